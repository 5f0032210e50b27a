/* Prints how long the null space takes next to matrix products of the same size, as markdown tables.
 *
 * B: m x n random numbers.  A = B diag(d) Z, Z orthogonal with three columns of d zero: a null space of dimension 3 that is not
 * along the columns.  One thread, except in the last column.  Rate: 2 m n^2 for each QR, n^3 for the quotient and 4 n^3 for its singular values and right vectors
 * [GolubVanLoan2013, sec. 8.6], over the seconds, relative to dgemm's.
 *
 * Then the null space of a real ansatz: the polynomials of two oscillators in the Chebyshev basis. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/linalg.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "geometry/model.h"
#include "integrals/nullspace.h"
#include "integrals/rows.h"

static double uniform(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) / 4503599627370496.0 - 1;
}

/* z := (1 - 2 w w^T / w^T w), then the first three columns 0: its null space has dimension 3 */
static void mixing(size_t n, double *z, unsigned long long *state)
{
    double *w = nh_alloc_array(n, sizeof *w), square = 0;
    for (size_t i = 0; i < n; i++)
        w[i] = uniform(state), square += w[i] * w[i];
    for (size_t j = 0; j < n; j++) /* D H: rows 0..2 vanish */
        for (size_t i = 0; i < n; i++)
            z[i + j * n] = i < 3 ? 0 : (double)(i == j) - 2 * w[i] * w[j] / square;
    nh_free(w);
}

/* Seconds for [A := B Z] as one product, and for the null space fed in blocks of 256 rows. */
static const nh_nullspace_options options = {1e-9, 100, 1e5, 1e3, 1e6, 1e-7, 1e-11};

/* The QR of A alone and the singular values and right vectors of its triangle: what numpy.linalg.svd is asked for. */
static double of_one_matrix(size_t n, size_t m, const double *a)
{
    double *copy = nh_alloc_array(m * n, sizeof *copy), *r = nh_alloc_array(2 * n * n + n, sizeof *r), begin = 0;
    memcpy(copy, a, m * n * sizeof *a);
    begin = nh_clock();
    nh_qr *qr = nh_qr_create(n, 1);
    nh_qr_add(qr, m, copy, m);
    nh_qr_triangle(qr, r);
    nh_svd(n, n, r, r + 2 * n * n, NULL, r + n * n);
    double seconds = nh_clock() - begin;
    nh_qr_free(qr);
    nh_free(r);
    nh_free(copy);
    return seconds;
}

/* The null space of A with the values B; *streamed: seconds until the last row was taken, *total: all of them. */
static nh_nullspace *solve(size_t n, size_t m, const double *a, const double *b, size_t threads, double *streamed, double *total)
{
    enum { BLOCK = 256 };
    double *rows_a = nh_alloc_array(BLOCK * n, sizeof *rows_a), *rows_b = nh_alloc_array(BLOCK * n, sizeof *rows_b), start = nh_clock();
    nh_equations *equations = nh_equations_create(n, threads);
    for (size_t i = 0; i < m; i += BLOCK) {
        size_t rows = m - i < BLOCK ? m - i : BLOCK;
        for (size_t j = 0; j < n; j++) {
            memcpy(rows_a + j * BLOCK, a + i + j * m, rows * sizeof *a);
            memcpy(rows_b + j * BLOCK, b + i + j * m, rows * sizeof *b);
        }
        nh_equations_add(equations, rows, rows_a, BLOCK);
        nh_equations_add_values(equations, rows, rows_b, BLOCK);
    }
    *streamed = nh_clock() - start;
    nh_nullspace *result = nh_nullspace_solve(equations, &options, NULL);
    *total = nh_clock() - start;
    nh_equations_free(equations);
    nh_free(rows_a);
    nh_free(rows_b);
    return result;
}

static void measure(size_t n, size_t m)
{
    unsigned long long state = 2385;
    double *b = nh_alloc_array(m * n, sizeof *b), *a = nh_alloc_array(m * n, sizeof *a), *z = nh_alloc_array(n * n, sizeof *z);
    for (size_t i = 0; i < m * n; i++)
        b[i] = uniform(&state);
    mixing(n, z, &state);
    nh_multiply(m, n, n, b, z, a);
    double start = nh_clock();
    nh_multiply(m, n, n, b, z, a);
    double product = nh_clock() - start;
    double streamed, total, shared, ignored;
    nh_nullspace_free(solve(n, m, a, b, nh_threads(0), &ignored, &shared));
    nh_nullspace *result = solve(n, m, a, b, 1, &streamed, &total);
    double work = 4.0 * (double)m * (double)n * (double)n + 5.0 * pow((double)n, 3), rate = work / total * product / (2.0 * (double)m * (double)n * (double)n);
    printf("| %zu | %zu | %.3f | %.3f | %.3f | %.3f | %.1f | %.0f %% | %zu | %.1e | %.3f | %.3f |\n", n, m, streamed, total - streamed, total, product, total / product, 100 * rate,
           result ? result->dimension : 0, result ? result->gap : 0, of_one_matrix(n, m, a), shared);
    nh_nullspace_free(result);
    nh_free(a);
    nh_free(b);
    nh_free(z);
}

/* Two oscillators with frequencies that are not rationally related. */
static const char oscillators[] = "name: oscillators\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 - (2*x^2 + 3.414*y^2)/2\n";

/* Values and rates of all columns at all points, into two arrays. */
static double assembly(const nh_model *o, const nh_ansatz *a, const nh_points *points)
{
    double *A = nh_alloc_array(nh_points_equations(points) * a->columns, sizeof *A), *B = nh_alloc_array(points->count * a->columns, sizeof *B), begin = nh_clock();
    nh_rows_all(o, a, points, A, B);
    double seconds = nh_clock() - begin;
    nh_free(A);
    nh_free(B);
    return seconds;
}

/* All polynomials up to this degree: assembly alone; the QR alone, of as many random numbers; the null space. */
static void measure_ansatz(size_t degree, size_t m)
{
    nh_error error;
    nh_error_clear(&error);
    nh_system *s = nh_system_parse("oscillators", oscillators, 0, NULL, &error);
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    nh_ex in[4] = {s->coordinate[0].q, s->coordinate[1].q, o->chart->w[0], o->chart->w[1]};
    nh_family family = {.kind = NH_POLYNOMIAL, .in = in, .in_count = 4, .degree = degree};
    nh_points *points = nh_points_create(o, m, 1, 1, &error);
    nh_ansatz *a = nh_ansatz_create(o, points, 1, &family, 5000, &error);
    nh_rows *rows = nh_rows_create(o, a, 0, NULL);
    size_t n = a->columns;
    nh_equations *equations = nh_equations_create(n, 1), *bare = nh_equations_create(n, 1);
    nh_rows_current(rows, points, NULL, equations);
    double begin, *block = nh_alloc_array(256 * n, sizeof *block), qr = 0;
    unsigned long long state = 2385;
    for (size_t i = 0; i < m; i += 256) {
        for (int k = 0; k < 2; k++) {
            for (size_t j = 0; j < 256 * n; j++) block[j] = uniform(&state);
            begin = nh_clock();
            if (k) nh_equations_add(bare, 256, block, 256);
            else nh_equations_add_values(bare, 256, block, 256);
            qr += nh_clock() - begin;
        }
    }
    begin = nh_clock();
    nh_nullspace *result = nh_nullspace_solve(equations, &options, &error);
    printf("| %zu | %zu | %.3f | %.3f | %.3f | %zu | %.1e |\n", n, m, assembly(o, a, points), qr, nh_clock() - begin, result ? result->dimension : 0, result ? result->gap : 0);
    nh_nullspace_free(result);
    nh_equations_free(bare);
    nh_equations_free(equations);
    nh_free(block);
    nh_rows_free(rows);
    nh_ansatz_free(a);
    nh_points_free(points);
    nh_model_free(o);
    nh_system_free(s);
}

int main(void)
{
    nh_linalg_threads(1);
    puts("| columns | rows of A and of B | both QR, s | quotient and SVD, s | null space, s | dgemm (rows x n)(n x n), s | ratio | rate | dimension (3 true) | gap | A alone: QR and SVD, s | null space on all processors, s |");
    puts("|---|---|---|---|---|---|---|---|---|---|---|---|");
    measure(200, 10000);
    measure(500, 20000);
    measure(1000, 20000);
    puts("\n| columns (Chebyshev, polynomials of two oscillators) | samples | assembly, s | both QR, s | quotient and SVD, s | dimension | gap |");
    puts("|---|---|---|---|---|---|---|");
    measure_ansatz(7, 20000);
    measure_ansatz(10, 20000);
    return 0;
}
