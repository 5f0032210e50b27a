/* motion_series: the integrals without closed form of an explicit motion as power series along one motion, with bounds.
 *
 *     J(s) = sum_(k < degree) a_k (s - c)^k + R(s),     |R(s)| <= bound for |s - c| <= half
 *
 * on a chain of intervals with centres c, one beside the other, of which one has the motion's start as its centre.  The
 * constants are those of the start; from centre to centre the integrals go as balls, whose radii are in the bounds.
 * exact/ball_series.h has the bounds. */
#ifndef NH_MOTION_SERIES_H
#define NH_MOTION_SERIES_H

#include "search/analysis.h"
#include "search/explicit_motion.h"

enum { NH_MOTION_SERIES_TERMS = 16 };

typedef struct {
    nh_ex symbol;
    double coefficient[NH_MOTION_SERIES_TERMS], bound; /* of x^0, x^1, .. */
} nh_motion_series_of_one;

typedef struct {
    double centre, half;
    nh_motion_series_of_one *integral; /* those of the motion */
} nh_motion_series_link;

typedef struct nh_motion_series {
    double low, high;               /* where the motion's parameter goes */
    size_t integrals, links, first; /* first: the link about the start */
    nh_motion_series_link *link;    /* in ascending order */
} nh_motion_series;

/* From the state z = (t, q, w), whose parameter goes from `low` to `high`.  On each interval all bounds are
 * small beside the series; the chain ends where the motion does, where intervals become too short (at a zero of a root,
 * where the motion turns), or after a number of tries.  In the arena; NULL: there is none. */
nh_motion_series *nh_motion_series_from(nh_arena *arena, const nh_model *model, const nh_explicit_motion *motion,
                                        const double *z, double low, double high);
/* Where the chain begins and ends. */
double nh_motion_series_begin(const nh_motion_series *series);
double nh_motion_series_end(const nh_motion_series *series);
/* Integral j at a value of the parameter in the interval. */
double nh_motion_series_value(const nh_motion_series_link *link, size_t j, double at);

/* Of the analysis's motion, from where its checked motion starts, as far as that goes. */
void nh_motion_series_add(nh_analysis *result);

#endif
