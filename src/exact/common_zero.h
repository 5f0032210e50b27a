/* common_zero: a common zero of polynomials, of which a double is known, in closed form.
 *
 *     P_1(x, p) = P_2(x, p) = .. = 0,    x: a few unknowns,   p: everything else
 *
 * Irreducible factors that do not vanish at the point are left out; the other unknowns, and roots of p that the field
 * knows, are eliminated by resultants; the irreducible polynomial G(x_k, p) that remains is solved where it is of
 * degree one or two in x_k or in x_k^2.  The result is a proposal: factors are chosen by their values at one point. */
#ifndef NH_COMMON_ZERO_H
#define NH_COMMON_ZERO_H

#include "exact/normal_quotient.h"

typedef struct {
    nh_quotient_field *field;
    const double *value; /* values of every generator at the point */
    size_t unknowns;
    const size_t *unknown; /* generators that are unknowns */
} nh_zero_point;

enum { NH_MOST_ROOTS = 12 };

/* x = (rational + factor sqrt(radicand))^(1/outer), radicand = prod_i root_i; with `rational` zero, x^outer = factor
 * prod_i root_i^(power_i/2). */
typedef struct {
    const nh_quotient *rational, *factor;
    size_t roots;
    const nh_quotient *root[NH_MOST_ROOTS]; /* positive at the point */
    int power[NH_MOST_ROOTS];               /* 1 or -1 */
    unsigned outer;                         /* 1 or 2 */
} nh_zero_root;

/* Finds the unknown number k of the point, which satisfies all equations (quotients without denominators).  False: it
 * has no such form, or the form is too large. */
bool nh_common_zero(const nh_zero_point *point, size_t equations, const nh_quotient *const *equation, size_t k,
                    nh_zero_root *out);

#endif
