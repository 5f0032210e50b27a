/* reduce by the recipe of the papers: the groups of Chhabra and Emami (2014) and of Cendra and Diaz (2018) without options, Hamilton's form, metric, and what
 * the constraints integrate to, each against numbers derived here. */
#include "oracle.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/linalg.h"
#include "commands/reduce.h"
#include "document/reduction.h"
#include "evaluate/tape.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/parse.h"
#include "reduction/group.h"
#include "reduction/hamilton.h"
#include "reduction/subspace.h"
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

/* Euler's disk as Cendra and Diaz have it (49): S^1 x R^2 > R^2 by one option; without it R^2 is below SE(2) x SO(2), too. */
Test(reduce_papers, the_disk_is_divided_along_the_chain_of_the_paper)
{
    for (int given = 0; given < 2; given++) {
        nh_reduction *r = reduce_path("systems/euler_disk.yaml", given ? "1, 2, 3" : NULL, false);
        cr_assert_eq(r->stages, 2);
        const nh_reduction_stage *s = &r->stage[1];
        cr_assert(s->kind == NH_STAGE_POINCARE && s->by_stages);
        cr_expect_eq(s->action->d, given ? 3 : 4);
        cr_assert_eq(s->chain->blocks, 2);
        cr_expect_eq(s->chain->size[1], 2);
        for (size_t i = 0; i < 2; i++) { /* d/dx1, d/dx2 */
            const nh_generator *e = &s->action->generator[s->chain->order[s->chain->start[1] + i]];
            for (size_t q = 0; q < 3; q++) cr_expect(nh_is_zero(r->kinetic->dag, e->component[q]));
        }
        cr_expect(s->poincare.stages_vertical < 1e-12 && s->poincare.stages_horizontal < 1e-12 && s->poincare.bracket < 1e-12);
        nh_reduction_free(r);
    }
}

/* ---- accelerations from the whole system, by numbers ---- */

/* v such that omega v = 0: random, less its part along the constraints' rows in the metric of unit matrices. */
static void allowed(const nh_kinetic *k, const double *q, uint64_t seed, double *v)
{
    size_t m = k->m, f = k->f;
    double *om = nh_alloc_array(f * m + f * f + f + 1, sizeof *om), *gram = om + f * m, *c = gram + f * f;
    nh_kinetic_values(k, f * m, k->omega, q, om);
    for (size_t s = 0; s < m; s++) v[s] = sin(1.7 * (double)(seed * m + s) + 0.3);
    for (size_t i = 0; i < f; i++)
        for (size_t s = 0; s < m; s++) {
            c[i] += om[i * m + s] * v[s];
            for (size_t j = 0; j < f; j++) gram[i + j * f] += om[i * m + s] * om[j * m + s];
        }
    if (f) cr_assert(nh_solve(f, gram, 1, c, NULL));
    for (size_t i = 0; i < f; i++)
        for (size_t s = 0; s < m; s++) v[s] -= om[i * m + s] * c[i];
    nh_free(om);
}

/* d/dq^s of `count` expressions by a difference of order four. */
static void slope(const nh_kinetic *k, size_t count, const nh_ex *e, const double *q, size_t s, double *out)
{
    const double h = 1e-3, weight[4] = {1. / 12, -2. / 3, 2. / 3, -1. / 12}, step[4] = {-2, -1, 1, 2};
    double *at = nh_alloc_array(k->m + count + 1, sizeof *at), *value = at + k->m;
    memset(out, 0, count * sizeof *out);
    for (size_t i = 0; i < 4; i++) {
        memcpy(at, q, k->m * sizeof *at);
        at[s] += step[i] * h;
        nh_kinetic_values(k, count, e, at, value);
        for (size_t j = 0; j < count; j++) out[j] += weight[i] * value[j] / h;
    }
    nh_free(at);
}

/* K a + K' v - 1/2 v dK v + dV = omega^T lambda, omega a + omega' v = 0: Lagrange and d'Alembert with multipliers. */
static void acceleration(const nh_kinetic *k, const double *q, const double *v, double *a)
{
    size_t m = k->m, f = k->f, n = m + f, size = m * m + f * m + 1;
    nh_ex *e = nh_alloc_array(size, sizeof *e);
    double *z = nh_alloc_array(size * (m + 1) + n * n + n, sizeof *z), *matrix = z + size * (m + 1), *right = matrix + n * n;
    memcpy(e, k->K, m * m * sizeof *e);
    memcpy(e + m * m, k->omega, f * m * sizeof *e);
    e[size - 1] = k->V;
    nh_kinetic_values(k, size, e, q, z);
    for (size_t s = 0; s < m; s++) slope(k, size, e, q, s, z + size * (s + 1));
    for (size_t i = 0; i < m; i++) {
        for (size_t j = 0; j < m; j++) {
            matrix[i + j * n] = z[i * m + j];
            for (size_t s = 0; s < m; s++) right[i] += (0.5 * z[size * (i + 1) + j * m + s] - z[size * (s + 1) + i * m + j]) * v[s] * v[j];
        }
        right[i] -= z[size * (i + 1) + size - 1];
    }
    for (size_t r = 0; r < f; r++)
        for (size_t i = 0; i < m; i++) {
            matrix[m + r + i * n] = z[m * m + r * m + i];
            matrix[i + (m + r) * n] = -z[m * m + r * m + i];
            for (size_t s = 0; s < m; s++) right[m + r] -= z[size * (s + 1) + m * m + r * m + i] * v[s] * v[i];
        }
    cr_assert(nh_solve(n, matrix, 1, right, NULL));
    memcpy(a, right, m * sizeof *a);
    nh_free(e);
    nh_free(z);
}

/* ---- Hamilton's form ---- */

/* `count` expressions of h at (x, p, m). */
static void at_state(const nh_reduction *r, const nh_hamilton *h, size_t count, const nh_ex *e, const double *z, double *out)
{
    const nh_kinetic *k = r->kinetic;
    size_t n = h->n, width = 2 * n + h->d;
    nh_ex *in = nh_alloc_array(width, sizeof *in);
    memcpy(in, h->x, n * sizeof *in);
    memcpy(in + n, h->p, (n + h->d) * sizeof *in);
    nh_tape *tape = nh_tape_create(h->dag, width, in, count, e, r->system->parameters, k->model->parameter, k->model->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(in);
}

/* The momenta at which dH/dp is this velocity of the shape. */
static void momenta_of(const nh_reduction *r, const nh_hamilton *h, const double *speed, double *z)
{
    size_t n = h->n;
    double *matrix = nh_alloc_array(n * n + 2 * n + 1, sizeof *matrix), *zero = matrix + n * n, *right = zero + n;
    memset(z + n, 0, n * sizeof *z);
    at_state(r, h, n, h->speed, z, zero);
    for (size_t j = 0; j < n; j++) {
        z[n + j] = 1;
        at_state(r, h, n, h->speed, z, matrix + j * n);
        z[n + j] = 0;
        for (size_t i = 0; i < n; i++) matrix[i + j * n] -= zero[i];
        right[j] = speed[j] - zero[j];
    }
    cr_assert(nh_solve(n, matrix, 1, right, NULL));
    memcpy(z + n, right, n * sizeof *z);
    nh_free(matrix);
}

/* For allowed states of the whole system: x'' of the shape from the whole equations, and as the rate of dH/dp along (dH/dp, p'); H is the energy. */
static void compare_hamilton(const char *name, const nh_reduction *r, const nh_hamilton *h, const size_t *shape, const nh_ex *generator)
{
    const nh_kinetic *k = r->kinetic;
    size_t m = k->m, n = h->n, d = h->d, width = 2 * n + d;
    double *q = nh_alloc_array(3 * m + 4 * width + m * m + m * d + 4 * n + 2, sizeof *q), *v = q + m, *a = v + m, *z = a + m, *rate = z + width, *at = rate + width, *K = at + width, *E = K + m * m,
           *speed = E + m * d, *second = speed + n, *value = second + n;
    const double step = 1e-3, weight[4] = {1. / 12, -2. / 3, 2. / 3, -1. / 12}, times[4] = {-2, -1, 1, 2};
    for (size_t p = 0; p < 3; p++) {
        memcpy(q, k->place + p * m, m * sizeof *q);
        allowed(k, q, p, v);
        acceleration(k, q, v, a);
        nh_kinetic_values(k, m * m, k->K, q, K);
        if (d) nh_kinetic_values(k, m * d, generator, q, E);
        double energy = 0, V, H, largest = 0;
        nh_kinetic_values(k, 1, &k->V, q, &V);
        memset(z, 0, width * sizeof *z);
        for (size_t i = 0; i < m * m; i++) {
            energy += 0.5 * v[i / m] * K[i] * v[i % m];
            for (size_t b = 0; b < d; b++) z[2 * n + b] += E[b * m + i / m] * K[i] * v[i % m]; /* m_b = e_b . p */
        }
        for (size_t i = 0; i < n; i++) z[i] = q[shape[i]], speed[i] = v[shape[i]];
        momenta_of(r, h, speed, z);
        at_state(r, h, 1, &h->H, z, &H);
        cr_expect_float_eq(H, energy + V, 1e-10 * (1 + fabs(energy)), "%s: H = %g, the energy is %g", name, H, energy + V);
        at_state(r, h, n, h->speed, z, rate);
        at_state(r, h, n, h->rate, z, rate + n);
        memset(second, 0, n * sizeof *second);
        for (size_t i = 0; i < 4; i++) {
            for (size_t j = 0; j < width; j++) at[j] = z[j] + times[i] * step * (j < 2 * n ? rate[j] : 0);
            at_state(r, h, n, h->speed, at, value);
            for (size_t j = 0; j < n; j++) second[j] += weight[i] * value[j] / step;
        }
        for (size_t i = 0; i < m; i++) largest = fmax(largest, fabs(a[i]));
        for (size_t i = 0; i < n; i++)
            cr_expect_float_eq(second[i], a[shape[i]], 1e-7 * (1 + largest), "%s, place %zu: %s'' = %.9g, in the whole system %.9g", name, p, k->name[shape[i]], second[i], a[shape[i]]);
    }
    nh_free(q);
}

/* Stages whose shape coordinates the groups leave alone: x'' is that of the whole system.  The ball's second stage has (ii) in the weak form only. */
Test(reduce_papers, Hamiltons_form_has_the_accelerations_of_the_whole_system)
{
    static const struct {
        const char *system;
        bool second, bent; /* Upsilon does not vanish */
    } cases[] = {{"crane", true, true}, {"euler_disk", false, true}, {"chaplygin_ball", true, true}, {"two_wheel_cart", false, true}, {"rolling_disk", false, true}, {"cart_rotor", true, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", cases[i].system);
        nh_reduction *r = reduce_path(path, NULL, false);
        nh_hamilton h;
        const nh_chaplygin *c = r->stage[0].chaplygin;
        cr_assert(c && nh_hamilton_of_first(&h, r->arena, c), "%s", path);
        compare_hamilton(path, r, &h, c->slice->shape, NULL);
        bool bent = false;
        for (size_t k = 0; k < h.n * h.n; k++) bent |= !nh_is_zero(h.dag, h.form[k]);
        cr_expect_eq(bent, cases[i].bent, "%s: Upsilon", path);
        if (cases[i].second) {
            const nh_second *t = r->stage[1].second;
            size_t shape[8], n = t->n, m = r->kinetic->m;
            cr_assert(r->stage[1].kind == NH_STAGE_SECOND && nh_hamilton_of_second(&h, r->arena, t), "%s", path);
            nh_ex *generator = nh_alloc_array(m * t->d, sizeof *generator);
            for (size_t s = 0; s < m * t->d; s++) generator[s] = nh_int(h.dag, 0);
            for (size_t a = 0; a < t->d; a++)
                for (size_t s = 0; s < c->n; s++) generator[a * m + c->slice->shape[s]] = t->action.generator[a].component[s];
            for (size_t s = 0; s < n; s++) shape[s] = c->slice->shape[t->slice.shape[s]];
            compare_hamilton(path, r, &h, shape, generator);
            nh_free(generator);
        }
        nh_reduction_free(r);
    }
}

/* The printed lines: of a skate with a spring on its axle, z' = y x' by hand: H = p_x^2/(2 (1 + y^2)) + p_y^2/2, Upsilon_xy = -y x' with J = z' and B_xy = -dz'/dy. */
Test(reduce_papers, Hamiltons_form_is_printed)
{
    nh_reduction *r = reduce_text("name: p\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints:\n  - z' = y*x'\n", false);
    nh_text text;
    nh_text_init(&text);
    nh_reduction_write(r, NULL, (nh_pen_style){.form = NH_PEN_TEXT, .verbose = true}, &text);
    const char *s = nh_text_string(&text);
    cr_expect(strstr(s, "\nHamilton's form\n  x'^i=dH/dp_i, p'_i=-dH/dx^i+Upsilon_i,j x'^j"), "%s", s);
    cr_expect(strstr(s, "H = (p_y^2 + p_x^2/(y^2 + 1))/2"), "%s", s);
    cr_expect(strstr(s, "Upsilon_x,y = y x'"), "%s", s);
    nh_text_clear(&text);
    nh_reduction_free(r);
}

/* ---- metric, locked inertia, Helmholtz's conditions: the formulas of the JSON ---- */

static bool any_name(void *dag, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    (void)fault;
    *out = nh_symbol(dag, name);
    return true;
}

typedef struct {
    nh_dag *dag;
    size_t count;
    nh_ex in[64];
    double value[64];
} names;

static void give(names *n, double value, const char *format, const char *name)
{
    char text[80];
    snprintf(text, sizeof text, format, name);
    n->in[n->count] = nh_symbol(n->dag, text);
    n->value[n->count++] = value;
}

/* The parameters of a reduction, its coordinates and velocities. */
static names names_at(const nh_reduction *r, const double *q, const double *v)
{
    names n = {.dag = nh_dag_create()};
    for (size_t i = 0; i < r->system->parameters; i++) give(&n, r->system->parameter[i].value, "%s", r->system->parameter[i].name);
    for (size_t s = 0; s < r->kinetic->m; s++) give(&n, q[s], "%s", r->kinetic->name[s]), give(&n, v[s], "%s'", r->kinetic->name[s]);
    return n;
}

static double value_of(const names *n, const cJSON *item)
{
    nh_ex e;
    nh_parse_fault fault;
    double out;
    cr_assert(cJSON_IsString(item) && nh_parse(n->dag, item->valuestring, any_name, n->dag, &e, &fault), "%s", cJSON_IsString(item) ? item->valuestring : "no text");
    nh_tape *tape = nh_tape_create(n->dag, n->count, n->in, 1, &e, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, n->value, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

static cJSON *json_of(const nh_reduction *r)
{
    char *text = nh_reduction_json(r, NULL);
    cJSON *out = cJSON_Parse(text);
    nh_free(text);
    cr_assert_not_null(out);
    return out;
}

/* L at (q, v): the file's Lagrangian, or that of its bodies. */
static double lagrangian(const nh_reduction *r, const double *q, const double *v)
{
    const nh_kinetic *k = r->kinetic;
    size_t m = k->m;
    nh_ex in[32];
    double at[32], out;
    memcpy(in, k->q, m * sizeof *in), memcpy(in + m, k->v, m * sizeof *in);
    memcpy(at, q, m * sizeof *at), memcpy(at + m, v, m * sizeof *at);
    nh_tape *tape = nh_tape_create(k->dag, 2 * m, in, 1, &r->system->lagrangian, r->system->parameters, k->model->parameter, k->model->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, at, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

/* K(X, Y) = (L(X + Y) - L(X - Y))/2 for L = 1/2 v K v - V. */
static double polarised(const nh_reduction *r, const double *q, const double *X, const double *Y)
{
    double sum[16], less[16];
    for (size_t s = 0; s < r->kinetic->m; s++) sum[s] = X[s] + Y[s], less[s] = X[s] - Y[s];
    return (lagrangian(r, q, sum) - lagrangian(r, q, less)) / 2;
}

/* The metric of the crane, 8 x 8, and of others against L of their velocities; the locked inertia of the whole group against L along its fields, at a
 * place of the slice. */
Test(reduce_papers, metric_and_locked_inertia_are_the_kinetic_energy)
{
    static const char *const systems[] = {"crane", "crane_lagrangian", "euler_disk", "two_wheel_cart"};
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", systems[i]);
        nh_reduction *r = reduce_path(path, NULL, false);
        cJSON *json = json_of(r);
        const cJSON *metric = oracle_get(json, "metric");
        size_t m = r->kinetic->m;
        double q[16], zero[16] = {0}, X[16], Y[16];
        const nh_reduction_stage *s = &r->stage[r->stages - 1];
        memcpy(q, r->kinetic->place, m * sizeof *q);
        cr_assert_eq((size_t)cJSON_GetArraySize(metric), m);
        names n = names_at(r, q, zero);
        for (size_t a = 0; a < m * m; a++) {
            memset(X, 0, sizeof X), memset(Y, 0, sizeof Y);
            X[a / m] = Y[a % m] = 1;
            double want = polarised(r, q, X, Y), got = value_of(&n, cJSON_GetArrayItem(cJSON_GetArrayItem(metric, (int)(a / m)), (int)(a % m)));
            cr_expect_float_eq(got, want, 1e-12 * (1 + fabs(want)), "%s: K_%zu,%zu is %.15g, not %.15g", path, a / m, a % m, got, want);
        }
        const nh_slice *slice = s->shown_slice;
        double y[16], E[128];
        nh_kinetic_values(r->kinetic, slice->d, slice->y, q, y);
        for (size_t a = 0; a < slice->d; a++) q[slice->along[a]] = y[a];
        nh_action_values(slice->action, q, E);
        const cJSON *locked = oracle_get(cJSON_GetArrayItem(oracle_get(json, "stages"), (int)r->stages - 1), "locked_inertia");
        cr_assert_eq((size_t)cJSON_GetArraySize(locked), slice->d);
        for (size_t a = 0; a < slice->d * slice->d; a++) {
            double want = polarised(r, q, E + a / slice->d * m, E + a % slice->d * m),
                   got = value_of(&n, cJSON_GetArrayItem(cJSON_GetArrayItem(locked, (int)(a / slice->d)), (int)(a % slice->d)));
            cr_expect_float_eq(got, want, 1e-12 * (1 + fabs(want)), "%s: I_%zu is %.15g, not %.15g", path, a, got, want);
        }
        nh_dag_free(n.dag);
        cJSON_Delete(json);
        nh_reduction_free(r);
    }
}

/* F_i = d/dt dLhat/dx'^i - dLhat/dx^i along the true motion through (x, x'), Lhat = 1/2 x' Khat x' - V with Khat of the lifted velocities. */
static void force_of(const nh_reduction *r, const nh_chaplygin *c, const double *q, const double *speed, double *F)
{
    const nh_kinetic *k = r->kinetic;
    size_t n = c->n, m = k->m, f = k->f, cell = n * n + 1;
    nh_ex *e = nh_alloc_array(cell, sizeof *e);
    double *om = nh_alloc_array(f * m + f * f + f + 2 * m + cell * (n + 1) + 1, sizeof *om), *matrix = om + f * m, *right = matrix + f * f, *v = right + f, *a = v + m, *z = a + m;
    size_t along[16], g = 0;
    nh_kinetic_values(k, f * m, k->omega, q, om);
    for (size_t s = 0; s < m; s++) { /* the velocity of the whole system that the constraints add */
        bool shape = false;
        for (size_t i = 0; i < n; i++)
            if (c->slice->shape[i] == s) shape = true, v[s] = speed[i];
        if (!shape) along[g++] = s;
    }
    for (size_t i = 0; i < f; i++) {
        for (size_t j = 0; j < f; j++) matrix[i + j * f] = om[i * m + along[j]];
        for (size_t j = 0; j < n; j++) right[i] -= om[i * m + c->slice->shape[j]] * speed[j];
    }
    cr_assert(g == f && nh_solve(f, matrix, 1, right, NULL));
    for (size_t j = 0; j < f; j++) v[along[j]] = right[j];
    acceleration(k, q, v, a);
    memcpy(e, c->K, n * n * sizeof *e);
    e[n * n] = c->V;
    nh_kinetic_values(k, cell, e, q, z);
    for (size_t i = 0; i < n; i++) slope(k, cell, e, q, c->slice->shape[i], z + cell * (i + 1));
    for (size_t i = 0; i < n; i++) {
        F[i] = z[cell * (i + 1) + n * n];
        for (size_t j = 0; j < n; j++) {
            F[i] += z[i * n + j] * a[c->slice->shape[j]];
            for (size_t l = 0; l < n; l++) F[i] += (z[cell * (l + 1) + i * n + j] - 0.5 * z[cell * (i + 1) + j * n + l]) * speed[j] * speed[l];
        }
    }
    nh_free(e);
    nh_free(om);
}

Test(reduce_papers, Helmholtzs_conditions_are_those_of_the_force_of_the_whole_system)
{
    static const char *const systems[] = {"crane", "euler_disk", "two_wheel_cart", "vertical_disk"};
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", systems[i]);
        nh_reduction *r = reduce_path(path, NULL, false);
        cJSON *json = json_of(r);
        const nh_chaplygin *c = r->stage[0].chaplygin;
        size_t n = c->n, m = r->kinetic->m, listed = 0;
        const double *q = r->kinetic->place + m;
        double speed[8], v[16] = {0}, slope_of[64] = {0}, plus[8], less[8];
        for (size_t j = 0; j < n; j++) speed[j] = v[c->slice->shape[j]] = 0.4 + 0.3 * (double)j;
        for (size_t j = 0; j < n; j++) { /* F is quadratic: a central difference is exact but for rounding */
            double at[8];
            memcpy(at, speed, sizeof at);
            at[j] += 0.5, force_of(r, c, q, at, plus);
            at[j] -= 1, force_of(r, c, q, at, less);
            for (size_t l = 0; l < n; l++) slope_of[l * n + j] = plus[l] - less[l];
        }
        names given = names_at(r, q, v);
        const cJSON *conditions = oracle_get(cJSON_GetArrayItem(oracle_get(json, "stages"), 0), "helmholtz_conditions");
        bool holds = true;
        for (size_t a = 0; a < n; a++)
            for (size_t b = a; b < n; b++) {
                double want = slope_of[a * n + b] + slope_of[b * n + a], got = 0;
                const cJSON *item;
                cJSON_ArrayForEach(item, oracle_get(conditions, "symmetric"))
                {
                    if (strcmp(oracle_get(item, "i")->valuestring, r->kinetic->name[c->slice->shape[a]]) || strcmp(oracle_get(item, "j")->valuestring, r->kinetic->name[c->slice->shape[b]])) continue;
                    got = value_of(&given, oracle_get(item, "value"));
                    listed++;
                }
                holds &= fabs(want) < 1e-7;
                cr_expect_float_eq(got, want, 1e-7 * (1 + fabs(want)), "%s: dF_%zu/dx'^%zu + .. is %.12g, not %.12g", path, a, b, got, want);
            }
        cr_expect_eq(cJSON_IsTrue(oracle_get(conditions, "holds")), holds, "%s: holds", path);
        cr_expect_eq((size_t)cJSON_GetArraySize(oracle_get(conditions, "symmetric")), listed);
        nh_dag_free(given.dag);
        cJSON_Delete(json);
        nh_reduction_free(r);
    }
}

/* ---- what the constraints integrate to ---- */

/* e_j projected to ker omega. */
static void projected(const nh_kinetic *k, const double *q, size_t j, double *X)
{
    size_t m = k->m, f = k->f;
    double *om = nh_alloc_array(f * m + f * f + f + 1, sizeof *om), *gram = om + f * m, *c = gram + f * f;
    nh_kinetic_values(k, f * m, k->omega, q, om);
    memset(X, 0, m * sizeof *X);
    X[j] = 1;
    for (size_t a = 0; a < f; a++) {
        c[a] = om[a * m + j];
        for (size_t b = 0; b < f; b++)
            for (size_t s = 0; s < m; s++) gram[a + b * f] += om[a * m + s] * om[b * m + s];
    }
    cr_assert(nh_solve(f, gram, 1, c, NULL));
    for (size_t a = 0; a < f; a++)
        for (size_t s = 0; s < m; s++) X[s] -= om[a * m + s] * c[a];
    nh_free(om);
}

/* [X_word[0], [X_word[1], ..]] of these fields, by differences of order four. */
static void iterated(const nh_kinetic *k, const double *q, size_t length, const size_t *word, double *out)
{
    const double h = 0.02, weight[4] = {1. / 12, -2. / 3, 2. / 3, -1. / 12}, step[4] = {-2, -1, 1, 2};
    double X[16], Y[16], at[16], value[16];
    if (length == 1) {
        projected(k, q, word[0], out);
        return;
    }
    projected(k, q, word[0], X);
    iterated(k, q, length - 1, word + 1, Y);
    memset(out, 0, k->m * sizeof *out);
    for (size_t i = 0; i < 4; i++) {
        for (size_t s = 0; s < k->m; s++) at[s] = q[s] + step[i] * h * X[s];
        iterated(k, at, length - 1, word + 1, value);
        for (size_t s = 0; s < k->m; s++) out[s] += weight[i] / h * value[s];
        for (size_t s = 0; s < k->m; s++) at[s] = q[s] + step[i] * h * Y[s];
        projected(k, at, word[0], value);
        for (size_t s = 0; s < k->m; s++) out[s] -= weight[i] / h * value[s];
    }
}

static size_t rank_of(size_t m, size_t n, const double *a)
{
    double *out = nh_alloc_array(m * m, sizeof *out);
    size_t rank = nh_span(m, n, a, 1e-4, out);
    nh_free(out);
    return rank;
}

/* The growth vector by brackets in numbers; sums that are constant, along allowed velocities; momenta, by the accelerations. */
Test(reduce_papers, what_is_integrable_in_the_distribution_is_said)
{
    static const struct {
        const char *system;
        size_t length, rank[4], leaves, momenta;
    } cases[] = {{"crane", 3, {4, 5, 7}, 1, 1}, {"two_wheel_cart", 3, {2, 3, 4}, 1, 0}, {"sleigh", 2, {2, 3}, 0, 0}, {"euler_disk", 3, {3, 4, 5}, 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", cases[i].system);
        nh_reduction *r = reduce_path(path, NULL, false);
        const nh_kinetic *k = r->kinetic;
        size_t m = k->m, word[3], n = 0, found = 0;
        const double *q = k->place;
        double *all = nh_alloc_array(m * (m + m * m + m * m * m), sizeof *all), v[16], a[16];
        cr_assert_eq(r->growth.length, cases[i].length, "%s", path);
        for (size_t length = 1; length <= cases[i].length; length++) {
            size_t words = length == 1 ? m : length == 2 ? m * m : m * m * m;
            for (size_t w = 0; w < words; w++) {
                word[0] = w % m, word[1] = w / m % m, word[2] = w / m / m;
                if (length > 1 && word[length - 1] <= word[length - 2]) continue;
                iterated(k, q, length, word, all + m * n++);
            }
            cr_expect_eq(rank_of(m, n, all), cases[i].rank[length - 1], "%s: rank %zu", path, rank_of(m, n, all));
            cr_expect_eq(r->growth.rank[length - 1], cases[i].rank[length - 1], "%s", path);
        }
        cr_expect_eq(r->leaf_count, cases[i].leaves, "%s", path);
        for (size_t p = 0; p < 4; p++) {
            allowed(k, q, p, v);
            acceleration(k, q, v, a);
            for (size_t j = 0; j < r->leaf_count; j++) {
                double along = 0, size = 0;
                for (size_t s = 0; s < m; s++) {
                    double slope_of;
                    slope(k, 1, &r->leaf[j], q, s, &slope_of);
                    along += slope_of * v[s], size = fmax(size, fabs(slope_of * v[s]));
                }
                cr_expect(size > 0.01 && fabs(along) < 1e-10 * size, "%s: %g of %g", path, along, size);
            }
            for (size_t j = 0; j < r->momenta.count; j++) {
                const nh_momentum *P = &r->momenta.momentum[j];
                const double h = 1e-3;
                double rate = 0, value = 0, weight[4] = {1. / 12, -2. / 3, 2. / 3, -1. / 12}, step[4] = {-2, -1, 1, 2};
                nh_ex in[32];
                memcpy(in, k->q, m * sizeof *in), memcpy(in + m, k->v, m * sizeof *in);
                nh_tape *tape = nh_tape_create(k->dag, 2 * m, in, 1, &P->value, r->system->parameters, k->model->parameter, k->model->parameter_value);
                nh_tape_work *work = nh_tape_work_create(tape);
                for (size_t t = 0; t < 4; t++) {
                    double at[32];
                    for (size_t s = 0; s < m; s++) at[s] = q[s] + step[t] * h * v[s], at[m + s] = v[s] + step[t] * h * a[s];
                    nh_tape_eval(tape, work, at, &value);
                    rate += weight[t] / h * value;
                }
                cr_expect(fabs(rate) < 1e-8 * (1 + fabs(value)), "%s: momentum %zu changes by %g", path, j + 1, rate);
                found += p == 0 && P->of_lagrangian && P->proof.all_parameters;
                nh_tape_work_free(work);
                nh_tape_free(tape);
            }
        }
        cr_expect_eq(found, cases[i].momenta, "%s: %zu momenta of L", path, found);
        nh_free(all);
        nh_reduction_free(r);
    }
}

/* Both facts about the crane stand on the first screen, and in --details. */
Test(reduce_papers, the_integral_of_the_crane_is_on_the_first_screen)
{
    nh_reduction *r = reduce_path("systems/crane.yaml", NULL, false);
    for (int verbose = 0; verbose < 2; verbose++) {
        nh_text text;
        nh_text_init(&text);
        nh_reduction_write(r, NULL, (nh_pen_style){.form = NH_PEN_TEXT, .verbose = verbose}, &text);
        const char *s = nh_text_string(&text);
        cr_expect(strstr(s, "  b*(psi2 - psi3) + 2*c*(theta + psi1)\n"), "%s", s);
        cr_expect(strstr(s, "4,5,7 of 8, so it is not bracket generating (proved)"), "%s", s);
        cr_expect(strstr(s, "(theta' + psi1')*("), "%s", s);
        nh_text_clear(&text);
    }
    nh_reduction_free(r);
}

/* ---- names, and the slice ---- */

static size_t occurrences(const char *text, const char *words)
{
    size_t n = 0;
    for (const char *at = strstr(text, words); at; at = strstr(at + 1, words)) n++;
    return n;
}

/* Parameters that are called as momenta and velocities of the reduced equations would be: these get other names, in text and JSON. */
Test(reduce_papers, names_of_the_file_are_not_given_to_anything_else)
{
    static const char *const taken[] = {"p_h", "m_1", "zeta_1", "v1", "H", "zeta1", "mu_3", "p_x_r"};
    nh_reduction *r = reduce_text("name: names\nparameters: {m: 2, J: 0.7, a: 0.5, b: 0.8, p_h: 0.4, m_1: 0.6, zeta_1: 0.05, v1: 0.1, H: 0.3, zeta1: 0.2, mu_3: 0.3, p_x_r: 1}\n"
                                  "bodies:\n  - {name: cart, mass: m, inertia: [0, 0, J + v1 + H + zeta1 + mu_3], center: [a, 0, 0]}\n  - {name: rod, mass: 0.4*p_x_r, inertia: [0, 0, p_h + m_1 + zeta_1]}\n"
                                  "joints:\n  - {type: planar, child: cart, coordinates: [x, y, h]}\n  - {type: revolute, parent: cart, child: rod, at: [b, 0, 0], axis: z, coordinates: [s]}\n"
                                  "wheels:\n  - {type: knife-edge, body: cart, axis: y}\ndomain: {h: [-1.2, 1.2]}\n", false);
    nh_text text;
    nh_text_init(&text);
    nh_reduction_write(r, NULL, (nh_pen_style){.form = NH_PEN_TEXT, .verbose = true}, &text);
    const char *s = strstr(nh_text_string(&text), "\nReduced equations"); /* behind the parameters' values */
    cr_assert_not_null(s);
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) {
        char words[40];
        snprintf(words, sizeof words, "\n  %s = ", taken[i]);
        cr_expect_eq(occurrences(s, words), 0, "%s is defined again", taken[i]);
    }
    cr_expect(occurrences(s, "\n  p_h_r = ") == 2 && occurrences(s, "\n  m_1_r = ") == 1 && occurrences(s, "\n  mu_3_r = ") == 1 && occurrences(s, "\n  zeta_1_r = ") == 1, "%s", s);
    cr_expect(occurrences(s, "\n  H_r = ") == 2, "%s", s);
    cJSON *json = json_of(r);
    const cJSON *stage, *item;
    cJSON_ArrayForEach(stage, oracle_get(json, "stages"))
    {
        cJSON_ArrayForEach(item, oracle_get(stage, "momentum"))
            for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) cr_expect(strcmp(oracle_get(item, "of")->valuestring, taken[i]), "%s", taken[i]);
        cJSON_ArrayForEach(item, oracle_get(stage, "velocities"))
            for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) cr_expect(strcmp(item->valuestring, taken[i]), "%s", taken[i]);
    }
    cJSON_Delete(json);
    nh_text_clear(&text);
    nh_reduction_free(r);
}

/* Every stage says on which slice its equations hold, and which shape coordinates the group moves: a ball on a slope, turned by the spin about its own axis. */
Test(reduce_papers, the_slice_is_named)
{
    static const char *const systems[] = {"crane", "euler_disk", "ball_on_slope"};
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", systems[i]);
        nh_reduction *r = reduce_path(path, NULL, false);
        nh_text text;
        nh_text_init(&text);
        nh_reduction_write(r, NULL, (nh_pen_style){.form = NH_PEN_TEXT, .verbose = true}, &text);
        const char *s = nh_text_string(&text);
        cr_expect_eq(occurrences(s, "\n  Slice: "), r->stages, "%s: %zu slices of %zu stages", path, occurrences(s, "\n  Slice: "), r->stages);
        cJSON *json = json_of(r);
        for (size_t k = 0; k < r->stages; k++) {
            const nh_slice *slice = r->stage[k].shown_slice;
            const cJSON *moved = oracle_get(cJSON_GetArrayItem(oracle_get(json, "stages"), (int)k), "moved");
            int want = 0;
            double E[256];
            nh_action_values(slice->action, slice->kinetic->place, E);
            for (size_t c = 0; c < slice->n; c++) {
                double size = 0;
                for (size_t a = 0; a < slice->d; a++) size = fmax(size, fabs(E[a * slice->m + slice->shape[c]]));
                want += size > 0;
            }
            cr_expect_eq(cJSON_GetArraySize(moved), want, "%s, stage %zu", path, k + 1);
            if (want) cr_expect(strstr(s, ": values on it of "), "%s", s);
        }
        cJSON_Delete(json);
        nh_text_clear(&text);
        nh_reduction_free(r);
    }
}

/* Where the group moves a coordinate its value on the slice has a name of its own: the rates of the JSON in these names are those of the stage. */
Test(reduce_papers, moved_coordinates_have_names_of_their_own)
{
    static const struct {
        const char *system, *moved;
    } cases[] = {{"ball_on_turntable", "x"}, {"ball_on_slope", "theta"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[100], own[40];
        snprintf(path, sizeof path, "systems/%s.yaml", cases[i].system);
        snprintf(own, sizeof own, "%s_s", cases[i].moved);
        nh_reduction *r = reduce_path(path, NULL, false);
        cJSON *json = json_of(r);
        const cJSON *stage = cJSON_GetArrayItem(oracle_get(json, "stages"), 0), *item;
        const nh_reduced *o = r->stage[0].shown;
        bool found = false;
        cJSON_ArrayForEach(item, oracle_get(stage, "shape"))
        {
            found |= !strcmp(item->valuestring, own);
            cr_expect(strcmp(item->valuestring, cases[i].moved), "%s: %s", path, item->valuestring);
        }
        cr_expect(found, "%s: no %s", path, own);
        names given = {.dag = nh_dag_create()};
        double at[16], F[8];
        nh_ex in[16];
        size_t k = 0;
        for (size_t p = 0; p < r->system->parameters; p++) give(&given, r->system->parameter[p].value, "%s", r->system->parameter[p].name);
        for (size_t s = 0; s < o->n; s++) in[k] = o->x[s], at[k++] = 0.7 + 0.2 * (double)s;
        for (size_t s = 0; s < o->r; s++) in[k] = o->w[s], at[k++] = 0.3 - 0.5 * (double)s;
        for (size_t s = 0; s < o->n; s++) give(&given, at[s], "%s", cJSON_GetArrayItem(oracle_get(stage, "shape"), (int)s)->valuestring);
        for (size_t s = 0; s < o->r; s++) give(&given, at[o->n + s], "%s", cJSON_GetArrayItem(oracle_get(stage, "velocities"), (int)s)->valuestring);
        nh_tape *tape = nh_tape_create(r->kinetic->dag, k, in, o->r, o->F, r->system->parameters, r->kinetic->model->parameter, r->kinetic->model->parameter_value);
        nh_tape_work *work = nh_tape_work_create(tape);
        nh_tape_eval(tape, work, at, F);
        cr_assert_eq((size_t)cJSON_GetArraySize(oracle_get(stage, "equations")), o->r);
        for (size_t s = 0; s < o->r; s++) {
            double got = value_of(&given, oracle_get(cJSON_GetArrayItem(oracle_get(stage, "equations"), (int)s), "rate"));
            cr_expect_float_eq(got, F[s], 1e-10 * (1 + fabs(F[s])), "%s: rate %zu is %g, not %g", path, s, got, F[s]);
        }
        nh_tape_work_free(work);
        nh_tape_free(tape);
        nh_dag_free(given.dag);
        cJSON_Delete(json);
        nh_reduction_free(r);
    }
}

/* ---- signs ---- */

/* [X, Y]^s = X(Y^s) - Y(X^s), as `explain bracket` says: X(Y(f)) - Y(X(f)) of a coordinate f, by differences of the fields of the JSON. */
Test(reduce_papers, brackets_have_the_sign_that_explain_gives)
{
    static const char *const systems[] = {"crane", "euler_disk", "rolling_ball"};
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        char path[100];
        snprintf(path, sizeof path, "systems/%s.yaml", systems[i]);
        nh_reduction *r = reduce_path(path, NULL, false);
        const nh_kinetic *k = r->kinetic;
        cJSON *json = json_of(r);
        const cJSON *fields = oracle_get(oracle_get(json, "group"), "generators"), *item, *c;
        size_t m = k->m, seen = 0;
        double zero[16] = {0}, at[16];
        const double h = 1e-4, *q = k->place;
        size_t d = r->all->action.d;
        for (size_t a = 0; a < d; a++)
            for (size_t b = a + 1; b < d; b++) {
                double want[16] = {0}, got[16] = {0}, size = 0;
                for (int sign = -1; sign <= 1; sign += 2)
                    for (size_t which = 0; which < 2; which++) { /* along X the field Y, along Y the field X, less */
                        size_t along = which ? b : a, of = which ? a : b;
                        names here = names_at(r, q, zero);
                        for (size_t s = 0; s < m; s++) {
                            const cJSON *e = cJSON_GetObjectItem(cJSON_GetArrayItem(fields, (int)along), k->name[s]);
                            at[s] = q[s] + sign * h * (e ? value_of(&here, e) : 0);
                        }
                        names there = names_at(r, at, zero);
                        for (size_t s = 0; s < m; s++) {
                            const cJSON *e = cJSON_GetObjectItem(cJSON_GetArrayItem(fields, (int)of), k->name[s]);
                            want[s] += (which ? -1 : 1) * sign * (e ? value_of(&there, e) : 0) / (2 * h);
                        }
                        nh_dag_free(here.dag), nh_dag_free(there.dag);
                    }
                cJSON_ArrayForEach(item, oracle_get(oracle_get(json, "group"), "brackets"))
                {
                    const cJSON *pair = oracle_get(item, "of");
                    if (cJSON_GetArrayItem(pair, 0)->valueint != (int)a + 1 || cJSON_GetArrayItem(pair, 1)->valueint != (int)b + 1) continue;
                    names here = names_at(r, q, zero);
                    cJSON_ArrayForEach(c, oracle_get(item, "is"))
                        for (size_t s = 0; s < m; s++) {
                            const cJSON *e = cJSON_GetObjectItem(cJSON_GetArrayItem(fields, atoi(c->string) - 1), k->name[s]);
                            got[s] += value_of(&here, c) * (e ? value_of(&here, e) : 0);
                        }
                    nh_dag_free(here.dag);
                    seen++;
                }
                for (size_t s = 0; s < m; s++) size = fmax(size, fabs(want[s]));
                for (size_t s = 0; s < m; s++) cr_expect_float_eq(got[s], want[s], 1e-5 * (1 + size), "%s: [e_%zu,e_%zu] along %s is %g, not %g", path, a + 1, b + 1, k->name[s], got[s], want[s]);
            }
        cr_expect(seen >= 2, "%s: %zu brackets", path, seen);
        cJSON_Delete(json);
        nh_reduction_free(r);
    }
}
