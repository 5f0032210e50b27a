/* distribution: what kind of constraint this is.
 *
 *     affine         nu^a_s d2rho^s/dw^i dw^j = 0: the velocities allowed at a place form an affine space
 *     homogeneous    nu^a_s rho^s = 0: with a velocity all its multiples are allowed
 *     linear         both
 *     rheonomic      df^a/dt is not zero on the submanifold; for a constraint between positions, its own rate at rest
 *                    is not
 *     holonomic      affine and integrable: as many functions of (t, q) stay constant as there are constraints.
 *                    Semiholonomic constraints,
 *                    eps'_l(g^a) = 0, are defined for linear and affine ones only and are the same [CechMusilova2014,
 *                    sec. 3.2]
 *     growth         of the distribution of virtual displacements (linear, no t), of d/dt + rho^s d/dq^s and R^s_i
 *                    d/dq^s on (t, q) (affine or t),
 *                    of the canonical distribution on (t, q, w) (nonlinear)
 *     hidden         functions of (t, q) that the constraints hold constant, besides those of the constraints between
 *                    positions
 *
 * [docs/method.md, sec. 2] */
#ifndef NH_DISTRIBUTION_H
#define NH_DISTRIBUTION_H

#include "geometry/growth.h"

typedef enum { NH_UNCONSTRAINED, NH_LINEAR, NH_AFFINE, NH_NONLINEAR } nh_constraint_type;

typedef struct {
    nh_constraint_type type;
    bool homogeneous, rheonomic, holonomic;
    size_t positions; /* constraints that were given between positions */
    nh_growth growth; /* length 0 without constraints */
    size_t integrals; /* number of functions of (t, q) that stay constant: dimension minus last rank */
    size_t hidden;    /* how many of them are not given as constraints between positions */
} nh_distribution;

/* Fields that span the distribution of virtual displacements (in space and time, where the constraints are affine or
 * depend on t), for constraints that are at most affine: `count` of them with components field[i * dimension + j] along
 * symbol[j], on the heap.  None otherwise. */
typedef struct {
    size_t count, dimension;
    const nh_ex *symbol;
    nh_ex *field;
} nh_distribution_fields;
nh_distribution_fields nh_distribution_fields_of(const nh_model *model);

/* What the constraints of the model are. */
nh_distribution nh_distribution_of(const nh_model *model);
const char *nh_constraint_type_name(nh_constraint_type type);

/* "holonomic" (given between positions), "integrable", "partly integrable", "nonholonomic", or "none". */
const char *nh_constraint_integrability(const nh_model *model, const nh_distribution *distribution);

#endif
