/* distribution: what kind of constraint this is.
 *
 *     linear, affine, nonlinear      in the velocities
 *     rheonomic                      time occurs in it
 *     semiholonomic                  nu^a_s (X_0(R^s_l) - X_l(rho^s)) = 0, which is eps'_l(g^a) = 0 [CechMusilova2014, sec. 2.3]
 *     holonomic                      affine and semiholonomic: the distribution is integrable (Frobenius)
 *     growth vector                  ranks of D, D + [D,D], D + [D,D] + [D,[D,D]], ... at generic points; a final rank below m
 *                                    means m - rank hidden holonomic constraints */
#ifndef NH_DISTRIBUTION_H
#define NH_DISTRIBUTION_H

#include "geometry/model.h"

typedef enum { NH_UNCONSTRAINED, NH_LINEAR, NH_AFFINE, NH_NONLINEAR } nh_constraint_type;

enum { NH_MOST_GROWTH = 6 };

typedef struct {
    nh_constraint_type type;
    bool rheonomic, semiholonomic, holonomic;
    size_t growth[NH_MOST_GROWTH], growth_length; /* linear constraints without t only */
    size_t hidden; /* hidden holonomic constraints: m - last growth rank */
} nh_distribution;

nh_distribution nh_distribution_of(const nh_model *model);
const char *nh_constraint_type_name(nh_constraint_type type);

#endif
