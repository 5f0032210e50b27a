/* Hamilton's form of a reduced stage (hamilton.h). */
#include "reduction/hamilton.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"

enum { most_length = 3000 }; /* of an entry that is simplified */

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

static nh_ex tidy(nh_dag *d, nh_ex e) { return nh_simplify_short(d, e, most_length); }

/* ---- 1/2 y K^-1 y ---- */

typedef struct {
    nh_dag *d;
    size_t n;
    nh_ex *K, *y;
    bool *gone;
} squares;

/* How many others row i is coupled with; *other: one of them. */
static size_t coupled(const squares *s, size_t i, size_t *other)
{
    size_t count = 0;
    for (size_t j = 0; j < s->n; j++)
        if (j != i && !s->gone[j] && !nh_is_zero(s->d, s->K[i * s->n + j])) count++, *other = j;
    return count;
}

/* The length of what is split off with row i. */
static size_t length_of(const squares *s, size_t i)
{
    size_t sum = nh_complexity(s->d, s->K[i * (s->n + 1)]);
    for (size_t j = 0; j < s->n; j++)
        if (j != i && !s->gone[j] && !nh_is_zero(s->d, s->K[i * s->n + j]))
            sum += nh_complexity(s->d, tidy(s->d, nh_div(s->d, s->K[i * s->n + j], s->K[i * (s->n + 1)])));
    return sum;
}

/* y_i^2 / (2 K_ii); K and y of the others without row i. */
static nh_ex split_off(squares *s, size_t i)
{
    nh_dag *d = s->d;
    size_t n = s->n;
    nh_ex pivot = s->K[i * (n + 1)], *ratio = nh_alloc_array(n + 1, sizeof *ratio);
    s->gone[i] = true;
    for (size_t j = 0; j < n; j++) ratio[j] = s->gone[j] ? nh_int(d, 0) : tidy(d, nh_div(d, s->K[i * n + j], pivot));
    for (size_t j = 0; j < n; j++)
        for (size_t k = 0; k <= j && !s->gone[j]; k++) {
            nh_ex off = plus(d, nh_int(d, 0), ratio[j], s->K[i * n + k]);
            if (!s->gone[k] && !nh_is_zero(d, off))
                s->K[j * n + k] = s->K[k * n + j] = tidy(d, nh_sub(d, s->K[j * n + k], off));
        }
    for (size_t j = 0; j < n; j++)
        if (!s->gone[j]) s->y[j] = plus(d, s->y[j], nh_neg(d, ratio[j]), s->y[i]);
    nh_free(ratio);
    return nh_div(d, nh_powi(d, s->y[i], 2), nh_mul(d, nh_int(d, 2), pivot));
}

/* (K_jj y_i^2 - 2 K_ij y_i y_j + K_ii y_j^2) / (2 det). */
static nh_ex pair(squares *s, size_t i, size_t j)
{
    nh_dag *d = s->d;
    size_t n = s->n;
    nh_ex a = s->K[i * (n + 1)], b = s->K[j * (n + 1)], c = s->K[i * n + j], sum = nh_int(d, 0),
          det = tidy(d, nh_sub(d, nh_mul(d, a, b), nh_powi(d, c, 2))), twice = nh_mul(d, nh_int(d, 2), det);
    s->gone[i] = s->gone[j] = true;
    if (nh_is_zero(d, det)) return 0;
    sum = plus(d, sum, tidy(d, nh_div(d, b, twice)), nh_powi(d, s->y[i], 2));
    sum = plus(d, sum, nh_neg(d, tidy(d, nh_div(d, c, det))), nh_mul(d, s->y[i], s->y[j]));
    return plus(d, sum, tidy(d, nh_div(d, a, twice)), nh_powi(d, s->y[j], 2));
}

nh_ex nh_hamilton_quadratic(nh_dag *d, size_t n, const nh_ex *K, const nh_ex *y)
{
    nh_ex *copy = nh_alloc_array(n * n + n + 1, sizeof *copy), sum = nh_int(d, 0);
    squares s = {d, n, copy, copy + n * n, nh_alloc_array(n + 1, sizeof(bool))};
    memcpy(s.K, K, n * n * sizeof *K);
    memcpy(s.y, y, n * sizeof *y);
    bool good = true;
    for (size_t left = n; left > 0 && good;) {
        size_t best = 0, other = 0, shortest = SIZE_MAX, others = 0;
        for (size_t i = 0; i < n; i++) { /* those that are coupled with none, or with one that is so only with them */
            size_t back = 0, count = s.gone[i] ? 0 : coupled(&s, i, &other);
            if (s.gone[i]) continue;
            bool alone = !count || (count == 1 && coupled(&s, other, &back) == 1);
            size_t length = alone ? 0 : length_of(&s, i);
            if (length >= shortest) continue;
            shortest = length;
            best = i;
            others = alone ? count : 2;
        }
        if (others == 1) coupled(&s, best, &other);
        nh_ex part = others == 1 ? pair(&s, best, other) : nh_is_zero(d, s.K[best * (n + 1)]) ? 0 : split_off(&s, best);
        good = part != 0;
        if (good) sum = nh_add(d, sum, part);
        left -= others == 1 ? 2 : 1;
    }
    nh_free(s.gone);
    nh_free(copy);
    return good ? sum : 0;
}

/* ---- stages ---- */

static void begin(nh_hamilton *h, nh_arena *arena, nh_dag *dag, const nh_reduced *o, size_t d)
{
    size_t n = o->n;
    *h = (nh_hamilton){.dag = dag, .n = n, .d = d, .x = o->x};
    h->p = nh_arena_alloc(arena, (3 * n + d + n * n * (n + d) + n * n + 1) * sizeof *h->p);
    h->m = h->p + n;
    h->speed = h->m + d;
    h->rate = h->speed + n;
    h->form = h->rate + n;
    h->U = h->form + n * n;
    for (size_t i = 0; i < n + d; i++) h->p[i] = nh_symbol_fresh(dag, o->momentum[i]);
}

/* dH/dp, Ups and p' from H and U. */
static void finish(nh_hamilton *h)
{
    nh_dag *d = h->dag;
    size_t n = h->n;
    for (size_t i = 0; i < n; i++) h->speed[i] = nh_diff(d, h->H, h->p[i]);
    for (size_t i = 0; i < n * n; i++) {
        h->form[i] = nh_int(d, 0);
        for (size_t k = 0; k < n + h->d; k++)
            h->form[i] = plus(d, h->form[i], h->U[k * n * n + i], k < n ? h->speed[k] : h->m[k - n]);
    }
    for (size_t i = 0; i < n; i++) {
        h->rate[i] = nh_neg(d, nh_diff(d, h->H, h->x[i]));
        for (size_t j = 0; j < n; j++) h->rate[i] = plus(d, h->rate[i], h->form[i * n + j], h->speed[j]);
    }
}

bool nh_hamilton_of_first(nh_hamilton *h, nh_arena *arena, const nh_chaplygin *c)
{
    if (!c->plain) return false;
    begin(h, arena, c->dag, &c->reduced, 0);
    nh_ex kinetic = nh_hamilton_quadratic(c->dag, c->n, c->K, h->p);
    if (!kinetic) return false;
    h->H = nh_add(c->dag, kinetic, c->V);
    memcpy(h->U, c->U, c->n * c->n * c->n * sizeof *h->U);
    finish(h);
    return true;
}

/* The part of Ups_ij with I v: U(e_a; h_i, h_j) + U(h_i; e_a, h_j) + I_ab Bv^b_ij for v^a. */
static nh_ex with_group_velocity(const nh_second *t, const nh_ex *U, size_t a, size_t i, size_t j)
{
    nh_dag *d = t->slice.dag;
    size_t n = t->n, m = t->slice.m;
    nh_ex sum = nh_add(d, U[((n + a) * m + i) * m + j], U[(i * m + n + a) * m + j]);
    for (size_t b = 0; b < t->d; b++) sum = plus(d, sum, t->inertia[a * t->d + b], t->Bv[(b * n + i) * n + j]);
    return tidy(d, sum);
}

bool nh_hamilton_of_second(nh_hamilton *h, nh_arena *arena, const nh_second *t)
{
    nh_dag *d = t->slice.dag;
    size_t n = t->n, m = t->slice.m, g = t->d;
    if (!t->first->plain || !t->abelian || t->magnetic) return false;
    begin(h, arena, d, &t->reduced, g);
    nh_ex shape = nh_hamilton_quadratic(d, n, t->Kt, h->p), group = nh_hamilton_quadratic(d, g, t->inertia, h->m);
    if (!shape || !group) return false;
    h->H = nh_add(d, nh_add(d, shape, group), t->slice.V);
    nh_ex *U = nh_alloc_array(m * m * m + g + 1, sizeof *U), *v = U + m * m * m;
    nh_second_form(t, m, U);
    for (size_t a = 0; a < g; a++) v[a] = nh_diff(d, group, h->m[a]);
    for (size_t i = 0; i < n * n; i++) {
        for (size_t k = 0; k < n; k++) h->U[k * n * n + i] = tidy(d, U[(k * m + i / n) * m + i % n]);
        for (size_t b = 0; b < g; b++) { /* d/dm_b of v^a times the part of v^a */
            nh_ex sum = nh_int(d, 0);
            for (size_t a = 0; a < g; a++)
                sum = plus(d, sum, with_group_velocity(t, U, a, i / n, i % n), nh_diff(d, v[a], h->m[b]));
            h->U[(n + b) * n * n + i] = tidy(d, sum);
        }
    }
    nh_free(U);
    finish(h);
    return true;
}
