/* library_answers: the commands of the public interface, and what they found as documents. */
#include <math.h>
#include <string.h>

#include "commands/reduce.h"
#include "commands/verify.h"
#include "library/answer.h"
#include "library/library_internal.h"

/* ---- commands ---- */

/* The result of a request: the first part of its answer. */
static void *result_of(nh_problem *p, const char *command, nh_request *q, nh_error *error)
{
    nh_answer a;
    q->command = command;
    nh_error_clear(error);
    const nh_answer_kind *kind = nh_answer_kind_of(command);
    if (kind->check && !kind->check(q, error)) return NULL;
    nh_problem_enter(p);
    bool good = nh_answer_create(&a, q, error);
    nh_problem_leave(p);
    return good ? a.part[0] : NULL;
}

nh_analysis *nh_analyze(nh_problem *p, nh_error *error)
{
    nh_request q = p->request;
    q.documents = true;
    return result_of(p, "analyze", &q, error);
}

nh_simulation *nh_simulate(nh_problem *p, nh_error *error) { return nh_simulate_zeros(p, NULL, NULL, error); }

nh_simulation *nh_simulate_zeros(nh_problem *p, const char *events, const char *section, nh_error *error)
{
    nh_request q = p->request;
    q.event = events;
    q.section = section;
    return result_of(p, "simulate", &q, error);
}

nh_reduction *nh_reduce(nh_problem *p, nh_error *error)
{
    nh_request q = p->request;
    return result_of(p, "reduce", &q, error);
}

static nh_verification *verify(nh_problem *p, const char *current, const char *field, nh_error *error)
{
    nh_request q = p->request;
    q.current = current;
    q.field = field;
    return result_of(p, "verify", &q, error);
}

nh_verification *nh_verify_current(nh_problem *p, const char *current, nh_error *error)
{
    return verify(p, current, NULL, error);
}

nh_verification *nh_verify_field(nh_problem *p, const char *field, nh_error *error)
{
    return verify(p, NULL, field, error);
}

bool nh_verification_holds(const nh_verification *v) { return v->conserved; }

bool nh_verification_proved(const nh_verification *v) { return v->proof.proved; }

nh_classified *nh_classify_over(nh_problem *p, const char *parameter, bool shape, nh_error *error)
{
    nh_request q = p->request;
    nh_error_clear(error);
    if (strchr(parameter, ',')) /* several have an answer of another kind */
        return nh_fail(error, NH_USAGE, "", "over: expected the name of one parameter, found `%s`", parameter), NULL;
    q.over = parameter;
    q.shape = shape;
    return result_of(p, "classify", &q, error);
}

nh_benchmark *nh_benchmark_methods(nh_problem *p, const nh_comparison *c, nh_error *error)
{
    nh_request q = p->request;
    nh_error_clear(error);
    q.methods = 0; /* that of the question is of a simulation */
    if (c && c->methods && !nh_request_methods(&q, c->methods, error)) return NULL;
    q.budget = c ? c->seconds : 0;
    q.robustness = c && c->robustness;
    q.over = c ? c->over : NULL;
    return result_of(p, "benchmark", &q, error);
}

/* ---- documents ---- */

/* The table or the picture; NULL with a message where there is none. */
static char *columns(const nh_answer *a, bool picture, nh_error *error)
{
    void (*const put)(const nh_answer *, nh_text *) = picture ? a->kind->picture : a->kind->table;
    if (!put) {
        nh_fail(error, NH_USAGE, "", "%s has no %s", a->kind->name, picture ? "picture" : "table");
        return nh_error_hint(error, "it has text, JSON, a page and LaTeX"), NULL;
    }
    nh_text text;
    nh_text_init(&text);
    put(a, &text);
    char *out = nh_strdup(nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* The LaTeX of a reduction are its equations; the table of a simulation is its motion, as in a folder, whether it has a
   section or not. */
static char *document(const char *command, const void *result, double seed, nh_format format, nh_error *error)
{
    static const double shown = 600; /* symbols of the longest formula on a page, as by default */
    const nh_request request = {.to = !strcmp(command, "reduce") && format == NH_FORMAT_LATEX ? "latex" : NULL,
                                .folder = ""};
    const nh_answer a = {.kind = nh_answer_kind_of(command), .request = &request, .part = {(void *)result},
                         .run = {.seed = seed, .shown = shown, .seconds = NAN}};
    bool table = request.to || (format == NH_FORMAT_TEXT && a.kind->print);
    nh_error_clear(error);
    if (format == NH_FORMAT_JSON) return a.kind->json(&a);
    if (format == NH_FORMAT_CSV || format == NH_FORMAT_SVG) return columns(&a, format == NH_FORMAT_SVG, error);
    nh_text text;
    nh_text_init(&text);
    nh_pen_form form = format == NH_FORMAT_HTML ? NH_PEN_PAGE : format == NH_FORMAT_LATEX ? NH_PEN_LATEX : NH_PEN_TEXT;
    if (!table || !a.kind->print(&a, &text))
        a.kind->write(&a, (nh_pen_style){.form = form, .verbose = form == NH_PEN_TEXT}, &text);
    char *out = nh_strdup(nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

char *nh_analysis_document(const nh_analysis *a, nh_format format, nh_error *error)
{
    return document("analyze", a, 1, format, error);
}

char *nh_simulation_document(const nh_simulation *s, nh_format format, nh_error *error)
{
    return document("simulate", s, 1, format, error);
}

char *nh_reduction_document(const nh_reduction *r, nh_format format, nh_error *error)
{
    return document("reduce", r, r->options.seed, format, error);
}

char *nh_verification_document(const nh_verification *v, nh_format format, nh_error *error)
{
    return document("verify", v, 1, format, error);
}

char *nh_classified_document(const nh_classified *c, nh_format format, nh_error *error)
{
    return document("classify", c, 1, format, error);
}

char *nh_benchmark_document(const nh_benchmark *b, nh_format format, nh_error *error)
{
    return document("benchmark", b, 1, format, error);
}

void nh_string_free(char *string) { nh_free(string); }
