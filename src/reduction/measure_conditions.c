#include "reduction/measure_conditions.h"

#include <string.h>

#include "exact/generic_value.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/diff.h"

enum { longest = 3000 };

typedef struct {
    nh_arena *arena;
    const nh_slice *s;
    nh_dag *dag;
    size_t n;
    nh_ex *T, *Theta;        /* T[(k*n + i)*n + j] */
    nh_measure_conditions *out;
} work;

static nh_ex tidy(const work *w, nh_ex e) { return nh_simplify_short(w->dag, e, longest); }

static bool tensor(work *w, const nh_ex *K, const nh_ex *U)
{
    size_t n = w->n;
    nh_ex *column = nh_alloc_array(n + 1, sizeof *column), zero = nh_int(w->dag, 0);
    nh_lu *lu = nh_lu_create(w->dag, n, K, nh_slice_pivot_score, (void *)w->s, NULL);
    for (size_t i = 0; i < n && lu; i++)
        for (size_t j = 0; j < i; j++) {
            bool any = false;
            for (size_t l = 0; l < n; l++) any |= !nh_is_zero(w->dag, column[l] = U[(l * n + i) * n + j]);
            if (any) nh_lu_solve(lu, column, column);
            for (size_t k = 0; k < n; k++) {
                nh_ex e = any ? tidy(w, column[k]) : zero;
                w->T[(k * n + i) * n + j] = e;
                w->T[(k * n + j) * n + i] = nh_neg(w->dag, e);
            }
        }
    bool good = lu != NULL;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++) w->T[(k * n + i) * n + i] = zero;
    for (size_t j = 0; j < n && good; j++) {
        w->Theta[j] = zero;
        for (size_t i = 0; i < n; i++) w->Theta[j] = nh_add(w->dag, w->Theta[j], w->T[(i * n + i) * n + j]);
        w->Theta[j] = tidy(w, w->Theta[j]);
    }
    nh_lu_free(lu);
    nh_free(column);
    return good;
}

static bool same(const nh_parameter_zeros *a, const nh_parameter_zeros *b)
{
    bool equal = a->ways == b->ways;
    for (size_t i = 0; i < a->ways && equal; i++) {
        equal = a->way[i].count == b->way[i].count;
        for (size_t k = 0; k < a->way[i].count && equal; k++) equal = a->way[i].polynomial[k] == b->way[i].polynomial[k];
    }
    return equal;
}

/* e = 0 is one more condition, unless it holds anyhow or is there already. */
static bool demand(work *w, nh_ex e, bool factor)
{
    const nh_system *y = w->s->kinetic->model->system;
    nh_measure_conditions *o = w->out;
    nh_parameter_zeros where;
    const nh_ex *symbol;
    const double *value;
    nh_system_bindings(y, &symbol, &value);
    if (nh_is_zero(w->dag, e)) return true;
    if (!nh_parameter_zeros_find(w->arena, w->dag, e, y->parameters, symbol, &where)) return false;
    if (where.ways == 1 && !where.way[0].count) return true;
    for (size_t i = 0; i < o->count; i++)
        if (same(&o->condition[i].where, &where)) return true;
    o->condition[o->count++] = (nh_measure_condition){factor, where};
    return true;
}

/* d_i Theta_j - d_j Theta_i */
static nh_ex curl(const work *w, size_t i, size_t j)
{
    const nh_ex *x = w->s->x;
    return nh_sub(w->dag, nh_diff(w->dag, w->Theta[j], x[i]), nh_diff(w->dag, w->Theta[i], x[j]));
}

static bool closed(work *w)
{
    bool good = true;
    for (size_t i = 0; i < w->n && good; i++)
        for (size_t j = 0; j < i && good; j++) good = demand(w, tidy(w, curl(w, i, j)), false);
    return good;
}

/* Does the curl of Theta vanish for hardly any parameters? */
static bool rarely_closed(const work *w)
{
    bool found = false;
    for (size_t i = 0; i < w->n && !found; i++)
        for (size_t j = 0; j < i && !found; j++) {
            nh_ex e = curl(w, i, j);
            found = nh_generic_nonzero(w->dag, 1, &e, w->n, w->s->x);
        }
    return found;
}

static bool simple(work *w)
{
    size_t n = w->n;
    bool good = true;
    for (size_t at = 0; at < n * n * n && good; at++) {
        size_t k = at / (n * n), i = at / n % n, j = at % n;
        nh_ex want = nh_int(w->dag, 0);
        if (j >= i) continue;
        if (k == i) want = nh_add(w->dag, want, w->Theta[j]);
        if (k == j) want = nh_sub(w->dag, want, w->Theta[i]);
        good = demand(w, tidy(w, nh_sub(w->dag, w->T[at], nh_mul(w->dag, nh_ratio(w->dag, 1, (int64_t)n - 1), want))), true);
    }
    return good;
}

nh_measure_conditions nh_measure_conditions_of(nh_arena *arena, const nh_slice *s, const nh_ex *K, const nh_ex *U)
{
    nh_measure_conditions out = {0};
    size_t n = s->n;
    work w = {.arena = arena, .s = s, .dag = s->dag, .n = n, .out = &out};
    out.condition = nh_arena_alloc(arena, (n * n + n * n * n + 1) * sizeof *out.condition);
    w.T = nh_arena_alloc(arena, (n * n * n + n + 1) * sizeof *w.T);
    w.Theta = w.T + n * n * n;
    bool made = n > 1 && tensor(&w, K, U);
    out.known = made && closed(&w) && (n == 2 || simple(&w));
    if (!out.known) out.count = 0;
    out.rare = made && !out.known && rarely_closed(&w);
    return out;
}
