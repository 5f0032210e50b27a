/* saddle: the solution of symmetric linear equations with a border,
 *
 *     [ K  F^T ] [ a  ]       [ h ]
 *     [ F   0  ] [ mu ]  =  - [ g ]        K: m x m, F: k x m, both column-major
 *
 * such as accelerations and multipliers come from.  Rows and columns are scaled first: K_ij/(K_ii K_jj)^(1/2), whose
 * condition number no other scaling makes smaller by more than the factor m when K is positive [VanDerSluis1969], and
 * rows of F of size one.  So a light body beside a heavy one, or another unit of length, does not make the matrix look
 * singular.  The factors are powers of two: scaling rounds nothing.  Rows of F that depend on each other and agree are
 * harmless, unless one is zero: then a is the same, and mu the shortest (in this scaling). */
#ifndef NH_SADDLE_H
#define NH_SADDLE_H

#include <stdbool.h>
#include <stddef.h>

/* Length of the work memory, in doubles. */
size_t nh_saddle_work(size_t m, size_t k);

/* a (m) and mu (k; may be NULL); *rcond gets the reciprocal condition number of the scaled matrix (may be NULL).  False
   when singular or not finite. */
bool nh_saddle_solve(size_t m, size_t k, const double *K, const double *F, const double *h, const double *g, double *a,
                     double *mu, double *rcond, double *work);
/* The same for two right-hand sides: h is m x 2, g k x 2, a m x 2. */
bool nh_saddle_solve_two(size_t m, size_t k, const double *K, const double *F, const double *h, const double *g,
                         double *a, double *work);

#endif
