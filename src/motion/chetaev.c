/* chetaev: see chetaev.h.
 *
 *     r_1 = q' - v,      r_2 = K v' + h + F^T mu,      r_3 = F v' + g          unknowns y = (q, v, mu)
 *
 * Newton's matrix dr/dy + c dr/dy' of the backward differences y' = c y + ... is
 *
 *           q              v                mu
 *     [    c I            -I                0    ]
 *     [  dr_2/dq     c K + dr_2/dv         F^T   ]
 *     [  dr_3/dq     c F + dr_3/dv          0    ]
 *
 * where K, F and F^T are exact and the derivatives of r_2, r_3 at constant v', mu are differences: they only speed up
 * the iteration, its limit does not depend on them.  v' and mu are functions of (q,v) as long as the matrix [K F^T; F
 * 0] is regular, so the index is 1 whether K is regular or not.  Of index 2, r_3 = f, the third row of the matrix is
 * (df/dq, F, 0). */
#include "motion/chetaev.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "base/saddle.h"
#include "motion/sundials.h"
#include "motion/stepping.h"

/* The multipliers take part in the error test, or they would be wrong between the steps wherever (q,v) allows long ones
 * (by 10 % at rtol 1e-9 in a test); but they follow the accelerations, which are one order less exact than (q,v), so
 * their tolerance is wider.  What Newton's iteration leaves behind enters v' and mu divided by the step: at IDA's share
 * of 0.33 that noise, not the motion, ruled the steps.  The sleigh to T = 10, rtol 1e-10 and 1e-14, errors of phi and
 * mu:
 *     mu not tested, 0.33     1.3 ms, 7e-10, 1e-7       4.5 ms, 1e-12, 5e-11
 *     width 1, 0.33           3.3 ms, 5e-10, 2e-9      13 ms, 4e-14, 9e-13     (40 ms at 1e-12)
 *     width 10, 0.003         1.4 ms, 2e-9, 2e-8        5.1 ms, 3e-13, 7e-12 */
static const double multiplier_width = 10;
static const double iteration_share = 0.003;
/* Of index 2 the multipliers are left out of the error test, and Newton's iteration needs no digits of theirs: their
 * noise is the iteration's divided by the step. */
static const double multiplier_width_2 = 1e10;

typedef struct {
    const nh_chetaev_problem *problem;
    size_t m, k;
    double *K, *h, *F, *g, *f; /* the terms at the last point asked for; K owns the memory of all five */
    double *base, *shifted;    /* (r_2, r_3), m + k each */
    double *point;             /* (q, v), 2m */
    double *scale;             /* 2m + k */
    /* 2m + k: by which the equations are multiplied, so that numbers without units are eliminated: a pivot is the
       largest of them */
    double *row;
    double *saddle;
    nh_sundials sundials;
    void *ida;
    N_Vector state, rate, differential;
    SUNMatrix matrix;
    SUNLinearSolver solver;
    double stop, rtol;
    long evaluations, jacobians;
    bool failed; /* the terms could not be computed in the last steps; at which time and step */
    double failed_at;
    long step, failed_step;
} ida_work;

static size_t terms_size(size_t m, size_t k) { return m * m + m + k * m + 2 * k; }

static bool terms_at(ida_work *work, double t, const double *q, const double *v)
{
    work->evaluations++;
    if (work->problem->terms(t, q, v, work->K, work->h, work->F, work->g, work->f, work->problem->context) &&
        nh_all_finite(terms_size(work->m, work->k), work->K))
        return true;
    work->failed = true;
    work->failed_at = t;
    work->failed_step = work->step;
    return false;
}

/* (r_2, r_3) from the terms; `a` stands for v'.  Of index 2: r_3 = f. */
static void balance(const ida_work *work, const double *a, const double *mu, double *out)
{
    size_t m = work->m, k = work->k;
    memcpy(out, work->h, m * sizeof *out);
    memcpy(out + m, work->problem->holds ? work->f : work->g, k * sizeof *out);
    for (size_t j = 0; j < m; j++) {
        for (size_t i = 0; i < m; i++) out[i] += work->K[i + j * m] * a[j];
        for (size_t c = 0; c < k; c++) {
            out[j] += work->F[c + j * k] * mu[c];
            if (!work->problem->holds) out[m + c] += work->F[c + j * k] * a[j];
        }
    }
}

/* ---- the start: [K F^T; F 0] (v', mu) = -(h, g) ---- */

static bool solve_bordered(const ida_work *work, double *a, double *mu, double *rcond)
{
    return nh_saddle_solve(work->m, work->k, work->K, work->F, work->h, work->g, a, mu, rcond, work->saddle) &&
           *rcond > DBL_EPSILON;
}

/* The nearest power of two, by which nothing is rounded; 1 where it is none. */
static double power_of_two(double x) { return x > 0 && isfinite(x) ? exp2(round(log2(x))) : 1; }

/* What size a multiplier has: the power |h_j| s_j of the forces that it balances is that of mu_a F_aj s_j, with s_j the
 * size of v_j; so nothing depends on units.  Without forces: of those that change the momenta within the whole time. */
static void scale_multipliers(ida_work *work, const double *a, double time)
{
    size_t m = work->m, k = work->k;
    const double *size = work->scale + m;
    double force = 0, momentum = 0;
    for (size_t j = 0; j < m; j++) {
        force = fmax(force, fabs(work->h[j]) * size[j]);
        for (size_t i = 0; i < m; i++) {
            force = fmax(force, fabs(work->K[i + j * m] * a[j]) * size[i]);
            momentum = fmax(momentum, fabs(work->K[i + j * m]) * size[j] * size[i]);
        }
    }
    double power = force > 0 ? force : momentum / time;
    for (size_t j = 0; j < m; j++)
        work->row[j] = power_of_two(1 / size[j]), work->row[m + j] = power_of_two(size[j] / power);
    for (size_t c = 0; c < k; c++) {
        double direction = 0;
        for (size_t j = 0; j < m; j++) direction = fmax(direction, fabs(work->F[c + j * k]) * size[j]);
        work->scale[2 * m + c] = power > 0 && direction > 0 && isfinite(power / direction) ? power / direction : 1;
        work->row[2 * m + c] = power_of_two((work->problem->holds ? 1 : momentum / power) / direction);
    }
}

/* The whole initial state: q, v given, v' and mu computed. */
static bool make_consistent(ida_work *work, double t, const double *initial, double *state, double *rate,
                            nh_error *error)
{
    size_t m = work->m;
    double rcond = 0;
    if (!terms_at(work, t, initial, initial + m)) {
        nh_fail(error, NH_NUMERIC, "", "the equations of motion cannot be evaluated at the initial state (t = %.10g)",
                t);
        return nh_error_hint(error, "check the initial values, or use coordinates that are regular there");
    }
    memcpy(state, initial, 2 * m * sizeof *state);
    memcpy(rate, initial + m, m * sizeof *rate);
    if (!solve_bordered(work, rate + m, state + 2 * m, &rcond)) {
        nh_fail(error, NH_NUMERIC, "",
                "the accelerations and multipliers are not determined at the initial state: the mass matrix "
                "bordered by the constraints has the reciprocal condition number %.2g",
                rcond);
        return nh_error_hint(
            error, "check for dependent constraints, and for coordinates without inertia that no constraint fixes");
    }
    scale_multipliers(work, rate + m, fabs(work->stop - t));
    return true;
}

/* ---- IDA's callbacks ---- */

static int call_residual(sunrealtype t, N_Vector state, N_Vector rate, N_Vector residual, void *user)
{
    ida_work *work = user;
    const double *y = NV_DATA_S(state), *dy = NV_DATA_S(rate);
    double *r = NV_DATA_S(residual);
    size_t m = work->m;
    if (!terms_at(work, t, y, y + m)) return 1; /* "recoverable": IDA tries a smaller step */
    for (size_t i = 0; i < m; i++) r[i] = dy[i] - y[m + i];
    balance(work, dy + m, y + 2 * m, r + m);
    for (size_t i = 0; i < 2 * m + work->k; i++) r[i] *= work->row[i];
    return 0;
}

/* The blocks that are known exactly; column-major, n = 2m + k. */
static void exact_blocks(const ida_work *work, double c, double *matrix)
{
    size_t m = work->m, k = work->k, n = 2 * m + k;
    memset(matrix, 0, n * n * sizeof *matrix);
    for (size_t j = 0; j < m; j++) {
        matrix[j + j * n] = c;
        matrix[j + (m + j) * n] = -1;
        for (size_t i = 0; i < m; i++) matrix[m + i + (m + j) * n] = c * work->K[i + j * m];
        for (size_t a = 0; a < k; a++) {
            if (!work->problem->holds) matrix[2 * m + a + (m + j) * n] = c * work->F[a + j * k];
            matrix[m + j + (2 * m + a) * n] = work->F[a + j * k];
        }
    }
}

/* Move coordinate or velocity j and evaluate, to the other side where the first leaves the domain; the shift, or 0. */
static double shift(ida_work *work, double t, const double *y, size_t j)
{
    double size = sqrt(DBL_EPSILON) * fmax(fabs(y[j]), work->scale[j]);
    memcpy(work->point, y, 2 * work->m * sizeof *y);
    for (int side = 1; side >= -1; side -= 2) {
        volatile double moved = y[j] + side * size; /* volatile: the shift must be the one that is stored */
        work->point[j] = moved;
        if (terms_at(work, t, work->point, work->point + work->m)) return moved - y[j];
    }
    return 0;
}

static int call_jacobian(sunrealtype t, sunrealtype c, N_Vector state, N_Vector rate, N_Vector residual,
                         SUNMatrix matrix, void *user, N_Vector work1, N_Vector work2, N_Vector work3)
{
    (void)residual, (void)work1, (void)work2, (void)work3;
    ida_work *work = user;
    const double *y = NV_DATA_S(state), *a = NV_DATA_S(rate) + work->m;
    size_t m = work->m, n = 2 * m + work->k;
    if (!terms_at(work, t, y, y + m)) return 1;
    exact_blocks(work, c, SM_DATA_D(matrix));
    balance(work, a, y + 2 * m, work->base);
    for (size_t j = 0; j < 2 * m; j++) {
        double moved = shift(work, t, y, j), *column = SM_DATA_D(matrix) + j * n + m;
        if (moved == 0) return 1;
        balance(work, a, y + 2 * m, work->shifted);
        for (size_t i = 0; i < n - m; i++) column[i] += (work->shifted[i] - work->base[i]) / moved;
    }
    for (size_t i = 0; i < n * n; i++) SM_DATA_D(matrix)[i] *= work->row[i % n];
    work->jacobians++;
    return 0;
}

static int call_weights(N_Vector state, N_Vector weight, void *user)
{
    const ida_work *work = user;
    size_t m = work->m, n = 2 * m + work->k;
    const double *y = NV_DATA_S(state);
    double width = work->problem->holds ? multiplier_width_2 : multiplier_width;
    for (size_t i = 0; i < n; i++)
        NV_DATA_S(weight)[i] = 1 / ((i < 2 * m ? 1 : width) * work->rtol * (fabs(y[i]) + work->scale[i]));
    return 0;
}

/* ---- one motion ---- */

/* At the last state that was reached. */
static double bordered_rcond(ida_work *work, double t)
{
    double *y = NV_DATA_S(work->state), *a = NV_DATA_S(work->rate) + work->m, rcond = 0;
    if (terms_at(work, t, y, y + work->m)) solve_bordered(work, a, y + 2 * work->m, &rcond);
    return rcond;
}

static void explain(int flag, ida_work *work, nh_motion *motion)
{
    double t = motion->end_time;
    if (work->failed && flag != IDA_TOO_MUCH_ACC)
        nh_motion_note(motion,
                       "the equations of motion cannot be evaluated near t = %.10g: the motion leaves their domain or "
                       "meets a singularity there; use other coordinates or stop earlier",
                       work->failed_at);
    else if (flag == IDA_TOO_MUCH_ACC)
        nh_motion_note(motion, "double precision cannot reach the tolerance %g near t = %.10g; use a larger tolerance",
                       work->rtol, t);
    else if (flag == IDA_ERR_FAIL || flag == IDA_CONV_FAIL || flag == IDA_LSETUP_FAIL || flag == IDA_LSOLVE_FAIL)
        nh_motion_note(
            motion,
            "no step near t = %.10g reaches the tolerance %g; the mass matrix bordered by the constraints has the "
            "reciprocal condition number %.2g there: if it is small, constraints become dependent, else the "
            "solution is singular",
            t, work->rtol, bordered_rcond(work, t));
    else nh_motion_note(motion, "the integrator stopped near t = %.10g: %s", t, work->sundials.message);
}

static nh_step ida_advance(double *time, nh_motion *motion, void *context)
{
    ida_work *work = context;
    work->step = motion->steps;
    if (work->step > work->failed_step + NH_STUCK_AFTER) /* so many good steps since: no longer of interest */
        work->failed = false;
    int flag = IDASolve(work->ida, work->stop, time, work->state, work->rate, IDA_ONE_STEP);
    motion->evaluations = work->evaluations;
    motion->jacobians = work->jacobians;
    if (flag >= 0) return flag == IDA_TSTOP_RETURN ? NH_STEP_LAST : NH_STEP_ON;
    explain(flag, work, motion);
    return NH_STEP_FAILED;
}

static bool ida_state(double time, double *state, void *context)
{
    ida_work *work = context;
    if (IDAGetDky(work->ida, time, 0, work->state) != IDA_SUCCESS) return false;
    memcpy(state, NV_DATA_S(work->state), (2 * work->m + work->k) * sizeof *state);
    return true;
}

static void ida_stuck(nh_motion *motion, void *context) { explain(IDA_ERR_FAIL, context, motion); }

static bool create_objects(ida_work *work)
{
    sunindextype size = (sunindextype)(2 * work->m + work->k);
    if (!nh_sundials_open(&work->sundials)) return false;
    work->state = N_VNew_Serial(size, work->sundials.context);
    work->rate = N_VNew_Serial(size, work->sundials.context);
    work->differential = N_VNew_Serial(size, work->sundials.context);
    work->matrix = SUNDenseMatrix(size, size, work->sundials.context);
    if (!work->state || !work->rate || !work->differential || !work->matrix) return false;
    N_VConst(0, work->rate);
    work->solver = SUNLinSol_Dense(work->state, work->matrix, work->sundials.context);
    work->ida = IDACreate(work->sundials.context);
    return work->solver && work->ida;
}

static void create_arrays(ida_work *work, const double *scale)
{
    size_t m = work->m, k = work->k;
    work->K = nh_alloc_array(terms_size(m, k), sizeof(double));
    work->h = work->K + m * m;
    work->F = work->h + m;
    work->g = work->F + k * m;
    work->f = work->g + k;
    work->base = nh_alloc_array(m + k, sizeof(double));
    work->shifted = nh_alloc_array(m + k, sizeof(double));
    work->point = nh_alloc_array(2 * m, sizeof(double));
    work->scale = nh_alloc_array(2 * (2 * m + k), sizeof(double));
    work->row = work->scale + 2 * m + k;
    work->saddle = nh_alloc_array(nh_saddle_work(m, k), sizeof(double));
    for (size_t i = 0; i < 2 * m; i++) work->scale[i] = scale ? scale[i] : 1.0;
}

static bool leave_multipliers_out(ida_work *work)
{
    for (size_t i = 0; i < 2 * work->m + work->k; i++) NV_DATA_S(work->differential)[i] = i < 2 * work->m;
    return IDASetId(work->ida, work->differential) == IDA_SUCCESS && IDASetSuppressAlg(work->ida, 1) == IDA_SUCCESS;
}

static bool set_up(ida_work *work, double start)
{
    return nh_sundials_listen(IDA, work->ida, &work->sundials) &&
           IDAInit(work->ida, call_residual, start, work->state, work->rate) == IDA_SUCCESS &&
           IDASetUserData(work->ida, work) == IDA_SUCCESS && IDAWFtolerances(work->ida, call_weights) == IDA_SUCCESS &&
           IDASetLinearSolver(work->ida, work->solver, work->matrix) == IDA_SUCCESS &&
           IDASetJacFn(work->ida, call_jacobian) == IDA_SUCCESS &&
           IDASetNonlinConvCoef(work->ida, iteration_share) == IDA_SUCCESS &&
           IDASetStopTime(work->ida, work->stop) == IDA_SUCCESS &&
           (!work->problem->holds || leave_multipliers_out(work));
}

static void destroy_work(ida_work *work)
{
    IDAFree(&work->ida);
    SUNLinSolFree(work->solver);
    SUNMatDestroy(work->matrix);
    N_VDestroy(work->state);
    N_VDestroy(work->rate);
    N_VDestroy(work->differential);
    nh_sundials_close(&work->sundials);
    nh_free(work->K);
    nh_free(work->base);
    nh_free(work->shifted);
    nh_free(work->point);
    nh_free(work->scale);
    nh_free(work->saddle);
}

/* The whole start, multipliers included, into the rows that hold it already. */
static void enter_start(nh_motion *motion, const ida_work *work)
{
    size_t size = motion->size * sizeof(double);
    for (size_t i = 0; i < motion->count; i++) memcpy(motion->state + i * motion->size, NV_DATA_S(work->state), size);
    memcpy(motion->end_state, NV_DATA_S(work->state), size);
}

/* The largest |f^a| over the output points, beside the largest |F_aj| s_j there, with s_j the size of v_j: what the
 * constraint is made of.  The terms are there, or the motion would not have come so far. */
static double violation(ida_work *work, const nh_motion *motion)
{
    size_t m = work->m, k = work->k;
    double result = 0, *size = nh_alloc_array(2 * k + 1, sizeof *size), *off = size + k;
    for (size_t i = 0; i < motion->count; i++) {
        const double *y = motion->state + i * motion->size;
        if (!terms_at(work, motion->time[i], y, y + m)) continue;
        for (size_t a = 0; a < k; a++) {
            off[a] = fmax(off[a], fabs(work->f[a]));
            for (size_t j = 0; j < m; j++)
                size[a] = fmax(size[a], fabs(work->F[a + j * k]) * fmax(work->scale[m + j], fabs(y[m + j])));
        }
    }
    for (size_t a = 0; a < k; a++)
        if (off[a] > 0) result = fmax(result, off[a] / size[a]);
    nh_free(size);
    return result;
}

static bool integrate(ida_work *work, nh_motion *motion, const double *initial, size_t count, const double *times,
                      const nh_flow_options *options, nh_error *error)
{
    create_arrays(work, options->scale);
    bool created = create_objects(work);
    if (created && !make_consistent(work, times[0], initial, NV_DATA_S(work->state), NV_DATA_S(work->rate), error))
        return false;
    if (!created || !set_up(work, times[0])) return nh_sundials_fail(&work->sundials, error);
    enter_start(motion, work);
    nh_stepper stepper = {.context = work, .advance = ida_advance, .state = ida_state, .stuck = ida_stuck};
    nh_motion_run(motion, count, times, options, &stepper);
    return true;
}

nh_chetaev_motion *nh_chetaev(const nh_chetaev_problem *problem, const double *initial, size_t count,
                              const double *times, const nh_flow_options *options, nh_error *error)
{
    size_t m = problem->coordinates, k = problem->constraints;
    nh_motion *motion = nh_motion_start(2 * m + k, 2 * m, initial, count, times, options, error);
    if (!motion) return NULL;
    ida_work work = {
        .problem = problem, .m = m, .k = k, .stop = times[count - 1], .rtol = nh_motion_rtol(motion, options)};
    nh_chetaev_motion *result = NULL;
    if (integrate(&work, motion, initial, count, times, options, error)) {
        result = nh_alloc(sizeof *result);
        *result = (nh_chetaev_motion){motion, violation(&work, motion)};
    } else {
        nh_motion_free(motion);
    }
    destroy_work(&work);
    return result;
}

void nh_chetaev_motion_free(nh_chetaev_motion *motion)
{
    if (!motion) return;
    nh_motion_free(motion->motion);
    nh_free(motion);
}
