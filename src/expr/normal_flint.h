/* normal_flint: what normal_quotient.c and normal_factor.c share; the only place that includes FLINT. */
#ifndef NH_NORMAL_FLINT_H
#define NH_NORMAL_FLINT_H

#include <flint/flint.h>
#include <flint/fmpz.h>
#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_mpoly_factor.h>

#include "expr/normal_quotient.h"

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
    bool pair, hyperbolic;
    slong sine, cosine;
} nh_relation;

struct nh_field {
    fmpz_mpoly_ctx_t ctx;
    slong generators;
    nh_relation *relation;
    size_t relations, capacity;
    nh_quotient *all;
    ulong *exponent; /* scratch, one per generator */
    double max_terms, work, max_work;
    nh_field_state state;
};

#endif
