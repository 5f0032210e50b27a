/* Power series modulo primes, adapted frames, and the count of polynomial integrals: against closed forms, published numbers, and attempts to break it. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <string.h>

#include "exact/normal.h"
#include "count/completeness.h"
#include "count/count_internal.h"
#include "integrals/region.h"
#include "graph/dag.h"
#include "problem/analysis_file.h"
#include "names.h"
#include "sweep.h"

/* ---- series ---- */

static nh_jet_ring *ring_of(size_t order)
{
    return nh_jet_ring_create(nh_prime_at(0), 3, (const size_t[]){1, 2, 1}, order);
}

static nh_residue *random_series(const nh_jet_ring *r, uint64_t seed)
{
    nh_residue *a = nh_alloc_array(r->size, sizeof *a);
    for (size_t e = 0; e < r->size; e++) a[e] = nh_residue_random(r->field, &seed);
    return a;
}

static bool equal(const nh_jet_ring *r, const nh_residue *a, const nh_residue *b) { return memcmp(a, b, r->size * sizeof *a) == 0; }

Test(count, primes_have_the_roots_that_are_promised)
{
    for (size_t i = 0; i < 8; i++) {
        nh_prime f = nh_prime_at(i);
        cr_assert_eq(f.p % 12, 11);
        cr_assert(f.p % 5 != 1 && f.p % 7 != 1 && f.p < (uint64_t)1 << 31);
        if (i) cr_assert(f.p < nh_prime_at(i - 1).p);
        uint64_t state = i;
        for (int k = 0; k < 50; k++) {
            nh_residue a = nh_residue_random(f, &state), root, square = nh_residue_mul(f, a, a);
            cr_assert(nh_residue_root(f, square, 2, &root));
            cr_assert_eq(nh_residue_mul(f, root, root), square);
            cr_assert(nh_residue_root(f, a, 15, &root));
            cr_assert_eq(nh_residue_power(f, root, 15), a);
            cr_assert_eq(nh_residue_mul(f, a, nh_residue_inverse(f, a)), 1);
        }
    }
}

Test(count, exponents_are_as_many_as_partitions_say)
{
    nh_jet_ring *r = ring_of(9);
    size_t expected = 0;
    for (size_t total = 0; total <= 9; total++)
        for (size_t b = 0; 2 * b <= total; b++) expected += total - 2 * b + 1;
    cr_assert_eq(r->size, expected);
    cr_assert_eq(nh_jet_ring_size(3, (const size_t[]){1, 2, 1}, 9, 10000), expected);
    cr_assert_eq(nh_jet_ring_size(3, (const size_t[]){1, 2, 1}, 9, expected - 1), SIZE_MAX);
    for (size_t e = 0; e < r->size; e++) {
        cr_assert_eq(nh_jet_ring_find(r, r->exponent + 3 * e), e);
        for (size_t i = r->pairs[e]; i < r->pairs[e + 1]; i++)
            for (size_t k = 0; k < 3; k++) cr_assert_eq(r->exponent[3 * r->left[i] + k] + r->exponent[3 * r->right[i] + k], r->exponent[3 * e + k]);
    }
    nh_jet_ring_free(r);
}

Test(count, functions_of_series_obey_their_identities)
{
    nh_jet_ring *r = ring_of(7);
    nh_prime f = r->field;
    nh_residue *a = random_series(r, 1), *b = random_series(r, 2), *x = nh_alloc_array(6 * r->size, sizeof *x);
    nh_residue *y = x + r->size, *z = y + r->size, *u = z + r->size, *v = u + r->size, *one = v + r->size;
    nh_jet_constant(r, 1, one);
    nh_jet_power(r, a, (nh_residue)(f.p - 1), nh_residue_inverse(f, a[0]), x);
    nh_jet_mul(r, a, x, y);
    cr_assert(equal(r, y, one), "a/a is 1");
    nh_jet_mul(r, a, a, x); /* sqrt(a^2) = +-a */
    nh_jet_power(r, x, nh_residue_inverse(f, 2), a[0], y);
    cr_assert(equal(r, y, a), "the root of a square");
    nh_jet_exponential(r, a, 5, x);
    nh_jet_exponential(r, b, 7, y);
    nh_jet_mul(r, x, y, z);
    memcpy(u, a, r->size * sizeof *u);
    nh_jet_add_multiple(r, u, 1, b);
    nh_jet_exponential(r, u, 35, v);
    cr_assert(equal(r, z, v), "exp(a) exp(b) is exp(a + b)");
    nh_residue inverse = nh_residue_inverse(f, 5); /* (3/5, 4/5) is on the circle */
    nh_jet_circle(r, a, nh_residue_mul(f, 3, inverse), nh_residue_mul(f, 4, inverse), x, y);
    nh_jet_mul(r, x, x, z);
    nh_jet_add_product(r, z, y, y);
    cr_assert(equal(r, z, one), "sin^2 + cos^2 is 1");
    nh_jet_power(r, a, (nh_residue)(f.p - 1), nh_residue_inverse(f, a[0]), z); /* log a, and back */
    nh_jet_integral(r, a, z, 11, u);
    nh_jet_exponential(r, u, a[0], v);
    cr_assert(equal(r, v, a), "exp(log a) is a");
    nh_free(x);
    nh_free(b);
    nh_free(a);
    nh_jet_ring_free(r);
}

Test(count, linear_equations_of_series_are_solved)
{
    enum { n = 4, columns = 2 };
    nh_jet_ring *r = ring_of(5);
    size_t e = r->size;
    nh_residue *M = nh_alloc_array(n * n * e, sizeof *M), *copy = nh_alloc_array(n * n * e, sizeof *copy), *b = nh_alloc_array(n * columns * e, sizeof *b), *x = nh_alloc_array(n * columns * e, sizeof *x);
    uint64_t state = 9;
    for (size_t i = 0; i < n * n * e; i++) M[i] = copy[i] = nh_residue_random(r->field, &state);
    for (size_t i = 0; i < n * columns * e; i++) b[i] = x[i] = nh_residue_random(r->field, &state);
    M[0] = copy[0] = 0; /* rows have to change places */
    cr_assert(nh_jet_solve(r, n, M, columns, x));
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < columns; k++) {
            nh_residue *sum = nh_alloc_array(e, sizeof *sum);
            for (size_t j = 0; j < n; j++) nh_jet_add_product(r, sum, copy + (i * n + j) * e, x + (j * columns + k) * e);
            cr_assert(equal(r, sum, b + (i * columns + k) * e));
            nh_free(sum);
        }
    memset(copy, 0, n * n * e * sizeof *copy);
    cr_assert_not(nh_jet_solve(r, n, copy, columns, x));
    nh_free(x);
    nh_free(b);
    nh_free(copy);
    nh_free(M);
    nh_jet_ring_free(r);
}

/* ---- expressions ---- */

static const char *const PLANE = "name: plane\nparameters: [{name: a, value: 2}]\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2\n";

/* Equal expressions that are different nodes have equal series; false when no point was found. */
static bool agree(const char *left, const char *right)
{
    nh_system *s = system_of(PLANE);
    nh_ex e[2] = {nh_canonical(s->dag, expression_of(s, left), 0), nh_canonical(s->dag, expression_of(s, right), 0)};
    nh_jet_point *p = nh_jet_point_create(s->dag);
    cr_assert(nh_jet_point_register(p, 2, e), "%s", p->obstacle);
    nh_ex symbol[3] = {s->coordinate[0].q, s->coordinate[1].q, s->parameter[0].symbol};
    bool done = false, same = false;
    for (uint64_t seed = 1; seed < 60 && !done; seed++) {
        nh_jet_ring *r = nh_jet_ring_create(nh_prime_at(seed % 7), 2, (const size_t[]){1, 1}, 5);
        nh_jet_point_choose(p, r->field, seed);
        nh_jet_eval *v = nh_jet_eval_create(p, r);
        nh_residue *x = nh_alloc_array(3 * r->size, sizeof *x);
        for (size_t k = 0; k < 3; k++) {
            memset(x, 0, r->size * sizeof *x);
            if (k < 2) x[r->up[k * r->size]] = 1;
            x[0] = 1000 + 7 * (nh_residue)seed + (nh_residue)k;
            nh_jet_eval_set(v, symbol[k], x, false);
        }
        done = nh_jet_eval_all(v, 2, e, x);
        same = done && equal(r, x, x + r->size);
        nh_free(x);
        nh_jet_eval_free(v);
        nh_jet_ring_free(r);
    }
    cr_assert(done, "%s has a series somewhere", left);
    nh_jet_point_free(p);
    nh_system_free(s);
    return same;
}

Test(count, relations_between_functions_are_kept)
{
    cr_assert(agree("sin(x + y)", "sin(x)*cos(y) + cos(x)*sin(y)"));
    cr_assert(agree("cos(2*x/3)^2", "(1 + cos(4*x/3))/2"));
    cr_assert(agree("tan(2*x)", "2*tan(x)/(1 - tan(x)^2)"));
    cr_assert(agree("exp(x/2)*exp(x/3)*exp(y)", "exp(5*x/6 + y)"));
    cr_assert(agree("cosh(x)^2 - sinh(x)^2", "1"));
    cr_assert(agree("tanh(x)", "(exp(2*x) - 1)/(exp(2*x) + 1)"));
    cr_assert(agree("sqrt(1 + x)*sqrt(1 + y)", "sqrt((1 + x)*(1 + y))"));
    cr_assert(agree("(1 + x)^(1/3)*(1 + x)^(1/6)", "sqrt(1 + x)"));
    cr_assert(agree("sqrt(2)*sqrt(3)*y", "sqrt(6)*y"));
    cr_assert(agree("(x^2 + y^2)^(-3/2)", "1/((x^2 + y^2)*sqrt(x^2 + y^2))"));
    cr_assert(agree("sin(x + pi/3)", "sin(x)/2 + sqrt(3)/2*cos(x)"));
    cr_assert_not(agree("sin(x)", "cos(x)"));
    cr_assert_not(agree("sqrt(1 + x)", "1 + x/2"));
}

/* d/dx by the series of the function and by the series of its derivative. */
static bool derives(const char *function, const char *derivative)
{
    nh_system *s = system_of(PLANE);
    nh_ex e[2] = {expression_of(s, function), expression_of(s, derivative)};
    nh_jet_point *p = nh_jet_point_create(s->dag);
    cr_assert(nh_jet_point_register(p, 2, e), "%s", p->obstacle);
    bool done = false, same = true;
    for (uint64_t seed = 1; seed < 60 && !done; seed++) {
        nh_jet_ring *r = nh_jet_ring_create(nh_prime_at(0), 1, (const size_t[]){1}, 8);
        nh_jet_point_choose(p, r->field, seed);
        nh_jet_eval *v = nh_jet_eval_create(p, r);
        nh_residue *x = nh_alloc_array(3 * r->size, sizeof *x);
        x[0] = (nh_residue)(100 + seed);
        x[1] = 1;
        nh_jet_eval_set(v, s->coordinate[0].q, x, false);
        done = nh_jet_eval_all(v, 2, e, x);
        if (done) nh_jet_derivative(r, x, 0, x + 2 * r->size);
        for (size_t k = 0; done && k + 1 < r->size; k++) same &= x[r->size + k] == x[2 * r->size + k];
        nh_free(x);
        nh_jet_eval_free(v);
        nh_jet_ring_free(r);
    }
    cr_assert(done, "%s has a series somewhere", function);
    nh_jet_point_free(p);
    nh_system_free(s);
    return same;
}

Test(count, primitives_have_their_derivatives)
{
    cr_assert(derives("log(1 + x^2)", "2*x/(1 + x^2)"));
    cr_assert(derives("atan(x^2)", "2*x/(1 + x^4)"));
    cr_assert(derives("atanh(x)", "1/(1 - x^2)"));
    cr_assert(derives("asin(x)", "1/sqrt(1 - x^2)"));
    cr_assert(derives("acos(x)", "-1/sqrt(1 - x^2)"));
    cr_assert(derives("asinh(3*x)", "3/sqrt(1 + 9*x^2)"));
    cr_assert(derives("acosh(x)", "1/sqrt(x^2 - 1)"));
    cr_assert(derives("atan2(x, 2)", "2/(4 + x^2)"));
    cr_assert(derives("abs(x)^3", "3*x*abs(x)"));
}

/* ---- counts ---- */

typedef struct {
    nh_system *system;
    nh_model *model;
    nh_ex *known;
    size_t count;
} problem;

/* A system with the integrals that it is claimed to have, by `known: currents`. */
static problem problem_of(const char *text)
{
    nh_error error = {0};
    problem p = {.system = system_of(text)};
    nh_chart *chart = nh_chart_create(p.system, NH_CHART_AUTO, 1, &error);
    must(chart != NULL, &error, "the chart");
    p.model = nh_model_create(p.system, chart, &error);
    must(p.model != NULL, &error, "the model");
    p.known = nh_alloc_array(p.system->currents + 1, sizeof *p.known);
    for (size_t k = 0; k < p.system->currents; k++)
        must(nh_analysis_file_to_chart(p.model, p.system->current[k].value, &p.known[p.count++], &error), &error, "a current");
    return p;
}

static void problem_clear(problem *p)
{
    nh_free(p->known);
    nh_model_free(p->model);
    nh_system_free(p->system);
}

static nh_count count_in(const char *text, size_t degree, bool time, bool generic)
{
    problem p = problem_of(text);
    nh_count_question q = {.time = time, .generic = generic, .degree = degree, .work = 1e10, .known = p.count, .current = p.known};
    nh_count c = nh_count_integrals(p.model, &q);
    problem_clear(&p);
    return c;
}

static nh_count count_text(const char *text, size_t degree) { return count_in(text, degree, false, false); }

static void expect(const char *name, const nh_count *c, size_t degrees, const size_t *bound)
{
    cr_assert_null(c->obstacle, "%s: %s", name, c->obstacle);
    cr_assert_eq(c->rows, degrees, "%s: %zu degrees, because of %s", name, c->rows, c->end ? c->end : "nothing");
    for (size_t d = 0; d < degrees; d++) cr_assert_eq(c->row[d].bound, bound[d], "%s, degree %zu: %zu instead of %zu", name, d + 1, c->row[d].bound, bound[d]);
}

#define EXPECT(text, ...)                                                                                                                            \
    do {                                                                                                                                             \
        size_t bound_[] = {__VA_ARGS__}, degrees_ = sizeof bound_ / sizeof *bound_;                                                                  \
        nh_count count_ = count_text(text, degrees_);                                                                                                \
        expect(#text, &count_, degrees_, bound_);                                                                                                    \
    } while (0)

static const char *const FREE_1 = "name: f\ncoordinates: [{name: x}]\nlagrangian: x'^2/2\n";
static const char *const FREE_2 = "name: f\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2\n";
static const char *const FREE_3 = "name: f\ncoordinates: [{name: x}, {name: y}, {name: z}]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n";
static const char *const FREE_POLAR = "name: f\ncoordinates: [{name: r, type: length}, {name: h, type: angle}]\nlagrangian: (r'^2 + r^2*h'^2)/2\n";
static const char *const SPHERE = "name: f\ncoordinates: [{name: a, type: angle}, {name: b, type: angle}]\nlagrangian: (a'^2 + sin(a)^2*b'^2)/2\n";

/* Killing tensors of rank k on a space of constant curvature: (m + k - 1)! (m + k)!/((m - 1)! m! k! (k + 1)!) [Thompson1986]. */
static size_t killing(size_t m, size_t k)
{
    double n = 1;
    for (size_t i = 1; i <= k; i++) n *= (double)(m + i - 1) / (double)i;
    for (size_t i = 1; i <= k; i++) n *= (double)(m + i) / (double)(i + 1);
    return (size_t)(n + 0.5);
}

static void flat(const char *text, size_t m, size_t degree)
{
    nh_count c = count_text(text, degree);
    size_t total = 1;
    cr_assert_null(c.obstacle, "%s", c.obstacle);
    cr_assert_eq(c.rows, degree);
    for (size_t d = 1; d <= degree; d++) cr_assert_eq(c.row[d - 1].bound, total += killing(m, d), "%zu coordinates, degree %zu: %zu", m, d, c.row[d - 1].bound);
}

Test(count, free_motion_in_spaces_of_constant_curvature)
{
    flat(FREE_1, 1, 8);
    flat(FREE_2, 2, 6);
    flat(FREE_POLAR, 2, 6);
    flat(SPHERE, 2, 5);
    flat(FREE_3, 3, 4);
}

#define PLANAR(potential) "name: h\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\ndomain: {x: [0.5, 1.5]}\nlagrangian: (x'^2 + y'^2)/2 - (" potential ")\n"

Test(count, potentials_in_the_plane)
{
    EXPECT(PLANAR("(x^2 + y^2)/2 + x^2*y + y^3/3"), 1, 3, 3, 6);
    EXPECT(PLANAR("(x^2 + 16*y^2)/2 + x^2*y + 16/3*y^3"), 1, 2, 2, 4);
    EXPECT(PLANAR("(x^2 + y^2)/2 + x^2*y - y^3/3"), 1, 2, 2, 3);
    EXPECT(PLANAR("(x^2 + 16*y^2)/2 + x^2*y + 16/3*y^3 + 7/10/x^2"), 1, 2, 2, 4);
    EXPECT(PLANAR("12*x^(4/3) + y^2*x^(-2/3)"), 1, 2, 2, 3, 3, 5);
    EXPECT(PLANAR("exp(x - y) + exp(-x) + exp(y)"), 1, 2, 2);
    EXPECT(PLANAR("1/sqrt(x^2 + y^2)"), 2, 6, 10, 19); /* A^2 + B^2 = 2 E L^2 + 1 */
}

#define RIGID(A, B, C, potential) "name: top\ncoordinates: [{name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\ndomain: {h: [0.4, 2.6]}\n" \
    "lagrangian: (" A ")*(p'*sin(h)*sin(s) + h'*cos(s))^2/2 + (" B ")*(p'*sin(h)*cos(s) - h'*sin(s))^2/2 + (" C ")*(p'*cos(h) + s')^2/2 - (" potential ")\n"

Test(count, rigid_bodies)
{
    EXPECT(RIGID("2", "3", "5", "0"), 4, 11, 24);
    EXPECT(RIGID("2", "2", "5", "cos(h)"), 3, 7, 13, 22);
    EXPECT(RIGID("2", "2", "1", "sin(h)*sin(s)"), 2, 4, 6, 10);
}

#define SLEIGH(J) "name: sl\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: h, type: angle}]\nconstraints: [\"x'*sin(h) - y'*cos(h) = 0\"]\n" \
    "lagrangian: (" J ")*h'^2/2 + 13/10*((x' - 4/10*h'*sin(h))^2 + (y' + 4/10*h'*cos(h))^2)/2\n"
#define SPACE(constraint, potential) "name: c\ncoordinates: [{name: x}, {name: y}, {name: z}]\nconstraints: [\"" constraint "\"]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (" potential ")\n"

Test(count, nonholonomic_systems)
{
    EXPECT(SLEIGH("7/10"), 3, 6, 10, 15);
    EXPECT(SPACE("z' = y*x'", "(x^2 + y^2 + z^2)/2"), 1, 3);
    EXPECT("name: d\ncoordinates: [{name: x}, {name: y}, {name: p, type: angle}, {name: s, type: angle}]\nconstraints: [\"x' = 6/10*s'*cos(p)\", \"y' = 6/10*s'*sin(p)\"]\n"
           "lagrangian: 13/10*(x'^2 + y'^2)/2 + 7/10*p'^2/2 + 4/10*s'^2/2\n", 7, 27);
}

/* Velocities of other kinds and other coordinates give the same numbers. */
Test(count, numbers_do_not_depend_on_velocities_or_coordinates)
{
    const char *const BODY = "name: sl\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: h, type: angle}]\n"
                             "velocities: {names: [om, v], map: [\"h' = om\", \"x' = v*cos(h)\", \"y' = v*sin(h)\"]}\nconstraints: [\"x'*sin(h) - y'*cos(h) = 0\"]\n"
                             "lagrangian: 7/10*h'^2/2 + 13/10*((x' - 4/10*h'*sin(h))^2 + (y' + 4/10*h'*cos(h))^2)/2\n";
    EXPECT(BODY, 3, 6, 10);
    EXPECT("name: k\ncoordinates: [{name: r, type: length}, {name: h, type: angle}]\ndomain: {r: [0.5, 2]}\nlagrangian: (r'^2 + r^2*h'^2)/2 + 1/r\n", 2, 6, 10, 19);
    EXPECT("name: k\ncoordinates: [{name: u, type: length}, {name: v, type: length}]\ndomain: {u: [0.5, 2]}\nlagrangian: (u^2 + v^2)*(u'^2 + v'^2)*2 + 1/(u^2 + v^2)\n", 2, 6, 10);
}

Test(count, integrable_constraints_are_followed_along_their_leaves)
{
    EXPECT(SPACE("x*x' + y*y' + z*z' = 0", "0"), 4, 10);                                   /* a sphere: 1, 3 + 1, 6 + 3 + 1 */
    EXPECT(SPACE("z' = x*x' + y*y'", "0"), 2, 4);                                          /* a paraboloid: rotation and energy */
    EXPECT("name: two\ncoordinates: [{name: x}, {name: y}, {name: z}, {name: u}]\nconstraints: [\"z' = y*x'\", \"u*u' + x*x' = 0\"]\ndomain: {u: [1, 2]}\n"
           "lagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2 - y\n", 2, 4);                       /* a contact structure on a leaf: sqrt(1 + y^2 cos(a)^2) a', and the energy */
}

Test(count, time_is_a_coordinate)
{
    nh_count c = count_in(FREE_1, 3, true, false);
    size_t line[] = {3, 6, 10}; /* polynomials in x' and x - t x' */
    expect("a line in time", &c, 3, line);
    c = count_in("name: o\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - x^2\n", 2, true, false);
    size_t oscillator[] = {3, 6};
    expect("an oscillator in time", &c, 2, oscillator);
    c = count_in("name: o\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - t*x^2\n", 2, false, false);
    cr_assert(c.time, "it depends on time by itself");
    expect("Airy's equation", &c, 2, oscillator);
    c = count_in("name: o\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - t*x^4\n", 2, false, false);
    size_t none[] = {1, 1};
    expect("a quartic oscillator that stiffens", &c, 2, none);
}

static const char *const ROLLING_DISK =
    "name: disk\ncoordinates: [{name: x}, {name: y}, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
    "lagrangian: (x'^2 + y'^2)/2 + h'^2*cos(h)^2/2 + (h'^2 + p'^2*sin(h)^2)/8 + (p'*cos(h) + s')^2/4 - 2*sin(h)\n"
    "constraints:\n  - x' - h'*sin(h)*sin(p) + p'*cos(h)*cos(p) + s'*cos(p) = 0\n"
    "  - y' + h'*sin(h)*cos(p) + p'*cos(h)*sin(p) + s'*sin(p) = 0\n";

/* Where the equations depend on time, a count without time in the coefficients is none. */
Test(count, equations_that_depend_on_time_are_not_counted_twice)
{
    const char *const driven = "name: d\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - x^2/2 + x*cos(t)\n";
    for (int k = 0; k < 2; k++) {
        problem p = problem_of(k ? driven : FREE_1);
        nh_count_question q = {.timeless = true, .degree = 2, .work = 1e9};
        nh_count c = nh_count_integrals(p.model, &q);
        cr_expect_eq(c.time, k == 1);
        cr_expect_eq(c.rows, k ? 0u : 2u);
        nh_completeness both[NH_COMPLETENESS_KINDS];
        nh_completeness_of(p.model, &(nh_completeness_question){.degree = 2, .work = 1e9, .threads = 2}, both);
        cr_expect_eq(both[NH_COMPLETE_IN_COORDINATES].counted, k == 0);
        cr_expect(both[NH_COMPLETE_IN_TIME].counted && both[NH_COMPLETE_IN_TIME].count.rows == 2);
        problem_clear(&p);
    }
}

/* The heading enters only the rates of the place of the contact; the spin and the place enter nothing. */
Test(count, coordinates_that_closed_equations_do_not_need_are_dropped)
{
    static const nh_count_shape SHAPE[] = {NH_EVERY_COORDINATE, NH_NOT_CYCLIC, NH_CLOSED_SHAPE};
    static const size_t UNKNOWN_COORDINATES[] = {5, 2, 1};
    problem p = problem_of(ROLLING_DISK);
    for (size_t i = 0; i < sizeof SHAPE / sizeof *SHAPE; i++) {
        nh_count_question q = {.shape = SHAPE[i], .degree = 2, .alone = true, .work = 1e10};
        nh_counter c;
        nh_counter_open(&c, p.model, &q, false);
        cr_expect_eq(c.equations->coordinates, UNKNOWN_COORDINATES[i], "%zu: %zu", i, c.equations->coordinates);
        nh_counter_close(&c);
        nh_count n = nh_count_integrals(p.model, &q);
        cr_assert_eq(n.rows, 1, "%s", n.obstacle ? n.obstacle : "nothing was counted");
        cr_expect_eq(n.row[0].bound, 7, "%zu: %zu", i, n.row[0].bound);
    }
    /* 1, two of degree 1 and the energy: products of degree up to 8, (a, b, c) with a + b + 2 c <= 8 */
    nh_count_question q = {.shape = NH_CLOSED_SHAPE, .degree = 8, .alone = true, .work = 1e9};
    nh_count n = nh_count_integrals(p.model, &q);
    cr_assert_eq(n.rows, 1);
    cr_expect_eq(n.row[0].bound, 95, "%zu", n.row[0].bound);
    cr_expect(n.row[0].settled);
    problem_clear(&p);
}

Test(count, known_integrals_are_compared)
{
    const char *const KEPLER = "name: k\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\ndomain: {x: [0.5, 2]}\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n"
                               "known:\n  currents:\n    - {name: E, expr: (x'^2 + y'^2)/2 - 1/sqrt(x^2 + y^2)}\n    - {name: L, expr: x*y' - y*x'}\n";
    nh_count c = count_text(KEPLER, 2);
    cr_assert(c.row[0].complete);
    cr_assert_not(c.row[1].complete, "the vector of Laplace, Runge and Lenz is missing");
    cr_assert_eq(c.row[1].bound, 6);
    cr_assert_eq(c.row[1].known, 4); /* 1, E, L, L^2 */
    char *all = nh_alloc(4096);
    snprintf(all, 4096, "%s    - {name: A, expr: y'*(x*y' - y*x') - x/sqrt(x^2 + y^2)}\n    - {name: B, expr: -x'*(x*y' - y*x') - y/sqrt(x^2 + y^2)}\n", KEPLER);
    c = count_text(all, 4);
    nh_free(all);
    for (size_t d = 0; d < 4; d++) cr_assert(c.row[d].complete, "degree %zu: %zu of %zu", d + 1, c.row[d].known, c.row[d].bound);
}

/* Products of integrals that hold for all parameters, and the bound for these values, give what the equations for generic ones give. */
Test(count, the_bound_for_some_values_is_one_for_generic_values)
{
    static const char text[] = "name: k\nparameters: [{name: m, value: 1.3}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                               "domain: {x: [0.5, 1.5], y: [0.5, 1.5]}\nlagrangian: (x'^2 + y'^2)/2 + m/sqrt(x^2 + y^2)\n"
                               "known:\n  currents:\n    - {name: E, expr: (x'^2 + y'^2)/2 - m/sqrt(x^2 + y^2)}\n    - {name: L, expr: x*y' - y*x'}\n"
                               "    - {name: A, expr: y'*(x*y' - y*x') - m*x/sqrt(x^2 + y^2)}\n    - {name: B, expr: x'*(y*x' - x*y') - m*y/sqrt(x^2 + y^2)}\n";
    enum { degree = 3 };
    problem p = problem_of(text);
    nh_count_question q = {.degree = degree, .work = 1e10, .known = p.count, .current = p.known};
    nh_count here = nh_count_integrals(p.model, &q);
    q.generic = true;
    nh_count solved = nh_count_integrals(p.model, &q);
    nh_count brackets = nh_count_brackets(p.model, &q);
    problem_clear(&p);
    for (size_t d = 0; d < degree; d++) {
        cr_assert(here.row[d].complete && solved.row[d].complete, "degree %zu", d + 1);
        cr_expect_eq(here.row[d].bound, solved.row[d].bound);
        cr_expect_eq(here.row[d].known, solved.row[d].known);
    }
    cr_expect_eq(brackets.rows, 0);
    cr_expect_eq(brackets.weights, here.weights);
    cr_expect_eq(brackets.weights, solved.weights);
    cr_expect_eq(brackets.leaf, here.leaf);
}

/* The constraint is integrable for k = 0 alone: the bound there is none for generic k, and the weights tell. */
Test(count, brackets_of_other_ranks_are_seen)
{
    static const char text[] = "name: k\nparameters: [{name: k, value: 0}]\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                               "constraints: [\"z' = k*y*x'\"]\n";
    nh_count here = count_in(text, 1, false, false), generic = count_in(text, 1, false, true);
    cr_assert(!here.obstacle && !generic.obstacle);
    cr_expect(here.leaf == 1 && here.weights == 2, "%zu, %zu", here.leaf, here.weights);
    cr_expect(generic.leaf == 0 && generic.weights == 4, "%zu, %zu", generic.leaf, generic.weights);
}

Test(count, generic_parameters_have_no_more_than_special_ones)
{
    const char *const text = "name: h\nparameters: [{name: b, value: 1}, {name: e, value: 3}]\ncoordinates: [{name: x}, {name: y}]\n"
                             "lagrangian: (x'^2 + y'^2)/2 - (x^2 + b*y^2)/2 - x^2*y - y^3/e\nknown: {currents: [{name: E, expr: (x'^2 + y'^2)/2 + (x^2 + b*y^2)/2 + x^2*y + y^3/e}]}\n";
    nh_count c = count_in(text, 4, false, true);
    size_t generic[] = {1, 2, 2, 3}, special[] = {1, 3, 3, 6};
    expect("all b, e", &c, 4, generic);
    cr_assert(c.row[3].complete);
    c = count_in(text, 4, false, false);
    expect("b = 1, e = 3", &c, 4, special);
    cr_assert_not(c.row[3].complete);
}

/* Systems of step 2 and 3, whose numbers fall slowly: what stays the same once may fall again. */
Test(count, numbers_that_fall_slowly_are_not_taken_for_settled)
{
    const char *const CONTACT = SPACE("z' = y*x'", "x^2/2 + y^2/2 + z^2/2");
    nh_count c = count_text(CONTACT, 4);
    cr_assert_null(c.obstacle);
    for (size_t d = 1; d < c.rows; d++) cr_assert(c.row[d].bound >= c.row[d - 1].bound);
    cr_assert(c.row[1].settled && c.row[1].bound == 3);
}

Test(count, what_is_out_of_reach_is_said)
{
    cr_assert_not_null(count_text("name: r\ncoordinates: [{name: x}, {name: y}]\nlagrangian: -sqrt(1 - x'^2 - y'^2)\n", 2).obstacle);
    cr_assert_not_null(count_text("name: s\ncoordinates: [{name: x}, {name: y}, {name: z}]\nconstraints: [\"z' = sqrt(x'^2 + y'^2)\"]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n", 2).obstacle);
    cr_assert_not_null(count_text(PLANAR("x^pi"), 2).obstacle);
    cr_assert_null(count_text(PLANAR("abs(x) + abs(y)"), 2).obstacle);
}

/* exp(x) and exp(2 x) are one function: with two independent ones there would be fewer integrals (A2 and others of Toda's kind). */
Test(count, exponentials_of_multiples_are_not_independent)
{
    EXPECT(PLANAR("exp(2*x) + exp(-x)*cosh(sqrt(3)*y)*2"), 1, 2, 3); /* Toda A2, periodic */
    EXPECT("name: m\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - exp(x) - exp(2*x) - exp(x/3)\n", 1, 2, 2, 3);
}

/* A degree whose bound is known, but still falls, may take more work than the option allows for one that is not begun. */
Test(count, a_bound_that_falls_gets_more_work)
{
    problem p = problem_of("name: s\ncoordinates: [{name: x}, {name: y}, {name: f, type: angle}]\n"
                           "constraints: [\"x'*sin(f) = y'*cos(f)\"]\nlagrangian: (x'^2 + y'^2 + f'^2)/2 - x\n"
                           "known: {currents: [{name: f, expr: f'}, {name: E, expr: (x'^2 + y'^2 + f'^2)/2 + x}]}\n");
    bool more = false;
    for (double work = 1e4; work < 1e8 && !more; work *= 1.5) {
        nh_count_question q = {.degree = 2, .work = work, .known = p.count, .current = p.known};
        nh_count c = nh_count_integrals(p.model, &q);
        more = c.rows == 2 && c.row[1].settled && c.work > 1.5 * work;
    }
    cr_expect(more);
    problem_clear(&p);
}

/* The parts of a weight are the same for every number of threads, and so is the place where a limit of work is reached. */
Test(count, numbers_of_threads_change_nothing)
{
    const char *const text[] = {FREE_3, "name: s\nparameters: [{name: g, value: 0.9}]\ncoordinates: [{name: x}, {name: y}, {name: f, type: angle}]\n"
                                        "constraints: [\"x'*sin(f) = y'*cos(f)\"]\nlagrangian: (x'^2 + y'^2 + f'^2)/2 - g*x\n"
                                        "known: {currents: [{name: f, expr: f'}, {name: E, expr: (x'^2 + y'^2 + f'^2)/2 + g*x}]}\n"};
    double most = 0;
    for (size_t i = 0; i < 2; i++)
        for (double work = 1e5; work < (sweep_sanitized() ? 2e7 : 2e9); work *= 6) {
            problem p = problem_of(text[i]);
            nh_count_question q = {.time = true, .degree = 4, .work = work, .threads = 1, .known = p.count, .current = p.known};
            nh_count one = nh_count_integrals(p.model, &q);
            most = one.work > most ? one.work : most;
            for (q.threads = 2; q.threads <= 5; q.threads += 3) {
                nh_count c = nh_count_integrals(p.model, &q);
                cr_assert_eq(c.rows, one.rows);
                cr_expect_eq(c.work, one.work, "%zu threads, at most %g: %.0f and %.0f", q.threads, work, c.work, one.work);
                cr_expect(c.end == one.end || (c.end && one.end && !strcmp(c.end, one.end)));
                for (size_t d = 0; d < c.rows; d++) {
                    cr_expect_eq(c.row[d].bound, one.row[d].bound);
                    cr_expect_eq(c.row[d].rank, one.row[d].rank);
                    cr_expect_eq(c.row[d].order, one.row[d].order);
                    cr_expect_eq(c.row[d].settled, one.row[d].settled);
                }
            }
            problem_clear(&p);
        }
    cr_expect_gt(most, 1e7, "%g: too little for several parts", most);
}

/* Too little work: what the series so far allow is said, and that it is not settled. */
Test(count, numbers_that_are_not_settled_are_said)
{
    problem p = problem_of("name: s\nparameters: [{name: g, value: 0.9}]\ncoordinates: [{name: x}, {name: y}, {name: f, type: angle}]\n"
                           "constraints: [\"x'*sin(f) = y'*cos(f)\"]\nlagrangian: (x'^2 + y'^2 + f'^2)/2 - g*x\n"
                           "known: {currents: [{name: f, expr: f'}, {name: E, expr: (x'^2 + y'^2 + f'^2)/2 + g*x}]}\n");
    nh_text said;
    nh_text_init(&said);
    for (double work = 1e3; work < 1e9 && !strstr(nh_text_string(&said), "is not settled: series up to order"); work *= 2) {
        nh_completeness c[NH_COMPLETENESS_KINDS];
        nh_completeness_of(p.model, &(nh_completeness_question){.known = p.count, .current = p.known, .degree = 2, .work = work}, c);
        nh_text_clear(&said);
        nh_text_init(&said);
        nh_completeness_words(c, 0, &said);
        cr_expect(!c[0].missing_at || c[0].settled || strstr(nh_text_string(&said), "not settled") || !nh_text_string(&said)[0], "%s", nh_text_string(&said));
    }
    cr_expect_not_null(strstr(nh_text_string(&said), "is not settled: series up to order"), "%s", nh_text_string(&said));
    nh_text_clear(&said);
    problem_clear(&p);
}

/* A degree without a bound may take more work than one whose bound still falls: more degrees, with the same numbers. */
Test(count, a_first_bound_may_take_more_work)
{
    problem p = problem_of("name: s\ncoordinates: [{name: x}, {name: y}, {name: f, type: angle}]\n"
                           "constraints: [\"x'*sin(f) = y'*cos(f)\"]\nlagrangian: (x'^2 + y'^2 + f'^2)/2 - x^3*y\n");
    size_t more = 0;
    for (double work = 1e3; work < 1e7; work *= 2) {
        nh_count_question q = {.degree = 4, .work = work, .known = p.count, .current = p.known}, patient = q;
        patient.first_work = 10 * work;
        nh_count a = nh_count_integrals(p.model, &q), b = nh_count_integrals(p.model, &patient);
        cr_expect_geq(b.rows, a.rows);
        more += b.rows - a.rows;
        for (size_t d = 0; d < a.rows; d++)
            if (a.row[d].bounded && b.row[d].bounded) cr_expect_eq(a.row[d].bound, b.row[d].bound);
    }
    cr_expect_gt(more, 0u);
    problem_clear(&p);
}

/* While integrals are sought the lowest degree that misses some is enough; what is said of it is the same. */
Test(count, degrees_end_where_functions_are_missing)
{
    static const char *const kind[] = {"(x'^2 + y'^2)/2 - x^2/2 - y^2/2", "(x'^2 + y'^2)/2 - x^4/4 - y^4/4", "(x'^2 + y'^2)/2 - x^4*y"};
    static const bool more[] = {true, true, false}; /* of the last one everything is known */
    for (size_t i = 0; i < sizeof kind / sizeof *kind; i++) {
        char text[400];
        snprintf(text, sizeof text, "name: s\ncoordinates: [x, y]\nlagrangian: %s\nknown: {currents: [{name: E, expr: %s}]}\n", kind[i],
                 i == 2 ? "(x'^2 + y'^2)/2 + x^4*y" : "1 + 1");
        problem p = problem_of(text);
        nh_count_question q = {.degree = 4, .work = 2e8, .known = p.count, .current = p.known}, brief = q;
        brief.until_missing = true;
        nh_count a = nh_count_integrals(p.model, &q), b = nh_count_integrals(p.model, &brief);
        cr_expect_eq(a.rows, 4u);
        cr_expect(!a.more && b.more == more[i] && (b.rows < a.rows) == more[i], "%s: %zu of %zu rows", kind[i], b.rows, a.rows);
        for (size_t d = 0; d < b.rows; d++)
            cr_expect(b.row[d].bound == a.row[d].bound && b.row[d].functions == a.row[d].functions && (b.row[d].functions || d + 1 == b.rows));
        problem_clear(&p);
    }
}

/* What is said of a system, nothing of which is known; `all`: there can be no more independent integrals. */
static void words_of(const char *text, bool all, nh_text *out)
{
    problem p = problem_of(text);
    nh_completeness c[NH_COMPLETENESS_KINDS];
    nh_completeness_question q = {.known = p.count, .current = p.known, .general = true, .all = all, .degree = 2, .work = 2e8};
    nh_completeness_of(p.model, &q, c);
    nh_completeness_generic(p.model, &q, c);
    nh_text_init(out);
    nh_completeness_words(c, 0, out);
    problem_clear(&p);
}

Test(count, words_say_which_coefficients_are_meant)
{
    nh_text said;
    words_of("name: o\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - t*x^2\n", false, &said);
    cr_expect_not_null(strstr(nh_text_string(&said), "Not complete: at degree 1, with any functions of time and the coordinates"), "%s", nh_text_string(&said));
    nh_text_clear(&said);
    words_of(PLANAR("x^4 + 3*y^3*x + y"), false, &said);
    cr_expect_not_null(strstr(nh_text_string(&said), "Complete to degree 1: no function"), "%s", nh_text_string(&said));
    nh_text_clear(&said);
    words_of("name: k\ncoordinates: [x, y]\ndomain: {x: [2, 3], y: [-2, -1]}\nlagrangian: (x'^2 + y'^2)/2 - abs(x - 2*y)^3 - x^4*abs(y)\n", false, &said);
    cr_expect_not_null(strstr(nh_text_string(&said), "Complete to degree 1 for y < 0 and x - 2*y > 0: no function"), "%s", nh_text_string(&said));
    nh_text_clear(&said);
    /* z - atan(x) is conserved, and a coefficient */
    words_of("name: l\ncoordinates: [x, y, z]\nconstraints: [\"z' = x'/(1 + x^2)\"]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - t*x^4 - x*y*z - y^4\n", false, &said);
    cr_expect_not_null(strstr(nh_text_string(&said), "Complete to degree 2: but for functions of what the constraints keep constant, no function"), "%s", nh_text_string(&said));
    nh_text_clear(&said);
    words_of(FREE_2, true, &said);
    cr_expect_not_null(strstr(nh_text_string(&said), "is a function of those found: there cannot be more independent ones."), "%s", nh_text_string(&said));
    nh_text_clear(&said);
}

/* What holds on one side of a wall counts on that side only. */
Test(count, a_side_has_what_holds_there)
{
    problem p = problem_of("name: k\ncoordinates: [x, y]\ndomain: {x: [2, 3], y: [-2, -1]}\nlagrangian: (x'^2 + y'^2)/2 - abs(x)\n");
    nh_ex x = nh_symbol(p.model->dag, "x"), y = nh_symbol(p.model->dag, "y");
    const struct {
        nh_ex wall;
        nh_region_kind kind;
        bool within;
    } row[] = {{x, NH_REGION_ABOVE, true}, {x, NH_REGION_BELOW, false}, {y, NH_REGION_ABOVE, false},   {y, NH_REGION_BELOW, true},
               {x, NH_REGION_APART, true}, {x, NH_REGION_PARTS, false}, {y, NH_REGION_IMPULSE, true}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        nh_region region = {.count = 1, .wall = {row[i].wall}, .kind = {row[i].kind}};
        cr_expect_eq(nh_region_has_probe(p.model, &region), row[i].within, "%zu", i);
    }
    problem_clear(&p);
}

/* The same question with so little work that series are out of reach: what frequencies alone say. */
static nh_count without_series(const char *text, size_t degree, bool time)
{
    problem p = problem_of(text);
    nh_count_question q = {.time = time, .degree = degree, .work = 7e3, .known = p.count, .current = p.known};
    nh_count c = nh_count_integrals(p.model, &q);
    problem_clear(&p);
    return c;
}

static const char *const SPRINGS = "name: c\ncoordinates: [x, y]\nlagrangian: (x'^2 + x'*y' + y'^2)/2 - x^2 + x*y - 2*y^2 + x/3\n"
                                   "known: {currents: [{name: E, expr: (x'^2 + x'*y' + y'^2)/2 + x^2 - x*y + 2*y^2 - x/3}]}\n";

Test(count, linear_equations_are_counted_by_their_frequencies)
{
    for (int time = 0; time < 2; time++) {
        size_t degrees = time ? 2 : 4;
        nh_count series = count_in(SPRINGS, degrees, time, false), own = without_series(SPRINGS, degrees, time);
        cr_assert(own.linear == 1 || own.linear == 2); /* the first may have come by series */
        cr_assert_eq(own.rows, degrees);
        for (size_t d = 0; d < degrees; d++) {
            const nh_count_row *a = &series.row[d], *b = &own.row[d];
            cr_assert(a->order > 0 && (b->order == 0) == (d + 1 >= own.linear));
            cr_expect_eq(a->bound, b->bound, "degree %zu: %zu, %zu", d + 1, a->bound, b->bound);
            cr_expect_eq(a->rank, b->rank, "degree %zu: %zu, %zu", d + 1, a->rank, b->rank);
            cr_expect_eq(a->known_rank, b->known_rank);
            cr_expect_eq(a->complete, b->complete);
        }
    }
    /* up to where no frequencies are in resonance: waves, waves and exponentials, 1 : 1, 1 : 2, 1 : 3, free motion, another force, gyroscopic forces, drag */
    static const struct {
        const char *text;
        size_t last;
    } tried[] = {{PLANAR("x^2 + 3*y^2"), 4}, {PLANAR("x^2 - 3*y^2"), 4}, {PLANAR("x^2 + y^2"), 0}, {PLANAR("x^2 + 4*y^2"), 1}, {PLANAR("x^2 + 9*y^2"), 1}, {PLANAR("x^2"), 0}, {PLANAR("x^2 + 3*y^2 + y^3"), 0},
                 {"name: g\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + x*y' - x^2 - 5*y^2\n", 0}, {"name: d\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^2 - 5*y^2\nforces: [\"x = -x'\"]\n", 0}};
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        nh_count c = without_series(tried[i].text, 4, false), series = count_text(tried[i].text, 4);
        size_t last = c.linear ? c.rows : 0; /* the first may have come by series */
        cr_expect(last == tried[i].last || (last == 0 && tried[i].last == 1), "%s: to degree %zu", tried[i].text, last);
        for (size_t d = 0; d < c.rows; d++) cr_expect_eq(c.row[d].bound, series.row[d].bound, "%s", tried[i].text);
        if (tried[i].last == 0) continue;
        c = without_series(tried[i].text, 2, true);
        series = count_in(tried[i].text, 2, true, false);
        cr_expect(c.rows == (tried[i].last > 1 ? 2 : 1) && (c.linear == 1 || c.row[0].order > 0), "%s", tried[i].text);
        for (size_t d = 0; d < c.rows; d++) cr_expect_eq(c.row[d].bound, series.row[d].bound, "%s", tried[i].text);
    }
}

/* n equal masses between springs: sin(j pi/(2 n + 2)) are linearly independent over Q where n + 1 is prime, and for n = 20 three of them are in resonance: then there may be more of degree 2. */
Test(count, chains_of_many_masses_say_what_is_missing, PLAIN_ONLY)
{
    static const size_t masses[] = {40, 20};
    for (size_t k = 0; k < sizeof masses / sizeof *masses; k++) {
        size_t n = masses[k];
        nh_text text, said;
        nh_text_init(&text);
        nh_text_add(&text, "name: c\nparameters: [{name: k, value: 0.7}]\ncoordinates: [x1");
        for (size_t i = 2; i <= n; i++) nh_text_addf(&text, ", x%zu", i);
        nh_text_add(&text, "]\nlagrangian: x1'^2/2 - k*x1^2/2");
        for (size_t i = 2; i <= n; i++) nh_text_addf(&text, " + x%zu'^2/2 - k*(x%zu - x%zu)^2/2", i, i, i - 1);
        nh_text_addf(&text, " - k*x%zu^2/2\n", n);
        words_of(nh_text_string(&text), false, &said);
        bool sure = strstr(nh_text_string(&said), "At degree 2 there are 40 more independent integrals");
        cr_expect_eq(sure, n == 40, "%s", nh_text_string(&said));
        cr_expect_not_null(strstr(nh_text_string(&said), n == 40 ? "at degree 1 there are 80 more" : "at degree 1 there are 40 more"), "%s", nh_text_string(&said));
        nh_text_clear(&said);
        nh_text_clear(&text);
    }
}
