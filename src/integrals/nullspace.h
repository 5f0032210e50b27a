/* nullspace: the combinations of the ansatz that satisfy every sampled equation.
 *
 *     minimise |A c| / |B c|,   A: rows of (N0), (NY) or Gamma(Phi);   B: samples of Phi - mean(Phi)
 *
 * A plain SVD of A would call every near-dependence of the basis a symmetry; the quotient asks how little Gamma(Phi) is
 * compared with how much Phi varies.  Both matrices are streamed: only their triangles are kept.  Columns of B that
 * depend on the others over the samples are dropped by Gram-Schmidt (after equilibration); the generalized
 * singular values are those of A R^-1 with B P = Q R.  The rank is read at the widest gap above rounding; a shallow gap
 * is NH_UNDECIDED, never a quiet "none".
 *
 *     paper                    here
 *     generalized sigma_j      spectrum[j], ascending
 *     ker                      vector, columns x dimension
 *
 * Reference: [GolubVanLoan2013, sec. 6.1.6 and 8.7.4]. */
#ifndef NH_NULLSPACE_H
#define NH_NULLSPACE_H

#include <stdbool.h>
#include <stddef.h>

#include "integrals/basis.h"

/* Fitted: of analyses whose currents cannot be proved, because tables have no formula. */
typedef enum { NH_FOUND, NH_NONE, NH_UNDECIDED, NH_FITTED } nh_verdict;

/* Collects rows.  With more than one thread the triangles of A and B are computed beside the caller; the result does
 * not depend on it. */
typedef struct nh_equations nh_equations;
/* For rows of so many columns.  The caller frees it. */
nh_equations *nh_equations_create(size_t columns, size_t threads);
void nh_equations_free(nh_equations *equations);
void nh_equations_reset(nh_equations *equations); /* Forgets all rows. */
/* From now on a column that is not finite at some point is dropped, as dependent ones are, instead of being an error:
 * for an ansatz of the program (which may contain the root of a function of both signs). */
void nh_equations_leave_out(nh_equations *equations);
/* Rows of A: residuals of the equations per column (column-major, overwritten). */
void nh_equations_add(nh_equations *equations, size_t rows, double *a, size_t ld);
/* Rows of B: the currents' values per column at sample points (column-major, overwritten); the mean is removed here (by
 * a leading column of ones in the QR, so that no second pass is needed). */
void nh_equations_add_values(nh_equations *equations, size_t rows, double *b, size_t ld);

typedef struct {
    nh_verdict verdict;
    size_t columns, rows; /* of A as given */
    size_t rank;          /* independent, non-constant columns kept; length of the spectrum */
    double *spectrum;     /* generalized singular values, ascending, `rank` of them */
    size_t dimension;     /* of the null space */
    /* >= dimension: number of values before the widest gap; nearly dependent columns lift true null values above
     * rounding, so that these vectors deserve a certificate, and mean nothing without one */
    size_t likely;
    /* spectrum[dimension] / max(spectrum[dimension-1], eps); INFINITY when nothing is above or below */
    double gap;
    double *vector; /* columns x likely, in the columns' own units, |B c| = 1; dropped columns have 0 */
    bool *dropped;  /* per column */
    /* pivots of B relative to the first; closer than 1e3: the rank is in doubt */
    double smallest_kept, largest_dropped;
    bool rank_in_doubt;
    double next_left_scale; /* largest generalized singular value */
} nh_nullspace;

/* Minimises |A c| / |B c| over the rows collected so far.  The caller frees the result.  NULL with an error where
 * no row was given, a value is not finite, or a decomposition fails.  [docs/method.md, eq. 13] */
nh_nullspace *nh_nullspace_solve(nh_equations *equations, const nh_nullspace_options *options, nh_error *error);
/* The same without the quotient: a plain SVD of A with columns of norm one, for comparisons.  It takes a combination
 * that vanishes, or nearly does, for a current. */
nh_nullspace *nh_nullspace_plain(nh_equations *equations, const nh_nullspace_options *options, nh_error *error);
void nh_nullspace_free(nh_nullspace *nullspace);

#endif
