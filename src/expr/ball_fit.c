#include "expr/ball_fit.h"

#include <arb_mat.h>
#include <math.h>

#include "base/memory.h"
#include "expr/ball_internal.h"

struct nh_ball_fit {
    nh_ball *ball; /* borrows */
    size_t n, free;
    long bits;
    nh_ex *e;
    size_t *column;      /* unknown -> expression */
    arb_ptr c, row;      /* n each */
    arb_mat_t normal, right;
};

nh_ball_fit *nh_ball_fit_create(nh_ball *ball, size_t n, const nh_ex *e, const bool *fixed, const double *value)
{
    nh_ball_fit *f = nh_alloc(sizeof *f);
    *f = (nh_ball_fit){.ball = ball, .n = n, .bits = nh_ball_bits(ball), .e = nh_alloc_array(n + 1, sizeof *f->e),
                       .column = nh_alloc_array(n + 1, sizeof *f->column), .c = _arb_vec_init((slong)n), .row = _arb_vec_init((slong)n)};
    for (size_t j = 0; j < n; j++) {
        f->e[j] = e[j];
        if (fixed[j]) arb_set_d(f->c + j, value[j]);
        else f->column[f->free++] = j;
    }
    arb_mat_init(f->normal, (slong)f->free, (slong)f->free);
    arb_mat_init(f->right, (slong)f->free, 1);
    return f;
}

void nh_ball_fit_free(nh_ball_fit *f)
{
    if (!f) return;
    _arb_vec_clear(f->c, (slong)f->n);
    _arb_vec_clear(f->row, (slong)f->n);
    arb_mat_clear(f->normal);
    arb_mat_clear(f->right);
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

/* Only mid-points count for the fit: what the coefficients are worth is seen from the residual, which is rigorous. */
static void mid_points(nh_ball_fit *f)
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

/* N += r^T r,  b -= r^T (sum of the fixed part); the lower triangle is filled in when solving. */
bool nh_ball_fit_add(nh_ball_fit *f)
{
    if (!evaluate(f)) return false;
    mid_points(f);
    arb_t known;
    arb_init(known);
    for (size_t j = 0, next = 0; j < f->n; j++) {
        if (next < f->free && f->column[next] == j) next++;
        else arb_addmul(known, f->c + j, f->row + j, f->bits);
    }
    mag_zero(arb_radref(known));
    for (size_t i = 0; i < f->free; i++) {
        arb_srcptr x = f->row + f->column[i];
        if (arb_is_zero(x)) continue;
        arf_ptr b = arb_midref(arb_mat_entry(f->right, i, 0));
        arf_submul(b, arb_midref(x), arb_midref(known), f->bits, ARF_RND_DOWN);
        for (size_t j = i; j < f->free; j++) {
            arf_ptr to = arb_midref(arb_mat_entry(f->normal, i, j));
            arf_addmul(to, arb_midref(x), arb_midref(f->row + f->column[j]), f->bits, ARF_RND_DOWN);
        }
    }
    arb_clear(known);
    return true;
}

bool nh_ball_fit_solve(nh_ball_fit *f)
{
    arb_mat_t x, full;
    if (f->free == 0) return true;
    arb_mat_init(x, (slong)f->free, 1);
    arb_mat_init(full, (slong)f->free, (slong)f->free);
    for (size_t i = 0; i < f->free; i++)
        for (size_t j = 0; j < f->free; j++) arb_set(arb_mat_entry(full, i, j), i <= j ? arb_mat_entry(f->normal, i, j) : arb_mat_entry(f->normal, j, i));
    bool solved = arb_mat_approx_solve(x, full, f->right, f->bits) != 0;
    for (size_t i = 0; i < f->free && solved; i++) {
        solved = arb_is_finite(arb_mat_entry(x, i, 0)) != 0;
        arb_set(f->c + f->column[i], arb_mat_entry(x, i, 0));
        mag_zero(arb_radref(f->c + f->column[i]));
    }
    arb_mat_clear(full);
    arb_mat_clear(x);
    return solved;
}

bool nh_ball_fit_residual(nh_ball_fit *f, double *log10_ratio)
{
    if (!evaluate(f)) return false;
    arb_t sum, term;
    double largest = -INFINITY;
    arb_init(sum);
    arb_init(term);
    for (size_t j = 0; j < f->n; j++) {
        arb_mul(term, f->c + j, f->row + j, f->bits);
        arb_add(sum, sum, term, f->bits);
        largest = fmax(largest, nh_ball_log10_lower(term));
    }
    bool fine = isfinite(largest);
    if (fine) *log10_ratio = nh_ball_log10_upper(sum) - largest;
    arb_clear(sum);
    arb_clear(term);
    return fine;
}

double nh_ball_fit_coefficient(const nh_ball_fit *f, size_t j) { return arf_get_d(arb_midref(f->c + j), ARF_RND_NEAR); }
