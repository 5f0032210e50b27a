/* reduce_named: the stages as they are printed and exported.
 *
 * A shape coordinate x that the group moves is a coordinate on the slice: along a motion it is not the file's x, but
 * that of the place where the orbit meets the slice.  In what is printed it is called x_s, its velocity x_s', its
 * momentum p_x_s; for computations the stages keep the symbols of the coordinates. */
#include <string.h>

#include "commands/reduce_internal.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"

typedef struct {
    const nh_kinetic *k;
    size_t n; /* of from and to */
    nh_ex *from, *to;
    const char **name; /* m: the new name of each coordinate, or NULL */
} renaming;

static nh_ex one(const renaming *w, nh_ex e) { return nh_substitute(w->k->dag, e, w->n, w->from, w->to); }

static nh_ex *all(const renaming *w, size_t n, const nh_ex *e)
{
    nh_ex *out = nh_arena_alloc(w->k->arena, (n + 1) * sizeof *out);
    for (size_t i = 0; i < n && e; i++) out[i] = one(w, e[i]);
    return e ? out : NULL;
}

/* ---- the parts of a stage ---- */

static const char *momentum(const renaming *w, const nh_reduced *o, size_t j)
{
    for (size_t s = 0; s < w->k->m; s++)
        if (w->name[s] && o->w[j] == w->k->v[s]) return nh_kinetic_unused_name(w->k, "p_%s", w->name[s]);
    return o->momentum[j];
}

static nh_reduced reduced(const renaming *w, const nh_reduced *o)
{
    nh_reduced out = *o;
    out.momentum = nh_arena_alloc(w->k->arena, (o->r + 1) * sizeof *out.momentum);
    for (size_t j = 0; j < o->r; j++) out.momentum[j] = momentum(w, o, j);
    out.x = all(w, o->n, o->x), out.w = all(w, o->r, o->w);
    out.M = all(w, o->r * o->r, o->M), out.dx = all(w, o->n, o->dx);
    out.F = all(w, o->r, o->F), out.zeta = all(w, o->d, o->zeta);
    out.energy = one(w, o->energy);
    return out;
}

static nh_slice slice(const renaming *w, const nh_slice *s)
{
    nh_slice out = *s;
    out.x = all(w, s->n, s->x), out.E = all(w, s->m * s->d, s->E);
    out.K = all(w, s->m * s->m, s->K), out.V = one(w, s->V);
    out.omega = all(w, s->f * s->m, s->omega);
    out.a = all(w, s->m, s->a), out.b = all(w, s->f, s->b);
    return out;
}

static const nh_chaplygin *chaplygin(const renaming *w, const nh_chaplygin *c, const nh_slice *own)
{
    size_t n = c->n, d = c->d;
    nh_chaplygin *out = nh_arena_alloc(w->k->arena, sizeof *out);
    *out = *c;
    out->slice = own;
    out->A = all(w, d * n, c->A), out->B = all(w, d * n * n, c->B), out->K = all(w, n * n, c->K);
    out->J = all(w, d * n, c->J), out->U = all(w, n * n * n, c->U), out->V = one(w, c->V);
    out->A0 = all(w, d, c->A0), out->J0 = all(w, d, c->J0), out->B0 = all(w, d * n, c->B0);
    out->a = all(w, n, c->a), out->force = all(w, n, c->force);
    out->reduced = reduced(w, &c->reduced);
    return out;
}

static const nh_second *second(const renaming *w, const nh_second *t)
{
    size_t n = t->n, d = t->d;
    nh_second *out = nh_arena_alloc(w->k->arena, sizeof *out);
    *out = *t;
    out->slice = slice(w, &t->slice);
    out->inertia = all(w, d * d, t->inertia), out->Av = all(w, d * n, t->Av), out->Kt = all(w, n * n, t->Kt);
    out->Bv = all(w, d * n * n, t->Bv), out->U = all(w, n * n * n, t->U);
    out->reduced = reduced(w, &t->reduced);
    return out;
}

static const nh_hamilton *hamilton(const renaming *w, const nh_hamilton *h, const nh_reduced *own)
{
    size_t n = h->n;
    nh_hamilton *out = nh_arena_alloc(w->k->arena, sizeof *out);
    nh_ex *p = nh_arena_alloc(w->k->arena, (n + h->d + 1) * sizeof *p);
    *out = *h;
    for (size_t i = 0; i < n + h->d; i++) p[i] = nh_symbol_fresh(h->dag, own->momentum[i]);
    renaming both = {w->k, w->n + n + h->d, nh_arena_alloc(w->k->arena, (w->n + n + h->d) * sizeof *p),
                     nh_arena_alloc(w->k->arena, (w->n + n + h->d) * sizeof *p), w->name};
    memcpy(both.from, w->from, w->n * sizeof *p), memcpy(both.from + w->n, h->p, (n + h->d) * sizeof *p);
    memcpy(both.to, w->to, w->n * sizeof *p), memcpy(both.to + w->n, p, (n + h->d) * sizeof *p);
    out->x = own->x, out->p = p, out->m = p + n;
    out->H = one(&both, h->H), out->speed = all(&both, n, h->speed), out->rate = all(&both, n, h->rate);
    out->form = all(&both, n * n, h->form), out->U = all(&both, n * n * (n + h->d), h->U);
    return out;
}

static const nh_reduction_theory *theory(const renaming *w, const nh_reduction_theory *t, const nh_reduction_stage *own)
{
    nh_reduction_theory *out = nh_arena_alloc(w->k->arena, sizeof *out);
    *out = *t;
    size_t n = own->shown_slice->n, d = own->shown_slice->d;
    out->inverse = all(w, n * n, t->inverse);
    out->locked = all(w, d * d, t->locked);
    const nh_lagrange_poincare *l = t->bundle;
    if (!l) return out;
    nh_lagrange_poincare *b = nh_arena_alloc(w->k->arena, sizeof *b);
    *b = *l;
    b->slice = own->shown_slice;
    b->chi = all(w, d * l->r, l->chi), b->A = all(w, d * n, l->A), b->B = all(w, d * n * n, l->B);
    b->dx = all(w, n, l->dx), b->omega = all(w, d, l->omega), b->v = all(w, d, l->v);
    b->Kh = all(w, n * n, l->Kh), b->I = all(w, l->r * l->r, l->I), b->C = all(w, n * l->r, l->C);
    b->mu = all(w, d, l->mu), b->pi = all(w, n, l->pi), b->slope = all(w, n, l->slope);
    out->bundle = b;
    return out;
}

/* ---- stages ---- */

static void name_stage(nh_reduction *r, const renaming *w, nh_reduction_stage *s)
{
    nh_reduction_stage *own = nh_arena_alloc(r->arena, sizeof *own);
    nh_slice *on = nh_arena_alloc(r->arena, sizeof *on);
    nh_reduced *shown = nh_arena_alloc(r->arena, sizeof *shown);
    nh_hamilton *h = nh_arena_alloc(r->arena, sizeof *h);
    bool has = s->kind == NH_STAGE_CHAPLYGIN
                   ? nh_hamilton_of_first(h, r->arena, s->chaplygin)
                   : s->kind == NH_STAGE_SECOND && nh_hamilton_of_second(h, r->arena, s->second);
    *own = *s;
    *on = slice(w, s->shown_slice);
    *shown = reduced(w, s->shown);
    own->shown_slice = on;
    own->shown = shown;
    if (s->kind == NH_STAGE_CHAPLYGIN) own->chaplygin = chaplygin(w, s->chaplygin, on);
    if (s->kind == NH_STAGE_SECOND) own->second = second(w, s->second);
    if (has) own->hamilton = hamilton(w, h, shown);
    if (s->theory) own->theory = theory(w, s->theory, own);
    if (s->measure.closed) own->measure.density = one(w, s->measure.density);
    own->linear.N = all(w, s->linear.count * s->linear.count, s->linear.N);
    if (s->motion.momenta == shown->r) own->motion.name = s->motion.name = shown->momentum;
    own->named = NULL;
    s->named = own;
}

void nh_reduction_name_moved(nh_reduction *r)
{
    const nh_kinetic *k = r->kinetic;
    nh_dag *d = k->dag;
    bool *moved = nh_arena_alloc(r->arena, (k->m + 1) * sizeof *moved), *first = nh_arena_alloc(r->arena, k->m + 1);
    for (size_t i = 0; i < r->stages; i++) {
        nh_reduction_stage *s = &r->stage[i];
        const nh_slice *on = s->shown_slice;
        bool again = s->kind == NH_STAGE_SECOND && s->second->first->d;
        renaming w = {k, 0, nh_arena_alloc(r->arena, 2 * k->m * sizeof(nh_ex)),
                      nh_arena_alloc(r->arena, 2 * k->m * sizeof(nh_ex)),
                      nh_arena_alloc(r->arena, k->m * sizeof(char *))};
        memset(moved, 0, k->m * sizeof *moved);
        for (size_t c = 0; c < on->n; c++)
            for (size_t q = 0; q < k->m; q++)
                if (on->x[c] == k->q[q]) moved[q] = nh_slice_moves(on, c) || (again && first[q]);
        for (size_t q = 0; q < k->m; q++) {
            w.name[q] = moved[q] ? nh_kinetic_unused_name(k, "%s_s", k->name[q]) : NULL;
            if (!moved[q]) continue;
            w.from[w.n] = k->q[q], w.to[w.n++] = nh_symbol_fresh(d, w.name[q]);
            w.from[w.n] = k->v[q], w.to[w.n++] = nh_symbol_fresh(d, nh_arena_printf(k->arena, "%s'", w.name[q]));
        }
        if (s->kind == NH_STAGE_CHAPLYGIN) memcpy(first, moved, k->m * sizeof *first);
        if (w.n && !s->shown->force) name_stage(r, &w, s);
    }
}
