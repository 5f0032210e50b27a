#include "problem/drawing.h"

#include "graph/dag.h"
#include "graph/function.h"

/* e, or 0 where it is negative. */
static nh_ex positive(nh_dag *d, nh_ex e) { return nh_mul(d, nh_ratio(d, 1, 2), nh_add(d, e, nh_call(d, NH_ABS, e))); }

/* Edges of a box: I_x = m (b^2 + c^2)/12, so a^2 = 6 (I_y + I_z - I_x)/m. */
static bool edges(nh_dag *d, const nh_body *b, nh_ex out[3])
{
    enum { factor = 6 };
    bool any = false;
    if (nh_is_zero(d, b->mass)) return false;
    for (size_t e = 0; e < 3; e++) {
        nh_ex own = b->inertia[4 * e], sum = nh_int(d, 0);
        for (size_t k = 0; k < 3; k++) sum = nh_add(d, sum, k == e ? nh_neg(d, own) : b->inertia[4 * k]);
        out[e] = nh_sqrt(d, positive(d, nh_div(d, nh_mul(d, nh_int(d, factor), sum), b->mass)));
        any |= !nh_is_zero(d, own);
    }
    return any;
}

/* The third axis along the axle: u = a x e, a x u, a with a unit vector e across a. */
static nh_pose about_axle(nh_dag *d, const nh_pose *pose, const nh_wheel *w)
{
    nh_pose own = nh_pose_identity(d);
    nh_ex e[3], u[3], v[3];
    size_t across = 0;
    for (size_t k = 3; k-- > 0;)
        if (nh_is_zero(d, w->axis[k])) across = k;
    for (size_t k = 0; k < 3; k++) e[k] = nh_int(d, k == across);
    nh_cross(d, w->axis, e, u);
    nh_ex length = nh_sqrt(d, nh_dot(d, u, u));
    for (size_t k = 0; k < 3; k++) u[k] = nh_div(d, u[k], length);
    nh_cross(d, w->axis, u, v);
    for (size_t k = 0; k < 3; k++)
        own.R[3 * k] = u[k], own.R[3 * k + 1] = v[k], own.R[3 * k + 2] = w->axis[k], own.p[k] = w->at[k];
    return nh_pose_product(d, pose, &own);
}

nh_shape nh_solid_of_body(nh_dag *d, const nh_chain *c, size_t i)
{
    enum { thin = 5 }; /* the height of a wheel in its radius, upside down */
    const nh_body *b = &c->body[i];
    nh_pose pose = b->pose;
    nh_ex size[3] = {nh_int(d, 0), nh_int(d, 0), nh_int(d, 0)};
    for (size_t k = 0; k < c->wheels; k++) {
        const nh_wheel *w = &c->wheel[k];
        if (w->body != i || w->kind != NH_WHEEL_ROLLING) continue;
        size[0] = w->radius;
        size[1] = nh_div(d, w->radius, nh_int(d, thin));
        nh_pose_point(d, &b->pose, w->at, pose.p);
        if (w->ball) return nh_shape_solid(NH_SHAPE_BALL, b->name, &pose, size);
        pose = about_axle(d, &b->pose, w);
        return nh_shape_solid(NH_SHAPE_CYLINDER, b->name, &pose, size);
    }
    for (size_t k = 0; k < 3; k++) pose.p[k] = b->position[k];
    return nh_shape_solid(edges(d, b, size) ? NH_SHAPE_BOX : NH_SHAPE_BALL, b->name, &pose, size);
}
