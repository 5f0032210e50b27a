/* one_side: equations that are defined piece by piece, on one side of each kink: one function, on the open set of the
 * submanifold in which the first probe of the chart lies. */
#ifndef NH_ONE_SIDE_H
#define NH_ONE_SIDE_H

#include "geometry/model.h"
#include "integrals/region.h"

/* Replaces |u| in e by u or -u, and sign(u) by 1 or -1, as at the probe.  The walls u = 0 are added to `side` with the
 * chosen sides, unless `side` is NULL; a u that vanishes at the probe stays. */
nh_ex nh_one_side(const nh_model *model, nh_ex e, nh_region *side);

/* Likewise sqrt(u^2 v) by u sqrt(v) or -u sqrt(v): modulo a prime the root of a square has two values, both among those
 * of the other functions; and the second of paired roots (geometry/model.h). */
nh_ex nh_one_side_of_roots(const nh_model *model, nh_ex e, nh_region *side);

/* The sign of u at the probe by rigorous arithmetic, 0 where it is not known; the wall is added unless u is
 * seen to have this sign everywhere. */
int nh_one_side_sign(const nh_model *model, nh_ex u, nh_region *side);

/* Does a result for this region hold on the chosen sides?  Not where it holds in some parts only. */
bool nh_one_side_within(const nh_model *model, const nh_region *region);

#endif
