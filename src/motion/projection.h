/* projection: the smallest change of a state that restores the initial values of the currents [HairerLubichWanner2006].
 *
 *     z1 = z + D J^T l,   Phi(z1) = Phi(z0),     J = d Phi / dz,  D = diag(s_i^2), s_i: the size of state i at the
 *     start (motion/sizes.h)
 *
 * by at most three Gauss-Newton steps of least norm; rows that depend on others on the way are left out by a rank
 * decision, so that dependent currents are harmless. */
#ifndef NH_PROJECTION_H
#define NH_PROJECTION_H

#include "motion/dynamics.h"

typedef struct nh_projection nh_projection;

/* For `currents` expressions of the model's chart, which must have no implicit velocities; z0: m + n values at time t
 * of a motion to `end`.  The caller frees it. */
nh_projection *nh_projection_create(const nh_model *model, size_t currents, const nh_ex *current, double t, double end,
                                    const double *z0);
void nh_projection_free(nh_projection *projection);

/* Which currents can be projected onto from z0?  The gradient of each must be independent of those of the currents
 * chosen before it. why[k]: NULL when current k is chosen, otherwise the reason why not.  Returns how many are
 * chosen. */
size_t nh_projection_choose(const nh_model *model, size_t currents, const nh_ex *current, double t, double end,
                            const double *z0, const char **why);

/* For nh_flow_options.after: context is the projection.  False when the values are not finite. */
bool nh_projection_apply(double t, double *z, void *context);
long nh_projection_evaluations(const nh_projection *projection);

#endif
