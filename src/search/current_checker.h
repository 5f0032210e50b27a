/* current_checker: the data for checking all currents of one analysis. */
#ifndef NH_CURRENT_CHECKER_H
#define NH_CURRENT_CHECKER_H

#include "search/analysis.h"

enum { NH_LEAST_ALMOST = 6 /* digits to which a nearly conserved combination cancels */ };

typedef struct {
    nh_analysis *result;
    nh_points *heldout, *generic; /* points that were used in no fit */
    nh_terrain terrain;           /* where motions cross walls; of the first current on */
    bool searched;
    nh_ex *inverse; /* the chart's velocities in coordinate velocities */
    bool invertible;
    size_t refuted; /* candidates so far that are certainly not conserved */
    size_t nears;   /* refuted candidates of the present list that are nearly conserved */
    nh_candidate *near[NH_MOST_ALMOST];
    bool constructs; /* what is found is of the construction, of which the terms are the simplest */
} nh_current_checker;

/* max |Gamma(phi)| / max(sum |terms of it|, 1e-3 |dphi| |Gamma|) over the points. */
double nh_currents_residual(const nh_model *model, const nh_points *points, nh_ex phi);
/* Decides on a candidate of a system with tables: its formula, its residual and the digits of its coefficients. */
void nh_currents_fit(const nh_current_checker *checker, const nh_candidate *candidate, nh_current *current);

#endif
