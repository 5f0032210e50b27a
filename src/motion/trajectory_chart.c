/* trajectory_chart: where a chart breaks down, and the motion in all coordinates. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/terms.h"
#include "motion/automatic.h"
#include "motion/trajectory.h"

/* largest |R| of a chart of coordinate velocities, without units: above it the formulas lose digits */
static const double steepest = 10;

bool nh_may_leave_chart(const nh_model *model)
{
    nh_ex *inverse = nh_alloc_array(model->n + 1, sizeof *inverse);
    bool may = model->k && (!model->chart->quasi || nh_chart_inverse(model->chart, inverse));
    nh_free(inverse);
    return may;
}

bool *nh_steep_entries(size_t count, size_t n, const double *R, const double *factor, bool *any)
{
    bool *flag = nh_alloc_array(count + 1, sizeof *flag);
    *any = false;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < n; j++) flag[i] |= !(fabs(R[i * n + j] * factor[j]) < steepest);
        *any |= flag[i];
    }
    return flag;
}

bool *nh_steep_points(nh_dynamics *dynamics, const nh_motion *motion, bool *any)
{
    const nh_model *model = nh_dynamics_model(dynamics);
    size_t n = model->m * model->n;
    double *R = nh_alloc_array(n * (motion->count + 1) + 1, sizeof *R), *factor = R + n * motion->count;
    nh_chart_slopes(model->chart, factor);
    bool good =
             !model->chart->quasi && !model->chart->regular && model->k && nh_along(dynamics, motion, n, model->R, R),
         *flag = nh_steep_entries(good ? motion->count : 0, n, R, factor, any);
    if (!good) flag = (nh_free(flag), nh_alloc_array(motion->count + 1, sizeof *flag));
    nh_free(R);
    return flag;
}

/* Moves velocities onto the constraints. */
static void settle(nh_bordered *b, size_t m, double t, double *state, double *work)
{
    if (!nh_bordered_rates(b, t, state, state + m, work, work + m)) return;
    for (size_t s = 0; s < m; s++) state[m + s] += work[m + s];
}

static void settle_all(nh_bordered *b, nh_motion *motion)
{
    size_t m = nh_bordered_coordinates(b), size = motion->size;
    double *work = nh_alloc_array(2 * m + 1, sizeof *work);
    if (size != 2 * m) return nh_free(work);
    for (size_t i = 1; i < motion->count; i++) settle(b, m, motion->time[i], motion->state + i * size, work);
    for (size_t i = 0; i < motion->events; i++)
        settle(b, m, motion->event[i].time, motion->event_state + i * size, work);
    if (motion->end_state) settle(b, m, motion->end_time, motion->end_state, work);
    nh_free(work);
}

nh_motion *nh_motion_everywhere(nh_dynamics *dynamics, const nh_method *method, const double *initial, size_t count,
                                const double *times, const nh_flow_options *given, char *machine,
                                const nh_method **used, nh_error *error)
{
    const nh_model *model = nh_dynamics_model(dynamics);
    size_t m = model->m;
    nh_bordered *b = nh_bordered_create(model);
    nh_bordered_jit(b, nh_dynamics_patience(dynamics));
    nh_flow_problem problem = nh_bordered_flow(b);
    nh_flow_options options = *given;
    double *scale = given->scale ? nh_alloc_array(2 * m, sizeof *scale) : NULL;
    for (size_t s = 0; s < 2 * m && scale; s++) scale[s] = given->scale[0];
    options.scale = scale;
    nh_motion *motion = nh_automatic_or(method, &problem, initial, count, times, &options, used, error);
    if (motion) settle_all(b, motion);
    const char *words = nh_bordered_words(b);
    if (machine) snprintf(machine, NH_TRAJECTORY_MACHINE, "%s", words ? words : "interpreted");
    nh_free(scale);
    nh_bordered_free(b);
    return motion;
}

/* ---- requests of threads ---- */

nh_trajectory_own nh_trajectory_own_create(const nh_trajectory_request *request)
{
    nh_trajectory_own own = {.request = *request, .dag = nh_dag_copy(request->model->dag)};
    own.request.model = own.model = nh_model_copy(request->model, own.dag);
    if (request->other) own.request.other = own.other = nh_model_copy(request->other, own.dag);
    own.request.programs = NULL;
    return own;
}

void nh_trajectory_own_free(nh_trajectory_own *own)
{
    nh_model_copy_free(own->other);
    nh_model_copy_free(own->model);
    nh_dag_free(own->dag);
}
