/* chaplygin_measure: invariant measure and conformal factor of a reduced Chaplygin system (chaplygin.h;
 * docs/method.md, sec. 9).
 *
 *      T^k_ij = (K^-1)^kl U_lij,   Theta_j = T^i_ij
 *
 *      measure     d_i Theta_j = d_j Theta_i
 *      factor      measure, and T^k_ij = th_j delta^k_i - th_i delta^k_j, th = Theta/(n - 1)
 *
 *      decide      both modulo primes at random points; else by numbers at the sample points, in the coordinates' units
 *      many-valued a mean of Theta_j over a full turn of an angle that is not zero */
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "exact/generic_value.h"
#include "exact/normal.h"
#include "graph/diff.h"
#include "integrals/exact_points.h"
#include "reduction/chaplygin.h"
#include "reduction/subspace.h"

typedef struct {
    size_t n;
    const double *K, *U, *dK, *dU; /* at a place; derivatives one direction after the other */
    double *T, *dT;                /* T^k_ij = T[(k*n + i)*n + j]; n times as many */
    double *Theta, *dTheta;        /* n; dTheta[l*n + j] = d_l Theta_j */
} gyro;

/* T = K^-1 U,   d_l T = K^-1 (d_l U - d_l K T). */
static bool tensor(gyro *g)
{
    size_t n = g->n, cube = n * n * n;
    double *K = nh_alloc_array(n * n + cube, sizeof *K), *right = K + n * n;
    bool good = true;
    for (size_t l = 0; l <= n && good; l++) { /* l = 0: T itself */
        double *out = l ? g->dT + (l - 1) * cube : g->T;
        for (size_t i = 0; i < n * n; i++) K[i] = g->K[i];
        for (size_t k = 0; k < n; k++)
            for (size_t pair = 0; pair < n * n; pair++) {
                double x = l ? g->dU[(l - 1) * cube + k * n * n + pair] : g->U[k * n * n + pair];
                for (size_t s = 0; s < n && l; s++) x -= g->dK[(l - 1) * n * n + k * n + s] * g->T[s * n * n + pair];
                right[k + pair * n] = x;
            }
        good = nh_solve(n, K, n * n, right, NULL);
        for (size_t k = 0; k < n; k++)
            for (size_t pair = 0; pair < n * n; pair++) out[k * n * n + pair] = right[k + pair * n];
    }
    for (size_t j = 0; j < n; j++) {
        g->Theta[j] = 0;
        for (size_t i = 0; i < n; i++) g->Theta[j] += g->T[(i * n + i) * n + j];
        for (size_t l = 0; l < n; l++) {
            g->dTheta[l * n + j] = 0;
            for (size_t i = 0; i < n; i++) g->dTheta[l * n + j] += g->dT[l * cube + (i * n + i) * n + j];
        }
    }
    nh_free(K);
    return good;
}

static nh_ex *list(const nh_slice *s, const nh_ex *K, const nh_ex *U, size_t *total)
{
    size_t n = s->n, cube = n * n * n, at = n * n + cube;
    *total = at * (1 + n);
    nh_ex *e = nh_alloc_array(*total, sizeof *e);
    memcpy(e, K, n * n * sizeof *e);
    memcpy(e + n * n, U, cube * sizeof *e);
    for (size_t l = 0; l < n; l++)
        for (size_t i = 0; i < n * n; i++) e[at++] = nh_diff(s->dag, K[i], s->x[l]);
    for (size_t l = 0; l < n; l++)
        for (size_t i = 0; i < cube; i++) e[at++] = nh_diff(s->dag, U[i], s->x[l]);
    return e;
}

/* The algebraic condition: the distance of T^k_ij from th_j delta^k_i - th_i delta^k_j, th = Theta/(n - 1). */
static double off_simple(const gyro *g)
{
    size_t n = g->n;
    double off = 0;
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                double want = (k == i ? g->Theta[j] : 0) - (k == j ? g->Theta[i] : 0);
                off = fmax(off, fabs(g->T[(k * n + i) * n + j] - want / (double)(n - 1)));
            }
    return off;
}

/* What holds at random points modulo primes: Theta = 0, d Theta = 0, T simple. */
typedef struct {
    size_t n;
    bool flat, closed, simple;
} exactly;

/* K (n x n), then U as n rows of n x n series. */
static bool read_gyro(const nh_jet_ring *ring, nh_residue *series, void *context)
{
    exactly *x = context;
    size_t n = x->n, size = ring->size;
    nh_residue *T = series + n * n * size, *Theta = nh_alloc_array(n * size, sizeof *Theta);
    bool regular = nh_jet_solve(ring, n, series, n * n, T);
    for (size_t j = 0; j < n && regular; j++)
        for (size_t i = 0; i < n; i++) nh_jet_add_multiple(ring, Theta + j * size, 1, T + ((i * n + i) * n + j) * size);
    for (size_t j = 0; j < n && regular; j++) {
        x->flat &= nh_jet_is_zero(ring, Theta + j * size);
        for (size_t l = 0; l < j; l++) /* the coefficients of the first order */
            x->closed &= Theta[j * size + ring->up[l * size]] == Theta[l * size + ring->up[j * size]];
    }
    for (size_t at = 0; at < n * n * n && regular && n > 1; at++) {
        size_t k = at / n / n, i = at / n % n, j = at % n;
        nh_residue want = nh_residue_sub(ring->field, k == i ? Theta[j * size] : 0, k == j ? Theta[i * size] : 0);
        x->simple &= nh_residue_mul(ring->field, (nh_residue)(n - 1), T[at * size]) == want;
    }
    nh_free(Theta);
    return regular;
}

static bool decide(const nh_slice *s, const nh_ex *K, const nh_ex *U, exactly *x)
{
    size_t n = s->n, total = n * n + n * n * n;
    nh_ex *e = nh_alloc_array(total + 1, sizeof *e);
    for (size_t i = 0; i < total; i++) e[i] = nh_model_values(s->kinetic->model, i < n * n ? K[i] : U[i - n * n]);
    *x = (exactly){n, true, true, true};
    bool known = nh_generic_series(s->dag, total, e, n, s->x, read_gyro, x);
    nh_free(e);
    return known;
}

/* The mean of Theta_j over a full turn of an angle x^j in steps that start at the given part of one, and the largest
 * value; the others as in q.  False where it is not finite. */
static bool mean_over_turn(const nh_slice *s, nh_tape *tape, nh_tape_work *work, size_t j, size_t steps, double start,
                           double *q, double *mean, double *largest)
{
    static const double turn = 6.283185307179586;
    size_t n = s->n, cube = n * n * n;
    double *value = nh_alloc_array(n * n + cube, sizeof *value);
    bool good = true;
    *mean = 0;
    for (size_t i = 0; i < steps && good; i++) {
        double theta = 0;
        q[s->shape[j]] = turn * ((double)i + start) / (double)steps;
        nh_tape_eval(tape, work, q, value);
        good = isfinite(nh_largest(n * n + cube, value)) && nh_solve(n, value, n * n, value + n * n, NULL);
        for (size_t l = 0; l < n && good; l++) theta += value[n * n + (l + (l * n + j) * n)];
        *mean += theta / (double)steps;
        *largest = fmax(*largest, fabs(theta));
    }
    nh_free(value);
    return good;
}

/* The period of Theta along a turn of x^j through a place.  The means over equidistant steps converge exponentially
 * where Theta is regular on the way, wherever they start; where it has a pole, as where the orbits become tangent to D,
 * they depend on the start: then the turn is no curve in the region in which the stage is defined, and there is no
 * period.  Is there one that is not zero: above `small`, and far above the error of the mean? */
static bool has_period(const nh_slice *s, nh_tape *tape, nh_tape_work *work, size_t j, const double *place,
                       double small)
{
    enum { fewest = 24, most = 1536 };
    static const double far_above = 1e3;
    size_t m = s->kinetic->m;
    double *q = nh_alloc_array(m + 1, sizeof *q);
    bool regular = true, zero = false, other_than_zero = false;
    memcpy(q, place, m * sizeof *q);
    for (size_t steps = fewest; steps <= most && regular && !zero && !other_than_zero; steps *= 2) {
        double mean = 0, other = 0, largest = 0;
        regular = mean_over_turn(s, tape, work, j, steps, 0.37, q, &mean, &largest) &&
                  mean_over_turn(s, tape, work, j, steps, 0.11, q, &other, &largest);
        /* per radian: compared with 1, whatever the units of the other shape coordinates are */
        double error = fabs(mean - other), bound = small * (1 + largest);
        zero = regular && error <= bound && fabs(mean) <= bound;
        other_than_zero = regular && error <= bound && fabs(mean) > far_above * error && !zero;
    }
    nh_free(q);
    return other_than_zero;
}

/* K^-1 acts on the first index of U_kij: the columns are the pairs (i, j), as nh_solve wants them. */
static bool many_valued(const nh_slice *s, const nh_ex *K, const nh_ex *U, double small)
{
    enum { most_places = 6 };
    const nh_kinetic *k = s->kinetic;
    size_t n = s->n, cube = n * n * n, places = k->places < most_places ? k->places : most_places;
    /* U with the first index running fastest */
    nh_ex *e = nh_alloc_array(n * n + cube + 1, sizeof *e), *turned = e + n * n;
    bool many = false;
    memcpy(e, K, n * n * sizeof *e);
    for (size_t i = 0; i < n; i++)
        for (size_t pair = 0; pair < n * n; pair++) turned[i + pair * n] = U[i * n * n + pair];
    nh_tape *tape = nh_kinetic_tape(k, n * n + cube, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t j = 0; j < n; j++)
        for (size_t p = 0; p < places && k->periodic[s->shape[j]] && !many; p++)
            many = has_period(s, tape, work, j, k->place + p * k->m, small);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(e);
    return many;
}

/* The largest |d_i Theta_j - d_j Theta_i|. */
static double curl_of(const gyro *g)
{
    double most = 0;
    for (size_t l = 0; l < g->n; l++)
        for (size_t j = 0; j < l; j++) most = fmax(most, fabs(g->dTheta[l * g->n + j] - g->dTheta[j * g->n + l]));
    return most;
}

/* In units of the sizes that shape coordinates have: T^k_ij s_i s_j / s_k, Theta_j s_j, and s_l more for a derivative
   along x^l. */
static void in_units(gyro *g, const double *s)
{
    size_t n = g->n, cube = n * n * n;
    for (size_t i = 0; i < cube * (1 + n); i++) {
        double *T = i < cube ? g->T + i : g->dT + i - cube;
        size_t at = i % cube;
        *T *= s[at / n % n] * s[at % n] / s[at / n / n] * (i < cube ? 1 : s[i / cube - 1]);
    }
    for (size_t j = 0; j < n; j++) {
        g->Theta[j] *= s[j];
        for (size_t l = 0; l < n; l++) g->dTheta[l * n + j] *= s[l] * s[j];
    }
}

/* Where the parameters' values make the gyroscopic force vanish, its rounding errors cannot be compared with
 * anything. */
bool nh_chaplygin_flat(const nh_slice *s, const nh_ex *U)
{
    enum { largest_form = 4000 };
    for (size_t i = 0; i < s->n * s->n * s->n; i++)
        if (!nh_is_zero(s->dag, U[i]) &&
            nh_normal_is_zero(s->dag, nh_model_values(s->kinetic->model, U[i]), largest_form) != NH_ZERO)
            return false;
    return true;
}

nh_chaplygin_measure nh_chaplygin_measure_of(const nh_slice *s, const nh_ex *K, const nh_ex *U, const nh_slice *shown,
                                             const nh_ex *Ks, const nh_ex *Us, const nh_options *options)
{
    enum { most_places = 24 };
    nh_chaplygin_measure out = {.tested = s->n > 0};
    size_t n = s->n, cube = n * n * n, total, places = s->kinetic->places;
    if (!n) return out;
    if (places > most_places) places = most_places;
    nh_ex *e = list(s, K, U, &total);
    double *value = nh_alloc_array(places * total, sizeof *value),
           *work = nh_alloc_array(cube * (1 + n) + n + n * n, sizeof *work), tensor_size = 0, slope_size = 0, size = 0,
           curl = 0;
    double *all = nh_alloc_array(s->m + n + 1, sizeof *all), *unit = all + s->m;
    nh_kinetic_sizes(s->kinetic, places, all);
    for (size_t i = 0; i < n; i++) unit[i] = all[s->shape[i]];
    nh_kinetic_sample(s->kinetic, total, e, places, value);
    for (size_t p = 0; p < places; p++) {
        const double *v = value + p * total;
        gyro g = {.n = n,
                  .K = v,
                  .U = v + n * n,
                  .dK = v + n * n + cube,
                  .dU = v + n * n + cube + n * n * n,
                  .T = work,
                  .dT = work + cube};
        g.Theta = g.dT + n * cube;
        g.dTheta = g.Theta + n;
        if (!tensor(&g) || !isfinite(nh_largest(cube * n, g.dT))) continue;
        out.size = fmax(out.size, nh_largest(n, g.Theta));
        out.curl = fmax(out.curl, curl_of(&g));
        in_units(&g, unit);
        tensor_size = fmax(tensor_size, nh_largest(cube, g.T));
        slope_size = fmax(slope_size, nh_largest(cube * n, g.dT));
        size = fmax(size, nh_largest(n, g.Theta));
        curl = fmax(curl, curl_of(&g));
        if (n > 1) out.phi_simple = fmax(out.phi_simple, off_simple(&g));
    }
    double zero = options->group * (tensor_size + slope_size);
    exactly x;
    out.exact = decide(shown, Ks, Us, &x);
    if (!out.exact) x = (exactly){n, size <= zero, curl <= zero, out.phi_simple <= zero};
    if (x.flat) out.size = 0;
    if (x.closed && out.exact) out.curl = 0;
    out.measure = x.closed;
    out.local = out.measure && out.size > 0 && many_valued(s, K, U, options->group);
    out.simple = x.simple;
    out.factor = out.measure && out.simple;
    if (tensor_size > 0) out.phi_simple /= tensor_size;
    nh_free(e);
    nh_free(value);
    nh_free(work);
    nh_free(all);
    return out;
}
