/* joint: the displacements E of one joint of a chain, as motions of its coordinates.
 *
 *     E = exp(xi_1 s_1) ... exp(xi_n s_n),   E^-1 E' = sum_k B_k s_k',   B_k = Ad(what is behind screw k)^-1 xi_k
 *     s' = (B^T B)^-1 B^T xi                 for E^-1 E' = xi in the joint's Lie algebra */
#ifndef NH_REDUCTION_JOINT_H
#define NH_REDUCTION_JOINT_H

#include "system/system.h"

/* A basis of the joint's Lie algebra, in its frame: its screws, except that Euler's angles stand for all rotations.
   Returns its dimension. */
size_t nh_joint_basis(nh_dag *dag, const nh_chain *chain, const nh_joint *joint, nh_twist basis[NH_MOST_SCREWS]);
/* E. */
nh_pose nh_joint_pose(nh_dag *dag, const nh_chain *chain, const nh_joint *joint);

/* A pose where all coordinates and the time are zero. */
nh_pose nh_joint_at_rest(const nh_system *system, const nh_pose *pose);

/* NULL where the angles are singular everywhere. */
typedef struct nh_joint_rates nh_joint_rates;
nh_joint_rates *nh_joint_rates_create(const nh_system *system, const nh_joint *joint);
void nh_joint_rates_free(nh_joint_rates *rates);
/* The rates of the screws for the twist xi of the body (as many as there are screws). */
void nh_joint_rates_of(const nh_joint_rates *rates, const nh_twist *xi, nh_ex *rate);

/* Fields on the configuration space of a chain that the displacements of its joints generate.
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

typedef struct {
    size_t count, m;
    nh_ex *component; /* count x m; no two fields are the same expressions */
} nh_joint_fields;

/* Empty for a system without bodies. */
void nh_joint_fields_init(nh_joint_fields *fields, const nh_system *system);
void nh_joint_fields_clear(nh_joint_fields *fields);

#endif
