/* answer_scan: numbers over a grid of parameters. */
#include <string.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "document/scan.h"
#include "document/scan_numbers.h"
#include "library/answer_internal.h"

static const char kept[] = "what is finished is kept; the same command continues";

static bool scan(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    nh_scan_source *source = nh_arena_alloc(q->arena, sizeof *source); /* the scan refers to it */
    nh_scan_request request = {.system_path = q->system_path,
                               .settings = q->settings,
                               .setting = q->setting,
                               .axes = q->overs,
                               .over = q->over_list,
                               .source = source,
                               .options = q->options,
                               .program = q->program,
                               .folder = q->folder,
                               .chunk = q->chunk,
                               .chunks = q->chunks,
                               .workers = q->workers,
                               .begin_worker = q->begin_worker,
                               .team = q->team};
    bool shared = q->team && q->team->size > 1;
    if (!request.workers || shared) request.workers = 1;
    if ((shared || request.workers > 1) && !request.options.threads) request.options.threads = 1;
    nh_scan_numbers_request numbers = {.of = q->of,
                                       .names = q->numbers,
                                       .name = q->number,
                                       .system_path = q->system_path,
                                       .settings = q->settings,
                                       .setting = q->setting,
                                       .options = request.options};
    if (!nh_scan_numbers(q->arena, &numbers, source, error)) return false;
    nh_scan *x = nh_scan_create(&request, error);
    if (!x) {
        if (error->code == NH_NUMERIC) *error->hint = 0, nh_error_hint(error, "%s", kept);
        return false;
    }
    a->part[0] = x;
    a->run.command = x->question; /* the process and the folder are no part of the answer */
    a->words_only = x->chunked;
    a->silent = x->silent;
    return true;
}

static void scan_free(nh_answer *a) { nh_scan_free(a->part[0]); }

static void scan_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_scan_write(a->part[0], &a->run, style, out);
}

static char *scan_json(const nh_answer *a) { return nh_scan_json(a->part[0], &a->run); }

static void scan_table(const nh_answer *a, nh_text *csv) { nh_scan_csv(a->part[0], csv); }

static void scan_notes(const nh_answer *a, bool verbose, bool printed, nh_text *out)
{
    const nh_scan *x = a->part[0];
    (void)verbose, (void)printed;
    if (x->deaths)
        nh_text_addf(out,
                     "nhsym: %zu time%s a worker ended early, and what it had begun was computed again; the last "
                     "time %s\n",
                     x->deaths, x->deaths == 1 ? "" : "s", x->death);
}

static int scan_code(const nh_answer *a, nh_error *error)
{
    const nh_scan *x = a->part[0];
    if (error->code != NH_OK) { /* it could not be written */
        *error->hint = 0, nh_error_hint(error, "%s", kept);
        return (int)error->code;
    }
    if (nh_interrupted()) return (int)nh_ended_code();
    if (x->finished == x->units && !(x->partial && !x->chunked)) return NH_OK;
    nh_fail(error, NH_NUMERIC, "", "%zu of %zu units were not computed%s%s", x->units - x->finished, x->units,
            x->death ? ": " : "", x->death ? x->death : "");
    nh_error_hint(error, "%s", kept);
    return error->code;
}

const nh_answer_kind nh_answer_scan = {.name = "scan",
                                       .create = scan,
                                       .free = scan_free,
                                       .write = scan_write,
                                       .json = scan_json,
                                       .table = scan_table,
                                       .table_name = "scan.csv",
                                       .notes = scan_notes,
                                       .code = scan_code};
