/* wheels: the conditions of blades and rolling wheels, linear in the rates.
 *
 * A wheel's own turning about its axle changes neither its centre nor its axle.  So the conditions are written in the
 * frame before that turn, where its angle does not occur.  There, with the twist (v, w) relative to the surface, the
 * centre c, the axle a, the surface's normal n and the radius r:
 *
 *     knife-edge    a . (v + w x c) = 0
 *     rolling       u = v + w x (c - r n_a) = 0,   n_a = (n - (n.a) a) / |n - (n.a) a|
 *
 * The last component of u is the rate of the height n . (p + c - r n_a): n . n_a = sqrt(1 - (n.a)^2) changes at the
 * rate n . (w x n_a), as the axle turns with w.
 *
 * u is the velocity of the point of contact; n_a, in the wheel's plane, points up from there to the centre
 * [NeimarkFufaev1972, ch. III].  Its components are taken along a x n (forward), n x (a x n) (sideways) and n. */
#include <string.h>

#include "graph/dag.h"
#include "system/bodies.h"

typedef struct {
    nh_dag *dag;
    nh_pose pose;        /* of the frame before the turn, in the ground's frame */
    nh_twist twist;      /* relative to the surface; w with the turn */
    nh_ex n[3];          /* the surface's normal */
    nh_ex height;        /* of the frame's origin above the surface */
    nh_ex tangent[2][3]; /* the surface's own axes across it */
} station;

static bool same(const nh_ex a[3], const nh_ex b[3]) { return !memcmp(a, b, 3 * sizeof *a); }

/* Does the turn of a screw leave centre and axle where they are?  A ball has no axle. */
static bool leaves_alone(nh_dag *d, const nh_wheel *w, const nh_screw *s)
{
    nh_ex off[3], back[3];
    if (!s->turns || !nh_is_zero(d, s->pitch)) return false;
    nh_cross(d, s->axis, w->at, off);
    for (int i = 0; i < 3; i++) {
        if (!nh_is_zero(d, nh_tidy(d, off[i]))) return false;
        back[i] = nh_neg(d, w->axis[i]);
    }
    return w->ball || same(s->axis, w->axis) || same(s->axis, back);
}

/* How many of the last screws are the wheel's own turning. */
static size_t own_turns(const nh_chain *c, nh_dag *d, const nh_wheel *w)
{
    const nh_joint *j = &c->joint[c->body[w->body].joint];
    size_t n = 0;
    while (n < j->screws && leaves_alone(d, w, &c->screw[j->first + j->screws - 1 - n])) n++;
    return n;
}

/* w + the rates of the turns left out, in the frame before them. */
static void add_turns(const nh_chain *c, nh_dag *d, const nh_wheel *wheel, size_t skip, nh_ex w[3])
{
    const nh_joint *j = &c->joint[c->body[wheel->body].joint];
    nh_pose turned = nh_pose_identity(d);
    for (size_t k = j->screws - skip; k < j->screws; k++) {
        const nh_screw *s = &c->screw[j->first + k];
        nh_pose step = nh_screw_pose(d, s);
        nh_ex axis[3];
        turned = nh_pose_product(d, &turned, &step); /* which leaves the screw's own axis alone */
        nh_rotate(d, turned.R, false, s->axis, axis);
        for (int i = 0; i < 3; i++) w[i] = nh_add(d, w[i], nh_mul(d, axis[i], s->rate));
    }
}

static station stand(const nh_chain *c, nh_dag *d, const nh_wheel *w, size_t skip)
{
    station s = {.dag = d};
    nh_pose ground;
    nh_twist surface;
    nh_chain_frame(c, d, (long)w->body, skip, &s.pose, &s.twist);
    nh_chain_frame(c, d, w->on, 0, &ground, &surface);
    nh_pose relative = nh_pose_between(d, &ground, &s.pose);
    surface = nh_twist_inwards(d, &relative, &surface);
    s.height = relative.p[w->normal];
    for (int i = 0; i < 3; i++) {
        s.twist.v[i] = nh_sub(d, s.twist.v[i], surface.v[i]);
        s.twist.w[i] = nh_sub(d, s.twist.w[i], surface.w[i]);
        s.n[i] = relative.R[3 * w->normal + i]; /* R^T e_normal */
        for (int t = 0; t < 2; t++) s.tangent[t][i] = relative.R[3 * ((w->normal + 1 + t) % 3) + i];
    }
    add_turns(c, d, w, skip, s.twist.w);
    return s;
}

/* direction . (v + w x point) */
static nh_ex slip(const station *s, const nh_ex point[3], const nh_ex direction[3])
{
    nh_ex u[3];
    nh_cross(s->dag, s->twist.w, point, u);
    for (int i = 0; i < 3; i++) u[i] = nh_add(s->dag, s->twist.v[i], u[i]);
    return nh_dot(s->dag, direction, u);
}

/* n_a: a itself has no part in it. */
static void up_in_the_wheel(const station *s, const nh_wheel *w, nh_ex up[3])
{
    nh_dag *d = s->dag;
    memcpy(up, s->n, 3 * sizeof *up);
    nh_ex lean = w->ball ? nh_int(d, 0) : nh_tidy(d, nh_dot(d, s->n, w->axis));
    if (nh_is_zero(d, lean)) return;
    nh_ex size = nh_sqrt(d, nh_tidy(d, nh_sub(d, nh_int(d, 1), nh_powi(d, lean, 2))));
    for (int i = 0; i < 3; i++) up[i] = nh_tidy(d, nh_div(d, nh_sub(d, s->n[i], nh_mul(d, lean, w->axis[i])), size));
}

/* Does an orientation carry the wheel?  Forward and sideways would then be directions of its frame, in which no
 * component of the velocity has a coefficient without a zero. */
static bool on_orientation(const nh_chain *c, const nh_wheel *w)
{
    for (long b = (long)w->body; b != NH_GROUND; b = c->joint[c->body[b].joint].parent)
        if (c->joint[c->body[b].joint].orientation >= 0) return true;
    return false;
}

static void contact_of(const station *s, const nh_wheel *w, nh_ex contact[3])
{
    nh_ex up[3];
    up_in_the_wheel(s, w, up);
    for (int i = 0; i < 3; i++) contact[i] = nh_sub(s->dag, w->at[i], nh_mul(s->dag, w->radius, up[i]));
}

nh_ex nh_wheel_height(const nh_chain *c, nh_dag *d, const nh_wheel *w)
{
    nh_ex contact[3];
    station s = stand(c, d, w, own_turns(c, d, w));
    contact_of(&s, w, contact);
    return nh_add(d, s.height, nh_dot(d, s.n, contact));
}

bool nh_wheel_turns(const nh_chain *c, nh_dag *d, const nh_wheel *w) { return own_turns(c, d, w) > 0; }

size_t nh_wheel_conditions(const nh_chain *c, nh_dag *d, const nh_wheel *w, nh_ex out[3], nh_ex level[3])
{
    bool rolls = w->kind == NH_WHEEL_ROLLING;
    level[0] = level[1] = level[2] = 0;
    station s = stand(c, d, w, rolls ? own_turns(c, d, w) : 0);
    if (!rolls) {
        out[0] = slip(&s, w->at, w->axis);
        return 1;
    }
    nh_ex contact[3], direction[3][3];
    contact_of(&s, w, contact);
    memcpy(direction, s.tangent, sizeof s.tangent);
    if (!w->ball && !on_orientation(c, w)) {
        nh_cross(d, w->axis, s.n, direction[0]);
        nh_cross(d, s.n, direction[0], direction[1]);
    }
    memcpy(direction[2], s.n, sizeof s.n);
    for (int k = 0; k < 3; k++) out[k] = slip(&s, contact, direction[k]);
    level[2] = nh_add(d, s.height, nh_dot(d, s.n, contact));
    return 3;
}
