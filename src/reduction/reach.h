/* reach: positions and velocities moved along the orbits of a group.
 *
 * A slice need not pass through the place that a motion starts from: if h q lies on it, we integrate from h q and map
 * back by h^-1.  On the slice y = 0 the equations are shortest, and often regular where those on a slice through q are
 * not. */
#ifndef NH_REACH_H
#define NH_REACH_H

#include <stdint.h>

#include "reduction/slice.h"

enum { NH_REACH_MOST = 60 };

/* The flow of a generator for the time `time`, of z = (q, v): 2 m values, overwritten. */
bool nh_action_push(const nh_action *action, size_t generator, double time, double *z);
/* Onto a slice, by Newton's method along the generators one after the other; q and v are overwritten.  Returns how many
 * moves were made (NH_REACH_MOST at most), and what leads back, first move outermost: d numbers each into `moved`, all
 * but one of them zero.  SIZE_MAX, and q and v left alone, where the orbit does not reach it. */
size_t nh_slice_reach(const nh_slice *slice, double *q, double *v, double *moved);

#endif
