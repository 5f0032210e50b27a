/* Functions of one argument that a file declares: with a value they are that value; without one they are any function, and what is
 * proved holds for all of them. */
#include "analysed.h"
#include "exact/jet_eval.h"
#include "exact/normal.h"
#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/print.h"
#include "mechanics.h"
#include "program.h"
#include "evaluate/named_value.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "sweep.h"

static const char central[] = "name: central\nparameters: [{name: m, value: 1}]\nfunctions: [\"V(r)\"]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                              "lagrangian: m/2*(x'^2 + y'^2) - V(sqrt(x^2 + y^2))\n";

static nh_ex reading(const nh_system *s, const char *text)
{
    nh_error error = {0};
    nh_ex e = 0;
    must(nh_system_expression_text(s, "test", text, 0, NULL, &e, &error), &error, text);
    return e;
}

static nh_system *parsed(const char *text)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("test.yaml", text, 0, NULL, &error);
    must(s != NULL, &error, text);
    return s;
}

/* Is e zero as a power series at a random point modulo a prime, in x and y? */
static bool vanishes(const nh_system *s, nh_ex e, uint64_t seed)
{
    nh_prime p = nh_prime_at(0);
    nh_jet_ring *ring = nh_jet_ring_create(p, 2, (const size_t[]){1, 1}, 4);
    nh_jet_point *point = nh_jet_point_create(s->dag);
    cr_assert(nh_jet_point_register(point, 1, &e));
    nh_jet_point_choose(point, p, seed);
    nh_jet_eval *eval = nh_jet_eval_create(point, ring);
    nh_residue series[64], out[64];
    cr_assert_leq(ring->size, 64);
    for (size_t i = 0; i < s->coordinates; i++) {
        memset(series, 0, sizeof series);
        series[0] = nh_residue_random(p, &seed);
        for (size_t k = 1; k < ring->size; k++)
            if (ring->exponent[2 * k] + ring->exponent[2 * k + 1] == 1 && ring->exponent[2 * k + i] == 1) series[k] = 1;
        nh_jet_eval_set(eval, s->coordinate[i].q, series, true);
    }
    bool zero = true;
    cr_assert(nh_jet_eval_all(eval, 1, &e, out));
    for (size_t k = 0; k < ring->size; k++) zero &= out[k] == 0;
    nh_jet_eval_free(eval);
    nh_jet_point_free(point);
    nh_jet_ring_free(ring);
    return zero;
}

/* Derivatives are written as they are read. */
Test(functions, derivatives)
{
    nh_system *s = parsed(central);
    nh_ex e = reading(s, "V(x^2)"), x = s->coordinate[0].q;
    cr_expect_eq(nh_diff(s->dag, e, x), reading(s, "2*x*V'(x^2)"));
    cr_expect_eq(nh_diff(s->dag, nh_diff(s->dag, reading(s, "V(x*y)"), x), x), reading(s, "y^2*V''(x*y)"));
    char *text = nh_print_string(s->dag, reading(s, "V''(sqrt(x)) + V(y)/V'(1)"));
    cr_expect_eq(reading(s, text), reading(s, "V''(sqrt(x)) + V(y)/V'(1)"), "%s", text);
    nh_free(text);
    nh_system_free(s);
}

/* Series modulo primes: what holds for every function is zero, what holds for some functions is not; equal arguments, however they are
 * written, have equal values. */
Test(functions, series_hold_for_every_function)
{
    nh_system *s = parsed("functions: [\"V(r)\", \"W(r)\"]\ncoordinates: [x, y]\nlagrangian: x'^2/2 + y'^2/2\n");
    static const char *const always[] = {"V((x + y)^2) - V(x^2 + 2*x*y + y^2)", "V'(x - y) - V'(-(y - x))", "(V(x) + W(y))^2 - V(x)^2 - 2*V(x)*W(y) - W(y)^2"},
                             *const sometimes[] = {"V(x) - V(-x)", "V(x) - W(x)", "V''(x) + V(x)", "V(x + y) - V(x)*V(y)", "V'(x) - V(x)", "V(x*y) - V(x) - V(y)", "V(0)"};
    for (size_t i = 0; i < sizeof always / sizeof *always; i++) cr_expect(vanishes(s, reading(s, always[i]), 3), "%s", always[i]);
    for (size_t i = 0; i < sizeof sometimes / sizeof *sometimes; i++) {
        nh_ex e = reading(s, sometimes[i]);
        cr_expect_not(vanishes(s, e, 3), "%s", sometimes[i]);
        cr_expect_neq(nh_normal_is_zero(s->dag, e, 1000), NH_ZERO, "%s", sometimes[i]);
    }
    /* chain rule, with the graph's derivative against a shifted series: V(x + y) has equal derivatives by x and y */
    nh_ex e = reading(s, "V(x + y)*W(x*y)"), slope = nh_sub(s->dag, nh_diff(s->dag, e, s->coordinate[0].q), nh_diff(s->dag, e, s->coordinate[1].q));
    cr_expect(vanishes(s, nh_sub(s->dag, slope, reading(s, "V(x + y)*W'(x*y)*(y - x)")), 4));
    nh_system_free(s);
}

/* The jet of V(u) has the graph's derivatives as its coefficients. */
Test(functions, series_agree_with_derivatives)
{
    nh_system *s = parsed("functions: [\"V(r)\"]\ncoordinates: [x, y]\nlagrangian: x'^2/2 + y'^2/2\n");
    /* G(x, y) = V(x^2 + y) satisfies G_xx = 2 G_y + 4 x^2 G_yy */
    nh_ex x = s->coordinate[0].q, y = s->coordinate[1].q, G = reading(s, "V(x^2 + y)");
    nh_ex e = nh_sub(s->dag, nh_diff(s->dag, nh_diff(s->dag, G, x), x), nh_mul(s->dag, nh_int(s->dag, 2), nh_diff(s->dag, G, y)));
    e = nh_sub(s->dag, e, nh_mul(s->dag, reading(s, "4*x^2"), nh_diff(s->dag, nh_diff(s->dag, G, y), y)));
    cr_expect(vanishes(s, e, 9));
    nh_system_free(s);
}

static bool has(const nh_analysis *r, const char *text)
{
    bool found = false;
    for (size_t k = 0; k < r->list->count; k++) {
        char *own = nh_print_string(r->question->model->dag, r->list->found[k].phi);
        found |= !strcmp(own, text);
        cr_expect(r->list->found[k].proof.proved, "%s", own);
        nh_free(own);
    }
    return found;
}

/* Currents of all members of a family, and none of a single member. */
Test(functions, currents_hold_for_every_function, PLAIN_ONLY)
{
    static const struct {
        const char *text, *momentum;
        size_t count;
    } cases[] = {
        {central, "m*(x*y' - y*x')", 2},
        {"parameters: {m: 1, M: 2.5}\nfunctions: [{name: V, of: s}]\ncoordinates: [x, y]\nlagrangian: m/2*x'^2 + M/2*y'^2 - V(x - y)\n", "m*x' + M*y'", 3},
        {"functions: [f(t)]\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + x*f(t)\n", "y'", 2},
        {"parameters: {m: 2, J: 1.5, a: 0.3}\nfunctions: [V(p)]\ncoordinates: {phi: angle, x: length, y: length}\n"
         "lagrangian: m/2*(x'^2 + y'^2) + (J + m*a^2)/2*phi'^2 + m*a*phi'*(y'*cos(phi) - x'*sin(phi)) - V(phi)\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n", NULL, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_analysis *r = analysed_text(cases[i].text);
        cr_expect_eq(r->list->count, cases[i].count, "%zu currents, expected %zu: %s", r->list->count, cases[i].count, cases[i].text);
        if (cases[i].momentum) cr_expect(has(r, cases[i].momentum), "%s", cases[i].text);
        cr_expect(r->question->model->system->notes > 0);
        nh_analysis_free(r);
    }
}

/* The stand-in is one function: each order is the derivative of the one before, in doubles, balls and complex numbers; two functions differ. */
Test(functions, stand_in)
{
    const double h = 1e-3;
    for (int f = 0; f < 3; f++)
        for (int n = 0; n < 5; n++)
            for (double x = -2; x < 3; x += 0.7) {
                double at[5], own = nh_named_value(NH_UNSPECIFIED, (double[]){f, n + 1, x});
                for (int k = 0; k < 5; k++) at[k] = nh_named_value(NH_UNSPECIFIED, (double[]){f, n, x + (k - 2) * h});
                double slope = (8 * (at[3] - at[1]) - (at[4] - at[0])) / (12 * h);
                cr_expect_float_eq(slope, own, 1e-9, "%d, %d, %g: %.17g, %.17g", f, n, x, slope, own);
                double _Complex z = nh_named_value_complex(NH_UNSPECIFIED, (double _Complex[]){f, n, x});
                cr_expect_float_eq((double)z, at[2], 1e-14);
                cr_expect(fabs(nh_named_value(NH_UNSPECIFIED, (double[]){f + 1, n, x}) - at[2]) > 1e-6);
            }
}

/* The argument hides a coordinate or parameter of its name; t is the time, and another argument where it is called. */
Test(functions, arguments)
{
    nh_system *s = parsed("parameters: {a: 2, r: 7}\nfunctions: [\"F(t) = a*t^3\", {name: G, of: x, value: \"F'(x) + x\"}, {name: H, of: r, value: a*r}]\ncoordinates: [x, y]\nlagrangian: x'^2/2 + y'^2/2\n");
    static const char *const same[][2] = {{"F(t)", "a*t^3"}, {"F'(y)", "3*a*y^2"}, {"F'''(x*y)", "6*a"}, {"G(y)", "3*a*y^2 + y"}, {"H(y)", "a*y"}, {"H'(x)", "a"}};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) cr_expect_eq(reading(s, same[i][0]), reading(s, same[i][1]), "%s", same[i][0]);
    cr_expect_null(nh_declared_unspecified(s->dag));
    nh_system_free(s);
}

/* V(r) = -k/r is Kepler's problem: by the command line, in the file, in an analysis file. */
Test(functions, values)
{
    static const char polar[] = "coordinates: [{name: x, type: length}, {name: y, type: length}]\nlagrangian: m/2*(x'^2 + y'^2) - V(sqrt(x^2 + y^2))\n";
    place p = place_make();
    char own[2000];
    write_here(&p, "central.yaml", central);
    finished f = run(&p, "simulate central.yaml");
    cr_expect_eq(f.code, 3);
    cr_expect(strstr(f.err, "the function `V` has no value") && strstr(f.err, "--set \"V(r) ="), "%s", f.err);
    finished_clear(&f);
    snprintf(own, sizeof own, "parameters: {m: 1, k: 3}\nfunctions: [{name: V, of: s, value: -k/s}]\n%s", polar);
    write_here(&p, "own.yaml", own);
    write_here(&p, "kepler.yaml", "coordinates: {x: length, y: length}\nlagrangian: (x'^2 + y'^2)/2 + 3/sqrt(x^2 + y^2)\n");
    write_here(&p, "three.yaml", "system: central.yaml\nset: {\"V(q)\": -3/q}\n");
#define MOTION " --initial x=1,y'=1 --until 1 --step 1 --watch x,y --quiet"
    finished g[] = {run(&p, "simulate kepler.yaml" MOTION), run(&p, "simulate own.yaml" MOTION),
                    run(&p, "simulate central.yaml --set V(r)=-3/r" MOTION), run(&p, "simulate central.yaml --analysis three.yaml" MOTION)};
    for (int i = 0; i < 4; i++) {
        cr_expect_eq(g[i].code, 0, "%d: %s", i, g[i].err);
        cr_expect_str_eq(g[i].out, g[0].out);
    }
    for (int i = 0; i < 4; i++) finished_clear(&g[i]);
    place_clear(&p);
}
