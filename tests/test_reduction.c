/* reduction: reduced motions with reconstruction against the motion in all coordinates. */
#include "oracle.h"
#include "reduced.h"
#include "sweep.h"

#include <stdio.h>
#include <stdlib.h>

#include "motion/integrators.h"
#include "motion/dynamics.h"
#include "reduction/chaplygin.h"
#include "reduction/group.h"
#include "reduction/group_flow.h"
#include "reduction/linear.h"
#include "reduction/momenta.h"
#include "reduction/reconstruct.h"
#include "reduction/second.h"
#include "reduction/subspace.h"

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
    nh_motion *motion = nh_cvode(&problem, z, count, times, &options, &error);
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
    must(nh_action_check(&action, &options, &error), &error, name);
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
    nh_reconstruction *r = nh_reconstruct(&reduced, &slice, z, count, times, &(nh_reconstruct_how){.tolerance = options.tolerance, .steps = options.steps}, &error);
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

Test(reduction, equations_on_a_slice_and_reconstruction_agree_with_the_full_motion, PLAIN_ONLY)
{
    master_against_full("crane, d = 4", CRANE, NULL, 4, CRANE_FOUR, 2, 1e-10);
    master_against_full("crane, d = 6", CRANE, NULL, 6, FIRST, 2, 1e-10);
    master_against_full("snakeboard", SNAKEBOARD, NULL, 4, FIRST, 0.5, 1e-10);
    master_against_full("cart", CART, NULL, 5, FIRST, 2, 1e-10);
    master_against_full("twisted cart", TWISTED_CART, NULL, 5, FIRST, 1, 1e-10);
    master_against_full("disk", DISK, NULL, 4, FIRST, 0.3, 1e-10);
    master_against_full("Chaplygin ball", NULL, "systems/chaplygin_ball.yaml", 3, FIRST, 0.5, 1e-10);
    master_against_full("rotations", ROTATIONS, NULL, 3, FIRST, 1, 1e-10);
    master_against_full("top", NULL, "systems/euler_top.yaml", 3, FIRST, 0.5, 1e-10);
    master_against_full("Routh sphere", NULL, "systems/routh_sphere.yaml", 4, FIRST, 0.5, 1e-10);
    master_against_full("sleigh", NULL, "systems/sleigh_inertia.yaml", 3, FIRST, 5, 1e-10);
}

/* ---- Chaplygin ---- */

/* The Chaplygin stage of a system, by generators in the order in which they are found. */
typedef struct {
    reducible x;
    nh_group *g;
    nh_action action;
    nh_slice slice;
    nh_chaplygin c;
    nh_options options;
} stage;

static void stage_open(stage *s, const char *name, nh_system *system, const size_t *index, const double *q, nh_error *error)
{
    s->options = sharp();
    s->x = reducible_make(system, 5, error);
    s->g = nh_group_find(s->x.kinetic, &s->options, error);
    must(s->g != NULL, error, name);
    s->action = subgroup(s->g, s->x.kinetic->f, index, &s->options);
    cr_assert(s->action.chaplygin, "%s is no Chaplygin system", name);
    size_t shape[20], along[20];
    double y0[20];
    nh_slice_choose(&s->action, shape, along);
    for (size_t a = 0; a < s->action.d; a++) y0[a] = q ? q[along[a]] : 0;
    nh_slice_init(&s->slice, &s->action, shape, along, y0);
    if (!q && !nh_chaplygin_init(&s->c, &s->slice, error)) { /* zero is a pole of the coordinates */
        nh_error_clear(error);
        for (size_t a = 0; a < s->action.d; a++) y0[a] = s->x.kinetic->place[along[a]];
        nh_slice_init(&s->slice, &s->action, shape, along, y0);
    }
    must(nh_chaplygin_init(&s->c, &s->slice, error), error, name);
}

static void stage_close(stage *s)
{
    nh_action_clear(&s->action);
    nh_group_free(s->g);
    reducible_clear(&s->x);
}

/* At points and along the motions of the crane: every reduced number of the reference data. */
/* Ad of a product of exponentials, factor by factor by scaling and squaring. */
Test(reduction, factors_of_a_group_element)
{
    static const struct {
        const char *file;
        bool abelian;
    } cases[] = {{"systems/isotropic_oscillator.yaml", false}, {"systems/sleigh.yaml", false}, {"systems/crane.yaml", false}, {"systems/chaplygin_ball.yaml", false}, {"systems/kepler.yaml", false}, {"systems/contact_oscillator.yaml", true}};
    static const double parts[] = {0, 0.3, -1.7, 2.9, 11, 1e-9};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_error error = {0};
        nh_options options = sharp();
        reducible x = reducible_make(nh_system_read(cases[i].file, 0, NULL, &error), 3, &error);
        nh_group *g = nh_group_find(x.kinetic, &options, &error);
        must(g != NULL, &error, cases[i].file);
        nh_group_flow f;
        size_t d = g->action.d;
        double t[10], P[100], next[100], E[100], A[100];
        nh_group_flow_init(&f, &g->action, true);
        cr_expect_eq(f.abelian, cases[i].abelian, "%s", cases[i].file);
        for (size_t a = 0; a < d; a++) t[a] = parts[(a + i) % 6];
        for (size_t k = 0; k < d * d; k++) P[k] = k % (d + 1) == 0;
        for (size_t a = 0; a < d; a++) {
            for (size_t k = 0; k < d * d; k++) A[k] = t[a] * f.ad[a * d * d + k];
            nh_matrix_exp(d, A, E);
            nh_multiply(d, d, d, P, E, next);
            memcpy(P, next, d * d * sizeof *P);
        }
        nh_group_flow_factors(&f, t);
        for (size_t k = 0; k < d * d; k++) cr_expect_float_eq(f.P[k], P[k], 1e-13 * (1 + nh_largest(d * d, P)), "%s, %zu: %.17g, %.17g", cases[i].file, k, f.P[k], P[k]);
        nh_group_flow_clear(&f);
        nh_group_free(g);
        reducible_clear(&x);
    }
}

Test(reduction, crane_reference_values)
{
    nh_error error = {0};
    stage s;
    cJSON *data = oracle_read("tests/data/crane_oracle.json");
    const cJSON *set = oracle_get(data, "sets")->child;
    stage_open(&s, "crane", nh_system_parse("crane", CRANE, 0, NULL, &error), CRANE_FOUR, NULL, &error);
    cr_assert(s.slice.n == 4 && s.slice.shape[0] == 3 && s.slice.shape[1] == 4 && s.slice.shape[2] == 5 && s.slice.shape[3] == 7);
    static const size_t order[4] = {0, 2, 1, 3}; /* the data's psi1, psi2, phi1, phi2 */
    tally tK = {.what = "Khat"}, tp = {.what = "phat"}, tU = {.what = "Upsilon12"}, tF = {.what = "F_G"};
    nh_reduced_flow *flow = nh_reduced_flow_create(&s.c.reduced);
    for (const cJSON *point = oracle_get(set, "points")->child; point; point = point->next) {
        double q[8], v[8], u[8], w[4], K[16], J[16], U[64], want[16], got[16];
        oracle_flat(oracle_get(point, "q_full"), q);
        oracle_flat(oracle_get(point, "qdot_full"), v);
        nh_kinetic_values(s.x.kinetic, 16, s.c.K, q, K);
        nh_kinetic_values(s.x.kinetic, 16, s.c.J, q, J);
        nh_kinetic_values(s.x.kinetic, 64, s.c.U, q, U);
        oracle_flat(oracle_get(point, "Khat"), want);
        for (size_t i = 0; i < 16; i++) got[i] = K[order[i / 4] * 4 + order[i % 4]];
        tally_add(&tK, 16, got, want, 0);
        for (size_t i = 0; i < 4; i++) w[i] = v[s.slice.shape[i]];
        for (size_t i = 0; i < 4; i++) {
            got[i] = u[i] = 0;
            for (size_t j = 0; j < 4; j++) got[i] += K[order[i] * 4 + j] * w[j];
        }
        oracle_flat(oracle_get(point, "phat"), want);
        tally_add(&tp, 4, got, want, 0);
        got[0] = 0; /* Ups_12: psi1 and psi2 are the first and the third shape coordinate here */
        for (size_t k = 0; k < 4; k++) got[0] += U[(k * 4 + 0) * 4 + 2] * w[k];
        oracle_flat(oracle_get(point, "Upsilon12"), want);
        tally_add(&tU, 1, got, want, 0);
        for (size_t a = 0; a < 4; a++) { /* body momenta of d/dx, d/dy, d/dpsi3, rotation */
            got[a] = 0;
            for (size_t j = 0; j < 4; j++) got[a] += J[a * 4 + j] * w[j];
        }
        double x = got[2];
        got[2] = got[3], got[3] = x;
        oracle_flat(oracle_get(point, "F_G"), want);
        tally_add(&tF, 4, got, want, 0);
    }
    tally_check(&tK, 1e-12, "crane");
    tally_check(&tp, 1e-12, "crane");
    tally_check(&tU, 1e-11, "crane");
    tally_check(&tF, 1e-12, "crane");
    nh_reduced_flow_free(flow);
    cJSON_Delete(data);
    stage_close(&s);
}

/* The reduced motions with reconstruction, from initial states with any group coordinates. */
Test(reduction, crane_reference_motions, PLAIN_ONLY)
{
    nh_error error = {0};
    cJSON *data = oracle_read("tests/data/crane_oracle.json");
    tally tq = {.what = "q(T)"}, tz = {.what = "reduced"};
    for (const cJSON *motion = oracle_get(oracle_get(data, "sets")->child, "trajectories")->child; motion; motion = motion->next) {
        stage s;
        double q[8], v[8], w[4], x[4], z[8], want[12], got[12], times[2] = {0, oracle_number(motion, "T")};
        static const size_t order[4] = {0, 2, 1, 3}, group[4] = {0, 1, 2, 6};
        oracle_flat(oracle_get(motion, "q0"), q);
        oracle_flat(oracle_get(motion, "qdot0"), v);
        stage_open(&s, "crane", nh_system_parse("crane", CRANE, 0, NULL, &error), CRANE_FOUR, q, &error);
        for (size_t i = 0; i < 4; i++) w[i] = v[s.slice.shape[i]], x[i] = q[s.slice.shape[i]];
        cr_assert(nh_reduced_start(&s.c.reduced, x, w, z));
        nh_reconstruction *r = nh_reconstruct(&s.c.reduced, &s.slice, z, 2, times, &(nh_reconstruct_how){.tolerance = s.options.tolerance, .steps = s.options.steps}, &error);
        must(r && r->complete, &error, "the crane");
        oracle_flat(oracle_get(motion, "qT"), want);
        tally_add(&tq, 8, r->q + 8, want, 0);
        oracle_flat(oracle_get(motion, "reduced_T(psi1,psi2,phi1,phi2,phat1..4,x,y,theta,psi3)"), want);
        for (size_t i = 0; i < 4; i++) {
            got[i] = r->z[8 + order[i]];
            got[4 + i] = r->z[8 + 4 + order[i]];
            got[8 + i] = r->q[8 + group[i]];
        }
        tally_add(&tz, 12, got, want, 0);
        nh_reconstruction_free(r);
        stage_close(&s);
    }
    tally_check(&tq, 1e-10, "crane");
    tally_check(&tz, 1e-10, "crane");
    cJSON_Delete(data);
}

/* (2.11) with curvature, against Hamel's equations in the frame: two derivations of one right-hand side. */
static void chaplygin_against_master(const char *name, nh_system *system, const size_t *index, double tolerance)
{
    nh_error error = {0};
    stage s;
    stage_open(&s, name, system, index, NULL, &error);
    size_t independent[20], n = s.slice.n, used = 0;
    nh_reduced master;
    for (size_t i = 0; i < n; i++) independent[i] = i;
    must(nh_reduced_master(&master, &s.slice, independent, &error), &error, name);
    nh_reduced_flow *a = nh_reduced_flow_create(&master), *b = nh_reduced_flow_create(&s.c.reduced);
    double worst = 0, ups = 0;
    for (size_t p = 0; p < 20; p++) {
        double z[20], ra[20], rb[20], za[20], zb[20];
        for (size_t i = 0; i < n; i++) {
            z[i] = s.x.kinetic->place[p * s.slice.m + s.slice.shape[i]];
            z[n + i] = s.x.kinetic->speed[p * s.slice.m + i];
        }
        cr_assert(nh_reduced_flow_at(a, z, ra, NULL, za, NULL) && nh_reduced_flow_at(b, z, rb, NULL, zb, NULL));
        worst = fmax(worst, fmax(distance(2 * n, ra, rb), distance(s.action.d, za, zb)));
        double *U = nh_alloc_array(n * n * n, sizeof *U), q[20];
        nh_slice_place(&s.slice, z, q);
        nh_kinetic_values(s.x.kinetic, n * n * n, s.c.U, q, U);
        for (size_t i = 0; i < n * n * n; i++) ups = fmax(ups, fabs(U[i]));
        used++;
        nh_free(U);
    }
    cr_expect(worst < tolerance && used == 20, "%s: the two forms differ by %g", name, worst);
    cr_expect(ups > 1e-3, "%s has no curvature", name);
    if (getenv("NHSYM_TEST_FIGURES")) printf("%-30s (2.11) against the frame's equations: %.1e, |Ups| %.2g\n", name, worst, ups);
    nh_reduced_flow_free(a);
    nh_reduced_flow_free(b);
    stage_close(&s);
}

Test(reduction, almost_symplectic_equations_agree_with_those_in_the_frame, PLAIN_ONLY)
{
    static const size_t cart[] = {0, 1, 4}, ball[] = {0, 1}, particle[] = {1};
    nh_error error = {0};
    chaplygin_against_master("crane", nh_system_parse("crane", CRANE, 0, NULL, &error), CRANE_FOUR, 1e-10);
    chaplygin_against_master("cart", nh_system_parse("cart", CART, 0, NULL, &error), cart, 1e-10); /* Ups comes from the bracket alone */
    chaplygin_against_master("twisted cart", nh_system_parse("twisted", TWISTED_CART, 0, NULL, &error), (size_t[]){2, 3, 4}, 1e-10);
    chaplygin_against_master("Chaplygin ball", nh_system_read("systems/chaplygin_ball.yaml", 0, NULL, &error), ball, 1e-10);
    chaplygin_against_master("rotations", nh_system_parse("so3", ROTATIONS, 0, NULL, &error), (size_t[]){0, 1, 2}, 1e-10);
    chaplygin_against_master("particle", nh_system_read("systems/nonholonomic_particle.yaml", 0, NULL, &error), particle, 1e-10);
}

Test(reduction, measure_and_factor)
{
    static const size_t cart[] = {0, 1, 4}, two[] = {0, 1}, one[] = {0}, three[] = {0, 1, 2}, particle[] = {1};
    static const struct {
        const char *name, *text, *file;
        const size_t *index;
        bool measure, factor;
    } known[] = {{"particle", NULL, "systems/nonholonomic_particle.yaml", particle, true, true}, {"cart", CART, NULL, cart, true, true},
                 {"vertical disk", NULL, "systems/vertical_disk.yaml", two, true, true}, {"Chaplygin ball", NULL, "systems/chaplygin_ball.yaml", two, true, false},
                 {"sleigh", NULL, "systems/sleigh_inertia.yaml", one, false, false}, {"rotations", ROTATIONS, NULL, three, false, false},     {"crane", CRANE, NULL, CRANE_FOUR, false, false}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        nh_error error = {0};
        stage s;
        stage_open(&s, known[i].name, known[i].text ? nh_system_parse(known[i].name, known[i].text, 0, NULL, &error) : nh_system_read(known[i].file, 0, NULL, &error), known[i].index, NULL, &error);
        nh_chaplygin_measure m = nh_chaplygin_measure_of(&s.slice, s.c.K, s.c.U, &s.slice, s.c.K, s.c.U, &s.options);
        if (getenv("NHSYM_TEST_FIGURES")) printf("%-30s |Theta| %.2e, |dTheta| %.1e, phi-simple %.1e\n", known[i].name, m.size, m.curl, m.phi_simple);
        cr_expect_eq(m.measure, known[i].measure, "%s: measure, |dTheta| = %g", known[i].name, m.curl);
        cr_expect_eq(m.factor, known[i].factor, "%s: factor, %g", known[i].name, m.phi_simple);
        stage_close(&s);
    }
}

/* ---- the second stage ---- */

static void field_of(const stage *s, size_t index, nh_ex *out) { memcpy(out, s->g->action.generator[index].component, s->slice.m * sizeof *out); }

/* The second stage by generators of the whole group, on the slice through a place of the first shape space. */
static void second_open(nh_second *second, const stage *s, const char *name, size_t d, const size_t *index, const double *x, nh_error *error)
{
    nh_ex *field = nh_alloc_array(d * s->slice.m, sizeof *field);
    size_t shape[20], along[20];
    double y0[20];
    for (size_t b = 0; b < d; b++) field_of(s, index[b], field + b * s->slice.m);
    must(nh_second_init(second, &s->c, d, field, &s->options, error), error, name);
    nh_slice_choose(&second->action, shape, along);
    for (size_t a = 0; a < d; a++) y0[a] = x ? x[along[a]] : 0;
    must(nh_second_equations(second, shape, along, y0, error), error, name);
    nh_free(field);
}

/* p of the second stage from a state (x, w) of the first. */
static void second_start(const nh_second *t, const double *x, const double *w, double *z)
{
    double u[20], Av[100], x2[20], w2[20];
    cr_assert(nh_slice_components(&t->slice, x, w, u));
    nh_kinetic_values(t->hat, t->d * t->n, t->Av, x, Av);
    for (size_t i = 0; i < t->n; i++) x2[i] = x[t->slice.shape[i]], w2[i] = u[i];
    for (size_t a = 0; a < t->d; a++) {
        w2[t->n + a] = u[t->n + a];
        for (size_t i = 0; i < t->n; i++) w2[t->n + a] += Av[a * t->n + i] * u[i];
    }
    cr_assert(nh_reduced_start(&t->reduced, x2, w2, z));
}

Test(reduction, crane_twice_reduced_reference_values)
{
    nh_error error = {0};
    cJSON *data = oracle_read("tests/data/crane_oracle.json");
    tally tz = {.what = "twice reduced"}, ta = {.what = "Abreve, Xi"}, t0 = {.what = "start"};
    const cJSON *set = oracle_get(data, "sets")->child;
    static const size_t phi1[] = {2}, order[3] = {0, 1, 2};
    for (const cJSON *motion = oracle_get(set, "trajectories")->child; motion; motion = motion->next) {
        stage s;
        nh_second t;
        double q[8], v[8], x[4], w[4], z[8], want[6], got[6], times[2] = {0, oracle_number(motion, "T")};
        oracle_flat(oracle_get(motion, "q0"), q);
        oracle_flat(oracle_get(motion, "qdot0"), v);
        stage_open(&s, "crane", nh_system_parse("crane", CRANE, 0, NULL, &error), CRANE_FOUR, q, &error);
        for (size_t i = 0; i < 4; i++) w[i] = v[s.slice.shape[i]], x[i] = q[s.slice.shape[i]];
        second_open(&t, &s, "crane", 1, phi1, x, &error);
        cr_assert(t.n == 3 && t.slice.shape[0] == 0 && t.slice.shape[1] == 2 && t.slice.shape[2] == 3 && t.abelian);
        cr_expect(t.weak < 1e-12 && t.strong < 1e-12 && t.invariance < 1e-12);
        second_start(&t, x, w, z);
        oracle_flat(oracle_get(motion, "twice_reduced0(psi1,psi2,phi2,pc1,pc2,pcphi2)"), want);
        for (size_t i = 0; i < 6; i++) got[i] = z[i < 3 ? order[i] : 3 + order[i - 3]];
        tally_add(&t0, 6, got, want, 0);
        cr_expect_float_eq(z[6], oracle_number(motion, "vartheta"), 1e-12);
        nh_reconstruction *r = nh_reconstruct(&t.reduced, &t.slice, z, 2, times, &(nh_reconstruct_how){.tolerance = s.options.tolerance, .steps = s.options.steps}, &error);
        must(r && r->complete, &error, "the crane, twice reduced");
        oracle_flat(oracle_get(motion, "twice_reduced_T"), want);
        tally_add(&tz, 6, r->z + 7, want, 0);
        cr_expect_float_eq(r->z[13], z[6], 1e-11);
        nh_reconstruction_free(r);
        for (const cJSON *point = oracle_get(set, "points")->child; point; point = point->next) {
            double Av[3], B[9], abreve[4], at[4];
            oracle_flat(oracle_get(point, "q_full"), q);
            for (size_t i = 0; i < 4; i++) at[i] = q[s.slice.shape[i]];
            nh_kinetic_values(t.hat, 3, t.Av, at, Av);
            nh_kinetic_values(t.hat, 9, t.Bv, at, B);
            oracle_flat(oracle_get(point, "Abreve"), abreve);
            want[0] = abreve[0], want[1] = abreve[1], want[2] = oracle_number(point, "Xi12_over_vartheta");
            got[0] = Av[0], got[1] = Av[1], got[2] = B[1];
            tally_add(&ta, 3, got, want, 0);
        }
        nh_second_clear(&t);
        stage_close(&s);
    }
    tally_check(&tz, 1e-10, "crane");
    tally_check(&t0, 1e-12, "crane");
    tally_check(&ta, 1e-12, "crane");
    cJSON_Delete(data);
}

/* Twice reduced with reconstruction against once reduced; the spatial momentum is conserved. */
static void twice_against_once(const char *name, nh_system *system, const size_t *first, size_t d, const size_t *index, bool strong, double until, double tolerance)
{
    enum { count = 5 };
    nh_error error = {0};
    stage s;
    nh_second t;
    stage_open(&s, name, system, first, NULL, &error);
    size_t n = s.slice.n, m = s.slice.m;
    double x[20], w[20], z[40], times[count], E[60];
    for (size_t i = 0; i < n; i++) x[i] = s.x.kinetic->place[2 * m + s.slice.shape[i]], w[i] = s.x.kinetic->speed[2 * m + s.slice.shape[i]];
    second_open(&t, &s, name, d, index, x, &error);
    cr_expect_lt(t.weak, 1e-10, "%s: (ii) fails, %g", name, t.weak);
    cr_expect_eq(t.strong < 1e-10, strong, "%s: (ii') %g", name, t.strong);
    for (size_t i = 0; i < count; i++) times[i] = until * (double)i / (count - 1);
    second_start(&t, x, w, z);
    nh_reconstruction *r = nh_reconstruct(&t.reduced, &t.slice, z, count, times, &(nh_reconstruct_how){.tolerance = s.options.tolerance, .steps = s.options.steps}, &error);
    must(r && r->complete, &error, name);
    cr_assert(nh_reduced_start(&s.c.reduced, x, w, z));
    nh_reduced_flow *flow = nh_reduced_flow_create(&s.c.reduced);
    nh_flow_problem problem = nh_reduced_flow_problem(flow);
    nh_flow_options options = {.method = NH_ADAMS, .rtol = s.options.tolerance};
    nh_motion *once = nh_cvode(&problem, z, count, times, &options, &error);
    must(once && once->complete, &error, name);
    double off = 0, drift = 0, momentum[20], start[20], curvature[500], most = 0;
    for (size_t i = 0; i < count; i++) {
        const double *at = once->state + i * 2 * n;
        off = fmax(off, distance(n, r->q + i * n, at));
        nh_action_values(&t.action, at, E);
        for (size_t a = 0; a < d; a++) { /* e_a^s p_s */
            momentum[a] = 0;
            for (size_t k = 0; k < n; k++) momentum[a] += E[k + a * n] * at[n + k];
            if (i == 0) start[a] = momentum[a];
            drift = fmax(drift, fabs(momentum[a] - start[a]));
        }
    }
    nh_kinetic_values(t.hat, d * t.n * t.n, t.Bv, x, curvature);
    for (size_t i = 0; i < d * t.n * t.n; i++) most = fmax(most, fabs(curvature[i]));
    cr_expect(off < tolerance, "%s: %g from the once reduced motion", name, off);
    cr_expect(drift < tolerance, "%s: the momentum drifts by %g", name, drift);
    cr_expect(distance(n, r->q + (count - 1) * n, r->q) > 0.05, "%s: nothing moves", name);
    if (getenv("NHSYM_TEST_FIGURES"))
        printf("%-30s N of %zu, orbits of %zu: %.1e from once reduced, momentum drift %.1e, |Bv| %.2g, weak %.1e strong %.1e, %zu restarts\n", name, d, t.orbit, off, drift, most, t.weak, t.strong, r->restarts);
    nh_motion_free(once);
    nh_reduced_flow_free(flow);
    nh_reconstruction_free(r);
    nh_second_clear(&t);
    stage_close(&s);
}

Test(reduction, twice_reduced_motions_agree_with_once_reduced_ones, PLAIN_ONLY)
{
    nh_error error = {0};
    static const size_t ball[] = {0, 1}, turn[] = {2}, phi1[] = {2};
    twice_against_once("crane", nh_system_parse("crane", CRANE, 0, NULL, &error), CRANE_FOUR, 1, phi1, true, 2, 1e-10);
    twice_against_once("Chaplygin ball", nh_system_read("systems/chaplygin_ball.yaml", 0, NULL, &error), ball, 1, turn, false, 1, 1e-10);
}

/* Chaplygin's theorem: on the sphere, after the turn about the vertical, the ball is Hamiltonian in another time; on SO(3) it is not. */
Test(reduction, ball_becomes_hamiltonian_after_the_second_stage)
{
    nh_error error = {0};
    static const size_t plane[] = {0, 1}, turn[] = {2};
    stage s;
    nh_second t;
    stage_open(&s, "ball", nh_system_read("systems/chaplygin_ball.yaml", 0, NULL, &error), plane, NULL, &error);
    second_open(&t, &s, "ball", 1, turn, NULL, &error);
    nh_chaplygin_measure first = nh_chaplygin_measure_of(&s.slice, s.c.K, s.c.U, &s.slice, s.c.K, s.c.U, &s.options), second = nh_chaplygin_measure_of(&t.slice, t.Kt, t.U, &t.slice, t.Kt, t.U, &s.options);
    cr_expect(first.measure && !first.factor);
    cr_expect(second.measure && second.factor && second.size > 1e-3, "%g %g %g", second.curl, second.phi_simple, second.size);
    nh_second_clear(&t);
    stage_close(&s);
}

/* N = SO(3), not abelian: momentum on coadjoint orbits of dimension two, curved mechanical connection. */
Test(reduction, second_stage_with_a_rotation_group, PLAIN_ONLY)
{
    nh_error error = {0};
    static const size_t cart[] = {0, 1, 4}, rotations[] = {3, 5, 6};
    twice_against_once("cart and free body", nh_system_parse("body", CART_AND_BODY, 0, NULL, &error), cart, 3, rotations, true, 1, 1e-10);
}

/* ---- momenta ---- */

/* The current of a section of V in D is that of the constraint symmetry with Z^0 = 0 and the section as its part on configuration space. */
static void momenta_of(const char *name, nh_system *system, size_t count, size_t horizontal)
{
    nh_error error = {0};
    nh_options options = sharp();
    must(system != NULL, &error, name);
    nh_model *o = nh_model_create(system, nh_chart_create(system, NH_CHART_COORDINATES, 1, &error), &error);
    must(o != NULL, &error, name);
    nh_kinetic *k = nh_kinetic_create(o, 9, &error);
    nh_group *g = nh_group_find(k, &options, &error);
    must(g != NULL, &error, name);
    nh_momenta p;
    must(nh_momenta_find(&p, &g->action, &options, &error), &error, name);
    size_t constant = 0;
    nh_points *points = points_of(o, 30, 77);
    for (size_t i = 0; i < p.count; i++) {
        nh_symmetry z;
        nh_ex phi = nh_model_compose(o, p.momentum[i].value);
        constant += p.momentum[i].horizontal;
        cr_expect(p.momentum[i].proof.proved, "%s: momentum %zu", name, i);
        must(nh_symmetry_of(o, points, phi, 1e-9, &z, &error), &error, name);
        cr_expect(z.noether_residual < 1e-9, "%s: %g", name, z.noether_residual);
        double at[30], want[12], got[12];
        for (size_t n = 0; n < 10; n++) {
            point_of(points, n, at);
            cr_expect_float_eq(value_at(o, z.field.time, at), 0, 1e-9, "%s: Z^0", name);
            values_at(o, o->m, z.field.space, at, got);
            values_at(o, o->m, p.momentum[i].field, at, want);
            bool outside = !p.momentum[i].horizontal && !p.momentum[i].gauge; /* of D: the section is its projection */
            cr_expect(outside || distance(o->m, got, want) < 1e-9, "%s: the field of momentum %zu is another", name, i);
        }
    }
    cr_expect_eq(p.count, count, "%s: %zu momenta", name, p.count);
    cr_expect_eq(constant, horizontal, "%s: %zu horizontal symmetries", name, constant);
    nh_points_free(points);
    nh_group_free(g);
    nh_kinetic_free(k);
    nh_model_free(o);
    nh_system_free(system);
}

Test(reduction, conserved_momenta_come_from_constraint_symmetries, PLAIN_ONLY)
{
    nh_error error = {0};
    momenta_of("vertical disk", nh_system_read("systems/vertical_disk.yaml", 0, NULL, &error), 2, 0);
    momenta_of("snakeboard", nh_system_parse("snakeboard", SNAKEBOARD, 0, NULL, &error), 1, 1);
    momenta_of("Chaplygin ball", nh_system_read("systems/chaplygin_ball.yaml", 0, NULL, &error), 1, 0);
    momenta_of("rolling ball", nh_system_read("systems/rolling_ball.yaml", 0, NULL, &error), 2, 0);
    momenta_of("top", nh_system_read("systems/euler_top.yaml", 0, NULL, &error), 3, 3);
    momenta_of("sleigh", nh_system_read("systems/sleigh_inertia.yaml", 0, NULL, &error), 0, 0);
}

/* ---- Euler's disk ---- */

/* The motions of the reference data, found again from one shape coordinate and three velocities; the two linear integrals are not elementary. */
Test(reduction, disk_reference_motions)
{
    nh_error error = {0};
    static const char *const parameter[] = {"r", "e", "M", "I1", "I3", "g"};
    static const size_t all[] = {0, 1, 2, 3};
    cJSON *data = oracle_read("tests/data/disk_oracle.json");
    tally tz = {.what = "q(T)"}, te = {.what = "energy"};
    double drift = 0, change = 0;
    for (const cJSON *set = oracle_get(data, "sets")->child; set; set = set->next)
        for (const cJSON *motion = oracle_get(set, "trajectories")->child; motion; motion = motion->next) {
            nh_setting setting[6];
            for (size_t i = 0; i < 6; i++) setting[i] = (nh_setting){.name = parameter[i], .value = oracle_number(set, parameter[i])};
            reducible x = reducible_make(nh_system_parse("disk", DISK, 6, setting, &error), 3, &error);
            nh_options options = sharp();
            nh_group *g = nh_group_find(x.kinetic, &options, &error);
            must(g != NULL, &error, "disk");
            cr_assert_eq(g->action.d, 4);
            nh_action action = subgroup(g, 4, all, &options);
            size_t shape[5], along[5], independent[5];
            nh_slice slice;
            nh_reduced reduced;
            double z0[8], q[5], v[5], u[5], w[5], z[10], y0[5], want[8], times[2] = {0, oracle_number(motion, "T")}, c, s;
            oracle_flat(oracle_get(motion, "z0"), z0);
            memcpy(q, z0, sizeof q);
            c = cos(q[1]), s = sin(q[1]);
            memcpy(v, z0 + 5, 3 * sizeof *v);
            v[3] = -setting[0].value * v[2] * c;
            v[4] = -setting[0].value * v[2] * s;
            nh_slice_choose(&action, shape, along);
            for (size_t a = 0; a < 4; a++) y0[a] = q[along[a]];
            nh_slice_init(&slice, &action, shape, along, y0);
            nh_reduced_independent(&slice, independent);
            must(nh_reduced_master(&reduced, &slice, independent, &error), &error, "disk");
            cr_assert(slice.n == 1 && shape[0] == 0 && reduced.r == 3);
            cr_assert(nh_slice_components(&slice, q, v, u));
            for (size_t i = 0; i < 3; i++) w[i] = u[independent[i]];
            cr_assert(nh_reduced_start(&reduced, q, w, z));
            nh_reconstruction *r = nh_reconstruct(&reduced, &slice, z, 2, times, &(nh_reconstruct_how){.tolerance = options.tolerance, .steps = options.steps}, &error);
            must(r && r->complete, &error, "disk");
            oracle_flat(oracle_get(motion, "zT"), want);
            tally_add(&tz, 5, r->q + 5, want, 0);
            nh_reduced_flow *flow = nh_reduced_flow_create(&reduced);
            double energy, expected = oracle_number(motion, "E");
            cr_assert(nh_reduced_flow_at(flow, r->z + 4, NULL, NULL, NULL, &energy));
            tally_add(&te, 1, &energy, &expected, 0);
            nh_linear_momenta linear;
            nh_linear_momenta_find(&linear, &reduced, &options);
            cr_assert_eq(linear.count, 2, "off by %g", linear.off);
            drift = fmax(drift, fabs(nh_linear_momenta_drift(&linear, &reduced, 2, r->z)));
            for (size_t i = 0; i < 2; i++) change = fmax(change, fabs(r->z[4 + 1 + linear.index[i]] - r->z[1 + linear.index[i]]));
            nh_reduced_flow_free(flow);
            nh_reconstruction_free(r);
            nh_action_clear(&action);
            nh_group_free(g);
            reducible_clear(&x);
        }
    cr_expect(drift < 1e-9, "the linear currents drift by %g", drift);
    cr_expect(change > 0.1, "the momenta themselves change by %g only", change);
    tally_check(&tz, 1e-10, "disk");
    tally_check(&te, 1e-11, "disk");
    cJSON_Delete(data);
}
