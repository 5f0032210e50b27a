#include "reduction/joint_fields.h"

#include <string.h>

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "reduction/joint.h"

enum { most_fields = 200 };

typedef struct {
    const nh_system *system;
    const nh_chain *chain;
    nh_dag *dag;
    const nh_joint *joint;
    size_t n;
    nh_twist basis[NH_MOST_SCREWS];
    nh_joint_rates *rates;
    size_t points;
    nh_ex point[3][3]; /* in the body's frame */
    nh_joint_fields *out;
} work;

/* ---- one field ---- */

/* Is xi a combination of the basis?  It subtracts the part along each basis twist in turn: for a basis that is not
 * orthogonal the answer may be no although xi is a combination. */
static bool inside(const work *w, const nh_twist *xi)
{
    nh_dag *d = w->dag;
    nh_twist off = *xi;
    for (size_t k = 0; k < w->n; k++) {
        const nh_twist *b = &w->basis[k];
        nh_ex size = nh_add(d, nh_dot(d, b->v, b->v), nh_dot(d, b->w, b->w));
        nh_ex part = nh_div(d, nh_add(d, nh_dot(d, b->v, xi->v), nh_dot(d, b->w, xi->w)), size);
        for (int i = 0; i < 3; i++) {
            off.v[i] = nh_sub(d, off.v[i], nh_mul(d, part, b->v[i]));
            off.w[i] = nh_sub(d, off.w[i], nh_mul(d, part, b->w[i]));
        }
    }
    for (int i = 0; i < 3; i++)
        if (!nh_is_zero(d, nh_simplify(d, off.v[i])) || !nh_is_zero(d, nh_simplify(d, off.w[i]))) return false;
    return true;
}

/* Is the field in the list? */
static bool known(const nh_joint_fields *f, const nh_ex *component)
{
    for (size_t i = 0; i < f->count; i++)
        if (!memcmp(f->component + i * f->m, component, f->m * sizeof *component)) return true;
    return false;
}

/* -d/dy counts as d/dy. */
static void turn_round(const work *w, nh_ex *component)
{
    size_t i = 0, m = w->out->m;
    while (i + 1 < m && nh_is_zero(w->dag, component[i])) i++;
    for (size_t j = 0; j < m && nh_is_number(w->dag, component[i], -1); j++)
        if (j != i) component[j] = nh_neg(w->dag, component[j]);
    if (nh_is_number(w->dag, component[i], -1)) component[i] = nh_int(w->dag, 1);
}

/* The field with E^-1 E' = xi of this joint, all others at rest. */
static void add(work *w, const nh_twist *xi)
{
    nh_joint_fields *f = w->out;
    nh_ex rate[NH_MOST_SCREWS], *component = f->component + f->count * f->m;
    bool good = f->count < most_fields, zero = true;
    if (!good) return;
    nh_joint_rates_of(w->rates, xi, rate);
    for (size_t i = 0; i < f->m; i++) component[i] = nh_int(w->dag, 0);
    for (size_t k = 0; k < w->n; k++) {
        component[w->chain->screw[w->joint->first + k].coordinate] = rate[k];
        good &= !nh_depends(w->dag, rate[k], w->system->t);
        zero &= nh_is_zero(w->dag, rate[k]);
    }
    turn_round(w, component);
    f->count += good && !zero && !known(f, component);
}

/* ---- displacements fixed in the frame of a body before the joint ---- */

static nh_twist unit_twist(nh_dag *d, size_t i)
{
    nh_twist t;
    for (size_t k = 0; k < 3; k++) t.v[k] = nh_int(d, k == i), t.w[k] = nh_int(d, k + 3 == i);
    return t;
}

static bool turns(nh_dag *d, const nh_twist *t)
{
    return !nh_is_zero(d, t->w[0]) || !nh_is_zero(d, t->w[1]) || !nh_is_zero(d, t->w[2]);
}

/* Adds c, in the frame in which `pose` is that of the body: unchanged, and turned about the points of the body. */
static void add_fixed(work *w, const nh_pose *pose, const nh_twist *c)
{
    nh_dag *d = w->dag;
    nh_twist xi = nh_twist_inwards(d, pose, c);
    if (inside(w, &xi)) add(w, &xi);
    for (size_t i = 0; i < w->points && turns(d, c); i++) {
        nh_twist about = xi;
        nh_cross(d, w->point[i], xi.w, about.v);
        if (inside(w, &about)) add(w, &about);
    }
}

static bool is_turned(const work *w)
{
    nh_pose identity = nh_pose_identity(w->dag);
    return memcmp(identity.R, w->joint->placement.R, sizeof identity.R);
}

/* P: the joint's frame in that of a body before it. */
static void fixed_in(work *w, const nh_pose *P, const nh_pose *E, bool own)
{
    nh_dag *d = w->dag;
    nh_pose all = nh_pose_product(d, P, E), P0 = nh_joint_at_rest(w->system, P), since = nh_pose_between(d, &P0, &all);
    for (size_t k = 0; k < w->n && own; k++) add_fixed(w, &since, &w->basis[k]);
    for (size_t i = 0; i < 6; i++) {
        nh_twist c = unit_twist(d, i);
        add_fixed(w, &all, &c);
    }
    for (size_t k = 0; k < w->n && !own; k++) add_fixed(w, &since, &w->basis[k]);
}

/* From the parent to the ground. */
static void fixed_before(work *w)
{
    const nh_chain *c = w->chain;
    nh_dag *d = w->dag;
    nh_pose E = nh_joint_pose(d, c, w->joint), P = w->joint->placement;
    bool own = !is_turned(w); /* otherwise the axes of the ground first: gravity is given in these */
    for (long body = w->joint->parent;;) {
        fixed_in(w, &P, &E, own);
        if (body == NH_GROUND) break;
        const nh_joint *before = &c->joint[c->body[body].joint];
        nh_pose step = nh_joint_pose(d, c, before);
        step = nh_pose_product(d, &before->placement, &step);
        P = nh_pose_product(d, &step, &P);
        body = before->parent;
    }
}

/* ---- points of the body ---- */

/* Mass and first moment of a body and all behind it, in its frame. */
static void moment_behind(const work *w, size_t body, nh_ex *mass, nh_ex h[3])
{
    const nh_chain *c = w->chain;
    nh_dag *d = w->dag;
    *mass = c->body[body].mass;
    for (int i = 0; i < 3; i++) h[i] = nh_mul(d, *mass, c->body[body].center[i]);
    for (size_t j = 0; j < c->joints; j++) {
        nh_ex m, own[3], x[3];
        if (c->joint[j].parent != (long)body) continue;
        nh_pose E = nh_joint_pose(d, c, &c->joint[j]), pose = nh_pose_product(d, &c->joint[j].placement, &E);
        moment_behind(w, c->joint[j].child, &m, own);
        nh_rotate(d, pose.R, false, own, x);
        for (int i = 0; i < 3; i++) h[i] = nh_add(d, h[i], nh_add(d, x[i], nh_mul(d, m, pose.p[i])));
        *mass = nh_add(d, *mass, m);
    }
}

static void add_point(work *w, const nh_ex p[3])
{
    for (size_t i = 0; i < w->points; i++)
        if (!memcmp(w->point[i], p, sizeof w->point[i])) return;
    memcpy(w->point[w->points++], p, 3 * sizeof *p);
}

static void points(work *w)
{
    nh_dag *d = w->dag;
    nh_ex zero[3] = {nh_int(d, 0), nh_int(d, 0), nh_int(d, 0)}, p[3], mass;
    w->points = 0;
    add_point(w, zero);
    add_point(w, w->chain->body[w->joint->child].center);
    moment_behind(w, w->joint->child, &mass, p);
    if (nh_is_zero(d, mass)) return;
    for (int i = 0; i < 3; i++) p[i] = nh_simplify(d, nh_div(d, p[i], mass));
    add_point(w, p);
}

void nh_joint_fields_init(nh_joint_fields *out, const nh_system *system)
{
    const nh_chain *c = system->chain;
    *out = (nh_joint_fields){.m = system->coordinates};
    if (!c) return;
    out->component = nh_alloc_array((most_fields + 1) * out->m + 1, sizeof *out->component);
    for (size_t i = 0; i < c->joints; i++) {
        work w = {.system = system, .chain = c, .dag = system->dag, .joint = &c->joint[c->order[i]], .out = out};
        bool free = w.joint->screws > 0;
        for (size_t k = 0; k < w.joint->screws; k++) free &= c->screw[w.joint->first + k].coordinate >= 0;
        if (!free || !(w.rates = nh_joint_rates_create(system, w.joint))) continue;
        w.n = nh_joint_basis(system->dag, c, w.joint, w.basis);
        points(&w);
        fixed_before(&w);
        for (size_t k = 0; k < w.n; k++) add(&w, &w.basis[k]);
        nh_joint_rates_free(w.rates);
    }
}

void nh_joint_fields_clear(nh_joint_fields *f)
{
    nh_free(f->component);
    *f = (nh_joint_fields){0};
}
