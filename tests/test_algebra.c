/* algebra: products of known algebras in random bases must be taken apart again and called by their names. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "reduction/algebra.h"
#include "reduction/subspace.h"
#include "system/sample.h"

#include "sweep.h"

static const double SMALL = 1e-7, CLUSTER = 2e-3;
enum { MOST = 21 };

static void put(nh_algebra *g, size_t at, int a, int b, int k, double value)
{
    size_t d = g->d, i = at + (size_t)a, j = at + (size_t)b, l = at + (size_t)k;
    g->c[(i * d + j) * d + l] += value;
    g->c[(j * d + i) * d + l] -= value;
}

/* One factor, by a letter, from basis vector `at` on; its dimension. */
static size_t factor(nh_algebra *g, size_t at, char kind)
{
    switch (kind) {
    case 'r': return 1;
    case 'o': put(g, at, 0, 1, 2, 1), put(g, at, 1, 2, 0, 1), put(g, at, 2, 0, 1, 1); return 3;
    case 'l': put(g, at, 0, 1, 1, 2), put(g, at, 0, 2, 2, -2), put(g, at, 1, 2, 0, 1); return 3;
    case 'e': put(g, at, 0, 1, 2, 1), put(g, at, 0, 2, 1, -1); return 3;
    case 'p': put(g, at, 0, 1, 1, 1), put(g, at, 0, 2, 2, -1); return 3;
    case 'h': put(g, at, 0, 1, 2, 1); return 3;
    case 'a': put(g, at, 0, 1, 1, 1); return 2;
    case 's': /* so(3) acting on R^3 */
        put(g, at, 0, 1, 2, 1), put(g, at, 1, 2, 0, 1), put(g, at, 2, 0, 1, 1);
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            put(g, at, i, 3 + j, 3 + k, 1);
            put(g, at, i, 3 + k, 3 + j, -1);
        }
        return 6;
    case 'f': /* filiform, nilpotent of dimension 4: none of the names */
        put(g, at, 0, 1, 2, 1), put(g, at, 0, 2, 3, 1);
        return 4;
    case 'd': /* a dilation of the plane: [x,y] = y, [x,z] = 0.7 z */
        put(g, at, 0, 1, 1, 1), put(g, at, 0, 2, 2, 0.7);
        return 3;
    default: cr_assert_fail("no factor"); return 0;
    }
}

static nh_algebra product(const char *letters)
{
    static const char kinds[] = "rolephasfd";
    static const size_t dimension[] = {1, 3, 3, 3, 3, 3, 2, 6, 4, 3};
    size_t d = 0, at = 0;
    for (const char *c = letters; *c; c++) d += dimension[strchr(kinds, *c) - kinds];
    nh_algebra g = nh_algebra_create(d);
    for (const char *c = letters; *c; c++) at += factor(&g, at, *c);
    return g;
}

/* A basis that is not nearly dependent: the digits that such a one costs are lost whatever is done with it. */
static nh_algebra in_random_basis(const nh_algebra *g, uint64_t seed, double *t)
{
    size_t n = g->d;
    double *a = nh_alloc_array(n * n + n + 1, sizeof *a), rcond;
    do {
        for (size_t i = 0; i < n * n; i++) a[i] = t[i] = 2 * nh_random(&seed) - 1;
        cr_assert(nh_solve(n, a, 1, a + n * n, &rcond));
    } while (rcond < 1e-3);
    nh_free(a);
    return nh_algebra_change(g, n, t, NULL);
}

/* The largest violation of antisymmetry and of Jacobi's identity. */
static double jacobi(const nh_algebra *g)
{
    size_t d = g->d;
    double worst = 0;
    const double *c = g->c;
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            for (size_t l = 0; l < d; l++) {
                worst = fmax(worst, fabs(c[(i * d + j) * d + l] + c[(j * d + i) * d + l]));
                for (size_t k = 0; k < d; k++) { /* [[i,j],l] + [[j,l],i] + [[l,i],j] */
                    double sum = 0;
                    for (size_t n = 0; n < d; n++)
                        sum += c[(i * d + j) * d + n] * c[(n * d + l) * d + k] +
                               c[(j * d + l) * d + n] * c[(n * d + i) * d + k] +
                               c[(l * d + i) * d + n] * c[(n * d + j) * d + k];
                    worst = fmax(worst, fabs(sum));
                }
            }
    return worst;
}

static const struct {
    const char *letters, *name;
    size_t centre;
} products[] = {
    {"o", "SO(3)", 0},           {"oo", "SO(3)^2", 0},        {"eo", "SO(3) x SE(2)", 0},
    {"er", "SE(2) x R", 1},      {"errr", "SE(2) x R^3", 3},  {"ee", "SE(2)^2", 0},
    {"h", "Heisenberg", 1},      {"hr", "Heisenberg x R", 2}, {"hh", "Heisenberg^2", 2},
    {"s", "SE(3)", 0},           {"srr", "SE(3) x R^2", 2},   {"la", "SL(2,R) x Aff(1)", 0},
    {"p", "E(1,1)", 0},          {"per", "SE(2) x E(1,1) x R", 1}, {"oehr", "SO(3) x SE(2) x Heisenberg x R", 2},
    {"sss", "SE(3)^3", 0},       {"hhh", "Heisenberg^3", 3}, {"ooooooo", "SO(3)^7", 0}, {"oooooooo", "(an algebra of dimension 24)", 0},
    {"rrrr", "R^4", 4},          {"f", "(an algebra of dimension 4)", 1},  {"d", "(an algebra of dimension 3)", 0},
};

Test(algebra, products_in_random_bases_are_named, WHOLE_ONLY)
{
    for (size_t i = 0; i < sizeof products / sizeof *products; i++)
        for (uint64_t seed = 1; seed <= 6; seed++) {
            if (!sweep_tries(i + seed, 2, 6)) continue;
            nh_algebra plain = product(products[i].letters);
            double *t = nh_alloc_array(plain.d * plain.d, sizeof *t);
            nh_algebra g = in_random_basis(&plain, 77 * seed + i, t);
            nh_algebra_report r;
            nh_text name;
            nh_text_init(&name);
            cr_expect_lt(jacobi(&plain), 1e-14);
            nh_algebra_report_init(&r, &g, SMALL, CLUSTER, MOST, seed);
            nh_algebra_name(&r, NULL, &name);
            cr_expect_str_eq(nh_text_string(&name), products[i].name, "%s, seed %d: %s", products[i].letters, (int)seed, nh_text_string(&name));
            cr_expect_eq(r.centre, products[i].centre, "%s: centre %zu", products[i].letters, r.centre);
            size_t sum = 0; /* the pieces are ideals and fill the algebra */
            for (size_t p = 0; p < r.pieces; p++) {
                sum += r.piece[p].dimension;
                double off = nh_algebra_ideal(&g, r.piece[p].dimension, r.piece[p].basis) / fmax(nh_largest(g.d * g.d * g.d, g.c), 1e-3);
                cr_expect_lt(off, 1e-5, "%s: a piece is off an ideal by %g", products[i].letters, off);
            }
            cr_expect_eq(sum, g.d);
            nh_text_clear(&name);
            nh_algebra_report_clear(&r);
            nh_algebra_clear(&g);
            nh_algebra_clear(&plain);
            nh_free(t);
        }
}

Test(algebra, series_of_known_algebras)
{
    static const struct {
        const char *letters;
        size_t derived[4], derived_length, lower[4], lower_length, radical;
    } known[] = {{"h", {3, 1, 0}, 3, {3, 1, 0}, 3, 3},  {"e", {3, 2, 0}, 3, {3, 2}, 2, 3}, {"o", {3}, 1, {3}, 1, 0},
                 {"f", {4, 2, 0}, 3, {4, 2, 1, 0}, 4, 4}, {"s", {6}, 1, {6}, 1, 3},         {"or", {4, 3}, 2, {4, 3}, 2, 1}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        nh_algebra g = product(known[i].letters);
        nh_algebra_report r;
        nh_algebra_report_init(&r, &g, SMALL, CLUSTER, MOST, 3);
        cr_expect_eq(r.derived_length, known[i].derived_length, "%s: derived length %zu", known[i].letters, r.derived_length);
        cr_expect_eq(r.lower_length, known[i].lower_length, "%s: lower length %zu", known[i].letters, r.lower_length);
        for (size_t k = 0; k < known[i].derived_length; k++) cr_expect_eq(r.derived[k], known[i].derived[k], "%s", known[i].letters);
        for (size_t k = 0; k < known[i].lower_length; k++) cr_expect_eq(r.lower[k], known[i].lower[k], "%s", known[i].letters);
        cr_expect_eq(r.radical, known[i].radical, "%s: radical %zu", known[i].letters, r.radical);
        nh_algebra_report_clear(&r);
        nh_algebra_clear(&g);
    }
}

Test(algebra, circles_are_told_from_lines)
{
    nh_algebra g = product("err");
    nh_algebra_report r;
    nh_text name;
    nh_text_init(&name);
    bool closed[3] = {false, true, true};
    nh_algebra_report_init(&r, &g, SMALL, CLUSTER, MOST, 5);
    nh_algebra_name(&r, closed, &name);
    cr_expect_str_eq(nh_text_string(&name), "SE(2) x SO(2)^2");
    nh_text_clear(&name);
    nh_algebra_report_clear(&r);
    nh_algebra_clear(&g);
}

/* exp(ad_x) is an automorphism, and <ad*_x mu, y> = <mu, [x, y]>. */
Test(algebra, adjoint_and_coadjoint)
{
    uint64_t seed = 2385;
    nh_algebra plain = product("seo");
    size_t d = plain.d;
    double *t = nh_alloc_array(4 * d * d + 8 * d, sizeof *t), *ad = t + d * d, *e = ad + d * d, *v = e + d * d;
    nh_algebra g = in_random_basis(&plain, 41, t);
    double *x = v, *y = x + d, *z = y + d, *mu = z + d, *b = mu + d, *eb = b + d, *ey = eb + d, *ez = ey + d, left = 0, right = 0;
    double bracket[12];
    for (size_t i = 0; i < 4 * d; i++) v[i] = 0.4 * (2 * nh_random(&seed) - 1);
    nh_algebra_ad(&g, x, ad);
    nh_matrix_exp(d, ad, e);
    nh_algebra_bracket(&g, y, z, b);
    nh_multiply(d, 1, d, e, b, eb);
    nh_multiply(d, 1, d, e, y, ey);
    nh_multiply(d, 1, d, e, z, ez);
    nh_algebra_bracket(&g, ey, ez, bracket);
    for (size_t i = 0; i < d; i++) cr_expect_float_eq(bracket[i], eb[i], 1e-10 * (1 + nh_largest(d, eb)));
    nh_algebra_coad(&g, x, mu, b);
    nh_algebra_bracket(&g, x, y, eb);
    for (size_t i = 0; i < d; i++) left += b[i] * y[i], right += mu[i] * eb[i];
    cr_expect_float_eq(left, right, 1e-12 * (1 + fabs(left)));
    cr_expect_gt(fabs(left), 1e-3);
    nh_algebra_clear(&plain);
    nh_algebra_clear(&g);
    nh_free(t);
}

/* An ideal and a subalgebra that is none, of se(3). */
Test(algebra, ideals)
{
    nh_algebra g = product("s");
    double translations[18] = {0}, rotations[18] = {0}, off;
    for (size_t i = 0; i < 3; i++) translations[3 + i + 6 * i] = rotations[i + 6 * i] = 1;
    cr_expect_lt(nh_algebra_ideal(&g, 3, translations), 1e-14);
    cr_expect_gt(nh_algebra_ideal(&g, 3, rotations), 0.5);
    nh_algebra sub = nh_algebra_change(&g, 3, rotations, &off);
    cr_expect_lt(off, 1e-14);
    cr_expect_eq(nh_algebra_kind_of(&sub, SMALL, 1), NH_SO3);
    nh_algebra_clear(&sub);
    rotations[0] = 0, rotations[3] = 1; /* one translation among two rotations does not close */
    sub = nh_algebra_change(&g, 3, rotations, &off);
    cr_expect_gt(off, 0.5);
    nh_algebra_clear(&sub);
    nh_algebra_clear(&g);
}
