/* answer_classify: special values of parameters, and the values for which there may be another integral. */
#include <string.h>

#include "commands/classify_absence.h"
#include "document/classification.h"
#include "library/answer_internal.h"

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

static bool is_absence(const nh_request *q) { return q->of && !strcmp(q->of, "absence"); }

/* --of measure */
static bool read_question(const nh_request *q, nh_classify_request *out, nh_error *error)
{
    static const char *const names[] = {
#define X(name, word) #word,
        NH_LINEAR_QUESTION_TABLE(X)
#undef X
            "absence"};
    size_t of = 0;
    while (q->of && of < NH_LINEAR_QUESTIONS && strcmp(q->of, names[of])) of++;
    out->of = (nh_linear_question)of;
    if (of < NH_LINEAR_QUESTIONS && (of == NH_OF_CURRENTS || !out->over[1])) return true;
    if (of < NH_LINEAR_QUESTIONS) {
        nh_fail(error, NH_USAGE, "", "--of %s takes one parameter, not %s", q->of, out->over[2] ? "three" : "two");
        return nh_error_hint(error, "give the other%s with --set", out->over[2] ? "s values" : " a value");
    }
    nh_fail(error, NH_USAGE, "", "--of does not know `%s`", q->of);
    return nh_error_hint_near(error, q->of, names, sizeof names / sizeof *names,
                              "currents, measure, hamiltonization, symmetries, constraints or absence");
}

static bool read_classify(const nh_request *q, nh_classify_request *out, nh_error *error)
{
    *out = (nh_classify_request){.command = q->line,
                                 .system_path = q->system_path,
                                 .settings = q->settings,
                                 .setting = q->setting,
                                 .shape = q->shape,
                                 .options = q->options};
    return is_absence(q) || (read_names(q, out, error) && read_question(q, out, error));
}

static bool classify_check(const nh_request *q, nh_error *error)
{
    nh_classify_request ignored;
    return read_classify(q, &ignored, error);
}

static bool classified_create(nh_answer *a, nh_error *error)
{
    nh_classify_request request;
    if (!read_classify(a->request, &request, error)) return false;
    if (is_absence(a->request)) a->part[1] = nh_classify_absence(&request, a->request->over, error);
    else a->part[0] = nh_classify_system(&request, error);
    return a->part[0] || a->part[1];
}

static void classified_free(nh_answer *a)
{
    nh_classified_free(a->part[0]);
    nh_classified_absence_free(a->part[1]);
}

static void classified_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    if (a->part[1]) nh_classification_absence_write(a->part[1], &a->run, style, out);
    else nh_classification_write(a->part[0], &a->run, style, out);
}

static char *classified_json(const nh_answer *a)
{
    return a->part[1] ? nh_classification_absence_json(a->part[1], &a->run)
                      : nh_classification_json(a->part[0], &a->run);
}

static int classified_code(const nh_answer *a, nh_error *error)
{
    const nh_classified *x = a->part[0];
    const nh_classified_absence *values = a->part[1];
    if (values) return nh_answer_code(values->partial, error);
    if (x->classification->obstacle) nh_fail(error, NH_NUMERIC, "", "%s", x->classification->obstacle);
    return nh_answer_code(x->partial, error);
}

const nh_answer_kind nh_answer_classify = {.name = "classify",
                                           .check = classify_check,
                                           .create = classified_create,
                                           .free = classified_free,
                                           .write = classified_write,
                                           .json = classified_json,
                                           .code = classified_code};
