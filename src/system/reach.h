/* reach: default sampling intervals that reach beyond the walls of functions of one symbol.
 *
 * |t - 2| is 2 - t all over 0 < t < 1: samples from there alone would show what holds for t < 2 only.  So where a
 * wall (exact/walls.h) of the Lagrangian, a force or a constraint depends on one symbol alone, and the default
 * interval lies on one side of it, the interval is widened to half of its width beyond. */
#ifndef NH_REACH_H
#define NH_REACH_H

#include "system/system.h"

/* Sets system->reach; intervals that the file gives are left as they are. */
void nh_reach_walls(nh_system *system);

#endif
