/* Coefficients from residues: given terms, the integral that they make, for all parameters where it is a polynomial in these. */
#include "names.h"

#include <stdio.h>

#include "count/jet_equations.h"
#include "count/lift.h"
#include "exact/normal.h"
#include "graph/dag.h"

typedef struct {
    const char *name, *text;
    bool time;
    size_t terms;
    const char *term[6], *integral; /* NULL: there is none of these terms */
} row;

#define PLANE "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - "
#define LINE "coordinates: [x]\nlagrangian: x'^2/2 - "

static const row ROW[] = {
    {"Post and Winternitz", "parameters: {a: 0.7}\n" PLANE "a*y*x^(-2/3)\n", false, 4,
     {"x'^2*y'", "y'^3", "x^(1/3)*x'", "y*x^(-2/3)*y'"}, "x'^2*y' + 2/3*y'^3 + 3*a*x^(1/3)*x' + 2*a*y*x^(-2/3)*y'"},
    {"a sum of parameters", "parameters: {a: 2, b: 3}\n" LINE "(a + b)*x^2\n", false, 2, {"x'^2", "x^2"}, "x'^2 + 2*(a + b)*x^2"},
    {"a square of such a sum", "parameters: {a: 2, b: 3}\n" LINE "((a + b)^2*x^4 + a*x)\n", false, 3, {"x'^2", "x^4", "x"},
     "x'^2 + 2*(a + b)^2*x^4 + 2*a*x"},
    {"a parameter in a denominator", "parameters: {k: 2, m: 3}\ncoordinates: [x]\nlagrangian: m*x'^2/2 - k*x^2/2\n", false, 2,
     {"x'^2", "x^2"}, "x'^2 + k/m*x^2"},
    /* no polynomial in them: for their values only */
    {"one over a sum", "parameters: {k: 2, m: 3, n: 4}\ncoordinates: [x]\nlagrangian: (m + n)*x'^2/2 - k*x^2/2\n", false, 2,
     {"x'^2", "x^2"}, "x'^2 + 2/7*x^2"},
    {"a long fraction", LINE "1234567890123/9876543210987*x^2\n", false, 2, {"x'^2", "x^2"},
     "x'^2 + 2*1234567890123/9876543210987*x^2"},
    {"terms with time", "parameters: {g: 9.81}\n" LINE "g*x\n", true, 3, {"x", "t*x'", "t^2"}, "x - t*x' - g*t^2/2"},
    {"others' terms", LINE "x^2\n", false, 2, {"x'^2", "x^4"}, NULL},
    {"two integrals of these terms", PLANE "0\n", false, 3, {"x'*y'", "x'^2", "y'^2"}, NULL},
    {"a root as a coefficient", LINE "sqrt(2)*x^2\n", false, 2, {"x'^2", "x^2"}, NULL},
    {"no polynomial in the velocities", LINE "x^2\n", false, 2, {"sin(x')", "x^2"}, NULL},
    {"a rolling disk's momentum", "parameters: {m: 2, J: 3, R: 1/2}\ncoordinates: [x, f]\nlagrangian: m*x'^2/2 + J*f'^2/2 - m*x\n"
     "constraints: [\"x' = R*f'\"]\nvelocities: {names: [w], map: [\"f' = w\", \"x' = R*w\"]}\n", false, 2, {"w^2", "x"}, "w^2 + 8/7*x"},
};

Test(lift, coefficients_of_given_terms)
{
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        char text[500];
        nh_error error = {0};
        nh_ex term[6];
        snprintf(text, sizeof text, "name: row\n%s", ROW[i].text);
        nh_system *s = system_of(text);
        nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
        must(o != NULL, &error, ROW[i].name);
        for (size_t j = 0; j < ROW[i].terms; j++) term[j] = nh_model_compose(o, expression_of(s, ROW[i].term[j]));
        nh_lift_result r = nh_lift(o, ROW[i].time, ROW[i].terms, term, 1e9), none = nh_lift(o, ROW[i].time, ROW[i].terms, term, 10);
        cr_expect_eq(r.integral != 0, ROW[i].integral != NULL, "%s", ROW[i].name);
        cr_expect_eq(none.integral, (nh_ex)0, "%s: without work", ROW[i].name);
        if (r.integral && ROW[i].integral) {
            nh_ex difference = nh_sub(o->dag, r.integral, nh_model_compose(o, expression_of(s, ROW[i].integral)));
            cr_expect_eq(nh_normal_is_zero(o->dag, difference, 0), NH_ZERO, "%s", ROW[i].name);
        }
        nh_model_free(o);
        nh_system_free(s);
    }
}

/* The coefficients of x^2, x^4 and x'^2 are those of the energy where numbers like them are wanted; others are refused, and so is a question without work or
 * with one term. */
static void expect_energy(const char *text, const char *energy, const double *like, const double *other)
{
    static const char *const terms[] = {"x^2", "x^4", "x'^2"};
    nh_error error = {0};
    nh_ex term[3], c[3], phi;
    nh_system *s = system_of(text);
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    must(o != NULL, &error, "row");
    for (size_t j = 0; j < 3; j++) term[j] = nh_model_compose(o, expression_of(s, terms[j]));
    cr_assert(nh_lift_coefficients(o, 3, term, like, 2, 1e9, c));
    phi = nh_add(o->dag, nh_mul(o->dag, c[0], term[0]), nh_add(o->dag, nh_mul(o->dag, c[1], term[1]), nh_mul(o->dag, c[2], term[2])));
    phi = nh_sub(o->dag, nh_div(o->dag, phi, c[2]), nh_mul(o->dag, nh_int(o->dag, 2), nh_model_compose(o, expression_of(s, energy))));
    cr_expect_eq(nh_normal_is_zero(o->dag, phi, 0), NH_ZERO);
    cr_expect_not(nh_lift_coefficients(o, 3, term, other, 2, 1e9, c));
    cr_expect_not(nh_lift_coefficients(o, 3, term, like, 2, 10, c), "without work");
    cr_expect_not(nh_lift_coefficients(o, 1, term, like, 0, 1e9, c), "one term");
    nh_model_free(o);
    nh_system_free(s);
}

/* Any of the first terms, or the pivot, may be the one with the coefficient 1; also without parameters, and with numbers of very different sizes. */
Test(lift, coefficients_like_given_ones)
{
    expect_energy("name: row\nparameters: {m: 2, k: 3}\n" LINE "k*x^2/m - x^4\n", "x'^2/2 + k*x^2/m + x^4", (double[]){0.75, 0.5, 0.25}, (double[]){0.75, 0.4, 0.25});
    expect_energy("name: row\n" LINE "1.3e-9*x^2 - 3e9*x^4\n", "x'^2/2 + 1.3e-9*x^2 + 3e9*x^4", (double[]){1.3e-9, 3e9, 0.5}, (double[]){2e9, 3e9, 0.5});
}

/* Along a motion the energy has no terms beyond its value: a pendulum on a cart, and a coin that rolls down a slope. */
Test(lift, series_along_motions_keep_the_energy)
{
    enum { order = 6 };
    static const char *const text[][2] = {{"name: cart\nparameters: {m: 2, l: 1/3}\ncoordinates: [x, {name: f, type: angle}]\n"
                                           "lagrangian: m*x'^2/2 + (x'^2 + 2*l*x'*f'*cos(f) + l^2*f'^2)/2 + 9*l*cos(f)\n",
                                           "m*x'^2/2 + (x'^2 + 2*l*x'*f'*cos(f) + l^2*f'^2)/2 - 9*l*cos(f)"},
                                          {"name: coin\nparameters: {m: 2, J: 1/3}\ncoordinates: [x, y, {name: f, type: angle}, {name: p, type: angle}]\n"
                                           "lagrangian: m*(x'^2 + y'^2)/2 + J*f'^2/2 + J*p'^2 - m*x\nconstraints: [\"x' = cos(f)*p'\", \"y' = sin(f)*p'\"]\n",
                                           "m*(x'^2 + y'^2)/2 + J*f'^2/2 + J*p'^2 + m*x"}};
    for (size_t i = 0; i < 2; i++) {
        nh_error error = {0};
        nh_system *s = system_of(text[i][0]);
        nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
        must(o != NULL, &error, text[i][0]);
        nh_ex e = nh_model_compose(o, expression_of(s, text[i][1]));
        nh_jet_equations *x = nh_jet_equations_create(o, false, false);
        cr_assert(nh_jet_equations_take(x, true, &e), "%s", x->obstacle);
        size_t one = 1, tried = 0;
        nh_prime field = nh_jet_point_prime(x->point, 0);
        nh_jet_ring *ring = nh_jet_ring_create(field, 1, &one, order);
        nh_residue w[4], q[8 * (order + 1)], v[4 * (order + 1)], value[order + 1];
        for (uint64_t seed = 1; seed < 100 && tried < 3; seed++) {
            nh_jet_equations_choose(x, field, seed);
            for (size_t k = 0; k < x->n; k++) w[k] = (nh_residue)(seed + 7 * k);
            if (!nh_jet_equations_along(x, ring, w, q, v)) continue;
            tried++;
            nh_jet_eval *eval = nh_jet_equations_eval(x, ring, q);
            for (size_t k = 0; k < x->n; k++) nh_jet_eval_set(eval, x->w[k], v + k * ring->size, true);
            cr_assert(nh_jet_eval_all(eval, 1, &e, value));
            cr_expect_neq(value[0], 0);
            cr_expect_neq(q[1], 0);
            for (size_t k = 1; k <= order; k++) cr_expect_eq(value[k], 0, "system %zu, order %zu", i, k);
            nh_jet_eval_free(eval);
        }
        cr_expect_eq(tried, 3);
        nh_jet_ring_free(ring);
        nh_jet_equations_free(x);
        nh_model_free(o);
        nh_system_free(s);
    }
}
