/* linear: momenta that obey a linear differential equation in the only shape coordinate [Bloch1996, sec. 4.3].
 *
 * With one shape coordinate x and w = (x', nu), let p_a be the momenta of the group among those of the reduced
 * equations.  Where
 *
 *     p_a' = x' N_a^b(x) p_b          (no terms in nu nu and none in x' x')
 *
 * the currents Y(x)^-1 p with dY/dx = N Y, Y(x_0) = 1, are conserved and linear in the velocities, as many as there are
 * momenta; Y need not be elementary (Euler's disk). */
#ifndef NH_LINEAR_H
#define NH_LINEAR_H

#include "base/option.h"
#include "reduction/reduced.h"

typedef struct {
    size_t count;  /* 0: there is no such equation */
    size_t *index; /* count: which of the momenta p of the reduced equations */
    nh_ex *N;      /* count x count, row-major, functions of x */
    double off;    /* largest of the terms that must vanish, relative */
} nh_linear_momenta;

/* Memory: the kinetic's arena. */
void nh_linear_momenta_find(nh_linear_momenta *out, const nh_reduced *reduced, const nh_options *options);

/* The largest change of Y(x)^-1 p along `count` states z (size n + r each), relative to the size of p.  Negative when Y
   cannot be followed. */
double nh_linear_momenta_drift(const nh_linear_momenta *momenta, const nh_reduced *reduced, size_t count,
                               const double *z);

#endif
