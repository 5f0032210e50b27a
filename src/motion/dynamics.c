#include "motion/dynamics.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "exact/walls.h"
#include "motion/turns.h"

/* ---- equations of motion on the constraint submanifold ---- */

struct nh_dynamics {
    const nh_model *model;
    size_t m, n, size, width;
    nh_tape *rate, *jacobian, *velocity; /* jacobian: NULL where it is long; velocity: rho and R */
    nh_tape_work *rate_work, *jacobian_work, *velocity_work;
    double *point, *out, *dense;
    nh_tape *constraint; /* df^a/dv^s (k x m, row-major), of constraints without poles; NULL: no pivot to watch */
    nh_tape_work *constraint_work;
    double *slope;       /* values of these derivatives, and the k x k part of the dependent velocities */
    double least;        /* the pivot at which the chart ends; it has the sign of the pivot at the start */
    size_t walls;        /* number of walls of the rates (exact/walls.h) */
    nh_tape *wall;       /* NULL: there are none */
    nh_tape_work *wall_work;
    double patience;
    bool shares;         /* another nh_dynamics owns the tapes */
};

static void make_rates(nh_dynamics *d)
{
    const nh_model *o = d->model;
    nh_ex *e = nh_alloc_array(o->m + o->n, sizeof *e), wall[NH_MOST_WALLS];
    memcpy(e, o->rho, o->m * sizeof *e);
    memcpy(e + o->m, o->a, o->n * sizeof *e);
    d->rate = nh_model_tape(o, o->m + o->n, e);
    d->walls = nh_walls_between(o->dag, o->m + o->n, e, o->width, o->chart->symbol, wall);
    if (d->walls) d->wall = nh_model_tape(o, d->walls, wall);
    nh_free(e);
}

/* A robot of 40 joints has rates of 1e5 instructions, whose Jacobian would have 1e7: differences of the rates are then
   the cheaper ones. */
bool nh_dynamics_differences(size_t length, size_t size)
{
    static const double most = 2e6;
    return (double)length * (double)size > most;
}

static nh_tape *jacobian_tape(const nh_model *o)
{
    size_t size = o->m + o->n;
    nh_ex *e = nh_alloc_array(size * size, sizeof *e);
    for (size_t j = 0; j < size; j++)
        for (size_t i = 0; i < size; i++)
            e[i + j * size] = nh_diff(o->dag, i < o->m ? o->rho[i] : o->a[i - o->m], o->chart->symbol[1 + j]);
    nh_tape *tape = nh_model_tape(o, size * size, e);
    nh_free(e);
    return tape;
}

static nh_tape *velocity_tape(const nh_model *o)
{
    nh_ex *e = nh_alloc_array(o->m * (1 + o->n) + 1, sizeof *e);
    memcpy(e, o->rho, o->m * sizeof *e);
    for (size_t i = 0; i < o->n; i++)
        for (size_t s = 0; s < o->m; s++) e[o->m + s + i * o->m] = o->R[s * o->n + i];
    nh_tape *tape = nh_model_tape(o, o->m * (1 + o->n), e);
    nh_free(e);
    return tape;
}

bool nh_dynamics_watched(const nh_model *o)
{
    return !o->chart->quasi && o->k && !o->chart->implicit && !o->chart->branch;
}

/* A chart of coordinate velocities ends where its dependent velocities are no longer determined. */
static void watch_pivot(nh_dynamics *d)
{
    const nh_model *o = d->model;
    if (!nh_dynamics_watched(o)) return;
    nh_ex *e = nh_alloc_array(o->k * o->m, sizeof *e);
    for (size_t a = 0; a < o->k; a++) {
        nh_ex f = nh_constraint_without_poles(o, a);
        for (size_t s = 0; s < o->m; s++)
            e[a * o->m + s] = nh_chart_compose(o->chart, nh_diff(o->dag, f, o->system->coordinate[s].v));
    }
    d->constraint = nh_model_tape(o, o->k * o->m, e);
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
    d->slope = d->constraint ? nh_alloc_array(k * m + k * k, sizeof *d->slope) : NULL;
    d->point = nh_alloc_array(d->width, sizeof *d->point);
    d->out = nh_alloc_array(m * (1 + n) + 1, sizeof *d->out);
    d->dense = nh_alloc_array(m * n + m + n + 1, sizeof *d->dense);
}

nh_dynamics *nh_dynamics_create(const nh_model *o)
{
    nh_dynamics *d = nh_alloc(sizeof *d);
    *d = (nh_dynamics){.model = o, .m = o->m, .n = o->n, .size = o->m + o->n, .width = o->width};
    make_rates(d);
    d->jacobian = nh_dynamics_differences(nh_tape_length(d->rate), d->size) ? NULL : jacobian_tape(o);
    d->velocity = velocity_tape(o);
    watch_pivot(d);
    make_room(d);
    return d;
}

nh_dynamics *nh_dynamics_share(const nh_dynamics *other)
{
    nh_dynamics *d = nh_alloc(sizeof *d);
    *d = *other;
    d->shares = true;
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

static bool rate_of(double t, const double *z, double *rate, void *context)
{
    nh_dynamics *d = context;
    if (!nh_dynamics_point(d, t, z, d->point)) return false;
    nh_tape_eval(d->rate, d->rate_work, d->point, rate);
    return nh_all_finite(d->size, rate);
}

static bool jacobian_of(double t, const double *z, double *jacobian, void *context)
{
    nh_dynamics *d = context;
    if (!nh_dynamics_point(d, t, z, d->point)) return false;
    nh_tape_eval(d->jacobian, d->jacobian_work, d->point, jacobian);
    return nh_all_finite(d->size * d->size, jacobian);
}

/* det(df^a/dv^dependent) with rows of |df/dv| = 1: integrators step over its zeros without notice. */
static bool pivot_of(double t, const double *z, double *value, void *context)
{
    nh_dynamics *d = context;
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
    *value -= d->least;
    return isfinite(*value);
}

void nh_dynamics_end_early(nh_dynamics *d, double t, const double *z)
{
    static const double small = 0.01;
    double pivot = 0;
    d->least = 0;
    if (d->constraint && pivot_of(t, z, &pivot, d)) d->least = small * pivot;
}

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
    if (d->constraint && !pivot_of(t, z, value, d)) return false;
    nh_turns_guard(d->model->system, z, value + (d->constraint ? 1 : 0));
    return true;
}

static bool renew(double *z, void *context)
{
    return nh_turns_renew(((nh_dynamics *)context)->model->system, z, NULL);
}

nh_flow_problem nh_dynamics_problem(nh_dynamics *d)
{
    size_t turns = d->model->chart->quasi ? d->model->system->orientations : 0;
    return (nh_flow_problem){.size = d->size,
                             .context = d,
                             .rate = rate_of,
                             .jacobian = d->jacobian ? jacobian_of : NULL,
                             .guards = (d->constraint ? 1 : 0) + turns,
                             .guard = turns ? guards_of : d->constraint ? pivot_of : NULL,
                             .turns = turns,
                             .renew = turns ? renew : NULL,
                             .walls = d->walls,
                             .wall = walls_of};
}

/* ---- initial states ---- */

/* One Gauss-Newton step of rho(w) = v for the given velocities; the largest |dw_i| beside |w_i| and the step's largest
 * part, negative on failure: no unit matters but for velocities of several kinds, of which the large ones decide. */
static double fit_step(nh_dynamics *d, const nh_state *state, double *w)
{
    size_t m = d->m, n = d->n;
    nh_tape_eval(d->velocity, d->velocity_work, d->point, d->out);
    if (!nh_all_finite(m * (1 + n), d->out)) return -1;
    double *R = d->dense, *b = R + m * n, step = 0, size = 0;
    memcpy(R, d->out + m, m * n * sizeof *R);
    for (size_t s = 0; s < m; s++) {
        bool counts = !state->given || state->given[s];
        b[s] = counts ? state->v[s] - d->out[s] : 0;
        for (size_t i = 0; i < n && !counts; i++) R[s + i * m] = 0;
    }
    if (nh_least_squares(m, n, R, 1, b, m, 1e-12) < 0) return -1;
    for (size_t i = 0; i < n; i++) {
        w[i] += b[i];
        step = fmax(step, fabs(b[i]));
        size = fmax(size, fabs(w[i]));
    }
    return step > 0 ? step / fmax(step, size) : 0;
}

/* The largest of |v_s| and the terms of rho_s = R_si w_i + b_s. */
static double size_of_velocity(const nh_dynamics *d, const nh_state *state, const double *w, size_t s)
{
    const double *R = d->out + d->m;
    double largest = fabs(state->v[s]), sum = 0;
    for (size_t i = 0; i < d->n; i++) {
        largest = fmax(largest, fabs(R[s + i * d->m] * w[i]));
        sum += R[s + i * d->m] * w[i];
    }
    return fmax(largest, fabs(d->out[s] - sum));
}

/* |v_s - rho_s| beside the sizes of the velocities of this kind (angles, or others); *off: the difference itself where
   that is largest. */
static double mismatch(nh_dynamics *d, const nh_state *state, const double *w, double *off)
{
    const nh_system *system = d->model->system;
    double worst = 0, size[2] = {0, 0};
    nh_tape_eval(d->velocity, d->velocity_work, d->point, d->out);
    for (size_t s = 0; s < d->m; s++) {
        bool angle = system->coordinate[s].type == NH_ANGLE;
        size[angle] = fmax(size[angle], size_of_velocity(d, state, w, s));
    }
    for (size_t s = 0; s < d->m; s++) {
        double difference = fabs(state->v[s] - d->out[s]), beside = size[system->coordinate[s].type == NH_ANGLE];
        if ((state->given && !state->given[s]) || !(difference > worst * beside)) continue;
        worst = difference / beside;
        *off = difference;
    }
    return worst;
}

bool nh_dynamics_start(nh_dynamics *d, const nh_state *state, bool project, double *z, nh_error *error)
{
    enum { most_steps = 50 };
    static const double on_constraint = 1e-9;
    const nh_chart *c = d->model->chart;
    memcpy(z, state->q, d->m * sizeof *z);
    memset(z + d->m, 0, d->n * sizeof *z);
    for (size_t i = 0; i < d->n && !c->quasi; i++)
        for (size_t s = 0; s < d->m; s++)
            if (c->w[i] == d->model->system->coordinate[s].v) z[d->m + i] = state->v[s];
    for (size_t a = 0; a < c->implicit; a++) d->point[d->width - c->implicit + a] = state->v[c->dependent[a]];
    double size = 1;
    for (int i = 0; i < most_steps && size > 1e-15; i++) {
        if (!nh_dynamics_point(d, state->t, z, d->point)) size = -1;
        else size = fit_step(d, state, z + d->m);
    }
    if (size < 0 || !nh_dynamics_point(d, state->t, z, d->point)) {
        nh_fail(error, NH_NUMERIC, "",
                "the initial state does not lie in the chart of %s: no velocities near the given ones satisfy the "
                "constraints",
                c->name);
        return nh_error_hint(error, "give fewer velocities (the constraints determine the others), change the values, "
                                    "or choose another branch by `domain:`");
    }
    double off = 0;
    if (mismatch(d, state, z + d->m, &off) <= on_constraint || project) return true;
    nh_fail(error, NH_USAGE, "", "the initial velocities violate the constraints: the residual is %.3g", off);
    return nh_error_hint(error, "omit the dependent velocities, which the constraints determine; or use --project, "
                                "which takes the nearest velocities that satisfy the constraints");
}

/* Expressions of (t, q, v) at a state. */
static void values_at(const nh_model *o, const nh_state *state, size_t n, const nh_ex *e, double *value)
{
    const nh_system *y = o->system;
    nh_ex *in = nh_alloc_array(1 + 2 * o->m, sizeof *in);
    double *z = nh_alloc_array(1 + 2 * o->m, sizeof *z);
    in[0] = y->t;
    z[0] = state->t;
    for (size_t s = 0; s < o->m; s++) {
        in[1 + s] = y->coordinate[s].q;
        in[1 + o->m + s] = y->coordinate[s].v;
        z[1 + s] = state->q[s];
        z[1 + o->m + s] = state->v[s];
    }
    nh_tape *tape = nh_tape_create(o->dag, 1 + 2 * o->m, in, n, e, y->parameters, o->parameter, o->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, value);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(z);
    nh_free(in);
}

bool nh_dynamics_other_branch(const nh_model *o, const nh_state *state)
{
    const nh_chart *c = o->chart;
    double root;
    if (!c->branch || (state->given && !state->given[c->dependent[0]])) return false;
    values_at(o, state, 1, &c->root, &root);
    return root < 0;
}

/* Gaussian elimination with complete pivoting of F (k x m, by rows) among the columns that are allowed: which columns,
 * and the smallest pivot relative to the largest. */
static double eliminate(size_t k, size_t m, const double *F, const bool *allowed, size_t *column)
{
    double *a = nh_alloc_array(k * m + 1, sizeof *a), first = 0, last = 0;
    bool *used = nh_alloc_array(m + k + 1, sizeof *used), *done = used + m;
    memcpy(a, F, k * m * sizeof *a);
    for (size_t step = 0; step < k; step++) {
        size_t row = 0, at = 0;
        last = 0;
        for (size_t i = 0; i < k; i++)
            for (size_t j = 0; j < m; j++)
                if (!done[i] && !used[j] && (!allowed || allowed[j]) && fabs(a[i * m + j]) > last)
                    last = fabs(a[i * m + j]), row = i, at = j;
        if (!(last > 0)) break;
        if (step == 0) first = last;
        done[row] = used[at] = true;
        column[step] = at;
        for (size_t i = 0; i < k; i++) {
            double factor = done[i] ? 0 : a[i * m + at] / a[row * m + at];
            for (size_t j = 0; j < m && factor != 0; j++) a[i * m + j] -= factor * a[row * m + j];
        }
    }
    nh_free(used);
    nh_free(a);
    return last > 0 ? last / first : 0;
}

bool nh_dynamics_other_dependents(const nh_model *o, const nh_state *state, size_t *dependent)
{
    static const double singular = 1e-8;
    size_t k = o->k, m = o->m;
    if (!nh_dynamics_watched(o)) return false;
    nh_ex *e = nh_alloc_array(k * m + 1, sizeof *e);
    double *F = nh_alloc_array(k * m + 1, sizeof *F);
    bool *own = nh_alloc_array(m + 1, sizeof *own);
    for (size_t a = 0; a < k; a++) {
        nh_ex f = nh_constraint_without_poles(o, a);
        for (size_t s = 0; s < m; s++) e[a * m + s] = nh_diff(o->dag, f, o->system->coordinate[s].v);
        own[o->chart->dependent[a]] = true;
    }
    values_at(o, state, k * m, e, F);
    for (size_t a = 0; a < k; a++) { /* scale the rows to one size */
        double size = 0;
        for (size_t s = 0; s < m; s++) size = fmax(size, fabs(F[a * m + s]));
        for (size_t s = 0; s < m && size > 0; s++) F[a * m + s] /= size;
    }
    bool other = nh_all_finite(k * m, F) && eliminate(k, m, F, own, dependent) < singular &&
                 eliminate(k, m, F, NULL, dependent) > singular;
    nh_free(own);
    nh_free(F);
    nh_free(e);
    return other;
}

/* ---- multiplier form ---- */

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

static bool bordered_rate(double t, const double *z, double *rate, void *context)
{
    size_t m = nh_bordered_coordinates(context);
    memcpy(rate, z + m, m * sizeof *rate);
    return nh_bordered_accelerations(context, t, z, z + m, rate + m);
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
