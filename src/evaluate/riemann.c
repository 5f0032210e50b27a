/* Riemann's equation (1 + z^2)^2 y'' = (a + b z + c z^2) y, singular at i, -i and infinity [DLMF 15.11].
 *
 * Its solutions are products of powers and 2F1 of (1 + i z)/2.  They are computed by Taylor series on a path from 0 to
 * z, because 2F1 is slow there, slowest where c = 3/4, and needs other formulas where exponents differ by whole
 * numbers. */
#include "evaluate/named_value.h"

#include <math.h>
#include <string.h>

enum { A, B, C };
enum { least_bits = 64, guard_bits = 30 };
/* radius of the disc over the distance from i and -i; step over that radius, on a path and at most */
static const double disc = 0.6, stride = 0.25, farthest = 0.75;
static const double nearly = 0.999, rounding = 1e-12;

static double distance_below(const acb_t z, int sign)
{
    acb_t apart;
    arf_t below;
    acb_init(apart);
    arf_init(below);
    acb_onei(apart);
    if (sign > 0) acb_add(apart, z, apart, least_bits);
    else acb_sub(apart, z, apart, least_bits);
    acb_get_abs_lbound_arf(below, apart, least_bits);
    double out = arf_get_d(below, ARF_RND_DOWN);
    acb_clear(apart);
    arf_clear(below);
    return out;
}

static void add_product(mag_t out, const acb_t x, const mag_t by)
{
    mag_t size;
    mag_init(size);
    acb_get_mag(size, x);
    mag_addmul(out, size, by);
    mag_clear(size);
}

/* A bound of |y| for |z - at| <= radius: |y''| <= M |y| there, so that |y| <= (|y(at)| + radius |y'(at)|) exp(sqrt(M)
 * radius).  Not inlined: GCC 14 would take y for its first part, and warn. */
__attribute__((noinline)) static void bound(mag_t out, acb_srcptr y, acb_srcptr p, const acb_t at, double radius,
                                            double left, double right)
{
    mag_t size, reach, growth, below;
    mag_init(size);
    mag_init(reach);
    mag_init(growth);
    mag_init(below);
    mag_set_d(size, radius);
    acb_get_mag(reach, at);
    mag_add(reach, reach, size); /* |z| */
    mag_set_d(growth, 0);
    add_product(growth, p + C, reach);
    mag_mul(growth, growth, reach);
    add_product(growth, p + B, reach);
    mag_one(below);
    add_product(growth, p + A, below);
    mag_set_d_lower(below, (left - radius) * (right - radius) * (1 - rounding));
    mag_div(growth, growth, below);
    mag_div(growth, growth, below);
    mag_sqrt(growth, growth);
    mag_mul(growth, growth, size);
    mag_exp(growth, growth);
    acb_get_mag(out, y);
    add_product(out, y + 1, size);
    mag_mul(out, out, growth);
    mag_clear(size);
    mag_clear(reach);
    mag_clear(growth);
    mag_clear(below);
}

/* The coefficients u_0 .. u_(n - 1) of y at `at`, u_0 and u_1 given, of ((1 + at^2) + 2 at h + h^2)^2 y'' = (a + b z +
 * c z^2) y. */
static void taylor(acb_ptr u, slong n, acb_srcptr p, const acb_t at, slong bits)
{
    enum { e0, e1, d0, d1, d2, d3, n0, n1, sum, all };
    acb_ptr w = _acb_vec_init(all);
    acb_mul(w + e0, at, at, bits);
    acb_mul(w + n0, p + C, w + e0, bits);
    acb_addmul(w + n0, p + B, at, bits);
    acb_add(w + n0, w + n0, p + A, bits);
    acb_add_ui(w + e0, w + e0, 1, bits);
    acb_mul_2exp_si(w + e1, at, 1);
    acb_mul(w + n1, p + C, w + e1, bits);
    acb_add(w + n1, w + n1, p + B, bits);
    acb_mul(w + d0, w + e0, w + e0, bits);
    acb_mul(w + d1, w + e0, w + e1, bits);
    acb_mul_2exp_si(w + d1, w + d1, 1);
    acb_mul(w + d2, w + e1, w + e1, bits);
    acb_addmul_si(w + d2, w + e0, 2, bits);
    acb_mul_2exp_si(w + d3, w + e1, 1);
    acb_inv(w + d0, w + d0, bits);
    for (slong k = 0; k + 2 < n; k++) {
        acb_mul(w + sum, w + n0, u + k, bits);
        if (k > 0) acb_addmul(w + sum, w + n1, u + k - 1, bits);
        if (k > 1) acb_addmul(w + sum, p + C, u + k - 2, bits);
        acb_mul(u + k + 2, w + d1, u + k + 1, bits);
        acb_submul_si(w + sum, u + k + 2, (k + 1) * k, bits);
        acb_mul(u + k + 2, w + d2, u + k, bits);
        acb_submul_si(w + sum, u + k + 2, k * (k - 1), bits);
        if (k > 2) {
            acb_mul(u + k + 2, w + d3, u + k - 1, bits);
            acb_submul_si(w + sum, u + k + 2, (k - 1) * (k - 2), bits);
            acb_submul_si(w + sum, u + k - 2, (k - 2) * (k - 3), bits);
        }
        acb_mul(w + sum, w + sum, w + d0, bits);
        acb_div_ui(u + k + 2, w + sum, (ulong)((k + 2) * (k + 1)), bits);
    }
    _acb_vec_clear(w, all);
}

/* Terms of a series on a step of which the ratio to the radius is at most q. */
static slong terms_of(double q, slong bits)
{
    return q > 0 ? 4 + (slong)((double)(bits + guard_bits) / fmax(-log2(q), 0.4)) : 4;
}

/* The n coefficients u of the solution with the values y at `at`, and bounds of what the terms beyond add to it and to
 * its derivative on steps of at most `ratio` times the radius: |u_k| <= tail/radius^k. */
static void expand(acb_ptr u, slong n, mag_ptr beyond, acb_srcptr y, acb_srcptr p, const acb_t at, const mag_t ratio,
                   slong bits)
{
    double left = distance_below(at, 1), right = distance_below(at, -1), radius = disc * fmin(left, right);
    mag_t power;
    mag_init(power);
    acb_set(u, y);
    acb_set(u + 1, y + 1);
    taylor(u, n, p, at, bits);
    bound(beyond, y, p, at, radius, left, right);
    mag_pow_ui(power, ratio, (ulong)n - 1);
    mag_mul(beyond, beyond, power);
    mag_mul_ui(beyond, beyond, 16 * (ulong)n); /* sum of k q^(k - 1), 1/(1 - q)^2 <= 16 */
    mag_set_d_lower(power, radius);
    mag_div(beyond + 1, beyond, power);
    mag_clear(power);
}

/* y and y' from `at` to `at` + h; not finite where h leaves the disc of convergence.  Not inlined: GCC 14 would take y
 * for its first part, and warn. */
__attribute__((noinline)) static void advance(acb_ptr y, acb_srcptr p, const acb_t at, const acb_t h, slong bits)
{
    mag_t size, ratio;
    mag_ptr beyond = _mag_vec_init(2);
    mag_init(size);
    mag_init(ratio);
    acb_get_mag(ratio, h);
    mag_set_d_lower(size, disc * fmin(distance_below(at, 1), distance_below(at, -1)));
    mag_div(ratio, ratio, size);
    double q = mag_get_d(ratio);
    if (!(q < farthest)) {
        acb_indeterminate(y);
        acb_indeterminate(y + 1);
    } else {
        slong n = terms_of(q, bits);
        acb_ptr u = _acb_vec_init(n);
        expand(u, n, beyond, y, p, at, ratio, bits);
        _acb_poly_evaluate2(y, y + 1, u, n, h, bits);
        acb_add_error_mag(y, beyond);
        acb_add_error_mag(y + 1, beyond + 1);
        _acb_vec_clear(u, n);
    }
    _mag_vec_clear(beyond, 2);
    mag_clear(size);
    mag_clear(ratio);
}

/* Of the solution with y(0) = 1, y'(0) = 0, or 0 and 1: y and y' at z = argument[3]. */
static void transport(acb_ptr y, bool second, acb_srcptr argument, slong bits)
{
    acb_t z, at, next, middle, step;
    double gone = 0, length;
    mag_t size;
    mag_init(size);
    acb_init(z);
    acb_init(at);
    acb_init(next);
    acb_init(middle);
    acb_init(step);
    acb_set(z, argument + 3);
    acb_set_ui(y, !second);
    acb_set_ui(y + 1, second);
    acb_get_mid(middle, z);
    acb_get_mag(size, middle);
    length = mag_get_d(size);
    for (bool done = !acb_is_finite(z); !done;) {
        double reach = nearly * stride * disc * fmin(distance_below(at, 1), distance_below(at, -1));
        done = !(gone + reach < length) || !(reach > 1e-6);
        gone += reach;
        if (done) acb_set(next, z);
        else acb_set_d(next, gone / length);
        if (!done) acb_mul(next, next, middle, bits);
        if (!done) acb_get_mid(next, next);
        acb_sub(step, next, at, bits);
        advance(y, argument, at, step, bits);
        acb_get_mid(at, next);
    }
    if (!acb_is_finite(z)) _acb_vec_indeterminate(y, 2);
    mag_clear(size);
    acb_clear(z);
    acb_clear(at);
    acb_clear(next);
    acb_clear(middle);
    acb_clear(step);
}

void nh_riemann(acb_t out, bool second, bool prime, acb_srcptr argument, slong bits)
{
    acb_ptr y = _acb_vec_init(2);
    transport(y, second, argument, bits);
    acb_set(out, y + prime);
    _acb_vec_clear(y, 2);
}

/* ---- at many real places ----
 *
 * Motions ask for values at thousands of places with the same a, b and c.  All of them are on one path from 0, which is
 * kept with its series: a value is then one sum.  A kept series is the one that would be computed again, so that a
 * value is the same whatever was asked before.  Each thread has its own paths and takes no lock. */

enum { most_centres = 256, most_paths = 8 };

typedef struct {
    double at, end; /* exact */
    arb_ptr u;      /* of the series */
    mag_ptr beyond; /* what its end adds to y and y' */
} centre;

typedef struct {
    double p[3];
    bool second;
    slong bits, terms;
    size_t centres;
    centre centre[most_centres];
} path;

static _Thread_local path *kept[most_paths];
static _Thread_local size_t oldest;
static _Thread_local bool known_to_flint;

static void path_free(path *x)
{
    if (!x) return;
    for (size_t k = 0; k < x->centres; k++) {
        _arb_vec_clear(x->centre[k].u, x->terms);
        _mag_vec_clear(x->centre[k].beyond, 2);
    }
    flint_free(x);
}

/* FLINT calls it when a thread ends its work with FLINT. */
static void forget(void)
{
    for (size_t i = 0; i < most_paths; i++) {
        path_free(kept[i]);
        kept[i] = NULL;
    }
    known_to_flint = false;
}

static path *path_of(bool second, const double *p, slong bits)
{
    for (size_t i = 0; i < most_paths; i++)
        if (kept[i] && kept[i]->second == second && kept[i]->bits == bits && !memcmp(kept[i]->p, p, sizeof kept[i]->p))
            return kept[i];
    if (!known_to_flint) flint_register_cleanup_function(forget);
    known_to_flint = true;
    path *x = flint_calloc(1, sizeof *x);
    x->second = second;
    x->bits = bits;
    x->terms = terms_of(stride, bits);
    memcpy(x->p, p, sizeof x->p);
    path_free(kept[oldest]);
    kept[oldest] = x;
    oldest = (oldest + 1) % most_paths;
    return x;
}

/* y and y' at z, which the disc around this centre covers. */
static void evaluate(const path *x, const centre *c, double z, arb_ptr y)
{
    arb_t h, start;
    arb_init(h);
    arb_init(start);
    arb_set_d(h, z);
    arb_set_d(start, c->at);
    arb_sub(h, h, start, x->bits);
    _arb_poly_evaluate2(y, y + 1, c->u, x->terms, h, x->bits);
    arb_add_error_mag(y, c->beyond);
    arb_add_error_mag(y + 1, c->beyond + 1);
    arb_clear(h);
    arb_clear(start);
}

static void add_centre(path *x)
{
    const centre *last = x->centres ? &x->centre[x->centres - 1] : NULL;
    centre *c = &x->centre[x->centres];
    acb_ptr p = _acb_vec_init(3), y = _acb_vec_init(2), u = _acb_vec_init(x->terms);
    arb_ptr start = _arb_vec_init(2);
    acb_t at;
    mag_t ratio;
    acb_init(at);
    mag_init(ratio);
    for (slong i = 0; i < 3; i++) acb_set_d(p + i, x->p[i]);
    *c = (centre){.at = last ? last->end : 0, .u = _arb_vec_init(x->terms), .beyond = _mag_vec_init(2)};
    acb_set_d(at, c->at);
    if (last) evaluate(x, last, c->at, start);
    else arb_one(start + x->second);
    for (slong i = 0; i < 2; i++) acb_set_arb(y + i, start + i);
    mag_set_d(ratio, stride);
    expand(u, x->terms, c->beyond, y, p, at, ratio, x->bits);
    for (slong i = 0; i < x->terms; i++) acb_get_real(c->u + i, u + i);
    c->end = c->at + nearly * stride * disc * fmin(distance_below(at, 1), distance_below(at, -1));
    x->centres++;
    acb_clear(at);
    mag_clear(ratio);
    _arb_vec_clear(start, 2);
    _acb_vec_clear(u, x->terms);
    _acb_vec_clear(y, 2);
    _acb_vec_clear(p, 3);
}

/* The centre whose disc covers z >= 0; NULL: it is too far. */
static const centre *centre_of(path *x, double z)
{
    while (x->centres < most_centres && (!x->centres || x->centre[x->centres - 1].end < z)) add_centre(x);
    size_t low = 0, high = x->centres - 1;
    if (x->centre[high].end < z) return NULL;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (x->centre[middle].end < z) low = middle + 1;
        else high = middle;
    }
    return &x->centre[low];
}

/* Where z < 0: y(-z) solves the equation with -b. */
void nh_riemann_at(arb_t out, bool second, bool prime, const double *place, slong bits)
{
    bool finite = true, left = place[3] < 0;
    for (size_t i = 0; i < 4; i++) finite &= isfinite(place[i]);
    double p[3] = {place[A], left ? -place[B] : place[B], place[C]}, z = fabs(place[3]);
    path *x = finite ? path_of(second, p, bits) : NULL;
    const centre *c = x ? centre_of(x, z) : NULL;
    if (c) {
        arb_ptr y = _arb_vec_init(2);
        evaluate(x, c, z, y);
        if (left && second != prime) arb_neg(out, y + prime);
        else arb_set(out, y + prime);
        _arb_vec_clear(y, 2);
        return;
    }
    acb_t all;
    acb_ptr argument = _acb_vec_init(4);
    acb_init(all);
    for (slong i = 0; i < 4; i++) acb_set_d(argument + i, place[i]);
    nh_riemann(all, second, prime, argument, bits);
    acb_get_real(out, all);
    acb_clear(all);
    _acb_vec_clear(argument, 4);
}
