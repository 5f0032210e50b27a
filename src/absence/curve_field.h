/* curve_field: functions on the curve of a particular motion.
 *
 *     K = Q(x)[w],   w^2 = num(x)/den(x)         a field, unless num/den is a square
 *     (even + odd w)/den                          its elements
 *
 * x: the moving coordinate, or t = tan(x/2) of an angle; w: the velocity that moves it. */
#ifndef NH_CURVE_FIELD_H
#define NH_CURVE_FIELD_H

#include <stdbool.h>

#include <flint/fmpq.h>
#include <flint/fmpz_poly.h>

#include "base/memory.h"

typedef struct {
    fmpz_poly_t num, den; /* of w^2 */
} nh_curve_field;

/* Polynomials of Z[x] without a common factor; den has a positive leading coefficient. */
typedef struct {
    fmpz_poly_t even, odd, den;
} nh_curve_element;

/* w^2 = x; the caller clears it. */
void nh_curve_field_init(nh_curve_field *field);
void nh_curve_field_clear(nh_curve_field *field);

/* 0; the caller clears it.  Results may be arguments as well. */
void nh_curve_field_element_init(nh_curve_element *e);
void nh_curve_field_element_clear(nh_curve_element *e);
/* `count` of them; the caller frees them by nh_curve_field_elements_free. */
nh_curve_element *nh_curve_field_elements(size_t count);
void nh_curve_field_elements_free(nh_curve_element *e, size_t count);

void nh_curve_field_set(nh_curve_element *out, const nh_curve_element *a);
void nh_curve_field_set_fmpq(nh_curve_element *out, const fmpq_t a);
void nh_curve_field_set_si(nh_curve_element *out, slong a);
void nh_curve_field_set_x(nh_curve_element *out);
void nh_curve_field_set_w(nh_curve_element *out);
bool nh_curve_field_is_zero(const nh_curve_element *a);
bool nh_curve_field_equal(const nh_curve_element *a, const nh_curve_element *b);
bool nh_curve_field_is_even(const nh_curve_element *a); /* in Q(x)? */
bool nh_curve_field_is_odd(const nh_curve_element *a);  /* in Q(x) w? */

void nh_curve_field_add(nh_curve_element *out, const nh_curve_element *a, const nh_curve_element *b);
void nh_curve_field_scale(nh_curve_element *out, const nh_curve_element *a, const fmpq_t c);
/* out -= a b */
void nh_curve_field_submul(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a,
                           const nh_curve_element *b);
void nh_curve_field_mul(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a,
                        const nh_curve_element *b);
/* False for 0. */
bool nh_curve_field_inv(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a);
/* n may be negative; false for a power of 0 that is no number. */
bool nh_curve_field_pow(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a, slong n);
/* Where square roots are positive: for large real x, for large -x, near 0. */
typedef enum { NH_CURVE_FAR, NH_CURVE_FAR_BELOW, NH_CURVE_NEAR } nh_curve_side;
/* The root in Q(x) that is positive there; false: there is none in Q(x), or it has no sign there. */
bool nh_curve_field_sqrt(nh_curve_element *out, const nh_curve_element *a, nh_curve_side side);
/* da/dx */
void nh_curve_field_derivative(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a);

#endif
