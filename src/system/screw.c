#include "system/screw.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"

/* largest complexity that is simplified: that of a product of two rotation matrices, not of five */
enum { short_enough = 150 };

nh_ex nh_tidy(nh_dag *d, nh_ex e) { return nh_simplify_short(d, e, short_enough); }

/* ---- vectors ---- */

nh_ex nh_dot(nh_dag *d, const nh_ex a[3], const nh_ex b[3])
{
    nh_ex sum = nh_int(d, 0);
    for (int i = 0; i < 3; i++) sum = nh_add(d, sum, nh_mul(d, a[i], b[i]));
    return sum;
}

void nh_cross(nh_dag *d, const nh_ex a[3], const nh_ex b[3], nh_ex out[3])
{
    nh_ex result[3];
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        result[i] = nh_sub(d, nh_mul(d, a[j], b[k]), nh_mul(d, a[k], b[j]));
    }
    memcpy(out, result, sizeof result);
}

void nh_rotate(nh_dag *d, const nh_ex R[9], bool transposed, const nh_ex x[3], nh_ex out[3])
{
    nh_ex result[3];
    for (int i = 0; i < 3; i++) {
        nh_ex row[3];
        for (int j = 0; j < 3; j++) row[j] = transposed ? R[3 * j + i] : R[3 * i + j];
        result[i] = nh_tidy(d, nh_dot(d, row, x));
    }
    memcpy(out, result, sizeof result);
}

/* out := a + b, entry by entry, tidied. */
static void sum(nh_dag *d, size_t n, const nh_ex *a, const nh_ex *b, nh_ex *out)
{
    for (size_t i = 0; i < n; i++) out[i] = nh_tidy(d, nh_add(d, a[i], b[i]));
}

static bool is_identity(const nh_dag *d, const nh_ex R[9])
{
    for (int i = 0; i < 9; i++)
        if (!nh_is_number(d, R[i], i % 4 == 0)) return false;
    return true;
}

/* ---- poses ---- */

nh_pose nh_pose_identity(nh_dag *d)
{
    nh_pose a;
    for (int i = 0; i < 9; i++) a.R[i] = nh_int(d, i % 4 == 0);
    for (int i = 0; i < 3; i++) a.p[i] = nh_int(d, 0);
    return a;
}

/* R = u u^T + cos(angle) (1 - u u^T) + sin(angle) [u x]   (Rodrigues) */
nh_pose nh_pose_turn(nh_dag *d, const nh_ex u[3], nh_ex angle)
{
    nh_pose a = nh_pose_identity(d);
    nh_ex c = nh_call(d, NH_COS, angle), s = nh_call(d, NH_SIN, angle);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            nh_ex uu = nh_mul(d, u[i], u[j]), across = nh_tidy(d, nh_sub(d, nh_int(d, i == j), uu)),
                  e = nh_add(d, uu, nh_mul(d, c, across));
            int k = 3 - i - j;
            if (i != j) e = nh_add(d, e, nh_mul(d, nh_mul(d, s, u[k]), nh_int(d, (j - i + 3) % 3 == 1 ? -1 : 1)));
            a.R[3 * i + j] = nh_tidy(d, e);
        }
    return a;
}

nh_pose nh_pose_shift(nh_dag *d, const nh_ex shift[3])
{
    nh_pose a = nh_pose_identity(d);
    memcpy(a.p, shift, sizeof a.p);
    return a;
}

void nh_pose_point(nh_dag *d, const nh_pose *a, const nh_ex x[3], nh_ex out[3])
{
    nh_ex turned[3];
    nh_rotate(d, a->R, false, x, turned);
    sum(d, 3, turned, a->p, out);
}

nh_pose nh_pose_product(nh_dag *d, const nh_pose *a, const nh_pose *b)
{
    nh_pose c;
    for (int j = 0; j < 3; j++) {
        nh_ex column[3] = {b->R[j], b->R[3 + j], b->R[6 + j]};
        nh_rotate(d, a->R, false, column, column);
        for (int i = 0; i < 3; i++) c.R[3 * i + j] = column[i];
    }
    nh_pose_point(d, a, b->p, c.p);
    return c;
}

/* (R_a^T R_b, R_a^T (p_b - p_a)) */
nh_pose nh_pose_between(nh_dag *d, const nh_pose *a, const nh_pose *b)
{
    nh_pose back;
    nh_ex from[3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) back.R[3 * i + j] = a->R[3 * j + i];
        from[i] = nh_neg(d, a->p[i]);
    }
    nh_rotate(d, a->R, true, from, back.p);
    return nh_pose_product(d, &back, b);
}

/* ---- twists, wrenches ---- */

/* (R^T (v + w x p), R^T w) */
nh_twist nh_twist_inwards(nh_dag *d, const nh_pose *a, const nh_twist *t)
{
    nh_twist out;
    nh_ex v[3];
    nh_cross(d, t->w, a->p, v);
    for (int i = 0; i < 3; i++) v[i] = nh_add(d, t->v[i], v[i]);
    nh_rotate(d, a->R, true, v, out.v);
    nh_rotate(d, a->R, true, t->w, out.w);
    return out;
}

/* (R p, R L + d x R p) */
nh_wrench nh_wrench_outwards(nh_dag *d, const nh_pose *a, const nh_wrench *f)
{
    nh_wrench out;
    nh_ex moment[3];
    nh_rotate(d, a->R, false, f->p, out.p);
    nh_rotate(d, a->R, false, f->L, out.L);
    nh_cross(d, a->p, out.p, moment);
    sum(d, 3, out.L, moment, out.L);
    return out;
}

nh_ex nh_pairing(nh_dag *d, const nh_twist *t, const nh_wrench *f)
{
    return nh_add(d, nh_dot(d, t->v, f->p), nh_dot(d, t->w, f->L));
}

/* ---- inertias ---- */

static void turn_inertia(nh_dag *d, const nh_ex R[9], nh_inertia *c)
{
    nh_ex half[9];
    if (is_identity(d, R)) return;
    nh_rotate(d, R, false, c->h, c->h);
    for (int i = 0; i < 3; i++) nh_rotate(d, R, false, c->I + 3 * i, half + 3 * i); /* rows of I R^T, I = I^T */
    for (int j = 0; j < 3; j++) {
        nh_ex column[3] = {half[j], half[3 + j], half[6 + j]};
        nh_rotate(d, R, false, column, column);
        for (int i = 0; i <= j; i++) c->I[3 * i + j] = c->I[3 * j + i] = column[i];
    }
}

/* I + 2 (h.s) 1 - h s^T - s h^T + m (s.s 1 - s s^T),  h + m s */
static void shift_inertia(nh_dag *d, const nh_ex s[3], nh_inertia *c)
{
    nh_ex both[3]; /* 2 h + m s */
    for (int i = 0; i < 3; i++) both[i] = nh_add(d, nh_mul(d, nh_int(d, 2), c->h[i]), nh_mul(d, c->m, s[i]));
    nh_ex trace = nh_dot(d, both, s);
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            nh_ex e = nh_sub(d, c->I[3 * i + j], nh_add(d, nh_mul(d, c->h[i], s[j]), nh_mul(d, s[i], c->h[j])));
            e = nh_sub(d, e, nh_mul(d, c->m, nh_mul(d, s[i], s[j])));
            if (i == j) e = nh_add(d, e, trace);
            c->I[3 * i + j] = c->I[3 * j + i] = nh_tidy(d, e);
        }
    for (int i = 0; i < 3; i++) c->h[i] = nh_tidy(d, nh_add(d, c->h[i], nh_mul(d, c->m, s[i])));
}

nh_inertia nh_inertia_outwards(nh_dag *d, const nh_pose *a, const nh_inertia *c)
{
    nh_inertia out = *c;
    turn_inertia(d, a->R, &out);
    shift_inertia(d, a->p, &out);
    return out;
}

nh_inertia nh_inertia_sum(nh_dag *d, const nh_inertia *a, const nh_inertia *b)
{
    nh_inertia out;
    sum(d, 1, &a->m, &b->m, &out.m);
    sum(d, 3, a->h, b->h, out.h);
    sum(d, 9, a->I, b->I, out.I);
    return out;
}

nh_wrench nh_inertia_momentum(nh_dag *d, const nh_inertia *c, const nh_twist *t)
{
    nh_wrench out;
    nh_ex a[3], b[3];
    nh_cross(d, t->w, c->h, a);
    nh_cross(d, c->h, t->v, b);
    for (int i = 0; i < 3; i++) {
        out.p[i] = nh_tidy(d, nh_add(d, nh_mul(d, c->m, t->v[i]), a[i]));
        out.L[i] = nh_tidy(d, nh_add(d, b[i], nh_dot(d, c->I + 3 * i, t->w)));
    }
    return out;
}
