/* unknowns: frequencies and other nonlinear parameters of the ansatz.
 *
 * Two ways that must agree [docs/method.md, sec. 4]:
 *   pencil   for a product {b_j} x {cos nu q, sin nu q} the eigenvalue problem Gamma(f) = i nu Gamma(q) f on span{b_j};
 *   search   minimise the smallest generalized singular value that is not null for every theta (variable projection):
 *            NLopt's MLSL over a low-discrepancy sequence, then every distinct basin to round-off. */
#ifndef NH_UNKNOWNS_H
#define NH_UNKNOWNS_H

#include "integrals/echelon.h"

typedef struct {
    nh_ex symbol;
    double low, high;
} nh_unknown;

typedef struct {
    double *value;    /* one per unknown */
    double quotient;  /* generalized singular value at the hit */
    size_t dimension; /* dimension of the null space at the hit */
    bool by_pencil, by_search;
    double difference; /* |pencil - search| / |value| when both found it */
} nh_hit;

typedef struct {
    nh_arena *arena;
    size_t unknowns, count;
    nh_hit *hit;      /* ascending in the first unknown */
    size_t generic;   /* null dimension for generic theta */
    long evaluations; /* number of evaluations of the search's objective */
    double best;      /* the smallest value of the objective */
    /* the box cut into so many equal parts along each unknown, and how many of the parts hold an evaluation */
    size_t parts, visited;
    bool pencil_applied; /* the ansatz has the form that the pencil needs */
} nh_hits;

/* All hits in the intervals of the unknowns.  The caller frees the result.  NULL with an error. */
nh_hits *nh_unknowns_find(const nh_model *model, const nh_points *points, size_t families, const nh_family *family,
                          size_t unknowns, const nh_unknown *unknown, const nh_options *options, nh_error *error);
void nh_hits_free(nh_hits *hits);

/* Only the pencil, for one unknown: candidates in [low, high], ascending; returns their number (at most `most`). */
size_t nh_unknowns_pencil(const nh_model *model, const nh_points *points, size_t families, const nh_family *family,
                          const nh_unknown *unknown, const nh_options *options, size_t most, double *value,
                          bool *applied);

/* The objective of the search over one unknown: sigma[i] is the generalized singular value number `index`
 * (hits->generic: the first that is not null for every value) at theta[i], infinite where the problem has no answer. */
bool nh_unknowns_scan(const nh_model *model, const nh_points *points, size_t families, const nh_family *family,
                      const nh_unknown *unknown, const nh_options *options, size_t index, size_t count,
                      const double *theta, double *sigma, nh_error *error);

/* Does a family contain the unknown? */
bool nh_family_contains(const nh_model *model, const nh_family *family, nh_ex unknown);

/* A copy of a family with the unknowns replaced by expressions, in the arena. */
nh_family nh_family_substitute(nh_arena *arena, nh_dag *dag, const nh_family *family, size_t n, const nh_ex *from,
                               const nh_ex *to);

#endif
