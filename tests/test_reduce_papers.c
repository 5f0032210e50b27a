/* reduce by the recipe of the papers: the groups of Chhabra and Emami (2014) and of Cendra and Diaz (2018) without options, Hamilton's form, metric, and what
 * the constraints integrate to, each against numbers derived here. */
#include "oracle.h"

#include <stdio.h>

#include "commands/reduce.h"
#include "reduction/group.h"
#include "scratch.h"

static nh_reduction *reduce_path(const char *path, const char *group, bool equations)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .group = group, .equations = equations};
    nh_options_default(&q.options);
    q.options.until = 2;
    nh_reduction *r = nh_reduction_create(&q, &error);
    must(r != NULL, &error, path);
    return r;
}

static nh_reduction *reduce_text(const char *text, bool equations)
{
    char path[SCRATCH];
    cr_assert(scratch_text(path, text));
    nh_reduction *r = reduce_path(path, NULL, equations);
    remove(path);
    return r;
}

/* ---- the group ---- */

static bool has_shape(const nh_reduction_stage *s, size_t n, const char *const *name)
{
    bool same = s->shown->n == n;
    for (size_t i = 0; i < n && same; i++) same = !strcmp(s->slice->kinetic->name[s->slice->shape[i]], name[i]);
    return same;
}

/* Section 6 of the paper: G = Q1 x Q5, N = Q3, and A-hat as it is printed there. */
Test(reduce_papers, the_crane_is_divided_by_the_group_of_the_paper)
{
    static const char *const files[] = {"systems/crane.yaml", "systems/crane_lagrangian.yaml"};
    static const char *const four[] = {"psi1", "phi1", "psi2", "phi2"}, *const three[] = {"psi1", "psi2", "phi2"};
    for (size_t i = 0; i < 2; i++) {
        nh_reduction *r = reduce_path(files[i], NULL, false);
        cr_assert(r->stages == 3 && r->stage[0].kind == NH_STAGE_CHAPLYGIN && r->stage[1].kind == NH_STAGE_SECOND);
        cr_expect(has_shape(&r->stage[0], 4, four), "%s: shape of the first stage", files[i]);
        cr_expect(has_shape(&r->stage[1], 3, three), "%s: shape of the second stage", files[i]);
        const nh_chaplygin *c = r->stage[0].chaplygin;
        bool first[4];
        nh_group_first_joint(c->slice->action, first);
        for (size_t a = 0; a < 4; a++) { /* x, y, psi3, and the turn, which is the last generator */
            cr_expect_eq(first[a], i == 0 && a != 2, "%s: generator %zu", files[i], a + 1);
        }
        const double l = 2.6, b = 0.35, e = 0.8;
        for (size_t p = 0; p < 10; p++) {
            const double *q = r->kinetic->place + p * 8;
            double A[16], s = sin(q[3]), k = cos(q[3]), D = l - e * s;
            double want[4][2] = {{-l * e * k / D, -l * b * k / D}, {0, 0}, {-2 * l * e / b / D, -(l + e * s) / D}, {-e * s / D, -b * s / D}};
            nh_kinetic_values(r->kinetic, 16, c->A, q, A);
            for (size_t a = 0; a < 4; a++) {
                cr_expect_float_eq(A[a * 4 + 0], want[a][0], 1e-13, "A^%zu_psi1", a + 1);
                cr_expect_float_eq(A[a * 4 + 2], want[a][1], 1e-13, "A^%zu_psi2", a + 1);
            }
        }
        nh_reduction_free(r);
    }
}

#define BODY "  - {name: top, mass: 0.7, inertia: [0.2, 0.3, 0.45]}\n"
/* The crane's car, a body on a ball joint in the place of the crane. */
static const char car_with_ball[] =
    "name: car\nparameters: {l: 2.6, b: 0.35, c: 0.8}\nbodies:\n  - {name: car, mass: 9.5, inertia: [0, 0, 4.1], center: [1.1, 0, 0]}\n  - {name: axle, mass: 0.6, inertia: [0.12, 0, 0.12]}\n" BODY
    "  - {name: left, mass: 0.45, inertia: [0.05, 0.08, 0.05]}\n  - {name: right, mass: 0.45, inertia: [0.05, 0.08, 0.05]}\n"
    "joints:\n  - {type: planar, child: car, coordinates: [x, y, h]}\n  - {type: revolute, parent: car, child: axle, at: [l, 0, 0], axis: z, coordinates: [psi1]}\n"
    "  - {type: spherical, parent: car, child: top, at: [0.7, 0, 0.5], angles: zxz, coordinates: [u, v, w]}\n"
    "  - {type: revolute, parent: axle, child: left, at: [0, c, 0], axis: y, coordinates: [psi2]}\n  - {type: revolute, parent: axle, child: right, at: [0, -c, 0], axis: y, coordinates: [psi3]}\n"
    "wheels:\n  - {type: knife-edge, body: car, axis: y}\n  - {type: rolling, body: left, axle: y, radius: b}\n  - {type: rolling, body: right, axle: y, radius: b}\n"
    "domain: {h: [-1.2, 1.2], psi1: [-1, 1], v: [0.4, 1.4]}\n";
/* The same body on a cart with two wheels: three constraints. */
static const char cart_with_ball[] =
    "name: cart\nparameters: {c: 0.6, r: 0.25}\nbodies:\n  - {name: cart, mass: 2.3, inertia: [0, 0, 0.9], center: [0.45, 0, 0]}\n  - {name: left, mass: 0.35, inertia: [0.007, 0.012, 0.007]}\n"
    "  - {name: right, mass: 0.35, inertia: [0.007, 0.012, 0.007]}\n" BODY
    "joints:\n  - {type: planar, child: cart, at: [0, 0, r], coordinates: [x, y, h]}\n  - {type: revolute, parent: cart, child: left, at: [0, c, 0], axis: y, coordinates: [psi1]}\n"
    "  - {type: revolute, parent: cart, child: right, at: [0, -c, 0], axis: y, coordinates: [psi2]}\n  - {type: spherical, parent: cart, child: top, at: [0.3, 0, 0.4], angles: zxz, coordinates: [u, v, w]}\n"
    "wheels:\n  - {type: rolling, body: left, axle: y, radius: r}\n  - {type: rolling, body: right, axle: y, radius: r}\ndomain: {h: [-1.2, 1.2], v: [0.4, 1.4]}\n";

/* The second stage divides SO(3) out, and its momentum is the spin of the body in space, R I Omega with the attitude R: of body velocity Omega, derived here from
 * Euler's angles z, x, z after the turn h of the car. */
Test(reduce_papers, a_ball_joint_is_divided_out_in_a_second_stage)
{
    static const struct {
        const char *text, *first;
    } cases[] = {{car_with_ball, "SE(2) x SO(2)"}, {cart_with_ball, "SE(2)"}};
    for (size_t i = 0; i < 2; i++) {
        nh_reduction *r = reduce_text(cases[i].text, false);
        cr_assert(r->stages >= 2 && r->stage[1].kind == NH_STAGE_SECOND);
        cr_expect_str_eq(r->stage[0].group, cases[i].first);
        cr_expect_str_eq(r->stage[1].group, "SO(3)");
        cr_expect_eq(r->stage[1].second->orbit, 2);
        cr_expect(r->stage[0].agreement < 1e-8 && r->stage[1].agreement < 1e-8 && r->stage[1].momentum_drift < 1e-10);
        long h = nh_system_coordinate(r->system, "h"), u = nh_system_coordinate(r->system, "u"), v = nh_system_coordinate(r->system, "v"), w = nh_system_coordinate(r->system, "w");
        size_t m = r->kinetic->m;
        double first[3] = {0}, I[3] = {0.2, 0.3, 0.45};
        cr_assert(r->stage[0].motion.count > 10);
        for (size_t k = 2; k + 2 < r->stage[0].motion.count; k++) { /* the attitude angle a = h + u, v, w; rates by differences of order four */
            const double *q = r->stage[0].motion.q + k * m, t = r->times[1] - r->times[0];
            double a = q[h] + q[u], rate[3], spin[3] = {0};
            const long of[3] = {u, v, w};
            for (size_t j = 0; j < 3; j++) {
                double at[5];
                for (size_t n = 0; n < 5; n++) at[n] = q[of[j] + ((long)n - 2) * (long)m] + (j == 0 ? q[h + ((long)n - 2) * (long)m] : 0);
                rate[j] = (8 * (at[3] - at[1]) - (at[4] - at[0])) / (12 * t);
            }
            double sv = sin(q[v]), cv = cos(q[v]), sw = sin(q[w]), cw = cos(q[w]), sa = sin(a), ca = cos(a);
            double Omega[3] = {rate[0] * sv * sw + rate[1] * cw, rate[0] * sv * cw - rate[1] * sw, rate[0] * cv + rate[2]};
            double R[3][3] = {{ca * cw - sa * cv * sw, -ca * sw - sa * cv * cw, sa * sv}, {sa * cw + ca * cv * sw, -sa * sw + ca * cv * cw, -ca * sv}, {sv * sw, sv * cw, cv}};
            for (size_t j = 0; j < 9; j++) spin[j / 3] += R[j / 3][j % 3] * I[j % 3] * Omega[j % 3];
            for (size_t j = 0; j < 3; j++) {
                if (k == 2) first[j] = spin[j];
                cr_expect_float_eq(spin[j], first[j], 1e-4 * hypot(hypot(first[0], first[1]), first[2]), "case %zu, output %zu: the spin %zu is %g, was %g", i, k, j, spin[j], first[j]);
            }
        }
        nh_reduction_free(r);
    }
}
