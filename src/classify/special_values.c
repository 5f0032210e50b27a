/* Special values modulo primes, and over the rationals: FLINT's polynomials. */
#include "classify/special_values.h"

#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>
#include <flint/fmpz_vec.h>
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "classify/special_values_internal.h"
#include "exact/fraction.h"

/* ---- modulo a prime ---- */

static void take(nmod_poly_t out, const nh_residue_polynomial *p)
{
    nmod_poly_zero(out);
    for (size_t j = 0; j <= p->degree; j++) nmod_poly_set_coeff_ui(out, (slong)j, p->coefficient[j]);
}

static nh_residue_polynomial written(const nmod_poly_t p)
{
    nh_residue_polynomial out = {.degree = (size_t)nmod_poly_degree(p)};
    out.coefficient = nh_alloc_array(out.degree + 1, sizeof *out.coefficient);
    for (size_t j = 0; j <= out.degree; j++) out.coefficient[j] = (nh_residue)nmod_poly_get_coeff_ui(p, (slong)j);
    return out;
}

/* p/gcd(p, p'), monic: degrees are below the prime. */
static void squarefree(nmod_poly_t p, ulong modulus)
{
    nmod_poly_t d;
    nmod_poly_init(d, modulus);
    nmod_poly_derivative(d, p);
    nmod_poly_gcd(d, p, d);
    nmod_poly_div(p, p, d);
    nmod_poly_make_monic(p, p);
    nmod_poly_clear(d);
}

nh_special_roots nh_special_common(nh_prime f, const nh_residue_polynomial chi[2], const nh_residue_polynomial Q[2])
{
    nmod_poly_t all[2], singular[2], part;
    nmod_poly_init(part, f.p);
    for (int k = 0; k < 2; k++) {
        nmod_poly_init(all[k], f.p);
        nmod_poly_init(singular[k], f.p);
        take(all[k], &chi[k]);
        take(singular[k], &Q[k]);
        nmod_poly_mul(all[k], all[k], singular[k]);
        squarefree(all[k], f.p);
        squarefree(singular[k], f.p);
    }
    nmod_poly_gcd(all[0], all[0], all[1]);
    nmod_poly_gcd(singular[0], singular[0], singular[1]);
    nmod_poly_gcd(part, all[0], singular[0]);
    nmod_poly_div(all[0], all[0], part);
    nh_special_roots out = {written(all[0]), written(singular[0])};
    for (int k = 0; k < 2; k++) {
        nmod_poly_clear(all[k]);
        nmod_poly_clear(singular[k]);
    }
    nmod_poly_clear(part);
    return out;
}

void nh_special_roots_clear(nh_special_roots *r)
{
    nh_free(r->excluded.coefficient);
    nh_free(r->degenerate.coefficient);
}

/* ---- over the integers ---- */

fmpz *nh_special_lift_numbers(size_t primes, const nh_prime *prime, size_t count, const nh_residue *const *residue)
{
    fmpq_t *q = nh_alloc_array(count, sizeof *q);
    nh_residue *r = nh_alloc_array(primes, sizeof *r);
    fmpz *out = _fmpz_vec_init((slong)count);
    fmpz_t common;
    bool good = true;
    fmpz_init_set_ui(common, 1);
    for (size_t k = 0; k < count; k++) fmpq_init(q[k]);
    for (size_t k = 0; k < count && good; k++) {
        for (size_t i = 0; i < primes; i++) r[i] = residue[i][k];
        good = nh_fraction_of(primes, prime, r, q[k]);
        fmpz_lcm(common, common, fmpq_denref(q[k]));
    }
    for (size_t k = 0; k < count && good; k++) {
        fmpz_divexact(out + k, common, fmpq_denref(q[k]));
        fmpz_mul(out + k, out + k, fmpq_numref(q[k]));
    }
    for (size_t k = 0; k < count; k++) fmpq_clear(q[k]);
    fmpz_clear(common);
    nh_free(r);
    nh_free(q);
    if (good) return out;
    _fmpz_vec_clear(out, (slong)count);
    return NULL;
}

/* False: a coefficient is too long for 64 bits. */
static bool take_factor(nh_special_factor *out, const fmpz_poly_struct *p)
{
    bool good = true;
    int sign = fmpz_sgn(fmpz_poly_lead(p));
    out->degree = (size_t)fmpz_poly_degree(p);
    out->coefficient = nh_alloc_array(out->degree + 1, sizeof *out->coefficient);
    for (size_t j = 0; j <= out->degree && good; j++) {
        const fmpz *c = fmpz_poly_get_coeff_ptr(p, (slong)j);
        good = fmpz_fits_si(c);
        if (good) out->coefficient[j] = sign * fmpz_get_si(c);
    }
    return good;
}

/* By degree, then by coefficients from the highest on. */
static int by_size(const void *a, const void *b)
{
    const nh_special_factor *x = a, *y = b;
    if (x->degree != y->degree) return x->degree < y->degree ? -1 : 1;
    for (size_t j = x->degree + 1; j-- > 0;)
        if (x->coefficient[j] != y->coefficient[j]) return x->coefficient[j] < y->coefficient[j] ? -1 : 1;
    return 0;
}

nh_special_factors nh_special_lift(size_t primes, const nh_prime *prime, const nh_residue_polynomial *residue)
{
    nh_special_factors out = {.norm = 1};
    fmpz_poly_t p;
    fmpz_poly_factor_t factors;
    fmpz_poly_init(p);
    fmpz_poly_factor_init(factors);
    size_t count = residue[0].degree + 1;
    const nh_residue **all = nh_alloc_array(primes, sizeof *all);
    for (size_t i = 0; i < primes; i++) all[i] = residue[i].coefficient;
    fmpz *lifted = primes > 1 ? nh_special_lift_numbers(primes, prime, count, all) : NULL;
    nh_free(all);
    if (lifted) {
        out.lifted = true;
        out.norm = 0;
        for (size_t j = 0; j < count; j++) fmpz_poly_set_coeff_fmpz(p, (slong)j, lifted + j);
        _fmpz_vec_clear(lifted, (slong)count);
        for (slong j = 0; j <= fmpz_poly_degree(p); j++) out.norm += fabs(fmpz_get_d(fmpz_poly_get_coeff_ptr(p, j)));
        if (fmpz_poly_degree(p) > 0) fmpz_poly_factor(factors, p);
        out.factor = nh_alloc_array((size_t)factors->num + 1, sizeof *out.factor);
        for (slong k = 0; k < factors->num; k++) out.lifted &= take_factor(&out.factor[out.factors++], factors->p + k);
        qsort(out.factor, out.factors, sizeof *out.factor, by_size);
    }
    fmpz_poly_factor_clear(factors);
    fmpz_poly_clear(p);
    return out;
}

bool nh_special_agrees(const nh_special_factors *of, nh_prime f, const nh_residue_polynomial *polynomial)
{
    nmod_poly_t all, part;
    nmod_poly_init(all, f.p);
    nmod_poly_init(part, f.p);
    nmod_poly_one(all);
    for (size_t k = 0; k < of->factors; k++) {
        nmod_poly_zero(part);
        for (size_t j = 0; j <= of->factor[k].degree; j++)
            nmod_poly_set_coeff_ui(part, (slong)j, nh_residue_of(f, of->factor[k].coefficient[j]));
        nmod_poly_mul(all, all, part);
    }
    take(part, polynomial);
    if (!nmod_poly_is_zero(all)) nmod_poly_make_monic(all, all);
    bool same = nmod_poly_equal(all, part);
    nmod_poly_clear(part);
    nmod_poly_clear(all);
    return same;
}

void nh_special_factors_clear(nh_special_factors *f)
{
    for (size_t k = 0; k < f->factors; k++) nh_free(f->factor[k].coefficient);
    nh_free(f->factor);
}

/* ---- roots ---- */

bool nh_residue_polynomial_root(const nh_residue_polynomial *of, nh_prime f, nh_residue *root)
{
    nmod_poly_t p;
    nmod_poly_factor_t parts;
    bool found = false;
    nmod_poly_init(p, f.p);
    nmod_poly_factor_init(parts);
    take(p, of);
    if (nmod_poly_degree(p) == (slong)of->degree && of->degree) nmod_poly_factor(parts, p);
    for (slong k = 0; k < parts->num; k++) {
        if (nmod_poly_degree(parts->p + k) != 1) continue;
        nh_residue top = (nh_residue)nmod_poly_get_coeff_ui(parts->p + k, 1),
                   bottom = (nh_residue)nmod_poly_get_coeff_ui(parts->p + k, 0);
        nh_residue x = nh_residue_negative(f, nh_residue_mul(f, bottom, nh_residue_inverse(f, top)));
        if (!found || x < *root) *root = x;
        found = true;
    }
    nmod_poly_factor_clear(parts);
    nmod_poly_clear(p);
    return found;
}

bool nh_special_root(const nh_special_factor *factor, nh_prime f, nh_residue *root)
{
    nh_residue_polynomial p = {.degree = factor->degree};
    p.coefficient = nh_alloc_array(p.degree + 1, sizeof *p.coefficient);
    for (size_t j = 0; j <= p.degree; j++) p.coefficient[j] = nh_residue_of(f, factor->coefficient[j]);
    bool found = nh_residue_polynomial_root(&p, f, root);
    nh_free(p.coefficient);
    return found;
}

static double value(size_t degree, const double *c, double x)
{
    double y = 0;
    for (size_t j = degree + 1; j-- > 0;) y = y * x + c[j];
    return y;
}

/* Between roots of the derivative a polynomial is monotone. */
size_t nh_special_roots_of(size_t degree, const double *c, double *out)
{
    while (degree && c[degree] == 0) degree--;
    if (degree == 0) return 0;
    double *slope = nh_alloc_array(degree, sizeof *slope), *turn = nh_alloc_array(degree + 2, sizeof *turn), bound = 0;
    for (size_t j = 1; j <= degree; j++) slope[j - 1] = (double)j * c[j];
    for (size_t j = 0; j < degree; j++) bound = fmax(bound, fabs(c[j] / c[degree]));
    size_t turns = nh_special_roots_of(degree - 1, slope, turn + 1), count = 0;
    turn[0] = -1 - bound; /* Cauchy's bound */
    turn[turns + 1] = 1 + bound;
    for (size_t k = 0; k <= turns; k++) {
        double low = turn[k], high = turn[k + 1], sign = value(degree, c, low);
        if (sign * value(degree, c, high) > 0) continue;
        for (int step = 0; step < 200; step++) {
            double middle = low + (high - low) / 2;
            if (sign * value(degree, c, middle) > 0) low = middle;
            else high = middle;
        }
        out[count++] = high;
    }
    nh_free(turn);
    nh_free(slope);
    return count;
}

size_t nh_special_reals(const nh_special_factor *factor, double *out)
{
    double *c = nh_alloc_array(factor->degree + 1, sizeof *c);
    for (size_t j = 0; j <= factor->degree; j++) c[j] = (double)factor->coefficient[j];
    size_t count = nh_special_roots_of(factor->degree, c, out);
    nh_free(c);
    return count;
}
