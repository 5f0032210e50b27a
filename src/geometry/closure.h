/* closure: the rank of a distribution, and the ranks of its growth, modulo a prime.
 *
 * Fields span, with their brackets, brackets of brackets and so on, a distribution D of rank r, and annihilate N - r
 * independent functions (Frobenius).  The fields are power series in N symbols at a random point modulo a prime.  The
 * rank of those brackets at the point is a lower bound for r, for the given values of the parameters and for almost
 * all.  This proves that there are at most N - r such functions; and that they are functions of N - r known ones, where
 * so many independent ones are known. */
#ifndef NH_CLOSURE_H
#define NH_CLOSURE_H

#include "geometry/model.h"

enum { NH_MOST_GROWTH = 40 };

typedef struct {
    const char *obstacle;   /* the reason why there is no result, or NULL */
    size_t dimension, rank; /* N = 1 + m + n; lower bound of r */
    size_t known;           /* lower bound of the number of independent ones among the known functions */
} nh_closure;

/* `count` fields of 1 + m + n components each, on (t, q, w); `functions` that all of them annihilate: once N - r
 * independent ones are known, nothing more is computed. */
nh_closure nh_closure_of(const nh_model *model, size_t count, const nh_ex *field, size_t functions,
                         const nh_ex *function);

typedef struct {
    const char *obstacle;
    size_t length, rank[NH_MOST_GROWTH]; /* of D^1, D^2, ..: the last rank is not repeated, but for special places */
    bool cut;                            /* the ranks may grow further */
} nh_closure_growth;

/* The ranks of D^1 = D, D^(j+1) = D^j + [D, D^j] for `count` fields with components field[i*N + j] along symbol[j], at
 * random residues: lower bounds of the generic ranks, which almost every point reaches. */
nh_closure_growth nh_closure_growth_of(const nh_model *model, size_t count, size_t N, const nh_ex *symbol,
                                       const nh_ex *field);

/* The same where the symbols zero[0..zeros-1] vanish: the ranks of exactly `stages` terms. */
nh_closure_growth nh_closure_growth_at(const nh_model *model, size_t count, size_t N, const nh_ex *symbol,
                                       const nh_ex *field, size_t zeros, const nh_ex *zero, size_t stages);

#endif
