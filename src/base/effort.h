/* effort: counted work of this thread along motions, in units that do not depend on the clock, the load or the machine.
 *
 * A unit is about a nanosecond, as in base/budget.h: an instruction of a straight-line program that is interpreted
 * costs about two, a step of an integrator some hundred and what it does with its vectors.  Tapes, linear algebra and
 * integrators add what they do.  Ways of computing the same motion are compared by differences of nh_effort, so that
 * the choice is the same on every machine, however busy.  Machine code is counted as what it replaces. */
#ifndef NH_EFFORT_H
#define NH_EFFORT_H

/* Units since the thread began. */
double nh_effort(void);
void nh_effort_add(double units);

#endif
