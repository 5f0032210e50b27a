#include "motion/along.h"

#include <string.h>

#include "graph/dag.h"

struct nh_along_values {
    const nh_model *model;
    size_t n;
    nh_to_point *place;
    void *context;
    nh_tape *tape;
    nh_tape_work *work;
    double *point;
    nh_dynamics *other;          /* the model in other velocities, and */
    nh_along_values *velocities; /* its coordinate velocities */
};

/* ---- in the chart ---- */

static bool point_of_all(void *context, double t, const double *z, double *point)
{
    return nh_dynamics_point(context, t, z, point);
}

nh_along_values *nh_along_values_create(const nh_model *model, nh_to_point *place, void *context, size_t n,
                                        const nh_ex *e)
{
    nh_along_values *v = nh_alloc(sizeof *v);
    *v = (nh_along_values){.model = model,
                           .n = n,
                           .place = place,
                           .context = context,
                           .tape = nh_model_tape(model, n, e),
                           .point = nh_alloc_array(model->width, sizeof *v->point)};
    v->work = nh_tape_work_create(v->tape);
    return v;
}

/* ---- in all coordinates ---- */

/* An expression of the chart in (t, q, v), where it holds beyond the chart: implicit velocities and roots are
 * velocities there.  `inverse`: quasi-velocities in v. */
static nh_ex everywhere(const nh_model *model, const nh_ex *inverse, nh_ex e)
{
    const nh_chart *c = model->chart;
    for (size_t s = 0; s < model->m; s++)
        if (e == model->rho[s]) return model->system->coordinate[s].v;
    nh_ex *v = nh_alloc_array(c->implicit + 1, sizeof *v);
    for (size_t a = 0; a < c->implicit; a++) v[a] = model->system->coordinate[c->dependent[a]].v;
    e = nh_substitute(model->dag, e, c->implicit, c->u, v);
    nh_free(v);
    if (c->quasi) e = nh_substitute(model->dag, e, model->n, c->w, inverse);
    return c->branch ? nh_chart_both_branches(c, e) : e;
}

/* The point (t, q, v) of a state (q, v). */
static bool point_everywhere(void *context, double t, const double *z, double *point)
{
    const nh_along_values *v = context;
    point[0] = t;
    memcpy(point + 1, z, 2 * v->model->m * sizeof *point);
    return true;
}

/* The point (t, q, v) of a state of another model. */
static bool point_by_other(void *context, double t, const double *z, double *point)
{
    nh_along_values *v = context;
    size_t m = v->model->m;
    point[0] = t;
    memcpy(point + 1, z, m * sizeof *point);
    return nh_along_values_at(v->velocities, t, z, point + 1 + m);
}

static nh_along_values *in_coordinates(const nh_model *model, size_t n, const nh_ex *e)
{
    size_t m = model->m;
    nh_along_values *v = nh_alloc(sizeof *v);
    nh_ex *in = nh_alloc_array(1 + 2 * m, sizeof *in), *out = nh_alloc_array(n + 1, sizeof *out);
    in[0] = model->system->t;
    for (size_t s = 0; s < m; s++) {
        in[1 + s] = model->system->coordinate[s].q;
        in[1 + m + s] = model->system->coordinate[s].v;
    }
    nh_ex *inverse = nh_alloc_array(model->n + 1, sizeof *inverse);
    if (model->chart->quasi) nh_chart_inverse(model->chart, inverse);
    for (size_t k = 0; k < n; k++) out[k] = everywhere(model, inverse, e[k]);
    nh_free(inverse);
    *v = (nh_along_values){.model = model,
                           .n = n,
                           .place = point_everywhere,
                           .context = v,
                           .point = nh_alloc_array(1 + 2 * m, sizeof *v->point)};
    v->tape = nh_tape_create(model->dag, 1 + 2 * m, in, n, out, model->system->parameters, model->parameter,
                             model->parameter_value);
    v->work = nh_tape_work_create(v->tape);
    nh_free(out);
    nh_free(in);
    return v;
}

nh_along_values *nh_along_values_of(nh_dynamics *dynamics, bool all, size_t n, const nh_ex *e)
{
    const nh_model *model = nh_dynamics_model(dynamics);
    return all ? in_coordinates(model, n, e) : nh_along_values_create(model, point_of_all, dynamics, n, e);
}

nh_along_values *nh_along_values_by_other(const nh_model *model, nh_dynamics *other, size_t n, const nh_ex *e)
{
    nh_along_values *v = in_coordinates(model, n, e);
    v->velocities = nh_along_values_of(other, false, model->m, nh_dynamics_model(other)->rho);
    v->place = point_by_other;
    return v;
}

void nh_along_values_free(nh_along_values *v)
{
    if (!v) return;
    nh_along_values_free(v->velocities);
    nh_tape_work_free(v->work);
    nh_tape_free(v->tape);
    nh_free(v->point);
    nh_free(v);
}

/* ---- along a motion ---- */

bool nh_along_values_at(nh_along_values *v, double t, const double *z, double *value)
{
    if (!v->place(v->context, t, z, v->point)) return false;
    nh_tape_eval(v->tape, v->work, v->point, value);
    return true;
}

bool nh_along_values_outputs(nh_along_values *v, const nh_motion *motion, double *value)
{
    bool good = true;
    for (size_t i = 0; i < motion->count && good; i++)
        good = nh_along_values_at(v, motion->time[i], motion->state + i * motion->size, value + i * v->n);
    return good;
}

bool nh_along_values_events(nh_along_values *v, const nh_motion *motion, double *value)
{
    bool good = true;
    for (size_t i = 0; i < motion->events && good; i++)
        good = nh_along_values_at(v, motion->event[i].time, motion->event_state + i * motion->size, value + i * v->n);
    return good;
}

bool nh_along(nh_dynamics *dynamics, const nh_motion *motion, size_t n, const nh_ex *e, double *value)
{
    const nh_model *model = nh_dynamics_model(dynamics);
    nh_along_values *v = nh_along_values_of(dynamics, motion->size > model->m + model->n, n, e);
    bool good = nh_along_values_outputs(v, motion, value);
    nh_along_values_free(v);
    return good;
}

/* `count` states (q, w) at these times as (q, v); NULL where implicit velocities cannot be found. */
static double *in_all(nh_along_values *velocities, size_t count, size_t size, const double *time, const double *state)
{
    size_t m = velocities->model->m;
    double *out = nh_alloc_array(2 * count * m + 1, sizeof *out);
    for (size_t i = 0; i < count; i++) {
        memcpy(out + 2 * i * m, state + i * size, m * sizeof *out);
        if (!nh_along_values_at(velocities, time[i], state + i * size, out + (2 * i + 1) * m))
            return nh_free(out), NULL;
    }
    return out;
}

bool nh_states_in_coordinates(nh_dynamics *dynamics, const nh_motion *motion, double *states)
{
    const nh_model *model = nh_dynamics_model(dynamics);
    nh_along_values *v = nh_along_values_of(dynamics, motion->size > model->m + model->n, model->m, model->rho);
    double *all = in_all(v, motion->count, motion->size, motion->time, motion->state);
    if (all) memcpy(states, all, 2 * motion->count * model->m * sizeof *states);
    nh_free(all);
    nh_along_values_free(v);
    return all != NULL;
}

static bool replaced(double **states, double *by)
{
    if (!by) return false;
    nh_free(*states);
    *states = by;
    return true;
}

bool nh_motion_to_coordinates(nh_dynamics *dynamics, nh_motion *motion)
{
    const nh_model *model = nh_dynamics_model(dynamics);
    nh_along_values *v = nh_along_values_of(dynamics, false, model->m, model->rho);
    double *time = nh_alloc_array(motion->events + 1, sizeof *time);
    for (size_t i = 0; i < motion->events; i++) time[i] = motion->event[i].time;
    bool good = replaced(&motion->state, in_all(v, motion->count, motion->size, motion->time, motion->state)) &&
                replaced(&motion->event_state, in_all(v, motion->events, motion->size, time, motion->event_state)) &&
                replaced(&motion->end_state, in_all(v, 1, motion->size, &motion->end_time, motion->end_state));
    motion->size = 2 * model->m;
    nh_free(time);
    nh_along_values_free(v);
    return good;
}
