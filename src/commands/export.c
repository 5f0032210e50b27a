/* From a system file and the names of parts to a list of functions. */
#include "commands/export.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "commands/export_internal.h"
#include "graph/dag.h"
#include "graph/diff.h"

static const struct {
    const char *name;
    nh_export_part part;
} parts[] = {{"equations", NH_EXPORT_EQUATIONS}, {"momenta", NH_EXPORT_MOMENTA}, {"submanifold", NH_EXPORT_SUBMANIFOLD},
             {"currents", NH_EXPORT_CURRENTS},   {"reduced", NH_EXPORT_REDUCED}, {"all", NH_EXPORT_ALL}};
enum { part_count = sizeof parts / sizeof *parts };

const char *nh_export_part_name(nh_export_part part)
{
    for (size_t i = 0; i < part_count; i++)
        if (parts[i].part == part) return parts[i].name;
    return "";
}

/* ---- how functions are added ---- */

void nh_export_note(nh_export *x, const char *format, ...)
{
    char text[600];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (x->notes < sizeof x->note / sizeof *x->note) x->note[x->notes++] = nh_arena_strdup(x->arena, text);
}

nh_export_function *nh_export_add(nh_export *x, nh_export_part part, const nh_system *system, const char *name,
                                  const char *doc)
{
    nh_grow(&x->function, &x->capacity, x->functions + 1, sizeof *x->function);
    nh_export_function *f = &x->function[x->functions++];
    *f = (nh_export_function){.name = nh_arena_strdup(x->arena, name),
                              .doc = nh_arena_strdup(x->arena, doc),
                              .system = system,
                              .dag = system->dag,
                              .part = part};
    return f;
}

static const nh_ex *copy(nh_export *x, size_t n, const nh_ex *e)
{
    nh_ex *out = nh_arena_alloc(x->arena, (n + 1) * sizeof *out);
    if (n) memcpy(out, e, n * sizeof *e);
    return out;
}

void nh_export_argument(nh_export *x, nh_export_function *f, const char *name, const char *doc, size_t n,
                        const nh_ex *symbol)
{
    if (!n) return;
    f->argument[f->arguments++] = (nh_export_array){
        nh_arena_strdup(x->arena, name), nh_arena_strdup(x->arena, doc), n, 1, copy(x, n, symbol), NULL};
}

void nh_export_result(nh_export *x, nh_export_function *f, const char *name, const char *doc, size_t rows,
                      size_t columns, const nh_ex *value, const char *const *label)
{
    const char **words = NULL;
    if (!rows || !columns) return;
    if (label) words = nh_arena_alloc(x->arena, rows * sizeof *words);
    for (size_t i = 0; i < rows && label; i++) words[i] = nh_arena_strdup(x->arena, label[i]);
    f->result[f->results++] = (nh_export_array){nh_arena_strdup(x->arena, name),
                                                nh_arena_strdup(x->arena, doc),
                                                rows,
                                                columns,
                                                copy(x, rows * columns, value),
                                                words};
}

void nh_export_linear(nh_export *x, nh_export_function *f, size_t n, const nh_ex *matrix, const nh_ex *right,
                      const nh_ex *unknown)
{
    f->solve[f->solves++] = (nh_export_solve){
        .n = n, .matrix = copy(x, n * n, matrix), .right = copy(x, n, right), .unknown = copy(x, n, unknown)};
}

void nh_export_newton(nh_export *x, nh_export_function *f, size_t n, const nh_ex *matrix, const nh_ex *right,
                      const nh_ex *unknown, size_t guess)
{
    nh_export_linear(x, f, n, matrix, right, unknown);
    f->solve[f->solves - 1].newton = true;
    f->solve[f->solves - 1].guess = guess;
}

nh_ex *nh_export_symbols(nh_export *x, nh_dag *dag, const char *base, size_t n)
{
    nh_ex *out = nh_arena_alloc(x->arena, (n + 1) * sizeof *out);
    for (size_t i = 0; i < n; i++) out[i] = nh_symbol_fresh(dag, nh_arena_printf(x->arena, "%s%zu", base, i + 1));
    return out;
}

/* ---- the question ---- */

/* The next word of a list separated by commas or blanks; NULL at its end. */
static const char *next_word(nh_arena *arena, const char **list)
{
    *list += strspn(*list, ",; \t");
    size_t length = strcspn(*list, ",; \t");
    const char *word = length ? nh_arena_strndup(arena, *list, length) : NULL;
    *list += length;
    return word;
}

static bool read_parts(nh_export *x, const char *list, unsigned *out, nh_error *error)
{
    const char *names[part_count], *word;
    for (size_t i = 0; i < part_count; i++) names[i] = parts[i].name;
    *out = list ? 0 : NH_EXPORT_ALL;
    while (list && (word = next_word(x->arena, &list))) {
        size_t i = 0;
        while (i < part_count && strcmp(word, names[i])) i++;
        if (i < part_count) {
            *out |= parts[i].part;
            continue;
        }
        nh_fail(error, NH_USAGE, "--of", "there is no part `%.100s`", word);
        const char *near = nh_text_nearest(word, names, part_count);
        return near ? nh_error_hint(error, "did you mean `%s`?", near)
                    : nh_error_hint(error, "--of takes equations, momenta, submanifold, currents, reduced, or all");
    }
    if (*out) return true;
    nh_fail(error, NH_USAGE, "--of", "no part is named");
    return nh_error_hint(error, "--of takes equations, momenta, submanifold, currents, reduced, or all");
}

/* An input may be any function of time: its derivative must not occur in the equations of motion. */
static bool may_change(const nh_system *system, size_t parameter, nh_error *error)
{
    nh_dag *d = system->dag;
    const nh_parameter *u = &system->parameter[parameter];
    const char *where = NULL;
    for (size_t i = 0; i < system->coordinates && !where; i++)
        if (nh_depends(d, nh_diff(d, system->lagrangian, system->coordinate[i].v), u->symbol))
            where = "the velocities' part of the Lagrangian";
    for (size_t a = 0; a < system->constraints && !where; a++)
        if (nh_depends(d, nh_sub(d, system->constraint[a].lhs, system->constraint[a].rhs), u->symbol))
            where = "a constraint";
    if (!where) return true;
    nh_fail(error, NH_USAGE, "--input", "`%s` occurs in %s, so that the equations of motion contain its derivative",
            u->name, where);
    return nh_error_hint(error, "an input is a parameter of the forces or the potential, as in forces: [\"%s = u\"]",
                         system->coordinate[0].name);
}

static bool read_inputs(nh_export *x, const char *list, nh_error *error)
{
    const nh_system *system = x->system;
    const char **names = nh_arena_alloc(x->arena, (system->parameters + 1) * sizeof *names), *word;
    x->input = nh_arena_alloc(x->arena, (system->parameters + 1) * sizeof *x->input);
    for (size_t i = 0; i < system->parameters; i++) {
        names[i] = system->parameter[i].name;
        if (!system->parameter[i].input) continue;
        if (!may_change(system, i, error)) return false;
        x->inputs++;
        x->input[i] = true;
    }
    while (list && (word = next_word(x->arena, &list))) {
        size_t i = 0;
        while (i < system->parameters && strcmp(word, names[i])) i++;
        if (i == system->parameters) {
            nh_fail(error, NH_USAGE, "--input", "`%.100s` is not a parameter of %s", word, system->name);
            const char *near = nh_text_nearest(word, names, system->parameters);
            if (near) return nh_error_hint(error, "did you mean `%s`?", near);
            return nh_error_hint(error,
                                 "an input is declared in the system file: parameters: {%.40s: 0}, forces: "
                                 "[\"%s = %.40s\"]",
                                 word, system->coordinate[0].name, word);
        }
        if (!may_change(system, i, error)) return false;
        x->inputs += !x->input[i];
        x->input[i] = true;
    }
    return true;
}

/* ---- the results that the parts come from ---- */

static bool analyse(nh_export *x, const nh_request *q, nh_error *error)
{
    x->analysis = nh_analysis_create(q, error);
    if (!x->analysis) return false;
    x->model = x->analysis->question->model;
    x->partial |= x->analysis->partial;
    if (x->analysis->partial) nh_export_note(x, "a limit ended the search for currents");
    return true;
}

/* Without a group there is nothing to reduce by: this is a remark, unless the user asked for a group. */
static bool reduce(nh_export *x, const nh_request *q, nh_error *error)
{
    nh_error trouble = {0};
    x->reduction = nh_reduction_create(q, &trouble);
    if (!x->reduction && (q->group || q->initial || nh_interrupted() || trouble.code == NH_USAGE))
        return *error = trouble, false;
    if (!x->reduction) nh_export_note(x, "reduced: %s", trouble.what);
    else if (!x->reduction->stages) nh_export_note(x, "reduced: there is no symmetry group to divide out");
    if (x->reduction) x->partial |= x->reduction->partial;
    return true;
}

static bool gather(nh_export *x, const nh_request *q, unsigned wanted, nh_error *error)
{
    const unsigned geometry = NH_EXPORT_SUBMANIFOLD;
    uint64_t seed = (uint64_t)q->options.seed;
    if (wanted & NH_EXPORT_CURRENTS && !analyse(x, q, error)) return false;
    if (!x->model && wanted & ~(unsigned)NH_EXPORT_REDUCED) {
        nh_chart *chart = nh_chart_create(x->own, q->chart, seed, error);
        if (!chart) return false;
        x->model = x->bare = wanted & geometry ? nh_model_create(x->own, chart, error) : nh_model_bare(x->own, chart);
        if (!x->model || !nh_model_regular(x->model, error)) return false;
    }
    if (wanted & NH_EXPORT_EQUATIONS) nh_export_equations(x, x->model);
    if (wanted & NH_EXPORT_MOMENTA) nh_export_momenta(x, x->model);
    if (wanted & NH_EXPORT_SUBMANIFOLD) nh_export_submanifold(x, x->model);
    if (wanted & NH_EXPORT_CURRENTS) nh_export_currents(x, x->analysis);
    if (wanted & NH_EXPORT_REDUCED) {
        if (!reduce(x, q, error)) return false;
        if (x->reduction) nh_export_stages(x, x->reduction);
    }
    bool model = x->to && !strcmp(x->to, "js");
    if (x->functions || model) return true;
    return nh_fail(error, NH_NUMERIC, "", "there is nothing to export: %s", x->notes ? x->note[0] : "no part exists");
}

nh_export *nh_export_create(const nh_request *request, nh_error *error)
{
    nh_request bare = *request, *q = &bare; /* of its parts only the formulas are of use */
    bare.analysis_path = NULL, bare.accuracy = 0;
    nh_arena *arena = nh_arena_create();
    nh_export *x = nh_arena_alloc(arena, sizeof *x);
    unsigned wanted = 0;
    *x = (nh_export){.arena = arena, .command = q->line, .written = q->options.shown, .seed = q->options.seed};
    if (q->to) x->to = nh_arena_strdup(arena, q->to);
    if (q->name) x->name = nh_arena_strdup(arena, q->name);
    bool js = q->to && !strcmp(q->to, "js"); /* one model, of a motion with its currents */
    bool good = js && q->of ? nh_fail(error, NH_USAGE, "--of", "--to js writes one model: leave out --of")
                            : read_parts(x, js ? "currents" : q->of, &wanted, error);
    if (good) x->system = x->own = nh_system_read(q->system_path, q->settings, q->setting, error);
    good = good && x->own && nh_system_needs_values(x->own, "the code", error) && read_inputs(x, q->input, error) &&
           gather(x, q, wanted, error);
    if (good && nh_interrupted()) x->partial = true;
    if (good) return x;
    nh_export_free(x);
    return NULL;
}

nh_export *nh_export_of_reduction(const nh_reduction *reduction)
{
    nh_arena *arena = nh_arena_create();
    nh_export *x = nh_arena_alloc(arena, sizeof *x);
    *x =
        (nh_export){.arena = arena, .borrowed = true, .system = reduction->system, .written = reduction->options.shown};
    x->input = nh_arena_alloc(arena, (x->system->parameters + 1) * sizeof *x->input);
    x->reduction = (nh_reduction *)reduction;
    nh_export_stages(x, reduction);
    return x;
}

void nh_export_free(nh_export *x)
{
    if (!x) return;
    if (!x->borrowed) nh_reduction_free(x->reduction);
    nh_model_free(x->bare);
    nh_analysis_free(x->analysis);
    nh_system_free(x->own);
    nh_free(x->function);
    nh_arena_free(x->arena);
}
