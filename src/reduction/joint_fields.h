/* joint_fields: fields on the configuration space of a chain that the displacements of its joints generate.
 *
 * A joint moves its body by E; its Lie algebra has the basis b.  With P the pose of the joint's frame in the frame of a
 * body before it (the parent, that one's parent, .. the ground) and P0 the same for q = 0, E^-1 E' is
 *
 *     b                                   E -> E g
 *     Ad(P E)^-1 c                        E -> g E, g fixed in that frame: c a unit twist there, or Ad(P0) b
 *     (p x w, w),  w = Ad(P E)^-1 c       a turn about a point p of the body: its origin, its centre of mass, the
 *                                         centre of mass of all bodies behind the joint
 *
 * wherever that stays in the joint's Lie algebra.  Symmetries of the kinetic energy are combinations of these in many
 * chains where the components along Euler's angles are products of more functions than a library can hold
 * [ChhabraEmami2014, sec. 4]. */
#ifndef NH_REDUCTION_JOINT_FIELDS_H
#define NH_REDUCTION_JOINT_FIELDS_H

#include "system/system.h"

typedef struct {
    size_t count, m;
    nh_ex *component; /* count x m; no two fields are the same expressions */
} nh_joint_fields;

/* Empty for a system without bodies. */
void nh_joint_fields_init(nh_joint_fields *fields, const nh_system *system);
void nh_joint_fields_clear(nh_joint_fields *fields);

#endif
