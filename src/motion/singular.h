/* singular: places on a motion where the equations of motion determine no acceleration.
 *
 *     [ K  F^T ] [ v' ]     [ h ]
 *     [ F   0  ] [ mu ] = - [ g ]          K = d2L/dv dv,  F = df/dv   (geometry/bordered.h)
 *
 * has one solution where F has full rank and K is regular on the velocities that the constraints allow.  Where one of
 * them is not, other motions may go on from the same state: at the tip of a cone, at the crossing of x y = 0, where a
 * constraint x z' = x y x' is multiplied by zero, where two axes of a gimbal coincide.  An integrator steps over such a
 * point without notice.  So the modulus of the determinant is sampled inside each step.  Where it has a minimum, the
 * least singular values of F and of K on ker F decide: one that is far below what it is at both sides is a zero.  Where
 * steps become short on the way to such a place, the determinant changes by its own size when a state changes by its
 * error. */
#ifndef NH_SINGULAR_H
#define NH_SINGULAR_H

#include "motion/inside_step.h"
#include "system/system.h"

typedef struct {
    const nh_system *system;
    size_t m, k;
    /* K (m x m) and F (k x m), column-major, of a state of the motion; false where they cannot be computed */
    bool (*value)(double t, const double *z, double *entry, void *context);
    void *context;
    bool mapped; /* the velocities are not those of the coordinates */
} nh_singular_terms;

/* For motions that begin at one state.  The caller frees it. */
nh_singular_watch *nh_singular_watch_create(const nh_singular_terms *terms);
void nh_singular_watch_free(nh_singular_watch *watch);

/* The time of the first such place in the last step (NAN: there is none), or of its end where that is so near to such
 * a place that errors of the states, of a multiple of rtol of their sizes, may lead there. */
double nh_singular_watch_step(nh_singular_watch *watch, nh_inside_step *inside, double rtol);
/* Is the end of the last step near such a place, so that the integrator cannot go on? */
bool nh_singular_watch_end(nh_singular_watch *watch, nh_inside_step *inside);
/* Was the place found only within the errors of the states? */
bool nh_singular_watch_close(const nh_singular_watch *watch);
/* What vanishes at that place, as a sentence. */
const char *nh_singular_watch_words(const nh_singular_watch *watch);

#endif
