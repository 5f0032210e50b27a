#include "report/result_json.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expr/print.h"
#include "geometry/distribution.h"

typedef struct {
    const nh_result *r;
    nh_dag *dag;
} writer;

/* The shortest text that reads back as the same double (cJSON itself gives up the last digit); null when x is not finite. */
static cJSON *number(double x)
{
    char text[40];
    if (!isfinite(x)) return cJSON_CreateNull();
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, x);
        if (strtod(text, NULL) == x) break;
    }
    return cJSON_CreateRaw(text);
}

static void put_number(cJSON *to, const char *key, double x) { cJSON_AddItemToObject(to, key, number(x)); }

static cJSON *expression(const writer *w, nh_ex e)
{
    char *text = nh_print_string(w->dag, e);
    cJSON *item = cJSON_CreateString(text);
    nh_free(text);
    return item;
}

static void put_expression(const writer *w, cJSON *to, const char *key, nh_ex e) { cJSON_AddItemToObject(to, key, expression(w, e)); }

static cJSON *put_array(cJSON *to, const char *key)
{
    cJSON *array = cJSON_CreateArray();
    cJSON_AddItemToObject(to, key, array);
    return array;
}

static cJSON *put_object(cJSON *to, const char *key)
{
    cJSON *object = cJSON_CreateObject();
    cJSON_AddItemToObject(to, key, object);
    return object;
}

static void put_expressions(const writer *w, cJSON *to, const char *key, size_t n, const nh_ex *e)
{
    cJSON *array = put_array(to, key);
    for (size_t i = 0; i < n; i++) cJSON_AddItemToArray(array, expression(w, e[i]));
}

static void put_numbers(cJSON *to, const char *key, size_t n, const double *x, size_t stride)
{
    cJSON *array = put_array(to, key);
    for (size_t i = 0; i < n; i++) cJSON_AddItemToArray(array, number(x[i * stride]));
}

/* ---- the system ---- */

static void put_system(const writer *w, cJSON *to)
{
    const nh_result *r = w->r;
    cJSON_AddNumberToObject(to, "schema", 1);
    cJSON_AddStringToObject(to, "version", NH_VERSION);
    cJSON_AddStringToObject(to, "system", r->system->name);
    cJSON_AddStringToObject(to, "title", r->system->title);
    cJSON *parameters = put_object(to, "parameters");
    for (size_t i = 0; i < r->system->parameters; i++) put_number(parameters, r->system->parameter[i].name, r->system->parameter[i].value);
    cJSON *dimension = put_object(to, "dimension");
    cJSON_AddNumberToObject(dimension, "coordinates", (double)r->model->m);
    cJSON_AddNumberToObject(dimension, "constraints", (double)r->model->k);
    cJSON_AddNumberToObject(dimension, "submanifold", (double)(1 + r->model->m + r->model->n));
    nh_distribution d = nh_distribution_of(r->model);
    cJSON *constraint = put_object(to, "constraint");
    cJSON_AddStringToObject(constraint, "type", nh_constraint_type_name(d.type));
    cJSON_AddBoolToObject(constraint, "semiholonomic", d.semiholonomic);
    cJSON_AddBoolToObject(constraint, "holonomic", d.holonomic);
    cJSON_AddBoolToObject(constraint, "rheonomic", d.rheonomic);
    cJSON *growth = put_array(constraint, "growth_vector");
    for (size_t i = 0; i < d.growth_length; i++) cJSON_AddItemToArray(growth, cJSON_CreateNumber((double)d.growth[i]));
}

static cJSON *chart(const writer *w, const nh_model *o)
{
    cJSON *item = cJSON_CreateObject();
    cJSON_AddStringToObject(item, "name", o->chart->name);
    put_expression(w, item, "lagrangian", o->Lbar);
    put_expression(w, item, "energy", o->E);
    cJSON *equations = put_array(item, "reduced_equations");
    for (size_t i = 0; i < o->n; i++) {
        cJSON *line = cJSON_CreateObject();
        cJSON_AddStringToObject(line, "velocity", nh_name_of(o->dag, o->chart->w[i]));
        put_expression(w, line, "rate", o->a[i]);
        cJSON_AddItemToArray(equations, line);
    }
    cJSON *multipliers = put_array(item, "multipliers");
    for (size_t a = 0; a < o->k; a++) {
        cJSON *line = cJSON_CreateObject();
        cJSON_AddStringToObject(line, "constraint", o->system->constraint[a].text);
        put_expression(w, line, "expression", o->mu[a]);
        cJSON_AddItemToArray(multipliers, line);
    }
    put_expressions(w, item, "reaction", o->m, o->reaction);
    return item;
}

static void put_equations(const writer *w, cJSON *to)
{
    const nh_result *r = w->r;
    cJSON *own = chart(w, r->model);
    cJSON_AddStringToObject(to, "chart", r->model->chart->name);
    cJSON_AddItemToObject(to, "reduced_equations", cJSON_Duplicate(cJSON_GetObjectItem(own, "reduced_equations"), 1));
    cJSON_AddItemToObject(to, "multipliers", cJSON_Duplicate(cJSON_GetObjectItem(own, "multipliers"), 1));
    cJSON *charts = put_array(to, "charts");
    cJSON_AddItemToArray(charts, own);
    if (r->other) cJSON_AddItemToArray(charts, chart(w, r->other));
}

/* ---- the search ---- */

static const char *verdict_name(nh_verdict verdict)
{
    static const char *const names[] = {"FOUND", "NONE", "UNDECIDED"};
    return names[verdict];
}

static void put_spectrum(cJSON *to, const char *key, const nh_spectrum *s)
{
    if (!s->done) {
        cJSON_AddNullToObject(to, key);
        return;
    }
    cJSON *item = put_object(to, key);
    cJSON_AddNumberToObject(item, "columns", (double)s->columns);
    cJSON_AddNumberToObject(item, "rank", (double)s->rank);
    cJSON_AddNumberToObject(item, "rows", (double)s->rows);
    put_numbers(item, "spectrum", s->rank, s->spectrum, 1);
    put_number(item, "gap", s->gap);
    cJSON_AddNumberToObject(item, "dimension", (double)s->dimension);
    cJSON_AddStringToObject(item, "verdict", verdict_name(s->verdict));
}

static void put_unknowns(const writer *w, cJSON *to)
{
    const nh_result *r = w->r;
    cJSON *item = put_object(to, "unknowns");
    for (size_t j = 0; r->hits && j < r->hits->unknowns; j++) {
        cJSON *values = put_array(item, nh_name_of(w->dag, r->analysis->unknown[j].symbol));
        for (size_t k = 0; k < r->specials; k++) {
            const nh_special *s = &r->special[k];
            cJSON *value = cJSON_CreateObject();
            put_number(value, "value", s->value[j]);
            if (s->recognised[j]) put_expression(w, value, "recognised", s->recognised[j]);
            else cJSON_AddNullToObject(value, "recognised");
            cJSON_AddBoolToObject(value, "by_pencil", s->hit->by_pencil);
            cJSON_AddBoolToObject(value, "by_search", s->hit->by_search);
            put_number(value, "difference", s->hit->difference);
            put_number(value, "quotient", s->hit->quotient);
            cJSON_AddItemToArray(values, value);
        }
    }
}

static void put_search(const writer *w, cJSON *to)
{
    const nh_result *r = w->r;
    cJSON_AddStringToObject(to, "verdict", verdict_name(r->verdict));
    cJSON_AddStringToObject(to, "ansatz", r->ansatz_note);
    put_spectrum(to, "nullspace", &r->current);
    put_spectrum(to, "symmetry_route", &r->symmetry);
    if (r->routes_compared) {
        cJSON *routes = put_object(to, "routes");
        cJSON_AddBoolToObject(routes, "agree", r->routes_agree);
        put_number(routes, "angle", r->routes_angle);
    } else {
        cJSON_AddNullToObject(to, "routes");
    }
    cJSON *samples = put_object(to, "samples");
    cJSON_AddNumberToObject(samples, "used", (double)r->samples);
    cJSON_AddNumberToObject(samples, "rejected", (double)r->rejected);
    put_number(samples, "seed", r->options.seed);
    put_unknowns(w, to);
}

/* ---- currents ---- */

static void put_field(const writer *w, cJSON *to, const nh_found *f)
{
    const nh_result *r = w->r;
    const nh_model *o = r->model, *basis = r->other ? r->other : r->model;
    const nh_symmetry *z = &f->symmetry;
    cJSON *item = put_object(to, "symmetry");
    put_expression(w, item, "Z0", z->Z0);
    put_expressions(w, item, "zeta", o->n, z->zeta);
    put_expressions(w, item, "W", o->n, z->W);
    cJSON *components = put_object(item, "components");
    put_expression(w, components, "t", z->Z0);
    for (size_t s = 0; s < o->m; s++) put_expression(w, components, r->system->coordinate[s].name, z->field.space[s]);
    for (size_t i = 0; i < basis->n; i++) {
        nh_ex e = r->other ? 0 : z->W[i];
        for (size_t s = 0; s < o->m && r->other; s++)
            if (basis->chart->w[i] == r->system->coordinate[s].v) e = z->coordinate_rate[s];
        put_expression(w, components, nh_name_of(w->dag, basis->chart->w[i]), e);
    }
    put_number(item, "residual", z->noether_residual);
    put_expressions(w, item, "i_bracket_phi", o->k, z->bracket_form);
}

static void put_drift(const writer *w, cJSON *to, const nh_found *f)
{
    if (!w->r->validation) {
        cJSON_AddNullToObject(to, "drift");
        cJSON_AddNullToObject(to, "drift_order_ok");
        return;
    }
    put_number(to, "drift", f->drift.drift[NH_DRIFT_RUNS - 1]);
    cJSON_AddBoolToObject(to, "drift_order_ok", f->drift.falls);
}

static cJSON *current(const writer *w, const nh_found *f)
{
    cJSON *item = cJSON_CreateObject();
    cJSON_AddStringToObject(item, "name", f->name);
    put_expression(w, item, "expression", f->phi);
    if (f->has_in_velocities) put_expression(w, item, "in_velocities", f->in_velocities);
    else cJSON_AddNullToObject(item, "in_velocities");
    cJSON_AddStringToObject(item, "meaning", f->meaning);
    put_number(item, "residual", f->quotient);
    put_number(item, "heldout_residual", f->heldout);
    put_number(item, "certified_digits", floor(f->proof.digits));
    cJSON_AddBoolToObject(item, "proved", f->proof.proved);
    cJSON_AddBoolToObject(item, "proved_for_all_parameters", f->proof.all_parameters);
    cJSON_AddBoolToObject(item, "exact", f->exact);
    cJSON_AddBoolToObject(item, "independent", f->independence == NH_INDEPENDENT);
    if (f->relation) cJSON_AddStringToObject(item, "relation", f->relation);
    else cJSON_AddNullToObject(item, "relation");
    cJSON_AddBoolToObject(item, "local", f->local);
    put_drift(w, item, f);
    if (!f->has_symmetry) {
        cJSON_AddNullToObject(item, "symmetry");
        return item;
    }
    put_field(w, item, f);
    cJSON_AddBoolToObject(item, "bracket_in_distribution", f->symmetry.bracket_in_distribution);
    if (f->symmetry.kase) cJSON_AddNumberToObject(item, "case", f->symmetry.kase);
    else cJSON_AddNullToObject(item, "case");
    cJSON_AddBoolToObject(item, "projectable", f->symmetry.projectable);
    return item;
}

/* ---- the motion ---- */

static void put_validation(const writer *w, cJSON *to)
{
    const nh_validation *v = w->r->validation;
    if (!v) {
        cJSON_AddNullToObject(to, "validation");
        return;
    }
    cJSON *item = put_object(to, "validation");
    cJSON_AddStringToObject(item, "method", v->method);
    cJSON_AddStringToObject(item, "chart", v->chart);
    put_number(item, "begin", v->begin);
    put_number(item, "end", v->end);
    cJSON_AddBoolToObject(item, "complete", v->complete);
    cJSON_AddNumberToObject(item, "evaluations", (double)v->evaluations);
    put_numbers(item, "tolerances", NH_DRIFT_RUNS, v->tolerance, 1);
    cJSON *drift = put_object(item, "drift");
    for (size_t k = 0; k < v->currents; k++) put_numbers(drift, w->r->found[k].name, NH_DRIFT_RUNS, v->current[k].drift, 1);
    if (v->multiplier_form) {
        cJSON *full = put_object(item, "multiplier_form");
        cJSON_AddStringToObject(full, "method", v->multiplier_method);
        put_number(full, "state_difference", v->state_difference);
        put_number(full, "multiplier_difference", v->multiplier_difference);
        put_number(full, "constraint_violation", v->violation);
    } else {
        cJSON_AddNullToObject(item, "multiplier_form");
    }
    if (v->crossing_chart) {
        cJSON *crossing = put_object(item, "chart_crossing");
        cJSON_AddStringToObject(crossing, "chart", v->crossing_chart);
        put_number(crossing, "time", v->crossing);
    }
    cJSON *watch = put_object(item, "watch");
    if (v->watches) put_numbers(watch, "t", v->count, v->time, 1);
    for (size_t j = 0; j < v->watches; j++) put_numbers(watch, v->watch_name[j], v->count, v->watch + j, v->watches);
}

static void put_timing(const nh_timing *t, cJSON *to)
{
    cJSON *item = put_object(to, "timing");
    put_number(item, "total_s", t->total);
    put_number(item, "read_s", t->read);
    put_number(item, "geometry_s", t->geometry);
    put_number(item, "unknowns_s", t->unknowns);
    put_number(item, "nullspace_s", t->samples + t->nullspace);
    put_number(item, "currents_s", t->currents);
    put_number(item, "validation_s", t->validation);
}

char *nh_result_json(const nh_result *r)
{
    writer w = {r, r->model->dag};
    cJSON *root = cJSON_CreateObject();
    put_system(&w, root);
    put_equations(&w, root);
    put_search(&w, root);
    cJSON *currents = put_array(root, "currents");
    for (size_t k = 0; k < r->count; k++) cJSON_AddItemToArray(currents, current(&w, &r->found[k]));
    cJSON_AddNumberToObject(root, "independent_currents", (double)r->independent);
    cJSON_AddNumberToObject(root, "local_maximum", (double)r->local_maximum);
    put_validation(&w, root);
    cJSON_AddBoolToObject(root, "partial", r->partial);
    put_timing(&r->timing, root);
    cJSON *warnings = put_array(root, "warnings");
    for (size_t i = 0; i < r->warnings; i++) cJSON_AddItemToArray(warnings, cJSON_CreateString(r->warning[i]));
    char *printed = cJSON_Print(root);
    cJSON_Delete(root);
    size_t length = strlen(printed);
    char *out = nh_alloc(length + 2);
    memcpy(out, printed, length);
    out[length] = '\n';
    free(printed);
    return out;
}
