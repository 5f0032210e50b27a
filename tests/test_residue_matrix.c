/* Arithmetic modulo a prime in batches: against sums of single products. */
#include <criterion/criterion.h>
#include <string.h>

#include "base/memory.h"
#include "exact/residue_matrix.h"
#include "exact/row_sum.h"

static nh_residue *random_matrix(nh_prime f, size_t count, uint64_t seed)
{
    nh_residue *a = nh_alloc_array(count + 1, sizeof *a);
    for (size_t i = 0; i < count; i++) a[i] = nh_residue_random(f, &seed) * (seed % 3 != 0);
    return a;
}

Test(residue_matrix, numbers_below_2_62_are_reduced)
{
    for (size_t k = 0; k < 4; k++) {
        nh_prime f = nh_prime_at(9 * k);
        uint64_t near[] = {0, 1, f.p - 1, f.p, f.p + 1, 2 * f.p - 1, 2 * f.p, f.p * f.p, f.p * f.p - 1, f.bound - 1, (uint64_t)1 << 61, ((uint64_t)1 << 62) - 1}, seed = k;
        for (size_t i = 0; i < sizeof near / sizeof *near; i++) cr_expect_eq(nh_residue_reduce(f, near[i]), near[i] % f.p);
        for (size_t i = 0; i < 10000; i++) {
            uint64_t x = ((uint64_t)nh_residue_random(f, &seed) << 31 | nh_residue_random(f, &seed)) & (((uint64_t)1 << 62) - 1);
            cr_assert_eq(nh_residue_reduce(f, x), x % f.p);
        }
    }
}

/* All entries p - 1: the sums are as large as they can be. */
Test(residue_matrix, rows_are_added_with_factors)
{
    nh_prime f = nh_prime_at(2);
    static const size_t SIZE[] = {1, 3, 7, 8, 9, 15, 16, 17, 31, 511, 512, 513, 1100}, COUNT[] = {0, 1, 4, 5, 8, 9, 41, 64, 67, 150};
    for (size_t i = 0; i < sizeof SIZE / sizeof *SIZE; i++)
        for (size_t k = 0; k < sizeof COUNT / sizeof *COUNT; k++)
            for (int largest = 0; largest < 2; largest++) {
                size_t n = SIZE[i], count = COUNT[k];
                nh_residue *a = random_matrix(f, n * count, 5), *c = random_matrix(f, count, 6), *y = random_matrix(f, n, 7), *sum = random_matrix(f, n, 7);
                const nh_residue *row[150];
                for (size_t t = 0; t < n * count && largest; t++) a[t] = (nh_residue)(f.p - 1);
                for (size_t t = 0; t < count; t++) {
                    row[t] = a + t * n;
                    if (largest) c[t] = (nh_residue)(f.p - 1);
                    for (size_t j = 0; j < n; j++) sum[j] = (nh_residue)((sum[j] + (uint64_t)c[t] * a[t * n + j]) % f.p);
                }
                nh_row_sum_add(f, n, y, count, c, row);
                cr_assert_eq(memcmp(y, sum, n * sizeof *y), 0, "%zu rows of %zu", count, n);
                nh_free(sum);
                nh_free(y);
                nh_free(c);
                nh_free(a);
            }
}

/* a b with a m x r and b r x n has rank r: its echelon form spans its rows, and has 1 and 0 at its pivots. */
static void echelon(size_t m, size_t n, size_t r, size_t within)
{
    nh_prime f = nh_prime_at(1);
    nh_residue *a = random_matrix(f, m * r, 11 + m), *b = random_matrix(f, r * n, 13 + n), *c = random_matrix(f, m * n, 1), *e = random_matrix(f, m * n, 1);
    size_t *pivot = nh_alloc_array(m + 1, sizeof *pivot);
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j < n; j++)
            if (j % 5 == 2 || j < i / 3) b[i * n + j] = 0; /* columns without a pivot */
    nh_residue_matrix_multiply(f, m, r, n, a, b, c);
    memcpy(e, c, m * n * sizeof *e);
    size_t rank = nh_residue_matrix_echelon(f, m, n, within, e, pivot);
    for (size_t i = 0; i < rank; i++) {
        cr_assert(pivot[i] < within && (i == 0 || pivot[i - 1] < pivot[i]));
        for (size_t j = 0; j < pivot[i]; j++) cr_assert_eq(e[i * n + j], 0);
        for (size_t k = 0; k < m; k++) cr_assert_eq(e[k * n + pivot[i]], k == i);
    }
    for (size_t i = rank; i < m; i++)
        for (size_t j = 0; j < within; j++) cr_assert_eq(e[i * n + j], 0);
    for (size_t i = 0; i < m && within == n; i++) { /* every row of c is the combination of those of e that its entries at the pivots say */
        for (size_t k = 0; k < rank; k++) nh_residue_add_multiple(f, n, c + i * n, e + k * n, nh_residue_negative(f, c[i * n + pivot[k]]));
        for (size_t j = 0; j < n; j++) cr_assert_eq(c[i * n + j], 0);
    }
    nh_residue_matrix_multiply(f, m, r, n, a, b, c);
    if (within == n) {
        size_t *alone = nh_alloc_array(m + n + 1, sizeof *alone);
        cr_assert_eq(nh_residue_matrix_pivots(f, m, n, c, alone), rank);
        for (size_t i = 0; i < rank; i++) cr_assert_eq(alone[i], pivot[i]);
        nh_residue_matrix_multiply(f, m, r, n, a, b, c);
        cr_assert_eq(nh_residue_matrix_rank(f, m, n, c), rank);
        nh_free(alone);
    }
    if (within == n && r <= m && r <= n / 3) cr_assert_eq(rank, r);
    nh_free(pivot);
    nh_free(e);
    nh_free(c);
    nh_free(b);
    nh_free(a);
}

Test(residue_matrix, echelon_forms_span_the_rows)
{
    echelon(1, 1, 1, 1);
    echelon(5, 40, 5, 40);
    echelon(60, 20, 6, 20);
    echelon(100, 150, 40, 150);
    echelon(33, 64, 21, 64);
    echelon(129, 200, 66, 200);
    echelon(90, 120, 80, 70);
}

/* The echelon form belongs to the span of the rows: rows in another order, times numbers, and rows that add nothing leave it as it is. */
Test(residue_matrix, echelon_forms_depend_on_the_span_only)
{
    enum { ROWS = 31, COLUMNS = 70, RANK = 23 };
    nh_prime f = nh_prime_at(3);
    uint64_t seed = 19;
    nh_residue *a = random_matrix(f, ROWS * RANK, 2), *b = random_matrix(f, RANK * COLUMNS, 3), *c = nh_alloc_array(ROWS * COLUMNS, sizeof *c), *both = nh_alloc_array(2 * ROWS * COLUMNS, sizeof *both);
    size_t pivot[ROWS], other[2 * ROWS];
    nh_residue_matrix_multiply(f, ROWS, RANK, COLUMNS, a, b, c);
    for (size_t i = 0; i < ROWS; i++) memcpy(both + 2 * (ROWS - 1 - i) * COLUMNS, c + i * COLUMNS, COLUMNS * sizeof *c);
    size_t rank = nh_residue_matrix_echelon(f, ROWS, COLUMNS, COLUMNS, c, pivot);
    cr_assert_eq(rank, RANK);
    for (size_t i = 0; i < ROWS; i++) memcpy(both + (2 * i + 1) * COLUMNS, c + i * COLUMNS, COLUMNS * sizeof *c);
    for (size_t i = 0; i < 2 * ROWS; i++) {
        nh_residue factor = nh_residue_random(f, &seed);
        for (size_t j = 0; j < COLUMNS; j++) both[i * COLUMNS + j] = nh_residue_mul(f, factor, both[i * COLUMNS + j]);
    }
    cr_assert_eq(nh_residue_matrix_echelon(f, 2 * ROWS, COLUMNS, COLUMNS, both, other), rank);
    cr_expect_eq(memcmp(pivot, other, rank * sizeof *pivot), 0);
    cr_expect_eq(memcmp(c, both, rank * COLUMNS * sizeof *c), 0);
    for (size_t k = rank * COLUMNS; k < 2 * ROWS * COLUMNS; k++) cr_assert_eq(both[k], 0);
    nh_free(both);
    nh_free(c);
    nh_free(b);
    nh_free(a);
}

Test(residue_matrix, nothing_has_rank_zero)
{
    nh_residue zero[12] = {0};
    size_t pivot[4];
    nh_prime f = nh_prime_at(0);
    cr_expect_eq(nh_residue_matrix_rank(f, 3, 4, zero), 0);
    cr_expect_eq(nh_residue_matrix_rank(f, 0, 4, zero), 0);
    cr_expect_eq(nh_residue_matrix_rank(f, 3, 0, zero), 0);
    cr_expect_eq(nh_residue_matrix_echelon(f, 3, 4, 4, zero, pivot), 0);
}
