/* reduction: reduced motions with reconstruction against the motion in all coordinates. */
#include "reduced.h"

#include <stdio.h>
#include <stdlib.h>

#include "motion/dynamics.h"
#include "reduction/group.h"
#include "reduction/reconstruct.h"

static nh_options sharp(void)
{
    nh_options o;
    nh_options_default(&o);
    o.tolerance = 1e-13;
    return o;
}

/* The positions of the motion in all coordinates at the given times. */
static double *full_motion(const reducible *x, const double *q, const double *v, size_t count, const double *times, double tolerance)
{
    nh_error error = {0};
    size_t m = x->kinetic->m;
    nh_bordered *b = nh_bordered_create(x->model);
    nh_flow_problem problem = nh_bordered_flow(b);
    nh_flow_options options = {.method = NH_ADAMS, .rtol = tolerance};
    double *z = nh_alloc_array(2 * m, sizeof *z), *out = nh_alloc_array(count * m, sizeof *out);
    memcpy(z, q, m * sizeof *z);
    memcpy(z + m, v, m * sizeof *z);
    nh_motion *motion = nh_flow(&problem, z, count, times, &options, &error);
    must(motion && motion->complete, &error, "the full motion");
    for (size_t i = 0; i < count; i++) memcpy(out + i * m, motion->state + i * 2 * m, m * sizeof *out);
    nh_motion_free(motion);
    nh_bordered_free(b);
    nh_free(z);
    return out;
}

static double distance(size_t n, const double *a, const double *b)
{
    double worst = 0;
    for (size_t i = 0; i < n; i++) worst = fmax(worst, fabs(a[i] - b[i]) / (1 + fabs(b[i])));
    return worst;
}

/* A subgroup by the numbers of its generators. */
static nh_action subgroup(const nh_group *g, size_t n, const size_t *index, const nh_options *options)
{
    double *t = nh_alloc_array(g->action.d * n + 1, sizeof *t);
    nh_action out;
    for (size_t i = 0; i < n; i++) t[index[i] + i * g->action.d] = 1;
    nh_action_sub(&out, &g->action, n, t, options);
    nh_free(t);
    return out;
}

static void master_against_full(const char *name, const char *text, const char *file, size_t n, const size_t *index, double until, double tolerance)
{
    enum { count = 5 };
    nh_error error = {0};
    nh_options options = sharp();
    reducible x = reducible_make(text ? nh_system_parse(name, text, 0, NULL, &error) : nh_system_read(file, 0, NULL, &error), 3, &error);
    nh_group *g = nh_group_find(x.kinetic, &options, &error);
    must(g != NULL, &error, name);
    nh_action action = subgroup(g, n, index, &options);
    must(nh_action_check(&action, &error), &error, name);
    size_t m = x.kinetic->m, shape[20], along[20], independent[20];
    nh_slice slice;
    nh_reduced reduced;
    double y0[20], u[20], w[20], z[40], times[count];
    const double *q = x.kinetic->place, *v = x.kinetic->speed;
    nh_slice_choose(&action, shape, along);
    for (size_t a = 0; a < n; a++) y0[a] = q[along[a]];
    nh_slice_init(&slice, &action, shape, along, y0);
    nh_reduced_independent(&slice, independent);
    must(nh_reduced_master(&reduced, &slice, independent, &error), &error, name);
    cr_assert(nh_slice_components(&slice, q, v, u));
    for (size_t i = 0; i < reduced.r; i++) w[i] = u[independent[i]];
    double x0[20];
    for (size_t i = 0; i < slice.n; i++) x0[i] = q[shape[i]];
    cr_assert(nh_reduced_start(&reduced, x0, w, z));
    for (size_t i = 0; i < count; i++) times[i] = until * (double)i / (count - 1);
    nh_reconstruction *r = nh_reconstruct(&reduced, &slice, z, count, times, &options, &error);
    must(r != NULL, &error, name);
    cr_assert(r->complete, "%s: %s", name, r->note);
    double *full = full_motion(&x, q, v, count, times, options.tolerance), off = distance(count * m, r->q, full), way = distance(m, full + (count - 1) * m, full);
    cr_expect(off < tolerance, "%s: %g from the full motion", name, off);
    cr_expect(way > 0.05, "%s: nothing moves", name);
    if (getenv("NHSYM_TEST_FIGURES")) printf("%-30s group of %zu, %zu shape coordinates, %zu velocities: %.1e from the full motion, %zu restarts\n", name, n, slice.n, reduced.r, off, r->restarts);
    nh_reconstruction_free(r);
    nh_free(full);
    nh_action_clear(&action);
    nh_group_free(g);
    reducible_clear(&x);
}

static const size_t FIRST[] = {0, 1, 2, 3, 4, 5}, CRANE_FOUR[] = {0, 1, 4, 5};

Test(reduction, equations_on_a_slice_and_reconstruction_agree_with_the_full_motion)
{
    master_against_full("crane, d = 4", CRANE, NULL, 4, CRANE_FOUR, 2, 1e-10);
    master_against_full("crane, d = 6", CRANE, NULL, 6, FIRST, 2, 1e-10);
    master_against_full("snakeboard", SNAKEBOARD, NULL, 4, FIRST, 0.5, 1e-10);
    master_against_full("cart", CART, NULL, 5, FIRST, 2, 1e-10);
    master_against_full("twisted cart", TWISTED_CART, NULL, 5, FIRST, 1, 1e-10);
    master_against_full("disk", DISK, NULL, 4, FIRST, 0.3, 1e-10);
    master_against_full("Chaplygin ball", NULL, "systems/chaplygin_ball.yaml", 3, FIRST, 0.5, 1e-10);
    master_against_full("top", NULL, "systems/euler_top.yaml", 3, FIRST, 0.5, 1e-10);
    master_against_full("Routh sphere", NULL, "systems/routh_sphere.yaml", 4, FIRST, 0.5, 1e-10);
    master_against_full("sleigh", NULL, "systems/sleigh_inertia.yaml", 3, FIRST, 5, 1e-10);
}
