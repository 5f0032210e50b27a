/* answer_search: currents and symmetries of one system, and at special values of its parameters. */
#include <string.h>

#include "commands/classify.h"
#include "commands/verify.h"
#include "document/analysis_json.h"
#include "document/analysis_outline.h"
#include "document/classification.h"
#include "document/verification.h"
#include "library/answer_internal.h"

/* ---- analyze ---- */

static bool analyze(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    nh_analyze_request request = {.command = q->line,
                                  .system_path = q->system_path,
                                  .system_words = q->system_words,
                                  .analysis_path = q->analysis_path,
                                  .settings = q->settings,
                                  .setting = q->setting,
                                  .chart = q->velocities,
                                  .options = q->options,
                                  .accuracy = q->accuracy,
                                  .equations = q->equations,
                                  .no_figures = !q->documents,
                                  .seed_given = q->seed_given,
                                  .samples_given = q->samples_given,
                                  .tolerance_given = q->tolerance_given,
                                  .until_given = q->until_given};
    return (a->part[0] = nh_analysis_create(&request, error)) != NULL;
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
    return nh_answer_code(result->partial, error);
}

const nh_answer_kind nh_answer_analyze = {.name = "analyze",
                                          .analysis = true,
                                          .create = analyze,
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

static bool verify(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    nh_system *system = nh_system_read(q->system_path, q->settings, q->setting, error); /* the verification's own */
    nh_verification *v =
        !system         ? NULL
        : of_motions(q) ? nh_verification_of_motions(system, q->velocities, q->field, &q->options, error)
        : q->current    ? nh_verification_of_current(system, q->velocities, q->current, &q->options, error)
                        : nh_verification_of_field(system, q->velocities, q->field, &q->options, error);
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
                                         .create = verify,
                                         .free = verification_free,
                                         .write = verification_write,
                                         .json = verification_json,
                                         .code = verification_code};

/* ---- classify ---- */

/* "eps", "B, eps" or "A, B, eps" */
static bool read_names(const nh_request *q, nh_classify_request *out, nh_error *error)
{
    size_t count = 0;
    for (const char *at = q->over; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        at += strspn(at, " ");
        size_t length = strcspn(at, ", ");
        if (length == 0) return nh_fail(error, NH_USAGE, "", "--over `%s` lacks the name of a parameter", q->over);
        if (count == NH_MOST_PARAMETERS) {
            nh_fail(error, NH_USAGE, "", "--over `%s` names more than three parameters", q->over);
            return nh_error_hint(error, "give the others values with --set");
        }
        out->over[count++] = nh_arena_strndup(q->arena, at, length);
    }
    return true;
}

/* --of measure */
static bool read_question(const nh_request *q, nh_classify_request *out, nh_error *error)
{
    static const char *const names[] = {
#define X(name, word) #word,
        NH_LINEAR_QUESTION_TABLE(X)
#undef X
    };
    size_t of = 0;
    while (q->of && of < NH_LINEAR_QUESTIONS && strcmp(q->of, names[of])) of++;
    out->of = (nh_linear_question)of;
    if (of < NH_LINEAR_QUESTIONS && (of == NH_OF_CURRENTS || !out->over[1])) return true;
    if (of < NH_LINEAR_QUESTIONS) {
        nh_fail(error, NH_USAGE, "", "--of %s takes one parameter, not %s", q->of, out->over[2] ? "three" : "two");
        return nh_error_hint(error, "give the other%s with --set", out->over[2] ? "s values" : " a value");
    }
    nh_fail(error, NH_USAGE, "", "--of does not know `%s`", q->of);
    return nh_error_hint_near(error, q->of, names, NH_LINEAR_QUESTIONS,
                              "currents, measure, hamiltonization, symmetries or constraints");
}

static bool read_classify(const nh_request *q, nh_classify_request *out, nh_error *error)
{
    *out = (nh_classify_request){.command = q->line,
                                 .system_path = q->system_path,
                                 .settings = q->settings,
                                 .setting = q->setting,
                                 .shape = q->shape,
                                 .options = q->options};
    return read_names(q, out, error) && read_question(q, out, error);
}

static bool classify_check(const nh_request *q, nh_error *error)
{
    nh_classify_request ignored;
    return read_classify(q, &ignored, error);
}

static bool classify(nh_answer *a, nh_error *error)
{
    nh_classify_request request;
    if (!read_classify(a->request, &request, error)) return false;
    a->part[0] = nh_classify_system(&request, error);
    return a->part[0];
}

static void classified_free(nh_answer *a) { nh_classified_free(a->part[0]); }

static void classified_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_classification_write(a->part[0], &a->run, style, out);
}

static char *classified_json(const nh_answer *a) { return nh_classification_json(a->part[0], &a->run); }

static int classified_code(const nh_answer *a, nh_error *error)
{
    const nh_classified *x = a->part[0];
    if (x->classification->obstacle) nh_fail(error, NH_NUMERIC, "", "%s", x->classification->obstacle);
    return nh_answer_code(x->partial, error);
}

const nh_answer_kind nh_answer_classify = {.name = "classify",
                                           .check = classify_check,
                                           .create = classify,
                                           .free = classified_free,
                                           .write = classified_write,
                                           .json = classified_json,
                                           .code = classified_code};
