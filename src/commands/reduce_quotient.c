/* reduce_quotient: systems without connection and momenta (nonlinear constraints, Lagrangians that are not quadratic,
 * explicit time): their equations on the quotient, whenever a group leaves them invariant. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "commands/reduce_internal.h"

/* On the branch of a quadratic constraint that the initial state lies on. */
bool nh_reduction_whole_model(nh_reduction *r, nh_error *error)
{
    double *w = nh_alloc_array(r->kinetic->m + 1, sizeof *w);
    for (int attempt = 0; attempt < 2; attempt++) {
        nh_error off = {0};
        if (!r->whole)
            r->whole = nh_model_create(r->system,
                                       nh_chart_create(r->system, r->chart, (uint64_t)r->options.seed, error), error);
        if (!r->whole || !r->whole->chart->branch || attempt ||
            nh_quotient_velocities(r->whole, 0, r->initial.q, r->initial.v, w, &off))
            break;
        r->system->branch = -r->whole->chart->branch;
        nh_model_free(r->whole);
        r->whole = NULL;
    }
    nh_free(w);
    return r->whole != NULL;
}

/* The equations in a chart of velocities, to be shown. */
static const nh_reduced *in_chart(nh_reduction *r, nh_slice *slice, nh_slice *shown, const nh_slice **used,
                                  nh_error *error)
{
    nh_reduced *o = nh_arena_alloc(r->arena, sizeof *o);
    nh_error ignored = {0};
    *used = shown;
    bool good = nh_quotient_init(o, r->whole, shown, &ignored);
    nh_error_clear(&ignored);
    if (!good) good = nh_quotient_init(o, r->whole, *used = slice, error);
    return good ? o : NULL;
}

bool nh_reduction_quotient(nh_reduction_bench *b, const nh_action *action, nh_error *error)
{
    nh_reduction *r = b->r;
    nh_arena *arena = r->arena;
    nh_slice *slice, *shown;
    const nh_slice *used;
    if (!nh_reduction_whole_model(r, error)) return false;
    nh_reduction_make_slices(r, action, r->initial.q, &slice, &shown);
    const nh_reduced *pretty = in_chart(r, slice, shown, &used, error);
    if (!pretty) return false;
    nh_reduced *o = nh_arena_alloc(arena, sizeof *o);
    nh_frame_motion_free(r->frame);
    r->frame = nh_frame_motion_create(o, r->model, slice);
    o->conservative = pretty->conservative;
    double *z = nh_arena_alloc(arena, (o->n + o->r + 1) * sizeof *z);
    for (size_t i = 0; i < o->n; i++) z[i] = r->initial.q[slice->shape[i]];
    if (!nh_slice_components(slice, r->initial.q, r->initial.v, z + o->n))
        return nh_fail(error, NH_NUMERIC, "", "the slice is singular at the initial place");
    nh_reduction_stage *s = nh_reduction_new_stage(r, NH_STAGE_QUOTIENT, action);
    s->slice = slice;
    s->reduced = o;
    s->shown = pretty;
    s->shown_slice = used;
    s->start = z;
    nh_reduction_compare(
        b, s,
        &(nh_reduction_time_series){
            .z = z, .outputs = b->reached, .want = b->full, .stride = r->kinetic->m, .reached = b->reached});
    return true;
}

bool nh_reduction_quotient_momenta(nh_reduction *r, nh_error *error)
{
    if (!nh_reduction_whole_model(r, error)) return false;
    nh_quotient_momenta(&r->momenta, r->whole, &r->group->action, &r->options);
    return true;
}
