/* group_flow: the reduced equations of one chart together with the motion of the group over it, as one differential
 * equation.
 *
 * The state is (x, p), then for the group d coordinates of the second kind, g = exp(t_1 e_1) ... exp(t_d e_d), with
 * M(t) t' = Ad_g zeta, then where that is possible the place q itself. */
#ifndef NH_GROUP_FLOW_H
#define NH_GROUP_FLOW_H

#include "reduction/atlas.h"

typedef struct {
    const nh_reduced_chart *chart;
    const nh_action *action;
    bool group;   /* the motion in the group is wanted as well */
    bool abelian; /* all ad_a are zero: M = 1 */
    size_t inner, d, m;
    double *ad;                      /* d matrices d x d */
    bool *acts;                      /* ad_a is not zero */
    bool *cubic;                     /* ad_a^3 = lambda_a ad_a: its exponential has a closed form */
    double *square, *lambda;         /* ad_a^2, d matrices; lambda_a */
    double *M, *P, *E, *next, *zeta; /* work */
    bool direct;                     /* the place itself is integrated beside (x, p, t) */
    nh_tape *field;                  /* generators at a place */
    nh_tape_work *field_work;
    double *unit;                 /* d: how far a group coordinate moves places by their size (1 for rotations) */
    double *e, *before, *spatial; /* their values; Ad of the factors kept; g' g^-1 */
} nh_group_flow;

/* `group`: the motion in the group is wanted.  The flow has no chart yet.  The caller clears it. */
void nh_group_flow_init(nh_group_flow *flow, const nh_action *action, bool group);
/* From now on the flow uses this chart, which it borrows. */
void nh_group_flow_chart(nh_group_flow *flow, const nh_reduced_chart *chart);
void nh_group_flow_clear(nh_group_flow *flow);

/* The number of entries of a state. */
size_t nh_group_flow_size(const nh_group_flow *flow);
/* z' (context: the flow). */
bool nh_group_flow_rate(double time, const double *z, double *rate, void *flow);
/* The guards of the reduced equations, and det M, relative to limits that they must not cross, with M's entries: three
 * values (context: the flow). */
bool nh_group_flow_guard(double time, const double *z, double *value, void *flow);
/* M(t) into flow->M and Ad_g into flow->P, from the d coordinates. */
void nh_group_flow_factors(nh_group_flow *flow, const double *t);

#endif
