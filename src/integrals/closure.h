/* closure: how many independent functions do some fields on the constraint submanifold annihilate?
 *
 * The fields span, with their brackets, brackets of brackets and so on, a distribution D of rank r; the functions that
 * the fields annihilate number N - r (Frobenius).  The fields are power series in (t, q, w) at a point, modulo a prime.
 * The rank of those brackets at the point is a lower bound for r, for the given values of the parameters and for almost
 * all: that there are at most N - r such functions is proved, and so is that they are functions of N - r independent
 * ones that are known. */
#ifndef NH_CLOSURE_H
#define NH_CLOSURE_H

#include "geometry/model.h"

typedef struct {
    const char *obstacle;      /* why nothing is known, or NULL */
    size_t dimension, rank;    /* N = 1 + m + n; r, at least */
    size_t known;              /* how many of the functions that are known are independent, at least */
} nh_closure;

/* `count` fields of 1 + m + n components each; `functions` that all of them annihilate: with N - r independent ones
   nothing more is computed. */
nh_closure nh_closure_of(const nh_model *model, size_t count, const nh_ex *field, size_t functions,
                         const nh_ex *function);

#endif
