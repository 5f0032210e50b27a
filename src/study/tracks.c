#include "study/tracks.h"

#include <string.h>

static void add(nh_result *r, const char *name, nh_track_kind kind, nh_ex value) { r->track[r->tracks++] = (nh_track){name, kind, value}; }

/* The first two lengths span the plane; the first angle is the heading. */
static void default_drawing(nh_result *r)
{
    const nh_system *s = r->system;
    size_t length[2], lengths = 0, angle = s->coordinates;
    for (size_t i = 0; i < s->coordinates; i++) {
        if (s->coordinate[i].type == NH_LENGTH && lengths < 2) length[lengths++] = i;
        if (s->coordinate[i].type == NH_ANGLE && angle == s->coordinates) angle = i;
    }
    if (lengths < 2) return;
    nh_shape *shape = nh_arena_alloc(r->arena, sizeof *shape);
    shape->kind = angle < s->coordinates ? NH_SHAPE_ARROW : NH_SHAPE_POINT;
    shape->value[0] = s->coordinate[length[0]].q;
    shape->value[1] = s->coordinate[length[1]].q;
    if (shape->kind == NH_SHAPE_ARROW) shape->value[2] = s->coordinate[angle].q;
    r->shape = shape;
    r->shapes = 1;
    r->shape_chosen = true;
}

static void drawing(nh_result *r)
{
    if (r->analysis && r->analysis->shapes) {
        r->shape = r->analysis->shape;
        r->shapes = r->analysis->shapes;
    } else {
        default_drawing(r);
    }
}

void nh_tracks_list(nh_result *r)
{
    const nh_model *o = r->model;
    const nh_system *s = r->system;
    drawing(r);
    size_t watches = r->analysis ? r->analysis->watches : 0;
    r->track = nh_arena_alloc(r->arena, (2 * o->m + o->n + r->count + watches + NH_SHAPE_NUMBERS * r->shapes + 2) * sizeof *r->track);
    for (size_t i = 0; i < o->m; i++) add(r, s->coordinate[i].name, NH_TRACK_STATE, s->coordinate[i].q);
    for (size_t i = 0; i < o->m; i++) add(r, nh_name_of(o->dag, s->coordinate[i].v), NH_TRACK_STATE, o->rho[i]);
    for (size_t i = 0; i < o->n && o->chart->quasi; i++) add(r, nh_name_of(o->dag, o->chart->w[i]), NH_TRACK_STATE, o->chart->w[i]);
    add(r, "E", NH_TRACK_ENERGY, o->E);
    for (size_t k = 0; k < r->count; k++) add(r, r->found[k].name, NH_TRACK_CURRENT, r->found[k].phi);
    for (size_t i = 0; i < r->shapes; i++)
        for (size_t j = 0; j < nh_shape_numbers(r->shape[i].kind); j++)
            add(r, nh_arena_printf(r->arena, "%s%zu.%zu", nh_shape_name(r->shape[i].kind), i + 1, j + 1), NH_TRACK_SHAPE, r->shape[i].value[j]);
    for (size_t i = 0; i < watches; i++) add(r, r->analysis->watch[i].name, NH_TRACK_WATCH, r->analysis->watch[i].value);
}

const nh_watch *nh_tracks_watches(const nh_result *r)
{
    nh_watch *watch = nh_arena_alloc(r->arena, (r->tracks + 1) * sizeof *watch);
    for (size_t i = 0; i < r->tracks; i++) watch[i] = (nh_watch){r->track[i].name, r->track[i].value, r->track[i].kind == NH_TRACK_WATCH};
    return watch;
}
