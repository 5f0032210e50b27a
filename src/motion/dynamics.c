/* The equations of motion as problems for the integrators (dynamics.h):
 *
 *      chart        z = (q, w), m + n:     z' = (rho, a)                model's formulas (method.md, sec. 2)
 *                                          d z'/d z exact, or by differences where that program would be long
 *                                          guards: pivot det(df^a/dv^dependent), orientations; walls of the rates
 *      bordered     (q, v), 2 m:           q' = nearest velocity on the constraints, [K F^T; F 0] (v', mu) = -(h, g)
 *      multipliers  (q, v, mu):            the terms K, h, F, g, f for chetaev.h */
#include "motion/dynamics_internal.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "exact/walls.h"
#include "motion/turns.h"

/* ---- equations of motion on the constraint submanifold ---- */

/* The programs of (rho, a), m + n values, and of the walls between them. */
static void make_rates(nh_dynamics *d)
{
    const nh_model *model = d->model;
    nh_ex *e = nh_alloc_array(model->m + model->n, sizeof *e), wall[NH_MOST_WALLS];
    memcpy(e, model->rho, model->m * sizeof *e);
    memcpy(e + model->m, model->a, model->n * sizeof *e);
    d->rate = nh_model_tape(model, model->m + model->n, e);
    d->walls = nh_walls_between(model->dag, model->m + model->n, e, model->width, model->chart->symbol, wall);
    if (d->walls) d->wall = nh_model_tape(model, d->walls, wall);
    nh_free(e);
}

/* A robot of 40 joints has rates of 1e5 instructions, whose Jacobian would have 1e7: differences of the rates are then
   the cheaper ones. */
bool nh_dynamics_differences(size_t length, size_t size)
{
    static const double most = 2e6;
    return (double)length * (double)size > most;
}

/* d(rho, a)_i/dz_j at i + j (m + n). */
static nh_tape *jacobian_tape(const nh_model *model)
{
    size_t size = model->m + model->n;
    nh_ex *e = nh_alloc_array(size * size, sizeof *e);
    for (size_t j = 0; j < size; j++)
        for (size_t i = 0; i < size; i++)
            e[i + j * size] =
                nh_diff(model->dag, i < model->m ? model->rho[i] : model->a[i - model->m], model->chart->symbol[1 + j]);
    nh_tape *tape = nh_model_tape(model, size * size, e);
    nh_free(e);
    return tape;
}

nh_tape *nh_dynamics_velocity_tape(const nh_model *model)
{
    nh_ex *e = nh_alloc_array(model->m * (1 + model->n) + 1, sizeof *e);
    memcpy(e, model->rho, model->m * sizeof *e);
    for (size_t i = 0; i < model->n; i++)
        for (size_t s = 0; s < model->m; s++) e[model->m + s + i * model->m] = model->R[s * model->n + i];
    nh_tape *tape = nh_model_tape(model, model->m * (1 + model->n), e);
    nh_free(e);
    return tape;
}

bool nh_dynamics_watched(const nh_model *model)
{
    return !model->chart->quasi && model->k && !model->chart->implicit && !model->chart->branch;
}

/* A chart of coordinate velocities ends where its dependent velocities are no longer determined. */
static void watch_pivot(nh_dynamics *d)
{
    const nh_model *model = d->model;
    if (!nh_dynamics_watched(model)) return;
    nh_ex *e = nh_alloc_array(model->k * model->m, sizeof *e);
    for (size_t a = 0; a < model->k; a++) {
        nh_ex f = nh_constraint_without_poles(model, a);
        for (size_t s = 0; s < model->m; s++)
            e[a * model->m + s] =
                nh_chart_compose(model->chart, nh_diff(model->dag, f, model->system->coordinate[s].v));
    }
    d->constraint = nh_model_tape(model, model->k * model->m, e);
    nh_free(e);
}

static nh_tape_work *work_of(const nh_tape *tape) { return tape ? nh_tape_work_create(tape) : NULL; }

/* The memory for evaluating the tapes. */
static void make_room(nh_dynamics *d)
{
    size_t m = d->m, n = d->n, k = d->model->k;
    d->rate_work = work_of(d->rate);
    d->jacobian_work = work_of(d->jacobian);
    d->velocity_work = work_of(d->velocity);
    d->constraint_work = work_of(d->constraint);
    d->wall_work = work_of(d->wall);
    d->slope = d->constraint ? nh_alloc_array(k * m + k * m, sizeof *d->slope) : NULL;
    d->point = nh_alloc_array(d->width, sizeof *d->point);
    d->out = nh_alloc_array(m * (1 + n) + 1, sizeof *d->out);
    d->dense = nh_alloc_array(m * n + m + n + 1, sizeof *d->dense);
}

nh_dynamics *nh_dynamics_create(const nh_model *model)
{
    nh_dynamics *d = nh_alloc(sizeof *d);
    *d =
        (nh_dynamics){.model = model, .m = model->m, .n = model->n, .size = model->m + model->n, .width = model->width};
    make_rates(d);
    d->jacobian = nh_dynamics_differences(nh_tape_length(d->rate), d->size) ? NULL : jacobian_tape(model);
    d->velocity = nh_dynamics_velocity_tape(model);
    watch_pivot(d);
    make_room(d);
    return d;
}

nh_dynamics *nh_dynamics_share(const nh_dynamics *other)
{
    nh_dynamics *d = nh_alloc(sizeof *d);
    *d = *other;
    d->shares = true;
    d->start = NULL;
    make_room(d);
    return d;
}

void nh_dynamics_free(nh_dynamics *d)
{
    if (!d) return;
    nh_tape_work_free(d->rate_work);
    nh_tape_work_free(d->jacobian_work);
    nh_tape_work_free(d->velocity_work);
    nh_tape_work_free(d->constraint_work);
    nh_tape_work_free(d->wall_work);
    nh_dynamics_start_free(d->start);
    nh_free(d->slope);
    nh_free(d->point);
    nh_free(d->out);
    nh_free(d->dense);
    nh_tape *const tape[] = {d->rate, d->jacobian, d->velocity, d->constraint, d->wall};
    for (size_t i = 0; i < sizeof tape / sizeof *tape && !d->shares; i++) nh_tape_free(tape[i]);
    nh_free(d);
}

void nh_dynamics_jit(nh_dynamics *d, double patience)
{
    d->patience = patience;
    nh_tape_jit(d->rate_work, patience);
    if (d->jacobian) nh_tape_jit(d->jacobian_work, patience);
    if (d->constraint_work) nh_tape_jit(d->constraint_work, patience);
}

double nh_dynamics_patience(const nh_dynamics *d) { return d->patience; }
size_t nh_dynamics_length(const nh_dynamics *d) { return nh_tape_length(d->rate) + 1; }

const char *nh_dynamics_words(const nh_dynamics *d) { return nh_tape_words(d->rate_work); }

const nh_model *nh_dynamics_model(const nh_dynamics *d) { return d->model; }

/* The implicit velocities start from their last values, so that a motion stays on its branch. */
bool nh_dynamics_point(nh_dynamics *d, double t, const double *z, double *point)
{
    point[0] = t;
    memcpy(point + 1, z, d->size * sizeof *z);
    size_t implicit = d->model->chart->implicit;
    if (!implicit) return true;
    if (point != d->point)
        memcpy(point + d->width - implicit, d->point + d->width - implicit, implicit * sizeof *point);
    if (!nh_chart_complete(d->model->chart, point)) return false;
    memcpy(d->point + d->width - implicit, point + d->width - implicit, implicit * sizeof *point);
    return true;
}

/* z' at (t, z). */
static bool rate_of(double t, const double *z, double *rate, void *context)
{
    nh_dynamics *d = context;
    if (!nh_dynamics_point(d, t, z, d->point)) return false;
    nh_tape_eval(d->rate, d->rate_work, d->point, rate);
    return nh_all_finite(d->size, rate);
}

/* d z'_i/d z_j at jacobian[i + j (m + n)]. */
static bool jacobian_of(double t, const double *z, double *jacobian, void *context)
{
    nh_dynamics *d = context;
    if (!nh_dynamics_point(d, t, z, d->point)) return false;
    nh_tape_eval(d->jacobian, d->jacobian_work, d->point, jacobian);
    return nh_all_finite(d->size * d->size, jacobian);
}

double nh_dynamics_digits_lost(const nh_model *model, const double *F, const double *R)
{
    double lost = 0;
    for (size_t a = 0; a < model->k; a++)
        for (size_t i = 0; i < model->n; i++) {
            double sum = 0, row = 0, column = 0;
            for (size_t s = 0; s < model->m; s++) {
                double unit = nh_chart_unit(model->system, s), f = F[a + s * model->k], r = R[s + i * model->m];
                sum += f * r, row = hypot(row, f * unit), column = hypot(column, r / unit);
            }
            if (sum != 0) lost = fmax(lost, isfinite(sum) ? fabs(sum) / (row * column) : INFINITY);
        }
    return lost;
}

/* A chart without singular points loses none. */
static bool loses_digits(nh_dynamics *d)
{
    size_t m = d->m, k = d->model->k;
    double *F = d->slope + k * m;
    if (d->model->chart->regular) return false;
    nh_tape_eval(d->velocity, d->velocity_work, d->point, d->out);
    for (size_t s = 0; s < m; s++)
        for (size_t a = 0; a < k; a++) F[a + s * k] = d->slope[a * m + s];
    return !(nh_dynamics_digits_lost(d->model, F, d->out + m) < NH_CHART_DIGITS);
}

/* det(df^a/dv^dependent) with rows of |df/dv| = 1: integrators step over its zeros without notice. */
static bool pivot_of(nh_dynamics *d, double t, const double *z, double *value)
{
    size_t m = d->m, k = d->model->k;
    double *part = d->slope + k * m;
    if (!nh_dynamics_point(d, t, z, d->point)) return false;
    nh_tape_eval(d->constraint, d->constraint_work, d->point, d->slope);
    for (size_t a = 0; a < k; a++) {
        double norm = 0;
        for (size_t s = 0; s < m; s++) norm = hypot(norm, d->slope[a * m + s]);
        for (size_t b = 0; b < k; b++)
            part[a + b * k] = d->slope[a * m + d->model->chart->dependent[b]] / (norm > 0 ? norm : 1);
    }
    *value = nh_determinant(k, part);
    return isfinite(*value);
}

/* The chart ends where its pivot does; and where its formulas lose their digits, because a divisor vanishes and the
 * pivot does not: with the sign of the other side. */
static bool end_of_chart(double t, const double *z, double *value, void *context)
{
    nh_dynamics *d = context;
    if (!pivot_of(d, t, z, value)) return false;
    *value -= d->least;
    if (*value * d->least >= 0 && loses_digits(d)) *value = d->least != 0 ? -*value : 0;
    return true;
}

void nh_dynamics_end_early(nh_dynamics *d, double t, const double *z)
{
    static const double small = 0.01;
    double pivot = 0;
    d->least = 0;
    if (d->constraint && pivot_of(d, t, z, &pivot)) d->least = small * pivot;
}

/* The walls' values. */
static bool walls_of(double t, const double *z, double *value, void *context)
{
    nh_dynamics *d = context;
    if (!nh_dynamics_point(d, t, z, d->point)) return false;
    nh_tape_eval(d->wall, d->wall_work, d->point, value);
    return true;
}

/* The pivot, and the guards of orientations. */
static bool guards_of(double t, const double *z, double *value, void *context)
{
    nh_dynamics *d = context;
    if (d->constraint && !end_of_chart(t, z, value, d)) return false;
    nh_turns_guard(d->model->system, z, value + (d->constraint ? 1 : 0));
    return true;
}

static bool renew(double *z, void *context) { return nh_turns_renew(((nh_dynamics *)context)->model->system, z, NULL); }

nh_flow_problem nh_dynamics_problem(nh_dynamics *d)
{
    size_t turns = d->model->chart->quasi ? d->model->system->orientations : 0;
    return (nh_flow_problem){.size = d->size,
                             .context = d,
                             .rate = rate_of,
                             .jacobian = d->jacobian ? jacobian_of : NULL,
                             .guards = (d->constraint ? 1 : 0) + turns,
                             .guard = turns           ? guards_of
                                      : d->constraint ? end_of_chart
                                                      : NULL,
                             .turns = turns,
                             .renew = turns ? renew : NULL,
                             .walls = d->walls,
                             .wall = walls_of};
}

/* ---- multiplier form ---- */

/* K, h, F, g, f at (t, q, v), for the multiplier form. */
static bool terms_of(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f,
                     void *context)
{
    return nh_bordered_terms(context, t, q, v, K, h, F, g, f);
}

nh_chetaev_problem nh_bordered_problem(nh_bordered *b)
{
    return (nh_chetaev_problem){.coordinates = nh_bordered_coordinates(b),
                                .constraints = nh_bordered_constraints(b),
                                .context = b,
                                .terms = terms_of};
}

/* q' is the nearest velocity that satisfies the constraints: what the errors of the steps add to v does not move the
 * positions off the constraints. */
static bool bordered_rate(double t, const double *z, double *rate, void *context)
{
    size_t m = nh_bordered_coordinates(context);
    bool good = nh_bordered_rates(context, t, z, z + m, rate + m, rate);
    for (size_t s = 0; s < m; s++) rate[s] += z[m + s];
    return good;
}

static bool bordered_walls(double t, const double *z, double *value, void *context)
{
    return nh_bordered_wall(context, t, z, value), true;
}

static bool bordered_guards(double t, const double *z, double *value, void *context)
{
    (void)t;
    nh_turns_guard(nh_bordered_system(context), z, value);
    return true;
}

static bool bordered_renew(double *z, void *context)
{
    return nh_turns_renew(nh_bordered_system(context), z, z + nh_bordered_coordinates(context));
}

nh_flow_problem nh_bordered_flow(nh_bordered *b)
{
    size_t turns = nh_bordered_system(b)->orientations;
    return (nh_flow_problem){.size = 2 * nh_bordered_coordinates(b),
                             .context = b,
                             .rate = bordered_rate,
                             .guards = turns,
                             .guard = turns ? bordered_guards : NULL,
                             .turns = turns,
                             .renew = turns ? bordered_renew : NULL,
                             .walls = nh_bordered_walls(b),
                             .wall = bordered_walls};
}
