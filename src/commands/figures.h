/* figures: the curves of the figures of an analysis file: paths and quantities along motions, repeated over the values
 * of a parameter, the smallest singular value over an unknown, the gap over the number of samples. */
#ifndef NH_FIGURES_H
#define NH_FIGURES_H

#include "commands/request.h"
#include "search/analysis.h"

/* Fills result->figure.  A curve that cannot be computed is left out with a warning.  `family`: those of the ansatz
 * with the values of the unknowns; none where the program chose the ansatz. */
void nh_figures_compute(nh_analysis *result, const nh_request *request, size_t families, const nh_family *family);

#endif
