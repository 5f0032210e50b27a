/* Gauss and Jordan's elimination in panels of columns, on top of sums of rows.
 *
 * A panel with the pivots A[R, C] = B replaces, of all columns from its first on,
 *
 *     A[R] by B^-1 A[R],      A[i] by A[i] - A[i, C] A[R]   for the other rows i
 *
 * so that most of the work consists of sums of many rows. */
#include "exact/residue_matrix.h"

#include <string.h>

#include "base/memory.h"
#include "exact/row_sum.h"

enum { panel_width = 32 };

void nh_residue_matrix_multiply(nh_prime field, size_t m, size_t k, size_t n, const nh_residue *a, const nh_residue *b,
                                nh_residue *out)
{
    const nh_residue **row = nh_alloc_array(k + 1, sizeof *row);
    for (size_t t = 0; t < k; t++) row[t] = b + t * n;
    memset(out, 0, m * n * sizeof *out);
    for (size_t i = 0; i < m; i++) nh_row_sum_add(field, n, out + i * n, k, a + i * k, row);
    nh_free(row);
}

/* ---- elimination ---- */

typedef struct {
    nh_prime field;
    size_t rows, columns, rank;
    nh_residue *a;
    size_t first, width;                      /* the columns of the present panel */
    size_t found, *pivot;                     /* number of pivots in it; their columns in the matrix */
    nh_residue *panel, *inverse_block, *part; /* rows x width; found x 2 found; found x columns */
} elimination;

static void swap_rows(nh_residue *a, size_t n, size_t i, size_t k)
{
    for (size_t j = 0; i != k && j < n; j++) {
        nh_residue kept = a[i * n + j];
        a[i * n + j] = a[k * n + j];
        a[k * n + j] = kept;
    }
}

/* Finds linearly independent rows of the panel and their pivots, and moves these rows to the beginning of the remaining
 * matrix. */
static void find_pivots(elimination *x)
{
    size_t rest = x->rows - x->rank, w = x->width;
    for (size_t i = 0; i < rest; i++)
        memcpy(x->panel + i * w, x->a + (x->rank + i) * x->columns + x->first, w * sizeof *x->panel);
    x->found = 0;
    for (size_t c = 0; c < w && x->found < rest; c++) {
        size_t i = x->found;
        while (i < rest && !x->panel[i * w + c]) i++;
        if (i == rest) continue;
        swap_rows(x->panel, w, i, x->found);
        swap_rows(x->a, x->columns, x->rank + i, x->rank + x->found);
        const nh_residue *head = x->panel + x->found * w;
        nh_residue minus_inverse = nh_residue_negative(x->field, nh_residue_inverse(x->field, head[c]));
        for (i = x->found + 1; i < rest; i++) {
            nh_residue *own = x->panel + i * w;
            if (own[c])
                nh_residue_add_multiple(x->field, w - c, own + c, head + c,
                                        nh_residue_mul(x->field, own[c], minus_inverse));
        }
        x->pivot[x->rank + x->found++] = x->first + c;
    }
}

/* B | 1 becomes 1 | B^-1, by Gauss and Jordan; B is regular. */
static void invert_pivots(elimination *x)
{
    size_t k = x->found, w = 2 * k;
    nh_residue *b = x->inverse_block;
    memset(b, 0, k * w * sizeof *b);
    for (size_t i = 0; i < k; i++) {
        for (size_t j = 0; j < k; j++) b[i * w + j] = x->a[(x->rank + i) * x->columns + x->pivot[x->rank + j]];
        b[i * w + k + i] = 1;
    }
    for (size_t c = 0; c < k; c++) {
        size_t i = c;
        while (!b[i * w + c]) i++;
        swap_rows(b, w, i, c);
        nh_residue inverse = nh_residue_inverse(x->field, b[c * w + c]);
        for (size_t j = 0; j < w; j++) b[c * w + j] = nh_residue_mul(x->field, b[c * w + j], inverse);
        for (i = 0; i < k; i++)
            if (i != c)
                nh_residue_add_multiple(x->field, w, b + i * w, b + c * w, nh_residue_negative(x->field, b[i * w + c]));
    }
}

/* Updates the rows with pivots, and then the others: all, or those below. */
static void apply_pivots(elimination *x, bool above)
{
    size_t k = x->found, n = x->columns - x->first;
    const nh_residue *row[panel_width];
    nh_residue factor[panel_width];
    memset(x->part, 0, k * n * sizeof *x->part);
    for (size_t t = 0; t < k; t++) row[t] = x->a + (x->rank + t) * x->columns + x->first;
    for (size_t i = 0; i < k; i++)
        nh_row_sum_add(x->field, n, x->part + i * n, k, x->inverse_block + i * 2 * k + k, row);
    for (size_t i = 0; i < k; i++)
        memcpy(x->a + (x->rank + i) * x->columns + x->first, x->part + i * n, n * sizeof *x->part);
    for (size_t i = above ? 0 : x->rank + k; i < x->rows; i++) {
        nh_residue *own = x->a + i * x->columns;
        bool any = false;
        if (i >= x->rank && i < x->rank + k) continue;
        for (size_t t = 0; t < k; t++)
            any |= (factor[t] = nh_residue_negative(x->field, own[x->pivot[x->rank + t]])) != 0;
        if (any) nh_row_sum_add(x->field, n, own + x->first, k, factor, row);
    }
}

/* Panel after panel; `reduced`: rows above the pivots are reduced, too. */
static size_t eliminate(nh_prime field, size_t rows, size_t columns, size_t within, nh_residue *a, size_t *pivot,
                        bool reduced)
{
    elimination x = {.field = field, .rows = rows, .columns = columns, .a = a, .pivot = pivot};
    x.panel = nh_alloc_array(rows * panel_width + 1, sizeof *x.panel);
    x.inverse_block = nh_alloc_array(2 * panel_width * panel_width, sizeof *x.inverse_block);
    x.part = nh_alloc_array(panel_width * columns + 1, sizeof *x.part);
    for (x.first = 0; x.first < within && x.rank < rows; x.first += x.width) {
        x.width = within - x.first < panel_width ? within - x.first : panel_width;
        find_pivots(&x);
        if (!x.found) continue;
        invert_pivots(&x);
        apply_pivots(&x, reduced);
        x.rank += x.found;
    }
    nh_free(x.part);
    nh_free(x.inverse_block);
    nh_free(x.panel);
    return x.rank;
}

size_t nh_residue_matrix_echelon(nh_prime field, size_t rows, size_t columns, size_t within, nh_residue *a,
                                 size_t *pivot)
{
    return eliminate(field, rows, columns, within, a, pivot, true);
}

size_t nh_residue_matrix_pivots(nh_prime field, size_t rows, size_t columns, nh_residue *a, size_t *pivot)
{
    return eliminate(field, rows, columns, columns, a, pivot, false);
}

size_t nh_residue_matrix_rank(nh_prime field, size_t rows, size_t columns, nh_residue *a)
{
    size_t *pivot = nh_alloc_array((rows < columns ? rows : columns) + 1, sizeof *pivot);
    size_t rank = nh_residue_matrix_pivots(field, rows, columns, a, pivot);
    nh_free(pivot);
    return rank;
}
