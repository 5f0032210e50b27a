/* drift: how far currents change along a motion that is computed at three tolerances. */
#ifndef NH_DRIFT_H
#define NH_DRIFT_H

#include "base/option.h"
#include "motion/dynamics.h"

enum { NH_DRIFT_RUNS = 3 };

typedef struct {
    /* max |Phi - Phi(0)| / scale, loosest tolerance first; NAN: it is real at no state of the motion */
    double drift[NH_DRIFT_RUNS];
    double scale; /* size of the current along the motion: of its terms, not of their cancelled sum */
    /* time up to which it was measured: earlier than the end where the motion leaves the current's interval */
    double until;
    /* the drift of the tightest motion in doubles, where these lose digits and `drift` is computed in ball arithmetic;
     * else 0 */
    double in_doubles;
    bool small, falls; /* below options->drift tolerances; falls with the tolerance, or is at rounding */
    /* the error of the motion explains it: it is small, or it falls from the second tolerance to the third as that
     * error does */
    bool explained;
} nh_drift;

/* Where a current is defined: while the variable lies between low and high. */
typedef struct {
    nh_ex variable; /* a coordinate or t; 0: it holds everywhere */
    double low, high;
} nh_valid;

typedef struct {
    nh_dynamics *dynamics;
    const nh_options *options;
    double begin;            /* of the motions */
    const double *tolerance; /* NH_DRIFT_RUNS */
    size_t currents;
    const nh_ex *current;  /* of the chart */
    const nh_valid *valid; /* `currents` intervals, or NULL */
} nh_drift_question;

/* Measures the drift along the motion of tolerance[which]; out has one entry for each current. */
void nh_drift_measure(const nh_drift_question *question, const nh_motion *motion, size_t which, nh_drift *out);

/* Call after the last motion: sets small, falls and explained. */
void nh_drift_judge(size_t count, const double *tolerance, const nh_options *options, nh_drift *drift);

#endif
