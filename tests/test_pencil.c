/* The pencil on linear and polynomial flows whose eigenvalues are known. */
#include <criterion/criterion.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "integrals/pencil.h"
#include "samples.h"

static const nh_nullspace_options OPTIONS = {1e-9, 100, 1e5, 1e3, 1e6, 1e-7, 1e-11};
static const double SPLIT = 1e-4;

static void set(samples *s, size_t row, size_t column, double value, double rate)
{
    s->b[row + column * s->rows] = value;
    s->a[row + column * s->rows] = rate;
}

static nh_pencil *solve_split(const samples *s, double split, nh_error *error)
{
    size_t size = s->rows * s->columns * sizeof(double);
    double *a = nh_alloc(size), *b = nh_alloc(size);
    memcpy(a, s->a, size);
    memcpy(b, s->b, size);
    nh_pencil *pencil = nh_pencil_solve(s->rows, s->columns, a, b, &OPTIONS, split, error);
    nh_free(a);
    nh_free(b);
    return pencil;
}

static nh_pencil *solve(const samples *s)
{
    nh_error error = {0};
    nh_pencil *pencil = solve_split(s, SPLIT, &error);
    cr_assert(pencil, "%s", error.what);
    return pencil;
}

/* What must hold of any result: f is an eigenvector row by row, its largest entry has modulus 1, pairs are adjacent. */
static void check_pairs(const samples *s, const nh_pencil *p, double tolerance)
{
    cr_assert_eq(p->columns, s->columns);
    for (size_t k = 0; k < p->dimension; k++) {
        const double *x = p->vector_re + k * p->columns, *y = p->vector_im + k * p->columns;
        double largest = 0, above = 0, below = 0;
        for (size_t j = 0; j < p->columns; j++)
            largest = fmax(largest, hypot(x[j], y[j]));
        cr_assert_float_eq(largest, 1, 1e-14);
        for (size_t i = 0; i < s->rows; i++) {
            double ar = 0, ai = 0, br = 0, bi = 0;
            for (size_t j = 0; j < p->columns; j++) {
                double a = s->a[i + j * s->rows], b = s->b[i + j * s->rows];
                ar += a * x[j], ai += a * y[j], br += b * x[j], bi += b * y[j];
            }
            above += pow(ar - p->re[k] * br + p->im[k] * bi, 2) + pow(ai - p->re[k] * bi - p->im[k] * br, 2);
            below += br * br + bi * bi;
        }
        double residual = sqrt(above / below);
        cr_assert_lt(residual, tolerance, "pair %zu: residual %g", k, residual);
        cr_assert_leq(fabs(residual - p->residual[k]), 2e-14 + 1e-3 * residual, "%g is told, %g is true", p->residual[k], residual);
        if (p->im[k] > 0) {
            cr_assert_lt(k + 1, p->dimension);
            cr_assert(p->im[k + 1] == -p->im[k] && p->re[k + 1] == p->re[k]);
            for (size_t j = 0; j < p->columns; j++)
                cr_assert(x[j + p->columns] == x[j] && y[j + p->columns] == -y[j]);
        } else if (p->im[k] < 0)
            cr_assert(k > 0 && p->im[k - 1] == -p->im[k]);
    }
}

/* Distance of re + i im to the nearest eigenvalue; its index in *index. */
static double nearest(const nh_pencil *p, double re, double im, size_t *index)
{
    double least = INFINITY;
    for (size_t k = 0; k < p->dimension; k++) {
        double distance = hypot(p->re[k] - re, p->im[k] - im);
        if (distance < least) {
            least = distance;
            *index = k;
        }
    }
    return least;
}

static void expect(const nh_pencil *p, double re, double im, double tolerance)
{
    size_t index = 0;
    double distance = nearest(p, re, im, &index);
    cr_assert_lt(distance, tolerance, "%g %+g i is missing by %g", re, im, distance);
}

enum { FREQUENCIES = 4 };
static const double OMEGA[FREQUENCIES] = {0.37, 1, 2.385, 11.3};

/* x' = v, v' = -w^2 x for every w; then columns that are no part of it. */
static samples oscillators(size_t rows, size_t irrelevant)
{
    samples s = make(rows, 2 * FREQUENCIES + irrelevant);
    for (size_t i = 0; i < rows; i++) {
        for (size_t k = 0; k < FREQUENCIES; k++) {
            double x = uniform(), v = uniform();
            set(&s, i, 2 * k, x, v);
            set(&s, i, 2 * k + 1, v, -OMEGA[k] * OMEGA[k] * x);
        }
        for (size_t j = 2 * FREQUENCIES; j < s.columns; j++)
            set(&s, i, j, uniform(), 3 * uniform());
    }
    return s;
}

Test(pencil, oscillators_give_their_frequencies)
{
    samples s = oscillators(100, 0);
    nh_pencil *p = solve(&s);
    check_pairs(&s, p, 1e-12);
    cr_assert_eq(p->dimension, 2 * FREQUENCIES);
    for (size_t k = 0; k < FREQUENCIES; k++) {
        expect(p, 0, OMEGA[k], 1e-12);
        expect(p, 0, -OMEGA[k], 1e-12);
    }
    nh_pencil_free(p);
    discard(&s);
}

/* f = x + v / lambda: Gamma f = v + lambda x = lambda f with lambda^2 = -w^2. */
Test(pencil, irrelevant_columns_stay_out)
{
    samples s = oscillators(120, 15);
    nh_pencil *p = solve(&s);
    check_pairs(&s, p, 1e-11);
    cr_assert_eq(p->dimension, 2 * FREQUENCIES);
    for (size_t k = 0; k < FREQUENCIES; k++) {
        size_t at = 0;
        cr_assert_lt(nearest(p, 0, OMEGA[k], &at), 1e-11);
        const double *x = p->vector_re + at * p->columns, *y = p->vector_im + at * p->columns;
        double c = x[2 * k], d = y[2 * k]; /* v / x = -i / w: x_v + i y_v = (d - i c) / w */
        cr_assert_float_eq(x[2 * k + 1], d / OMEGA[k], 1e-11);
        cr_assert_float_eq(y[2 * k + 1], -c / OMEGA[k], 1e-11);
        for (size_t j = 0; j < p->columns; j++)
            cr_assert(j / 2 == k || hypot(x[j], y[j]) < 1e-11, "column %zu in the vector of %g", j, OMEGA[k]);
    }
    nh_pencil_free(p);
    discard(&s);
}

Test(pencil, neither_order_nor_units_nor_copies_of_columns_matter)
{
    samples s = oscillators(130, 5), t = make(130, s.columns + 3);
    for (size_t j = 0; j < t.columns; j++) {
        size_t from = j * 6 % s.columns; /* 13 columns: all, and three of them twice */
        double scale = pow(10, 8 * uniform());
        for (size_t i = 0; i < s.rows; i++)
            set(&t, i, j, scale * s.b[i + from * s.rows], scale * s.a[i + from * s.rows]);
    }
    nh_pencil *p = solve(&t);
    cr_assert_eq(p->dimension, 2 * FREQUENCIES);
    for (size_t k = 0; k < FREQUENCIES; k++)
        expect(p, 0, OMEGA[k], 1e-11);
    nh_pencil_free(p);
    discard(&s);
    discard(&t);
}

Test(pencil, real_and_damped_eigenvalues)
{
    samples s = make(60, 4); /* u' = 0.7 u; w' = -1.9 w; z' = (-0.3 + 1.1 i) z */
    for (size_t i = 0; i < 60; i++) {
        double u = uniform(), w = uniform(), x = uniform(), y = uniform();
        set(&s, i, 0, u + w, 0.7 * u - 1.9 * w);
        set(&s, i, 1, u - w, 0.7 * u + 1.9 * w);
        set(&s, i, 2, x, -0.3 * x - 1.1 * y);
        set(&s, i, 3, y, 1.1 * x - 0.3 * y);
    }
    nh_pencil *p = solve(&s);
    check_pairs(&s, p, 1e-13);
    cr_assert_eq(p->dimension, 4);
    expect(p, 0.7, 0, 1e-13);
    expect(p, -1.9, 0, 1e-13);
    expect(p, -0.3, 1.1, 1e-13);
    nh_pencil_free(p);
    discard(&s);
}

/* Free particle: x^i v^j, i + j <= 4: Jordan blocks at 0 of sizes up to 5, which eigenvalues alone would split to 1e-3. */
static size_t free_particle(samples *s, size_t row, size_t column)
{
    double x = 3 * uniform(), v = 3 * uniform();
    for (size_t i = 0; i <= 4; i++)
        for (size_t j = 0; i + j <= 4; j++)
            set(s, row, column++, pow(x, (double)i) * pow(v, (double)j),
                i ? (double)i * pow(x, (double)i - 1) * pow(v, (double)j + 1) : 0);
    return column;
}

Test(pencil, jordan_blocks_at_zero_are_left_out)
{
    samples s = make(100, 15);
    for (size_t i = 0; i < s.rows; i++)
        cr_assert_eq(free_particle(&s, i, 0), 15);
    nh_pencil *p = solve_split(&s, 0, NULL);
    cr_assert_eq(p->dimension, 0);
    nh_pencil_free(p);
    discard(&s);
}

Test(pencil, a_small_frequency_beside_jordan_blocks_is_found)
{
    samples s = make(100, 17);
    const double w = 2.385e-3;
    for (size_t i = 0; i < s.rows; i++) {
        double x = uniform(), v = uniform() * w;
        size_t next = free_particle(&s, i, 0);
        set(&s, i, next, x, v);
        set(&s, i, next + 1, v, -w * w * x);
    }
    nh_pencil *p = solve(&s);
    cr_assert_eq(p->dimension, 2);
    check_pairs(&s, p, 1e-11);
    expect(p, 0, w, 1e-11);
    nh_pencil_free(p);
    discard(&s);
}

Test(pencil, split_leaves_out_what_is_small_relative_to_the_scale)
{
    const double units[] = {1, 300, 1e-3};
    for (size_t k = 0; k < 3; k++) {
        samples s = make(40, 2);
        for (size_t i = 0; i < 40; i++)
            for (size_t j = 0; j < 2; j++) {
                double x = uniform();
                set(&s, i, j, x, (j ? 1e-5 : 1) * units[k] * x);
            }
        nh_pencil *p = solve(&s);
        cr_assert_eq(p->dimension, 1, "unit %g", units[k]);
        expect(p, units[k], 0, 1e-13 * units[k]);
        nh_pencil_free(p);
        p = solve_split(&s, 1e-6, NULL);
        cr_assert_eq(p->dimension, 2, "unit %g", units[k]);
        expect(p, 1e-5 * units[k], 0, 1e-13 * units[k]);
        nh_pencil_free(p);
        discard(&s);
    }
}

/* Rates that are wrong by 1e-11: proposed all the same, and the residual tells. */
Test(pencil, the_residual_tells_how_good_a_pair_is)
{
    samples s = oscillators(100, 0);
    for (size_t i = 0; i < s.rows * s.columns; i++)
        s.a[i] += 1e-11 * uniform();
    nh_pencil *p = solve(&s);
    cr_assert_eq(p->dimension, 2 * FREQUENCIES);
    check_pairs(&s, p, 1e-10);
    for (size_t k = 0; k < p->dimension; k++)
        cr_assert_gt(p->residual[k], 3e-12);
    nh_pencil_free(p);
    discard(&s);
}

/* The plane's velocity (ux, uy) turned by a heading with q' = omega: Gamma f = lambda omega f only for lambda = +-i; with kappa = 1
 * there is nothing, since omega varies. */
Test(pencil, the_factor_decides)
{
    samples by_heading = make(70, 4), by_time = make(70, 4);
    for (size_t i = 0; i < 70; i++) {
        double x = uniform(), y = uniform(), omega = 2 + uniform();
        const double value[] = {x, y, x * omega, y * omega};
        const double rate[] = {-omega * y, omega * x, -omega * omega * y, omega * omega * x};
        for (size_t j = 0; j < 4; j++) {
            set(&by_heading, i, j, omega * value[j], rate[j]);
            set(&by_time, i, j, value[j], rate[j]);
        }
    }
    nh_pencil *p = solve(&by_heading), *q = solve(&by_time);
    check_pairs(&by_heading, p, 1e-12);
    cr_assert_eq(p->dimension, 4); /* f and omega f: +-i twice */
    for (size_t k = 0; k < 4; k++)
        cr_assert_float_eq(hypot(p->re[k], fabs(p->im[k]) - 1), 0, 1e-13);
    cr_assert_eq(q->dimension, 0);
    nh_pencil_free(p);
    nh_pencil_free(q);
    discard(&by_heading);
    discard(&by_time);
}

/* x' = x^2, y' = x y: null(rest) of {x, x^2, y} is not empty (x), but K takes it out of itself (to x^2, whose rate x^3 is
 * outside). */
Test(pencil, what_is_not_invariant_shrinks_to_nothing)
{
    samples s = make(50, 3);
    for (size_t i = 0; i < 50; i++) {
        double x = uniform(), y = uniform();
        set(&s, i, 0, x, x * x);
        set(&s, i, 1, x * x, 2 * x * x * x);
        set(&s, i, 2, y, x * y);
    }
    nh_pencil *p = solve(&s);
    cr_assert_eq(p->dimension, 0);
    cr_assert_eq(p->columns, 3);
    nh_pencil_free(p);
    discard(&s);
}

Test(pencil, zero_columns_and_only_integrals)
{
    samples s = make(30, 3);
    nh_pencil *p = solve(&s); /* all columns are zero: no basis */
    cr_assert_eq(p->dimension, 0);
    nh_pencil_free(p);
    for (size_t i = 0; i < 30; i++) {
        set(&s, i, 0, 2.385, 0);
        set(&s, i, 1, uniform(), 1e-15 * uniform());
    }
    p = solve(&s);
    cr_assert_eq(p->dimension, 0, "rounding is no frequency");
    nh_pencil_free(p);
    discard(&s);
}

Test(pencil, bad_input_is_refused_with_a_reason)
{
    samples s = oscillators(40, 0);
    nh_error error = {0};
    s.a[3 + 5 * 40] = NAN;
    cr_assert_null(solve_split(&s, SPLIT, &error));
    cr_assert_eq(error.code, NH_NUMERIC);
    cr_assert(strstr(error.what, "column 5 ") && strstr(error.what, "derivatives"), "%s", error.what);
    discard(&s);
    s = oscillators(15, 0); /* 8 columns */
    error = (nh_error){0};
    cr_assert_null(solve_split(&s, SPLIT, &error));
    cr_assert(strstr(error.what, "16") && error.hint[0], "%s", error.what);
    discard(&s);
}
