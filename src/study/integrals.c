#include "study/integrals.h"

enum { generic_count = 24, own_seed = 505 };

static bool only_events(const nh_model *o, nh_ex e)
{
    for (size_t j = 1 + o->m; j < o->width; j++)
        if (nh_depends(o->dag, e, o->chart->symbol[j])) return false;
    return true;
}

/* Functions in the order: the given constraints between positions, then the currents of (t, q); current[i]: which current, or r->count. */
static size_t gather(const nh_result *r, nh_ex *phi, size_t *current)
{
    const nh_system *y = r->system;
    size_t n = 0;
    for (size_t a = 0; a < y->constraints; a++)
        if (y->constraint[a].position) phi[n] = y->constraint[a].level, current[n++] = r->count;
    for (size_t k = 0; k < r->count; k++)
        if (only_events(r->model, r->found[k].phi)) phi[n] = r->found[k].phi, current[n++] = k;
    return n;
}

void nh_integrals_of_constraints(nh_result *r)
{
    size_t most = r->count + r->system->constraints + 1;
    nh_ex *phi = nh_alloc_array(most, sizeof *phi);
    size_t *current = nh_alloc_array(most, sizeof *current), n = r->system->constraints ? gather(r, phi, current) : 0;
    nh_independence *kind = nh_alloc_array(most, sizeof *kind);
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_points *points = n ? nh_points_create(r->model, generic_count, 1, (uint64_t)r->options.seed + own_seed, &ignored) : NULL;
    r->integral = nh_arena_alloc(r->arena, most * sizeof *r->integral);
    if (points) nh_independence_test(r->model, points, n, phi, r->options.sure, r->options.doubt, kind, NULL);
    for (size_t i = 0; i < n && points; i++) {
        if (current[i] == r->count) continue;
        nh_found *f = &r->found[current[i]];
        bool fresh = kind[i] == NH_INDEPENDENT && r->integrals < r->constraint.hidden;
        if (fresh) r->integral[r->integrals++] = current[i];
        if (!f->meaning[0]) f->meaning = fresh ? "integral of the constraints" : r->constraint.positions ? "the constraints between positions" : "";
    }
    nh_points_free(points);
    nh_free(kind);
    nh_free(current);
    nh_free(phi);
}
