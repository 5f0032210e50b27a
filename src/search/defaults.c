#include "search/search.h"

#include <string.h>

#include "motion/first_state.h"

bool nh_defaults_initial(nh_analysis *result, nh_state *state, nh_error *error)
{
    static const double inner = 0.7; /* part of the box */
    const nh_model *model = result->question->model;
    nh_points *p = nh_points_create(model, 1, inner, (uint64_t)result->question->options.seed + 909, error);
    if (!p) return false;
    *state = (nh_state){0, nh_arena_alloc(result->arena, (model->m + 1) * sizeof(double)),
                        nh_arena_alloc(result->arena, (model->m + 1) * sizeof(double)), NULL, NULL};
    double *z = nh_alloc_array(model->width + 1, sizeof *z);
    for (size_t i = 0; i < model->width; i++) z[i] = p->column[i][0];
    bool good = nh_first_state(model, z, state->v);
    state->t = z[0];
    memcpy(state->q, z + 1, model->m * sizeof(double));
    nh_free(z);
    nh_points_free(p);
    return good || nh_fail(error, NH_NUMERIC, "", "the equations of motion have no finite values at a sample point");
}
