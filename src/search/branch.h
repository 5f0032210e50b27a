/* branch: do the printed formulas hold on the other branch of a quadratic constraint?
 *
 * The chart is computed on one branch.  Formulas with the dependent velocity in the place of the root (nh_chart_shown)
 * are put into the chart of the other branch, with a model of its own, and proved again there. */
#ifndef NH_BRANCH_H
#define NH_BRANCH_H

#include "search/analysis.h"

/* The model on the other branch of o's chart; NULL where it has none, or cannot be made. */
nh_model *nh_branch_other(const nh_model *o, const nh_options *options);

/* Is phi, of the other branch's model, conserved there as surely as it is here? */
bool nh_branch_conserves(const nh_model *other, nh_ex phi, const nh_proof *here, const nh_options *options);

/* The branches' names, and for equations and currents whether they hold on both. */
void nh_branch_compare(nh_analysis *result);

#endif
