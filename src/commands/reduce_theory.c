/* The objects of the stages that --equations shows beside the equations: inverse metrics, and the whole group's
 * bundle. */
#include "commands/reduce_internal.h"

#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"

enum { large_length = 3000 };

/* K^-1 of an n x n metric on a slice; NULL where the elimination fails. */
static nh_ex *inverse_of(nh_arena *arena, const nh_slice *s, size_t n, const nh_ex *K)
{
    nh_ex *inverse = nh_arena_alloc(arena, (n * n + n + 1) * sizeof *inverse), *column = inverse + n * n;
    nh_lu *lu = n ? nh_lu_create(s->dag, n, K, nh_slice_pivot_score, (void *)s, NULL) : NULL;
    for (size_t j = 0; j < n && lu; j++) {
        for (size_t i = 0; i < n; i++) column[i] = nh_int(s->dag, i == j);
        nh_lu_solve(lu, column, column);
        for (size_t i = 0; i < n; i++) inverse[i * n + j] = nh_simplify_short(s->dag, column[i], large_length);
    }
    bool good = lu != NULL;
    nh_lu_free(lu);
    return good ? inverse : NULL;
}

/* The inner product to which the lifts are orthogonal: NULL, or that of the generators, which are orthonormal by
 * default. */
static const nh_ex *lifts_of(const nh_reduction *r, const nh_slice *s)
{
    if (!(r->options.lifts > 0)) return NULL;
    if (r->inner) return r->inner;
    nh_ex *identity = nh_arena_alloc(r->arena, (s->d * s->d + 1) * sizeof *identity);
    for (size_t i = 0; i < s->d * s->d; i++) identity[i] = nh_int(s->dag, i % (s->d + 1) == 0);
    return identity;
}

void nh_reduction_write_out(nh_reduction *r)
{
    for (size_t i = 0; i < r->stages && !nh_interrupted(); i++) {
        nh_reduction_stage *s = &r->stage[i];
        nh_reduction_theory *t = nh_arena_alloc(r->arena, sizeof *t);
        *t = (nh_reduction_theory){0};
        if (s->kind == NH_STAGE_CHAPLYGIN)
            t->inverse = inverse_of(r->arena, s->chaplygin->slice, s->chaplygin->n, s->chaplygin->K);
        if (s->kind == NH_STAGE_SECOND) {
            t->inverse = inverse_of(r->arena, &s->second->slice, s->second->n, s->second->Kt);
            t->locked = inverse_of(r->arena, &s->second->slice, s->second->d, s->second->inertia);
        }
        if (s->kind == NH_STAGE_POINCARE)
            t->bundle = nh_lagrange_poincare_of(r->arena, s->shown_slice, lifts_of(r, s->shown_slice));
        s->theory = t;
    }
}
