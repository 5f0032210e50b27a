/* sign_changes: the first change of sign of functions within a step of a motion.
 *
 * The functions are sampled along the states inside of the step, more densely until its neighbours predict each
 * sample, so that two changes of one function within a step are found, too.  Kinks of the equations of motion
 * (kinks.h) and events (events.h) are such changes. */
#ifndef NH_SIGN_CHANGES_H
#define NH_SIGN_CHANGES_H

#include <stdbool.h>
#include <stddef.h>

/* The state at a time inside of the last step. */
typedef bool nh_inside(double time, double *state, void *context);

typedef struct {
    size_t count, size; /* number of functions; number of entries of a state */
    bool (*value)(double t, const double *z, double *value, void *context);
    void *context;
    /* how often the way to an extremum is shortened: 1 suffices where a parabola through samples shows it */
    int closer;
    double *side; /* of each function: +1, -1; 0: not known yet */
    double *sample, *probe, *z; /* values along a step, and at one more time; a state */
    long samples;               /* number of samples in the last search */
    bool exhausted;             /* the last search took all samples that are allowed, and did not reach the end */
    nh_inside *inside;          /* of the step that is searched */
    void *inside_context;
} nh_sign_changes;

/* Sets the members above `side`, and allocates the others. */
void nh_sign_changes_open(nh_sign_changes *changes);
void nh_sign_changes_clear(nh_sign_changes *changes);

/* The values at a time inside of the step, into value; false where they are not finite. */
bool nh_sign_changes_at(nh_sign_changes *changes, double t, double *value);
/* Has a function with these values changed its sign?  A side that is not known yet becomes the sign of its value. */
bool nh_sign_changes_crossed(nh_sign_changes *changes, const double *value);
/* Sets the sides at a state. */
void nh_sign_changes_take_sides(nh_sign_changes *changes, double t, const double *z);

/* Between `before`, where the sides are known, and `now`: two near times with the first change of a sign between them.
 * False: there is none. */
bool nh_sign_changes_first(nh_sign_changes *changes, double before, double now, double *near, double *far);

#endif
