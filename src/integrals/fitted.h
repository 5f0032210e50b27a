/* fitted: what holds of a system whose equations contain tables (graph/declared.h).
 *
 * A table has no formula: balls and power series do not know it, and no proof is tried.  A current of such a system is
 * what a fit says it is: its residual at points that the fit has not seen, and, where it is a sum of several terms,
 * the digits of its coefficients from a second fit at twice as many points.
 *
 * Noise moves a null vector of the quotient |A c| / |B c|.  With m rows, n columns, smallest quotient s and the next
 * one s', noise E of independent entries has |E c|/|B c| near s sqrt(m/(m - n)) in every direction, and its norm is at
 * most about (1 + sqrt(n/m)) times that; so the error of c, in the norm |B c|, is at most [Wedin1972]
 *
 *     safety s (1 + sqrt(n/m)) / sqrt(1 - n/m) / (s' - s). */
#ifndef NH_FITTED_H
#define NH_FITTED_H

#include "integrals/echelon.h"

/* Do the equations of motion contain a table? */
bool nh_fitted_is(const nh_model *model);
/* Raises the bounds on residuals of such a system to the estimated error of its tables, at most to 1e-4, and lowers the
 * gap that is asked for. */
void nh_fitted_options(const nh_model *model, nh_options *options);

/* Digits to which the null vector number 0 of the spectrum is determined, by the bound above; rounded down. */
double nh_fitted_digits(const nh_nullspace *nullspace);
/* Fits the candidate's coefficients again at points that it has not seen, and returns the digits to which they are
 * determined: by the bound, and by how far both fits differ, relative to the largest term.  INFINITY for one term; 0
 * where nothing is determined. */
double nh_fitted_again(const nh_model *model, const nh_points *points, const nh_candidate *candidate,
                       const nh_options *options);

#endif
