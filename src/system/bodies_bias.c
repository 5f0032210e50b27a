/* bodies_bias: recursive Newton and Euler [Featherstone2008, ch. 5]: the forces c(q, q', t) that hold all q'' at zero,
 * gravity included, so that
 *
 *     d/dt dL/dq'^i - dL/dq^i = K_ij q''^j + c_i,       L the Lagrangian of bodies and joints.
 *
 * From the root to the leaves go twists V and accelerations A, gravity as an acceleration of the ground; back come the
 * wrenches h A + ad*_V h V.  That is linear in the number of bodies, where derivatives of the metric are quadratic. */
#include <string.h>

#include "graph/dag.h"
#include "graph/diff.h"
#include "system/bodies.h"

typedef struct {
    nh_twist V, A;
    nh_wrench F;
} state;

static void add_scaled(nh_dag *d, nh_ex factor, const nh_ex x[3], nh_ex sum[3])
{
    for (int i = 0; i < 3; i++) sum[i] = nh_add(d, sum[i], nh_mul(d, factor, x[i]));
}

/* After one more screw: A := Ad A + [V, xi s'] + xi s'', V := Ad V + xi s'. */
static void advance(nh_dag *d, const nh_screw *s, nh_ex drift, state *x)
{
    nh_pose step = nh_screw_pose(d, s);
    nh_twist xi = nh_screw_twist(d, s);
    nh_ex turn[3];
    x->V = nh_twist_inwards(d, &step, &x->V);
    x->A = nh_twist_inwards(d, &step, &x->A);
    nh_cross(d, x->V.w, xi.v, turn);
    add_scaled(d, s->rate, turn, x->A.v);
    nh_cross(d, x->V.v, xi.w, turn);
    add_scaled(d, s->rate, turn, x->A.v);
    nh_cross(d, x->V.w, xi.w, turn);
    add_scaled(d, s->rate, turn, x->A.w);
    add_scaled(d, drift, xi.v, x->A.v);
    add_scaled(d, drift, xi.w, x->A.w);
    add_scaled(d, s->rate, xi.v, x->V.v);
    add_scaled(d, s->rate, xi.w, x->V.w);
}

/* h A + (w x p, w x L + v x p), (p, L) = h V */
static nh_wrench force_on(nh_dag *d, const nh_body *b, const state *x)
{
    nh_inertia h = nh_body_inertia(d, b);
    nh_wrench F = nh_inertia_momentum(d, &h, &x->A), P = nh_inertia_momentum(d, &h, &x->V);
    nh_ex c[3], one = nh_int(d, 1);
    nh_cross(d, x->V.w, P.p, c);
    add_scaled(d, one, c, F.p);
    nh_cross(d, x->V.w, P.L, c);
    add_scaled(d, one, c, F.L);
    nh_cross(d, x->V.v, P.p, c);
    add_scaled(d, one, c, F.L);
    return F;
}

/* ds'/dt with q'' = 0: not zero only where a displacement is an expression. */
static nh_ex drift_of(const nh_chain_scope *o, nh_ex rate)
{
    nh_ex sum = nh_diff(o->dag, rate, o->t);
    for (size_t i = 0; i < o->m; i++)
        sum = nh_add(o->dag, sum, nh_mul(o->dag, nh_diff(o->dag, rate, o->q[i]), o->v[i]));
    return sum;
}

void nh_chain_bias(const nh_chain *c, const nh_chain_scope *o, nh_ex *out)
{
    nh_dag *d = o->dag;
    state *x = nh_alloc_array(c->bodies + 1, sizeof *x), ground;
    for (size_t i = 0; i < o->m; i++) out[i] = nh_int(d, 0);
    for (int e = 0; e < 3; e++) {
        ground.V.v[e] = ground.V.w[e] = ground.A.w[e] = nh_int(d, 0);
        ground.A.v[e] = nh_neg(d, c->gravity[e]);
    }
    for (size_t i = 0; i < c->joints; i++) {
        const nh_joint *j = &c->joint[c->order[i]];
        state s = j->parent == NH_GROUND ? ground : x[j->parent];
        s.V = nh_twist_inwards(d, &j->placement, &s.V);
        s.A = nh_twist_inwards(d, &j->placement, &s.A);
        for (size_t k = j->first; k < j->first + j->screws; k++)
            advance(d, &c->screw[k], drift_of(o, c->screw[k].rate), &s);
        s.F = force_on(d, &c->body[j->child], &s);
        x[j->child] = s;
    }
    for (size_t i = c->joints; i-- > 0;) {
        const nh_joint *j = &c->joint[c->order[i]];
        nh_wrench F = x[j->child].F;
        for (size_t k = j->first + j->screws; k-- > j->first;) {
            nh_twist xi = nh_screw_twist(d, &c->screw[k]);
            nh_pose step = nh_screw_pose(d, &c->screw[k]);
            nh_ex torque = nh_pairing(d, &xi, &F);
            for (size_t q = 0; q < o->m; q++)
                out[q] = nh_add(d, out[q], nh_mul(d, nh_diff(d, c->screw[k].rate, o->v[q]), torque));
            F = nh_wrench_outwards(d, &step, &F);
        }
        if (j->parent == NH_GROUND) continue;
        F = nh_wrench_outwards(d, &j->placement, &F);
        add_scaled(d, nh_int(d, 1), F.p, x[j->parent].F.p);
        add_scaled(d, nh_int(d, 1), F.L, x[j->parent].F.L);
    }
    nh_free(x);
}
