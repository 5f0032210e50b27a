/* reduce_compare: the reconstructed motion of a stage, compared with the full one. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "geometry/bordered.h"
#include "reduction/reduced_check.h"
#include "commands/reduce_internal.h"

nh_reconstruction *nh_reduction_follow(const nh_reduction_bench *b, const nh_reduction_stage *s,
                                       const nh_reduction_time_series *c, bool group, const nh_reconstruct_how *how,
                                       nh_error *error)
{
    nh_reconstruct_how own = *how;
    double *place = nh_alloc_array(s->action->kinetic->m + 1, sizeof *place);
    own.absolute = nh_reduction_absolute(b->r);
    if (c->reached)
        own.place = place, nh_reduction_first_sizes(s->action->kinetic, c->reached, c->want, c->stride, place);
    nh_reconstruction *out = c->atlas
                                 ? nh_reconstruct_over(c->atlas, c->q, c->v, group, c->outputs, b->times, &own, error)
                                 : nh_reconstruct(s->reduced, s->slice, c->z, c->outputs, b->times, &own, error);
    nh_free(place);
    return out;
}

double nh_reduction_farthest(const nh_reduction_stage *s, const nh_reduction_time_series *c,
                             const nh_reconstruction *motion)
{
    double worst;
    nh_reduction_reliable(s->action->kinetic, motion->count < c->reached ? motion->count : c->reached, motion->q,
                          motion->m, c->want, c->stride, INFINITY, &worst);
    return worst;
}

/* The time, the drift of the energy and of conserved quantities, from the reduced motion (on one slice alone it
 * includes the group's motion). */
static void take_reduced(nh_reduction_bench *b, nh_reduction_stage *s, const nh_reconstruction *c)
{
    if (c->count > 1 && s->reduced->conservative) s->energy_drift = 0;
    for (size_t i = 1; i < c->count && s->reduced->conservative; i++) {
        double off = fabs(c->energy[i] - c->energy[0]);
        if (off > 0) s->energy_drift = fmax(s->energy_drift, off / c->energy_size[i]);
    }
    if (s->linear.count && c->charts == 0)
        s->linear_drift = nh_linear_momenta_drift(&s->linear, c->first, c->first_chart, c->z);
    s->charts = c->charts;
    s->seconds = c->seconds;
    s->speedup = c->complete && s->seconds > 0 ? b->r->full_seconds / s->seconds : 0;
}

/* Is the motion computed in the variables of the equations that are shown?  Other independent velocities have other
 * momenta, some of them with the same names. */
static bool in_shown_momenta(const nh_reduction_stage *s, const nh_reduced *first)
{
    bool same = s->shown && s->shown->r == first->r;
    for (size_t k = 0; k < first->r && same; k++) same = !strcmp(s->shown->momentum[k], first->momentum[k]);
    return same;
}

/* The part of the motion that is shown. */
static void keep(nh_reduction *r, nh_reduction_stage *s, const nh_reconstruction *c)
{
    size_t n = c->first->n, momenta = in_shown_momenta(s, c->first) ? c->first->r : 0;
    size_t charted = c->first_chart < c->count ? c->first_chart : c->count;
    double *q = nh_arena_alloc(r->arena, (c->count * c->m + 1) * sizeof *q);
    double *p = nh_arena_alloc(r->arena, (charted * momenta + 1) * sizeof *p);
    const char **name = nh_arena_alloc(r->arena, (momenta + 1) * sizeof *name);
    if (c->count > 0) memcpy(q, c->q, c->count * c->m * sizeof *q);
    for (size_t i = 0; i < charted * momenta; i++) p[i] = c->z[i / momenta * c->size + n + i % momenta];
    for (size_t k = 0; k < momenta; k++) name[k] = nh_arena_printf(r->arena, "%s", c->first->momentum[k]);
    s->motion = (nh_reduction_motion){
        .count = c->count, .m = c->m, .q = q, .charted = charted, .momenta = momenta, .p = p, .name = name};
}

/* How far the motion goes, and how near it comes to the full one. */
static void take_whole(const nh_reduction_bench *b, nh_reduction_stage *s, const nh_reduction_time_series *course,
                       const nh_reconstruction *c)
{
    size_t n = c->count < course->reached ? c->count : course->reached;
    s->complete = c->complete && course->outputs == NH_REDUCTION_OUTPUTS;
    s->dependent = c->dependent;
    s->restarts = c->restarts;
    if (c->charts > s->charts) s->charts = c->charts;
    s->compared = n > 1;
    s->reached = n > 1 ? b->times[n - 1] : 0;
    s->agreement = nh_reduction_farthest(s, course, c);
    if (!b->r->brief && c->q && s->compared) keep(b->r, s, c);
    snprintf(s->note, sizeof s->note, "%.250s", c->note);
}

/* The reduced motion alone. */
static void reduced_alone(nh_reduction_bench *b, nh_reduction_stage *s, const nh_reduction_time_series *course,
                          const nh_reconstruct_how *how)
{
    nh_error trouble = {0};
    nh_reconstruction *c = nh_reduction_follow(b, s, course, false, how, &trouble);
    nh_error_clear(&trouble);
    if (c) take_reduced(b, s, c);
    nh_reconstruction_free(c);
}

/* The motion with reconstruction; false when it cannot be started. */
static bool reduced_and_group(nh_reduction_bench *b, nh_reduction_stage *s, const nh_reduction_time_series *course,
                              const nh_reconstruct_how *how, bool first)
{
    nh_error trouble = {0};
    nh_reconstruction *c = nh_reduction_follow(b, s, course, true, how, &trouble);
    if (!c) snprintf(s->note, sizeof s->note, "%.250s", trouble.what);
    nh_error_clear(&trouble);
    if (!c) return false;
    if (!course->atlas && first) take_reduced(b, s, c);
    take_whole(b, s, course, c);
    nh_reconstruction_free(c);
    return true;
}

/* Where the two differ the reduced motion is computed again with a smaller tolerance, as it may be the more sensitive
 * one. */
static bool nearer(nh_reduction_bench *b, nh_reduction_stage *s, const nh_reduction_time_series *course)
{
    static const double apart = 50, finer = 0.02, least = 2e-14; /* a difference, in tolerances */
    const nh_reduction *r = b->r;
    nh_reconstruct_how how[] = {{.tolerance = b->rtol}, {.tolerance = fmax(b->rtol * finer, least)}};
    for (size_t i = 0; i < sizeof how / sizeof *how; i++) {
        nh_reduction_stage before = *s;
        how[i].steps = fmin(r->options.steps, NH_REDUCTION_STEPS);
        bool found = reduced_and_group(b, s, course, &how[i], i == 0);
        if (i == 0 && !found) return false;
        if (i > 0 && (!found || s->reached < before.reached || s->agreement > before.agreement)) *s = before;
        if (s->agreement <= apart * r->options.tolerance) break;
    }
    return true;
}

/* By the method that is chosen for the requested accuracy. */
static void chosen(nh_reduction_bench *b, nh_reduction_stage *s, const nh_reduction_time_series *course)
{
    nh_reduction *r = b->r;
    nh_reconstruct_how how;
    nh_reconstruction *c = nh_reduction_choose(b, s, course, &how);
    if (!c) {
        nh_error trouble = {0};
        nh_reconstruction_free(nh_reduction_follow(
            b, s, course, true, &(nh_reconstruct_how){.tolerance = b->rtol, .steps = NH_REDUCTION_STEPS}, &trouble));
        snprintf(s->note, sizeof s->note, "%.250s", trouble.what);
        nh_error_clear(&trouble);
        return;
    }
    if (course->atlas) reduced_alone(b, s, course, &how);
    else take_reduced(b, s, c);
    take_whole(b, s, course, c);
    nh_reconstruction_free(c);
    if (nh_stage_apart(s, &r->options)) nh_reduction_warn(r, "the reduced motion by %s: %s", s->group, s->choice.why);
}

static bool true_accelerations(void *bordered, const double *q, const double *v, double *acceleration)
{
    return nh_bordered_accelerations(bordered, 0, q, v, acceleration);
}

/* The equations as they are printed against those that they follow from. */
static void check_printed(nh_reduction *r, nh_reduction_stage *s)
{
    static const double allowed = 1e-7;
    if (r->brief || nh_interrupted()) return;
    if (s->second) {
        nh_reduced_shape *first = nh_reduced_shape_create(&s->second->first->reduced);
        s->printed =
            nh_reduced_difference(s->shown, s->shown_slice, nh_reduced_shape_accelerations, first, &s->printed_states);
        nh_reduced_shape_free(first);
    } else {
        nh_bordered *bordered = nh_bordered_create(r->model);
        s->printed = nh_reduced_difference(s->shown, s->shown_slice, true_accelerations, bordered, &s->printed_states);
        nh_bordered_free(bordered);
    }
    if (!s->printed_states)
        nh_reduction_warn(
            r, "the equations of %s could be evaluated at no state of the slice on which they are printed", s->group);
    else if (!(s->printed <= allowed))
        nh_reduction_warn(r, "the equations of %s, as printed, differ from the true accelerations by %.1e", s->group,
                          s->printed);
}

void nh_reduction_compare(nh_reduction_bench *b, nh_reduction_stage *s, const nh_reduction_time_series *course)
{
    nh_reduction *r = b->r;
    check_printed(r, s);
    if (nh_reduction_late(r, "the motion of a stage")) return;
    if (!course->atlas && course->reached < 2) {
        snprintf(s->note, sizeof s->note, "the full motion is not accurate at any time, so no comparison was possible");
        return;
    }
    if (course->atlas) {
        double *start = nh_arena_alloc(r->arena, (s->reduced->n + s->reduced->r + 1) * sizeof *start);
        if (nh_atlas_start(course->atlas, course->q, course->v, start)) s->start = start;
    }
    if (r->wanted > 0) {
        chosen(b, s, course);
        return;
    }
    if (course->atlas)
        reduced_alone(b, s, course,
                      &(nh_reconstruct_how){.tolerance = b->rtol, .steps = fmin(r->options.steps, NH_REDUCTION_STEPS)});
    if (!nearer(b, s, course) || s->agreement <= NH_REDUCTION_ALLOWED * r->options.tolerance) return;
    s->unsure = nh_reduction_unsure(b);
    if (nh_stage_apart(s, &r->options))
        nh_reduction_warn(r,
                          "the reduced motion by %s differs by %.1e from the reference motion, more than %d tolerances",
                          s->group, s->agreement, NH_REDUCTION_ALLOWED);
}

bool nh_stage_apart(const nh_reduction_stage *s, const nh_options *options)
{
    return s->compared && !(s->agreement <= NH_REDUCTION_ALLOWED * options->tolerance + s->unsure);
}

void nh_reduction_compare_full(nh_reduction_bench *b, nh_reduction_stage *s, nh_atlas *atlas)
{
    nh_reduction_compare(b, s,
                         &(nh_reduction_time_series){.atlas = atlas,
                                                     .q = b->r->initial.q,
                                                     .v = b->r->initial.v,
                                                     .outputs = NH_REDUCTION_OUTPUTS,
                                                     .want = b->full,
                                                     .stride = b->r->kinetic->m,
                                                     .reached = b->reached});
    nh_atlas_free(atlas);
}
