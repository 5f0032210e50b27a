/* frames: velocities along and across the headings of wheels and blades, for systems whose file has none.
 *
 * Constraints such as x' sin(phi) = y' cos(phi) do not depend on phi in
 *
 *     u = x' cos(phi) + y' sin(phi),   v = -x' sin(phi) + y' cos(phi)
 *
 * With such quasi-velocities equations are short that are long in x', and the first ones often depend on velocities
 * only. */
#ifndef NH_FRAMES_H
#define NH_FRAMES_H

#include "search/stage_solver.h"

/* Integrates one equation after another in these velocities, with the currents found so far. */
void nh_frames_search(nh_stage_solver *solver);

#endif
