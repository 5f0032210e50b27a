#include "document/time_series.h"

#include <stdio.h>

#include "base/memory.h"

enum { longest_name = 24 };

/* Includes room for the multipliers and their names. */
static nh_time_series *make(const nh_model *model, const nh_observables *t, size_t count, const double *time,
                            const double *value, size_t stride)
{
    nh_time_series *c = nh_alloc(sizeof *c);
    *c = (nh_time_series){
        .model = model, .count = count, .time = time, .shapes = t->shapes, .shape = t->shape, .drawing = t->drawing};
    c->line = nh_alloc_array(t->count + model->k + 1, sizeof *c->line + longest_name);
    for (size_t j = 0; j < t->count; j++)
        c->line[c->lines++] = (nh_line){t->track[j].name, t->track[j].kind, value + j, stride};
    return c;
}

nh_time_series *nh_time_series_of_analysis(const nh_analysis *result)
{
    const nh_validation *v = result->validation;
    size_t k = result->question->model->k;
    if (!v || !v->count) return NULL;
    nh_time_series *c = make(result->question->model, &result->tracks, v->count, v->time, v->watch, v->watches);
    c->drifts_elsewhere = true;
    char *name = (char *)(c->line + result->tracks.count + k + 1);
    for (size_t a = 0; a < k; a++, name += longest_name) {
        snprintf(name, longest_name, "c%zu", a + 1);
        c->line[c->lines++] = (nh_line){name, NH_TRACK_MULTIPLIER, v->multiplier + a, k};
    }
    return c;
}

nh_time_series *nh_time_series_of_simulation(const nh_simulation *s)
{
    if (!s->motion) return NULL;
    const nh_trajectory *t = nh_simulation_drawn(s);
    return make(s->model, &s->columns, t->motion->count, t->motion->time, t->value, s->columns.count);
}

void nh_time_series_free(nh_time_series *c)
{
    if (!c) return;
    nh_free(c->line);
    nh_free(c);
}

const nh_line *nh_time_series_shape(const nh_time_series *c, size_t i, size_t j)
{
    size_t before = j;
    for (size_t k = 0; k < i; k++) before += nh_shape_numbers(c->shape[k].kind);
    for (const nh_line *line = c->line;; line++)
        if (line->kind == NH_TRACK_SHAPE && before-- == 0) return line;
}

nh_json *nh_time_series_json(const nh_time_series *c, nh_json *to, const char *key, nh_track_kind kind)
{
    nh_json *group = nh_json_put_object(to, key);
    for (size_t j = 0; j < c->lines; j++)
        if (c->line[j].kind == kind)
            nh_json_put_numbers(group, c->line[j].name, c->count, c->line[j].value, c->line[j].stride);
    return group;
}

void nh_time_series_json_drawing(const nh_time_series *c, nh_json *to)
{
    static const char *const keys[NH_SHAPE_NUMBERS] = {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"};
    nh_json *list = nh_json_put_array(to, "drawing");
    for (size_t i = 0; i < c->shapes; i++) {
        nh_json *shape = nh_json_add_object(list);
        nh_json_put_text(shape, "kind", nh_shape_name(c->shape[i].kind));
        if (c->shape[i].name) nh_json_put_text(shape, "name", c->shape[i].name);
        for (size_t j = 0; j < nh_shape_numbers(c->shape[i].kind); j++) {
            const nh_line *line = nh_time_series_shape(c, i, j);
            nh_json_put_numbers(shape, keys[j], c->count, line->value, line->stride);
        }
    }
}
