/* library_answers: the commands of the public interface, and their results as documents. */
#include <math.h>
#include <string.h>

#include "commands/export.h"
#include "commands/reduce.h"
#include "commands/verify.h"
#include "library/answer.h"
#include "library/library_internal.h"

/* ---- commands ---- */

typedef struct {
    nh_request *request;
    nh_error *error;
    const char *methods; /* of a comparison, or NULL */
    void *result;
} computation;

static void compute(void *argument)
{
    computation *c = argument;
    const nh_answer_kind *kind = nh_answer_kind_of(c->request->command);
    nh_answer a;
    if (c->methods && !nh_request_methods(c->request, c->methods, c->error)) return;
    if (kind->check && !kind->check(c->request, c->error)) return;
    if (nh_answer_create(&a, c->request, c->error)) c->result = a.part[0];
}

/* The result of a request: the first part of its answer. */
static void *result_of(nh_problem *p, const char *command, nh_request *q, const char *methods, nh_error *error)
{
    computation c = {.request = q, .error = error, .methods = methods};
    q->command = command;
    return nh_problem_run(p, compute, &c, error) ? c.result : NULL;
}

nh_analysis *nh_analyze(nh_problem *p, nh_error *error)
{
    NH_OWN_ERROR(error);
    nh_request q = p->request;
    q.documents = true;
    return result_of(p, "analyze", &q, NULL, error);
}

nh_simulation *nh_simulate(nh_problem *p, nh_error *error) { return nh_simulate_zeros(p, NULL, NULL, error); }

nh_simulation *nh_simulate_zeros(nh_problem *p, const char *events, const char *section, nh_error *error)
{
    NH_OWN_ERROR(error);
    nh_request q = p->request;
    q.event = events;
    q.section = section;
    return result_of(p, "simulate", &q, NULL, error);
}

nh_reduction *nh_reduce(nh_problem *p, nh_error *error)
{
    NH_OWN_ERROR(error);
    nh_request q = p->request;
    return result_of(p, "reduce", &q, NULL, error);
}

static nh_verification *verify(nh_problem *p, const char *current, const char *field, nh_error *error)
{
    nh_request q = p->request;
    q.current = current;
    q.field = field;
    return result_of(p, "verify", &q, NULL, error);
}

nh_verification *nh_verify_current(nh_problem *p, const char *current, nh_error *error)
{
    NH_OWN_ERROR(error);
    return verify(p, current, NULL, error);
}

nh_verification *nh_verify_field(nh_problem *p, const char *field, nh_error *error)
{
    NH_OWN_ERROR(error);
    return verify(p, NULL, field, error);
}

bool nh_verification_holds(const nh_verification *v) { return v->conserved; }

bool nh_verification_proved(const nh_verification *v) { return v->proof.proved; }

nh_classified *nh_classify_over(nh_problem *p, const char *parameter, bool shape, nh_error *error)
{
    NH_OWN_ERROR(error);
    nh_request q = p->request;
    nh_error_clear(error);
    q.over = parameter;
    q.shape = shape;
    return result_of(p, "classify", &q, NULL, error);
}

nh_benchmark *nh_benchmark_methods(nh_problem *p, const nh_comparison *c, nh_error *error)
{
    NH_OWN_ERROR(error);
    nh_request q = p->request;
    nh_error_clear(error);
    q.methods = 0; /* that of the question is of a simulation */
    q.budget = c ? c->seconds : 0;
    q.robustness = c && c->robustness;
    q.over = c ? c->over : NULL;
    return result_of(p, "benchmark", &q, c ? c->methods : NULL, error);
}

nh_linearized *nh_linearize(nh_problem *p, const char *over, nh_error *error)
{
    NH_OWN_ERROR(error);
    nh_request q = p->request;
    q.over = over;
    return result_of(p, "linearize", &q, NULL, error);
}

/* ---- functions in other languages ---- */

nh_export *nh_export_functions(nh_problem *p, const char *language, const char *parts, const char *inputs,
                               const char *prefix, nh_error *error)
{
    nh_request q = p->request;
    q.to = language;
    q.of = parts;
    q.input = inputs;
    q.name = prefix;
    return result_of(p, "export", &q, NULL, error);
}

typedef struct {
    const nh_export *export;
    size_t file;
    char **name, *text;
} coding;

/* One of its files with its name, or all in one text. */
static void write_code(void *argument)
{
    coding *c = argument;
    const nh_export *x = c->export;
    const nh_request request = {.command = "export", .to = x->to, .name = x->name};
    const nh_answer a = {.kind = nh_answer_kind_of(request.command),
                         .request = &request,
                         .part = {(void *)x},
                         .run = {.seed = x->seed, .seconds = NAN}};
    nh_answer_file file[NH_ANSWER_FILES] = {{NULL}};
    size_t files = 1;
    if (c->name) files = a.kind->files(&a, file);
    else {
        nh_text_init(&file[0].text);
        a.kind->print(&a, &file[0].text);
    }
    if (c->file < files) {
        c->text = nh_strdup(nh_text_string(&file[c->file].text));
        if (c->name) *c->name = nh_strdup(file[c->file].name);
    }
    for (size_t i = 0; i < files; i++) nh_text_clear(&file[i].text);
}

char *nh_export_code(const nh_export *x, size_t file, char **name, nh_error *error)
{
    NH_OWN_ERROR(error);
    coding c = {.export = x, .file = file, .name = name};
    if (name) *name = NULL;
    return nh_library_try(write_code, &c, error) ? c.text : NULL;
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

typedef struct {
    const char *command;
    void *result;
    double seed;
    nh_format format;
    nh_error *error;
    char *text;
} writing;

/* The LaTeX of a reduction are its equations; the table of a simulation is its motion, as in a folder, whether it has a
   section or not. */
static void write_document(void *argument)
{
    static const double shown = 600; /* symbols of the longest formula on a page, as by default */
    writing *w = argument;
    nh_format format = w->format;
    const nh_request request = {.to = !strcmp(w->command, "reduce") && format == NH_FORMAT_LATEX ? "latex" : NULL,
                                .folder = ""};
    const nh_answer a = {.kind = nh_answer_kind_of(w->command),
                         .request = &request,
                         .part = {w->result},
                         .run = {.seed = w->seed, .shown = shown, .seconds = NAN}};
    bool table = request.to || (format == NH_FORMAT_TEXT && a.kind->print);
    if (format == NH_FORMAT_JSON) w->text = a.kind->json(&a);
    else if (format == NH_FORMAT_CSV || format == NH_FORMAT_SVG)
        w->text = columns(&a, format == NH_FORMAT_SVG, w->error);
    else {
        nh_text text;
        nh_text_init(&text);
        nh_pen_form form = format == NH_FORMAT_HTML    ? NH_PEN_PAGE
                           : format == NH_FORMAT_LATEX ? NH_PEN_LATEX
                                                       : NH_PEN_TEXT;
        if (!table || !a.kind->print(&a, &text))
            a.kind->write(&a, (nh_pen_style){.form = form, .verbose = form == NH_PEN_TEXT}, &text);
        w->text = nh_strdup(nh_text_string(&text));
        nh_text_clear(&text);
    }
}

static char *document(const char *command, const void *result, double seed, nh_format format, nh_error *error)
{
    writing w = {.command = command, .result = (void *)result, .seed = seed, .format = format, .error = error};
    return nh_library_try(write_document, &w, error) ? w.text : NULL;
}

char *nh_analysis_document(const nh_analysis *a, nh_format format, nh_error *error)
{
    NH_OWN_ERROR(error);
    return document("analyze", a, 1, format, error);
}

char *nh_simulation_document(const nh_simulation *s, nh_format format, nh_error *error)
{
    NH_OWN_ERROR(error);
    return document("simulate", s, 1, format, error);
}

char *nh_reduction_document(const nh_reduction *r, nh_format format, nh_error *error)
{
    NH_OWN_ERROR(error);
    return document("reduce", r, r->options.seed, format, error);
}

char *nh_verification_document(const nh_verification *v, nh_format format, nh_error *error)
{
    NH_OWN_ERROR(error);
    return document("verify", v, 1, format, error);
}

char *nh_classified_document(const nh_classified *c, nh_format format, nh_error *error)
{
    NH_OWN_ERROR(error);
    return document("classify", c, 1, format, error);
}

char *nh_benchmark_document(const nh_benchmark *b, nh_format format, nh_error *error)
{
    NH_OWN_ERROR(error);
    return document("benchmark", b, 1, format, error);
}

char *nh_linearized_document(const nh_linearized *x, nh_format format, nh_error *error)
{
    NH_OWN_ERROR(error);
    return document("linearize", x, 1, format, error);
}

void nh_string_free(char *string) { nh_free(string); }
