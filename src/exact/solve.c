#include "exact/solve.h"

#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"

struct nh_lu {
    nh_dag *dag;
    size_t n;
    nh_ex *a;       /* L below the diagonal (unit), U on and above it */
    size_t *row;    /* row[i]: which original row came i-th */
    size_t longest; /* limit of nh_simplify_short; 0: its own */
};

static void swap_rows(nh_lu *lu, size_t i, size_t j)
{
    if (i == j) return;
    for (size_t k = 0; k < lu->n; k++) {
        nh_ex t = lu->a[i * lu->n + k];
        lu->a[i * lu->n + k] = lu->a[j * lu->n + k];
        lu->a[j * lu->n + k] = t;
    }
    size_t t = lu->row[i];
    lu->row[i] = lu->row[j];
    lu->row[j] = t;
}

/* The best pivot for row r in column k; the row in its own place wins unless another is clearly safer.  For many
 * equations it is taken at once where elimination has left a good part of the original entry `before`, as in mass
 * matrices, because comparing all rows takes long. */
static double choose_pivot(nh_lu *lu, size_t r, size_t k, nh_ex before, nh_pivot_score *score, void *context,
                           size_t *best)
{
    static const double good_part = 1e-2;
    double value = 0;
    *best = r;
    if (lu->longest && r == k && !nh_is_zero(lu->dag, lu->a[k * lu->n + k])) {
        value = score(context, lu->a[k * lu->n + k]);
        if (value > good_part * score(context, before)) return value;
        value = 0;
    }
    for (size_t i = r; i < lu->n; i++) {
        nh_ex e = lu->a[i * lu->n + k];
        double s = nh_is_zero(lu->dag, e) ? 0 : score(context, e);
        if (s > (i == r ? 0 : 4 * value)) {
            value = s;
            *best = i;
        }
    }
    return value;
}

/* Eliminates column k below row r. */
static void eliminate(nh_lu *lu, size_t r, size_t k)
{
    nh_dag *d = lu->dag;
    size_t n = lu->n;
    nh_ex pivot = lu->a[r * n + k];
    for (size_t i = r + 1; i < n && !nh_interrupted(); i++) {
        nh_ex *row = lu->a + i * n;
        if (nh_is_zero(d, row[k])) continue;
        row[k] = nh_simplify_short(d, nh_div(d, row[k], pivot), lu->longest);
        for (size_t j = k + 1; j < n; j++) {
            nh_ex u = lu->a[r * n + j];
            if (!nh_is_zero(d, u)) row[j] = nh_simplify_short(d, nh_sub(d, row[j], nh_mul(d, row[k], u)), lu->longest);
        }
    }
}

nh_lu *nh_lu_create(nh_dag *dag, size_t n, const nh_ex *a, nh_pivot_score *score, void *context, size_t *rank)
{
    nh_lu *lu = nh_alloc(sizeof *lu);
    *lu = (nh_lu){.dag = dag,
                  .n = n,
                  .longest = nh_simplify_longest(n),
                  .a = nh_alloc_array(n * n + 1, sizeof *lu->a),
                  .row = nh_alloc_array(n + 1, sizeof *lu->row)};
    if (n) memcpy(lu->a, a, n * n * sizeof *a);
    for (size_t i = 0; i < n; i++) lu->row[i] = i;
    size_t r = 0; /* = k until a column has no pivot; from then on only the rank is computed */
    for (size_t k = 0; k < n && !nh_interrupted(); k++) {
        size_t best;
        if (choose_pivot(lu, r, k, a[k * n + k], score, context, &best) == 0) continue;
        swap_rows(lu, r, best);
        eliminate(lu, r++, k);
    }
    if (rank) *rank = r;
    if (r == n) return lu;
    nh_lu_free(lu);
    return NULL;
}

nh_lu *nh_lu_copy(const nh_lu *lu, nh_dag *copy)
{
    nh_lu *c = nh_alloc(sizeof *c);
    size_t n = lu->n;
    *c = *lu;
    c->dag = copy;
    c->a = nh_alloc_array(n * n + 1, sizeof *c->a);
    c->row = nh_alloc_array(n + 1, sizeof *c->row);
    if (n) memcpy(c->a, lu->a, n * n * sizeof *c->a);
    if (n) memcpy(c->row, lu->row, n * sizeof *c->row);
    return c;
}

void nh_lu_free(nh_lu *lu)
{
    if (!lu) return;
    nh_free(lu->a);
    nh_free(lu->row);
    nh_free(lu);
}

void nh_lu_solve(const nh_lu *lu, const nh_ex *b, nh_ex *x)
{
    nh_dag *d = lu->dag;
    size_t n = lu->n;
    nh_ex *y = nh_alloc_array(n + 1, sizeof *y);
    for (size_t i = 0; i < n; i++) {
        y[i] = b[lu->row[i]];
        for (size_t j = 0; j < i; j++) y[i] = nh_sub(d, y[i], nh_mul(d, lu->a[i * n + j], y[j]));
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; j++) y[i] = nh_sub(d, y[i], nh_mul(d, lu->a[i * n + j], y[j]));
        y[i] = nh_div(d, y[i], lu->a[i * n + i]);
    }
    memcpy(x, y, n * sizeof *x);
    nh_free(y);
}

nh_ex nh_solve_determinant(nh_dag *d, size_t n, const nh_ex *a)
{
    if (n == 0) return nh_int(d, 1);
    nh_ex sum = nh_int(d, 0), *minor = nh_alloc_array(n * n, sizeof *minor);
    for (size_t j = 0; j < n; j++) {
        for (size_t r = 1; r < n; r++)
            for (size_t c = 0, at = 0; c < n; c++)
                if (c != j) minor[(r - 1) * (n - 1) + at++] = a[r * n + c];
        nh_ex term = nh_is_zero(d, a[j]) ? a[j] : nh_mul(d, a[j], nh_solve_determinant(d, n - 1, minor));
        sum = j % 2 ? nh_sub(d, sum, term) : nh_add(d, sum, term);
    }
    nh_free(minor);
    return sum;
}
