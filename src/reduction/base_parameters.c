#include "reduction/measure_conditions.h"

#include <string.h>

#include "exact/normal.h"
#include "exact/relation_space.h"
#include "graph/dag.h"
#include "graph/diff.h"

typedef struct {
    nh_arena *arena;
    nh_dag *dag;
    size_t n, linear, others;
    nh_ex *entry, *mu, *other, *slope; /* slope[j * n + i] = d entry_i/d mu_j */
} work;

static bool vanishes(const work *w, nh_ex e)
{
    return nh_is_zero(w->dag, e) || nh_normal_is_zero(w->dag, e, 0) == NH_ZERO;
}

/* Are the entries linear in p, and in those before and p at once? */
static bool is_linear(work *w, nh_ex p)
{
    bool occurs = false, good = true;
    nh_ex *slope = w->slope + w->linear * w->n;
    for (size_t i = 0; i < w->n; i++) {
        slope[i] = nh_diff(w->dag, w->entry[i], p);
        occurs |= !nh_is_zero(w->dag, slope[i]);
    }
    for (size_t i = 0; i < w->n && good; i++) {
        good = vanishes(w, nh_diff(w->dag, slope[i], p));
        for (size_t j = 0; j < w->linear && good; j++) good = vanishes(w, nh_diff(w->dag, slope[i], w->mu[j]));
    }
    return occurs && good;
}

static void split(work *w, size_t parameters, const nh_ex *parameter)
{
    /* moments of inertia are usually the last ones: formulas in these have no masses in denominators */
    for (size_t k = parameters; k-- > 0;) {
        if (is_linear(w, parameter[k])) w->mu[w->linear++] = parameter[k];
        else w->other[w->others++] = parameter[k];
    }
    for (size_t k = 0; k < w->linear * w->n; k++) w->slope[k] = nh_simplify_short(w->dag, w->slope[k], 0);
}

/* Every relation eliminates the parameter of its last column. */
static void spare(work *w, const nh_relation_space *space, nh_base_parameters *out)
{
    size_t n = w->linear;
    nh_ex *zero = nh_arena_alloc(w->arena, (n + 1) * sizeof *zero),
          *gone = nh_arena_alloc(w->arena, (n + 1) * sizeof *gone);
    size_t count = 0;
    memcpy(out->parameter, w->mu, n * sizeof *w->mu);
    memcpy(out->meaning, w->mu, n * sizeof *w->mu);
    out->count = n;
    for (size_t r = 0; r < space->proved; r++) {
        const nh_ex *c = space->coefficient + r * n;
        size_t last = n;
        while (last > 0 && nh_is_zero(w->dag, c[last - 1])) last--;
        if (!last) continue;
        for (size_t j = 0; j + 1 < last; j++)
            out->meaning[j] =
                nh_sub(w->dag, out->meaning[j], nh_mul(w->dag, nh_div(w->dag, c[j], c[last - 1]), w->mu[last - 1]));
        gone[count] = w->mu[last - 1];
        zero[count++] = nh_int(w->dag, 0);
    }
    for (size_t i = 0; i < w->n; i++)
        w->entry[i] = nh_simplify_short(w->dag, nh_substitute(w->dag, w->entry[i], count, gone, zero), 0);
}

bool nh_base_parameters_of(nh_arena *arena, nh_dag *dag, size_t n, nh_ex *entry, size_t variables,
                           const nh_ex *variable, size_t parameters, const nh_ex *parameter, nh_base_parameters *out)
{
    work w = {.arena = arena, .dag = dag, .n = n, .entry = entry};
    nh_ex *list = nh_arena_alloc(arena, (4 * parameters + n * (parameters + 1) + 1) * sizeof *list);
    w.mu = list;
    w.other = list + parameters;
    out->parameter = list + 2 * parameters;
    out->meaning = list + 3 * parameters;
    w.slope = list + 4 * parameters;
    out->count = 0;
    split(&w, parameters, parameter);
    if (!w.linear) return false;
    nh_relation_columns columns = {.dag = dag,
                                   .columns = w.linear,
                                   .rows = n,
                                   .entry = w.slope,
                                   .variables = variables,
                                   .variable = variable,
                                   .parameters = w.others,
                                   .parameter = w.other};
    nh_relation_space *space = nh_relation_space_of(arena, &columns);
    if (space->obstacle || !space->proved) return false;
    spare(&w, space, out);
    return true;
}
