/* chain: random trees of bodies and joints, as the text of a system file and as numbers, and a recursion by hand for them.
 *
 * By hand: composite rigid bodies for the mass matrix, recursive Newton and Euler for the rest, Cholesky for the accelerations
 * [Featherstone2008, ch. 5 and 6], in plain doubles, one link per degree of freedom. */
#ifndef NH_TESTS_CHAIN_H
#define NH_TESTS_CHAIN_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "system/bodies.h"
#include "system/sample.h"

enum { most_links = 48, spatial = 6 };

/* One degree of freedom: a placement, then a screw; mass only where a body's joint ends. */
typedef struct {
    int parent;                       /* link, -1: the ground */
    double R[9], at[3];               /* placement in the parent's frame */
    double v[3], w[3];                /* screw */
    double m, center[3], inertia[9];  /* about the centre of mass */
} link;

typedef struct {
    size_t links, bodies;
    link link[most_links];
    int end[most_links]; /* last link of each body */
    double gravity[3];
} tree;

/* ---- small vectors ---- */

static inline void cross(const double *a, const double *b, double *out)
{
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    out[0] = x, out[1] = y, out[2] = z;
}

static inline double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* R x, or R^T x */
static inline void turned(const double *R, int transposed, const double *x, double *out)
{
    double y[3];
    for (int i = 0; i < 3; i++) y[i] = transposed ? R[i] * x[0] + R[3 + i] * x[1] + R[6 + i] * x[2] : dot(R + 3 * i, x);
    memcpy(out, y, sizeof y);
}

static inline void multiplied(const double *A, const double *B, double *out)
{
    double C[9];
    for (int i = 0; i < 9; i++) C[i] = A[i / 3 * 3] * B[i % 3] + A[i / 3 * 3 + 1] * B[3 + i % 3] + A[i / 3 * 3 + 2] * B[6 + i % 3];
    memcpy(out, C, sizeof C);
}

/* exp of the screw (v, w) q, |w| = 1 or 0, v along w where w is not 0. */
static inline void displacement(const link *l, double q, double *R, double *p)
{
    double s = sin(q), c = cos(q), one = dot(l->w, l->w);
    for (int i = 0; i < 3; i++) {
        p[i] = l->v[i] * q;
        for (int j = 0; j < 3; j++) R[3 * i + j] = one == 0 ? i == j : (1 - c) * l->w[i] * l->w[j] + c * (i == j);
        if (one == 0) continue;
        R[3 * i + (i + 1) % 3] -= s * l->w[(i + 2) % 3];
        R[3 * i + (i + 2) % 3] += s * l->w[(i + 1) % 3];
    }
}

/* Of each link in its parent's frame. */
typedef struct {
    double R[9], p[3];
} placed;

static inline placed place(const link *l, double q)
{
    placed x;
    double R[9], p[3];
    displacement(l, q, R, p);
    multiplied(l->R, R, x.R);
    turned(l->R, 0, p, x.p);
    for (int i = 0; i < 3; i++) x.p[i] += l->at[i];
    return x;
}

/* ---- the recursion ---- */

typedef struct {
    double m, h[3], I[9];
} lump;

static inline lump lump_of(const link *l)
{
    lump c = {.m = l->m};
    double cc = dot(l->center, l->center);
    for (int i = 0; i < 3; i++) c.h[i] = l->m * l->center[i];
    for (int i = 0; i < 9; i++) c.I[i] = l->inertia[i] + l->m * ((i % 4 == 0) * cc - l->center[i / 3] * l->center[i % 3]);
    return c;
}

/* Momentum of a lump with the twist (v, w). */
static inline void momentum(const lump *c, const double *v, const double *w, double *p, double *L)
{
    double a[3], b[3], k[3];
    cross(w, c->h, a);
    cross(c->h, v, b);
    turned(c->I, 0, w, k);
    for (int i = 0; i < 3; i++) p[i] = c->m * v[i] + a[i], L[i] = b[i] + k[i];
}

static inline void outwards(const placed *x, double *p, double *L)
{
    double moment[3];
    turned(x->R, 0, p, p);
    turned(x->R, 0, L, L);
    cross(x->p, p, moment);
    for (int i = 0; i < 3; i++) L[i] += moment[i];
}

static inline void inwards(const placed *x, const double *v, const double *w, double *v_out, double *w_out)
{
    double u[3];
    cross(w, x->p, u);
    for (int i = 0; i < 3; i++) u[i] += v[i];
    turned(x->R, 1, u, v_out);
    turned(x->R, 1, w, w_out);
}

static inline void gather(const placed *x, const lump *c, lump *into)
{
    double I[9], T[9], Rt[9], h[3], hx;
    for (int i = 0; i < 9; i++) Rt[i] = x->R[i % 3 * 3 + i / 3];
    multiplied(x->R, c->I, T);
    multiplied(T, Rt, I);
    turned(x->R, 0, c->h, h);
    hx = 2 * dot(h, x->p) + c->m * dot(x->p, x->p);
    for (int i = 0; i < 9; i++)
        into->I[i] += I[i] + (i % 4 == 0) * hx - h[i / 3] * x->p[i % 3] - x->p[i / 3] * h[i % 3] - c->m * x->p[i / 3] * x->p[i % 3];
    for (int i = 0; i < 3; i++) into->h[i] += h[i] + c->m * x->p[i];
    into->m += c->m;
}

/* The mass matrix, n x n. */
static inline void mass_matrix(const tree *t, const placed *x, double *M)
{
    lump c[most_links];
    size_t n = t->links;
    for (size_t i = 0; i < n; i++) c[i] = lump_of(&t->link[i]);
    for (size_t i = n; i-- > 0;)
        if (t->link[i].parent >= 0) gather(&x[i], &c[i], &c[t->link[i].parent]);
    memset(M, 0, n * n * sizeof *M);
    for (size_t i = 0; i < n; i++) {
        double p[3], L[3];
        momentum(&c[i], t->link[i].v, t->link[i].w, p, L);
        for (int j = (int)i; j >= 0; j = t->link[j].parent) {
            M[i * n + (size_t)j] = M[(size_t)j * n + i] = dot(t->link[j].v, p) + dot(t->link[j].w, L);
            outwards(&x[j], p, L);
        }
    }
}

/* The forces that hold the accelerations at zero: c(q, q') + gravity. */
static inline void bias(const tree *t, const placed *x, const double *rate, double *out)
{
    double v[most_links][3], w[most_links][3], a[most_links][3], b[most_links][3], f[most_links][3], g[most_links][3];
    const double still[3] = {0, 0, 0}, up[3] = {-t->gravity[0], -t->gravity[1], -t->gravity[2]};
    for (size_t i = 0; i < t->links; i++) {
        const link *l = &t->link[i];
        int o = l->parent;
        inwards(&x[i], o < 0 ? still : v[o], o < 0 ? still : w[o], v[i], w[i]);
        inwards(&x[i], o < 0 ? up : a[o], o < 0 ? still : b[o], a[i], b[i]);
        double sv[3], sw[3], k1[3], k2[3], k3[3];
        for (int e = 0; e < 3; e++) sv[e] = l->v[e] * rate[i], sw[e] = l->w[e] * rate[i];
        cross(w[i], sv, k1); /* ad of the twist on the screw's rate */
        cross(v[i], sw, k2);
        cross(w[i], sw, k3);
        for (int e = 0; e < 3; e++) {
            a[i][e] += k1[e] + k2[e];
            b[i][e] += k3[e];
            v[i][e] += sv[e];
            w[i][e] += sw[e];
        }
        lump c = lump_of(l);
        double p[3], L[3];
        momentum(&c, a[i], b[i], f[i], g[i]);
        momentum(&c, v[i], w[i], p, L);
        cross(w[i], p, k1);
        cross(w[i], L, k2);
        cross(v[i], p, k3);
        for (int e = 0; e < 3; e++) f[i][e] += k1[e], g[i][e] += k2[e] + k3[e];
    }
    for (size_t i = t->links; i-- > 0;) {
        out[i] = dot(t->link[i].v, f[i]) + dot(t->link[i].w, g[i]);
        int o = t->link[i].parent;
        if (o < 0) continue;
        outwards(&x[i], f[i], g[i]);
        for (int e = 0; e < 3; e++) f[o][e] += f[i][e], g[o][e] += g[i][e];
    }
}

/* Accelerations of free motion; M is the mass matrix on return, its triangle overwritten by the Cholesky factor in L. */
static inline void accelerations_by_hand(const tree *t, const double *q, const double *rate, double *M, double *out)
{
    placed x[most_links];
    double L[most_links * most_links];
    size_t n = t->links;
    for (size_t i = 0; i < n; i++) x[i] = place(&t->link[i], q[i]);
    mass_matrix(t, x, M);
    bias(t, x, rate, out);
    for (size_t j = 0; j < n; j++)
        for (size_t i = j; i < n; i++) {
            double sum = M[i * n + j];
            for (size_t k = 0; k < j; k++) sum -= L[i * n + k] * L[j * n + k];
            L[i * n + j] = i == j ? sqrt(sum) : sum / L[j * n + j];
        }
    for (size_t i = 0; i < n; i++) {
        double sum = -out[i];
        for (size_t k = 0; k < i; k++) sum -= L[i * n + k] * out[k];
        out[i] = sum / L[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
        double sum = out[i];
        for (size_t k = i + 1; k < n; k++) sum -= L[k * n + i] * out[k];
        out[i] = sum / L[i * n + i];
    }
}

/* ---- random trees ---- */

static inline double between(uint64_t *seed, double low, double high) { return low + (high - low) * nh_random(seed); }

static inline void unit(int axis, double *out)
{
    for (int i = 0; i < 3; i++) out[i] = i == axis;
}

/* The screws of a joint kind: turns as in src/system/bodies.h. */
typedef struct {
    const char *type, *keys;
    size_t screws;
    int turn[6], axis[6];
    double pitch;
} joint_form;

static const joint_form FORMS[] = {
    {"revolute", "axis: y", 1, {1}, {1}, 0},
    {"prismatic", "axis: x", 1, {0}, {0}, 0},
    {"helical", "axis: z, pitch: 0.37", 1, {1}, {2}, 0.37},
    {"cylindrical", "axis: x", 2, {0, 1}, {0, 0}, 0},
    {"planar", "axis: y", 3, {0, 0, 1}, {2, 0, 1}, 0},
    {"spherical", "angles: zxz", 3, {1, 1, 1}, {2, 0, 2}, 0},
    {"free", "angles: xyz", 6, {0, 0, 0, 1, 1, 1}, {0, 1, 2, 0, 1, 2}, 0},
    {"translation", "axes: [y, x]", 2, {0, 0}, {1, 0}, 0},
    {"translation", "axes: [z, x, y]", 3, {0, 0, 0}, {2, 0, 1}, 0},
    {"schoenflies", "axis: y", 4, {0, 0, 0, 1}, {0, 1, 2, 1}, 0},
    {"translating-screw", "axis: x, pitch: -0.23", 3, {0, 0, 1}, {1, 2, 0}, -0.23},
};
enum { forms = sizeof FORMS / sizeof *FORMS };

/* Append a body behind `parent` (-1: ground) to the tree and its lines to the two lists; coordinates are q0, q1, ... in order. */
static inline void grow(tree *t, int parent, const joint_form *f, uint64_t *seed, nh_text *bodies, nh_text *joints)
{
    double at[3], angle[2], m = between(seed, 0.5, 2), c[3], I[9], k[3];
    link turn[2] = {{.w = {0, 0, 1}}, {.w = {1, 0, 0}}};
    double R[9], S[9], p[3];
    size_t name = t->bodies;
    for (int i = 0; i < 3; i++) at[i] = between(seed, -1, 1), c[i] = between(seed, -0.5, 0.5), k[i] = between(seed, 0.3, 0.6);
    for (int i = 0; i < 2; i++) angle[i] = between(seed, -1, 1);
    for (int i = 0; i < 9; i++) I[i] = i % 4 == 0 ? k[0] + k[1] + k[2] - k[i / 4] : -0.1 * k[3 - i / 3 - i % 3];
    displacement(&turn[0], angle[0], R, p);
    displacement(&turn[1], angle[1], S, p);
    multiplied(R, S, R);
    nh_text_addf(bodies, "  - {name: b%zu, mass: %.17g, center: [%.17g, %.17g, %.17g], inertia: [[%.17g, %.17g, %.17g], [%.17g, %.17g, %.17g], [%.17g, %.17g, %.17g]]}\n", name, m,
                 c[0], c[1], c[2], I[0], I[1], I[2], I[3], I[4], I[5], I[6], I[7], I[8]);
    nh_text_addf(joints, "  - {type: %s, child: b%zu, at: [%.17g, %.17g, %.17g], rotation: [{z: %.17g}, {x: %.17g}], %s, coordinates: [", f->type, name, at[0], at[1], at[2], angle[0], angle[1], f->keys);
    for (size_t i = 0; i < f->screws; i++) {
        link *l = &t->link[t->links];
        *l = (link){.parent = i ? (int)t->links - 1 : parent < 0 ? -1 : t->end[parent]};
        for (int e = 0; e < 9; e++) l->R[e] = i ? e % 4 == 0 : R[e];
        if (!i) memcpy(l->at, at, sizeof at);
        unit(f->axis[i], f->turn[i] ? l->w : l->v);
        if (f->turn[i])
            for (int e = 0; e < 3; e++) l->v[e] = f->pitch * l->w[e];
        nh_text_addf(joints, "%sq%zu", i ? ", " : "", t->links++);
    }
    if (parent < 0) nh_text_add(joints, "]}\n");
    else nh_text_addf(joints, "], parent: b%d}\n", parent);
    link *last = &t->link[t->links - 1];
    last->m = m;
    memcpy(last->center, c, sizeof c);
    memcpy(last->inertia, I, sizeof I);
    t->end[t->bodies++] = (int)t->links - 1;
}

static inline char *tree_text(const tree *t, const nh_text *bodies, const nh_text *joints)
{
    nh_text all;
    nh_text_init(&all);
    nh_text_addf(&all, "name: tree\ngravity: [%.17g, %.17g, %.17g]\nbodies:\n%sjoints:\n%s", t->gravity[0], t->gravity[1], t->gravity[2], nh_text_string(bodies), nh_text_string(joints));
    return all.data;
}

/* A chain of n bodies on revolute joints, axes turned from one to the next; the text is the caller's. */
static inline char *revolute_chain(tree *t, size_t n, uint64_t seed)
{
    nh_text bodies, joints;
    nh_text_init(&bodies);
    nh_text_init(&joints);
    *t = (tree){.gravity = {0.3, -0.2, -9.81}};
    for (size_t i = 0; i < n; i++) grow(t, (int)i - 1, &FORMS[0], &seed, &bodies, &joints);
    char *text = tree_text(t, &bodies, &joints);
    nh_text_clear(&bodies);
    nh_text_clear(&joints);
    return text;
}

#endif
