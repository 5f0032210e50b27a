#include "base/sweep.h"

#include <dirent.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/context_internal.h"
#include "base/files.h"
#include "base/output.h"
#include "base/progress.h"
#include "base/sweep_internal.h"

static const char finished_word[] = "finished ", part_word[] = "part ";

/* Units of the sweep. */
static size_t units_of(const nh_sweep *s) { return (s->items + s->per_unit - 1) / s->per_unit; }

static size_t first_item(const nh_sweep *s, size_t unit) { return unit * s->per_unit; }

static size_t unit_items(const nh_sweep *s, size_t unit)
{
    size_t left = s->items - first_item(s, unit);
    return left < s->per_unit ? left : s->per_unit;
}

static bool is_ours(const nh_sweep *s, size_t unit) { return s->chunks < 2 || unit % s->chunks == s->chunk; }

/* ---- files ---- */

static void path_of(const nh_sweep *s, size_t unit, const char *ending, nh_text *out)
{
    nh_text_init(out);
    nh_text_addf(out, "%s/%s-%06zu.%s", s->folder, s->name, unit, ending);
}

/* A file ends with a line that says whether the unit is finished, and the fingerprint of what is before it. */
static void end_file(nh_text *text, bool whole)
{
    uint64_t sum = nh_text_fingerprint(0, nh_text_string(text), text->length);
    nh_text_addf(text, "%s%016" PRIx64 "\n", whole ? finished_word : part_word, sum);
}

/* Cuts the last line off; false where the file was changed since. */
static bool cut_end(char *text, bool *whole)
{
    size_t length = strlen(text), last = length ? length - 1 : 0;
    while (last && text[last - 1] != '\n') last--;
    *whole = !strncmp(text + last, finished_word, sizeof finished_word - 1);
    nh_text own;
    nh_text_init(&own);
    nh_text_add_n(&own, text, last);
    end_file(&own, *whole);
    bool good = own.length == length && !strcmp(nh_text_string(&own), text);
    nh_text_clear(&own);
    text[last] = 0;
    return good;
}

/* The lines behind the head, each ended by 0; *count: how many, at most as many as the unit has items.  Returns the
 * first one, or NULL where the file is not of this sweep, or damaged. */
static char *cut_lines(const nh_sweep *s, size_t unit, char *text, size_t *lines, bool *finished)
{
    nh_text head;
    bool whole, good = cut_end(text, &whole);
    nh_text_init(&head);
    nh_text_addf(&head, "%s %zu\n", s->fingerprint, unit);
    bool own = good && !strncmp(text, nh_text_string(&head), head.length);
    char *at = text + head.length, *start = at;
    nh_text_clear(&head);
    *lines = 0;
    *finished = false;
    if (!own) return NULL;
    for (char *end; *lines < unit_items(s, unit) && (end = strchr(at, '\n')); at = end + 1, (*lines)++) *end = 0;
    *finished = whole && *lines == unit_items(s, unit) && !*at;
    return start;
}

/* The lines of the unit's file; the caller frees *text.  NULL: there is no file, or no finished one. */
static char *finished_lines(const nh_sweep *s, size_t unit, char **text)
{
    nh_text path;
    size_t lines;
    bool finished = false;
    path_of(s, unit, "txt", &path);
    *text = nh_files_own(nh_text_string(&path), NULL);
    nh_text_clear(&path);
    char *start = *text ? cut_lines(s, unit, *text, &lines, &finished) : NULL;
    if (finished) return start;
    nh_free(*text);
    *text = NULL;
    return NULL;
}

static bool is_finished(const nh_sweep *s, size_t unit)
{
    char *text;
    bool finished = finished_lines(s, unit, &text) != NULL;
    nh_free(text);
    return finished;
}

size_t nh_sweep_read(const nh_sweep *s, nh_arena *arena, const char **line)
{
    size_t found = 0;
    for (size_t unit = 0; unit < units_of(s); unit++) {
        char *text = NULL, *at = is_ours(s, unit) ? finished_lines(s, unit, &text) : NULL;
        size_t n = unit_items(s, unit), first = first_item(s, unit);
        for (size_t k = 0; k < n; k++) {
            line[first + k] = at ? nh_arena_strdup(arena, at) : NULL;
            if (at) at += strlen(at) + 1;
        }
        found += text ? n : 0;
        nh_free(text);
    }
    return found;
}

/* ---- one unit ---- */

static bool write_unit(const nh_sweep *s, size_t unit, const char *ending, const nh_text *lines, bool whole,
                       nh_error *error)
{
    nh_text path, text;
    path_of(s, unit, ending, &path);
    nh_text_init(&text);
    nh_text_addf(&text, "%s %zu\n", s->fingerprint, unit);
    nh_text_add(&text, nh_text_string(lines));
    end_file(&text, whole);
    bool good = nh_output_write(nh_text_string(&path), nh_text_string(&text), text.length, error);
    nh_text_clear(&text);
    nh_text_clear(&path);
    return good;
}

/* Reads what an interrupted run left of this unit. */
static size_t take_part(const nh_sweep *s, size_t unit, nh_text *lines)
{
    nh_text path;
    size_t n = 0;
    bool finished;
    path_of(s, unit, "part", &path);
    char *text = nh_files_own(nh_text_string(&path), NULL), *at = text ? cut_lines(s, unit, text, &n, &finished) : NULL;
    for (size_t k = 0; at && k < n; k++) {
        nh_text_addf(lines, "%s\n", at);
        at += strlen(at) + 1;
    }
    nh_free(text);
    nh_text_clear(&path);
    return n;
}

static void drop_part(const nh_sweep *s, size_t unit)
{
    nh_text path;
    path_of(s, unit, "part", &path);
    unlink(nh_text_string(&path));
    nh_text_clear(&path);
}

bool nh_sweep_do_unit(const nh_sweep *s, size_t unit, atomic_size_t *items_done, bool (*orphan)(void), nh_error *error)
{
    nh_text lines;
    nh_text_init(&lines);
    size_t n = unit_items(s, unit), before = take_part(s, unit, &lines), k = before;
    atomic_fetch_add(items_done, before);
    for (; k < n && !nh_interrupted() && !(orphan && orphan()); k++) {
        size_t length = lines.length;
        if (!s->item(s->context, first_item(s, unit) + k, &lines) || nh_interrupted()) {
            lines.length = length;
            if (lines.data) lines.data[length] = 0;
            break;
        }
        nh_text_add(&lines, "\n");
        atomic_fetch_add(items_done, 1);
    }
    bool good = k == n ? write_unit(s, unit, "txt", &lines, true, error)
                       : k == before || write_unit(s, unit, "part", &lines, false, error);
    if (good && k == n) drop_part(s, unit);
    nh_text_clear(&lines);
    return good;
}

/* ---- all of them ---- */

static size_t missing(const nh_sweep *s, size_t *unit)
{
    size_t n = 0;
    for (size_t u = 0; u < units_of(s); u++)
        if (is_ours(s, u) && !is_finished(s, u)) unit[n++] = u;
    return n;
}

/* The same words from first to last: a log then has a line now and then, and not one for every item. */
void nh_sweep_say(const nh_sweep *s, size_t done, size_t all)
{
    nh_progress(s->doing, all ? (double)done / (double)all : 1);
}

/* An item's own reports would hide how far the whole sweep is. */
static nh_progress_handler *be_quiet(void **context)
{
    nh_context *c = nh_context_here();
    nh_progress_handler *handler = c->handler;
    *context = c->handler_context;
    c->handler = NULL;
    return handler;
}

static bool do_here(const nh_sweep *s, size_t n, const size_t *unit, nh_error *error)
{
    atomic_size_t done = 0;
    size_t all = 0;
    bool good = true;
    for (size_t i = 0; i < n; i++) all += unit_items(s, unit[i]);
    for (size_t i = 0; good && i < n && !nh_interrupted(); i++) {
        void *context;
        nh_sweep_say(s, atomic_load(&done), all);
        nh_progress_handler *handler = be_quiet(&context);
        good = nh_sweep_do_unit(s, unit[i], &done, NULL, error);
        nh_progress_set(handler, context);
    }
    return good;
}

/* The team gives out numbers of units, including those that were finished before. */
static bool do_in_team(const nh_sweep *s, nh_error *error)
{
    atomic_size_t done = 0;
    bool good = true;
    for (size_t u; good && !nh_interrupted() && (u = s->team->next(s->team->context)) < units_of(s);) {
        void *context;
        nh_progress_handler *handler;
        nh_sweep_say(s, first_item(s, u), s->items);
        handler = be_quiet(&context);
        good = is_finished(s, u) || nh_sweep_do_unit(s, u, &done, NULL, error);
        nh_progress_set(handler, context);
    }
    return good;
}

/* Has something else than our files one of their names? */
static bool only_files(const nh_sweep *s, nh_error *error)
{
    static const char *const ending[] = {"txt", "part"};
    bool good = true;
    for (size_t u = 0; u < units_of(s) && good; u++)
        for (int i = 0; i < 2 && good && is_ours(s, u); i++) {
            nh_text path;
            path_of(s, u, ending[i], &path);
            good = nh_files_regular(nh_text_string(&path), error);
            nh_text_clear(&path);
        }
    return good;
}

bool nh_sweep_run(const nh_sweep *s, nh_sweep_state *state, nh_error *error)
{
    enum { rounds = 3 }; /* a unit whose worker died is tried twice more */
    size_t *unit = nh_alloc_array(units_of(s) + 1, sizeof *unit), n = 0;
    *state = (nh_sweep_state){0};
    bool good = only_files(s, error);
    if (good && s->team && s->team->size > 1) good = do_in_team(s, error);
    if (s->team && s->team->size > 1) s->team->meet(s->team->context);
    bool whole = !s->team || s->team->rank == 0; /* the first process of a team computes what others lost */
    for (int round = 0; good && whole && round < rounds && !nh_interrupted(); round++) {
        if (!(n = missing(s, unit))) break;
        good = s->workers > 1 && n > 1 ? nh_sweep_do_in_workers(s, n, unit, state, error) : do_here(s, n, unit, error);
    }
    for (size_t u = 0; u < units_of(s); u++) state->units += is_ours(s, u);
    state->finished = state->units - missing(s, unit);
    nh_free(unit);
    return good;
}

/* ---- who works in the folder ---- */

bool nh_sweep_hold(const char *folder, int *hold, nh_error *error)
{
    nh_text path;
    nh_text_init(&path);
    nh_text_addf(&path, "%s/lock", folder);
    bool good = nh_files_regular(nh_text_string(&path), error);
    *hold = good ? open(nh_text_string(&path), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666) : -1;
    nh_text_clear(&path);
    if (*hold >= 0) flock(*hold, LOCK_SH);
    return good;
}

/* NAME-000017.txt.AbCdEf */
static bool is_temporary(const char *file, const char *name)
{
    const char *dot = strrchr(file, '.');
    return !strncmp(file, name, strlen(name)) && dot && strlen(dot) == 7;
}

bool nh_sweep_is_alone(int hold) { return hold >= 0 && !flock(hold, LOCK_EX | LOCK_NB); }

void nh_sweep_tidy(const char *folder, const char *name)
{
    DIR *list = opendir(folder);
    for (struct dirent *entry; list && (entry = readdir(list));)
        if (is_temporary(entry->d_name, name)) unlinkat(dirfd(list), entry->d_name, 0);
    if (list) closedir(list);
}

void nh_sweep_release(int hold)
{
    if (hold >= 0) close(hold);
}
