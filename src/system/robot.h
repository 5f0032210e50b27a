/* robot: what a file with bodies leaves to be completed.
 *
 *     base: planar                  the body without a joint is carried: fixed, planar, floating (angles),
 *                                   free (an orientation)
 *     wheels: [left, {body: right, radius: 0.1}]
 *
 * The body that is the child of no joint gets a joint: of the type `base`; without it, where the bodies are those of a
 * robot description, planar if there are wheels and otherwise fixed.  A wheel that names a body alone rolls; its axle
 * is the axis of the body's joint, and a robot description gives its radius. */
#ifndef NH_ROBOT_H
#define NH_ROBOT_H

#include "system/deck.h"

/* After all files are merged. */
bool nh_robot_complete(nh_deck *deck, nh_error *error);

#endif
