/* spline: smooth functions through the values of a table, in one variable or two.
 *
 * One variable: cubic splines with vanishing second derivatives at the ends, or Akima's [Akima1970], whose slopes
 * depend on five neighbours.  Two: bicubic.  GSL computes the slopes at the nodes; between nodes the function is
 *
 *     sum over the corners of  f h(u) h(v) + f_x k(u) h(v) dx + f_y h(u) k(v) dy + f_xy k(u) k(v) dx dy
 *
 * with Hermite's polynomials h = 1 - 3 u^2 + 2 u^3, k = u (1 - u)^2 and their mirror images, u in [0, 1] across the
 * cell. It has no value outside of the table. */
#ifndef NH_SPLINE_H
#define NH_SPLINE_H

#include <stdbool.h>

#include "base/memory.h"

enum { NH_SPLINE_ORDERS = 4 }; /* derivatives of this order and higher vanish */
enum { NH_SPLINE_LEAST = 5 };  /* nodes in each variable */

typedef struct {
    size_t nx, ny;               /* ny = 1: one variable */
    const double *x, *y;         /* nodes, ascending; y: NULL in one variable */
    const double *f;             /* nx x ny values, row by row: f[i * ny + j] at (x[i], y[j]) */
    const double *fx, *fy, *fxy; /* likewise; fy and fxy: NULL in one variable */
    /* root mean square difference of the slopes from those of the table without every second node, relative to the
     * slopes: an upper estimate of their error, for smooth functions about eight times the error, with noise the noise
     */
    double error;
} nh_spline;

/* A copy of the data in the arena.  y NULL, ny 1: one variable. */
nh_spline *nh_spline_create(nh_arena *arena, bool akima, size_t nx, const double *x, size_t ny, const double *y,
                            const double *f);
/* The derivative of order i in x and j in y; not-a-number outside of the table. */
double nh_spline_value(const nh_spline *spline, unsigned i, unsigned j, double x, double y);

#endif
