/* sign_changes: the first change of sign of functions within a step of a motion.
 *
 * On each part of the step every function is interpolated by Chebyshev polynomials, g = sum_k c_k T_k(x), |x| <= 1.
 * Where |c_0| > sum_{k>0} |c_k| it has no zero, where |c_1| > sum_{k>1} k^2 |c_k| it is monotonic and has one zero at
 * most, whose sign change the ends show; otherwise the part is halved.  So every pair of zeros is found, unless the
 * function stays within its floor, below which it has no sign: then `doubtful` tells the time.  How much the
 * interpolation is off is estimated by its last coefficients and at two more places.  Kinks of the equations of motion
 * (wall_steps.h) and events (events.h) are such changes. */
#ifndef NH_SIGN_CHANGES_H
#define NH_SIGN_CHANGES_H

#include <stdbool.h>
#include <stddef.h>

/* The state at a time inside of the last step. */
typedef bool nh_inside(double time, double *state, void *context);

typedef struct {
    size_t count, size; /* number of functions; number of entries of a state */
    /* the values, and after them sizes below which these have no sign (0 where nothing is written) */
    bool (*value)(double t, const double *z, double *value, void *context);
    void *context;
    double *side;               /* of each function: +1, -1; 0: not known yet */
    double *sample, *probe, *z; /* values and floors along a step, and at one more time; a state */
    double doubtful;            /* a time at which a function touches 0 within its floor; NAN: none so far */
    long samples;               /* number of samples in the last search */
    bool exhausted;             /* the last search took all samples that are allowed, and did not reach the end */
    nh_inside *inside;          /* of the step that is searched */
    void *inside_context;
} nh_sign_changes;

/* Sets the members above `side`, and allocates the others. */
void nh_sign_changes_open(nh_sign_changes *changes);
void nh_sign_changes_clear(nh_sign_changes *changes);

/* The values and floors at a time inside of the step, into value (2 count); false where they are not finite. */
bool nh_sign_changes_at(nh_sign_changes *changes, double t, double *value);
/* The sign of function i: +1, -1, 0 within its floor. */
int nh_sign_changes_sign(const nh_sign_changes *changes, const double *value, size_t i);
/* Has a function with these values changed its sign?  A side that is not known yet becomes the sign of its value. */
bool nh_sign_changes_crossed(nh_sign_changes *changes, const double *value);
/* Sets the sides at a state. */
void nh_sign_changes_take_sides(nh_sign_changes *changes, double t, const double *z);

/* Between `before`, where the sides are known, and `now`: two near times with the first change of a sign between them.
 * False: there is none. */
bool nh_sign_changes_first(nh_sign_changes *changes, double before, double now, double *near, double *far);

#endif
