#include "system/bodies.h"

#include <string.h>

#include "graph/dag.h"
#include "graph/diff.h"

/* ---- one screw ---- */

nh_twist nh_screw_twist(nh_dag *d, const nh_screw *s)
{
    nh_twist t;
    for (int i = 0; i < 3; i++) {
        t.v[i] = s->turns ? nh_mul(d, s->pitch, s->axis[i]) : s->axis[i];
        t.w[i] = s->turns ? s->axis[i] : nh_int(d, 0);
    }
    return t;
}

nh_pose nh_screw_pose(nh_dag *d, const nh_screw *s)
{
    nh_ex along[3], path = s->turns ? nh_mul(d, s->pitch, s->s) : s->s;
    for (int i = 0; i < 3; i++) along[i] = nh_mul(d, path, s->axis[i]);
    if (!s->turns) return nh_pose_shift(d, along);
    if (s->oriented) {
        nh_pose turned = nh_pose_identity(d);
        if (s->matrix) memcpy(turned.R, s->matrix, sizeof turned.R);
        return turned;
    }
    nh_pose a = nh_pose_turn(d, s->axis, s->s);
    memcpy(a.p, along, sizeof a.p);
    return a;
}

/* ds/dt along a motion */
static nh_ex rate_of(const nh_chain_scope *o, nh_ex s)
{
    nh_ex rate = nh_diff(o->dag, s, o->t);
    for (size_t i = 0; i < o->m; i++) rate = nh_add(o->dag, rate, nh_mul(o->dag, nh_diff(o->dag, s, o->q[i]), o->v[i]));
    return rate;
}

/* ---- from the root to the leaves ---- */

static void build_poses(nh_chain *c, nh_dag *d)
{
    for (size_t i = 0; i < c->joints; i++) {
        const nh_joint *j = &c->joint[c->order[i]];
        nh_body *b = &c->body[j->child];
        b->pose = j->parent == NH_GROUND ? j->placement : nh_pose_product(d, &c->body[j->parent].pose, &j->placement);
        for (size_t k = 0; k < j->screws; k++) {
            nh_pose step = nh_screw_pose(d, &c->screw[j->first + k]);
            b->pose = nh_pose_product(d, &b->pose, &step);
        }
        nh_pose_point(d, &b->pose, b->center, b->position);
    }
}

/* Pose and twist after one more screw. */
static void advance(nh_dag *d, const nh_screw *s, nh_pose *pose, nh_twist *twist)
{
    nh_pose step = nh_screw_pose(d, s);
    nh_twist own = nh_screw_twist(d, s);
    *pose = nh_pose_product(d, pose, &step);
    *twist = nh_twist_inwards(d, &step, twist);
    for (int i = 0; i < 3; i++) {
        twist->v[i] = nh_add(d, twist->v[i], nh_mul(d, own.v[i], s->rate));
        twist->w[i] = nh_add(d, twist->w[i], nh_mul(d, own.w[i], s->rate));
    }
}

void nh_chain_frame(const nh_chain *c, nh_dag *d, long body, size_t skip, nh_pose *pose, nh_twist *twist)
{
    if (body == NH_GROUND) {
        *pose = nh_pose_identity(d);
        for (int i = 0; i < 3; i++) twist->v[i] = twist->w[i] = nh_int(d, 0);
        return;
    }
    const nh_joint *j = &c->joint[c->body[body].joint];
    nh_chain_frame(c, d, j->parent, 0, pose, twist);
    *pose = nh_pose_product(d, pose, &j->placement);
    *twist = nh_twist_inwards(d, &j->placement, twist);
    for (size_t k = 0; k + skip < j->screws; k++) advance(d, &c->screw[j->first + k], pose, twist);
}

/* ---- from the leaves to the root ---- */

nh_inertia nh_body_inertia(nh_dag *d, const nh_body *b)
{
    nh_inertia c = {.m = b->mass};
    for (int i = 0; i < 3; i++) c.h[i] = nh_int(d, 0);
    memcpy(c.I, b->inertia, sizeof c.I);
    nh_pose shift = nh_pose_shift(d, b->center);
    return nh_inertia_outwards(d, &shift, &c);
}

/* S_jk for screw k and all screws j nearer to the root; F = C xi_k is written in the frame behind screw k. */
static void couple(nh_chain *c, nh_dag *d, const nh_joint *j, size_t k, nh_wrench F)
{
    for (size_t end = k + 1;; end = j->first + j->screws) {
        for (size_t at = end; at-- > j->first;) {
            nh_twist xi = nh_screw_twist(d, &c->screw[at]);
            nh_pose step = nh_screw_pose(d, &c->screw[at]);
            c->metric[at * c->screws + k] = c->metric[k * c->screws + at] = nh_tidy(d, nh_pairing(d, &xi, &F));
            F = nh_wrench_outwards(d, &step, &F);
        }
        if (j->parent == NH_GROUND) return;
        F = nh_wrench_outwards(d, &j->placement, &F);
        j = &c->joint[c->body[j->parent].joint];
    }
}

/* The metric, and the first moment of everything in the ground's frame. */
static void build_metric(nh_chain *c, nh_dag *d, nh_arena *arena, nh_ex moment[3])
{
    nh_inertia *composite = nh_arena_alloc(arena, (c->bodies + 1) * sizeof *composite);
    for (int i = 0; i < 3; i++) moment[i] = nh_int(d, 0);
    for (size_t i = 0; i < c->screws * c->screws; i++) c->metric[i] = nh_int(d, 0);
    for (size_t b = 0; b < c->bodies; b++) composite[b] = nh_body_inertia(d, &c->body[b]);
    for (size_t i = c->joints; i-- > 0;) {
        const nh_joint *j = &c->joint[c->order[i]];
        nh_inertia behind = composite[j->child];
        for (size_t k = j->first + j->screws; k-- > j->first;) {
            nh_twist xi = nh_screw_twist(d, &c->screw[k]);
            nh_pose step = nh_screw_pose(d, &c->screw[k]);
            couple(c, d, j, k, nh_inertia_momentum(d, &behind, &xi));
            behind = nh_inertia_outwards(d, &step, &behind);
        }
        behind = nh_inertia_outwards(d, &j->placement, &behind);
        if (j->parent == NH_GROUND)
            for (int e = 0; e < 3; e++) moment[e] = nh_add(d, moment[e], behind.h[e]);
        else composite[j->parent] = nh_inertia_sum(d, &composite[j->parent], &behind);
    }
}

/* ---- energies ---- */

/* 1/2 S_kl s_k' s_l' */
static nh_ex kinetic_energy(const nh_chain *c, nh_dag *d, bool framed)
{
    nh_ex sum = nh_int(d, 0);
    for (size_t k = 0; k < c->screws; k++)
        for (size_t l = k; l < c->screws; l++) {
            const nh_screw *a = &c->screw[k], *b = &c->screw[l];
            nh_ex rates = framed ? nh_mul(d, a->framed, b->framed) : nh_mul(d, a->rate, b->rate),
                  term = nh_mul(d, c->metric[k * c->screws + l], rates);
            sum = nh_add(d, sum, k == l ? nh_mul(d, nh_ratio(d, 1, 2), term) : term);
        }
    return sum;
}

/* K_ij = sum_kl (ds_k'/dv_i) S_kl (ds_l'/dv_j) */
static void metric_of_coordinates(nh_chain *c, const nh_chain_scope *o)
{
    nh_dag *d = o->dag;
    nh_ex *B = nh_alloc_array(o->m * c->screws + 1, sizeof *B);
    for (size_t i = 0; i < o->m; i++)
        for (size_t k = 0; k < c->screws; k++) B[i * c->screws + k] = nh_diff(d, c->screw[k].rate, o->v[i]);
    for (size_t i = 0; i < o->m; i++)
        for (size_t j = i; j < o->m; j++) {
            nh_ex sum = nh_int(d, 0);
            for (size_t k = 0; k < c->screws; k++)
                for (size_t l = 0; l < c->screws; l++) {
                    if (nh_is_zero(d, B[i * c->screws + k]) || nh_is_zero(d, B[j * c->screws + l])) continue;
                    sum = nh_add(
                        d, sum,
                        nh_mul(d, nh_mul(d, B[i * c->screws + k], B[j * c->screws + l]), c->metric[k * c->screws + l]));
                }
            c->K[i * o->m + j] = c->K[j * o->m + i] = sum;
        }
    nh_free(B);
}

void nh_chain_build(nh_chain *c, const nh_chain_scope *o)
{
    nh_ex moment[3];
    for (size_t k = 0; k < c->screws; k++)
        if (!c->screw[k].oriented) c->screw[k].rate = c->screw[k].framed = rate_of(o, c->screw[k].s);
    c->m = o->m;
    c->metric = nh_arena_alloc(o->arena, (c->screws * c->screws + 1) * sizeof *c->metric);
    c->K = nh_arena_alloc(o->arena, (o->m * o->m + 1) * sizeof *c->K);
    build_poses(c, o->dag);
    build_metric(c, o->dag, o->arena, moment);
    c->kinetic = kinetic_energy(c, o->dag, false);
    c->framed = kinetic_energy(c, o->dag, true);
    c->potential = nh_tidy(o->dag, nh_neg(o->dag, nh_dot(o->dag, c->gravity, moment)));
    metric_of_coordinates(c, o);
}
