/* The count from one order to the next: the system that the lower weights leave is kept, and a longer series continues
 * from there. */
#include <string.h>

#include "count/graded_solver_internal.h"

struct nh_graded_state {
    nh_graded_system s;
    size_t order, size, *total, injective_at, most; /* of what was solved; size: of its ring, which is gone */
    bool injective;
};

static void system_clear(nh_graded_system *s)
{
    nh_free(s->condition);
    nh_free(s->row);
    nh_arena_free(s->arena);
}

void nh_graded_state_free(nh_graded_state *state)
{
    if (!state) return;
    system_clear(&state->s);
    nh_free(state->total);
    nh_free(state);
}

/* What nh_graded_finish() changes and restore() puts back, because the next weight starts from the unfinished system:
 * the coefficients of the first jets, and the numbers. */
typedef struct {
    size_t N, conditions, count;
    double work;
    uint32_t *exponent;
    nh_residue *row;
} saved;

static saved save(nh_graded_system *s)
{
    saved kept = {.N = s->N, .conditions = s->conditions, .work = s->work};
    s->k = s->r->order - 1;
    kept.count = nh_graded_coefficients_left(s, NULL);
    kept.exponent = nh_alloc_array(kept.count + 1, sizeof *kept.exponent);
    kept.row = nh_alloc_array(s->alphas * kept.count * s->N + 1, sizeof *kept.row);
    nh_graded_coefficients_left(s, kept.exponent);
    for (size_t i = 0; i < s->alphas * kept.count; i++)
        memcpy(kept.row + i * s->N, nh_graded_row(s, i / kept.count, kept.exponent[i % kept.count]),
               s->N * sizeof *kept.row);
    return kept;
}

static void restore(nh_graded_system *s, saved *kept)
{
    s->N = kept->N;
    s->conditions = kept->conditions;
    s->work = kept->work;
    for (size_t i = 0; i < s->alphas * kept->count; i++)
        memcpy(nh_graded_row(s, i / kept->count, kept->exponent[i % kept->count]), kept->row + i * s->N,
               s->N * sizeof *kept->row);
    nh_free(kept->row);
    nh_free(kept->exponent);
}

/* The coefficients of a longer series, zero for the higher weights.  What the last weight left to nh_graded_finish() is
 * substituted now, as in a long series. */
static void lengthen(nh_graded_state *state, const nh_graded_problem *p)
{
    nh_graded_system *s = &state->s;
    size_t old = state->size, size = p->ring->size;
    nh_residue *row = nh_alloc_array(s->alphas * size * s->stride, sizeof *row);
    for (size_t a = 0; a < s->alphas; a++)
        memcpy(row + a * size * s->stride, s->row + a * old * s->stride, old * s->stride * sizeof *row);
    nh_free(s->row);
    s->row = row;
    s->p = p;
    s->r = p->ring;
    s->terms = 0;
    nh_graded_list_terms(s);
    s->over |= s->planned > p->most_work || s->work >= p->most_work;
    s->k = state->order - 1;
    if (!s->over && 4 * (s->N - s->conditions) <= s->N) nh_graded_substitute_all(s);
}

size_t nh_graded_state_order(const nh_graded_state *state) { return state->order; }

const nh_residue *nh_graded_state_solutions(nh_graded_state *state, const nh_graded_problem *p, size_t *count,
                                            size_t *stride, double *work)
{
    nh_graded_system *s = &state->s;
    nh_graded_problem all = *p;
    double before = s->work;
    all.keep = true;
    all.most_work += s->work;
    s->p = &all;
    s->r = p->ring;
    s->k = state->order - 1;
    nh_graded_substitute_all(s);
    s->p = p;
    bool good = !s->over;
    s->over = false;
    *work += s->work - before;
    *count = s->N;
    *stride = s->stride;
    return good ? s->row : NULL;
}

/* The system at its first weight, or at the first that was not solved yet. */
static nh_graded_state *open_state(const nh_graded_problem *p, nh_graded_state *old, nh_graded_count *out)
{
    if (old && (p->keep || old->order == 0 || old->order >= p->ring->order)) {
        nh_graded_state_free(old);
        old = NULL;
    }
    nh_graded_state *state = old ? old : nh_alloc(sizeof *state);
    if (old) {
        lengthen(state, p);
        memcpy(out->total, state->total, (state->order + 1) * sizeof *out->total);
        out->injective = state->injective;
        out->injective_at = state->injective_at;
        out->most = state->most;
        return state;
    }
    state->s = (nh_graded_system){.p = p, .r = p->ring, .f = p->ring->field, .arena = nh_arena_create()};
    nh_graded_start(&state->s);
    state->order = p->from ? p->from_order : 0;
    for (size_t k = 0; k <= state->order; k++) out->total[k] = state->s.N;
    out->most = state->s.N;
    return state;
}

nh_graded_count *nh_graded_continue(const nh_graded_problem *p, nh_graded_state **kept)
{
    nh_arena *arena = nh_arena_create();
    nh_graded_count *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_graded_count){.order = p->ring->order, .arena = arena};
    out->total = nh_arena_alloc(arena, (out->order + 1) * sizeof *out->total);
    nh_graded_state *state = open_state(p, kept ? *kept : NULL, out);
    nh_graded_system *s = &state->s;
    out->unknowns = s->alphas * s->r->size;
    for (s->k = state->order; s->k < out->order && !s->over; s->k++) {
        nh_graded_solve_weight(s, out);
        if (p->left && !nh_graded_is_extended(s)) break; /* more equations do not change that */
    }
    saved before = {0};
    bool again = kept && !p->keep && !s->over && out->order > 0;
    if (again) before = save(s);
    if (!s->over && !p->left) nh_graded_finish(s, out);
    if (!s->over && p->left) nh_graded_substitute_all(s);
    out->extended = nh_graded_is_extended(s);
    out->solved = !s->over;
    out->work = s->work;
    if (again) restore(s, &before);
    if (kept) *kept = again ? state : NULL;
    if (!again) {
        nh_graded_state_free(state);
        return out;
    }
    s->over = false; /* a limit of this order: the next order checks its own limits */
    state->order = out->order;
    state->size = s->r->size;
    nh_free(state->total);
    state->total = nh_alloc_array(out->order + 1, sizeof *state->total);
    memcpy(state->total, out->total, (out->order + 1) * sizeof *state->total);
    state->injective = out->injective;
    state->injective_at = out->injective_at;
    state->most = out->most;
    return out;
}

nh_graded_count *nh_graded_solve(const nh_graded_problem *p) { return nh_graded_continue(p, NULL); }

void nh_graded_count_clear(nh_graded_count *count)
{
    if (count) nh_arena_free(count->arena);
}
