#include "problem/observables.h"

#include <string.h>

#include "graph/node.h"
#include "problem/drawing.h"

nh_observables nh_observables_create(nh_arena *arena, const nh_model *model)
{
    return (nh_observables){.arena = arena, .model = model};
}

void nh_observables_add(nh_observables *t, const char *name, nh_track_kind kind, nh_ex value)
{
    if (t->count == t->capacity) {
        size_t capacity = 2 * t->capacity + 32;
        nh_track *more = nh_arena_alloc(t->arena, capacity * sizeof *more);
        if (t->count) memcpy(more, t->track, t->count * sizeof *more);
        t->track = more;
        t->capacity = capacity;
    }
    t->track[t->count++] = (nh_track){name, kind, value};
}

/* Of a coordinate: beside angular velocities it is listed already. */
static bool is_velocity(const nh_system *system, nh_ex w)
{
    for (size_t i = 0; i < system->coordinates; i++)
        if (system->coordinate[i].v == w) return true;
    return false;
}

void nh_observables_add_states(nh_observables *t)
{
    const nh_model *model = t->model;
    const nh_system *system = model->system;
    for (size_t i = 0; i < model->m; i++)
        nh_observables_add(t, system->coordinate[i].name, NH_TRACK_STATE, system->coordinate[i].q);
    for (size_t i = 0; i < model->m; i++)
        nh_observables_add(t, nh_name_of(model->dag, system->coordinate[i].v), NH_TRACK_STATE, model->rho[i]);
    for (size_t i = 0; i < model->n && model->chart->quasi; i++)
        if (!is_velocity(system, model->chart->w[i]))
            nh_observables_add(t, nh_name_of(model->dag, model->chart->w[i]), NH_TRACK_STATE, model->chart->w[i]);
}

void nh_observables_add_watches(nh_observables *t, const nh_analysis_file *a)
{
    for (size_t i = 0; a && i < a->watches; i++)
        nh_observables_add(t, a->watch[i].name, NH_TRACK_WATCH, a->watch[i].value);
}

void nh_observables_add_drawing(nh_observables *t, const nh_analysis_file *a)
{
    const nh_system *system = t->model->system;
    if (a && a->shapes) {
        t->shape = a->shape;
        t->shapes = a->shapes;
        t->drawing = "as in the analysis file";
    } else if (system->shapes) {
        t->shape = system->shape;
        t->shapes = system->shapes;
        t->drawing = "as in the system file";
    } else {
        t->drawing = nh_drawing_choose(t->arena, system, &t->shapes, &t->shape);
    }
    for (size_t i = 0; i < t->shapes; i++)
        for (size_t j = 0; j < nh_shape_numbers(t->shape[i].kind); j++)
            nh_observables_add(t, nh_arena_printf(t->arena, "%s%zu.%zu", nh_shape_name(t->shape[i].kind), i + 1, j + 1),
                               NH_TRACK_SHAPE, t->shape[i].value[j]);
}
