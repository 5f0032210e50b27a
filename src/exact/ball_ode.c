/* ball_ode: the equations at one s, and power series about it (the method: ball_ode.h).
 *
 *      samples p = 1..P of the other variables,  words i = 1..W
 *
 *           [ r b_i(s, p) ] f' + [ c_i(s, p) ] f = 0         P x W: divided by r, B f' + R f = 0
 *
 *           M = -(B^T B)^-1 B^T R      f' = M f               W x W
 *           C = R + B M                C f = 0                P x W: what least squares leaves
 *
 *      one piece of the s axis:
 *
 *           centre - half                 centre                 centre + half
 *           |--x---x----x-----x------x------+------x------x-----x----x---x--|     x: nodes, M there
 *
 *           M(x) = sum_k M_k x^k by interpolation,   (k+1) f_(k+1) = half sum_j M_j f_(k-j)
 *
 * Words that are combinations of others with functions of s as coefficients make B^T B singular; they are found by
 * elimination at the first s, and left out. A piece whose interpolation or series is not accurate enough is tried
 * again with a smaller half width. */
#include "exact/ball_ode_internal.h"

#include <math.h>

#include "base/budget.h"
#include "base/memory.h"
#include "base/progress.h"

enum { nodes = 56, terms = NH_ODE_TERMS, most_tries = 10, rejected_each = 8 };
static const double guard_digits = 6, condition_digits = 24,
                    lost_each =
                        /* digits that each further power of an interpolating polynomial loses: log10(1 + sqrt 2) */
                    0.39,
                    same_word = 20;

long nh_ball_ode_bits(double digits)
{
    return (long)ceil((2 * (digits + condition_digits) + lost_each * nodes) / log10(2));
}

nh_ball_ode *nh_ball_ode_create(nh_ball *ball, const nh_ball_ode_problem *problem)
{
    nh_ball_ode *o = nh_alloc(sizeof *o);
    size_t n = problem->words;
    *o = (nh_ball_ode){.ball = ball,
                       .q = *problem,
                       .bits = nh_ball_bits(ball),
                       .word = nh_alloc_array(n + 1, sizeof *o->word),
                       .sample = nh_alloc_array(2 * n + NH_ODE_SPARE, sizeof *o->sample),
                       .scale = nh_alloc_array(n + 1, sizeof *o->scale),
                       .piece = nh_alloc_array(NH_ODE_PIECES, sizeof *o->piece),
                       .rate = -INFINITY};
    return o;
}

static size_t entries(const nh_ball_ode *o) { return terms * o->words * o->dimension; }

static void drop_pieces(nh_ball_ode *o)
{
    for (size_t i = 0; i < o->pieces; i++) _arb_vec_clear(o->piece[i].f, (slong)entries(o));
    o->pieces = 0;
}

void nh_ball_ode_free(nh_ball_ode *o)
{
    if (!o) return;
    drop_pieces(o);
    nh_free(o->piece);
    nh_free(o->scale);
    nh_free(o->sample);
    nh_free(o->word);
    nh_free(o);
}

/* ---- the equations at one s ---- */

void nh_ode_work(const nh_ball_ode *o, double products)
{
    nh_work_add(NH_WORK_BALL, products * nh_ball_products(o->bits));
}

void nh_ode_add_product(arb_ptr z, arb_srcptr x, arb_srcptr y, long bits)
{
    if (!arf_is_zero(arb_midref(x))) arf_addmul(arb_midref(z), arb_midref(x), arb_midref(y), bits, ARF_RND_DOWN);
}

/* log10 |v| of the mid-point. */
double nh_ode_size(arb_srcptr v)
{
    arb_t middle;
    arb_init(middle);
    arf_set(arb_midref(middle), arb_midref(v));
    double size = nh_ball_log10_upper(middle);
    arb_clear(middle);
    return size;
}

double nh_ode_largest(const arb_mat_t a)
{
    double size = -INFINITY;
    for (slong i = 0; i < arb_mat_nrows(a); i++)
        for (slong j = 0; j < arb_mat_ncols(a); j++) size = fmax(size, nh_ode_size(arb_mat_entry(a, i, j)));
    return size;
}

/* Row `row` of B and R = c/r.  Only mid-points count: the quality of the solutions is judged by their residuals, which
 * are rigorous. */
static bool fill_row(nh_ball_ode *o, double s, size_t sample, slong row, arb_mat_t B, arb_mat_t R, arb_t r)
{
    if (!o->q.point(o->q.context, o->ball, s, sample) || !nh_ball_eval(o->ball, o->q.variable_slope, r) ||
        arb_contains_zero(r))
        return false;
    for (size_t i = 0; i < o->words; i++) {
        arb_ptr b = arb_mat_entry(B, row, i), c = arb_mat_entry(R, row, i);
        if (!nh_ball_eval(o->ball, o->q.value[o->word[i]], b) || !nh_ball_eval(o->ball, o->q.slope[o->word[i]], c))
            return false;
        arb_div(c, c, r, o->bits);
        arb_mul_2exp_si(b, b, -o->scale[i]);
        arb_mul_2exp_si(c, c, -o->scale[i]);
        mag_zero(arb_radref(b));
        mag_zero(arb_radref(c));
    }
    return true;
}

/* All rows of B and R at s: P x W. */
static bool fill(nh_ball_ode *o, double s, arb_mat_t B, arb_mat_t R)
{
    arb_t r;
    arb_init(r);
    bool fine = true;
    for (size_t p = 0; p < o->samples && fine; p++) fine = fill_row(o, s, o->sample[p], (slong)p, B, R, r);
    arb_clear(r);
    return fine;
}

/* M: W x W; C (NULL: not asked for): P x W, allocated here. */
bool nh_ode_equation(nh_ball_ode *o, double s, arb_mat_t M, arb_mat_t *C)
{
    slong W = (slong)o->words, P = (slong)o->samples;
    arb_mat_t B, R, T, N, Q;
    arb_mat_init(B, P, W);
    arb_mat_init(R, P, W);
    arb_mat_init(T, W, P);
    arb_mat_init(N, W, W);
    arb_mat_init(Q, W, W);
    bool fine = fill(o, s, B, R);
    if (fine) {
        nh_ode_work(o, (double)W * (double)W * (2 * (double)P + (double)W));
        arb_mat_transpose(T, B);
        arb_mat_approx_mul(N, T, B, o->bits);
        arb_mat_approx_mul(Q, T, R, o->bits);
        fine = arb_mat_approx_solve(M, N, Q, o->bits) != 0;
    }
    if (fine) arb_mat_neg(M, M);
    double bound = nh_ode_largest(M) - o->q.digits - condition_digits;
    for (slong i = 0; i < W && fine; i++)
        for (slong j = 0; j < W && fine; j++) {
            fine = arb_is_finite(arb_mat_entry(M, i, j)) != 0;
            if (nh_ode_size(arb_mat_entry(M, i, j)) < bound) arb_zero(arb_mat_entry(M, i, j)); /* rounding */
        }
    if (fine && C) {
        o->rate = fmax(o->rate, nh_ode_largest(R));
        arb_mat_approx_mul(*C, B, M, o->bits);
        for (slong i = 0; i < P; i++)
            for (slong j = 0; j < W; j++)
                arf_add(arb_midref(arb_mat_entry(*C, i, j)), arb_midref(arb_mat_entry(*C, i, j)),
                        arb_midref(arb_mat_entry(R, i, j)), o->bits, ARF_RND_DOWN);
    }
    arb_mat_clear(B);
    arb_mat_clear(R);
    arb_mat_clear(T);
    arb_mat_clear(N);
    arb_mat_clear(Q);
    return fine;
}

/* ---- samples and words ---- */

/* Chooses samples at which the words and their rates have values and s changes: where it hardly does, 1/r is near a
 * pole for other s. */
static bool choose_samples(nh_ball_ode *o, double s)
{
    static const double slow = 0.1;
    size_t wanted = 2 * o->words + NH_ODE_SPARE, tried = 0;
    arb_t v;
    arb_init(v);
    double fastest = -INFINITY;
    for (size_t p = 0; p < wanted; p++)
        if (o->q.point(o->q.context, o->ball, s, p) && nh_ball_eval(o->ball, o->q.variable_slope, v))
            fastest = fmax(fastest, nh_ball_log10_upper(v));
    o->samples = 0;
    for (; o->samples < wanted && tried < rejected_each * wanted && !nh_late(); tried++) {
        bool usable = o->q.point(o->q.context, o->ball, s, tried) && nh_ball_eval(o->ball, o->q.variable_slope, v) &&
                      nh_ball_log10_lower(v) > fastest + log10(slow);
        for (size_t i = 0; i < o->q.words && usable; i++)
            usable = nh_ball_eval(o->ball, o->q.value[i], v) && nh_ball_eval(o->ball, o->q.slope[i], v);
        if (usable) o->sample[o->samples++] = tried;
    }
    arb_clear(v);
    return o->samples == wanted;
}

/* Elimination, column after column: a word whose column vanishes then is a combination of earlier words. */
static bool choose_words(nh_ball_ode *o, double s)
{
    slong P = (slong)o->samples;
    arb_mat_t B, R;
    arb_t dot, part;
    arb_mat_init(B, P, (slong)o->words);
    arb_mat_init(R, P, (slong)o->words);
    arb_init(dot);
    arb_init(part);
    bool fine = fill(o, s, B, R);
    size_t kept = 0;
    for (size_t j = 0; j < o->words && fine; j++) {
        double before = -INFINITY, after = -INFINITY;
        for (slong p = 0; p < P; p++) before = fmax(before, nh_ode_size(arb_mat_entry(B, p, j)));
        for (size_t i = 0; i < kept; i++) { /* the columns before it are orthonormal and are stored in R */
            arb_zero(dot);
            for (slong p = 0; p < P; p++)
                nh_ode_add_product(dot, arb_mat_entry(R, p, i), arb_mat_entry(B, p, j), o->bits);
            arb_neg(dot, dot);
            for (slong p = 0; p < P; p++)
                nh_ode_add_product(arb_mat_entry(B, p, j), dot, arb_mat_entry(R, p, i), o->bits);
        }
        for (slong p = 0; p < P; p++) after = fmax(after, nh_ode_size(arb_mat_entry(B, p, j)));
        if (!(after > before - same_word)) continue;
        arb_zero(dot);
        for (slong p = 0; p < P; p++) nh_ode_add_product(dot, arb_mat_entry(B, p, j), arb_mat_entry(B, p, j), o->bits);
        arb_rsqrt(dot, dot, o->bits);
        for (slong p = 0; p < P; p++) {
            arb_mul(part, arb_mat_entry(B, p, j), dot, o->bits);
            mag_zero(arb_radref(part));
            arb_set(arb_mat_entry(R, p, kept), part);
        }
        o->scale[kept] = (long)floor(before / log10(2));
        o->word[kept++] = o->word[j];
    }
    arb_clear(part);
    arb_clear(dot);
    arb_mat_clear(B);
    arb_mat_clear(R);
    o->words = kept;
    return fine && kept;
}

bool nh_ode_choose(nh_ball_ode *o, double s)
{
    o->words = o->q.words;
    for (size_t i = 0; i < o->words; i++) {
        o->word[i] = i;
        o->scale[i] = 0;
    }
    if (!choose_samples(o, s) || !choose_words(o, s)) return false;
    o->samples = 2 * o->words + NH_ODE_SPARE;
    return true;
}

/* ---- power series ---- */

/* M at points of [centre - half, centre + half] as a polynomial: X(k, i*W + l) is the coefficient of x^k.  *error:
 * log10 of its relative error. */
static bool interpolate(nh_ball_ode *o, double centre, double half, arb_mat_t X, double *error)
{
    slong W = (slong)o->words;
    arb_mat_t V, values, M;
    arb_t x;
    arb_init(x);
    arb_mat_init(V, nodes, nodes);
    arb_mat_init(values, nodes, W * W);
    arb_mat_init(M, W, W);
    bool fine = true;
    for (slong k = 0; k < nodes && fine; k++) {
        double s = centre - half * cos(M_PI * ((double)k + 0.5) / nodes);
        fine = nh_ode_equation(o, s, M, NULL) && !nh_late();
        for (slong i = 0; i < W * W && fine; i++) arb_set(arb_mat_entry(values, k, i), arb_mat_entry(M, i / W, i % W));
        arb_set_d(x, s);
        arb_set_d(arb_mat_entry(V, k, 0), centre);
        arb_sub(x, x, arb_mat_entry(V, k, 0), o->bits);
        arb_set_d(arb_mat_entry(V, k, 0), half);
        arb_div(x, x, arb_mat_entry(V, k, 0), o->bits);
        arb_one(arb_mat_entry(V, k, 0));
        for (slong j = 1; j < nodes; j++) {
            arb_mul(arb_mat_entry(V, k, j), arb_mat_entry(V, k, j - 1), x, o->bits);
            mag_zero(arb_radref(arb_mat_entry(V, k, j)));
        }
    }
    nh_ode_work(o, (double)nodes * nodes * (nodes / 3.0 + (double)(W * W)));
    fine = fine && arb_mat_approx_solve(X, V, values, o->bits) != 0;
    *error = -INFINITY; /* the last coefficients of Chebyshev's polynomials: x^n has 2^(1-n) T_n */
    for (slong i = 0; i < W * W && fine; i++)
        for (slong k = nodes - 2; k < nodes; k++)
            *error = fmax(*error, nh_ode_size(arb_mat_entry(X, k, i)) - (double)(k - 1) * log10(2));
    double size = nh_ode_largest(values);
    if (isfinite(size))
        *error -= fmax(
            size, -log10(half)); /* where f hardly depends on s, f' = M f with a small M needs few relative digits */
    arb_clear(x);
    arb_mat_clear(V);
    arb_mat_clear(values);
    arb_mat_clear(M);
    return fine;
}

/* (k+1) f_(k+1) = half sum_j M_j f_(k-j); f_0 is set.  Returns log10 of the last terms over the largest. */
static double power_series(nh_ball_ode *o, const arb_mat_t X, const nh_ode_piece *p)
{
    size_t W = o->words, d = o->dimension, step = W * d;
    double most = -INFINITY, last = -INFINITY;
    arb_t h;
    arb_init(h);
    for (size_t k = 0; k < terms; k++) {
        arb_ptr next = p->f + (k + 1) * step;
        for (size_t i = 0; i < step; i++) {
            double size = nh_ode_size(p->f + k * step + i);
            most = fmax(most, size);
            if (k + 2 >= terms) last = fmax(last, size);
        }
        if (k + 1 == terms) break;
        for (size_t j = 0; j <= k && j < nodes; j++)
            for (size_t i = 0; i < W; i++)
                for (size_t l = 0; l < W; l++)
                    for (size_t v = 0; v < d; v++)
                        nh_ode_add_product(next + i * d + v, arb_mat_entry(X, j, i * W + l),
                                           p->f + (k - j) * step + l * d + v, o->bits);
        arb_set_d(h, p->half);
        arb_div_ui(h, h, k + 1, o->bits);
        for (size_t i = 0; i < step; i++) {
            arb_mul(next + i, next + i, h, o->bits);
            mag_zero(arb_radref(next + i));
        }
    }
    nh_ode_work(o, (double)nodes * (terms - nodes / 2) * (double)(W * step));
    arb_clear(h);
    return last - most;
}

void nh_ode_evaluate(const nh_ball_ode *o, const nh_ode_piece *p, double s, bool derivative, arb_ptr out)
{
    size_t step = o->words * o->dimension;
    arb_t x, h;
    arb_init(x);
    arb_init(h);
    arb_set_d(x, s);
    arb_set_d(h, p->centre);
    arb_sub(x, x, h, o->bits);
    arb_set_d(h, p->half);
    arb_div(x, x, h, o->bits);
    mag_zero(arb_radref(x));
    for (size_t i = 0; i < step; i++) {
        arb_zero(out + i);
        for (size_t k = terms; k-- > (derivative ? 1 : 0);) {
            arb_mul(out + i, out + i, x, o->bits);
            if (derivative) arb_addmul_ui(out + i, p->f + k * step + i, k, o->bits);
            else arb_add(out + i, out + i, p->f + k * step + i, o->bits);
            mag_zero(arb_radref(out + i));
        }
        if (derivative) arb_div(out + i, out + i, h, o->bits);
        mag_zero(arb_radref(out + i));
    }
    nh_ode_work(o, (double)(terms * step));
    arb_clear(h);
    arb_clear(x);
}

bool nh_ode_add_piece(nh_ball_ode *o, double centre, double half, double least, arb_srcptr start)
{
    size_t step = o->words * o->dimension;
    double target = -(o->q.digits + guard_digits), error = 0;
    arb_mat_t X;
    bool done = false;
    if (o->pieces == NH_ODE_PIECES) return false;
    nh_ode_piece p = {.centre = centre, .half = half, .f = _arb_vec_init((slong)entries(o))};
    arb_mat_init(X, nodes, (slong)(o->words * o->words));
    for (size_t tries = 0; tries < most_tries && !done && p.half >= least && !nh_late() && !nh_budget_spent();
         tries++) {
        if (!interpolate(o, centre, p.half, X, &error)) {
            p.half /= 4;
        } else if (error > target) {
            p.half *= fmin(0.8, fmax(0.05, 0.9 * pow(10, (target - error) / nodes)));
        } else {
            _arb_vec_zero(p.f, (slong)entries(o));
            for (size_t i = 0; i < step; i++) arb_set(p.f + i, start + i);
            double last = power_series(o, X, &p);
            done = last <= target;
            if (!done) p.half *= fmin(0.8, fmax(0.05, 0.9 * pow(10, (target - last) / terms)));
        }
    }
    o->guess = p.half * fmin(2, fmax(0.8, 0.9 * pow(10, fmin(20, target - error) / nodes)));
    if (done) o->piece[o->pieces++] = p;
    else _arb_vec_clear(p.f, (slong)entries(o));
    arb_mat_clear(X);
    return done;
}
