/* scan_manifest: the record of which scan a folder holds.
 *
 * The first process writes the manifest, once: it makes a link, which fails if the manifest exists.  Later processes
 * compute only if program, files and question are the same.  The time that a point takes affects the size of a unit,
 * and no answer depends on that. */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"
#include "base/json.h"
#include "base/output.h"
#include "commands/scan_internal.h"

static const double unit_seconds = 10;
static const size_t least_units = 32; /* of a small grid, so that several workers share it */

static const char *hexadecimal(nh_arena *arena, uint64_t number)
{
    return nh_arena_printf(arena, "%016" PRIx64, number);
}

static bool make_folder(const char *path, nh_error *error)
{
    if (!mkdir(path, 0777) || errno == EEXIST) return true;
    nh_fail(error, NH_NUMERIC, path, "the folder could not be created: %s", strerror(errno));
    return nh_error_hint(error, "-o takes a folder; its parent folder must exist");
}

/* ---- reading ---- */

static bool differs(const nh_json *m, const char *key, const char *mine, const char *what, const char *path,
                    nh_error *error)
{
    const char *there = nh_json_text(m, key);
    if (there && !strcmp(there, mine)) return false;
    nh_fail(error, NH_USAGE, path, "this folder holds a scan %s: there `%.200s`, here `%.200s`", what,
            there ? there : "", mine);
    nh_error_hint(error, "give another folder, or remove this one");
    return true;
}

static bool compare(const char *path, const char *text, const char *program, const char *files, const char *question,
                    size_t points, size_t *per_unit, double *seconds, nh_error *error)
{
    nh_json *m = nh_json_parse(text);
    double size = nh_json_value(m, "points_per_unit");
    *seconds = nh_json_value(m, "unit_seconds");
    bool good = size >= 1 && size <= (double)points && size == floor(size) && nh_json_value(m, "schema") == 1;
    if (!good) {
        nh_fail(error, NH_INPUT, path, "this is no manifest of a scan");
        nh_error_hint(error, "give another folder, or remove this one");
    }
    good = good && !differs(m, "question", question, "with another question", path, error) &&
           !differs(m, "files", files, "of another system file, or this one was changed since", path, error) &&
           !differs(m, "program", program, "that another program began", path, error);
    if (good) *per_unit = (size_t)size;
    nh_json_free(m);
    return good;
}

/* ---- writing ---- */

static char *manifest_text(const nh_scan *x, const char *program, const char *files, double seconds)
{
    nh_json *m = nh_json_object();
    double most = fmax(1, floor((double)x->points / (double)least_units));
    double size = fmin(most, fmax(1, floor(unit_seconds / fmax(seconds, 1e-9))));
    nh_json_put_number(m, "schema", 1);
    nh_json_put_text(m, "program", program);
    nh_json_put_text(m, "system", x->system->name);
    nh_json_put_text(m, "question", x->question);
    nh_json_put_text(m, "files", files);
    nh_json_put_number(m, "points", (double)x->points);
    nh_json_put_number(m, "points_per_unit", size);
    nh_json_put_number(m, "unit_seconds", seconds * size);
    return nh_json_finish(m);
}

/* Written beside its place, then linked to it: the first one stays. */
static bool write_first(const char *path, const char *text, nh_error *error)
{
    char beside[NH_OUTPUT_LONGEST];
    snprintf(beside, sizeof beside, "%s.%ld", path, (long)getpid());
    if (!nh_output_write(beside, text, strlen(text), error)) return false;
    bool good = !link(beside, path) || errno == EEXIST;
    int reason = errno;
    nh_output_remove(beside);
    return good || nh_fail(error, NH_NUMERIC, path, "could not be written: %s", strerror(reason));
}

bool nh_scan_manifest(nh_scan *x, const nh_scan_request *q, double (*seconds_of_a_point)(void *), void *context,
                      size_t *per_unit, const char **fingerprint, nh_error *error)
{
    const char *path = nh_arena_printf(x->arena, "%s/manifest.json", q->folder);
    const char *files = hexadecimal(x->arena, nh_files_fingerprint());
    if (!make_folder(q->folder, error) || !make_folder(nh_arena_printf(x->arena, "%s/units", q->folder), error))
        return false;
    if (!nh_files_regular(path, error)) return false;
    char *text = nh_files_own(path, error);
    if (!text) {
        char *mine = manifest_text(x, q->program, files, seconds_of_a_point(context));
        bool written = write_first(path, mine, error);
        nh_free(mine);
        if (!written || !(text = nh_files_own(path, error)))
            return nh_fail(error, NH_NUMERIC, path, "could not be written");
    }
    bool good = compare(path, text, q->program, files, x->question, x->points, per_unit, &x->unit_seconds, error);
    nh_free(text);
    uint64_t h = nh_text_fingerprint(0, x->question, strlen(x->question));
    h = nh_text_fingerprint(h, files, strlen(files));
    h = nh_text_fingerprint(h, q->program, strlen(q->program));
    *fingerprint = nh_arena_printf(x->arena, "nhsym scan %s", hexadecimal(x->arena, h));
    return good;
}
