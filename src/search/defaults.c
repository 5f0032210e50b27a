#include "search/defaults.h"


bool nh_defaults_initial(nh_analysis *r, nh_state *state, nh_error *error)
{
    const nh_model *o = r->model;
    nh_points *p = nh_points_create(o, 1, 0.7, (uint64_t)r->options.seed + 909, error);
    if (!p) return false;
    double *v = nh_alloc_array(o->m + 1, sizeof *v);
    nh_points_evaluate(p, o, o->m, o->rho, v);
    *state = (nh_state){0, nh_arena_alloc(r->arena, (o->m + 1) * sizeof(double)),
                        nh_arena_alloc(r->arena, (o->m + 1) * sizeof(double)), NULL, NULL};
    state->t = p->column[0][0];
    for (size_t s = 0; s < o->m; s++) {
        state->q[s] = p->column[1 + s][0];
        state->v[s] = v[s];
    }
    nh_free(v);
    nh_points_free(p);
    return true;
}
