/* The null space on flows whose integrals are known, and the promises of the header: the spectrum is a property of the span,
 * not of the columns; a near-dependence is no integral; a shallow gap is undecided. */
#include <criterion/criterion.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "integrals/nullspace.h"
#include "samples.h"

static const nh_nullspace_options OPTIONS = {1e-9, 100, 1e5, 1e3, 1e6, 1e-7, 1e-11};

/* Solve from copies, fed in blocks of these sizes. */
static nh_nullspace *solve_with(const samples *s, size_t block_a, size_t block_b, const nh_nullspace_options *options, nh_error *error)
{
    nh_equations *equations = nh_equations_create(s->columns, 1);
    size_t count = s->rows * s->columns;
    double *a = nh_alloc_array(count, sizeof *a), *b = nh_alloc_array(count, sizeof *b);
    memcpy(a, s->a, count * sizeof *a);
    memcpy(b, s->b, count * sizeof *b);
    for (size_t i = 0; i < s->rows; i += block_a)
        nh_equations_add(equations, block_a < s->rows - i ? block_a : s->rows - i, a + i, s->rows);
    for (size_t i = 0; i < s->rows; i += block_b)
        nh_equations_add_values(equations, block_b < s->rows - i ? block_b : s->rows - i, b + i, s->rows);
    nh_nullspace *result = nh_nullspace_solve(equations, options, error);
    nh_equations_free(equations);
    nh_free(a);
    nh_free(b);
    return result;
}

static nh_nullspace *solve(const samples *s)
{
    nh_error error = {0};
    nh_nullspace *result = solve_with(s, s->rows, s->rows, &OPTIONS, &error);
    cr_assert(result, "%s", error.what);
    return result;
}

/* |a c| and |b c - mean|. */
static void apply(const samples *s, const double *c, double *rate, double *variation)
{
    double *x = nh_alloc_array(s->rows, sizeof *x), *y = nh_alloc_array(s->rows, sizeof *y), mean = 0;
    nh_multiply(s->rows, 1, s->columns, s->a, c, x);
    nh_multiply(s->rows, 1, s->columns, s->b, c, y);
    for (size_t i = 0; i < s->rows; i++)
        mean += y[i] / (double)s->rows;
    *rate = *variation = 0;
    for (size_t i = 0; i < s->rows; i++) {
        *rate = hypot(*rate, x[i]);
        *variation = hypot(*variation, y[i] - mean);
    }
    nh_free(x);
    nh_free(y);
}

static size_t count_dropped(const nh_nullspace *n)
{
    size_t count = 0;
    for (size_t j = 0; j < n->columns; j++)
        count += n->dropped[j];
    return count;
}

/* What must hold of any result. */
static void check_vectors(const samples *s, const nh_nullspace *n)
{
    cr_assert_eq(n->columns, s->columns);
    cr_assert_eq(n->rows, s->rows);
    cr_assert_eq(n->rank + count_dropped(n), n->columns);
    for (size_t j = 1; j < n->rank; j++)
        cr_assert_geq(n->spectrum[j], n->spectrum[j - 1]);
    for (size_t k = 0; k < n->dimension; k++) {
        const double *c = n->vector + k * n->columns;
        double rate, variation, largest = 0;
        apply(s, c, &rate, &variation);
        cr_assert_lt(rate, 1e-11, "vector %zu changes: %g", k, rate);
        cr_assert_float_eq(variation, 1, 1e-11, "vector %zu varies by %.15g", k, variation);
        for (size_t j = 0; j < n->columns; j++) {
            cr_assert(!n->dropped[j] || c[j] == 0);
            largest = fabs(c[j]) > fabs(largest) ? c[j] : largest;
        }
        cr_assert_gt(largest, 0, "the sign of vector %zu", k);
    }
}

Test(nullspace, finds_the_axis_of_a_rotation)
{
    samples s = rotation(64, 1, false, true);
    nh_nullspace *n = solve(&s);
    check_vectors(&s, n);
    cr_assert_eq(n->verdict, NH_FOUND);
    cr_assert_eq(n->rank, 3);
    cr_assert_eq(n->dimension, 1);
    cr_assert_gt(n->gap, 1e12);
    for (size_t k = 0; k < 3; k++) /* columns z, y, x: the one of total 1 and i = j = 0 comes first */
        cr_assert_float_eq(n->vector[k] / n->vector[0], AXIS[2 - k] / AXIS[2], 1e-13);
    nh_nullspace_free(n);
    discard(&s);
}

/* Functions of w = AXIS.x without the constants: degree of them.  Functions on the sphere of degree <= d: (d + 1)^2, so the
 * identity x.x = 1 and its multiples are dropped, not reported. */
Test(nullspace, the_identity_of_the_sphere_is_dropped_and_not_a_symmetry)
{
    for (size_t degree = 2; degree <= 5; degree++)
        for (int chebyshev = 0; chebyshev < 2; chebyshev++) {
            samples s = rotation(4 * products(degree), degree, chebyshev, true);
            nh_nullspace *n = solve(&s);
            check_vectors(&s, n);
            cr_assert_eq(n->verdict, NH_FOUND);
            cr_assert_eq(n->rank, (degree + 1) * (degree + 1) - 1, "degree %zu: rank %zu", degree, n->rank);
            cr_assert_eq(n->dimension, degree, "degree %zu: dimension %zu", degree, n->dimension);
            cr_assert_lt(n->largest_dropped, 1e-13);
            cr_assert_not(n->rank_in_doubt);
            nh_nullspace_free(n);
            discard(&s);
        }
}

static void check_same_spectrum(const nh_nullspace *p, const nh_nullspace *q, double tolerance, const char *what)
{
    cr_assert_eq(p->rank, q->rank, "%s", what);
    cr_assert_eq(p->dimension, q->dimension, "%s", what);
    cr_assert_eq(p->verdict, q->verdict, "%s", what);
    for (size_t j = p->dimension; j < p->rank; j++)
        cr_assert_float_eq(p->spectrum[j] / q->spectrum[j], 1, tolerance, "%s: sigma_%zu %g, %g", what, j, p->spectrum[j],
                           q->spectrum[j]);
}

Test(nullspace, monomials_and_chebyshev_have_one_spectrum)
{
    state = 700;
    samples s = rotation(400, 5, false, false);
    state = 700;
    samples t = rotation(400, 5, true, false);
    nh_nullspace *p = solve(&s), *q = solve(&t);
    cr_assert_eq(p->rank, 55);
    cr_assert_eq(p->dimension, 11); /* w^i r^2j, 0 < i + 2 j <= 5 */
    check_same_spectrum(p, q, 1e-11, "bases");
    nh_nullspace_free(p);
    nh_nullspace_free(q);
    discard(&s);
    discard(&t);
}

/* A copy with its columns in another order (order may be NULL) and scaled. */
static samples rearranged(const samples *s, const size_t *order, const double *scale)
{
    samples t = make(s->rows, s->columns);
    for (size_t j = 0; j < s->columns; j++)
        for (size_t i = 0; i < s->rows; i++) {
            size_t from = i + (order ? order[j] : j) * s->rows;
            t.a[i + j * s->rows] = s->a[from] * (scale ? scale[j] : 1);
            t.b[i + j * s->rows] = s->b[from] * (scale ? scale[j] : 1);
        }
    return t;
}

Test(nullspace, the_spectrum_depends_neither_on_the_order_nor_on_the_units_of_columns)
{
    samples s = rotation(200, 4, false, false);
    size_t order[64];
    double scale[64];
    for (size_t j = 0; j < s.columns; j++) {
        order[j] = (j * 13 + 5) % s.columns; /* 34 columns, no common factor */
        scale[j] = pow(10, 8 * uniform());
    }
    scale[3] = 1e8;
    scale[4] = 1e-8;
    samples permuted = rearranged(&s, order, NULL), scaled = rearranged(&s, NULL, scale), both = rearranged(&s, order, scale);
    nh_nullspace *n = solve(&s), *p = solve(&permuted), *q = solve(&scaled), *r = solve(&both);
    check_vectors(&s, n);
    check_vectors(&permuted, p);
    check_same_spectrum(n, p, 1e-12, "order");
    check_same_spectrum(n, q, 1e-12, "units");
    check_same_spectrum(n, r, 1e-12, "both");
    cr_assert_eq(n->dimension, 8);
    cr_assert_gt(q->gap, 1e11);
    nh_nullspace *results[] = {n, p, q, r};
    samples *all[] = {&s, &permuted, &scaled, &both};
    for (size_t k = 0; k < 4; k++) {
        nh_nullspace_free(results[k]);
        discard(all[k]);
    }
}

Test(nullspace, blocks_do_not_show_at_all)
{
    samples s = rotation(150, 3, false, true);
    nh_nullspace *n = solve(&s);
    const size_t sizes[][2] = {{1, 1}, {7, 64}, {64, 65}, {149, 3}};
    for (size_t k = 0; k < 4; k++) {
        nh_nullspace *p = solve_with(&s, sizes[k][0], sizes[k][1], &OPTIONS, NULL);
        cr_assert_eq(p->rank, n->rank);
        cr_assert_eq(memcmp(p->spectrum, n->spectrum, n->rank * sizeof(double)), 0);
        cr_assert_eq(memcmp(p->vector, n->vector, n->columns * n->dimension * sizeof(double)), 0);
        nh_nullspace_free(p);
    }
    nh_nullspace_free(n);
    discard(&s);
}

/* x' = 1 has no integral but constants; x^1 .. x^13 on [0.8, 1] are nearly dependent, and so are their rates. */
Test(nullspace, a_near_dependence_is_not_an_integral)
{
    enum { N = 13 };
    samples s = make(120, N);
    for (size_t i = 0; i < s.rows; i++) {
        double x = 0.9 + 0.1 * uniform();
        for (size_t j = 0; j < N; j++)
            s.b[i + j * s.rows] = power(false, j + 1, x, &s.a[i + j * s.rows]);
    }
    double *plain = nh_alloc_array(s.rows * N, sizeof *plain), sigma[N];
    memcpy(plain, s.a, s.rows * N * sizeof *plain);
    cr_assert(nh_svd(s.rows, N, plain, sigma, NULL, NULL));
    cr_assert_lt(sigma[N - 1], 100 * DBL_EPSILON * sigma[0], "the test needs what a plain SVD calls null");
    nh_nullspace *n = solve(&s);
    cr_assert_eq(n->verdict, NH_NONE);
    cr_assert_eq(n->dimension, 0);
    cr_assert_gt(n->rank, 3);
    cr_assert_gt(n->spectrum[0], 1, "the slowest polynomial changes as fast as x: %g", n->spectrum[0]);
    cr_assert(isinf(n->gap));
    nh_nullspace_free(n);
    nh_free(plain);
    discard(&s);
}

/* Columns f, f + eps g of unrelated functions: their difference is small, but changes as fast as g does. */
Test(nullspace, nearly_equal_columns_are_not_an_integral)
{
    samples s = make(80, 3);
    for (size_t i = 0; i < s.rows; i++) {
        double f = uniform(), g = uniform();
        s.b[i] = f;
        s.b[i + s.rows] = f + 1e-8 * g;
        s.b[i + 2 * s.rows] = uniform();
        double rf = uniform(), rg = uniform();
        s.a[i] = 1e-5 * rf;
        s.a[i + s.rows] = 1e-5 * (rf + 1e-8 * rg);
        s.a[i + 2 * s.rows] = uniform();
    }
    nh_nullspace *n = solve(&s);
    cr_assert_eq(n->rank, 3);
    cr_assert_eq(n->verdict, NH_NONE);
    cr_assert(n->spectrum[0] > 1e-6 && n->spectrum[0] < 1e-4, "%g", n->spectrum[0]);
    nh_nullspace_free(n);
    discard(&s);
}

static void disturb(samples *s, double size)
{
    for (size_t i = 0; i < s->rows * s->columns; i++)
        s->a[i] += size * uniform();
}

Test(nullspace, noise_is_undecided_and_more_noise_is_none)
{
    samples s = rotation(100, 2, false, false);
    disturb(&s, 1e-12);
    nh_nullspace *n = solve(&s);
    cr_assert_eq(n->verdict, NH_UNDECIDED);
    cr_assert_eq(n->dimension, 0);
    nh_nullspace_free(n);
    disturb(&s, 1e-6);
    n = solve(&s);
    cr_assert_eq(n->verdict, NH_NONE);
    nh_nullspace_free(n);
    discard(&s);
}

/* One integral at round-off and one at 1e-12: still undecided, and the first one is told. */
Test(nullspace, an_undecided_value_next_to_a_null_one_is_undecided)
{
    samples s = rotation(100, 1, false, false), t = make(100, 4);
    memcpy(t.a, s.a, 300 * sizeof(double));
    memcpy(t.b, s.b, 300 * sizeof(double));
    for (size_t i = 300; i < 400; i++) {
        t.b[i] = uniform();
        t.a[i] = 1e-12 * uniform();
    }
    nh_nullspace *n = solve(&t);
    check_vectors(&t, n);
    cr_assert_eq(n->verdict, NH_UNDECIDED);
    cr_assert_eq(n->dimension, 1);
    cr_assert_lt(n->gap, 1e5);
    nh_nullspace_free(n);
    discard(&s);
    discard(&t);
}

/* Independent noise columns of sizes 1e-13, 1e-12 and 1; no undecided band, null up to about 7e-13: only the gap speaks. */
Test(nullspace, a_shallow_gap_is_undecided)
{
    const double sizes[] = {1e-13, 1e-12, 1};
    samples s = make(100, 3);
    for (size_t i = 0; i < 300; i++) {
        s.b[i] = uniform();
        s.a[i] = sizes[i / 100] * uniform();
    }
    nh_nullspace_options options = OPTIONS;
    options.undecided = 1;
    options.zero = 4e-13 / DBL_EPSILON;
    nh_nullspace *n = solve_with(&s, 100, 100, &options, NULL);
    cr_assert_eq(n->dimension, 1);
    cr_assert(n->gap > 2 && n->gap < 50, "%g", n->gap);
    cr_assert_eq(n->verdict, NH_UNDECIDED);
    nh_nullspace_free(n);
    options.gap = 2;
    n = solve_with(&s, 100, 100, &options, NULL);
    cr_assert_eq(n->verdict, NH_FOUND);
    nh_nullspace_free(n);
    discard(&s);
}

Test(nullspace, a_sector_of_nothing_but_integrals)
{
    samples s = make(50, 4);
    for (size_t i = 0; i < 200; i++)
        s.b[i] = uniform();
    for (int round = 0; round < 2; round++) { /* rates exactly 0, then at round-off */
        nh_nullspace *n = solve(&s);
        check_vectors(&s, n);
        cr_assert_eq(n->verdict, NH_FOUND);
        cr_assert_eq(n->dimension, 4);
        cr_assert(isinf(n->gap));
        nh_nullspace_free(n);
        disturb(&s, 1e-16);
    }
    discard(&s);
}

Test(nullspace, rounding_grows_with_the_unit_of_time)
{
    samples s = rotation(100, 2, false, false);
    for (size_t i = 0; i < s.rows * s.columns; i++)
        s.a[i] *= 1e7 / 3;
    nh_nullspace *n = solve(&s);
    cr_assert_eq(n->verdict, NH_FOUND);
    cr_assert_eq(n->dimension, 3);
    cr_assert_gt(n->spectrum[2], 1e-11);
    nh_nullspace_free(n);
    discard(&s);
}

Test(nullspace, constants_and_zeros_are_dropped)
{
    samples s = make(50, 3), t = make(50, 5);
    for (size_t i = 0; i < 50; i++) {
        s.b[i] = 2.385e7;
        s.b[i + 100] = -3.1 * (1 + 1e-14 * uniform()); /* constant but for rounding */
        t.b[i + 50] = t.b[i + 100] = 1e9;
        t.b[i + 100] += uniform();
        t.a[i + 100] = uniform();
        t.b[i + 200] = uniform();
    }
    nh_nullspace *n = solve(&s);
    cr_assert_eq(n->rank, 0);
    cr_assert_eq(n->dimension, 0);
    cr_assert_eq(n->verdict, NH_NONE);
    cr_assert_eq(count_dropped(n), 3);
    nh_nullspace_free(n);
    n = solve(&t);
    cr_assert_eq(n->verdict, NH_FOUND);
    cr_assert_eq(n->dimension, 1);
    const bool expected[] = {true, true, false, true, false};
    cr_assert_eq(memcmp(n->dropped, expected, sizeof expected), 0);
    cr_assert_gt(n->vector[4], 0);
    cr_assert(n->spectrum[0] < 1e-16 && isfinite(n->gap), "sigma %g, gap %g", n->spectrum[0], n->gap);
    nh_nullspace_free(n);
    discard(&s);
    discard(&t);
}

Test(nullspace, a_rank_without_a_gap_is_in_doubt)
{
    samples s = make(80, 3);
    double second = 1e-8, third = 1e-10;
    for (int round = 0; round < 2; round++, second = 1e-3) {
        for (size_t i = 0; i < 80; i++) {
            double f = s.b[i] = uniform();
            s.b[i + 80] = f + second * uniform();
            s.b[i + 160] = f + third * uniform();
            s.a[i] = uniform();
            s.a[i + 80] = uniform();
            s.a[i + 160] = s.a[i];
        }
        nh_nullspace *n = solve(&s);
        cr_assert_eq(n->rank, 2);
        cr_assert_eq(n->rank_in_doubt, round == 0, "kept %g, dropped %g", n->smallest_kept, n->largest_dropped);
        nh_nullspace_free(n);
    }
    discard(&s);
}

Test(nullspace, what_is_not_finite_names_its_column)
{
    const double bad[] = {NAN, INFINITY};
    for (int in_values = 0; in_values < 2; in_values++)
        for (size_t k = 0; k < 2; k++) {
            samples s = rotation(40, 2, false, true);
            (in_values ? s.b : s.a)[17 + 6 * s.rows] = bad[k];
            nh_error error = {0};
            cr_assert_null(solve_with(&s, 16, 16, &OPTIONS, &error));
            cr_assert_eq(error.code, NH_NUMERIC);
            cr_assert(strstr(error.what, "column 6 "), "%s", error.what);
            cr_assert(strstr(error.what, in_values ? "values" : "equations"), "%s", error.what);
            discard(&s);
        }
}

/* The same with the column left out: the others' null vectors stay, whatever came before the row that is not finite. */
Test(nullspace, what_is_not_finite_can_be_left_out)
{
    for (int in_values = 0; in_values < 2; in_values++) {
        samples s = rotation(60, 2, false, true);
        size_t rows = s.rows, n = s.columns;
        nh_nullspace *all = solve(&s);
        nh_equations *equations = nh_equations_create(n, 1);
        nh_equations_leave_out(equations);
        (in_values ? s.b : s.a)[47 + 6 * rows] = NAN;
        for (size_t i = 0; i < rows; i += 20) {
            nh_equations_add(equations, 20, s.a + i, rows);
            nh_equations_add_values(equations, 20, s.b + i, rows);
        }
        nh_error error = {0};
        nh_nullspace *rest = nh_nullspace_solve(equations, &OPTIONS, &error);
        cr_assert(rest, "%s", error.what);
        cr_expect(rest->dropped[6] && !all->dropped[6] && rest->rank == all->rank - 1);
        bool used = false; /* did a null vector need the column? */
        for (size_t k = 0; k < all->dimension; k++) used |= fabs(all->vector[6 + k * n]) > 1e-8;
        cr_expect_eq(rest->dimension, all->dimension - used);
        for (size_t k = 0; k < rest->dimension; k++) cr_expect_eq(rest->vector[6 + k * n], 0);
        nh_nullspace_free(rest);
        nh_nullspace_free(all);
        nh_equations_free(equations);
        discard(&s);
    }
}

Test(nullspace, too_few_rows_are_refused_with_the_numbers)
{
    samples s = rotation(9, 2, false, false); /* 9 columns: the mean takes a tenth row */
    nh_error error = {0};
    cr_assert_null(solve_with(&s, 9, 9, &OPTIONS, &error));
    cr_assert_eq(error.code, NH_NUMERIC);
    cr_assert(strstr(error.what, "9 columns"), "%s", error.what);
    cr_assert(error.hint[0]);
    discard(&s);
    s = rotation(10, 2, false, false);
    nh_nullspace *n = solve_with(&s, 10, 10, &OPTIONS, NULL);
    cr_assert_eq(n->dimension, 3); /* w, w^2, r^2 */
    nh_nullspace_free(n);
    nh_equations *equations = nh_equations_create(9, 1);
    nh_equations_add(equations, 8, s.a, 10);
    nh_equations_add_values(equations, 10, s.b, 10);
    cr_assert_null(nh_nullspace_solve(equations, &OPTIONS, NULL));
    nh_equations_free(equations);
    discard(&s);
}
