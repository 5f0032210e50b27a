/* Linear systems in the graph: the solution solves, numerically, at many points. */
#include <criterion/criterion.h>
#include <math.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "exact/solve.h"
#include "random_expression.h"
#include "sweep.h"

enum { largest = 5 };

/* The least absolute value at a few points. */
static double score(void *context, nh_ex e)
{
    source *s = context;
    double least = INFINITY;
    for (int k = 0; k < 4; k++) {
        double at[SYMBOLS] = {0.7 + 0.21 * k, 1.3 - 0.17 * k, 0.4 + 0.13 * k, 1.1 + 0.05 * k * k}, size = 0;
        double value = naive_value(s->dag, e, s->symbol, at, &size);
        if (!isfinite(value)) return 0;
        least = fmin(least, fabs(value) < 1e-12 * size ? 0 : fabs(value));
    }
    return least;
}

static double value_of(const source *s, nh_ex e)
{
    double size = 0;
    return naive_value(s->dag, e, s->symbol, (double[]){0.81, 1.17, 0.523, 1.31}, &size);
}

static nh_ex entry(source *s)
{
    static const char *const text[] = {"0", "1", "x", "y", "sin(x)", "cos(x)", "x*y", "omega - y", "2*x' + 3", "exp(y)", "-x'^2", "1/x"};
    return parsed(s->dag, text[random_below(s, sizeof text / sizeof *text)]);
}

static void expect_solution(source *s, const nh_lu *lu, size_t n, const nh_ex *a)
{
    nh_ex b[largest] = {0}, x[largest] = {0};
    for (size_t i = 0; i < n; i++) x[i] = b[i] = entry(s);
    nh_lu_solve(lu, x, x); /* in place */
    double scale = 1;
    for (size_t j = 0; j < n; j++) scale += fabs(value_of(s, x[j]));
    for (size_t i = 0; i < n; i++) {
        double sum = -value_of(s, b[i]);
        for (size_t j = 0; j < n; j++) sum += value_of(s, a[i * n + j]) * value_of(s, x[j]);
        cr_assert_float_eq(sum, 0, 1e-9 * scale, "row %zu of %zu: %g", i, n, sum);
    }
}

Test(solve, random_matrices, PLAIN_ONLY)
{
    size_t solved = 0;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        source s = source_create(seed);
        nh_ex a[largest * largest];
        size_t n = 1 + seed % 4, rank;
        for (size_t i = 0; i < n * n; i++) a[i] = seed % 3 == 0 && i % (n + 1) == 0 && n > 1 ? nh_int(s.dag, 0) : entry(&s);
        nh_lu *lu = nh_lu_create(s.dag, n, a, score, &s, &rank);
        cr_assert_eq(lu != NULL, rank == n);
        if (lu) {
            expect_solution(&s, lu, n, a);
            solved++;
        }
        nh_lu_free(lu);
        nh_dag_free(s.dag);
    }
    cr_expect_gt(solved, 100, "%zu", solved);
}

static size_t rank_of(size_t n, const char *const *text)
{
    source s = source_create(1);
    nh_ex a[largest * largest];
    size_t rank = 77;
    for (size_t i = 0; i < n * n; i++) a[i] = parsed(s.dag, text[i]);
    nh_lu *lu = nh_lu_create(s.dag, n, a, score, &s, &rank);
    cr_expect_eq(lu != NULL, rank == n);
    nh_lu_free(lu);
    nh_dag_free(s.dag);
    return rank;
}

Test(solve, rank)
{
    cr_expect_eq(rank_of(2, (const char *const[]){"x", "y", "2*x", "2*y"}), 1);
    cr_expect_eq(rank_of(2, (const char *const[]){"0", "x", "y", "0"}), 2);
    cr_expect_eq(rank_of(2, (const char *const[]){"0", "x", "0", "y"}), 1, "the first column is skipped");
    cr_expect_eq(rank_of(1, (const char *const[]){"0"}), 0);
    cr_expect_eq(rank_of(3, (const char *const[]){"sin(x)^2", "cos(x)^2", "1", "1", "1", "2", "1 + sin(x)^2", "1 + cos(x)^2", "3"}), 2);
    cr_expect_eq(rank_of(3, (const char *const[]){"0", "x", "1", "0", "y", "2", "0", "x*y", "y"}), 2);
    cr_expect_eq(rank_of(3, (const char *const[]){"cos(x)", "sin(x)", "0", "-sin(x)", "cos(x)", "0", "x", "y", "1"}), 3);
    cr_expect_eq(rank_of(0, NULL), 0);
}

/* The rolling disc's kind of matrix: an identity hidden behind trigonometry must not be divided by. */
Test(solve, hidden_zero_pivots)
{
    source s = source_create(1);
    const char *const text[] = {"sin(x)^2 + cos(x)^2 - 1", "y", "x", "1"};
    nh_ex a[4];
    for (int i = 0; i < 4; i++) a[i] = parsed(s.dag, text[i]);
    nh_lu *lu = nh_lu_create(s.dag, 2, a, score, &s, NULL);
    cr_assert(lu);
    expect_solution(&s, lu, 2, a);
    nh_lu_free(lu);
    nh_dag_free(s.dag);
}
