/* Jets along straight lines (docs/method.md (20)): with X the direction and G = Gamma(., X),
 *
 *      xi' = B X,     B' = -( xi^l dG_l - B G + G B + Gamma(., B X) )          m + m^2 numbers for each jet
 *
 * in coordinates scaled by the metric at q0. A line on the way to a zero of det K is not followed. */
#include "reduction/transport.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/progress.h"
#include "graph/diff.h"
#include "reduction/runge.h"

static size_t packed(size_t i, size_t j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

/* K, its first and its second derivatives, packed: K_ij for i >= j. */
static nh_tape *metric_tape(const nh_kinetic *k)
{
    size_t m = k->m, h = m * (m + 1) / 2, n = 0;
    nh_ex *e = nh_alloc_array(h * (1 + m + h), sizeof *e);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j <= i; j++) e[n++] = k->K[i * m + j];
    for (size_t r = 0; r < m; r++)
        for (size_t p = 0; p < h; p++) e[n++] = nh_kinetic_diff(k, e[p], k->q[r]);
    for (size_t r = 0; r < m; r++)
        for (size_t s = 0; s <= r; s++)
            for (size_t p = 0; p < h; p++) e[n++] = nh_kinetic_diff(k, e[h + r * h + p], k->q[s]);
    nh_tape *tape = nh_kinetic_tape(k, n, e);
    nh_free(e);
    return tape;
}

void nh_transport_init(nh_transport *t, const nh_kinetic *k, const double *q0)
{
    size_t m = k->m, h = m * (m + 1) / 2, cube = m * m * m;
    *t = (nh_transport){.kinetic = k, .m = m, .h = h, .size = m + m * m, .tape = metric_tape(k)};
    t->work = nh_tape_work_create(t->tape);
    t->raw = nh_alloc_array(h * (1 + m + h) + 2 * m + 3 * m * m + 5 * cube, sizeof *t->raw);
    t->scale = t->raw + h * (1 + m + h);
    t->q = t->scale + m;
    t->K = t->q + m;
    t->Kinv = t->K + m * m;
    t->G = t->Kinv + m * m;
    t->dK = t->G + m * m;
    t->Gamma = t->dK + cube;
    t->dG = t->Gamma + cube;
    t->first = t->dG + cube;
    t->dfirst = t->first + cube;
    nh_tape_eval(t->tape, t->work, q0, t->raw);
    for (size_t i = 0; i < m; i++) {
        t->scale[i] = t->raw[packed(i, i)];
        for (size_t j = 0; j < m && !k->metric; j++) t->scale[i] = fmax(t->scale[i], fabs(t->raw[packed(i, j)]));
    }
    double length = nh_kinetic_length(k, t->scale);
    t->factor = 1 / (length * length);
    for (size_t i = 0; i < m; i++) t->scale[i] = length / sqrt(t->scale[i]);
}

void nh_transport_clear(nh_transport *t)
{
    nh_tape_work_free(t->work);
    nh_tape_free(t->tape);
    nh_free(t->raw);
}

/* a^-1 for m x m. */
static bool invert(size_t m, const double *a, double *inverse)
{
    double *copy = nh_alloc_array(m * m, sizeof *copy);
    memcpy(copy, a, m * m * sizeof *copy);
    for (size_t i = 0; i < m * m; i++) inverse[i] = i % (m + 1) == 0;
    bool good = nh_solve(m, copy, m, inverse, NULL);
    nh_free(copy);
    return good;
}

/* Gamma_l,jk = (d_j K_lk + d_k K_lj - d_l K_jk)/2 in `first`, raised in Gamma. */
static void christoffel(nh_transport *t)
{
    size_t m = t->m;
    for (size_t l = 0; l < m; l++)
        for (size_t j = 0; j < m; j++)
            for (size_t k = 0; k < m; k++)
                t->first[l + m * (j + m * k)] =
                    0.5 * (t->dK[l + m * (k + m * j)] + t->dK[l + m * (j + m * k)] - t->dK[j + m * (k + m * l)]);
    nh_multiply(m, m * m, m, t->Kinv, t->first, t->Gamma);
}

/* For one p, in scaled coordinates: D_lj = d_p d_j K_lk X^k and S_lj = d_p d_k K_lj X^k (m x m, column-major), from the
 * tape's output. */
static void second_derivatives(const nh_transport *t, size_t p, const double *x, double *D, double *S)
{
    size_t m = t->m, h = t->h;
    const double *c = t->scale;
    memset(S, 0, m * m * sizeof *S);
    for (size_t k = 0; k < m; k++) {
        const double *block = t->raw + h * (1 + m + packed(p, k));
        for (size_t l = 0; l < m; l++) {
            const double *row = block + l * (l + 1) / 2;
            double sum = 0;
            for (size_t i = 0; i <= l; i++) {
                sum += row[i] * x[i] * c[i];
                S[i + m * l] += row[i] * x[k] * c[k];
            }
            for (size_t i = l + 1; i < m; i++) sum += block[i * (i + 1) / 2 + l] * x[i] * c[i];
            D[l + m * k] = sum * c[l] * c[k] * c[p] * t->factor;
        }
    }
    for (size_t l = 0; l < m; l++)
        for (size_t j = 0; j <= l; j++) S[l + m * j] = S[j + m * l] *= c[l] * c[j] * c[p] * t->factor;
}

/* G^i_j = Gamma^i_jk X^k and d_p G^i_j = K^il ( d_p(Gamma_l,jk) X^k - d_p K_ln G^n_j ). */
static void along(nh_transport *t, const double *x)
{
    size_t m = t->m;
    /* the symbols of the first kind are not needed any more; m >= 3 of these fit */
    double *D = t->first, *S = D + m * m, *KG = S + m * m;
    double *own = m < 3 ? nh_alloc_array(3 * m * m, sizeof *own) : NULL;
    if (own) D = own, S = D + m * m, KG = S + m * m;
    memset(t->G, 0, m * m * sizeof *t->G);
    for (size_t k = 0; k < m; k++)
        for (size_t i = 0; i < m * m; i++) t->G[i] += t->Gamma[i + m * m * k] * x[k];
    for (size_t p = 0; p < m; p++) {
        second_derivatives(t, p, x, D, S);
        nh_multiply(m, m, m, t->dK + m * m * p, t->G, KG);
        for (size_t j = 0; j < m; j++)
            for (size_t l = 0; l < m; l++)
                t->dfirst[l + m * (j + m * p)] = 0.5 * (D[l + m * j] + S[l + m * j] - D[j + m * l]) - KG[l + m * j];
    }
    nh_multiply(m, m * m, m, t->Kinv, t->dfirst, t->dG);
    nh_free(own);
}

bool nh_transport_at(nh_transport *t, const double *q, const double *x)
{
    size_t m = t->m;
    const double *c = t->scale;
    nh_tape_eval(t->tape, t->work, q, t->raw);
    double sum = 0;
    for (size_t i = 0; i < t->h * (1 + m + t->h); i++) sum += t->raw[i] - t->raw[i];
    if (sum != 0) return false;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++) {
            t->K[i + m * j] = t->raw[packed(i, j)] * c[i] * c[j] * t->factor;
            for (size_t k = 0; k < m; k++)
                t->dK[i + m * (j + m * k)] = t->raw[t->h * (1 + k) + packed(i, j)] * c[i] * c[j] * c[k] * t->factor;
        }
    if (!invert(m, t->K, t->Kinv)) return false;
    christoffel(t);
    along(t, x);
    return true;
}

/* xi' = B X,   B' = -( xi^l dG_l - B G + G B + Gamma(., BX) ). */
void nh_transport_rate(const nh_transport *t, const double *x, const double *jet, double *rate)
{
    size_t m = t->m;
    const double *B = jet + m;
    double *dB = rate + m, *GB = nh_alloc_array(2 * m * m, sizeof *GB), *part = GB + m * m;
    nh_multiply(m, 1, m, B, x, rate);
    nh_multiply(m, m, m, B, t->G, dB);
    nh_multiply(m, m, m, t->G, B, GB);
    for (size_t i = 0; i < m * m; i++) dB[i] -= GB[i];
    nh_multiply(m * m, 1, m, t->dG, jet, part);
    for (size_t i = 0; i < m * m; i++) dB[i] -= part[i];
    nh_multiply(m * m, 1, m, t->Gamma, rate, part);
    for (size_t i = 0; i < m * m; i++) dB[i] -= part[i];
    nh_free(GB);
}

/* ---- along a line ---- */

typedef struct {
    nh_transport *t;
    const double *from, *x; /* true coordinates; scaled direction */
    size_t count;
} way;

static bool rate_of(double s, const double *y, double *rate, void *context)
{
    way *w = context;
    nh_transport *t = w->t;
    for (size_t i = 0; i < t->m; i++) t->q[i] = w->from[i] + s * w->x[i] * t->scale[i];
    if (!nh_transport_at(t, t->q, w->x)) return false;
    for (size_t j = 0; j < w->count && !nh_interrupted(); j++)
        nh_transport_rate(t, w->x, y + j * t->size, rate + j * t->size);
    return true;
}

/* |det K| at a fraction of the way, in scaled coordinates. */
static double determinant(nh_transport *t, const way *w, double part)
{
    size_t m = t->m;
    for (size_t i = 0; i < m; i++) t->q[i] = w->from[i] + part * w->x[i] * t->scale[i];
    nh_tape_eval(t->tape, t->work, t->q, t->raw);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++) t->K[i + m * j] = t->raw[packed(i, j)] * t->scale[i] * t->scale[j] * t->factor;
    return fabs(nh_determinant(m, t->K));
}

/* Does det K stay away from zero?  A transport would spend all its steps on the way to a zero.  Each minimum among
 * samples is narrowed by golden sections. */
static bool is_regular(nh_transport *t, const way *w)
{
    enum { samples = 16, sections = 24 };
    static const double golden = 0.3819660112501051, vanishing = 1e-6;
    double value[samples + 1];
    for (int i = 0; i <= samples; i++) value[i] = determinant(t, w, (double)i / samples);
    for (int i = 1; i < samples; i++) {
        double sides = fmin(value[i - 1], value[i + 1]), low = (double)(i - 1) / samples,
               high = (double)(i + 1) / samples;
        if (!(value[i] <= sides)) continue;
        double x = low + golden * (high - low), y = high - golden * (high - low), at_x = determinant(t, w, x),
               at_y = determinant(t, w, y);
        for (int k = 0; k < sections; k++)
            if (at_x < at_y) high = y, y = x, at_y = at_x, at_x = determinant(t, w, x = low + golden * (high - low));
            else low = x, x = y, at_x = at_y, at_y = determinant(t, w, y = high - golden * (high - low));
        if (fmin(at_x, at_y) < vanishing * sides) return false;
    }
    return true;
}

bool nh_transport_along(nh_transport *t, const double *q0, const double *q1, size_t count, double *y, double tolerance)
{
    static const double largest = 1e8; /* a jet that has grown by this factor has lost its digits */
    double *x = nh_alloc_array(t->m, sizeof *x);
    way w = {t, q0, x, count};
    for (size_t i = 0; i < t->m; i++) x[i] = (q1[i] - q0[i]) / t->scale[i];
    bool good = is_regular(t, &w) && nh_runge(t->size * count, rate_of, &w, 0, 1, tolerance, largest, &t->steps, y);
    nh_free(x);
    return good;
}
