/* library_results: access to results, number by number. */
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "commands/simulate.h"
#include "document/svg.h"
#include "document/typeset.h"
#include "evaluate/tape.h"
#include "geometry/bordered.h"
#include "graph/print.h"
#include "library/library_internal.h"
#include "search/analysis.h"

/* ---- an analysis ---- */

const char *nh_analysis_verdict(const nh_analysis *a)
{
    return a->verdict == NH_FOUND    ? "FOUND"
           : a->verdict == NH_FITTED ? "FITTED"
           : a->verdict == NH_NONE   ? "NONE"
                                     : "UNDECIDED";
}

const char *nh_analysis_search(const nh_analysis *a) { return nh_search_word(a->search); }

size_t nh_analysis_currents(const nh_analysis *a) { return a->list->count; }

size_t nh_analysis_independent(const nh_analysis *a) { return a->list->independent; }

size_t nh_analysis_most(const nh_analysis *a) { return a->question->local_maximum; }

nh_current_facts nh_current_describe(const nh_analysis *a, size_t index)
{
    if (index >= a->list->count) return (nh_current_facts){.name = "", .meaning = "", .digits = NAN, .drift = NAN};
    const nh_current *c = &a->list->found[index];
    bool followed = a->validation != NULL;
    return (nh_current_facts){.name = c->name,
                              .meaning = c->meaning,
                              .proved = c->proof.proved,
                              .for_all = c->proof.all_parameters,
                              .independent = c->independence == NH_INDEPENDENT,
                              .digits = c->proof.digits,
                              .drift = followed ? c->drift.drift[NH_DRIFT_RUNS - 1] : NAN};
}

/* In velocities where that is possible, else in the chart. */
static nh_ex shown_form(const nh_current *c) { return c->has_in_velocities ? c->in_velocities : c->phi; }

typedef struct {
    const nh_analysis *analysis;
    size_t index;
    const char *formula;
    nh_syntax syntax;
    char *out;
} setting;

static char *typeset(const char *formula, nh_syntax syntax)
{
    if (syntax == NH_SYNTAX_PLAIN) return nh_strdup(formula);
    nh_text text;
    nh_text_init(&text);
    bool good = nh_typeset(formula, syntax == NH_SYNTAX_LATEX ? NH_LATEX : NH_MATHML, &text);
    char *out = good ? nh_strdup(nh_text_string(&text)) : NULL;
    nh_text_clear(&text);
    return out;
}

static void typeset_formula(void *argument)
{
    setting *s = argument;
    s->out = typeset(s->formula, s->syntax);
}

char *nh_formula_typeset(const char *formula, nh_syntax syntax)
{
    setting s = {.formula = formula, .syntax = syntax};
    return nh_library_run(typeset_formula, &s) ? s.out : NULL;
}

static void typeset_current(void *argument)
{
    setting *s = argument;
    const nh_analysis *a = s->analysis;
    s->out =
        nh_print_short(a->question->model->dag, shown_form(&a->list->found[s->index]), a->question->options.written);
    if (!s->out || s->syntax == NH_SYNTAX_PLAIN) return;
    char *plain = s->out;
    s->out = typeset(plain, s->syntax);
    nh_free(plain);
}

char *nh_current_formula(const nh_analysis *a, size_t index, nh_syntax syntax)
{
    setting s = {.analysis = a, .index = index, .syntax = syntax};
    return index < a->list->count && nh_library_run(typeset_current, &s) ? s.out : NULL;
}

/* Of t, positions and velocities; NULL where the current cannot be written in velocities. */
static nh_tape *tape_of(const nh_analysis *a, size_t index)
{
    nh_model *model = a->question->model;
    const nh_current_list *list = a->list;
    if (index >= list->count || !list->found[index].has_in_velocities) return NULL;
    const nh_system *system = a->question->system;
    size_t m = system->coordinates;
    nh_ex form = list->found[index].in_velocities, *in = nh_alloc_array(2 * m + 1, sizeof *in);
    in[0] = system->t;
    for (size_t i = 0; i < m; i++) {
        in[1 + i] = system->coordinate[i].q;
        in[1 + m + i] = system->coordinate[i].v;
    }
    nh_tape *tape = nh_tape_create(model->dag, 2 * m + 1, in, 1, &form, system->parameters, model->parameter,
                                   model->parameter_value);
    nh_free(in);
    return tape;
}

typedef struct {
    const nh_analysis *analysis;
    size_t index, count;
    const double *t, *q, *v;
    double *out;
    bool good;
} evaluation;

static void evaluate(void *argument)
{
    evaluation *e = argument;
    nh_tape *tape = tape_of(e->analysis, e->index);
    if (!tape) return;
    nh_columns columns;
    nh_columns_open(&columns, e->analysis->question->system->coordinates, e->count, e->t, e->q, e->v);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t from = 0, n; (n = nh_columns_next(&columns, from)) > 0; from += n) {
        double *to = e->out + from;
        nh_tape_eval_batch(tape, work, n, columns.in, &to);
        for (size_t j = 0; j < n; j++) to[j] = isfinite(to[j]) ? to[j] : NAN;
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_columns_close(&columns);
    e->good = true;
}

double nh_current_value(const nh_analysis *a, size_t index, double t, const double *q, const double *v)
{
    double out;
    return nh_current_values(a, index, 1, &t, q, v, &out) ? out : NAN;
}

bool nh_current_values(const nh_analysis *a, size_t index, size_t count, const double *t, const double *q,
                       const double *v, double *out)
{
    evaluation e = {.analysis = a, .index = index, .count = count, .t = t, .q = q, .v = v, .out = out};
    return nh_library_run(evaluate, &e) && e.good;
}

/* ---- a simulation ---- */

static size_t drawn_from(const nh_simulation *s)
{
    size_t k = 0;
    while (k < s->columns.count && s->columns.track[k].kind != NH_TRACK_SHAPE) k++;
    return k;
}

size_t nh_simulation_rows(const nh_simulation *s) { return s->motion->count; }

size_t nh_simulation_columns(const nh_simulation *s) { return 1 + drawn_from(s); }

const char *nh_simulation_column(const nh_simulation *s, size_t column)
{
    return column == 0 ? "t" : column < nh_simulation_columns(s) ? s->columns.track[column - 1].name : NULL;
}

double nh_simulation_value(const nh_simulation *s, size_t row, size_t column)
{
    if (row >= s->motion->count || column >= nh_simulation_columns(s)) return NAN;
    return column == 0 ? s->motion->time[row] : s->value[row * s->columns.count + column - 1];
}

void nh_simulation_read(const nh_simulation *s, size_t column, double *out)
{
    for (size_t row = 0; row < s->motion->count; row++) out[row] = nh_simulation_value(s, row, column);
}

typedef struct {
    const nh_simulation *simulation;
    size_t x, y;
    char *out;
} picture;

static void draw(void *argument)
{
    picture *p = argument;
    const nh_simulation *s = p->simulation;
    size_t rows = s->motion->count, x = p->x, y = p->y;
    double *value = nh_alloc_array(2 * rows, sizeof *value);
    nh_simulation_read(s, x, value);
    nh_simulation_read(s, y, value + rows);
    const char *across = nh_simulation_column(s, x), *up = nh_simulation_column(s, y);
    nh_curve curve = {.name = up, .count = rows, .x = value, .y = value + rows, .x_stride = 1, .y_stride = 1};
    nh_plot plot = {.id = "plot",
                    .title = up,
                    .x_label = across,
                    .y_label = up,
                    .equal = x > 0 && y > 0 && nh_simulation_is_path(s, x - 1, y - 1),
                    .timed = x == 0,
                    .path = x > 0,
                    .curves = 1,
                    .curve = &curve};
    nh_text text, words;
    nh_text_init(&text);
    nh_text_init(&words);
    nh_text_addf(&words, "%s against %s", up, across);
    plot.description = nh_text_string(&words);
    nh_svg_plot(&plot, &text);
    p->out = nh_strdup(nh_text_string(&text));
    nh_text_clear(&text);
    nh_text_clear(&words);
    nh_free(value);
}

char *nh_simulation_svg(const nh_simulation *s, size_t x, size_t y)
{
    picture p = {.simulation = s, .x = x, .y = y};
    size_t columns = nh_simulation_columns(s);
    return x < columns && y < columns && nh_library_run(draw, &p) ? p.out : NULL;
}

/* ---- arrays of a caller as batches ---- */

void nh_columns_open(nh_columns *c, size_t m, size_t count, const double *t, const double *q, const double *v)
{
    *c = (nh_columns){.inputs = 1 + 2 * m, .count = count, .t = t, .q = q, .v = v};
    c->in = nh_alloc_array(c->inputs, sizeof *c->in);
}

size_t nh_columns_next(nh_columns *c, size_t from)
{
    size_t m = (c->inputs - 1) / 2, left = c->count - from;
    c->in[0] = c->t ? c->t + from : c->zero;
    for (size_t i = 0; i < m; i++) {
        c->in[1 + i] = c->q + i * c->count + from;
        c->in[1 + m + i] = c->v + i * c->count + from;
    }
    return left < NH_BATCH ? left : NH_BATCH;
}

void nh_columns_close(nh_columns *c) { nh_free(c->in); }

/* ---- the equations of motion, in all coordinates ---- */

struct nh_rates {
    nh_model *model;
    nh_bordered *bordered;
    nh_system *system; /* its own: it remains without the problem */
};

typedef struct {
    const nh_request *request;
    nh_error *error;
    nh_rates *rates;
    bool good;
} writing;

static bool write_equations(const nh_request *q, nh_rates *e, nh_error *error)
{
    e->system = nh_system_read(q->system_path, q->settings, q->setting, error);
    bool numbers = e->system && nh_system_needs_values(e->system, "the code", error);
    nh_chart *chart = numbers ? nh_chart_create(e->system, q->chart, (uint64_t)q->options.seed, error) : NULL;
    e->model = chart ? nh_model_bare(e->system, chart) : NULL;
    if (!e->model || !nh_model_regular(e->model, error)) return false;
    e->bordered = nh_bordered_create(e->model);
    return true;
}

static void create(void *argument)
{
    writing *w = argument;
    nh_rates *e = nh_alloc(sizeof *e);
    *e = (nh_rates){0};
    w->good = write_equations(w->request, e, w->error);
    w->rates = e;
}

nh_rates *nh_rates_create(nh_problem *p, nh_error *error)
{
    NH_OWN_ERROR(error);
    writing w = {.request = &p->request, .error = error};
    if (nh_problem_run(p, create, &w, error) && w.good) return w.rates;
    nh_rates_free(w.rates);
    return NULL;
}

void nh_rates_free(nh_rates *e)
{
    if (!e) return;
    nh_bordered_free(e->bordered);
    nh_model_free(e->model);
    nh_system_free(e->system);
    nh_free(e);
}

typedef struct {
    const nh_rates *rates;
    size_t count;
    const double *t, *q, *v;
    double *out;
} rates_evaluation;

static void evaluate_rates(void *argument)
{
    const rates_evaluation *r = argument;
    nh_bordered *bordered = r->rates->bordered;
    nh_columns columns;
    nh_columns_open(&columns, nh_bordered_coordinates(bordered), r->count, r->t, r->q, r->v);
    for (size_t from = 0, n; (n = nh_columns_next(&columns, from)) > 0; from += n)
        nh_bordered_accelerations_batch(bordered, n, columns.in, r->count, r->out + from);
    nh_columns_close(&columns);
}

void nh_rates_at(nh_rates *e, size_t count, const double *t, const double *q, const double *v, double *out)
{
    rates_evaluation r = {e, count, t, q, v, out};
    if (nh_library_run(evaluate_rates, &r)) return;
    size_t values = nh_bordered_coordinates(e->bordered) * count;
    for (size_t i = 0; i < values; i++) out[i] = NAN;
}
