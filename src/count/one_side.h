/* one_side: equations that are defined piece by piece, on one side of each kink: one function, on the open set of the
 * submanifold in which the first probe of the chart lies. */
#ifndef NH_ONE_SIDE_H
#define NH_ONE_SIDE_H

#include "geometry/model.h"
#include "integrals/region.h"

/* e with |u| as u or -u and sign(u) as 1 or -1.  The walls u = 0 are added to `side` with the sides taken, unless it is
 * NULL; what vanishes at the probe stays. */
nh_ex nh_one_side(const nh_model *model, nh_ex e, nh_region *side);

/* sqrt(u^2 v) as u sqrt(v) or -u sqrt(v), likewise: modulo a prime the root of a square would be either of both,
 * although it has its values among the other functions.  */
nh_ex nh_one_side_of_roots(const nh_model *model, nh_ex e, nh_region *side);

/* Does what holds in this region hold on the sides that are taken?  Not where it holds in some parts only. */
bool nh_one_side_within(const nh_model *model, const nh_region *region);

#endif
