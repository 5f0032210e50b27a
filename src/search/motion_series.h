/* motion_series: the integrals without closed form of an explicit motion as power series along one motion, with bounds.
 *
 *     J(s) = sum_(k < degree) a_k (s - s_0)^k + R(s),     |R(s)| <= bound for |s - s_0| <= half
 *
 * s_0 and the constants are those of the motion's start; exact/ball_series.h has the bound. */
#ifndef NH_MOTION_SERIES_H
#define NH_MOTION_SERIES_H

#include "search/analysis.h"
#include "search/explicit_motion.h"

enum { NH_MOTION_SERIES_TERMS = 16 };

typedef struct {
    nh_ex symbol;
    double coefficient[NH_MOTION_SERIES_TERMS], bound; /* of x^0, x^1, .. */
} nh_motion_series_of_one;

typedef struct nh_motion_series {
    double start, half;
    size_t integrals; /* those of the motion */
    nh_motion_series_of_one *integral;
} nh_motion_series;

/* From the state z = (t, q, w), whose parameter goes as far as `reach` from there; the largest interval on which all
 * bounds are small beside the series.  In the arena; NULL: there is none. */
nh_motion_series *nh_motion_series_from(nh_arena *arena, const nh_model *model, const nh_explicit_motion *motion,
                                        const double *z, double reach);

/* Of the analysis's motion, from where its checked motion starts, as far as that goes. */
void nh_motion_series_add(nh_analysis *result);

#endif
