/* A stage of the search: what is integrated along a coordinate.  With x' = c f'(h) h' for a current c, x - c f is
 * constant; with dv/dt = c f'(h) h' for a velocity v, v - c f. */
#include "count/closed_words.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "search/counted.h"
#include "search/stage_solver.h"

/* Velocities times 1 and positions besides currents times antiderivatives.  A velocity may need the root of its
 * inertia: x'/cos(h), where a blade with the heading h moves. */
static void with_velocities(nh_stage_solver *solver, const nh_family *currents)
{
    nh_analysis *result = solver->r;
    const nh_model *model = result->question->model;
    solver->words = nh_dictionary_of(result->question->model);
    const nh_dictionary *w = &solver->words;
    size_t n = 0, positions = 0, most = w->velocities + w->forms + w->frames + model->n + 1;
    nh_ex *linear = nh_arena_alloc(result->arena, most * sizeof *linear),
          *position = nh_arena_alloc(result->arena, (w->positions + 1) * sizeof *position);
    position[positions++] = nh_int(model->dag, 1);
    for (size_t k = 0; k < w->positions; k++) position[positions++] = w->position[k];
    for (size_t k = 0; k < w->velocities; k++) linear[n++] = w->velocity[k];
    for (size_t k = 0; k < w->forms; k++) linear[n++] = w->form[k];
    for (size_t k = 0; k < w->frames; k++) linear[n++] = w->frame[k];
    for (size_t i = 0; i < model->n; i++) {
        nh_ex outside, inside, inertia = nh_simplify_short(model->dag, model->M[i * model->n + i], 0);
        if (!nh_square_split(model->dag, inertia, &outside, &inside) || nh_kind_of(model->dag, outside) == NH_NUMBER)
            continue;
        linear[n++] = nh_mul(model->dag, outside, model->chart->w[i]);
    }
    nh_family *part = nh_arena_alloc(result->arena, 2 * sizeof *part),
              *all = nh_arena_alloc(result->arena, 2 * sizeof *all);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = n, .term = linear};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = positions, .term = position};
    all[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    all[1] = *currents;
    nh_stage_solver_stage(solver, "velocities times 1 and positions, currents times antiderivatives", 2, all);
}

bool nh_primitives_search(nh_stage_solver *solver, bool time, size_t degree)
{
    enum { most_primitives = 12, most_factors = 12 };
    nh_analysis *result = solver->r;
    const nh_current_list *list = result->list;
    const nh_model *model = result->question->model;
    nh_dag *d = model->dag;
    size_t words = most_primitives + model->m + 2, factors = 1, n = 0, before = list->count;
    nh_ex *word = nh_arena_alloc(result->arena, words * sizeof *word), factor[most_factors] = {nh_int(d, 1)},
          *phi = nh_alloc_array(list->count + list->furthers + 1, sizeof *phi);
    bool general;
    words = nh_closed_primitives(model, time, most_primitives, word);
    size_t independent, known = nh_counted_proved(result, phi, &general, &independent);
    for (size_t k = 0; k < known && factors < most_factors; k++)
        if (nh_counted_degree_of(model, phi[k]) <= (double)degree) factor[factors++] = phi[k];
    nh_free(phi);
    if (!words) return false;
    word[words++] = nh_int(d, 1);
    word[words++] = model->system->t;
    for (size_t k = 0; k < model->m; k++) word[words++] = model->system->coordinate[k].q;
    nh_ex *term = nh_arena_alloc(result->arena, factors * words * sizeof *term);
    for (size_t i = 0; i < factors; i++)
        for (size_t j = 0; j < words; j++) term[n++] = nh_mul(d, factor[i], word[j]);
    nh_family all = {.kind = NH_TERMS, .terms = n, .term = term};
    solver->wide = true;
    nh_stage_solver_stage(solver, "currents found so far times coordinates and antiderivatives", 1, &all);
    if (list->count == before && degree == 1) with_velocities(solver, &all);
    return list->count > before;
}
