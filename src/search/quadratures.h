/* quadratures: currents from integration, one state after another, and the motion as formulas (explicit_motion.h).
 *
 * Every state is tried as the parameter of the motions, with the currents found so far.  The constants of the
 * integrations are currents like others: they are proved, compared, and tested where motions cross the cuts of their
 * arctangents and logarithms.  A formula that needs values of parameters (the sleigh's position: sin and cos of phi and
 * of phi/k) is tried with values for those that stand in functions and exponents. */
#ifndef NH_QUADRATURES_H
#define NH_QUADRATURES_H

#include "search/stage_solver.h"

void nh_quadratures_search(nh_stage_solver *solver);

/* The constants of the whole motion where linear steps give it in closed form for all values of the parameters; else
 * nothing.  This finds in one step what many stages would find one after another. */
void nh_quadratures_complete(nh_stage_solver *solver);

#endif
