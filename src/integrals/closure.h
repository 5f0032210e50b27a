/* closure: how many independent functions do given fields on the constraint submanifold annihilate?
 *
 * The fields span, with their brackets, brackets of brackets and so on, a distribution D of rank r; the fields
 * annihilate N - r independent functions (Frobenius).  The fields are power series in (t, q, w) at a point, modulo a
 * prime.  The rank of those brackets at the point is a lower bound for r, for the given values of the parameters and
 * for almost all.  This proves that there are at most N - r such functions; and that they are functions of N - r known
 * ones, where so many independent ones are known. */
#ifndef NH_CLOSURE_H
#define NH_CLOSURE_H

#include "geometry/model.h"

typedef struct {
    const char *obstacle;      /* the reason why there is no result, or NULL */
    size_t dimension, rank;    /* N = 1 + m + n; lower bound of r */
    size_t known;              /* lower bound of the number of independent ones among the known functions */
} nh_closure;

/* `count` fields of 1 + m + n components each; `functions` that all of them annihilate: once N - r independent ones are
 * known, nothing more is computed. */
nh_closure nh_closure_of(const nh_model *model, size_t count, const nh_ex *field, size_t functions,
                         const nh_ex *function);

#endif
