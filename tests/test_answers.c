/* From null vectors to statements: echelon form, recognition of numbers, independence, proofs, unknown frequencies. */
#include "families.h"
#include "sweep.h"

#include <stdio.h>

#include "graph/dag.h"
#include "graph/function.h"
#include "integrals/independence.h"
#include "integrals/real_where.h"
#include "integrals/prove.h"
#include "integrals/symmetry.h"
#include "integrals/gradient_rank.h"
#include "integrals/recognise.h"
#include "integrals/unknowns.h"
#include "system/sample.h"

/* ---- echelon ---- */

/* The candidates of a list of families, refined. */
static nh_candidates *candidates_of(const nh_model *o, const nh_points *points, size_t count, const nh_family *family)
{
    nh_error error = {0};
    nh_options options = defaults();
    nh_nullspace_options limits = nh_nullspace_options_from(&options);
    nh_ansatz *a = ansatz_of(o, points, count, family);
    nh_rows *rows = nh_rows_create(o, a, 0, NULL);
    nh_equations *equations = nh_equations_create(a->columns, 1);
    nh_rows_current(rows, points, NULL, equations);
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, &error);
    must(s != NULL, &error, "the null space");
    nh_candidates *c = nh_echelon(o, points, a, s, s->dimension, &options);
    for (size_t i = 0; i < c->count; i++) nh_echelon_refine(o, points, &c->candidate[i], &options);
    nh_nullspace_free(s);
    nh_equations_free(equations);
    nh_rows_free(rows);
    nh_ansatz_free(a);
    return c;
}

static nh_ex assemble(const nh_model *o, const nh_candidate *c)
{
    nh_ex e = nh_int(o->dag, 0);
    for (size_t i = 0; i < c->count; i++) e = nh_add(o->dag, e, nh_mul(o->dag, nh_real(o->dag, c->coefficient[i]), c->term[i]));
    return e;
}

static const char OSCILLATOR[] = PARTICLE("oscillator", "") "parameters: [{name: c, value: 1.7}]\nlagrangian: (x'^2 + y'^2)/2 - c^2/2*(x^2 + y^2)\n";

/* Two energies, their mixture and the angular momentum among 15 monomials: each with two or three terms, coefficients to rounding. */
Test(echelon, sparse_representatives)
{
    static const char *const expected[] = {"x*y' - y*x'", "x'^2 + c^2*x^2", "y'^2 + c^2*y^2", "x'*y' + c^2*x*y"};
    mechanics x = mechanics_of_text(OSCILLATOR, NH_CHART_AUTO);
    nh_points *points = points_of(x.model, 256, 1);
    nh_ex in[] = {formula(x.model, "x"), formula(x.model, "y"), formula(x.model, "x'"), formula(x.model, "y'")};
    nh_family quadratic = {.kind = NH_POLYNOMIAL, .in_count = 4, .in = in, .degree = 2};
    nh_candidates *c = candidates_of(x.model, points, 1, &quadratic);
    cr_assert_eq(c->count, 4);
    for (size_t i = 0; i < 4; i++) {
        const nh_candidate *k = &c->candidate[i];
        double nearest = INFINITY;
        for (size_t j = 0; j < 4; j++) nearest = fmin(nearest, off_multiple(x.model, points, assemble(x.model, k), formula(x.model, expected[j])));
        cr_expect_eq(k->count, 2, "candidate %zu has %zu terms", i, k->count);
        cr_expect(nearest < 3e-15, "candidate %zu is off by %.1e", i, nearest);
        cr_expect(k->refitted && k->quotient < 1e-14 && k->coefficient[k->pivot] == 1);
    }
    nh_candidates_free(c);
    nh_points_free(points);
    mechanics_clear(&x);
}

/* The same current comes out whatever columns surround it, in any order of the families. */
Test(echelon, the_sleighs_currents_in_a_crowd)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    const nh_model *o = x.model;
    nh_points *points = points_of(o, 400, 1);
    families f;
    families_of(o, &f);
    f.wave.degree = 1;
    nh_family mixed[] = {f.product[0], f.wave}, crowd[] = {{.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = mixed}, f.velocities, f.high};
    nh_family back[] = {crowd[2], crowd[1], crowd[0]};
    const char *expected[] = {"E", PHI2, PHI2B};
    for (int order = 0; order < 2; order++) {
        nh_candidates *c = candidates_of(o, points, 3, order ? back : crowd);
        cr_assert_eq(c->count, 3);
        for (size_t j = 0; j < 3; j++) {
            double nearest = INFINITY;
            for (size_t i = 0; i < 3; i++) nearest = fmin(nearest, off_multiple(o, points, assemble(o, &c->candidate[i]), formula(o, expected[j])));
            cr_expect(nearest < 1e-14, "%s is off by %.1e", expected[j], nearest);
            cr_expect_eq(c->candidate[j].count, 2);
        }
        nh_candidates_free(c);
    }
    nh_points_free(points);
    mechanics_clear(&x);
}

/* ---- recognition ---- */

static bool is_ratio(double value, int64_t most, int64_t p, int64_t q)
{
    nh_num r;
    return nh_recognise_ratio(value, most, 1e-12, &r) && r.p == p && r.q == q;
}

Test(recognise, ratios)
{
    nh_num r;
    cr_expect(is_ratio(355.0 / 113 * (1 + 1e-14), 400, 355, 113));
    cr_expect(is_ratio(-8.0 / 399, 400, -8, 399));
    cr_expect(is_ratio(1e6 + 0.5, 400, 2000001, 2));
    cr_expect(is_ratio(0, 400, 0, 1));
    cr_expect(is_ratio(-3, 1, -3, 1));
    cr_expect_not(nh_recognise_ratio(acos(-1), 400, 1e-12, &r));
    cr_expect_not(nh_recognise_ratio(1.0 / 401, 400, 1e-12, &r));
    cr_expect_not(nh_recognise_ratio(0.5 * (1 + 1e-11), 400, 1e-12, &r));
    cr_expect_not(nh_recognise_ratio(NAN, 400, 1e-12, &r));
    cr_expect_not(nh_recognise_ratio(INFINITY, 400, 1e-12, &r));
    cr_expect_not(nh_recognise_ratio(1e-13, 400, 1e-12, &r)); /* small is not zero */
}

Test(recognise, numbers)
{
    nh_dag *d = nh_dag_create();
    nh_ex e;
    cr_assert(nh_recognise_number(d, -sqrt(6.0 / 7), 1e-12, &e));
    cr_expect_eq(e, nh_neg(d, nh_sqrt(d, nh_ratio(d, 6, 7))));
    cr_assert(nh_recognise_number(d, 2.0 / 3, 1e-12, &e));
    cr_expect_eq(e, nh_ratio(d, 2, 3));
    cr_expect_not(nh_recognise_number(d, exp(1), 1e-12, &e));
    cr_expect_not(nh_recognise_number(d, 0.123456789, 1e-12, &e));
    nh_dag_free(d);
}

enum { SETS = 9 };

/* c = -5/3 p^2 q^(-3/2), and what is no monomial. */
Test(recognise, monomials)
{
    nh_dag *d = nh_dag_create();
    nh_ex symbol[] = {nh_symbol(d, "p"), nh_symbol(d, "q")}, e = 0;
    double p[2 * SETS], c[SETS], noisy[SETS], sum[SETS];
    uint64_t state = 4;
    for (size_t s = 0; s < SETS; s++) {
        p[2 * s] = 1 + nh_random(&state);
        p[2 * s + 1] = 2 + nh_random(&state);
        c[s] = -5.0 / 3 * p[2 * s] * p[2 * s] * pow(p[2 * s + 1], -1.5);
        noisy[s] = c[s] * (1 + (s == 5) * 1e-8); /* one set that does not fit */
        sum[s] = p[2 * s] + p[2 * s + 1];
    }
    cr_assert(nh_recognise_monomial(d, SETS, 2, symbol, p, c, 1e-10, &e));
    nh_ex want = nh_mul(d, nh_ratio(d, -5, 3), nh_mul(d, nh_powi(d, symbol[0], 2), nh_pow(d, symbol[1], nh_ratio(d, -3, 2))));
    cr_expect_eq(e, want);
    cr_expect_not(nh_recognise_monomial(d, SETS, 2, symbol, p, noisy, 1e-10, &e));
    cr_expect_not(nh_recognise_monomial(d, SETS, 2, symbol, p, sum, 1e-10, &e));
    cr_expect_not(nh_recognise_monomial(d, 3, 2, symbol, p, c, 1e-10, &e)); /* three values fit anything */
    c[4] = -c[4];
    cr_expect_not(nh_recognise_monomial(d, SETS, 2, symbol, p, c, 1e-10, &e));
    nh_dag_free(d);
}

/* ---- independence ---- */

Test(independence, functions_of_what_was_found_are_seen)
{
    static const char *const text[] = {"E", PHI2, PHI2B, "E^2 - 3*(" PHI2 ")", "t*sqrt(E)", "exp(" PHI2 ")*E", "2.5", "x + 1e-4*y", "x", "y"};
    const nh_independence want[] = {NH_INDEPENDENT, NH_INDEPENDENT, NH_DEPENDENT, NH_DEPENDENT, NH_INDEPENDENT, NH_DEPENDENT, NH_CONSTANT, NH_INDEPENDENT,
                                    NH_INDEPENDENT, NH_DEPENDENT};
    enum { COUNT = sizeof want / sizeof *want };
    mechanics x = sleigh(1.3, 0.7, 1.5);
    nh_points *points = points_of(x.model, 24, 6);
    nh_independence got[COUNT];
    nh_ex phi[COUNT];
    double fraction[COUNT];
    for (size_t i = 0; i < COUNT; i++) phi[i] = formula(x.model, text[i]);
    nh_independence_test(x.model, points, COUNT, phi, NULL, 1e-2, 1e-6, got, fraction);
    for (size_t i = 0; i < COUNT; i++) cr_expect_eq(got[i], want[i], "%s is %d, %.2e", text[i], (int)got[i], fraction[i]);
    cr_expect(fabs(fraction[8] - 1e-4) < 1e-5, "%g", fraction[8]);
    nh_points_free(points);
    mechanics_clear(&x);
}

/* Functions of one function, that are never both real: the second was "independent", at points where the first has no value.  What is real beside
 * each of them is still independent. */
Test(independence, what_is_real_elsewhere_is_no_evidence)
{
    static const char *const list[][2] = {{"omega*exp(log(v))/v^3", "omega*exp(log(-v))/v^3"}, {"log(omega)", "log(-omega)"}, {"sqrt(x - 0.1)", "sqrt(0.1 - x)"},
                                          {"exp(3*log(omega/v))", "exp(3*log(-omega/v))"}, {"sqrt(1 - 4*x^2)", "sqrt(4*x^2 - 1)"}, {"asin(2*x)", "acosh(2*x)"},
                                          {"(x*y)^(3/4)", "(-x*y)^(1/4)"}};
    mechanics x = sleigh(1.3, 0.7, 1.5);
    nh_points *points = points_of(x.model, 24, 6);
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_ex phi[] = {formula(x.model, list[i][0]), formula(x.model, list[i][1]), formula(x.model, "phi + t"), formula(x.model, "sqrt(-1 - y^2)")};
        bool exact[] = {true, true, true, true};
        nh_independence got[4];
        nh_independence_test(x.model, points, 4, phi, exact, 1e-2, 1e-6, got, NULL);
        cr_expect_eq(got[0], NH_INDEPENDENT, "%s", list[i][0]);
        cr_expect_neq(got[1], NH_INDEPENDENT, "%s", list[i][1]);
        cr_expect_eq(got[2], NH_INDEPENDENT, "beside %s", list[i][0]);
        cr_expect_eq(got[3], NH_DOUBTFUL, "real nowhere: %d", (int)got[3]);
    }
    nh_points_free(points);
    mechanics_clear(&x);
}

/* A root that is real in the whole sampling box, and not beyond it, has its condition, too: v < 2 k with |v| <= 1.5. */
Test(independence, where_roots_are_real_beyond_the_box)
{
    static const char *const roots[] = {"sqrt(v)*sqrt(2*k - v)", "sqrt(v)*sqrt(7 - v)", "sqrt(v)*log(9 + x)", "sqrt(v)*sqrt(5 - omega^2)"};
    mechanics x = sleigh(1.3, 0.7, 1.5);
    for (size_t i = 0; i < 4; i++) {
        nh_ex positive[NH_MOST_REAL_WHERE];
        cr_expect_eq(nh_real_where(x.model, formula(x.model, roots[i]), positive), 2u, "%s", roots[i]);
    }
    nh_ex none[NH_MOST_REAL_WHERE];
    cr_expect_eq(nh_real_where(x.model, formula(x.model, "sqrt(1 + v^2)*log(2 + x^2)"), none), 0u);
    mechanics_clear(&x);
}

/* Implicit velocities: the gradient is that on the submanifold, where u depends on the rest. */
Test(independence, on_an_implicit_submanifold)
{
    mechanics x = mechanics_of_text(PROJECTILE_IMPLICIT, NH_CHART_COORDINATES);
    nh_points *points = points_of(x.model, 24, 6);
    nh_ex phi[] = {formula(x.model, "x'"), formula(x.model, "y'"), formula(x.model, "x'^2 + y'^2"), formula(x.model, "y")};
    const nh_independence want[] = {NH_INDEPENDENT, NH_DEPENDENT, NH_CONSTANT, NH_INDEPENDENT};
    nh_independence got[4];
    double fraction[4];
    nh_independence_test(x.model, points, 4, phi, NULL, 1e-2, 1e-6, got, fraction);
    for (size_t i = 0; i < 4; i++) cr_expect(got[i] == want[i] || (want[i] == NH_CONSTANT && got[i] == NH_DEPENDENT), "%zu is %d, %.2e", i, (int)got[i], fraction[i]);
    nh_points_free(points);
    mechanics_clear(&x);
}

/* ---- proofs ---- */

static nh_proof proof_of(const nh_model *o, const char *text, bool free)
{
    nh_options options = defaults();
    return nh_prove_current(o, formula(o, text), free, &options);
}

#define R "sqrt(v^2/a^2 + k^2*omega^2)"
#define PHI3 "m*a^2*k^2/2*log((" R " + v/a)/(" R " - v/a)) - m*a^2*t*" R

Test(prove, true_currents_for_all_parameters)
{
    static const char *const text[] = {"E", PHI2, PHI2B, PHI3, "E^2*(" PHI2 ")"};
    mechanics x = sleigh(1.3, 0.7, 1.5);
    for (size_t i = 0; i < 5; i++) {
        nh_proof p = proof_of(x.model, text[i], true), fixed = proof_of(x.model, text[i], false);
        cr_expect(p.proved && p.all_parameters && !p.refuted, "%s", text[i]);
        cr_expect(p.points >= 4 && p.digits >= 60, "%s: %g digits at %zu points", text[i], p.digits, p.points);
        cr_expect(fixed.proved && !fixed.all_parameters, "%s: all parameters were not asked for", text[i]);
    }
    mechanics_clear(&x);
}

/* Of a long energy too the symmetry is d/dt; of constraints that depend on time it is not, though no work is done. */
static void expect_translation(const mechanics *x, bool expected)
{
    nh_options options = defaults();
    nh_points *points = points_of(x->model, 12, 5);
    nh_symmetry z;
    nh_error error;
    nh_error_clear(&error);
    must(nh_symmetry_of(x->model, points, nh_neg(x->model->dag, x->model->E), options.same, &z, &error), &error, "energy");
    bool translation = nh_is_number(x->model->dag, z.Z0, 1);
    for (size_t s = 0; s < x->model->m; s++) translation &= nh_is_zero(x->model->dag, z.field.space[s]) && nh_is_zero(x->model->dag, z.coordinate_rate[s]);
    cr_expect_eq(translation && z.kase == 1 && z.bracket_in_distribution && z.projectable, expected);
    cr_expect_lt(z.noether_residual, 1e-8, "%g", z.noether_residual);
    nh_points_free(points);
}

/* The rate of a snake's energy is too long for a normal form: what the equations of motion say of it is the proof. */
Test(prove, energy_of_long_equations, PLAIN_ONLY)
{
    static const char *const text =
        "name: snake\nparameters: {m: 1.3, J: 0.4, l: 0.7}\ncoordinates: [x, y, {name: h, type: angle}, {name: a, type: angle}, {name: b, type: angle}]\n"
        "definitions: [\"vx = x' - l*h'*sin(h) - l*(h'+a')*sin(h+a)\", \"vy = y' + l*h'*cos(h) + l*(h'+a')*cos(h+a)\", "
        "\"ux = x' + l*h'*sin(h) + l*(h'+b')*sin(h+b)\", \"uy = y' - l*h'*cos(h) - l*(h'+b')*cos(h+b)\"]\n"
        "lagrangian: m/2*(x'^2 + y'^2 + vx^2 + vy^2 + ux^2 + uy^2) + J/2*(h'^2 + (h'+a')^2 + (h'+b')^2)%s\n"
        "constraints: [\"y'*cos(h) = %s\", \"vy*cos(h+a) = vx*sin(h+a)\", \"uy*cos(h+b) = ux*sin(h+b)\"]\n"
        "domain: {a: [0.3, 0.9], b: [0.4, 1.1]}\n";
    static const struct {
        const char *lagrangian, *constraint;
        bool conserved, translation;
    } more[] = {{"", "x'*sin(h)", true, true}, {" - m*x*t", "x'*sin(h)", false, false}, {"", "x'*sin(h) + l/9", false, false}, {"", "(1 + t/9)*x'*sin(h)", true, false}};
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
        char file[1200];
        snprintf(file, sizeof file, text, more[i].lagrangian, more[i].constraint);
        mechanics x = mechanics_of_text(file, NH_CHART_AUTO);
        nh_options options = defaults();
        nh_proof p = nh_prove_current(x.model, x.model->E, true, &options);
        cr_expect(more[i].conserved ? p.proved && p.all_parameters && p.digits > 60 : p.refuted && !p.proved, "%zu: %g", i, p.digits);
        if (more[i].conserved) expect_translation(&x, more[i].translation);
        mechanics_clear(&x);
    }
}

Test(prove, for_the_given_parameters_only)
{
    mechanics x = sleigh(2, 1, 1);
    nh_proof p = proof_of(x.model, "m*v*sin(phi) + m*a*omega*cos(phi)", true);
    cr_expect(p.proved && !p.all_parameters && !p.refuted && p.digits >= 60, "%g", p.digits);
    mechanics_clear(&x);
}

Test(prove, false_ones_are_refuted)
{
    static const char *const text[] = {"E + omega/1000", "omega", PHI2 " + 1e-12*v", "m*v*sin(phi/k) + m*a*k*omega*cos(1.0000001*phi/k)", "t"};
    mechanics x = sleigh(1.3, 0.7, 1.5);
    for (size_t i = 0; i < 5; i++) {
        nh_proof p = proof_of(x.model, text[i], true);
        cr_expect(!p.proved && !p.all_parameters && p.refuted && p.digits < 25 && p.points >= 4, "%s: %g digits", text[i], p.digits);
    }
    mechanics_clear(&x);
}

/* However small or large the box is, the points differ, so that what is false is refuted. */
Test(prove, false_ones_are_refuted_in_boxes_of_any_size)
{
    static const double size[] = {1e-12, 1e-7, 1e-3, 1, 1e5, 1e12};
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        char text[600];
        snprintf(text, sizeof text,
                 "name: box\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\nlagrangian: (x'^2 + y'^2)/2\n"
                 "domain: {x: [%g, %g], y: [%g, %g], x': [%g, %g], y': [%g, %g]}\n",
                 -size[i], size[i], -size[i], size[i], -size[i], size[i], -size[i], size[i]);
        mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
        nh_proof good = proof_of(x.model, "x*y' - y*x'", true), bad = proof_of(x.model, "x*x' - y*y'", true), worse = proof_of(x.model, "x*y' - 1.001*y*x'", true);
        cr_expect(good.proved && good.points >= 4, "%g", size[i]);
        cr_expect(bad.refuted && bad.digits < 5 && bad.points >= 4, "%g: %g digits at %zu points", size[i], bad.digits, bad.points);
        cr_expect(worse.refuted && worse.digits < 5, "%g: %g digits", size[i], worse.digits);
        mechanics_clear(&x);
    }
}

/* The number of digits says how far from true a near-integral is. */
Test(prove, digits_measure_the_distance)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    double rough = proof_of(x.model, PHI2 " + 1e-6*v", true).digits, fine = proof_of(x.model, PHI2 " + 1e-15*v", true).digits;
    cr_expect(rough > 4 && rough < 8, "%g", rough);
    cr_expect(fine > 13 && fine < 17, "%g", fine);
    mechanics_clear(&x);
}

/* With implicit velocities nothing is proved, but digits are certified: to those of the velocities, refined in ball arithmetic. */
Test(prove, implicit_velocities)
{
    mechanics x = mechanics_of_text(PROJECTILE_IMPLICIT, NH_CHART_COORDINATES);
    nh_proof good = proof_of(x.model, "t + v0/g*atanh(y'/v0)", true), bad = proof_of(x.model, "t + v0/g*atanh(y'/v0) + 1e-9*x", true);
    cr_expect(good.digits >= 50 && !good.refuted && good.points >= 4, "%g digits", good.digits);
    cr_expect(bad.refuted && bad.digits < 12, "%g digits", bad.digits);
    mechanics_clear(&x);
}

/* ---- unknown frequencies ---- */

typedef struct {
    nh_ex velocity[2], angle, nu, wave[4];
    nh_family part[2], family;
    nh_unknown unknown;
} search;

/* {omega, v} x {cos nu phi, sin nu phi}; as explicit terms the pencil does not apply. */
static void search_of(const nh_model *o, search *s, bool terms)
{
    nh_dag *d = o->dag;
    *s = (search){.velocity = {formula(o, "omega"), formula(o, "v")}, .angle = formula(o, "phi"), .nu = nh_symbol(d, "nu")};
    for (size_t i = 0; i < 4; i++) s->wave[i] = nh_mul(d, s->velocity[i / 2], nh_call(d, i % 2 ? NH_SIN : NH_COS, nh_mul(d, s->nu, s->angle)));
    s->part[0] = (nh_family){.kind = NH_TERMS, .terms = 2, .term = s->velocity};
    s->part[1] = (nh_family){.kind = NH_FOURIER, .in_count = 1, .in = &s->angle, .degree = 1, .frequency = s->nu};
    s->family = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = s->part};
    if (terms) s->family = (nh_family){.kind = NH_TERMS, .terms = 4, .term = s->wave};
    s->unknown = (nh_unknown){s->nu, 0.05, 3};
}

static nh_hits *hits_of(const nh_model *o, const search *s, uint64_t seed)
{
    nh_error error = {0};
    nh_options options = defaults();
    options.seed = (double)seed;
    nh_points *points = points_of(o, 128, seed);
    nh_hits *h = nh_unknowns_find(o, points, 1, &s->family, 1, &s->unknown, &options, &error);
    must(h != NULL, &error, "the search");
    nh_points_free(points);
    return h;
}

static const double SETS_OF_K[][3] = {{2, 1, 1}, {2, 1, 2}, {2, 1, 3}, {2, 1, 4}, {1.3, 0.7, 1.5}, {0.9, 2.385, 2.718}};

/* nu = 1/k, to 1e-10, by the pencil and by the search; both say so, and nothing else is found. */
Test(unknowns, the_sleighs_frequency)
{
    for (size_t i = 0; i < 6; i++)
        for (int terms = 0; terms < 2; terms++) {
            mechanics x = sleigh(SETS_OF_K[i][0], SETS_OF_K[i][1], SETS_OF_K[i][2]);
            double want = 1 / SETS_OF_K[i][2];
            search s;
            search_of(x.model, &s, terms);
            nh_hits *h = hits_of(x.model, &s, 1);
            cr_expect_eq(h->pencil_applied, !terms);
            cr_expect_eq(h->generic, 0);
            cr_assert_eq(h->count, 1, "k = %g: %zu values", SETS_OF_K[i][2], h->count);
            cr_expect(fabs(h->hit[0].value[0] / want - 1) < 1e-10, "k = %g: off by %.1e", SETS_OF_K[i][2], h->hit[0].value[0] / want - 1);
            size_t dimension = h->hit[0].dimension; /* the second value is null only where nu is right to the last digits */
            cr_expect(h->hit[0].by_search && h->hit[0].by_pencil == !terms && (dimension == 2 || (terms && dimension == 1)), "k = %g: search %d, pencil %d, dimension %zu",
                      SETS_OF_K[i][2], h->hit[0].by_search, h->hit[0].by_pencil, h->hit[0].dimension);
            cr_expect(h->hit[0].difference < 1e-10, "pencil and search differ by %.1e", h->hit[0].difference);
            nh_hits_free(h);
            mechanics_clear(&x);
        }
}

Test(unknowns, the_pencil_alone)
{
    nh_options options = defaults();
    for (size_t i = 0; i < 6; i++) {
        mechanics x = sleigh(SETS_OF_K[i][0], SETS_OF_K[i][1], SETS_OF_K[i][2]);
        double value[4];
        bool applied;
        search s;
        search_of(x.model, &s, false);
        nh_points *points = points_of(x.model, 128, 3);
        size_t n = nh_unknowns_pencil(x.model, points, 1, &s.family, &s.unknown, &options, 4, value, &applied);
        cr_assert(applied && n == 1);
        cr_expect(fabs(value[0] * SETS_OF_K[i][2] - 1) < 1e-12, "off by %.1e", value[0] * SETS_OF_K[i][2] - 1);
        s.unknown.low = 1.2 / SETS_OF_K[i][2];
        cr_expect_eq(nh_unknowns_pencil(x.model, points, 1, &s.family, &s.unknown, &options, 4, value, &applied), 0);
        nh_points_free(points);
        mechanics_clear(&x);
    }
}

/* Bounds that exclude 1/k: nothing is found, and the best value is far from zero. */
Test(unknowns, nothing_where_there_is_nothing)
{
    mechanics x = sleigh(1.3, 0.7, 1.5);
    search s;
    search_of(x.model, &s, false);
    s.unknown.low = 0.8;
    nh_hits *h = hits_of(x.model, &s, 1);
    cr_expect(h->count == 0 && h->best > 1e-4, "%zu values, best %.1e", h->count, h->best);
    nh_hits_free(h);
    mechanics_clear(&x);
}

/* Gradients that differ by little: doubles doubt, balls prove; with fitted numbers what is left has to be larger than their errors. */
Test(independence, small_differences_are_decided)
{
    mechanics x = mechanics_of_text(PARTICLE("free", "") "lagrangian: (x'^2 + y'^2)/2\n", NH_CHART_AUTO);
    nh_points *points = points_of(x.model, 24, 3);
    nh_dag *d = x.model->dag;
    nh_ex first = formula(x.model, "x'"), near = formula(x.model, "x' + y'/10000"), nearer = formula(x.model, "x' + y'/10^12"), root = formula(x.model, "sqrt(x'^2)*3 + x'^2");
    nh_ex fitted = nh_add(d, first, nh_mul(d, nh_real(d, 1.2345678901e-9), formula(x.model, "y'"))), loose = nh_add(d, first, nh_mul(d, nh_real(d, 1.2345678901e-3), formula(x.model, "y'")));
    const struct {
        nh_ex phi;
        nh_rank_answer answer;
        bool proved;
    } asked[] = {{near, NH_RANK_GROWS, true}, {nearer, NH_RANK_GROWS, true}, {root, NH_RANK_STAYS, false}, {fitted, NH_RANK_STAYS, false}, {loose, NH_RANK_GROWS, false}};
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        nh_ex pair[2] = {first, asked[i].phi};
        nh_rank rank = nh_rank_decide(x.model, 1, pair, 1e-6);
        cr_expect(rank.answer == asked[i].answer && rank.proved == asked[i].proved, "%zu: %d", i, (int)rank.answer);
        cr_expect(rank.answer != NH_RANK_STAYS || rank.digits > 6, "%zu: %g digits", i, rank.digits);
    }
    nh_ex pair[2] = {first, near};
    nh_independence kind[2];
    nh_independence_test(x.model, points, 2, pair, NULL, 1e-2, 1e-6, kind, NULL);
    cr_expect(kind[0] == NH_INDEPENDENT && kind[1] == NH_INDEPENDENT, "%d %d", (int)kind[0], (int)kind[1]);
    /* 1e-12 may be the error of a fit; of what is exact it is no error */
    pair[1] = nearer;
    for (int known = 0; known < 4; known++) {
        bool exact[2] = {known & 1, known & 2};
        nh_independence_test(x.model, points, 2, pair, exact, 1e-2, 1e-6, kind, NULL);
        cr_expect_eq(kind[1], known == 3 ? NH_INDEPENDENT : NH_DEPENDENT, "%d: %d", known, (int)kind[1]);
    }
    nh_independence_test(x.model, points, 2, pair, NULL, 1e-2, 1e-6, kind, NULL);
    cr_expect_eq(kind[1], NH_DEPENDENT);
    nh_points_free(points);
    mechanics_clear(&x);
}
