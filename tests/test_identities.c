/* Formulas that are zero, or twice another one, without looking so: whatever is said modulo primes is the same with and without them, or nothing is said. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <string.h>

#include "count/count.h"
#include "exact/field_root.h"
#include "exact/generic_value.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "identities.h"
#include "mechanics.h"
#include "program.h"
#include "sweep.h"

enum { most_text = 2000, degree = 2 };

typedef enum { IN_POTENTIAL, IN_METRIC, IN_CONSTRAINT, IN_FORCE, IN_TIME, IN_PARAMETER, PLACES } where;

/* A system with the term Z, which couples what is separate without it. */
static void write_system(char *text, where site, const char *Z)
{
    static const char *const parts[PLACES] = {
        "lagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3-(%s)*(3*x*y^2+x^3*y)\n",
        "lagrangian: (x'^2+(1+(%s)*x)*y'^2)/2-x^4/4-y^4/3\n",
        "lagrangian: (x'^2+y'^2+z'^2)/2-x^4/4\nconstraints: [\"z' = (1+(%s))*y*x'\"]\n",
        "lagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3\nforces: [\"x = -(%s)*y\"]\n",
        "lagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3-(%s)*(3*x*y^2+x^3*y)\n",
        "parameters: {a: 2}\nlagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3-(%s)*(3*x*y^2+x^3*y)\n"};
    int n = snprintf(text, most_text, "name: zero\ncoordinates: [x, y%s]\ndomain: {x: [0.5, 1.5], y: [0.5, 1.5]}\n", site == IN_CONSTRAINT ? ", z" : "");
    snprintf(text + n, most_text - (size_t)n, parts[site], Z);
}

static nh_count count_of(where site, const char *Z)
{
    char text[most_text];
    write_system(text, site, Z);
    mechanics x = mechanics_of_text(text, NH_CHART_COORDINATES);
    nh_count_question q = {.degree = degree, .work = 2e8, .generic = site == IN_PARAMETER, .time = site == IN_TIME};
    nh_count c = nh_count_integrals(x.model, &q);
    mechanics_clear(&x);
    return c;
}

/* Is what is said of both the same, or nothing said of the first? */
static bool agree(const nh_count *a, const nh_count *b)
{
    if (a->obstacle || b->obstacle) return true;
    bool same = a->leaf == b->leaf;
    for (size_t d = 0; d < a->rows && d < b->rows && same; d++)
        same = !a->row[d].settled || !b->row[d].settled || a->row[d].bound == b->row[d].bound;
    return same;
}

static const char *letter_of(where site) { return site == IN_TIME ? "t" : site == IN_PARAMETER ? "a" : "x"; }

/* Zeros (seeds that are even), and sums that are not zero but twice their right side. */
Test(identities, counts_are_those_of_the_plain_system)
{
    size_t seeds = sweep_whole() ? 2000 : 36, counted = 0, refused = 0, wrong = 0;
    nh_count plain[PLACES];
    for (where p = 0; p < PLACES; p++) plain[p] = count_of(p, "0");
    for (size_t seed = 0; seed < seeds; seed++) {
        where site = (where)(seed % PLACES);
        identity z = identity_make(seed, letter_of(site));
        bool zero = seed / PLACES % 2 == 0;
        char Z[3 * identity_length], same[2 * identity_length];
        snprintf(Z, sizeof Z, "%s%s(%s)", z.left, zero ? "-" : "+", z.right);
        snprintf(same, sizeof same, "2*(%s)", z.right);
        nh_count here = count_of(site, Z), expected = zero ? plain[site] : count_of(site, same);
        bool good = agree(&here, &expected);
        refused += here.obstacle != NULL;
        counted += !here.obstacle && good;
        wrong += !good;
        cr_expect(good, "seed %zu, site %d: %s: %zu of degree 2, but %zu", seed, site, Z, here.row[1].bound, expected.row[1].bound);
    }
    fprintf(stderr, "identities: %zu counted, %zu refused, %zu false\n", counted, refused, wrong);
    cr_expect(counted > refused, "%zu counted, %zu refused", counted, refused);
}

/* What is zero is never taken for something that is not, and what is not is seen, or nothing is said. */
Test(identities, values_that_are_not_zero_are_no_zeros)
{
    static const char plane[] = "name: plane\nparameters: {a: 2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n";
    size_t seeds = sweep_whole() ? 2000 : 60, seen = 0;
    mechanics x = mechanics_of_text(plane, NH_CHART_COORDINATES);
    nh_ex q[2] = {x.system->coordinate[0].q, x.system->coordinate[1].q};
    for (size_t seed = 0; seed < seeds; seed++) {
        identity z = identity_make(seed, seed % 2 ? "x" : "a");
        char Z[3 * identity_length];
        snprintf(Z, sizeof Z, "%s-(%s)", z.left, z.right);
        nh_ex e = formula(x.model, Z);
        cr_expect(!nh_generic_nonzero(x.model->dag, 1, &e, 2, q), "seed %zu: %s is zero", seed, Z);
        snprintf(Z, sizeof Z, "%s-2*(%s)", z.left, z.right);
        e = formula(x.model, Z);
        seen += nh_generic_nonzero(x.model->dag, 1, &e, 2, q);
    }
    cr_expect(2 * seen > seeds, "%zu of %zu", seen, seeds);
    mechanics_clear(&x);
}

Test(identities, square_roots_in_a_field)
{
    static const struct {
        const char *square, *root; /* NULL: there is none */
    } cases[] = {{"3 + 2*sqrt(2)", "1 + sqrt(2)"},
                 {"6 + sqrt(11)", "(1 + sqrt(11))/sqrt(2)"},
                 {"x + 2*sqrt(2)*sqrt(x) + 2", "sqrt(x) + sqrt(2)"},
                 {"1 + sin(x)", "sin(x/2) + cos(x/2)"},
                 {"(1 + cos(x))/2", "cos(x/2)"},
                 {"2*(1 + cosh(x))", "exp(x/2) + exp(-x/2)"},
                 {"sqrt(2)", NULL},
                 {"3 + sqrt(2)", NULL},
                 {"1 + cos(x/2)", NULL},
                 {"x + sqrt(x)", NULL},
                 {"1 + cosh(x)", "(exp(x/2) + exp(-x/2))/sqrt(2)"}};
    mechanics m = mechanics_of_text("name: line\ncoordinates: [x]\nlagrangian: x'^2/2\n", NH_CHART_COORDINATES);
    nh_dag *d = m.model->dag;
    nh_ex x = m.system->coordinate[0].q, half = nh_mul(d, nh_ratio(d, 1, 2), x),
          radicand[] = {nh_int(d, 2), nh_int(d, 11), x};
    nh_root_field f = {.angles = 1, .exponents = 1, .roots = 3, .angle = &half, .exponent = &half, .radicand = radicand};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_ex root = 0;
        bool found = nh_field_root(d, &f, formula(m.model, cases[i].square), &root);
        cr_assert_eq(found, cases[i].root != NULL, "%s", cases[i].square);
        if (!found) continue;
        nh_ex expected = formula(m.model, cases[i].root);
        bool same = nh_normal_is_zero(d, nh_sub(d, root, expected), 0) == NH_ZERO ||
                    nh_normal_is_zero(d, nh_add(d, root, expected), 0) == NH_ZERO;
        cr_expect(same, "%s", cases[i].square);
    }
    mechanics_clear(&m);
}

/* The five systems of which "complete to degree 6" was said with one integral: there are two. */
Test(identities, what_is_said_of_a_system_with_a_zero)
{
    static const char *const zero[] = {"sqrt(3+2*sqrt(2))-1-sqrt(2)", "sqrt(1+cos(x))-sqrt(2)*cos(x/2)", "sqrt(1+a+2*sqrt(a))-1-sqrt(a)",
                                       "sqrt(cosh(x)-1)-sqrt(2)*sinh(x/2)", "sqrt(1+cos(t))-sqrt(2)*cos(t/2)"};
    for (size_t i = 0; i < sizeof zero / sizeof *zero; i++) {
        nh_count c = count_of(i == 4 ? IN_TIME : i == 2 ? IN_PARAMETER : IN_POTENTIAL, zero[i]);
        cr_assert_null(c.obstacle, "%s: %s", zero[i], c.obstacle);
        cr_expect_eq(c.row[1].bound, 3, "%s: %zu with the constant", zero[i], c.row[1].bound);
    }
}

/* k = sqrt(2) has more: what is known modulo primes only is no absence. */
Test(identities, an_algebraic_value_is_not_denied)
{
    place p = place_with_systems();
    write_here(&p, "k.yaml", "name: k\nparameters: {k: 1}\ncoordinates: [x, y]\ndomain: {x: [0.5, 1.5], y: [0.5, 1.5]}\n"
                             "lagrangian: (x'^2+y'^2)/2-x^4/4-y^4/3-(k-sqrt(2))*(3*x*y^2+x^3*y)\n");
    finished f = run(&p, "classify k.yaml --over k");
    cr_assert_eq(f.code, 0, "%s", f.err);
    cr_expect(strstr(f.out, "No known value of k") && strstr(f.out, "Up to 1 algebraic number"), "%s", f.out);
    cr_expect_null(strstr(f.out, "No special values"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}
