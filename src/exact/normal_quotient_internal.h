/* normal_quotient_internal: what normal_field.c (polynomials within limits, modulo relations), normal_gcd.c,
 * normal_quotient.c (arithmetic) and normal_factor.c share; the only place that includes FLINT's polynomials in
 * several generators. */
#ifndef NH_NORMAL_QUOTIENT_INTERNAL_H
#define NH_NORMAL_QUOTIENT_INTERNAL_H

#include <flint/flint.h>
#include <flint/fmpz.h>
#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_mpoly_factor.h>

#include "exact/normal_quotient.h"

struct nh_quotient {
    fmpz_mpoly_t num, den;
    nh_quotient *next; /* all quotients of the field */
};

/* generator^order = num / den */
typedef struct {
    slong generator;
    ulong order;
    fmpz_mpoly_t num, den;
    bool integral; /* den = 1 */
    bool mixed;    /* num or den has lower powers of the generator */
    bool pair, hyperbolic;
    slong sine, cosine;
} nh_relation;

struct nh_quotient_field {
    fmpz_mpoly_ctx_t ctx;
    slong generators; /* FLINT needs one at least */
    size_t declared;  /* the generators that there are */
    nh_relation *relation;
    size_t relations, capacity;
    nh_quotient *all;
    ulong *exponent; /* scratch, one per generator */
    double max_terms, work, max_work;
    bool repeat; /* the relations a second time, after the last: values may need later ones */
    nh_quotient_field_state state;
};

/* A new quotient 0/1. */
nh_quotient *nh_quotient_fresh(nh_quotient_field *field);
/* Reduces by the relations, and cancels. */
const nh_quotient *nh_quotient_normalise(nh_quotient_field *field, nh_quotient *q);
/* Cancels the gcd where that is cheap, and makes the denominator positive; enough where the relations change
 * nothing. */
void nh_quotient_cancel(nh_quotient_field *field, nh_quotient *q);

/* Counts work before it is done, or the size of a polynomial; when it is too much the field is marked as broken. */
bool nh_quotient_field_spend(nh_quotient_field *field, double work);
void nh_quotient_field_check_size(nh_quotient_field *field, const fmpz_mpoly_t a);
/* out = a b, unless that is too much. */
void nh_quotient_field_times(nh_quotient_field *field, fmpz_mpoly_t out, const fmpz_mpoly_t a, const fmpz_mpoly_t b);
bool nh_quotient_field_cheap_gcd(const nh_quotient_field *field, const fmpz_mpoly_t a, const fmpz_mpoly_t b);
/* The greatest common divisor, with a positive leading coefficient; false: FLINT does not find it. */
bool nh_quotient_field_gcd(const nh_quotient_field *field, fmpz_mpoly_t gcd, const fmpz_mpoly_t a,
                           const fmpz_mpoly_t b);

#endif
