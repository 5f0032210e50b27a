/* Prints how long the null space takes next to matrix products of the same size, as a markdown table.
 *
 *     cc -std=c17 -O2 -D_GNU_SOURCE -Isrc tests/bench_nullspace.c src/noether/nullspace.c src/base/{linalg,error,memory}.c \
 *        -llapacke -lopenblas -lm && ./a.out
 *
 * B: m x n random numbers.  A = B diag(d) Z, Z orthogonal with three columns of d zero: a null space of dimension 3 that is not
 * along the columns.  One thread. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/linalg.h"
#include "base/memory.h"
#include "noether/nullspace.h"

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
static void measure(size_t n, size_t m)
{
    enum { BLOCK = 256 };
    const nh_nullspace_options options = {1e-9, 100, 1e5, 1e3, 1e6, 1e-7, 1e-11};
    unsigned long long state = 2385;
    double *b = nh_alloc_array(m * n, sizeof *b), *a = nh_alloc_array(m * n, sizeof *a), *z = nh_alloc_array(n * n, sizeof *z);
    for (size_t i = 0; i < m * n; i++)
        b[i] = uniform(&state);
    mixing(n, z, &state);
    nh_multiply(m, n, n, b, z, a);
    double start = nh_clock();
    nh_multiply(m, n, n, b, z, a);
    double product = nh_clock() - start;
    start = nh_clock();
    nh_equations *equations = nh_equations_create(n);
    for (size_t i = 0; i < m; i += BLOCK) {
        size_t rows = m - i < BLOCK ? m - i : BLOCK;
        nh_equations_add(equations, rows, a + i, m);
        nh_equations_add_values(equations, rows, b + i, m);
    }
    double streamed = nh_clock() - start;
    nh_nullspace *result = nh_nullspace_solve(equations, &options, NULL);
    double total = nh_clock() - start;
    printf("| %zu | %zu | %.3f | %.3f | %.3f | %.3f | %.1f | %zu | %.1e |\n", n, m, streamed, total - streamed, total, product,
           total / product, result ? result->dimension : 0, result ? result->gap : 0);
    nh_nullspace_free(result);
    nh_equations_free(equations);
    nh_free(a);
    nh_free(b);
    nh_free(z);
}

int main(void)
{
    nh_linalg_threads(1);
    puts("| columns | rows of A and of B | both QR, s | quotient and SVD, s | null space, s | dgemm (rows x n)(n x n), s | ratio "
         "| dimension (3 true) | gap |");
    puts("|---|---|---|---|---|---|---|---|---|");
    measure(200, 10000);
    measure(500, 20000);
    measure(1000, 20000);
    return 0;
}
