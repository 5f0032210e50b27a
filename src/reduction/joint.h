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

#endif
