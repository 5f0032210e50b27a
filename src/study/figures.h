/* figures: the curves of the figures that an analysis asks for: paths and quantities along motions, repeated over the values of a parameter, and the
 * smallest singular value over an unknown. */
#ifndef NH_STUDY_FIGURES_H
#define NH_STUDY_FIGURES_H

#include "study/analyze.h"

/* Fills result->figure.  A curve that cannot be computed is left out with a warning. */
void nh_figures_compute(nh_result *result, const nh_analyze_request *request);

#endif
