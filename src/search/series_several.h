/* series_several: currents polynomial in the velocities whose coefficients are functions of several variables. */
#ifndef NH_SERIES_SEVERAL_H
#define NH_SERIES_SEVERAL_H

#include "search/stage_solver.h"

/* Where this kind of coefficients may give more currents at its least degree: are there any, as series on a box?  They
 * are kept. */
bool nh_series_in_several(nh_stage_solver *solver, const nh_completeness *completeness);

#endif
