#include "document/analysis.h"

#include <math.h>

#include "graph/declared.h"
#include <stdio.h>
#include <string.h>

#include "base/json.h"
#include "graph/print.h"
#include "integrals/real_where.h"
#include "document/typeset.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/geometry_sheet.h"
#include "document/analysis_internal.h"
#include "document/provenance.h"
#include "graph/node.h"

typedef struct {
    const nh_analysis *r;
    nh_dag *dag;
    size_t *left_out; /* formulas that are too long */
} writer;

/* NULL, and counted, when it is too long. */
static char *text_of(const writer *w, nh_ex e)
{
    char *text = nh_print_short(w->dag, nh_formula_shown(w->r, e), w->r->question->options.written);
    *w->left_out += !text;
    return text;
}

static void put_expression(const writer *w, nh_json *to, const char *key, nh_ex e)
{
    char *text = text_of(w, e);
    nh_json_put_text(to, key, text);
    nh_free(text);
}

static void put_expressions(const writer *w, nh_json *to, const char *key, size_t n, const nh_ex *e)
{
    nh_json *array = nh_json_put_array(to, key);
    for (size_t i = 0; i < n; i++) {
        char *text = text_of(w, e[i]);
        nh_json_add_text(array, text);
        nh_free(text);
    }
}

/* ---- the system ---- */

static void put_ranks(nh_json *to, const char *key, size_t n, const size_t *rank)
{
    nh_json *list = nh_json_put_array(to, key);
    for (size_t i = 0; i < n; i++) nh_json_add_number(list, (double)rank[i]);
}

/* Functions of (t, q) that the constraints alone keep constant. */
static void put_integrals(const writer *w, nh_json *to)
{
    const nh_analysis *result = w->r;
    nh_json *item = nh_json_put_object(to, "hidden_holonomic");
    nh_json_put_number(item, "count", (double)result->question->constraint.hidden);
    nh_json *functions = nh_json_put_array(item, "functions");
    for (size_t i = 0; i < result->integrals; i++) {
        const nh_current *f = &result->list->found[result->integral[i]];
        nh_json *line = nh_json_add_object(functions);
        nh_json_put_text(line, "current", f->name);
        put_expression(w, line, "expression", f->phi);
        nh_json_put_bool(line, "local", f->local);
    }
    nh_json_put_number(item, "without_closed_form", (double)(result->question->constraint.hidden - result->integrals));
}

static void put_branch(const writer *w, nh_json *to)
{
    const nh_analysis *result = w->r;
    nh_json *item = result->branch ? nh_json_put_object(to, "branch") : NULL;
    if (!item) {
        nh_json_put_null(to, "branch");
        return;
    }
    nh_json_put_text(item, "computed", result->branch);
    nh_json_put_text(item, "other", result->other_branch);
    nh_json_put_bool(item, "equations_on_both", result->equations_on_both);
}

static void put_constraint(const writer *w, nh_json *to)
{
    static const char *const spaces[] = {"positions", "time and positions", "submanifold"};
    const nh_distribution *d = &w->r->question->constraint;
    const nh_growth *g = &d->growth;
    nh_json *item = nh_json_put_object(to, "constraint");
    nh_json_put_text(item, "type", nh_constraint_type_name(d->type));
    nh_json_put_bool(item, "homogeneous", d->homogeneous);
    /* defined for linear and affine constraints only */
    if (d->type == NH_NONLINEAR) nh_json_put_null(item, "semiholonomic");
    else nh_json_put_bool(item, "semiholonomic", d->holonomic);
    nh_json_put_bool(item, "holonomic", d->holonomic);
    nh_json_put_bool(item, "rheonomic", d->rheonomic);
    nh_json_put_text(item, "integrability", nh_constraint_integrability(w->r->question->model, d));
    put_ranks(item, "growth_vector", g->length, g->rank);
    nh_json_put_text(item, "growth_space", g->length ? spaces[g->space] : "none");
    nh_json_put_bool(item, "growth_proved", g->proved);
    nh_json_put_bool(item, "growth_complete", !g->cut);
    if (g->drops) {
        nh_json *drop = nh_json_put_object(item, "growth_drops");
        nh_json_put_text(drop, "where", g->where ? nh_name_of(w->dag, g->where) : "origin");
        put_ranks(drop, "growth_vector", g->length_there, g->rank_there);
    }
    put_branch(w, item);
    put_integrals(w, item);
}

static void put_system(const writer *w, nh_json *to)
{
    const nh_analysis *result = w->r;
    nh_model *model = result->question->model;
    nh_json_put_number(to, "schema", 1);
    nh_json_put_text(to, "version", NH_VERSION);
    nh_json_put_text(to, "system", result->question->system->name);
    nh_json_put_text(to, "title", result->question->system->title);
    nh_json *parameters = nh_json_put_object(to, "parameters");
    for (size_t i = 0; i < result->question->system->parameters; i++)
        nh_json_put_number(parameters, result->question->system->parameter[i].name,
                           result->question->system->parameter[i].value);
    nh_json *dimension = nh_json_put_object(to, "dimension");
    nh_json_put_number(dimension, "coordinates", (double)model->m);
    nh_json_put_number(dimension, "constraints", (double)model->k);
    nh_json_put_number(dimension, "submanifold", (double)(1 + model->m + model->n));
    put_constraint(w, to);
}

static nh_json *add_chart(const writer *w, nh_json *charts, const nh_model *model)
{
    nh_json *item = nh_json_add_object(charts);
    nh_json_put_text(item, "name", model->chart->name);
    put_expression(w, item, "lagrangian", model->Lbar);
    put_expression(w, item, "energy", model->E);
    nh_json *equations = nh_json_put_array(item, "reduced_equations");
    for (size_t i = 0; i < model->n; i++) {
        nh_json *line = nh_json_add_object(equations);
        nh_json_put_text(line, "velocity", nh_name_of(model->dag, model->chart->w[i]));
        put_expression(w, line, "rate", model->a[i]);
    }
    nh_json *multipliers = nh_json_put_array(item, "multipliers");
    for (size_t a = 0; a < model->k; a++) {
        nh_json *line = nh_json_add_object(multipliers);
        nh_json_put_text(line, "constraint", model->system->constraint[a].text);
        put_expression(w, line, "expression", model->mu[a]);
    }
    put_expressions(w, item, "reaction", model->m, model->reaction);
    return item;
}

static void put_equations(const writer *w, nh_json *to)
{
    const nh_analysis *result = w->r;
    nh_json_put_text(to, "chart", result->question->model->chart->name);
    nh_json *charts = nh_json_put_array(to, "charts"), *own = add_chart(w, charts, result->question->model);
    nh_json_put_copy(to, "reduced_equations", nh_json_get(own, "reduced_equations"));
    nh_json_put_copy(to, "multipliers", nh_json_get(own, "multipliers"));
    if (result->question->other) add_chart(w, charts, result->question->other);
}

/* ---- the search ---- */

/* The functions of tables, and how well their slopes are known. */
static void put_tables(const nh_analysis *result, nh_json *to)
{
    const nh_dag *d = result->question->model->dag;
    nh_json *list = nh_json_put_array(to, "tables");
    const char *name;
    for (size_t f = 0; (name = nh_declared_function(d, f)); f++) {
        const nh_spline *table = nh_declared_table(d, f);
        if (!table) continue;
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "name", name);
        nh_json_put_number(item, "error", table->error);
    }
}

static const char *verdict_name(nh_verdict verdict)
{
    static const char *const names[] = {"FOUND", "NONE", "UNDECIDED", "FITTED"};
    return names[verdict];
}

static void put_spectrum(nh_json *to, const char *key, const nh_spectrum *s)
{
    if (!s->done) {
        nh_json_put_null(to, key);
        return;
    }
    nh_json *item = nh_json_put_object(to, key);
    nh_json_put_number(item, "columns", (double)s->columns);
    nh_json_put_number(item, "rank", (double)s->rank);
    nh_json_put_number(item, "rows", (double)s->rows);
    nh_json_put_numbers(item, "spectrum", s->rank, s->spectrum, 1);
    nh_json_put_number(item, "gap", s->gap);
    nh_json_put_number(item, "dimension", (double)s->dimension);
    nh_json_put_text(item, "verdict", verdict_name(s->verdict));
}

static void put_unknowns(const writer *w, nh_json *to)
{
    const nh_analysis *result = w->r;
    nh_json *item = nh_json_put_object(to, "unknowns");
    for (size_t j = 0; result->hits && j < result->hits->unknowns; j++) {
        nh_json *values = nh_json_put_array(item, nh_name_of(w->dag, result->question->analysis->unknown[j].symbol));
        for (size_t k = 0; k < result->specials; k++) {
            const nh_special *s = &result->special[k];
            nh_json *value = nh_json_add_object(values);
            nh_json_put_number(value, "value", s->value[j]);
            if (s->recognised[j]) put_expression(w, value, "recognised", s->recognised[j]);
            else nh_json_put_null(value, "recognised");
            nh_json_put_bool(value, "by_pencil", s->hit->by_pencil);
            nh_json_put_bool(value, "by_search", s->hit->by_search);
            nh_json_put_number(value, "difference", s->hit->difference);
            nh_json_put_number(value, "quotient", s->hit->quotient);
        }
    }
    if (!nh_analysis_by_trial(result)) {
        nh_json_put_null(to, "tried");
        return;
    }
    nh_json *tried = nh_json_put_object(to, "tried");
    nh_json_put_number(tried, "evaluations", (double)result->hits->evaluations);
    nh_json_put_number(tried, "parts", (double)result->hits->parts);
    nh_json_put_number(tried, "visited", (double)result->hits->visited);
}

static void put_search(const writer *w, nh_json *to)
{
    const nh_analysis *result = w->r;
    nh_json_put_text(to, "verdict", verdict_name(result->verdict));
    put_tables(result, to);
    nh_json_put_text(to, "search", nh_search_word(result->search));
    nh_json_put_text(to, "ansatz", result->ansatz_note);
    put_spectrum(to, "nullspace", &result->current);
    put_spectrum(to, "symmetry_route", &result->symmetry);
    if (result->routes_compared) {
        nh_json *routes = nh_json_put_object(to, "routes");
        nh_json_put_bool(routes, "agree", result->routes_agree);
        nh_json_put_number(routes, "angle", result->routes_angle);
    } else {
        nh_json_put_null(to, "routes");
    }
    if (result->counted_space.compared) {
        nh_json *space = nh_json_put_object(to, "counted_space");
        nh_json_put_bool(space, "agrees", result->counted_space.agrees);
        nh_json_put_number(space, "angle", result->counted_space.angle);
        nh_json_put_number(space, "degree", (double)result->counted_space.degree);
        nh_json_put_number(space, "products", (double)result->counted_space.products);
    } else {
        nh_json_put_null(to, "counted_space");
    }
    nh_analysis_json_samples(result, to);
    put_unknowns(w, to);
    nh_analysis_json_completeness(result, to);
    nh_analysis_json_absence(result, to);
    nh_analysis_json_stages(result, to);
}

/* ---- currents ---- */

static void put_field(const writer *w, nh_json *to, const nh_current *f)
{
    const nh_analysis *result = w->r;
    const nh_model *model = result->question->model,
                   *basis = result->question->other ? result->question->other : result->question->model;
    const nh_symmetry *z = &f->symmetry;
    nh_json *item = nh_json_put_object(to, "symmetry");
    put_expression(w, item, "Z0", z->Z0);
    put_expressions(w, item, "zeta", model->n, z->zeta);
    put_expressions(w, item, "W", model->n, z->W);
    nh_json *components = nh_json_put_object(item, "components");
    put_expression(w, components, "t", z->Z0);
    for (size_t s = 0; s < model->m; s++)
        put_expression(w, components, result->question->system->coordinate[s].name, z->field.space[s]);
    for (size_t i = 0; i < basis->n; i++) {
        nh_ex e = result->question->other ? 0 : z->W[i];
        for (size_t s = 0; s < model->m && result->question->other; s++)
            if (basis->chart->w[i] == result->question->system->coordinate[s].v) e = z->coordinate_rate[s];
        put_expression(w, components, nh_name_of(w->dag, basis->chart->w[i]), e);
    }
    nh_field_term *term;
    size_t terms = z->along_motion ? nh_formula_field(result, z, &term) : 0;
    nh_json *relative = terms ? nh_json_put_object(item, "components_with_gamma") : NULL;
    for (size_t i = 0; i < terms; i++)
        put_expression(w, relative, term[i].along ? term[i].along : "Gamma", term[i].coefficient);
    if (!relative) nh_json_put_null(item, "components_with_gamma");
    nh_json_put_number(item, "residual", z->noether_residual);
    nh_json *residuals = nh_json_put_object(item, "residuals");
    nh_json_put_number(residuals, "N0", z->off[0]);
    nh_json_put_number(residuals, "NX", z->off[1]);
    nh_json_put_number(residuals, "NY", z->off[2]);
    put_expressions(w, item, "i_bracket_phi", model->k, z->bracket_form);
}

static void put_drift(const writer *w, nh_json *to, const nh_current *f)
{
    if (!w->r->validation) {
        nh_json_put_null(to, "drift");
        nh_json_put_null(to, "drift_order_ok");
        return;
    }
    nh_json_put_number(to, "drift", f->drift.drift[NH_DRIFT_RUNS - 1]);
    if (isnan(f->drift.drift[NH_DRIFT_RUNS - 1])) nh_json_put_null(to, "drift_order_ok");
    else nh_json_put_bool(to, "drift_order_ok", f->drift.falls);
}

static void put_interval(nh_json *to, const writer *w, const nh_series *series)
{
    nh_json_put_text(to, "coordinate", nh_name_of(w->dag, series->variable));
    nh_json_put_number(to, "low", series->low);
    nh_json_put_number(to, "high", series->high);
}

/* `box`, `rate_bound` and `indices` once told of series in several variables: readers find them still. */
static void put_series(const writer *w, nh_json *to, const nh_series *series)
{
    if (!series) {
        nh_json_put_null(to, "series");
        return;
    }
    nh_json *item = nh_json_put_object(to, "series");
    put_interval(item, w, series);
    put_interval(nh_json_add_object(nh_json_put_array(item, "box")), w, series);
    nh_json_put_number(item, "degree", (double)series->degree);
    nh_json_put_null(item, "rate_bound");
    if (series->equation) nh_json_put_text(item, "equation", series->equation);
    else nh_json_put_null(item, "equation");
    nh_json *words = nh_json_put_array(item, "words");
    for (size_t i = 0; i < series->words; i++) {
        char *text = nh_print_string(w->dag, series->word[i]);
        nh_json_add_text(words, text);
        nh_free(text);
    }
    nh_json *table = nh_json_put_array(item, "coefficients");
    for (size_t i = 0; i < series->words; i++) {
        nh_json *row = nh_json_add_array(table);
        for (size_t k = 0; k <= series->degree; k++)
            nh_json_add_number(row, series->coefficient[i * series->stride + k]);
    }
    nh_json_put_null(item, "indices");
}

/* The formula in LaTeX; null when it is too long to be shown. */
static void put_latex(const writer *w, nh_json *to, nh_ex e)
{
    char *text = nh_print_short(w->dag, nh_formula_shown(w->r, e), w->r->question->options.shown);
    nh_text latex;
    nh_text_init(&latex);
    bool good = text && nh_typeset(text, NH_LATEX, &latex);
    nh_json_put_text(to, "latex", good ? nh_text_string(&latex) : NULL);
    nh_text_clear(&latex);
    nh_free(text);
}

/* The members of every integral, whether it is counted or not. */
static void put_briefly(const writer *w, nh_json *item, const nh_current *f)
{
    nh_json_put_text(item, "name", f->name);
    put_expression(w, item, "expression", f->phi);
    if (f->has_in_velocities) put_expression(w, item, "in_velocities", f->in_velocities);
    else nh_json_put_null(item, "in_velocities");
    put_latex(w, item, f->phi);
    nh_json_put_text(item, "meaning", f->meaning);
    nh_json_put_number(item, "heldout_residual", f->heldout);
    nh_json_put_number(item, "certified_digits", floor(f->proof.digits));
    nh_json_put_bool(item, "proved", f->proof.proved);
    nh_json_put_bool(item, "proved_for_all_parameters", f->proof.all_parameters);
    nh_facts_put_holds(item, w->r->question->model, &f->proof);
    nh_json_put_bool(item, "fitted", f->fitted);
    if (f->fitted && isfinite(f->fit_digits)) nh_json_put_number(item, "fit_digits", f->fit_digits);
}

static void put_current(const writer *w, nh_json *currents, const nh_current *f)
{
    nh_json *item = nh_json_add_object(currents);
    put_briefly(w, item, f);
    nh_json_put_number(item, "residual", f->quotient);
    if (w->r->question->model->chart->branch) nh_json_put_bool(item, "on_both_branches", f->on_both);
    else nh_json_put_null(item, "on_both_branches");
    nh_ex found[NH_MOST_REAL_WHERE];
    put_expressions(w, item, "real_where_positive", f->series ? 0 : nh_real_where(w->r->question->model, f->phi, found),
                    found);
    put_expressions(w, item, "nonzero", f->series ? 0 : nh_real_where_divisors(w->r->question->model, f->phi, found),
                    found);
    nh_json_put_bool(item, "exact", f->exact);
    nh_json_put_number(item, "printed_digits", floor(f->printed_digits));
    nh_json_put_bool(item, "independent", f->independence == NH_INDEPENDENT);
    nh_json_put_text(item, "independence_by",
                     f->rank.proved                        ? "proof"
                     : f->rank.answer != NH_RANK_UNDECIDED ? "digits"
                                                           : "doubles");
    nh_json_put_text(item, "relation", f->relation);
    nh_json_put_text(item, "known", f->known);
    nh_json_put_bool(item, "local", f->local);
    put_series(w, item, f->series);
    put_drift(w, item, f);
    if (!f->has_symmetry) {
        nh_json_put_null(item, "symmetry");
        return;
    }
    put_field(w, item, f);
    nh_json_put_bool(item, "bracket_in_distribution", f->symmetry.bracket_in_distribution);
    if (f->symmetry.kase) nh_json_put_number(item, "case", f->symmetry.kase);
    else nh_json_put_null(item, "case");
    nh_json_put_bool(item, "projectable", f->symmetry.projectable);
}

/* Currents of a part of the motions, and integrals that are functions of the currents. */
static void put_others(const writer *w, nh_json *root)
{
    nh_json *list = nh_json_put_array(root, "currents_in_regions");
    for (size_t k = 0; k < w->r->list->pieces; k++) {
        nh_json *item = nh_json_add_object(list);
        put_briefly(w, item, &w->r->list->piece[k]);
        nh_json_put_text(item, "region", w->r->list->piece[k].region);
    }
    list = nh_json_put_array(root, "further_integrals");
    for (size_t k = 0; k < w->r->list->furthers; k++) {
        const nh_further_integral *g = &w->r->list->further[k];
        nh_json *item = nh_json_add_object(list);
        put_briefly(w, item, &g->current);
        nh_json_put_number(item, "degree", (double)g->degree);
        nh_json_put_text(item, "region", g->current.region);
    }
    list = nh_json_put_array(root, "relations");
    for (size_t k = 0; k < w->r->relations; k++)
        nh_json_add_text(list,
                         nh_arena_printf(w->r->arena, "%s = %s", w->r->relation[k].left, w->r->relation[k].right));
}

static void put_almost(const writer *w, nh_json *root)
{
    nh_json *list = nh_json_put_array(root, "almost_conserved");
    for (size_t k = 0; k < w->r->almosts; k++) {
        const nh_near_current *a = &w->r->almost[k];
        nh_json *item = nh_json_add_object(list);
        put_expression(w, item, "expression", a->phi);
        put_expression(w, item, "in_velocities", a->in_velocities);
        nh_json_put_number(item, "digits", floor(a->digits));
        nh_json_put_number(item, "rate", a->rate);
    }
}

/* ---- the whole document ---- */

static void put_timing(const nh_timing *t, nh_json *to)
{
    nh_json *item = nh_json_put_object(to, "timing");
    nh_json_put_number(item, "total_s", t->total);
    nh_json_put_number(item, "read_s", t->read);
    nh_json_put_number(item, "geometry_s", t->geometry);
    nh_json_put_number(item, "unknowns_s", t->unknowns);
    nh_json_put_number(item, "nullspace_s", t->samples + t->nullspace);
    nh_json_put_number(item, "currents_s", t->currents);
    nh_json_put_number(item, "validation_s", t->validation);
}

char *nh_analysis_json(const nh_analysis *result)
{
    const nh_options *options = &result->question->options;
    const nh_current_list *list = result->list;
    size_t left_out = 0;
    writer w = {result, result->question->model->dag, &left_out};
    nh_json *root = nh_json_object();
    put_system(&w, root);
    put_equations(&w, root);
    nh_motion_sheet_json(result, root);
    nh_geometry_json(result->arena, result->theory, result->question->analysis, root, "equations");
    put_search(&w, root);
    nh_json *currents = nh_json_put_array(root, "currents");
    for (size_t k = 0; k < list->count; k++) put_current(&w, currents, &list->found[k]);
    put_others(&w, root);
    put_almost(&w, root);
    nh_analysis_json_stated(result, root);
    nh_json_put_number(root, "independent_currents", (double)list->independent);
    nh_json_put_number(root, "local_maximum", (double)result->question->local_maximum);
    nh_analysis_json_validation(result, root);
    nh_analysis_json_figures(result, root);
    nh_json_put_bool(root, "partial", result->partial);
    nh_run_json(&(nh_run){result->question->command, result->question->system_path, result->question->analysis_path,
                          options->seed, options->shown, result->timing.total, NULL},
                result->question->system, root);
    put_timing(&result->timing, root);
    nh_json *warnings = nh_json_put_array(root, "warnings");
    for (size_t i = 0; i < result->warnings; i++) nh_json_add_text(warnings, result->warning[i]);
    char note[200];
    snprintf(note, sizeof note, "%zu formula%s longer than %.0f symbols and null here (option `written`)", left_out,
             left_out == 1 ? " is" : "s are", options->written);
    if (left_out) nh_json_add_text(warnings, note);
    size_t holes = nh_analysis_json_holes(result);
    snprintf(note, sizeof note,
             "%zu values along the motion are not finite, as at a pole of the chart, or not real: null here", holes);
    if (holes) nh_json_add_text(warnings, note);
    return nh_json_finish(root);
}
