/* answer: the table of answers, and the rows of all commands but simulate, reduce, export and classify. */
#include "library/answer.h"

#include <math.h>
#include <string.h>

#include "absence/absence.h"
#include "base/foreign_memory.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "commands/robustness.h"
#include "commands/verify.h"
#include "document/analysis.h"
#include "document/benchmark.h"
#include "document/html.h"
#include "document/linearized.h"
#include "document/scan.h"
#include "document/shown.h"
#include "document/unfinished.h"
#include "document/verification.h"
#include "evaluate/machine.h"
#include "library/answer_internal.h"

const nh_answer_kind *nh_answer_kind_of(const char *command)
{
#define X(name)                                                                                                        \
    if (!strcmp(command, #name)) return &nh_answer_##name;
    NH_ANSWER_TABLE(X)
#undef X
    return NULL;
}

static nh_answer begun(const nh_answer_kind *kind, const nh_request *q)
{
    return (nh_answer){
        .kind = kind,
        .request = q,
        .run = {q->line, q->system_path, q->analysis_path, q->options.seed, q->options.shown, NAN, q->system_words}};
}

bool nh_answer_create(nh_answer *a, const nh_request *q, nh_error *error)
{
    *a = begun(nh_answer_kind_of(q->command), q);
    return a->kind->create(a, error);
}

void nh_answer_free(nh_answer *a) { a->kind->free(a); }

int nh_answer_code(bool partial, const nh_error *error)
{
    return nh_interrupted() ? (int)nh_ended_code() : partial ? NH_LIMIT : (int)error->code;
}

void nh_answer_cleanup(void)
{
    nh_machine_cleanup();
    nh_foreign_memory_end();
}

/* ---- a run that was ended before it had a result ---- */

/* Parts: what is known, in the arena of the request; the system. */
static void unfinished_free(nh_answer *a) { nh_system_free(a->part[1]); }

static void unfinished_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_unfinished_write(a->part[0], &a->run, style, out);
}

static char *unfinished_json(const nh_answer *a) { return nh_unfinished_json(a->part[0], &a->run); }

bool nh_answer_unfinished(nh_answer *a, const nh_request *q)
{
    static const nh_answer_kind kind = {.free = unfinished_free, .write = unfinished_write, .json = unfinished_json};
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_system *system = q->system_path ? nh_system_read(q->system_path, q->settings, q->setting, &ignored) : NULL;
    if (!system) return false;
    char doing[80], why[80];
    nh_progress_last(doing, sizeof doing);
    nh_ended_words(why, sizeof why);
    nh_unfinished *u = nh_arena_alloc(q->arena, sizeof *u);
    *u = (nh_unfinished){system, nh_arena_strdup(q->arena, doing), nh_arena_strdup(q->arena, why),
                         !strcmp(q->command, "analyze")};
    *a = begun(&kind, q);
    a->part[0] = u;
    a->part[1] = system;
    return true;
}

/* ---- figures ---- */

bool nh_answer_figure(const char **page, const char **figure, size_t *length)
{
    return (*figure = nh_html_next_figure(page, length)) != NULL;
}

bool nh_answer_is_figure(const char *text, size_t number) { return nh_html_is_figure(text, number); }

/* ---- analyze ---- */

static bool analysis_create(nh_answer *a, nh_error *error)
{
    nh_analysis *result = nh_analysis_create(a->request, error);
    a->part[0] = result;
    if (result && !a->request->model_only && !nh_interrupted()) nh_absence_find(result, a->request->absence);
    return result != NULL;
}

static void analysis_free(nh_answer *a) { nh_analysis_free(a->part[0]); }

static void analysis_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_analysis_write(a->part[0], style, out); /* an analysis has a run of its own */
}

static char *analysis_json(const nh_answer *a) { return nh_analysis_json(a->part[0]); }

static int analysis_code(const nh_answer *a, nh_error *error)
{
    const nh_analysis *result = a->part[0];
    const nh_validation *v = result->validation;
    if (a->request->accuracy > 0 && !result->partial && !(v && v->accuracy.held))
        nh_fail(error, NH_NUMERIC, "", "%s",
                v ? v->accuracy.why : "no motion was computed, so the requested accuracy was not reached");
    if (result->counted_space.compared && !result->counted_space.agrees)
        nh_fail(error, NH_NUMERIC, "", "the sampled problem and the count disagree: one of them is wrong");
    if (result->absence && result->absence->contradiction)
        nh_fail(error, NH_NUMERIC, "", "%s: one of them is wrong", result->absence->contradiction);
    return nh_answer_code(result->partial, error);
}

const nh_answer_kind nh_answer_analyze = {.name = "analyze",
                                          .analysis = true,
                                          .create = analysis_create,
                                          .free = analysis_free,
                                          .write = analysis_write,
                                          .json = analysis_json,
                                          .code = analysis_code};

/* ---- verify ---- */

static bool of_motions(const nh_request *q) { return q->of && !strcmp(q->of, "equations"); }

static bool verify_check(const nh_request *q, nh_error *error)
{
    static const char *const words[] = {"constraint", "equations"};
    if (q->of && !of_motions(q) && strcmp(q->of, words[0])) {
        nh_fail(error, NH_USAGE, "", "--of does not know `%s`", q->of);
        return nh_error_hint_near(error, q->of, words, sizeof words / sizeof *words,
                                  "--of takes constraint or equations");
    }
    if (!q->of || q->field) return true;
    nh_fail(error, NH_USAGE, "", "--of needs --field");
    return nh_error_hint(error, "for example: --field \"Z0=1\" --of equations");
}

static bool verification_create(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    nh_verification *v = nh_verification_create(q, error);
    if (v && q->equations) nh_verification_write_out(v, &q->options);
    return (a->part[0] = v) != NULL;
}

static void verification_free(nh_answer *a) { nh_verification_free(a->part[0]); }

static void verification_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_verification *v = a->part[0];
    nh_simulation *motion = style.form == NH_PEN_PAGE ? nh_answer_motion_of_page(a->request) : NULL;
    v->motion = motion;
    nh_verification_write(v, &a->run, style, out);
    v->motion = NULL;
    nh_simulation_free(motion);
}

static char *verification_json(const nh_answer *a) { return nh_verification_json(a->part[0], &a->run); }

static int verification_code(const nh_answer *a, nh_error *error)
{
    const nh_verification *v = a->part[0];
    (void)error;
    return v->conserved ? NH_OK : NH_REFUTED;
}

const nh_answer_kind nh_answer_verify = {.name = "verify",
                                         .check = verify_check,
                                         .create = verification_create,
                                         .free = verification_free,
                                         .write = verification_write,
                                         .json = verification_json,
                                         .code = verification_code};

/* ---- show --equations ---- */

static bool shown_create(nh_answer *a, nh_error *error)
{
    return (a->part[0] = nh_shown_create(a->request, error)) != NULL;
}

static void shown_free(nh_answer *a) { nh_shown_free(a->part[0]); }

static void shown_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_shown_write(a->part[0], &a->run, style, out);
}

static char *shown_json(const nh_answer *a) { return nh_shown_json(a->part[0], &a->run); }

static int shown_code(const nh_answer *a, nh_error *error)
{
    (void)a;
    return nh_answer_code(false, error);
}

const nh_answer_kind nh_answer_show = {.name = "show",
                                       .create = shown_create,
                                       .free = shown_free,
                                       .write = shown_write,
                                       .json = shown_json,
                                       .code = shown_code};

/* ---- benchmark ---- */

/* Ranges are those of a map. */
static bool wants_maps(const nh_request *q) { return q->robustness || q->over; }

static bool benchmark_check(const nh_request *q, nh_error *error)
{
    if (q->fit && (wants_maps(q) || q->methods)) {
        nh_fail(error, NH_USAGE, "", "--fit, and --%s as well",
                q->methods ? "method"
                : q->over  ? "over"
                           : "robustness");
        return nh_error_hint(error, "--fit measures the discrete problem, and no motion");
    }
    if (!wants_maps(q) || !q->methods) return true;
    nh_fail(error, NH_USAGE, "", "--method, and --%s as well", q->over ? "over" : "robustness");
    return nh_error_hint(error, "maps compare five methods, which are always the same");
}

static bool benchmark_create(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    static const double usual = 5; /* seconds */
    a->part[0] = wants_maps(q) ? nh_robustness_benchmark(q, q->over, q->budget, error)
                               : nh_benchmark_run(q, q->budget > 0 ? q->budget : usual, error);
    return a->part[0] != NULL;
}

static void benchmark_free(nh_answer *a) { nh_benchmark_free(a->part[0]); }

static void benchmark_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    const nh_benchmark *b = a->part[0];
    nh_benchmark_write(b, b->maps, &a->run, style, out);
}

static char *benchmark_json(const nh_answer *a)
{
    const nh_benchmark *b = a->part[0];
    return nh_benchmark_json(b, b->maps, &a->run);
}

static void benchmark_table(const nh_answer *a, nh_text *csv) { nh_benchmark_csv(a->part[0], csv); }

static void benchmark_picture(const nh_answer *a, nh_text *svg) { nh_benchmark_svg(a->part[0], svg); }

static int benchmark_code(const nh_answer *a, nh_error *error)
{
    (void)a;
    if (nh_interrupted()) nh_fail_ended(error, "while methods were compared: this is what was measured until then");
    return (int)error->code;
}

const nh_answer_kind nh_answer_benchmark = {.name = "benchmark",
                                            .analysis = true,
                                            .check = benchmark_check,
                                            .create = benchmark_create,
                                            .free = benchmark_free,
                                            .write = benchmark_write,
                                            .json = benchmark_json,
                                            .table = benchmark_table,
                                            .table_name = "runs.csv",
                                            .picture = benchmark_picture,
                                            .code = benchmark_code};

/* ---- linearize ---- */

static bool linearize_check(const nh_request *q, nh_error *error)
{
    if (q->overs < 2) return true;
    nh_fail(error, NH_USAGE, "", "--over takes one range here, found %zu", q->overs);
    return nh_error_hint(error, "a stability chart is made of several runs, with --set for the other parameter");
}

static bool linearized_create(nh_answer *a, nh_error *error)
{
    return (a->part[0] = nh_linearize_create(a->request, error)) != NULL;
}

static void linearized_free(nh_answer *a) { nh_linearized_free(a->part[0]); }

static void linearized_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_linearized_write(a->part[0], &a->run, style, out);
}

static char *linearized_json(const nh_answer *a) { return nh_linearized_json(a->part[0], &a->run); }
static void linearized_table(const nh_answer *a, nh_text *csv) { nh_linearized_csv(a->part[0], csv); }
static void linearized_picture(const nh_answer *a, nh_text *svg) { nh_linearized_svg(a->part[0], svg); }

static size_t linearized_files(const nh_answer *a, nh_answer_file file[NH_ANSWER_FILES])
{
    file[0].name = "matrices.csv";
    nh_text_init(&file[0].text);
    nh_linearized_matrices_csv(a->part[0], &file[0].text);
    return 1;
}

static int linearized_code(const nh_answer *a, nh_error *error)
{
    const nh_linearized *x = a->part[0];
    if (x->partial) nh_fail_ended(error, "when %zu values were computed", x->rows);
    return nh_answer_code(x->partial, error);
}

const nh_answer_kind nh_answer_linearize = {.name = "linearize",
                                            .check = linearize_check,
                                            .create = linearized_create,
                                            .free = linearized_free,
                                            .write = linearized_write,
                                            .json = linearized_json,
                                            .table = linearized_table,
                                            .table_name = "eigenvalues.csv",
                                            .files = linearized_files,
                                            .picture = linearized_picture,
                                            .code = linearized_code};

/* ---- scan ---- */

static const char scan_kept[] = "what is finished is kept; the same command continues";

static bool scan_create(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    nh_scan_source *source = nh_arena_alloc(q->arena, sizeof *source); /* the scan refers to it */
    bool shared = q->team && q->team->size > 1;
    nh_request each = *q;
    each.workers = shared || !q->workers ? 1 : q->workers;
    if ((shared || each.workers > 1) && !each.options.threads) each.options.threads = 1;
    if (!nh_scan_numbers(q->arena, &each, source, error)) return false;
    nh_scan_request request = {.system_path = q->system_path,
                               .settings = q->settings,
                               .setting = q->setting,
                               .axes = q->overs,
                               .over = q->over_list,
                               .source = source,
                               .options = each.options,
                               .program = q->program,
                               .folder = q->folder,
                               .chunk = q->chunk,
                               .chunks = q->chunks,
                               .workers = each.workers,
                               .begin_worker = q->begin_worker,
                               .team = q->team};
    nh_scan *x = nh_scan_create(&request, error);
    if (!x) {
        if (error->code == NH_NUMERIC) *error->hint = 0, nh_error_hint(error, "%s", scan_kept);
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
        *error->hint = 0, nh_error_hint(error, "%s", scan_kept);
        return (int)error->code;
    }
    if (nh_interrupted()) return (int)nh_ended_code();
    if (x->finished == x->units && !(x->partial && !x->chunked)) return NH_OK;
    nh_fail(error, NH_NUMERIC, "", "%zu of %zu units were not computed%s%s", x->units - x->finished, x->units,
            x->death ? ": " : "", x->death ? x->death : "");
    nh_error_hint(error, "%s", scan_kept);
    return error->code;
}

const nh_answer_kind nh_answer_scan = {.name = "scan",
                                       .create = scan_create,
                                       .free = scan_free,
                                       .write = scan_write,
                                       .json = scan_json,
                                       .table = scan_table,
                                       .table_name = "scan.csv",
                                       .notes = scan_notes,
                                       .code = scan_code};
