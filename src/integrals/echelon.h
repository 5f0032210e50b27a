/* echelon: a null space in its simplest representatives.
 *
 * The terms are ordered by complexity; the reduced echelon form with the most complex pivots first gives each vector
 * the simplest tail.  Entries are compared in the size of c_j b_j, not of c_j.  Small entries are then tried as zeros:
 * the coefficients are fitted again on the support alone, which also makes them exact to rounding. */
#ifndef NH_ECHELON_H
#define NH_ECHELON_H

#include "base/option.h"
#include "integrals/rows.h"

typedef struct {
    size_t count; /* terms with a coefficient, simplest first */
    nh_ex *term;
    double *coefficient; /* the pivot's is 1 */
    size_t pivot;        /* the most complex term */
    double quotient;     /* |A c| / |B c| of the final coefficients */
    bool refitted;       /* the support alone has a one-dimensional null space */
    double accepted;     /* quotient of the null space itself: a smaller support must reach it, too */
    /* where the relation needs values of several parameters, no relations among these are sought: a current for all
     * values may replace it */
    bool by_values;
    bool only_new; /* with its final coefficients, too, it must not be a function of the known currents */
    size_t all;    /* every term of the echelon vector, before small ones were dropped */
    nh_ex *all_term;
    double *all_coefficient, *all_size; /* size: |c_j b_j| relative to the largest */
} nh_candidate;

typedef struct {
    nh_arena *arena;
    size_t count;
    nh_candidate *candidate; /* simplest first */
} nh_candidates;

nh_nullspace_options nh_nullspace_options_from(const nh_options *options);

/* Echelon form of the first `count` vectors (nullspace->dimension, or ->likely): coefficients to about seven digits. */
nh_candidates *nh_echelon(const nh_model *model, const nh_points *points, const nh_ansatz *ansatz,
                          const nh_nullspace *nullspace, size_t count, const nh_options *options);
/* The same with these terms as pivots, as far as some vector contains them. */
nh_candidates *nh_echelon_with_pivots(const nh_model *model, const nh_points *points, const nh_ansatz *ansatz,
                                      const nh_nullspace *nullspace, size_t count, size_t pivots, const nh_ex *pivot,
                                      const nh_options *options);
/* The smallest support of a candidate that satisfies the equations as well as the null space did, fitted again. */
void nh_echelon_refine(const nh_model *model, const nh_points *points, nh_candidate *candidate,
                       const nh_options *options);

void nh_candidates_free(nh_candidates *candidates);

#endif
