/* Relations with many digits: the null vectors of the Schur complement G (ball_fit.h).
 *
 *    1. add        one row [L F] per point, scaled to its largest entry; A^T A is summed up, n x n
 *    2. follow     X = -(F^T F)^-1 F^T L                         following x leading: F x = what L a leaves
 *    3. schur      G = L^T L + (F^T L)^T X                       leading x leading
 *    4. eliminate  Gauss-Jordan with complete pivoting, until the largest entry is below 10^(-2 digits)
 *    5. write      a free column k: a_k = 1, pivots a = -G_row,k, following values X a
 *
 * G is quadratic: a relation that holds to `digits` digits leaves 10^(-2 digits) in it. */
#include "exact/ball_fit.h"

#include <math.h>

#include "base/budget.h"
#include "base/memory.h"
#include "exact/ball_internal.h"

struct nh_ball_fit {
    nh_ball *ball; /* borrowed */
    size_t n, leading, solutions;
    long bits;
    nh_ex *e;         /* n */
    size_t *column;   /* indices of the columns: leading ones first, then the following ones */
    arb_ptr row;      /* n, in the order of `column` */
    arb_mat_t normal; /* A^T A, upper triangle, in that order */
    arb_mat_t c;      /* n x solutions */
};

/* Products of words in a product of two numbers. */
static double products(const nh_ball_fit *f) { return nh_ball_products(f->bits); }

/* ---- making and filling rows ---- */

static nh_ball_fit *create(nh_ball *ball, size_t n, const bool *leading)
{
    nh_ball_fit *f = nh_alloc(sizeof *f);
    *f = (nh_ball_fit){.ball = ball,
                       .n = n,
                       .bits = nh_ball_bits(ball),
                       .column = nh_alloc_array(n + 1, sizeof *f->column),
                       .row = _arb_vec_init((slong)n)};
    for (size_t j = 0; j < n; j++)
        if (leading[j]) f->column[f->leading++] = j;
    for (size_t j = 0, at = f->leading; j < n; j++)
        if (!leading[j]) f->column[at++] = j;
    arb_mat_init(f->normal, (slong)n, (slong)n);
    arb_mat_init(f->c, (slong)n, (slong)f->leading);
    return f;
}

nh_ball_fit *nh_ball_fit_create(nh_ball *ball, size_t n, const nh_ex *e, const bool *leading)
{
    nh_ball_fit *f = create(ball, n, leading);
    f->e = nh_alloc_array(n + 1, sizeof *f->e);
    for (size_t j = 0; j < n; j++) f->e[j] = e[f->column[j]];
    return f;
}

void nh_ball_fit_free(nh_ball_fit *f)
{
    if (!f) return;
    _arb_vec_clear(f->row, (slong)f->n);
    arb_mat_clear(f->normal);
    arb_mat_clear(f->c);
    nh_free(f->e);
    nh_free(f->column);
    nh_free(f);
}

static bool evaluate(nh_ball_fit *f)
{
    for (size_t j = 0; j < f->n; j++)
        if (!nh_ball_eval(f->ball, f->e[j], f->row + j)) return false;
    return true;
}

/* Divides the row by its largest entry.  Only mid-points count for the fit: its quality is judged by residuals, which
 * are rigorous. */
static void scale_row(nh_ball_fit *f)
{
    arb_t largest, size;
    arb_init(largest);
    arb_init(size);
    for (size_t j = 0; j < f->n; j++) {
        mag_zero(arb_radref(f->row + j));
        arb_abs(size, f->row + j);
        if (arb_gt(size, largest)) arb_set(largest, size);
    }
    for (size_t j = 0; j < f->n && !arb_is_zero(largest); j++) {
        arb_div(f->row + j, f->row + j, largest, f->bits);
        mag_zero(arb_radref(f->row + j));
    }
    arb_clear(largest);
    arb_clear(size);
}

bool nh_ball_fit_add(nh_ball_fit *f)
{
    if (!evaluate(f)) return false;
    scale_row(f);
    nh_work_add(NH_WORK_BALL, 0.5 * (double)f->n * (double)f->n * products(f));
    for (size_t i = 0; i < f->n; i++) {
        arf_srcptr x = arb_midref(f->row + i);
        if (arf_is_zero(x)) continue;
        for (size_t j = i; j < f->n; j++)
            arf_addmul(arb_midref(arb_mat_entry(f->normal, i, j)), x, arb_midref(f->row + j), f->bits, ARF_RND_DOWN);
    }
    return true;
}

/* ---- solving ---- */

static arb_srcptr normal(const nh_ball_fit *f, size_t i, size_t j)
{
    return i <= j ? arb_mat_entry(f->normal, i, j) : arb_mat_entry(f->normal, j, i);
}

/* X = -(F^T F)^-1 F^T L */
static bool follow(const nh_ball_fit *f, arb_mat_t X)
{
    size_t m = f->n - f->leading;
    arb_mat_t N, B;
    nh_work_add(NH_WORK_BALL, (double)m * (double)m * ((double)m / 3 + (double)f->leading) * products(f));
    arb_mat_init(N, (slong)m, (slong)m);
    arb_mat_init(B, (slong)m, (slong)f->leading);
    for (size_t i = 0; i < m; i++) {
        for (size_t j = 0; j < m; j++) arb_set(arb_mat_entry(N, i, j), normal(f, f->leading + i, f->leading + j));
        for (size_t k = 0; k < f->leading; k++) arb_neg(arb_mat_entry(B, i, k), normal(f, f->leading + i, k));
    }
    bool solved = m == 0 || arb_mat_approx_solve(X, N, B, f->bits) != 0;
    for (size_t i = 0; i < m && solved; i++)
        for (size_t k = 0; k < f->leading && solved; k++) solved = arb_is_finite(arb_mat_entry(X, i, k)) != 0;
    arb_mat_clear(N);
    arb_mat_clear(B);
    return solved;
}

static void drop_radii(arb_mat_t a)
{
    for (slong i = 0; i < arb_mat_nrows(a); i++)
        for (slong j = 0; j < arb_mat_ncols(a); j++) mag_zero(arb_radref(arb_mat_entry(a, i, j)));
}

/* G = L^T L + (F^T L)^T X, divided by |l_i| |l_j|; scale[i] = |l_i| */
static void schur(const nh_ball_fit *f, const arb_mat_t X, arb_mat_t G, arb_ptr scale)
{
    size_t d = f->leading, m = f->n - d;
    for (size_t i = 0; i < d; i++) {
        arb_sqrt(scale + i, normal(f, i, i), f->bits);
        mag_zero(arb_radref(scale + i));
        if (arb_is_zero(scale + i)) arb_one(scale + i);
    }
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++) {
            arb_ptr g = arb_mat_entry(G, i, j);
            arb_set(g, normal(f, i, j));
            for (size_t k = 0; k < m; k++) arb_addmul(g, normal(f, d + k, i), arb_mat_entry(X, k, j), f->bits);
            arb_div(g, g, scale + i, f->bits);
            arb_div(g, g, scale + j, f->bits);
        }
    drop_radii(G);
}

/* The largest remaining entry, as pivot; false when it is below the bound. */
static bool find_pivot(const arb_mat_t G, const bool *used, double bound_log10, size_t *row, size_t *column)
{
    double best = -INFINITY;
    size_t d = (size_t)arb_mat_nrows(G);
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d && !used[i]; j++) {
            double size = nh_ball_log10_upper(arb_mat_entry(G, i, j));
            if (used[d + j] || size <= best) continue;
            best = size;
            *row = i;
            *column = j;
        }
    return best > bound_log10;
}

/* Gauss-Jordan with complete pivoting.  used[0..d): rows, used[d..2d): columns that have a pivot; at[column]: its row.
   At most `most` pivots. */
static size_t eliminate(arb_mat_t G, bool *used, size_t *at, double bound_log10, size_t most, long bits)
{
    size_t d = (size_t)arb_mat_nrows(G), rank = 0, row = 0, column = 0;
    arb_t factor;
    arb_init(factor);
    for (; rank < most && find_pivot(G, used, bound_log10, &row, &column); rank++) {
        used[row] = used[d + column] = true;
        at[column] = row;
        nh_work_add(NH_WORK_BALL, (double)d * (double)d * nh_ball_products(bits));
        for (size_t i = 0; i < d; i++) {
            if (i == row) continue;
            arb_div(factor, arb_mat_entry(G, i, column), arb_mat_entry(G, row, column), bits);
            for (size_t j = 0; j < d; j++) arb_submul(arb_mat_entry(G, i, j), factor, arb_mat_entry(G, row, j), bits);
            arb_zero(arb_mat_entry(G, i, column));
        }
        drop_radii(G);
    }
    arb_clear(factor);
    return rank;
}

/* Solution k: the leading value 1 for the free column, -G_row,free / G_row,column (in their scales) for columns with a
 * pivot; then the following values. */
static void write_solution(nh_ball_fit *f, const arb_mat_t G, const bool *used, const size_t *at, size_t open,
                           const arb_mat_t X, arb_srcptr scale)
{
    size_t d = f->leading;
    slong k = (slong)f->solutions++;
    for (size_t j = 0; j < d; j++) {
        arb_ptr c = arb_mat_entry(f->c, j, k);
        if (j == open) arb_one(c);
        else if (used[d + j]) {
            arb_div(c, arb_mat_entry(G, at[j], open), arb_mat_entry(G, at[j], j), f->bits);
            arb_neg(c, c);
        }
        arb_mul(c, c, scale + open, f->bits);
        arb_div(c, c, scale + j, f->bits);
    }
    for (size_t i = d; i < f->n; i++)
        for (size_t j = 0; j < d; j++)
            arb_addmul(arb_mat_entry(f->c, i, k), arb_mat_entry(X, i - d, j), arb_mat_entry(f->c, j, k), f->bits);
}

size_t nh_ball_fit_solve(nh_ball_fit *f, double digits, bool nearest)
{
    size_t d = f->leading;
    arb_mat_t X, G;
    arb_mat_init(X, (slong)(f->n - d), (slong)d);
    arb_mat_init(G, (slong)d, (slong)d);
    arb_ptr scale = _arb_vec_init((slong)d);
    bool *used = nh_alloc_array(2 * d + 1, sizeof *used);
    size_t *at = nh_alloc_array(d + 1, sizeof *at);
    f->solutions = 0;
    arb_mat_zero(f->c);
    if (d > 0 && follow(f, X)) {
        drop_radii(X);
        schur(f, X, G, scale);
        size_t most = nearest ? d - 1 : d; /* the last pivot is left out: its column is nearest to a relation */
        eliminate(G, used, at, -2 * digits, most, f->bits);
        for (size_t j = 0; j < d; j++)
            if (!used[d + j]) write_solution(f, G, used, at, j, X, scale);
    }
    drop_radii(f->c);
    nh_free(at);
    nh_free(used);
    _arb_vec_clear(scale, (slong)d);
    arb_mat_clear(G);
    arb_mat_clear(X);
    return f->solutions;
}

bool nh_ball_fit_residual(nh_ball_fit *f, size_t k, double *log10_ratio)
{
    if (!evaluate(f)) return false;
    arb_t sum, term;
    double largest = -INFINITY;
    arb_init(sum);
    arb_init(term);
    for (size_t j = 0; j < f->n; j++) {
        arb_mul(term, arb_mat_entry(f->c, j, k), f->row + j, f->bits);
        arb_add(sum, sum, term, f->bits);
        largest = fmax(largest, nh_ball_log10_lower(term));
    }
    bool fine = isfinite(largest);
    if (fine) *log10_ratio = nh_ball_log10_upper(sum) - largest;
    arb_clear(sum);
    arb_clear(term);
    return fine;
}

double nh_ball_fit_coefficient(const nh_ball_fit *f, size_t k, size_t j)
{
    for (size_t i = 0; i < f->n; i++)
        if (f->column[i] == j) return arf_get_d(arb_midref(arb_mat_entry(f->c, i, k)), ARF_RND_NEAR);
    return 0;
}
