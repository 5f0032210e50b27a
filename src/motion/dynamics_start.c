/* dynamics_start: the velocities at the start of a motion.
 *
 * They come from the constraints themselves, F v + b = 0 at (t, q), in all coordinates, not from a chart: its formulas
 * may be 0/0 at a regular state.  Velocities are measured by the diagonal of the kinetic energy, s_i = K_ii^(-1/2), and
 * rows of F by their length, so that no unit matters; rows that depend on others there are left out by a rank decision
 * (pivoted QR), and are harmless where they agree with the others. */
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/text.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "motion/dynamics_internal.h"

/* relative: smaller singular values of F are zero; a smaller residual is rounding of the numbers that were given */
static const double dependent_row = 1e-10, on_constraint = 1e-9;
/* A velocity that is larger than all that it follows from by this factor follows by a coefficient that is rounding. */
static const double follows_by_rounding = 1e12;

struct nh_start {
    const nh_model *model;
    size_t m, k;
    nh_tape *tape; /* f (k), F (k x m, column-major), K_ii (m) at (t, q, v) */
    nh_tape_work *work;
    double *in, *out, *scale, *A, *step, *row; /* scale: s_i (m); A: F s (k x m), its rows of length 1; row: k */
    bool *some;                                /* m */
};

/* d2L/dv_i dv_i */
static void inertias(const nh_model *model, nh_ex *K)
{
    const nh_system *system = model->system;
    nh_ex rest = system->lagrangian;
    const nh_chain *chain = nh_model_chain(model, &rest);
    for (size_t s = 0; s < model->m; s++) {
        nh_ex v = system->coordinate[s].v;
        K[s] = nh_diff(model->dag, nh_diff(model->dag, rest, v), v);
        if (chain) K[s] = nh_add(model->dag, K[s], chain->K[s * model->m + s]);
    }
}

static nh_start *create(const nh_model *model)
{
    const nh_system *system = model->system;
    size_t m = model->m, k = model->k, total = k + k * m + m;
    nh_ex *in = nh_alloc_array(1 + 2 * m, sizeof *in), *e = nh_alloc_array(total, sizeof *e);
    in[0] = system->t;
    for (size_t s = 0; s < m; s++) in[1 + s] = system->coordinate[s].q, in[1 + m + s] = system->coordinate[s].v;
    for (size_t a = 0; a < k; a++) {
        e[a] = nh_constraint_without_poles(model, a);
        for (size_t s = 0; s < m; s++) e[k + a + s * k] = nh_diff(model->dag, e[a], system->coordinate[s].v);
    }
    inertias(model, e + k + k * m);
    nh_start *c = nh_alloc(sizeof *c);
    *c = (nh_start){.model = model, .m = m, .k = k};
    c->tape = nh_tape_create(model->dag, 1 + 2 * m, in, total, e, system->parameters, model->parameter,
                             model->parameter_value);
    c->work = nh_tape_work_create(c->tape);
    c->in = nh_alloc_array(1 + 2 * m + total + m + k * m + (m + k) + k + 1, sizeof *c->in);
    c->out = c->in + 1 + 2 * m, c->scale = c->out + total, c->A = c->scale + m, c->step = c->A + k * m;
    c->row = c->step + m + k;
    c->some = nh_alloc_array(m + 1, sizeof *c->some);
    nh_free(e);
    nh_free(in);
    return c;
}

void nh_dynamics_start_free(nh_start *c)
{
    if (!c) return;
    nh_tape_work_free(c->work);
    nh_tape_free(c->tape);
    nh_free(c->in);
    nh_free(c->some);
    nh_free(c);
}

static nh_start *start_of(nh_dynamics *d) { return d->start ? d->start : (d->start = create(d->model)); }

/* s_i; of coordinates without inertia that of the others, in their units. */
static void measure(nh_start *c)
{
    const double *K = c->out + c->k + c->k * c->m;
    double usual = 0;
    for (size_t s = 0; s < c->m; s++)
        if (K[s] != 0) usual = fmax(usual, 1 / sqrt(fabs(K[s])) / nh_chart_unit(c->model->system, s));
    for (size_t s = 0; s < c->m; s++)
        c->scale[s] = K[s] != 0 ? 1 / sqrt(fabs(K[s])) : (usual > 0 ? usual : 1) * nh_chart_unit(c->model->system, s);
}

/* f, and F with columns s_i and rows of length 1 in A.  False when not finite. */
static bool evaluate(nh_start *c, double t, const double *q, const double *v)
{
    size_t m = c->m, k = c->k;
    c->in[0] = t;
    memcpy(c->in + 1, q, m * sizeof *q);
    memcpy(c->in + 1 + m, v, m * sizeof *v);
    nh_tape_eval(c->tape, c->work, c->in, c->out);
    if (!nh_all_finite(k + k * m + m, c->out)) return false;
    measure(c);
    for (size_t a = 0; a < k; a++) {
        double size = 0;
        for (size_t s = 0; s < m; s++) size = hypot(size, c->out[k + a + s * k] * c->scale[s]);
        c->row[a] = size > 0 ? size : 1;
        for (size_t s = 0; s < m; s++) c->A[a + s * k] = c->out[k + a + s * k] * c->scale[s] / c->row[a];
        c->out[a] /= c->row[a];
    }
    return true;
}

/* The largest f, beside the size that it has for velocities of this size (Cauchy and Schwarz); *which: its constraint.
 */
static double residual(nh_start *c, const double *v, size_t *which)
{
    double worst = 0, speed = 0;
    for (size_t s = 0; s < c->m; s++) speed = hypot(speed, v[s] / c->scale[s]);
    for (size_t a = 0; a < c->k; a++) {
        double offset = c->out[a];
        for (size_t s = 0; s < c->m; s++) offset -= c->A[a + s * c->k] * v[s] / c->scale[s];
        double part = c->out[a] != 0 ? fabs(c->out[a]) / (fabs(offset) + speed) : 0;
        if (part > worst) worst = part, *which = a;
    }
    return worst;
}

/* Changes the velocities that are free (NULL: all) as little as possible so that the constraints hold, by Gauss-Newton;
 * returns the residual that is left, infinite where nothing is finite. */
static double satisfy(nh_start *c, double t, const double *q, const bool *is_free, double *v, size_t *which)
{
    enum { most_steps = 40 };
    size_t m = c->m, k = c->k;
    double last = INFINITY;
    for (int i = 0; i < most_steps; i++) {
        if (!evaluate(c, t, q, v)) return INFINITY;
        double now = residual(c, v, which);
        if (now == 0 || (i > 1 && !(now < last / 2))) return now;
        last = now;
        for (size_t a = 0; a < k; a++) c->step[a] = -c->out[a];
        for (size_t s = 0; s < m; s++)
            for (size_t a = 0; a < k && is_free && !is_free[s]; a++) c->A[a + s * k] = 0;
        if (nh_least_squares(k, m, c->A, 1, c->step, m + k, dependent_row) < 0) return INFINITY;
        for (size_t s = 0; s < m; s++)
            if (!is_free || is_free[s]) v[s] += c->step[s] * c->scale[s];
    }
    return evaluate(c, t, q, v) ? residual(c, v, which) : INFINITY;
}

/* The nearest given velocities to which the others can be chosen: what the constraints say about them alone, N f with N
 * F_others = 0, is made zero by the least change. */
static bool nearest_given(nh_start *c, double t, const double *q, const bool *given, double *v)
{
    size_t m = c->m, k = c->k, least = m < k ? m : k, alone = 0;
    if (!evaluate(c, t, q, v)) return false;
    double *others = nh_alloc_array(k * m + k * k + least + k * m + m + k + least * m + 1, sizeof *others);
    double *u = others + k * m, *sigma = u + k * k, *B = sigma + least, *right = B + k * m, *vt = right + m + k;
    for (size_t s = 0; s < m; s++)
        for (size_t a = 0; a < k; a++) others[a + s * k] = given && !given[s] ? c->A[a + s * k] : 0;
    bool good = nh_svd(k, m, others, sigma, u, vt);
    size_t rank = 0;
    while (good && rank < least && sigma[rank] > dependent_row) rank++;
    alone = least - rank;
    for (size_t i = 0; i < alone && good; i++) {
        const double *N = u + (rank + i) * k;
        for (size_t a = 0; a < k; a++) right[i] -= N[a] * c->out[a];
        for (size_t s = 0; s < m; s++)
            for (size_t a = 0; a < k && (!given || given[s]); a++) B[i + s * alone] += N[a] * c->A[a + s * k];
    }
    good = good && (!alone || nh_least_squares(alone, m, B, 1, right, m + k, dependent_row) >= 0);
    for (size_t s = 0; s < m && good && alone; s++) v[s] += right[s] * c->scale[s];
    nh_free(others);
    return good;
}

/* "x' = 1, y' = 0.5": those of the given velocities that change. */
static void say_nearest(const nh_start *c, const nh_state *state, const double *v, nh_text *out)
{
    enum { most = 6 };
    double speed = 0;
    size_t count = 0;
    for (size_t s = 0; s < c->m; s++) speed = hypot(speed, v[s] / c->scale[s]);
    for (size_t s = 0; s < c->m && count <= most; s++) {
        bool changes = fabs(v[s] - state->v[s]) > on_constraint * speed * c->scale[s];
        if ((state->given && !state->given[s]) || !changes) continue;
        if (count++ == most) nh_text_addf(out, ", ..");
        else nh_text_addf(out, "%s%s' = %.6g", count > 1 ? ", " : "", c->model->system->coordinate[s].name, v[s]);
    }
}

/* The constraint that is violated most at the given velocities, and the nearest ones that satisfy all. */
static bool refuse(nh_start *c, const nh_state *state, size_t which, const double *at, const double *nearest,
                   nh_error *error)
{
    const char *text = c->model->system->constraint[which].text;
    nh_text words;
    nh_text_init(&words);
    evaluate(c, state->t, state->q, at);
    double off = fabs(c->out[which]) * c->row[which];
    if (nearest) say_nearest(c, state, nearest, &words);
    nh_fail(error, NH_USAGE, "", "the initial velocities violate the constraints: the residual is %.3g%s%.160s%s", off,
            text ? " in `" : "", text ? text : "", text ? "`" : "");
    if (words.length)
        nh_error_hint(error,
                      "omit velocities that the constraints determine; or use --project, which takes the nearest "
                      "velocities that satisfy the constraints: %s",
                      nh_text_string(&words));
    else
        nh_error_hint(error, "omit the dependent velocities, which the constraints determine; or use --project, which "
                             "takes the nearest velocities that satisfy the constraints");
    nh_text_clear(&words);
    return false;
}

static bool not_finite(const nh_state *state, nh_error *error)
{
    nh_fail(error, NH_NUMERIC, "", "the constraints cannot be evaluated at the initial state (t = %.10g)", state->t);
    return nh_error_hint(error, "check the initial values, or use coordinates that are regular there");
}

/* Velocities that were not given are zero where the chart has them as independent ones; those of the dependent ones
 * follow.  Where the given ones do not allow that, all that were not given change, as little as possible. */
static bool velocities(nh_start *c, const nh_state *state, bool project, double *v, nh_error *error)
{
    enum { most_steps = 40 };
    static const double rounding = 1e-14;
    const nh_chart *chart = c->model->chart;
    size_t m = c->m, which = 0;
    double t = state->t, *nearest = nh_alloc_array(m + 1, sizeof *nearest), left = INFINITY;
    for (int attempt = 0; attempt < 2 && !(left <= rounding); attempt++) {
        for (size_t s = 0; s < m; s++) c->some[s] = attempt && state->given && !state->given[s];
        for (size_t a = 0; a < c->k && !attempt; a++)
            c->some[chart->dependent[a]] = state->given && !state->given[chart->dependent[a]];
        for (size_t s = 0; s < m; s++) v[s] = state->given && !state->given[s] ? 0 : state->v[s];
        left = satisfy(c, t, state->q, c->some, v, &which);
    }
    bool good = left <= on_constraint;
    if (good && left > rounding) satisfy(c, t, state->q, NULL, v, &which);
    if (!good && isfinite(left)) {
        size_t last = which;
        for (size_t s = 0; s < m; s++) nearest[s] = state->given && !state->given[s] ? 0 : state->v[s];
        bool found = false;
        for (size_t s = 0; s < m; s++) c->some[s] = state->given && !state->given[s];
        for (int i = 0; i < most_steps && !found; i++) /* one step where the constraints are linear */
            found = nearest_given(c, t, state->q, state->given, nearest) &&
                    satisfy(c, t, state->q, c->some, nearest, &last) <= on_constraint;
        good = project && found;
        if (good) memcpy(v, nearest, m * sizeof *v);
        else refuse(c, state, which, v, found ? nearest : NULL, error);
    } else if (!good) not_finite(state, error);
    nh_free(nearest);
    return good;
}

/* ---- a chart at a state ---- */

bool nh_dynamics_velocities(nh_dynamics *d, double t, const double *z, double *v)
{
    const nh_chart *chart = d->model->chart;
    size_t which;
    if (!nh_dynamics_watched(d->model)) {
        if (!nh_dynamics_point(d, t, z, d->point)) return false;
        nh_tape_eval(d->velocity, d->velocity_work, d->point, d->out);
        memcpy(v, d->out, d->m * sizeof *v);
        return nh_all_finite(d->m, v);
    }
    nh_start *c = start_of(d);
    memset(v, 0, d->m * sizeof *v);
    for (size_t i = 0; i < d->n; i++) v[chart->free[i]] = z[d->m + i];
    for (size_t s = 0; s < d->m; s++) c->some[s] = false;
    for (size_t a = 0; a < c->k; a++) c->some[chart->dependent[a]] = true;
    return satisfy(c, t, z, c->some, v, &which) <= on_constraint;
}

/* ---- the start in charts of other kinds ---- */

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

/* The least change of the chart's velocities that gives the known ones. */
static bool fit(nh_dynamics *d, const nh_state *state, bool project, double *z, nh_error *error)
{
    enum { most_steps = 50 };
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

/* Where hinges are at a right angle, pi/2 up to rounding, a velocity of 1 would need others of 1e16 and more. */
static bool follow(nh_start *c, const nh_state *state, const double *v, nh_error *error)
{
    double given = 0, largest = 0;
    size_t which = 0;
    if (!c->k || !evaluate(c, state->t, state->q, v)) return true;
    for (size_t s = 0; s < c->m; s++) {
        double size = fabs(v[s] / c->scale[s]);
        if (!state->given || state->given[s]) given = fmax(given, size);
        else if (size > largest) largest = size, which = s;
    }
    for (size_t a = 0; a < c->k; a++) { /* f = A v + offset */
        double offset = c->out[a];
        for (size_t s = 0; s < c->m; s++) offset -= c->A[a + s * c->k] * v[s] / c->scale[s];
        given = fmax(given, fabs(offset));
    }
    if (!(largest > follows_by_rounding * given) || given == 0) return true;
    const char *name = c->model->system->coordinate[which].name;
    nh_fail(error, NH_USAGE, "", "the initial velocities violate the constraints: by these %s' would be %.3g", name,
            v[which]);
    return nh_error_hint(error,
                         "here the given velocities follow from others by coefficients that are zero, up to rounding: "
                         "give %s' instead, or another position",
                         name);
}

bool nh_dynamics_start_all(nh_dynamics *d, const nh_state *state, bool project, double *z, double *v, nh_error *error)
{
    if (!nh_dynamics_watched(d->model)) {
        nh_state moved = {.t = state->t, .q = state->q, .v = v};
        bool first = project && !d->model->chart->quasi && d->model->k;
        return (!first || velocities(start_of(d), state, true, v, error)) &&
               fit(d, first ? &moved : state, project, z, error) &&
               (nh_dynamics_velocities(d, state->t, z, v) || not_finite(state, error)) &&
               follow(start_of(d), state, v, error);
    }
    bool good = velocities(start_of(d), state, project, v, error) && follow(start_of(d), state, v, error);
    memcpy(z, state->q, d->m * sizeof *z);
    for (size_t i = 0; i < d->n && good; i++) z[d->m + i] = v[d->model->chart->free[i]];
    return good;
}

bool nh_dynamics_start(nh_dynamics *d, const nh_state *state, bool project, double *z, nh_error *error)
{
    double *v = nh_alloc_array(d->m + 1, sizeof *v);
    bool good = nh_dynamics_start_all(d, state, project, z, v, error);
    nh_free(v);
    return good;
}

bool nh_dynamics_other_branch(const nh_model *model, const nh_state *state)
{
    const nh_chart *c = model->chart;
    double root;
    if (!c->branch || (state->given && !state->given[c->dependent[0]])) return false;
    nh_singular_start_values(model, state, 1, &c->root, &root);
    return root < 0;
}

/* Gaussian elimination with complete pivoting of F (k x m, by rows, whose length is 1) among the columns that are
 * allowed: which columns, and the smallest pivot. */
static double eliminate(size_t k, size_t m, const double *F, const bool *allowed, size_t *column)
{
    double *a = nh_alloc_array(k * m + 1, sizeof *a), last = 0;
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
        done[row] = used[at] = true;
        column[step] = at;
        for (size_t i = 0; i < k; i++) {
            double factor = done[i] ? 0 : a[i * m + at] / a[row * m + at];
            for (size_t j = 0; j < m && factor != 0; j++) a[i * m + j] -= factor * a[row * m + j];
        }
    }
    nh_free(used);
    nh_free(a);
    return last;
}

/* ---- another chart ---- */

/* Do the formulas of the chart hold at (t, q, v)?  Their velocities satisfy the constraints and are those of the state.
 */
static bool formulas_hold(nh_start *c, const nh_state *state, const double *v)
{
    const nh_model *model = c->model;
    size_t m = c->m, n = model->n;
    double *point = nh_alloc_array(model->width + m * (1 + n) + 1, sizeof *point), *rho = point + model->width,
           speed = 0;
    point[0] = state->t;
    memcpy(point + 1, state->q, m * sizeof *point);
    for (size_t i = 0; i < n; i++) point[1 + m + i] = v[model->chart->free[i]];
    nh_tape *tape = nh_dynamics_velocity_tape(model);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, point, rho);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    bool good = evaluate(c, state->t, state->q, v) && nh_all_finite(m * (1 + n), rho);
    for (size_t s = 0; s < m; s++) speed = hypot(speed, v[s] / c->scale[s]);
    for (size_t s = 0; s < m && good; s++) good = fabs(rho[s] - v[s]) <= NH_CHART_DIGITS * speed * c->scale[s];
    for (size_t s = 0; s < m && good; s++)
        for (size_t a = 0; a < c->k; a++) c->A[a + s * c->k] *= c->row[a] / c->scale[s];
    good = good && nh_dynamics_digits_lost(model, c->A, rho + m) < NH_CHART_DIGITS;
    nh_free(point);
    return good;
}

bool nh_dynamics_other_dependents(const nh_model *model, const nh_state *state, size_t *dependent, double *v)
{
    static const double singular = 1e-8;
    if (!nh_dynamics_watched(model)) return false;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_start *c = create(model);
    size_t k = c->k, m = c->m;
    double *F = nh_alloc_array(k * m + 1, sizeof *F);
    bool *own = nh_alloc_array(m + 1, sizeof *own), good = velocities(c, state, true, v, &ignored);
    for (size_t a = 0; a < k; a++) own[model->chart->dependent[a]] = true;
    for (size_t i = 0; i < k * m && good; i++) F[i] = c->A[i % m * k + i / m];
    bool determined = good && eliminate(k, m, F, own, dependent) > singular;
    bool other = good && !(determined && formulas_hold(c, state, v));
    if (other && !determined) other = eliminate(k, m, F, NULL, dependent) > singular;
    else memcpy(dependent, model->chart->dependent, k * sizeof *dependent);
    nh_free(own);
    nh_free(F);
    nh_dynamics_start_free(c);
    return other;
}

bool nh_dynamics_holds(nh_dynamics *d, double t, const double *z, const double *v)
{
    nh_state state = {.t = t, .q = (double *)z, .v = (double *)v};
    if (!nh_dynamics_watched(d->model)) return true;
    return formulas_hold(start_of(d), &state, v);
}
