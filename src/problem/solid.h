/* solid: a rigid body of a chain as a shape in space. */
#ifndef NH_SOLID_H
#define NH_SOLID_H

#include "system/bodies.h"
#include "system/shape.h"

/* The wheel or the ball that rolls on it; else the box of even density with its moments of inertia about the axes of
 * its frame, in which flat bodies are flat; without them a ball of radius 0. */
nh_shape nh_solid_of_body(nh_dag *dag, const nh_chain *chain, size_t body);

#endif
