/* linearization_matrices: the formulas of linearization.h, in balls.
 *
 *     accelerations    [K F^T; F 0] (a; mu) = -(h; g)                        a (m), mu (k)
 *     velocities       [ F | B | c_q | c_v ]  k x 4m, Gauss and Jordan in the columns of F
 *                      -> dependent columns become units:  dv_dep = -F' dw - B' dq,
 *                         dv'_dep = -F' dw' - c_q' dq - c_v' dv            R, S (m x n, m x m), E, H
 *     positions        the rows P_q and c^T F (c^T B = 0) in dq              T (m x s)
 *     forces           M, C, N
 *     state_matrix     A = [ (S T)_x  R_x ;  -M^-1 N  -M^-1 C ]               (s + n) x (s + n) */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "geometry/linearization_internal.h"

/* ---- matrices of balls ---- */

bool nh_linear_load(nh_ball *ball, size_t rows, size_t columns, const nh_ex *e, arb_mat_t out)
{
    bool good = true;
    arb_mat_init(out, (slong)rows, (slong)columns);
    for (size_t i = 0; i < rows * columns && good; i++)
        good = nh_ball_eval(ball, e[i], arb_mat_entry(out, i / columns, i % columns));
    return good;
}

bool nh_linear_vanishes(const arb_t x, double scale)
{
    static const double least = 1e-40; /* NH_LINEAR_DIGITS */
    return !(nh_ball_upper(x) > least * scale);
}

double nh_linear_largest(const arb_mat_t A)
{
    double largest = 0;
    for (slong i = 0; i < arb_mat_nrows(A); i++)
        for (slong j = 0; j < arb_mat_ncols(A); j++) largest = fmax(largest, nh_ball_upper(arb_mat_entry(A, i, j)));
    return largest;
}

/* The row below `rank` where column j is largest, as a part of the largest entry of its row. */
static double best_row(const arb_mat_t A, size_t columns, size_t rank, size_t j, const double *scale, size_t *row)
{
    double best = 0;
    for (size_t i = rank; i < (size_t)arb_mat_nrows(A); i++) {
        arb_srcptr x = arb_mat_entry(A, i, j);
        double largest = 0;
        if (nh_linear_vanishes(x, scale[i])) continue;
        for (size_t c = 0; c < columns; c++) largest = fmax(largest, nh_ball_upper(arb_mat_entry(A, i, c)));
        double part = nh_ball_upper(x) / largest;
        if (part > best) best = part, *row = i;
    }
    return best;
}

/* Row `row` is divided by its entry in column j, and column j is cleared in all others. */
static void clear_column(arb_mat_t A, size_t row, size_t j, long bits)
{
    size_t width = (size_t)arb_mat_ncols(A);
    arb_t factor;
    arb_init(factor);
    arb_inv(factor, arb_mat_entry(A, row, j), bits);
    for (size_t c = 0; c < width; c++) arb_mul(arb_mat_entry(A, row, c), arb_mat_entry(A, row, c), factor, bits);
    for (size_t i = 0; i < (size_t)arb_mat_nrows(A); i++) {
        if (i == row) continue;
        arb_set(factor, arb_mat_entry(A, i, j));
        for (size_t c = 0; c < width; c++) arb_submul(arb_mat_entry(A, i, c), factor, arb_mat_entry(A, row, c), bits);
    }
    arb_clear(factor);
}

/* Two passes: first the columns with a pivot above a thousandth of its row, then those with a small one. */
size_t nh_linear_eliminate(arb_mat_t A, size_t columns, const size_t *order, size_t *pivot, long bits)
{
    static const double small_pivot = 1e-3;
    size_t rows = (size_t)arb_mat_nrows(A), rank = 0, others, row = 0;
    bool *taken = nh_alloc_array(columns + 1, sizeof *taken);
    double *scale = nh_alloc_array(rows + 1, sizeof *scale);
    for (size_t i = 0; i < rows; i++)
        for (slong c = 0; c < arb_mat_ncols(A); c++) scale[i] = fmax(scale[i], nh_ball_upper(arb_mat_entry(A, i, c)));
    for (int small = 0; small < 2; small++)
        for (size_t o = 0; o < columns && rank < rows; o++) {
            size_t j = order[o];
            double part = taken[j] ? 0 : best_row(A, columns, rank, j, scale, &row);
            if (!(part > (small ? 0 : small_pivot))) continue;
            if (row != rank) {
                double s = scale[row];
                scale[row] = scale[rank], scale[rank] = s;
                arb_mat_swap_rows(A, NULL, (slong)row, (slong)rank);
            }
            clear_column(A, rank, j, bits);
            taken[j] = true;
            pivot[rank++] = j;
        }
    others = rank;
    for (size_t j = 0; j < columns; j++)
        if (!taken[j]) pivot[others++] = j;
    nh_free(scale);
    nh_free(taken);
    return rank;
}

/* out := a b, or a b + c */
static void product(arb_mat_t out, const arb_mat_t a, const arb_mat_t b, const arb_mat_struct *c, long bits)
{
    arb_mat_clear(out);
    arb_mat_init(out, arb_mat_nrows(a), arb_mat_ncols(b));
    arb_mat_mul(out, a, b, bits);
    if (c) arb_mat_add(out, out, c, bits);
}

static void remake(arb_mat_t A, size_t rows, size_t columns)
{
    arb_mat_clear(A);
    arb_mat_init(A, (slong)rows, (slong)columns);
}

/* Copies a into out from row and column on. */
static void put(arb_mat_t out, size_t row, size_t column, const arb_mat_t a)
{
    for (slong i = 0; i < arb_mat_nrows(a); i++)
        for (slong j = 0; j < arb_mat_ncols(a); j++)
            arb_set(arb_mat_entry(out, (slong)row + i, (slong)column + j), arb_mat_entry(a, i, j));
}

/* ---- the steps ---- */

/* Says why there are no accelerations: velocities with neither inertia nor constraint, or dependent constraints. */
static bool undetermined(nh_linear_work *w, const arb_mat_t K, const arb_mat_t F, nh_error *error)
{
    size_t m = w->l->m, k = w->l->k, *order = nh_alloc_array(2 * m + 1, sizeof *order), *pivot = order + m;
    const nh_coordinate *c = w->l->system->coordinate;
    arb_mat_t both;
    nh_text names;
    nh_text_init(&names);
    arb_mat_init(both, (slong)(k + m), (slong)m);
    put(both, 0, 0, F);
    put(both, k, 0, K);
    for (size_t j = 0; j < m; j++) order[j] = m - 1 - j;
    size_t rank = nh_linear_eliminate(both, m, order, pivot, w->bits);
    for (size_t j = 0; j < m && rank < m; j++) {
        bool moves = j == pivot[rank];
        for (size_t r = 0; r < rank && !moves; r++)
            moves = pivot[r] == j && !nh_linear_vanishes(arb_mat_entry(both, r, pivot[rank]), 1);
        if (moves) nh_text_addf(&names, "%s%s'", names.length ? ", " : "", c[j].name);
    }
    if (rank < m) {
        nh_fail(error, NH_NUMERIC, "",
                "the accelerations are not determined at this state: a motion in %s alone has "
                "no inertia there",
                nh_text_string(&names));
        nh_error_hint(error, "coordinates are singular there, as Euler's angles may be: take a state beside it, or "
                             "other coordinates");
    } else {
        nh_fail(error, NH_NUMERIC, "",
                "the accelerations and multipliers are not determined at this state: the "
                "constraints depend on each other there");
        nh_error_hint(error, "take a state beside it");
    }
    nh_text_clear(&names);
    arb_mat_clear(both);
    nh_free(order);
    return false;
}

/* K a + F^T mu = -h, F a = -g */
static bool accelerations(nh_linear_work *w, const arb_mat_t K, const arb_mat_t F, nh_error *error)
{
    const nh_linearization *l = w->l;
    size_t m = l->m, k = l->k;
    arb_mat_t h, g, both, right, solution, transposed;
    bool finite = nh_linear_load(w->ball, m, 1, l->h, h);
    finite = nh_linear_load(w->ball, k, 1, l->g, g) && finite;
    arb_mat_init(both, (slong)(m + k), (slong)(m + k));
    arb_mat_init(right, (slong)(m + k), 1);
    arb_mat_init(solution, (slong)(m + k), 1);
    arb_mat_init(transposed, (slong)m, (slong)k);
    arb_mat_transpose(transposed, F);
    put(both, 0, 0, K);
    put(both, 0, m, transposed);
    put(both, m, 0, F);
    put(right, 0, 0, h);
    put(right, m, 0, g);
    arb_mat_neg(right, right);
    bool good = finite && arb_mat_solve(solution, both, right, w->bits);
    for (size_t i = 0; i < m && good; i++) {
        arb_set(w->a + i, arb_mat_entry(solution, i, 0));
        nh_ball_set_arb(w->ball, l->a[i], w->a + i);
    }
    for (size_t i = 0; i < k && good; i++) nh_ball_set_arb(w->ball, l->mu[i], arb_mat_entry(solution, m + i, 0));
    arb_mat_struct *const all[] = {h, g, both, right, solution, transposed};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_mat_clear(all[i]);
    if (good) return true;
    if (!finite) return nh_fail(error, NH_NUMERIC, "", "the equations of motion have no value at this state");
    return undetermined(w, K, F, error);
}

/* The first rows of E, from the second column block on, with opposite sign, into the rows of the dependent
 * coordinates. */
static void expand(const nh_linear_work *w, const arb_mat_t E, size_t from, arb_mat_t out)
{
    size_t m = w->l->m, k = w->l->k;
    remake(out, m, m);
    for (size_t r = 0; r < k; r++)
        for (size_t j = 0; j < m; j++) arb_neg(arb_mat_entry(out, w->dependent[r], j), arb_mat_entry(E, r, from + j));
}

/* R, S and, with the blocks of derivatives, E and H: from the rows [F | B | c_q | c_v] solved for the dependent
 * columns. */
static bool velocities(nh_linear_work *w, const arb_mat_t F, const arb_mat_t B, arb_mat_t E, arb_mat_t H,
                       nh_error *error)
{
    const nh_linearization *l = w->l;
    size_t m = l->m, k = l->k;
    arb_mat_t rows, c_q, c_v, part;
    size_t *order = nh_alloc_array(m + 1, sizeof *order);
    bool good = nh_linear_load(w->ball, k, m, l->c_q, c_q);
    good = nh_linear_load(w->ball, k, m, l->c_v, c_v) && good;
    arb_mat_init(rows, (slong)k, (slong)(4 * m));
    arb_mat_init(part, 0, 0);
    put(rows, 0, 0, F);
    put(rows, 0, m, B);
    put(rows, 0, 2 * m, c_q);
    put(rows, 0, 3 * m, c_v);
    nh_linear_order(l, NULL, order);
    if (w->chosen) memcpy(order, w->dependent, m * sizeof *order);
    good = good && nh_linear_eliminate(rows, m, order, w->dependent, w->bits) == k;
    w->n = m - k;
    if (good) {
        remake(w->R, m, w->n);
        for (size_t i = 0; i < w->n; i++) {
            size_t j = w->dependent[k + i];
            arb_one(arb_mat_entry(w->R, j, i));
            for (size_t r = 0; r < k; r++) arb_neg(arb_mat_entry(w->R, w->dependent[r], i), arb_mat_entry(rows, r, j));
        }
        expand(w, rows, m, w->S);
        expand(w, rows, 3 * m, part);
        product(H, part, w->R, NULL, w->bits);
        product(E, part, w->S, NULL, w->bits);
        expand(w, rows, 2 * m, part);
        arb_mat_add(E, E, part, w->bits);
    } else {
        nh_fail(error, NH_NUMERIC, "", "the constraints depend on each other at this state");
    }
    arb_mat_struct *const all[] = {rows, c_q, c_v, part};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_mat_clear(all[i]);
    nh_free(order);
    return good;
}

/* Rows c^T F with c^T B = 0. */
static size_t constants(const nh_linear_work *w, const arb_mat_t F, const arb_mat_t B, const arb_mat_t P_q,
                        arb_mat_t out)
{
    size_t m = w->l->m, k = w->l->k, p = w->l->p;
    arb_mat_t rows;
    size_t *order = nh_alloc_array(2 * m + 1, sizeof *order), *pivot = order + m;
    arb_mat_init(rows, (slong)k, (slong)(2 * m));
    put(rows, 0, 0, B);
    put(rows, 0, m, F);
    for (size_t j = 0; j < m; j++) order[j] = j;
    size_t rank = nh_linear_eliminate(rows, m, order, pivot, w->bits), count = k - rank;
    remake(out, p + count, m);
    put(out, 0, 0, P_q);
    for (size_t r = 0; r < count; r++)
        for (size_t j = 0; j < m; j++) arb_set(arb_mat_entry(out, p + r, j), arb_mat_entry(rows, rank + r, m + j));
    arb_mat_clear(rows);
    nh_free(order);
    return count;
}

/* T: the coordinates that stay free are those with independent velocities, as far as possible. */
static bool positions(nh_linear_work *w, const arb_mat_t F, const arb_mat_t B)
{
    size_t m = w->l->m;
    arb_mat_t rows, P_q;
    arb_mat_init(rows, 0, 0);
    bool good = nh_linear_load(w->ball, w->l->p, m, w->l->P_q, P_q);
    if (good) constants(w, F, B, P_q, rows);
    size_t *order = nh_alloc_array(m + 1, sizeof *order);
    memcpy(order, w->chosen ? w->fixed : w->dependent, m * sizeof *order);
    size_t rank = good ? nh_linear_eliminate(rows, m, order, w->fixed, w->bits) : 0;
    w->s = m - rank;
    remake(w->T, m, w->s);
    for (size_t i = 0; i < w->s; i++) {
        size_t j = w->fixed[rank + i];
        arb_one(arb_mat_entry(w->T, j, i));
        for (size_t r = 0; r < rank; r++) arb_neg(arb_mat_entry(w->T, w->fixed[r], i), arb_mat_entry(rows, r, j));
    }
    arb_mat_clear(rows);
    arb_mat_clear(P_q);
    nh_free(order);
    return good;
}

/* M, C, N */
static bool forces(nh_linear_work *w, const arb_mat_t K, const arb_mat_t E, const arb_mat_t H)
{
    size_t m = w->l->m;
    arb_mat_t d_q, d_v, left, part, sum;
    arb_mat_init(left, (slong)w->n, (slong)m);
    arb_mat_init(part, 0, 0);
    arb_mat_init(sum, 0, 0);
    bool good = nh_linear_load(w->ball, m, m, w->l->d_q, d_q);
    good = nh_linear_load(w->ball, m, m, w->l->d_v, d_v) && good;
    if (good) {
        arb_mat_transpose(left, w->R);
        product(part, K, w->R, NULL, w->bits);
        product(w->M, left, part, NULL, w->bits);
        product(part, d_v, w->R, NULL, w->bits);
        product(sum, K, H, part, w->bits);
        product(w->C, left, sum, NULL, w->bits);
        product(part, d_v, w->S, d_q, w->bits);
        product(sum, K, E, part, w->bits);
        product(part, sum, w->T, NULL, w->bits);
        product(w->N, left, part, NULL, w->bits);
    }
    arb_mat_struct *const all[] = {d_q, d_v, left, part, sum};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_mat_clear(all[i]);
    return good;
}

/* A, of (x, w) */
static bool state_matrix(nh_linear_work *w)
{
    size_t n = w->n, s = w->s, *x = w->fixed + (w->l->m - s);
    arb_mat_t right, part;
    arb_mat_init(right, (slong)n, (slong)(s + n));
    arb_mat_init(part, 0, 0);
    remake(w->A, s + n, s + n);
    product(part, w->S, w->T, NULL, w->bits);
    for (size_t i = 0; i < s; i++) {
        for (size_t j = 0; j < s; j++) arb_set(arb_mat_entry(w->A, i, j), arb_mat_entry(part, x[i], j));
        for (size_t j = 0; j < n; j++) arb_set(arb_mat_entry(w->A, i, s + j), arb_mat_entry(w->R, x[i], j));
    }
    put(right, 0, 0, w->N);
    put(right, 0, s, w->C);
    bool good = arb_mat_solve(right, w->M, right, w->bits);
    arb_mat_neg(right, right);
    if (good) put(w->A, s, 0, right);
    arb_mat_clear(part);
    arb_mat_clear(right);
    return good;
}

bool nh_linear_matrices(nh_linear_work *w, nh_error *error)
{
    const nh_linearization *l = w->l;
    arb_mat_t K, F, B, E, H;
    nh_linear_set(w);
    bool good = nh_linear_load(w->ball, l->m, l->m, l->K, K);
    good = nh_linear_load(w->ball, l->k, l->m, l->F, F) && good;
    good = nh_linear_load(w->ball, l->k, l->m, l->B, B) && good;
    arb_mat_init(E, 0, 0);
    arb_mat_init(H, 0, 0);
    if (!good) nh_fail(error, NH_NUMERIC, "", "the equations of motion have no value at this state");
    good = good && accelerations(w, K, F, error) && velocities(w, F, B, E, H, error);
    if (good && !(positions(w, F, B) && forces(w, K, E, H)))
        good = nh_fail(error, NH_NUMERIC, "", "the linear equations have no value at this state");
    if (good && !state_matrix(w))
        good = nh_fail(error, NH_NUMERIC, "", "a velocity that the constraints leave free has no inertia there");
    w->chosen |= good;
    arb_mat_struct *const all[] = {K, F, B, E, H};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_mat_clear(all[i]);
    return good;
}
