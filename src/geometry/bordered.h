/* bordered: the equations of motion in all coordinates, with multipliers.
 *
 *     [ K  F^T ] [ v' ]     [ h ]        K = d2L/dv dv,  F = df/dv
 *     [ F   0  ] [ mu ] = - [ g ]        h: d/dt-part of p_s without v' minus dL/dq - Q;  g: d/dt-part of f without v'
 *
 * They are regular wherever the constraints are independent, whatever the charts of independent velocities do: the
 * chart that takes over where the pivot of another vanishes.  The constraints are taken without poles and normalised to
 * |df/dv| = 1 (velocities in nh_chart_unit): the multipliers are not those of the model, but the force mu_a df^a/dv^s
 * is the same.
 *
 * Reference: [Chetaev equations: CechMusilova2014, eq. 10]. */
#ifndef NH_BORDERED_H
#define NH_BORDERED_H

#include "geometry/model.h"

typedef struct nh_bordered nh_bordered;
/* The equations of a model, which they borrow; nh_bordered_free. */
nh_bordered *nh_bordered_create(const nh_model *model);
void nh_bordered_free(nh_bordered *bordered);
/* Lets long motions pass to machine code (nh_tape_jit). nh_bordered_words says whether they have; NULL: nothing was
 * tried. */
void nh_bordered_jit(nh_bordered *bordered, double patience);
const char *nh_bordered_words(const nh_bordered *bordered);
size_t nh_bordered_coordinates(const nh_bordered *bordered); /* m */
const nh_system *nh_bordered_system(const nh_bordered *bordered);
size_t nh_bordered_constraints(const nh_bordered *bordered); /* k */

/* Functions of t and the state (q, v) that change their sign where these equations have a kink (exact/walls.h). */
size_t nh_bordered_walls(const nh_bordered *bordered);
void nh_bordered_wall(nh_bordered *bordered, double t, const double *state, double *value);

/* At (t, q, v): K (m x m, column-major), h (m), F (k x m, column-major), g (k), f (k).  False when not finite. */
bool nh_bordered_terms(nh_bordered *bordered, double t, const double *q, const double *v, double *K, double *h,
                       double *F, double *g, double *f);

/* v' (m values).  False when not finite or the bordered matrix is singular. */
bool nh_bordered_accelerations(nh_bordered *bordered, double t, const double *q, const double *v, double *acceleration);
/* Also the least change of v (m values), in the metric K, after which the constraints hold, to first order. */
bool nh_bordered_rates(nh_bordered *bordered, double t, const double *q, const double *v, double *acceleration,
                       double *change);

/* The accelerations at count <= NH_BATCH states: in[j] is input j of t, q, v at each of them (1 + 2m inputs); v' of
 * coordinate s at state j goes to to[s*stride + j], NAN where there is none. */
void nh_bordered_accelerations_batch(nh_bordered *bordered, size_t count, const double *const *in, size_t stride,
                                     double *to);

/* The reaction force[s] = mu_a df^a/dv^s at (t, q, v), m values.  False when not finite. */
bool nh_bordered_force(nh_bordered *bordered, double t, const double *q, const double *v, const double *mu,
                       double *force);

/* Moves v to the nearest velocities that satisfy the constraints, in the units of their coordinates, by Gauss-Newton;
 * entries that are `fixed` (m flags; NULL: none) are not changed.  False when the iteration does not converge. */
bool nh_bordered_project(nh_bordered *bordered, double t, const double *q, const bool *fixed, double *v);

/* The entries as expressions of t, q, q': K (m x m, column-major), h (m), F (k x m, column-major), g (k), f (k);
   constraints without poles, not normalised. */
void nh_bordered_expressions(const nh_model *model, nh_ex *K, nh_ex *h, nh_ex *F, nh_ex *g, nh_ex *f);

/* f^a = lhs - rhs in coordinate velocities, without its poles: y' = x' tan phi as y' cos phi = x' sin phi. */
nh_ex nh_constraint_without_poles(const nh_model *model, size_t a);

#endif
