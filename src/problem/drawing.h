/* drawing: the default picture of a system. */
#ifndef NH_DRAWING_H
#define NH_DRAWING_H

#include "system/bodies.h"
#include "system/shape.h"
#include "system/system.h"

/* Shapes in t, coordinates and parameters, in the arena:
 *
 *     bodies and joints    a rod from joint to joint, a point at every mass, wheels and blades; from above when there
 *                          are wheels, else across
 *                          the direction in which the least moves
 *     polar coordinates    of a plane, of a sphere, where d2L/dv_i dv_j is that of them: a point each
 *     pendulums            one at the end of the other, on the ground or on a cart, likewise
 *     two lengths or more  points in the plane of the first two (of several pairs x1, y1, x2, y2: one point each), with
 *                          the first angle as heading
 *     one length           a point on a line, the angles as hands there
 *     angles               each the hand of a dial
 *
 * Returns how it is seen, in words for a caption, or NULL with no shapes. */
const char *nh_drawing_choose(nh_arena *arena, const nh_system *system, size_t *count, const nh_shape **shape);

/* A rigid body of a chain as a shape in space. */

/* The wheel or the ball that rolls on it; else the box of even density with its moments of inertia about the axes of
 * its frame, in which flat bodies are flat; without them a ball of radius 0. */
nh_shape nh_solid_of_body(nh_dag *dag, const nh_chain *chain, size_t body);

#endif
