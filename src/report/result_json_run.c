#include <math.h>
#include <stdio.h>

#include "base/versions.h"
#include "report/result_json_internal.h"

/* ---- the motion ---- */

/* The tracks of one kind, as {name: [numbers]}. */
static nh_json *put_tracks(const nh_result *r, nh_json *to, const char *key, nh_track_kind kind)
{
    const nh_validation *v = r->validation;
    nh_json *group = nh_json_put_object(to, key);
    for (size_t j = 0; j < v->watches; j++)
        if (r->track[j].kind == kind) nh_json_put_numbers(group, r->track[j].name, v->count, v->watch + j, v->watches);
    return group;
}

static void put_shapes(const nh_result *r, nh_json *to)
{
    const nh_validation *v = r->validation;
    nh_json *list = nh_json_put_array(to, "drawing");
    size_t track = 0;
    for (size_t i = 0; i < r->shapes; i++) {
        static const char *const keys[] = {"a", "b", "c", "d"};
        nh_json *shape = nh_json_add_object(list);
        nh_json_put_text(shape, "kind", nh_shape_name(r->shape[i].kind));
        for (size_t j = 0; j < nh_shape_numbers(r->shape[i].kind); j++) {
            while (r->track[track].kind != NH_TRACK_SHAPE) track++;
            nh_json_put_numbers(shape, keys[j], v->count, v->watch + track++, v->watches);
        }
    }
}

static void put_motion(const nh_result *r, nh_json *to)
{
    const nh_validation *v = r->validation;
    bool watched = r->analysis && r->analysis->watches;
    nh_json *motion = nh_json_put_object(to, "motion");
    nh_json_put_numbers(motion, "time", v->count, v->time, 1);
    put_tracks(r, motion, "states", NH_TRACK_STATE);
    put_tracks(r, motion, "energies", NH_TRACK_ENERGY);
    put_tracks(r, motion, "currents", NH_TRACK_CURRENT);
    nh_json *multipliers = nh_json_put_object(motion, "multipliers");
    for (size_t a = 0; a < r->model->k; a++) {
        char name[40];
        snprintf(name, sizeof name, "c%zu", a + 1);
        nh_json_put_numbers(multipliers, name, v->count, v->multiplier + a, r->model->k);
    }
    put_shapes(r, motion);
    nh_json *watch = put_tracks(r, to, "watch", NH_TRACK_WATCH);
    if (watched) nh_json_put_numbers(watch, "t", v->count, v->time, 1);
}

void nh_result_json_validation(const nh_result *r, nh_json *to)
{
    const nh_validation *v = r->validation;
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
    nh_json *drift = nh_json_put_object(item, "drift");
    for (size_t k = 0; k < v->currents; k++) nh_json_put_numbers(drift, r->found[k].name, NH_DRIFT_RUNS, v->current[k].drift, 1);
    if (v->multiplier_form) {
        nh_json *full = nh_json_put_object(item, "multiplier_form");
        nh_json_put_text(full, "method", v->multiplier_method);
        nh_json_put_number(full, "state_difference", v->state_difference);
        nh_json_put_number(full, "multiplier_difference", v->multiplier_difference);
        nh_json_put_number(full, "constraint_violation", v->violation);
    } else {
        nh_json_put_null(item, "multiplier_form");
    }
    if (v->crossing_chart) {
        nh_json *crossing = nh_json_put_object(item, "chart_crossing");
        nh_json_put_text(crossing, "chart", v->crossing_chart);
        nh_json_put_number(crossing, "time", v->crossing);
    }
    put_motion(r, item);
    if (v->scene) {
        nh_json *scene = nh_json_put_object(item, "scene");
        nh_json_put_text(scene, "model", v->scene);
        nh_json_put_number(scene, "difference", v->scene_difference);
        nh_json_put_number(scene, "evaluations", (double)v->scene_evaluations);
    }
}

size_t nh_result_json_holes(const nh_result *r)
{
    const nh_validation *v = r->validation;
    size_t holes = 0, k = r->model->k;
    for (size_t i = 0; v && i < v->count * v->watches; i++) holes += !isfinite(v->watch[i]);
    for (size_t i = 0; v && i < v->count * k; i++) holes += !isfinite(v->multiplier[i]);
    return holes;
}

/* ---- how it was computed ---- */

void nh_result_json_stages(const nh_result *r, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "stages");
    for (size_t i = 0; i < r->stages; i++) {
        const nh_tried *s = &r->stage[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "name", s->name);
        nh_json_put_bool(item, "too_large", s->skipped);
        nh_json_put_number(item, "columns", (double)s->columns);
        nh_json_put_number(item, "sectors", (double)s->sectors);
        nh_json_put_number(item, "dimension", (double)s->dimension);
        nh_json_put_number(item, "found", (double)s->found);
        nh_json_put_bool(item, "undecided", s->undecided);
    }
}

void nh_result_json_run(const nh_result *r, nh_json *to)
{
    nh_json *run = nh_json_put_object(to, "run");
    nh_json_put_text(run, "command", r->command);
    nh_json_put_text(run, "system_file", r->system_path);
    nh_json_put_text(run, "analysis_file", r->analysis_path);
    nh_json_put_text(run, "machine", nh_versions_machine());
    nh_json *libraries = nh_json_put_object(run, "libraries");
    for (size_t i = 0; nh_version_of(i).name; i++) nh_json_put_text(libraries, nh_version_of(i).name, nh_version_of(i).version);
}
