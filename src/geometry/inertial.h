/* inertial: the force of the constraints, read as inertial forces.
 *
 * By Chetaev's equations mu_a df^a/dv^s = A_s + B_sr v'^r (submanifold.h).  Along a length s each part has a name
 * [CechMusilova2014, eq. 46]:
 *
 *     Euler force          B_sr v'^r            r an angle
 *     translational force  B_sr v'^r            r a length
 *     centrifugal force    A_s, quadratic in the rates of angles
 *     Coriolis force       A_s, a rate of an angle times one of a length
 *     further terms        A_s, quadratic in the rates of lengths, or linear in velocities (they vanish in Cartesian
 *                          coordinates at rest)
 *     applied force        A_s, the rest
 *
 * It splits where every coordinate is an angle or a length and A_s - Q_s is at most quadratic in the velocities. */
#ifndef NH_INERTIAL_H
#define NH_INERTIAL_H

#include "geometry/submanifold.h"

typedef enum {
    NH_INERTIAL_CENTRIFUGAL,
    NH_INERTIAL_CORIOLIS,
    NH_INERTIAL_FURTHER,
    NH_INERTIAL_APPLIED,
    NH_INERTIAL_PARTS
} nh_inertial_part;

typedef struct {
    const nh_submanifold *of;
    /* m x NH_INERTIAL_PARTS, nothing for angles; the first two kinds hold the coefficients B of the submanifold */
    nh_ex *part;
} nh_inertial;

/* NULL: the force does not split or is too long, there are no constraints or no lengths, or a coordinate is neither a
 * length nor an angle. */
nh_inertial *nh_inertial_of(nh_arena *arena, const nh_submanifold *submanifold);

#endif
