#include "search/defaults.h"

#include <math.h>

#include "base/linalg.h"
#include "motion/assembly.h"

/* Does the time occur in the equations? */
static bool is_timed(const nh_model *o)
{
    const nh_dag *d = o->dag;
    nh_ex t = o->system->t;
    bool timed = nh_depends(d, o->E, t) || nh_depends(d, o->Lbar, t);
    for (size_t s = 0; s < o->m; s++) timed |= nh_depends(d, o->rho[s], t);
    for (size_t i = 0; i < o->n; i++) timed |= nh_depends(d, o->a[i], t);
    return timed;
}

/* With few digits, as people write a state: a hundredth of the unit is the last one.  Positions that satisfy equations
 * stay as they are. */
static void round_point(const nh_model *o, double *z)
{
    static const double last_digits = 2;
    nh_assembly *equations = nh_assembly_create(o);
    bool free = !equations;
    nh_assembly_free(equations);
    for (size_t i = 0; i < 1 + o->m + o->n; i++) {
        bool position = i >= 1 && i <= o->m;
        double steps = pow(10, last_digits - floor(log10(nh_chart_symbol_unit(o->system, o->chart->symbol[i]))));
        if (!position || free) z[i] = round(z[i] * steps) / steps;
    }
    if (!is_timed(o)) z[0] = 0;
}

/* Sets the velocities of the coordinates at a point of the chart; false where the equations have no values there. */
static bool velocities(const nh_model *o, double *z, double *v)
{
    nh_ex *e = nh_alloc_array(o->m + o->n + 1, sizeof *e);
    double *value = nh_alloc_array(o->m + o->n + 1, sizeof *value);
    for (size_t s = 0; s < o->m; s++) e[s] = o->rho[s];
    for (size_t i = 0; i < o->n; i++) e[o->m + i] = o->a[i];
    nh_tape *tape = nh_model_tape(o, o->m + o->n, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool good = nh_chart_complete(o->chart, z);
    if (good) nh_tape_eval(tape, work, z, value);
    good = good && nh_all_finite(o->m + o->n, value);
    for (size_t s = 0; s < o->m && good; s++) v[s] = value[s];
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(value);
    nh_free(e);
    return good;
}

bool nh_defaults_initial(nh_analysis *r, nh_state *state, nh_error *error)
{
    static const double inner = 0.7; /* part of the box */
    const nh_model *o = r->model;
    nh_points *p = nh_points_create(o, 1, inner, (uint64_t)r->options.seed + 909, error);
    if (!p) return false;
    *state = (nh_state){0, nh_arena_alloc(r->arena, (o->m + 1) * sizeof(double)),
                        nh_arena_alloc(r->arena, (o->m + 1) * sizeof(double)), NULL, NULL};
    double *z = nh_alloc_array(2 * o->width + 1, sizeof *z), *exact = z + o->width;
    for (size_t i = 0; i < o->width; i++) z[i] = exact[i] = p->column[i][0];
    round_point(o, z);
    double *point = velocities(o, z, state->v) ? z : velocities(o, exact, state->v) ? exact : NULL;
    if (point) {
        state->t = point[0];
        for (size_t s = 0; s < o->m; s++) state->q[s] = point[1 + s];
    }
    nh_free(z);
    nh_points_free(p);
    return point || nh_fail(error, NH_NUMERIC, "", "the equations of motion have no finite values at a sample point");
}
