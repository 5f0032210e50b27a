/* runge: y' = f(t, y) by an explicit Runge-Kutta method of order 8, for equations that are not stiff and too large, or
   too many, for CVODE. */
#ifndef NH_RUNGE_H
#define NH_RUNGE_H

#include <stdbool.h>
#include <stddef.h>

typedef bool nh_runge_rate(double t, const double *y, double *rate, void *context);

/* From t0 to t1 with absolute and relative tolerance; y is overwritten.  False when the rate fails, y grows beyond
 * `largest`, or no steps are left: *steps is counted down (NULL: 20000). */
bool nh_runge(size_t n, nh_runge_rate *rate, void *context, double t0, double t1, double tolerance, double largest,
              size_t *steps, double *y);

/* The same where states have units: errors relative to the size that each has at the start, or moves by; 1 where both
   are zero. */
bool nh_runge_sized(size_t n, nh_runge_rate *rate, void *context, double t0, double t1, double tolerance,
                    double largest, double *y);

#endif
