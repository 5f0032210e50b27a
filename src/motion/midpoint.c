/* Implicit steps with a fixed length h (the rules: integrators.h). One step from z0 = (q0, w0) at t:
 *
 *      z0 ------------- zm ------------- z1           zm = (z0 + z1)/2 at t + h/2 is the unknown of Newton's iteration
 *      t              t + h/2           t + h         (energy-preserving: z1 is, with the mean gradient on the segment)
 *
 * Newton's matrix is exact for the first two rules; the energy-preserving rule uses that of the midpoint rule, from
 * which its own differs by terms of third order. An iteration ends at rounding, whose size in the unknowns is |A^-1|
 * |A| |x| times epsilon. `composed` makes five such steps of s h, s h, (1 - 4 s) h, s h, s h. */
#include "motion/integrators.h"
#include "motion/turns.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/dag.h"
#include "motion/stepping.h"
#include "graph/diff.h"

enum { most_iterations = 30, usual_iterations = 4, gauss_points = 5, most_substeps = 5 };
/* units of effort (base/effort.h) of a step, and per number of the state */
static const double step_units = 100, step_vectors = 10;
/* relative difference of the pair from the equations of motion that is rounding */
static const double same_equations = 1e-9;

/* Gauss-Legendre on [0, 1]. */
static const double gauss_at[gauss_points] = {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                              0.953089922969332};
static const double gauss_weight[gauss_points] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                                  0.23931433524968324, 0.11846344252809454};

typedef struct {
    nh_programs *programs;
    nh_midpoint_rule rule;
    size_t m, n, size;
    double t, h;
    double substep[most_substeps];
    size_t substeps, left; /* substeps of one step; steps left to the next output time */
    double step, *z0, *z1, *zm, *residual, *matrix, *start; /* start: p and R at the beginning of the step */
    double *large, *noise, *inverse; /* the largest |z_i| so far; effect of rounding on z_i; size x 2 size */
    const double *times;
    size_t count;
    long before; /* number of evaluations in earlier runs */
} midpoint_work;

/* The values of one of the model's programs at (t, z). */
static const double *evaluate(midpoint_work *k, nh_program which, double t, const double *z)
{
    return nh_programs_at(k->programs, which, t, z);
}

static midpoint_work *work_create(nh_programs *programs, nh_midpoint_rule rule)
{
    const nh_model *model = nh_programs_model(programs);
    midpoint_work *k = nh_alloc(sizeof *k);
    *k = (midpoint_work){.programs = programs,
                         .rule = rule,
                         .m = model->m,
                         .n = model->n,
                         .size = model->m + model->n,
                         .before = nh_programs_evaluations(programs)};
    size_t size = k->size;
    k->z0 = nh_alloc_array(6 * size + 2 * size * size, sizeof *k->z0);
    k->z1 = k->z0 + size;
    k->zm = k->z1 + size;
    k->residual = k->zm + size;
    k->matrix = k->residual + 2 * size;
    k->start = nh_alloc_array(model->m + model->m * model->n + model->n * model->n + 1, sizeof *k->start);
    k->large = nh_alloc_array(2 * size + 2 * size * size, sizeof *k->large);
    k->noise = k->large + size;
    k->inverse = k->noise + size;
    return k;
}

static void work_free(midpoint_work *k)
{
    nh_free(k->z0);
    nh_free(k->start);
    nh_free(k->large);
    nh_free(k);
}

/* ---- Newton's method ---- */

/* Rounding of the equations A x = b moves x by epsilon |A^-1| |A| |x|, in units that the states' own units cancel from
 * (Skeel 1979). A state that is zero but for this has no digits to be found. */
static void measure_noise(midpoint_work *k, size_t n, const double *matrix, const double *x, double *noise)
{
    double *copy = k->inverse + n * n;
    memcpy(copy, matrix, n * n * sizeof *copy);
    for (size_t i = 0; i < n * n; i++) k->inverse[i] = i % (n + 1) == 0;
    memset(noise, 0, n * sizeof *noise);
    if (!nh_solve(n, copy, n, k->inverse, NULL)) return;
    for (size_t j = 0; j < n; j++) {
        double row = 0;
        for (size_t l = 0; l < n; l++) row += fabs(matrix[j + l * n] * x[l]);
        for (size_t i = 0; i < n; i++) noise[i] += fabs(k->inverse[i + j * n]) * row;
    }
}

/* x -= matrix^-1 residual for the last n states, the `iteration`th time.  Returns the largest change relative to the
 * size that the state has had so far, or infinity; where that is slow to end, relative to rounding. */
static double newton_step(midpoint_work *k, size_t n, int iteration, double *matrix, double *residual, double *x)
{
    double worst = 0, *large = k->large + k->size - n, *noise = k->noise + k->size - n;
    if (iteration == 0) memset(noise, 0, n * sizeof *noise);
    if (iteration >= usual_iterations) measure_noise(k, n, matrix, x, noise);
    if (!nh_solve(n, matrix, 1, residual, NULL)) return INFINITY;
    for (size_t i = 0; i < n; i++) {
        x[i] -= residual[i];
        if (!isfinite(x[i])) return INFINITY;
        double size = fmax(fmax(large[i], fabs(x[i])), noise[i]);
        /* size 0: the relative change is infinite */
        if (residual[i] != 0) worst = fmax(worst, fabs(residual[i]) / size);
    }
    return isfinite(worst) ? worst : 1;
}

/* Called after a step that led to k->z0. */
static void follow(midpoint_work *k)
{
    for (size_t i = 0; i < k->size; i++) k->large[i] = fmax(k->large[i], fabs(k->z0[i]));
}

/* Is the change at rounding, or small and no longer falling? */
static bool converged(double change, double last)
{
    return change < 2 * DBL_EPSILON || (change < 1e-12 && change > last / 2);
}

/* ---- the rules ---- */

/* F(zm) = 2 (zm - z0) - h f(tm, zm) = 0, dF/dzm = 2 - h df/dz. */
static bool solve_midpoint(midpoint_work *k)
{
    size_t size = k->size;
    double last = INFINITY;
    for (int i = 0; i < most_iterations; i++) {
        const double *f = evaluate(k, NH_PROGRAM_FLOW, k->t + k->h / 2, k->zm);
        for (size_t j = 0; j < size; j++) {
            k->residual[j] = 2 * (k->zm[j] - k->z0[j]) - k->h * f[j];
            for (size_t r = 0; r < size; r++)
                k->matrix[r + j * size] = (r == j ? 2 : 0) - k->h * f[size + r + j * size];
        }
        double change = newton_step(k, size, i, k->matrix, k->residual, k->zm);
        if (converged(change, last)) {
            for (size_t j = 0; j < size; j++) k->z1[j] = 2 * k->zm[j] - k->z0[j];
            return true;
        }
        if (!isfinite(change)) return false;
        last = change;
    }
    return false;
}

/* w1 from the second half of the discrete principle: Newton with M = R^T dp/dw. */
static bool discrete_velocity(midpoint_work *k, const double *impulse)
{
    size_t m = k->m, n = k->n;
    double last = INFINITY;
    memcpy(k->z1 + m, k->zm + m, n * sizeof *k->z1);
    for (int i = 0; i < most_iterations; i++) {
        const double *e = evaluate(k, NH_PROGRAM_MOMENTUM, k->t + k->h, k->z1), *p = e + m, *R = e + 3 * m,
                     *d = R + m * n;
        for (size_t a = 0; a < n; a++) {
            k->residual[a] = 0;
            for (size_t s = 0; s < m; s++) k->residual[a] += R[s * n + a] * (p[s] - impulse[s]);
            for (size_t b = 0; b < n; b++) {
                double sum = 0;
                for (size_t s = 0; s < m; s++) sum += R[s * n + a] * d[m + s + (m + b) * 3 * m];
                k->matrix[a + b * n] = sum;
            }
        }
        double change = newton_step(k, n, i, k->matrix, k->residual, k->z1 + m);
        if (converged(change, last)) return true;
        if (!isfinite(change)) return false;
        last = change;
    }
    return false;
}

/* 2 (qm - q0) = h rho,  R0^T (p0 + h/2 c - p) = 0, and its derivatives, from the momentum program's values e at zm. */
static void principle(midpoint_work *k, const double *e)
{
    size_t m = k->m, n = k->n, size = k->size;
    const double *p = e + m, *c = e + 2 * m, *d = e + 3 * m + m * n, *p0 = k->start, *R0 = p0 + m;
    for (size_t s = 0; s < m; s++) k->residual[s] = 2 * (k->zm[s] - k->z0[s]) - k->h * e[s];
    for (size_t a = 0; a < n; a++) {
        k->residual[m + a] = 0;
        for (size_t s = 0; s < m; s++) k->residual[m + a] += R0[s * n + a] * (p0[s] + k->h / 2 * c[s] - p[s]);
    }
    for (size_t j = 0; j < size; j++) {
        const double *column = d + j * 3 * m;
        for (size_t s = 0; s < m; s++) k->matrix[s + j * size] = (s == j ? 2 : 0) - k->h * column[s];
        for (size_t a = 0; a < n; a++) {
            double sum = 0;
            for (size_t s = 0; s < m; s++) sum += R0[s * n + a] * (k->h / 2 * column[2 * m + s] - column[m + s]);
            k->matrix[m + a + j * size] = sum;
        }
    }
}

/* zm = (qm, wm) by `principle`, then w1 by `discrete_velocity`. */
static bool solve_lagrange_dalembert(midpoint_work *k)
{
    size_t m = k->m, n = k->n;
    double last = INFINITY;
    const double *e = evaluate(k, NH_PROGRAM_MOMENTUM, k->t, k->z0);
    memcpy(k->start, e + m, m * sizeof *e);
    memcpy(k->start + m, e + 3 * m, m * n * sizeof *e);
    for (int i = 0; i < most_iterations; i++) {
        principle(k, evaluate(k, NH_PROGRAM_MOMENTUM, k->t + k->h / 2, k->zm));
        double change = newton_step(k, k->size, i, k->matrix, k->residual, k->zm);
        if (converged(change, last)) break;
        if (!isfinite(change) || i + 1 == most_iterations) return false;
        last = change;
    }
    e = evaluate(k, NH_PROGRAM_MOMENTUM, k->t + k->h / 2, k->zm);
    for (size_t s = 0; s < m; s++) {
        k->z1[s] = 2 * k->zm[s] - k->z0[s];
        k->start[s] = e[m + s] + k->h / 2 * e[2 * m + s];
    }
    return discrete_velocity(k, k->start);
}

/* rate = (R u, M^-1 (G u - R^T g_q)), u = M^-1 g_w, for a gradient g. */
static bool pair_rate(midpoint_work *k, const double *pair, const double *g, double *rate)
{
    size_t m = k->m, n = k->n;
    const double *R = pair, *M = R + m * n, *G = M + n * n;
    double *matrix = k->start + m + m * n, *u = rate + m, *right = k->residual + k->size;
    for (size_t i = 0; i < n * n; i++) matrix[i] = M[i]; /* symmetric */
    memcpy(u, g + m, n * sizeof *u);
    if (!nh_solve(n, matrix, 1, u, NULL)) return false;
    for (size_t s = 0; s < m; s++) {
        rate[s] = 0;
        for (size_t i = 0; i < n; i++) rate[s] += R[s * n + i] * u[i];
    }
    for (size_t i = 0; i < n; i++) {
        right[i] = 0;
        for (size_t j = 0; j < n; j++) right[i] += G[i * n + j] * u[j];
        for (size_t s = 0; s < m; s++) right[i] -= R[s * n + i] * g[s];
    }
    for (size_t i = 0; i < n * n; i++) matrix[i] = M[i];
    memcpy(u, right, n * sizeof *u);
    return nh_solve(n, matrix, 1, u, NULL);
}

/* The mean of grad E over the segment from z0 to z1 into `mean`. */
static void mean_gradient(midpoint_work *k, double *z, double *mean)
{
    size_t size = k->size;
    memset(mean, 0, size * sizeof *mean);
    for (int q = 0; q < gauss_points; q++) {
        for (size_t j = 0; j < size; j++) z[j] = k->z0[j] + gauss_at[q] * (k->z1[j] - k->z0[j]);
        const double *g = evaluate(k, NH_PROGRAM_GRADIENT, k->t + k->h / 2, z);
        for (size_t j = 0; j < size; j++) mean[j] += gauss_weight[q] * g[j];
    }
}

/* Newton's iteration with the matrix of the midpoint rule, from which this one differs by terms of order h^3. */
static bool solve_energy(midpoint_work *k)
{
    size_t size = k->size;
    double last = INFINITY, *rate = k->matrix + size * size, *mean = k->zm;
    if (!solve_midpoint(k)) return false;
    for (int i = 0; i < 3 * most_iterations; i++) {
        double *middle = k->residual; /* not set yet */
        for (size_t j = 0; j < size; j++) middle[j] = (k->z0[j] + k->z1[j]) / 2;
        const double *f = evaluate(k, NH_PROGRAM_FLOW, k->t + k->h / 2, middle);
        for (size_t j = 0; j < size; j++)
            for (size_t r = 0; r < size; r++) k->matrix[r + j * size] = (r == j) - k->h / 2 * f[size + r + j * size];
        const double *pair = evaluate(k, NH_PROGRAM_PAIR, k->t + k->h / 2, middle);
        mean_gradient(k, k->residual, mean);
        if (!pair_rate(k, pair, mean, rate)) return false;
        for (size_t j = 0; j < size; j++) k->residual[j] = k->z1[j] - k->z0[j] - k->h * rate[j];
        double change = newton_step(k, size, i, k->matrix, k->residual, k->z1);
        if (converged(change, last)) return true;
        if (!isfinite(change)) return false;
        last = change;
    }
    return false;
}

/* ---- which rule is valid ---- */

/* The sizes of the terms in the rates of the pair: |R| |u| and |M^-1| (|G| |u| + |R^T| |g_q|), u = M^-1 g_w. */
static bool pair_terms(const midpoint_work *k, const double *pair, const double *g, double *terms)
{
    size_t m = k->m, n = k->n;
    const double *R = pair, *M = R + m * n, *G = M + n * n;
    double *matrix = nh_alloc_array(2 * n * n + 2 * n + 1, sizeof *matrix), *inverse = matrix + n * n,
           *u = inverse + n * n, *sum = u + n;
    for (size_t i = 0; i < n * n; i++) {
        matrix[i] = M[i];
        inverse[i] = i % (n + 1) == 0;
    }
    bool good = nh_solve(n, matrix, n, inverse, NULL);
    for (size_t i = 0; i < n && good; i++) {
        u[i] = 0;
        for (size_t j = 0; j < n; j++) u[i] += inverse[i + j * n] * g[m + j];
    }
    for (size_t s = 0; s < m && good; s++) {
        terms[s] = 0;
        for (size_t i = 0; i < n; i++) terms[s] += fabs(R[s * n + i] * u[i]);
    }
    for (size_t i = 0; i < n && good; i++) {
        sum[i] = 0;
        for (size_t j = 0; j < n; j++) sum[i] += fabs(G[i * n + j] * u[j]);
        for (size_t s = 0; s < m; s++) sum[i] += fabs(R[s * n + i] * g[s]);
    }
    for (size_t i = 0; i < n && good; i++) {
        terms[m + i] = 0;
        for (size_t j = 0; j < n; j++) terms[m + i] += fabs(inverse[i + j * n]) * sum[j];
    }
    nh_free(matrix);
    return good;
}

/* Compares rates relative to their terms: |f_j| and |df_j/dz_i z_i|, and the terms of the pair, which can cancel where
 * f_j is zero identically. */
static bool pair_is_the_motion(nh_programs *programs)
{
    const nh_model *model = nh_programs_model(programs);
    midpoint_work *k = work_create(programs, NH_ENERGY);
    double *rate = k->matrix + k->size * k->size, *made_of = nh_alloc_array(k->size + 1, sizeof *made_of);
    size_t size = k->size;
    bool same = model->chart->probes > 0;
    for (size_t p = 0; p < model->chart->probes && same; p++) {
        const double *z = model->chart->probe + p * model->chart->width;
        const double *f = evaluate(k, NH_PROGRAM_FLOW, z[0], z + 1), *g = evaluate(k, NH_PROGRAM_GRADIENT, z[0], z + 1);
        const double *pair = evaluate(k, NH_PROGRAM_PAIR, z[0], z + 1);
        same = pair_rate(k, pair, g, rate) && pair_terms(k, pair, g, made_of);
        for (size_t j = 0; j < size && same; j++) {
            double terms = fabs(f[j]) + made_of[j];
            for (size_t i = 0; i < size; i++) terms += fabs(f[size + j + i * size] * z[1 + i]);
            same = fabs(rate[j] - f[j]) <= same_equations * terms;
        }
    }
    nh_free(made_of);
    work_free(k);
    return same && nh_is_zero(model->dag, nh_diff(model->dag, model->E, model->system->t));
}

/* What the pair does not describe, in words: forces, time, and the part of the velocities beside R w. */
static const char *why_another_motion(const nh_model *model)
{
    bool time = false, nonlinear = false, affine = false;
    nh_ex *zero = nh_alloc_array(model->n + 1, sizeof *zero);
    for (size_t i = 0; i < model->n; i++) zero[i] = nh_int(model->dag, 0);
    for (size_t s = 0; s < model->m; s++) {
        time |= nh_depends(model->dag, model->rho[s], model->system->t);
        affine |= !nh_is_zero(model->dag, nh_substitute(model->dag, model->rho[s], model->n, model->chart->w, zero));
        for (size_t i = 0; i < model->n * model->n; i++)
            nonlinear |= nh_depends(model->dag, model->R[s * model->n + i / model->n], model->chart->w[i % model->n]);
    }
    nh_free(zero);
    if (model->system->has_forces)
        return "it would converge to a different motion: it has no terms for forces without a potential";
    if (time) return "it would converge to a different motion: the constraints depend on time";
    if (nonlinear) return "it would converge to a different motion: the constraints are not linear in the velocities";
    if (affine) return "it would converge to a different motion: the constraints are affine";
    return nh_depends(model->dag, model->E, model->system->t)
               ? "it would converge to a different motion: time occurs in the energy"
               : "it would converge to a different motion: its equations differ "
                 "from those of the system at random points";
}

const char *nh_midpoint_refused(nh_programs *programs, nh_midpoint_rule rule)
{
    if (nh_programs_model(programs)->chart->implicit)
        return "the constraints are solved by Newton's method inside the equations of motion";
    return rule == NH_ENERGY && !pair_is_the_motion(programs) ? why_another_motion(nh_programs_model(programs)) : NULL;
}

/* ---- the motion ---- */

/* One step of length h by the rule; the state of k moves on. */
static bool step_once(midpoint_work *k, double h)
{
    k->h = h;
    memcpy(k->zm, k->z0, k->size * sizeof *k->zm);
    if (k->rule == NH_LAGRANGE_DALEMBERT) return solve_lagrange_dalembert(k);
    return k->rule == NH_ENERGY ? solve_energy(k) : solve_midpoint(k);
}

static nh_step midpoint_advance(double *time, nh_motion *motion, void *context)
{
    midpoint_work *k = context;
    nh_turns_renew(nh_programs_model(k->programs)->system, k->z0, NULL);
    double target = k->times[motion->count];
    if (!k->left) k->left = (size_t)fmax(1, ceil(fabs(target - *time) / k->step * (1 - 1e-12)));
    double h = (target - *time) / (double)k->left;
    for (size_t i = 0; i < k->substeps; i++) {
        if (!step_once(k, k->substep[i] * h)) {
            nh_motion_note(motion, "Newton's method does not converge near t = %.10g; use a smaller step", k->t);
            return NH_STEP_FAILED;
        }
        k->t += k->substep[i] * h;
        memcpy(k->z0, k->z1, k->size * sizeof *k->z0);
        follow(k);
    }
    k->left--;
    *time = k->t = k->left ? *time + h : target;
    motion->evaluations = nh_programs_evaluations(k->programs) - k->before;
    return *time == k->times[k->count - 1] ? NH_STEP_LAST : NH_STEP_ON;
}

static bool midpoint_state(double time, double *state, void *context)
{
    midpoint_work *k = context;
    (void)time;
    memcpy(state, k->z0, k->size * sizeof *state);
    return true;
}

static void midpoint_stuck(nh_motion *motion, void *context)
{
    (void)context;
    nh_motion_note(motion, "the step is too small for double precision near t = %.10g", motion->end_time);
}

nh_motion *nh_midpoint(nh_programs *programs, nh_midpoint_rule rule, bool composed, const double *initial, size_t count,
                       const double *times, const nh_flow_options *given, nh_error *error)
{
    size_t size = nh_programs_model(programs)->m + nh_programs_model(programs)->n;
    nh_flow_options own = *given, *options = &own;
    own.rtol = 1; /* the method ignores it */
    const char *refused = nh_midpoint_refused(programs, rule);
    if (refused) return nh_fail(error, NH_NUMERIC, "", "this method cannot be used here: %s", refused), NULL;
    nh_motion *motion = nh_motion_start(size, size, initial, count, times, options, error);
    if (!motion || motion->complete) return motion;
    midpoint_work *k = work_create(programs, rule);
    double s = 1 / (4 - cbrt(4));
    const double suzuki[most_substeps] = {s, s, 1 - 4 * s, s, s};
    k->substeps = composed ? most_substeps : 1;
    for (size_t i = 0; i < k->substeps; i++) k->substep[i] = composed ? suzuki[i] : 1;
    k->times = times;
    k->count = count;
    k->t = times[0];
    k->step = options->step > 0 ? options->step : fabs(times[count - 1] - times[0]) / 100;
    memcpy(k->z0, initial, size * sizeof *initial);
    follow(k);
    nh_stepper stepper = {.context = k,
                          .advance = midpoint_advance,
                          .state = midpoint_state,
                          .stuck = midpoint_stuck,
                          .step_effort = (double)k->substeps * (step_units + step_vectors * (double)size),
                          .rate = nh_programs_rate,
                          .rate_context = programs};
    nh_motion_run(motion, count, times, options, &stepper);
    work_free(k);
    return motion;
}
