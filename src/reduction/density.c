/* Closed forms of invariant measures exp(sigma), d_j sigma = -Theta_j (density.h):
 *
 *      collect_factors     F: det Khat, its numerator, sums, functions and coordinates in these and in Khat
 *      sample              d_j log F and -Theta_j at the sample points
 *      choose              one factor, then two: least squares c_1 d log F_1 + c_2 d log F_2 = -Theta, c rational
 *      prove               the same as an identity
 *
 *      taken: the first that holds for all parameters; else the first that is proved; else the first that fits */
#include "reduction/density.h"

#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "integrals/recognise.h"

enum { most_factors = 40, most_seen = 3000, most_places = 16, largest_denominator = 12 };

typedef struct {
    const nh_slice *s;
    nh_dag *d;
    size_t n, factors, seen;
    nh_ex factor[most_factors], node[most_seen];
} search;

/* Does e depend on the shape? */
static bool moves(const search *s, nh_ex e)
{
    for (size_t i = 0; i < s->n; i++)
        if (nh_depends(s->d, e, s->s->x[i])) return true;
    return false;
}

/* Adds a factor that depends on the shape and is not there. */
static void offer(search *s, nh_ex e)
{
    for (size_t i = 0; i < s->factors; i++)
        if (s->factor[i] == e) return;
    if (s->factors < most_factors && moves(s, e)) s->factor[s->factors++] = e;
}

/* Sums, functions and coordinates inside an expression. */
static void walk(search *s, nh_ex e)
{
    for (size_t i = 0; i < s->seen; i++)
        if (s->node[i] == e) return;
    if (s->seen == most_seen || !moves(s, e)) return;
    s->node[s->seen++] = e;
    if (nh_kind_of(s->d, e) != NH_PRODUCT) offer(s, e);
    for (size_t i = 0; i < nh_arity(s->d, e); i++) walk(s, nh_child(s->d, e, i));
}

/* -Theta_j = -(K^-1)^il U_lij as expressions. */
static bool minus_theta(const search *s, const nh_ex *K, const nh_ex *U, nh_ex *out)
{
    size_t n = s->n;
    nh_dag *d = s->d;
    nh_ex *b = nh_alloc_array(n + 1, sizeof *b);
    nh_lu *lu = nh_lu_create(d, n, K, nh_slice_pivot_score, (void *)s->s, NULL);
    for (size_t j = 0; j < n && lu; j++) {
        out[j] = nh_int(d, 0);
        for (size_t i = 0; i < n; i++) {
            for (size_t l = 0; l < n; l++) b[l] = U[(l * n + i) * n + j];
            nh_lu_solve(lu, b, b);
            out[j] = nh_sub(d, out[j], b[i]);
        }
    }
    /* near a pole of the coordinates 1e-9 of it would be lost */
    for (size_t j = 0; j < n && lu; j++) out[j] = nh_simplify(d, out[j]);
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(b);
    return good;
}

/* Least squares for one or two of the columns; the largest residual, relative. */
static double fit(size_t rows, const double *a, const double *b, const double *want, double *c)
{
    double aa = 0, ab = 0, bb = 0, aw = 0, bw = 0, off = 0, size = 0;
    for (size_t i = 0; i < rows; i++) {
        double y = b ? b[i] : 0;
        aa += a[i] * a[i], ab += a[i] * y, bb += y * y, aw += a[i] * want[i], bw += y * want[i];
    }
    double det = b ? aa * bb - ab * ab : aa;
    if (!(det > 1e-10 * (b ? aa * bb : aa))) return INFINITY;
    c[0] = b ? (aw * bb - bw * ab) / det : aw / det;
    c[1] = b ? (bw * aa - aw * ab) / det : 0;
    for (size_t i = 0; i < rows; i++) {
        off = fmax(off, fabs(c[0] * a[i] + (b ? c[1] * b[i] : 0) - want[i]));
        size = fmax(size, fabs(want[i]));
    }
    return off / (size > 0 ? size : 1);
}

/* d_j log F_k and -Theta_j at the sample points: rows (place, j), column by column; rows that are not finite are left
   out. */
static size_t sample(const search *s, const nh_ex *slope, double *column, double *want)
{
    const nh_kinetic *k = s->s->kinetic;
    size_t total = (s->factors + 1) * s->n, places = k->places < most_places ? k->places : most_places, rows = 0,
           all = places * s->n;
    double *value = nh_alloc_array(places * total + 1, sizeof *value);
    nh_kinetic_sample(k, total, slope, places, value);
    for (size_t p = 0; p < places; p++)
        for (size_t j = 0; j < s->n; j++) {
            const double *v = value + p * total;
            bool good = isfinite(v[s->factors * s->n + j]);
            for (size_t i = 0; i < s->factors; i++) good &= isfinite(v[i * s->n + j]);
            if (!good) continue;
            for (size_t i = 0; i < s->factors; i++) column[rows + i * all] = v[i * s->n + j];
            want[rows++] = v[s->factors * s->n + j];
        }
    for (size_t i = 1; i < s->factors; i++) memmove(column + i * rows, column + i * all, rows * sizeof *column);
    nh_free(value);
    return rows;
}

/* ---- which of them ---- */

typedef struct {
    size_t terms, which[2];
    nh_num power[2];
} candidate;

/* What the search knows of the slice, and the best density so far. */
typedef struct {
    const search *s;
    const nh_ex *slope, *theta;
    const nh_options *options;
    size_t left; /* number of candidates that may still be proved */
    bool found;
    candidate best;
    nh_proof proof;
} contest;

/* c_1 d_j log F_1 + c_2 d_j log F_2 + Theta_j = 0 for every j? */
static nh_proof prove(const contest *t, const candidate *c)
{
    const search *s = t->s;
    nh_dag *d = s->d;
    nh_proof all = {.proved = true, .all_parameters = true, .digits = INFINITY};
    for (size_t j = 0; j < s->n; j++) {
        nh_ex e[3] = {nh_neg(d, t->theta[j])};
        for (size_t i = 0; i < c->terms; i++)
            e[1 + i] = nh_mul(d, nh_number(d, c->power[i]), t->slope[c->which[i] * s->n + j]);
        all = nh_proof_both(s->s->kinetic->model, all,
                            nh_prove_zero(s->s->kinetic->model, 1 + c->terms, e, true, t->options));
    }
    return all;
}

/* The first candidate that fits and holds for all parameters; else the first that is proved; else the first that
 * fits. */
static void offer_candidate(contest *t, const candidate *c)
{
    if (!t->left) return;
    nh_proof proof = prove(t, c);
    t->left--;
    if (t->found && !(proof.all_parameters && !t->proof.all_parameters) && !(proof.proved && !t->proof.proved)) return;
    t->found = true;
    t->best = *c;
    t->proof = proof;
    if (proof.proved && proof.all_parameters) t->left = 0;
}

/* One factor, or two, that fit with rational exponents. */
static void choose(contest *t, size_t rows, const double *column, const double *want)
{
    /* where -Theta is too long to be simplified it has no more digits; the proof decides */
    static const double fits = 1e-6;
    double c[2];
    for (size_t i = 0; i < t->s->factors && t->left; i++) {
        candidate one = {.terms = 1, .which = {i}};
        if (fit(rows, column + i * rows, NULL, want, c) < fits &&
            nh_recognise_ratio(c[0], largest_denominator, fits, &one.power[0]))
            offer_candidate(t, &one);
    }
    for (size_t i = 0; i < t->s->factors; i++)
        for (size_t j = 0; j < i && t->left; j++) {
            candidate two = {.terms = 2, .which = {i, j}};
            if (fit(rows, column + i * rows, column + j * rows, want, c) < fits &&
                nh_recognise_ratio(c[0], largest_denominator, fits, &two.power[0]) &&
                nh_recognise_ratio(c[1], largest_denominator, fits, &two.power[1]))
                offer_candidate(t, &two);
        }
}

/* m + m y^2 as 1 + y^2: a sum without the powers of parameters that all terms have in common. */
static nh_ex without_content(const search *s, nh_ex e)
{
    static const int power[] = {2, 1, -1, -2};
    const nh_model *model = s->s->kinetic->model;
    for (size_t i = 0; i < model->system->parameters; i++)
        for (size_t j = 0; j < sizeof power / sizeof *power && nh_depends(s->d, e, model->parameter[i]); j++) {
            nh_ex rest = nh_simplify(s->d, nh_div(s->d, e, nh_powi(s->d, model->parameter[i], power[j])));
            if (!nh_depends(s->d, rest, model->parameter[i])) e = rest;
        }
    return e;
}

/* e^power without constant factors, and with (b^x)^c = b^(x c): constant factors and the sign of a density do not
 * matter. */
static nh_ex without_constants(const search *s, nh_ex e, nh_num power)
{
    nh_dag *d = s->d;
    nh_ex x = nh_number(d, power), out = nh_int(d, 1);
    e = nh_simplify(d, e);
    if (nh_kind_of(d, e) != NH_PRODUCT) return nh_pow(d, without_content(s, e), x);
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex base = nh_child(d, e, i), exponent = nh_exponent_of(d, e, i);
        if (moves(s, base) || moves(s, exponent))
            out = nh_mul(d, out, nh_pow(d, without_content(s, base), nh_mul(d, exponent, x)));
    }
    return out;
}

/* Factors that may occur in the density: the determinant, its numerator, the metric, and parts of these. */
static void collect_factors(search *s, const nh_ex *K)
{
    nh_ex det = nh_simplify(s->d, nh_solve_determinant(s->d, s->n, K));
    offer(s, det);
    walk(s, det);
    walk(s, nh_simplify(s->d, nh_numerator(s->d, det)));
    for (size_t i = 0; i < s->n * s->n; i++) walk(s, K[i]);
}

bool nh_density_find(const nh_slice *slice, const nh_ex *K, const nh_ex *U, const nh_options *options, nh_ex *density,
                     nh_proof *proof)
{
    enum { most_proofs = 12 };
    search *s = nh_alloc(sizeof *s);
    size_t n = slice->n, most = (most_factors + 1) * n;
    nh_dag *d = slice->dag;
    *s = (search){.s = slice, .d = d, .n = n};
    nh_ex *slope = nh_alloc_array(most + n + 1, sizeof *slope), *theta = slope + most;
    double *column = nh_alloc_array(most_places * n * (most_factors + 1) + 1, sizeof *column),
           *want = column + most_places * n * most_factors;
    contest t = {.s = s, .slope = slope, .theta = theta, .options = options, .left = most_proofs};
    bool good = n > 0 && n <= 4 && slice->tidy && minus_theta(s, K, U, theta);
    if (good) collect_factors(s, K);
    for (size_t i = 0; i < s->factors; i++)
        for (size_t j = 0; j < n; j++)
            slope[i * n + j] = nh_div(d, nh_diff(d, s->factor[i], slice->x[j]), s->factor[i]);
    if (good) memcpy(slope + s->factors * n, theta, n * sizeof *theta);
    size_t rows = good ? sample(s, slope, column, want) : 0;
    if (rows > 2 * n) choose(&t, rows, column, want);
    if (t.found) *density = nh_int(d, 1), *proof = t.proof;
    for (size_t i = 0; i < t.best.terms; i++)
        *density = nh_mul(d, *density, without_constants(s, s->factor[t.best.which[i]], t.best.power[i]));
    if (t.found) *density = nh_simplify(d, *density);
    nh_free(slope);
    nh_free(column);
    nh_free(s);
    return t.found;
}
