/* ball_ode: the space of solutions of f' = M f with C f = 0, and its continuation.
 *
 *    1. allowed         at the centre: null vectors of C^T C, the values f(centre) that the conditions leave
 *    2. first piece     the solutions with these initial values, as power series
 *    3. allowed_along   their combinations with C f = 0 at several s of the piece: null vectors of sum (C F)^T (C F)
 *    4. combine         the space gets these as its basis; its dimension is the answer
 *    5. extend          piece after piece to either side, each from the value at the last one's end:
 *
 *                  |-------piece 0-------|
 *                             |----piece 1---+-------------|        centred at the end of piece 0
 *                                                 |--piece 2-+----|     .  singularity of M
 *
 * The conditions are not used in phase 5: they hold there because they hold in an interval. */
#include <math.h>

#include "base/memory.h"
#include "base/progress.h"
#include "exact/ball_ode_internal.h"

enum { checked_nodes = 9, side_pieces = 40 };

/* The null vectors of a positive semidefinite G up to 10^bound, as columns of K with entries up to 1; by elimination
 * with the largest diagonal entries. */
static size_t kernel(arb_mat_t G, double bound, arb_mat_t K, long bits)
{
    size_t n = (size_t)arb_mat_nrows(G), left = n, count = 0;
    bool *used = nh_alloc_array(n + 1, sizeof *used);
    arb_t factor;
    arb_init(factor);
    for (; left; left--) {
        size_t at = n;
        double best = bound;
        for (size_t i = 0; i < n; i++) {
            if (used[i] || arf_sgn(arb_midref(arb_mat_entry(G, i, i))) <= 0 ||
                !(nh_ode_size(arb_mat_entry(G, i, i)) > best))
                continue;
            best = nh_ode_size(arb_mat_entry(G, i, i));
            at = i;
        }
        if (at == n) break;
        used[at] = true;
        for (size_t i = 0; i < n; i++) {
            if (i == at) continue;
            arb_div(factor, arb_mat_entry(G, i, at), arb_mat_entry(G, at, at), bits);
            arb_neg(factor, factor);
            for (size_t j = 0; j < n; j++)
                nh_ode_add_product(arb_mat_entry(G, i, j), factor, arb_mat_entry(G, at, j), bits);
            arb_zero(arb_mat_entry(G, i, at));
        }
    }
    for (size_t j = 0; j < n; j++) {
        if (used[j]) continue;
        arb_one(arb_mat_entry(K, j, count));
        for (size_t i = 0; i < n; i++) {
            if (!used[i]) continue;
            arb_div(arb_mat_entry(K, i, count), arb_mat_entry(G, i, j), arb_mat_entry(G, i, i), bits);
            arb_neg(arb_mat_entry(K, i, count), arb_mat_entry(K, i, count));
            mag_zero(arb_radref(arb_mat_entry(K, i, count)));
        }
        count++;
    }
    arb_clear(factor);
    nh_free(used);
    return count;
}

/* G += (C F)^T (C F) */
static void add_square(arb_mat_t G, const arb_mat_t C, const arb_mat_t F, long bits)
{
    arb_mat_t E, T, S;
    arb_mat_init(E, arb_mat_nrows(C), arb_mat_ncols(F));
    arb_mat_init(T, arb_mat_ncols(F), arb_mat_nrows(C));
    arb_mat_init(S, arb_mat_ncols(F), arb_mat_ncols(F));
    arb_mat_approx_mul(E, C, F, bits);
    arb_mat_transpose(T, E);
    arb_mat_approx_mul(S, T, E, bits);
    for (slong i = 0; i < arb_mat_nrows(S); i++)
        for (slong j = 0; j < arb_mat_ncols(S); j++)
            arf_add(arb_midref(arb_mat_entry(G, i, j)), arb_midref(arb_mat_entry(G, i, j)),
                    arb_midref(arb_mat_entry(S, i, j)), bits, ARF_RND_DOWN);
    arb_mat_clear(E);
    arb_mat_clear(T);
    arb_mat_clear(S);
}

/* F (W x dimension): the solutions at s. */
static void functions(const nh_ball_ode *o, const nh_ode_piece *p, double s, arb_mat_t F)
{
    size_t step = o->words * o->dimension;
    arb_ptr f = _arb_vec_init((slong)step);
    nh_ode_evaluate(o, p, s, false, f);
    for (size_t i = 0; i < step; i++) arb_set(arb_mat_entry(F, i / o->dimension, i % o->dimension), f + i);
    _arb_vec_clear(f, (slong)step);
}

/* Replaces the solutions by combinations of them: the columns of K. */
static void combine(nh_ball_ode *o, const arb_mat_t K, size_t count)
{
    size_t before = o->dimension, rows = NH_ODE_TERMS * o->words;
    for (size_t i = 0; i < o->pieces; i++) {
        arb_ptr old = o->piece[i].f, f = _arb_vec_init((slong)(rows * count));
        for (size_t k = 0; k < rows; k++)
            for (size_t v = 0; v < count; v++)
                for (size_t l = 0; l < before; l++)
                    nh_ode_add_product(f + k * count + v, old + k * before + l, arb_mat_entry(K, l, v), o->bits);
        _arb_vec_clear(old, (slong)(rows * before));
        o->piece[i].f = f;
    }
    nh_ode_work(o, (double)(o->pieces * rows * before * count));
    o->dimension = count;
}

/* The values of f at one s that its conditions allow: W x W, the first `count` columns. */
static size_t allowed(nh_ball_ode *o, double s, arb_mat_t K)
{
    slong W = (slong)o->words;
    size_t count = 0;
    arb_mat_t M, C, G, one;
    arb_mat_init(M, W, W);
    arb_mat_init(G, W, W);
    arb_mat_init(one, W, W);
    arb_mat_init(C, (slong)o->samples, W);
    arb_mat_one(one);
    if (nh_ode_equation(o, s, M, &C)) {
        add_square(G, C, one, o->bits);
        count = kernel(G, 2 * (o->rate - o->q.digits), K, o->bits);
    }
    arb_mat_clear(M);
    arb_mat_clear(C);
    arb_mat_clear(G);
    arb_mat_clear(one);
    return count;
}

/* Applies the conditions in the whole first interval to the solutions found so far. */
static size_t allowed_along(nh_ball_ode *o, arb_mat_t K)
{
    slong W = (slong)o->words, d = (slong)o->dimension;
    const nh_ode_piece *p = &o->piece[0];
    double size = -INFINITY;
    bool fine = true;
    arb_mat_t M, C, G, F;
    arb_mat_init(M, W, W);
    arb_mat_init(G, d, d);
    arb_mat_init(F, W, d);
    arb_mat_init(C, (slong)o->samples, W);
    for (int i = 0; i < checked_nodes && fine; i++) {
        double s = p->centre - p->half * cos(M_PI * (i + 0.5) / checked_nodes);
        fine = nh_ode_equation(o, s, M, &C) && !nh_late();
        functions(o, p, s, F);
        size = fmax(size, nh_ode_largest(F));
        add_square(G, C, F, o->bits);
    }
    size_t count = fine ? kernel(G, 2 * (o->rate + fmax(size, 0) - o->q.digits), K, o->bits) : 0;
    arb_mat_clear(M);
    arb_mat_clear(C);
    arb_mat_clear(G);
    arb_mat_clear(F);
    return count;
}

size_t nh_ball_ode_start(nh_ball_ode *o, double centre, double half)
{
    static const double least = 1e-4;
    if (!nh_ode_choose(o, centre)) return 0;
    slong W = (slong)o->words;
    arb_mat_t K, T;
    arb_mat_init(K, W, W);
    size_t count = o->dimension = allowed(o, centre, K);
    arb_ptr start = _arb_vec_init(W * W);
    for (size_t i = 0; i < (size_t)W * count; i++) arb_set(start + i, arb_mat_entry(K, i / count, i % count));
    o->guess = half / 2;
    if (count && nh_ode_add_piece(o, centre, half / 2, least * half, start)) {
        arb_mat_init(T, (slong)count, (slong)count);
        count = allowed_along(o, T);
        combine(o, T, count);
        arb_mat_clear(T);
    } else {
        count = o->dimension = 0;
    }
    _arb_vec_clear(start, W * W);
    arb_mat_clear(K);
    o->samples = o->words + NH_ODE_SPARE; /* if the solutions are true ones any points will do */
    return count;
}

size_t nh_ball_ode_words(const nh_ball_ode *o) { return o->words; }
size_t nh_ball_ode_word(const nh_ball_ode *o, size_t i) { return o->word[i]; }
double nh_ball_ode_size(const nh_ball_ode *o, size_t i) { return ldexp(1, (int)o->scale[i]); }
double nh_ball_ode_half(const nh_ball_ode *o) { return o->pieces ? o->piece[0].half : 0; }

double nh_ball_ode_extend(nh_ball_ode *o, double end, double least)
{
    static const double nothing = 1e-9;
    if (o->dimension == 0) return NAN;
    size_t step = o->words * o->dimension, last = 0;
    double side = end > o->piece[0].centre ? 1 : -1, whole = fabs(end - o->piece[0].centre), reached = 0;
    arb_ptr start = _arb_vec_init((slong)step);
    o->guess = o->piece[0].half;
    for (size_t added = 0;; added++) {
        reached = o->piece[last].centre + side * o->piece[last].half;
        if (side * (end - reached) <= nothing * whole || added == side_pieces) break;
        nh_ode_evaluate(o, &o->piece[last], reached, false, start);
        double half = fmin(o->guess, fabs(end - reached));
        if (!nh_ode_add_piece(o, reached, half, fmin(least, half), start)) break;
        last = o->pieces - 1;
    }
    _arb_vec_clear(start, (slong)step);
    return side * (end - reached) <= nothing * whole ? end : reached;
}

static const nh_ode_piece *piece_at(const nh_ball_ode *o, double s)
{
    const nh_ode_piece *best = &o->piece[0];
    for (size_t i = 1; i < o->pieces; i++)
        if (fabs(s - o->piece[i].centre) / o->piece[i].half < fabs(s - best->centre) / best->half) best = &o->piece[i];
    return best;
}

/* ---- a basis of the solutions ---- */

static void swap_columns(arb_mat_t A, slong i, slong j)
{
    for (slong k = 0; k < arb_mat_nrows(A); k++) arb_swap(arb_mat_entry(A, k, i), arb_mat_entry(A, k, j));
}

/* Makes the entry of column `at` in this row 1, and that of the others 0. */
static void clear_row(arb_mat_t A, slong row, slong at, long scale, long bits)
{
    arb_t factor;
    arb_init(factor);
    arb_mul_2exp_si(factor, arb_mat_entry(A, row, at), -scale);
    for (slong k = 0; k < arb_mat_nrows(A); k++) {
        arb_div(arb_mat_entry(A, k, at), arb_mat_entry(A, k, at), factor, bits);
        mag_zero(arb_radref(arb_mat_entry(A, k, at)));
    }
    for (slong v = 0; v < arb_mat_ncols(A); v++) {
        if (v == at) continue;
        arb_div(factor, arb_mat_entry(A, row, v), arb_mat_entry(A, row, at), bits);
        arb_neg(factor, factor);
        for (slong k = 0; k < arb_mat_nrows(A); k++)
            nh_ode_add_product(arb_mat_entry(A, k, v), factor, arb_mat_entry(A, k, at), bits);
        arb_zero(arb_mat_entry(A, row, v));
    }
    arb_clear(factor);
}

void nh_ball_ode_normalise(nh_ball_ode *o, double s)
{
    static const double small = -3;
    slong W = (slong)o->words, d = (slong)o->dimension, done = 0;
    arb_mat_t F, A, T;
    arb_mat_init(F, W, d);
    arb_mat_init(A, W + d, d); /* F, and the matrix by which it was multiplied */
    arb_mat_init(T, d, d);
    functions(o, piece_at(o, s), s, F);
    for (slong i = 0; i < W + d; i++)
        for (slong v = 0; v < d; v++) {
            if (i < W) arb_set(arb_mat_entry(A, i, v), arb_mat_entry(F, i, v));
            else arb_set_ui(arb_mat_entry(A, i, v), i - W == v);
        }
    for (slong i = 0; i < W && done < d; i++) {
        double best = small;
        slong at = d;
        for (slong v = done; v < d; v++) {
            double most = -INFINITY;
            for (slong k = 0; k < W; k++) most = fmax(most, nh_ode_size(arb_mat_entry(A, k, v)));
            if (!(nh_ode_size(arb_mat_entry(A, i, v)) - most > best)) continue;
            best = nh_ode_size(arb_mat_entry(A, i, v)) - most;
            at = v;
        }
        if (at == d) continue;
        swap_columns(A, done, at);
        clear_row(A, i, done++, o->scale[i], o->bits);
    }
    for (slong i = 0; i < d; i++)
        for (slong v = 0; v < d; v++) arb_set(arb_mat_entry(T, i, v), arb_mat_entry(A, W + i, v));
    combine(o, T, (size_t)d);
    arb_mat_clear(F);
    arb_mat_clear(A);
    arb_mat_clear(T);
}

/* ---- values ---- */

void nh_ball_ode_value(const nh_ball_ode *o, double s, double *out)
{
    size_t W = o->words, d = o->dimension;
    arb_ptr f = _arb_vec_init((slong)(W * d));
    nh_ode_evaluate(o, piece_at(o, s), s, false, f);
    for (size_t i = 0; i < W; i++)
        for (size_t v = 0; v < d; v++) {
            arb_mul_2exp_si(f + i * d + v, f + i * d + v, -o->scale[i]);
            out[i + v * W] = arf_get_d(arb_midref(f + i * d + v), ARF_RND_NEAR);
        }
    _arb_vec_clear(f, (slong)(W * d));
}

void nh_ball_ode_taylor(const nh_ball_ode *o, size_t terms, double *out)
{
    size_t W = o->words, d = o->dimension;
    const nh_ode_piece *p = &o->piece[0];
    for (size_t k = 0; k < terms; k++)
        for (size_t i = 0; i < W; i++)
            for (size_t v = 0; v < d; v++) {
                double f = arf_get_d(arb_midref(p->f + (k * W + i) * d + v), ARF_RND_NEAR);
                out[k + terms * (i + v * W)] = ldexp(f, -(int)o->scale[i]) / pow(p->half, (double)k);
            }
}

/* The terms f_i' r b_i and f_i c_i of each solution, relative to the largest. */
static bool residual(nh_ball_ode *o, const nh_ode_piece *p, double s, double *digits)
{
    size_t W = o->words, d = o->dimension;
    arb_ptr f = _arb_vec_init((slong)(2 * W * d)), value = _arb_vec_init((slong)(2 * W + 3)), r = value + 2 * W;
    bool fine = nh_ball_eval(o->ball, o->q.variable_slope, r);
    for (size_t i = 0; i < W && fine; i++) {
        fine = nh_ball_eval(o->ball, o->q.value[o->word[i]], value + i) &&
               nh_ball_eval(o->ball, o->q.slope[o->word[i]], value + W + i);
        arb_mul(value + i, value + i, r, o->bits);
        arb_mul_2exp_si(value + i, value + i, -o->scale[i]);
        arb_mul_2exp_si(value + W + i, value + W + i, -o->scale[i]);
    }
    nh_ode_evaluate(o, p, s, true, f);
    nh_ode_evaluate(o, p, s, false, f + W * d);
    for (size_t v = 0; v < d && fine; v++) {
        double most = -INFINITY;
        arb_ptr sum = r + 1, term = r + 2;
        arb_zero(sum);
        for (size_t i = 0; i < 2 * W; i++) {
            arb_mul(term, f + i * d + v, value + i, o->bits);
            arb_add(sum, sum, term, o->bits);
            most = fmax(most, nh_ball_log10_lower(term));
        }
        double left = nh_ball_log10_upper(sum);
        digits[v] = left == -INFINITY ? o->bits * log10(2) : isfinite(most) ? fmax(0, most - left) : 0;
    }
    _arb_vec_clear(value, (slong)(2 * W + 3));
    _arb_vec_clear(f, (slong)(2 * W * d));
    return fine;
}

bool nh_ball_ode_residual(nh_ball_ode *o, double s, size_t sample, double *digits)
{
    return o->q.point(o->q.context, o->ball, s, sample) && residual(o, piece_at(o, s), s, digits);
}
