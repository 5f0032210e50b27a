#include <math.h>
#include <stdio.h>

#include "document/analysis_internal.h"
#include "document/simulation.h"
#include "document/time_series.h"
#include "graph/node.h"

/* ---- the motion ---- */

static void put_motion(const nh_analysis *result, nh_json *to)
{
    const nh_validation *v = result->validation;
    nh_json *motion = nh_json_put_object(to, "motion");
    nh_time_series *c = nh_time_series_of_analysis(result);
    nh_json_put_numbers(motion, "time", v->count, v->time, 1);
    nh_time_series_json(c, motion, "states", NH_TRACK_STATE);
    nh_time_series_json(c, motion, "energies", NH_TRACK_ENERGY);
    nh_time_series_json(c, motion, "currents", NH_TRACK_CURRENT);
    nh_time_series_json(c, motion, "multipliers", NH_TRACK_MULTIPLIER);
    nh_time_series_json_drawing(c, motion);
    nh_json *watch = nh_time_series_json(c, to, "watch", NH_TRACK_WATCH);
    if (result->question->analysis && result->question->analysis->watches)
        nh_json_put_numbers(watch, "t", v->count, v->time, 1);
    nh_time_series_free(c);
}

void nh_analysis_json_validation(const nh_analysis *result, nh_json *to)
{
    const nh_validation *v = result->validation;
    if (!v) {
        nh_json_put_null(to, "validation");
        return;
    }
    nh_json *item = nh_json_put_object(to, "validation");
    nh_json_put_text(item, "method", v->method);
    nh_json_put_text(item, "chart", v->chart);
    nh_json_put_number(item, "begin", v->begin);
    nh_json_put_number(item, "end", v->end);
    nh_json_put_bool(item, "complete", v->complete);
    nh_json_put_number(item, "evaluations", (double)v->evaluations);
    nh_json_put_numbers(item, "tolerances", NH_DRIFT_RUNS, v->tolerance, 1);
    nh_accuracy_json(v->checked ? &v->accuracy : NULL, item);
    nh_json *drift = nh_json_put_object(item, "drift");
    for (size_t k = 0; k < v->currents; k++)
        nh_json_put_numbers(drift, result->list->found[k].name, NH_DRIFT_RUNS, v->current[k].drift, 1);
    if (v->multiplier_form) {
        nh_json *full = nh_json_put_object(item, "multiplier_form");
        nh_json_put_text(full, "method", v->multiplier_method);
        nh_json_put_number(full, "state_difference", v->state_difference);
        nh_json_put_number(full, "multiplier_difference", v->multiplier_difference);
        nh_json_put_number(full, "constraint_violation", v->violation);
    } else {
        nh_json_put_null(item, "multiplier_form");
    }
    if (v->multistep) {
        nh_json *other = nh_json_put_object(item, "multistep");
        nh_json_put_text(other, "method", "CVODE Adams");
        nh_json_put_number(other, "state_difference", v->multistep_difference);
    } else {
        nh_json_put_null(item, "multistep");
    }
    if (v->crossing_chart) {
        nh_json *crossing = nh_json_put_object(item, "chart_crossing");
        nh_json_put_text(crossing, "chart", v->crossing_chart);
        nh_json_put_number(crossing, "time", v->crossing);
    }
    put_motion(result, item);
    if (v->scene) {
        nh_json *scene = nh_json_put_object(item, "scene");
        nh_json_put_text(scene, "model", v->scene);
        nh_json_put_number(scene, "difference", v->scene_difference);
        nh_json_put_number(scene, "evaluations", (double)v->scene_evaluations);
    }
}

void nh_analysis_json_stated(const nh_analysis *result, nh_json *to)
{
    nh_model *model = result->question->model;
    nh_json *list = nh_json_put_array(to, "stated");
    for (size_t i = 0; i < result->stateds; i++) {
        const nh_stated *s = &result->stated[i];
        bool holds = s->verdict != NH_STATED_FALSE && s->verdict != NH_STATED_OPEN;
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "name", s->name);
        nh_json_put_text(item, "expression", s->text);
        nh_json_put_text(item, "as", s->denied ? "not conserved" : "current");
        nh_json_put_text(item, "verdict", nh_analysis_stated_word(s->verdict));
        nh_json_put_bool(item, "proved", s->proved);
        if (holds) nh_json_put_number(item, "digits", floor(s->digits));
        else nh_json_put_null(item, "digits");
        nh_json_put_text(item, "relation", s->relation);
        nh_json_put_text(item, "region", s->region);
        nh_json_put_text(item, "obstacle", s->obstacle);
        if (!s->state) {
            nh_json_put_null(item, "state");
            nh_json_put_null(item, "rate");
            continue;
        }
        nh_json *state = nh_json_put_object(item, "state");
        for (size_t j = 0; j < model->width; j++)
            nh_json_put_number(state, nh_name_of(model->dag, model->chart->symbol[j]), s->state[j]);
        nh_json_put_number(item, "rate", s->rate);
    }
}

void nh_analysis_json_figures(const nh_analysis *result, nh_json *to)
{
    static const char *const kinds[] = {"path", "plot", "scan", "samples", "residual"};
    nh_json *list = nh_json_put_array(to, "figures");
    for (size_t i = 0; i < result->figures; i++) {
        const nh_figure *f = &result->figure[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "title", f->request->title);
        nh_json_put_text(item, "kind", kinds[f->request->kind]);
        nh_json_put_text(item, "parameter", f->request->vary);
        nh_json *curves = nh_json_put_array(item, "curves");
        for (size_t k = 0; k < f->curves; k++) {
            const nh_figure_curve *c = &f->curve[k];
            nh_json *curve = nh_json_add_object(curves);
            nh_json_put_text(curve, "name", c->name);
            nh_json_put_number(curve, "value", c->value);
            nh_json_put_numbers(curve, "x", c->count, c->x, 1);
            nh_json_put_numbers(curve, "y", c->count, c->y, 1);
            if (c->heading) nh_json_put_numbers(curve, "heading", c->count, c->heading, 1);
        }
    }
}

size_t nh_analysis_json_holes(const nh_analysis *result)
{
    const nh_current_list *list = result->list;
    const nh_validation *v = result->validation;
    size_t holes = 0, k = result->question->model->k;
    for (size_t j = 0; v && j < v->watches; j++) {
        bool series = false; /* is it a series?  Its values end with its interval */
        for (size_t c = 0; c < list->count; c++)
            series |= list->found[c].series && result->tracks.track[j].value == list->found[c].phi;
        for (size_t i = 0; i < v->count && !series; i++) holes += !isfinite(v->watch[i * v->watches + j]);
    }
    for (size_t i = 0; v && i < v->count * k; i++) holes += !isfinite(v->multiplier[i]);
    return holes;
}

/* ---- the stages of the search ---- */

void nh_analysis_json_stages(const nh_analysis *result, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "stages");
    for (size_t i = 0; i < result->stages; i++) {
        const nh_stage_record *s = &result->stage[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "name", s->name);
        nh_json_put_bool(item, "too_large", s->skipped);
        if (s->skipped) nh_json_put_text(item, "brought_in_by", nh_limit_words(result->arena, &s->limit));
        nh_json_put_number(item, "columns", (double)s->columns);
        nh_json_put_number(item, "sectors", (double)s->sectors);
        nh_json_put_number(item, "dimension", (double)s->dimension);
        nh_json_put_number(item, "found", (double)s->found);
        nh_json_put_bool(item, "undecided", s->undecided);
    }
}

/* ---- how many integrals there are, and which stages were tried ---- */

static void put_new(nh_json *to, const nh_completeness *c)
{
    nh_json *fresh = nh_json_put_object(to, "new");
    char degree[16];
    for (size_t d = 0; d < c->count.rows; d++) {
        const nh_count_row *row = &c->count.row[d];
        snprintf(degree, sizeof degree, "%zu", row->degree);
        if (row->complete && row->bound > row->lower)
            nh_json_put_number(fresh, degree, (double)(row->bound - row->lower));
    }
}

static void put_degrees(nh_json *to, const nh_completeness *c)
{
    nh_json *list = nh_json_put_array(to, "degrees");
    for (size_t d = 0; d < c->count.rows; d++) {
        const nh_count_row *row = &c->count.row[d];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "degree", (double)row->degree);
        nh_json_put_number(item, "dimension", (double)row->bound);
        nh_json_put_number(item, "found", (double)row->known);
        nh_json_put_number(item, "rank", (double)row->rank);
        nh_json_put_number(item, "found_rank", (double)row->known_rank);
        nh_json_put_number(item, "order", (double)row->order);
        nh_json_put_bool(item, "stable", row->settled);
    }
}

static nh_json *put_count(nh_json *to, const char *key, const nh_completeness *c)
{
    if (!c->counted) {
        nh_json_put_null(to, key);
        return NULL;
    }
    nh_json *item = nh_json_put_object(to, key);
    const nh_count_row *row = c->count.rows ? &c->count.row[c->degree ? c->degree - 1 : 0] : NULL;
    nh_json_put_number(item, "degree", (double)c->degree);
    nh_json_put_text(item, "coefficients", c->count.time ? "t and coordinates" : "all coordinates");
    nh_json_put_text(item, "obstacle", c->count.obstacle);
    if (row) nh_json_put_number(item, "dimension", (double)row->bound);
    else nh_json_put_null(item, "dimension");
    if (row) nh_json_put_number(item, "found", (double)row->known);
    else nh_json_put_null(item, "found");
    put_new(item, c);
    if (row) nh_json_put_number(item, "order", (double)row->order);
    else nh_json_put_null(item, "order");
    nh_json_put_bool(item, "stable", row && (row->settled || row->complete));
    nh_json_put_number(item, "prime", (double)c->count.prime);
    nh_json_put_text(item, "of",
                     !c->degree  ? NULL
                     : c->linear ? "polynomials in the currents"
                                 : "functions of the currents");
    nh_json_put_text(item, "where", c->count.where);
    nh_json_put_bool(item, "regional", c->regional);
    nh_json_put_text(item, "proved",
                     !c->degree || !c->linear ? NULL
                     : c->generic             ? "for generic parameters"
                                              : "for these values");
    nh_json_put_number(item, "step", (double)c->count.step);
    nh_json_put_number(item, "leaf", (double)c->count.leaf);
    nh_json *without = nh_json_put_array(item, "without");
    for (size_t i = 0; i < c->count.without; i++) nh_json_add_text(without, c->count.without_name[i]);
    if (c->missing_at) nh_json_put_number(item, "missing_at", (double)c->missing_at);
    else nh_json_put_null(item, "missing_at");
    nh_json_put_number(item, "missing", (double)c->missing);
    nh_json_put_bool(item, "missing_settled", !c->missing_at || c->settled);
    put_degrees(item, c);
    return item;
}

void nh_analysis_json_samples(const nh_analysis *result, nh_json *to)
{
    const nh_analysis_question *q = result->question;
    const nh_grid_report *g = &result->grid;
    const nh_chart *c = q->model->chart;
    nh_json *samples = nh_json_put_object(to, "samples");
    nh_json_put_text(samples, "grid", nh_sample_grid_word(q->grid.kind));
    nh_json_put_number(samples, "used", (double)result->samples);
    nh_json_put_number(samples, "beyond_chart", (double)result->beyond);
    nh_json_put_number(samples, "rejected", (double)result->rejected);
    nh_json *why = nh_json_put_object(samples, "reasons");
    nh_json_put_number(why, "not_finite", (double)g->not_finite);
    nh_json_put_number(why, "no_solution", (double)g->not_solved);
    nh_json_put_number(why, "near_singularity", (double)g->degenerate);
    nh_json_put_number(why, "outside", (double)g->outside);
    nh_json *branches = nh_json_put_object(samples, "branches");
    for (size_t i = 0; i < g->branches; i++)
        nh_json_put_number(branches, g->branch[i].name, (double)g->branch[i].points);
    nh_json *domain = nh_json_put_object(samples, "domain");
    for (size_t j = 0; j < 1 + q->model->m + q->model->n; j++) {
        double range[2] = {c->low[j], c->high[j]};
        nh_json_put_numbers(domain, nh_name_of(q->model->dag, c->symbol[j]), 2, range, 1);
    }
    nh_json_put_number(samples, "seed", q->options.seed);
}

void nh_analysis_json_completeness(const nh_analysis *result, nh_json *to)
{
    const nh_completeness *c = result->completeness;
    bool timely = !c[NH_COMPLETE_IN_COORDINATES].counted;
    nh_json *item = put_count(to, "completeness", &c[timely ? NH_COMPLETE_IN_TIME : NH_COMPLETE_IN_COORDINATES]);
    if (item && timely) nh_json_put_null(item, "in_time");
    else if (item) put_count(item, "in_time", &c[NH_COMPLETE_IN_TIME]);
}
