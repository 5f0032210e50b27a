#include "search/combined_coordinates.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"

typedef struct {
    const nh_model *o;
    nh_dag *d;
    size_t states;
    const nh_ex *state;
    nh_ex *rate; /* per state; q_k of a combined coordinate occurs in none */
    nh_ex *with; /* per state q_i: z - q_i, or 0 */
} search;

static bool constant(const search *x, nh_ex e)
{
    for (size_t i = 0; i < x->states; i++)
        if (nh_depends(x->d, e, x->state[i])) return false;
    return true;
}

/* r with dg/dq_k = r dg/dq_i for all rates g. */
static bool ratio_of(const search *x, size_t i, size_t k, nh_ex *r)
{
    nh_dag *d = x->d;
    bool found = false;
    for (size_t j = 0; j < x->states; j++)
        if (nh_depends(d, x->rate[j], x->state[i]) != nh_depends(d, x->rate[j], x->state[k])) return false;
    for (size_t j = 0; j < x->states; j++) {
        if (!nh_depends(d, x->rate[j], x->state[i])) continue;
        nh_ex by_i = nh_diff(d, x->rate[j], x->state[i]), by_k = nh_diff(d, x->rate[j], x->state[k]);
        if (!found) *r = nh_simplify_short(d, nh_div(d, by_k, by_i), 0);
        if (!found && (!constant(x, *r) || nh_is_zero(d, *r))) return false;
        found = true;
        if (nh_normal_is_zero(d, nh_sub(d, by_k, nh_mul(d, *r, by_i)), 0) != NH_ZERO) return false;
    }
    return found;
}

/* z = q_i + r q_k: its rate, and q_k = 0 in all rates, which do not depend on it any more. */
static void join(search *x, size_t i, size_t k, nh_ex r)
{
    nh_dag *d = x->d;
    nh_ex zero = nh_int(d, 0);
    x->with[i] = nh_add(d, x->with[i], nh_mul(d, r, x->state[k]));
    x->rate[i] = nh_add(d, x->rate[i], nh_mul(d, r, x->rate[k]));
    for (size_t j = 0; j < x->states; j++) x->rate[j] = nh_substitute(d, x->rate[j], 1, &x->state[k], &zero);
}

const nh_combined_coordinates *nh_combined_coordinates_of(nh_arena *arena, const nh_model *model, const nh_ex *rate)
{
    size_t states = 1 + model->m + model->n;
    search x = {.o = model, .d = model->dag, .states = states, .state = model->chart->symbol};
    x.rate = nh_arena_alloc(arena, states * sizeof *x.rate);
    x.with = nh_arena_alloc(arena, states * sizeof *x.with);
    memcpy(x.rate, rate, states * sizeof *x.rate);
    for (size_t i = 0; i < states; i++) x.with[i] = nh_int(x.d, 0);
    for (size_t i = 1; i <= model->m; i++)
        for (size_t k = 0; k <= model->m; k++) {
            nh_ex r;
            if (k != i && (k == 0 || k > i) && ratio_of(&x, i, k, &r)) join(&x, i, k, r);
        }
    nh_combined_coordinates *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_combined_coordinates){.rate = x.rate};
    out->state = nh_arena_alloc(arena, states * sizeof *out->state);
    out->symbol = nh_arena_alloc(arena, states * sizeof *out->symbol);
    out->combined = nh_arena_alloc(arena, states * sizeof *out->combined);
    out->state_in_combined = nh_arena_alloc(arena, states * sizeof *out->state_in_combined);
    for (size_t i = 1; i <= model->m; i++) {
        if (nh_is_zero(x.d, x.with[i])) continue;
        out->state[out->count] = i;
        out->symbol[out->count] = x.state[i];
        out->combined[out->count] = nh_add(x.d, x.state[i], x.with[i]);
        out->state_in_combined[out->count++] = nh_sub(x.d, x.state[i], x.with[i]);
    }
    return out->count ? out : NULL;
}

nh_ex nh_combined_coordinates_in(const nh_combined_coordinates *j, nh_dag *d, nh_ex e)
{
    return j ? nh_substitute(d, e, j->count, j->symbol, j->state_in_combined) : e;
}

nh_ex nh_combined_coordinates_out(const nh_combined_coordinates *j, nh_dag *d, nh_ex e)
{
    return j ? nh_substitute(d, e, j->count, j->symbol, j->combined) : e;
}
