/* A stage of the search: what is integrated along a coordinate.  With x' = c f'(h) h' for a current c, x - c f is
 * constant; with dv/dt = c f'(h) h' for a velocity v, v - c f. */
#include "count/closed_primitives.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "search/counted.h"
#include "search/stage_solver.h"

/* Velocities times 1 and positions besides currents times antiderivatives.  A velocity may need the root of its
 * inertia: x'/cos(h), where a blade with the heading h moves. */
static void with_velocities(nh_stage_solver *x, const nh_family *currents)
{
    nh_analysis *r = x->r;
    const nh_model *o = r->model;
    x->words = nh_dictionary_of(r->model);
    const nh_dictionary *w = &x->words;
    size_t n = 0, positions = 0, most = w->velocities + w->forms + w->frames + o->n + 1;
    nh_ex *linear = nh_arena_alloc(r->arena, most * sizeof *linear),
          *position = nh_arena_alloc(r->arena, (w->positions + 1) * sizeof *position);
    position[positions++] = nh_int(o->dag, 1);
    for (size_t k = 0; k < w->positions; k++) position[positions++] = w->position[k];
    for (size_t k = 0; k < w->velocities; k++) linear[n++] = w->velocity[k];
    for (size_t k = 0; k < w->forms; k++) linear[n++] = w->form[k];
    for (size_t k = 0; k < w->frames; k++) linear[n++] = w->frame[k];
    for (size_t i = 0; i < o->n; i++) {
        nh_ex outside, inside, inertia = nh_simplify_short(o->dag, o->M[i * o->n + i], 0);
        if (!nh_square_split(o->dag, inertia, &outside, &inside) || nh_kind_of(o->dag, outside) == NH_NUMBER) continue;
        linear[n++] = nh_mul(o->dag, outside, o->chart->w[i]);
    }
    nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *all = nh_arena_alloc(r->arena, 2 * sizeof *all);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = n, .term = linear};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = positions, .term = position};
    all[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    all[1] = *currents;
    nh_stage_solver_stage(x, "velocities times 1 and positions, currents times antiderivatives", 2, all);
}

bool nh_primitives_search(nh_stage_solver *x, bool time, size_t degree)
{
    enum { most_primitives = 12, most_factors = 12 };
    nh_analysis *r = x->r;
    const nh_model *o = r->model;
    nh_dag *d = o->dag;
    size_t words = most_primitives + o->m + 2, factors = 1, n = 0, before = r->count;
    nh_ex *word = nh_arena_alloc(r->arena, words * sizeof *word), factor[most_factors] = {nh_int(d, 1)},
          *phi = nh_alloc_array(r->count + r->furthers + 1, sizeof *phi);
    bool general;
    words = nh_closed_primitives(o, time, most_primitives, word);
    size_t independent, known = nh_counted_proved(r, phi, &general, &independent);
    for (size_t k = 0; k < known && factors < most_factors; k++)
        if (nh_counted_degree_of(o, phi[k]) <= (double)degree) factor[factors++] = phi[k];
    nh_free(phi);
    if (!words) return false;
    word[words++] = nh_int(d, 1);
    word[words++] = o->system->t;
    for (size_t k = 0; k < o->m; k++) word[words++] = o->system->coordinate[k].q;
    nh_ex *term = nh_arena_alloc(r->arena, factors * words * sizeof *term);
    for (size_t i = 0; i < factors; i++)
        for (size_t j = 0; j < words; j++) term[n++] = nh_mul(d, factor[i], word[j]);
    nh_family all = {.kind = NH_TERMS, .terms = n, .term = term};
    x->wide = true;
    nh_stage_solver_stage(x, "currents found so far times coordinates and antiderivatives", 1, &all);
    if (r->count == before && degree == 1) with_velocities(x, &all);
    return r->count > before;
}
