/* slice: a system with symmetry on a slice of its configuration space, without group coordinates.
 *
 * Coordinates x (shape) and y, as many y as generators; the slice is y = y0.  Then (g, x) -> g . sigma(x) covers a
 * neighbourhood, and everything that is invariant is known on the slice: in the frame (d/dx^i, e_a) of vectors at
 * sigma(x)
 *
 *     Kf = Fr^T K Fr,      omf = omega Fr,      V(sigma(x))
 *
 * are functions of x alone.  x need not be invariant under the group: it is a coordinate of the slice. */
#ifndef NH_SLICE_H
#define NH_SLICE_H

#include "reduction/action.h"

typedef struct {
    const nh_action *action;
    const nh_kinetic *kinetic;
    nh_dag *dag;
    size_t m, f, n, d;     /* coordinates, constraints, shape, group; m = n + d */
    size_t *shape, *along; /* n, d coordinate indices: x and y */
    double *y0;            /* d */
    nh_ex *y;              /* d: the same as expressions, exact for integers and pi/2 */
    bool tidy;             /* all of them are exact, so that simplifying expressions is useful */
    nh_ex *x;              /* n symbols */
    nh_ex *E;              /* m x d: generators on the slice, E[s*d + a] */
    nh_ex *K;              /* m x m in the frame, row-major; shape first */
    nh_ex V;
    nh_ex *omega; /* f x m in the frame */
    nh_ex *a, *b; /* m, f: Fr^T a and b of L and of affine constraints */
    /* m: the place for which linear systems are eliminated; NULL: for all the sample points together */
    const double *pivots;
} nh_slice;

/* nh_pivot_score of a slice (`slice` is one). */
double nh_slice_pivot_score(void *slice, nh_ex e);

/* The d coordinates y whose rows of E are best conditioned over the sample points (system->dependent breaks ties). */
void nh_slice_choose(const nh_action *action, size_t *shape, size_t *along);

/* The same at one place.  `avoid`: d coordinates whose slice soon failed from there; others are taken unless they are
 * far worse.  NULL: none. */
void nh_slice_choose_at(const nh_action *action, const double *q, const size_t *avoid, size_t *shape, size_t *along);

/* The first y0 with entries 0, pi/2 (angles only) and 1 at which the slice is regular; false: none is. */
bool nh_slice_nice(const nh_action *action, const size_t *along, double *y);

/* y0 (d values); entries are simplified where y0 is exact (whole numbers, pi/2).  Memory: the kinetic's arena. */
void nh_slice_init(nh_slice *slice, const nh_action *action, const size_t *shape, const size_t *along,
                   const double *y0);

/* Does the group move shape coordinate i? */
bool nh_slice_moves(const nh_slice *slice, size_t i);

/* Components u = (x', zeta) in the frame of a velocity at a place q on the slice (m values each).  False when the frame
   is singular there. */
bool nh_slice_components(const nh_slice *slice, const double *q, const double *v, double *u);
/* The place of a point of the slice: x and y0 as coordinates. */
void nh_slice_place(const nh_slice *slice, const double *x, double *q);

#endif
