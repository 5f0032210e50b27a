/* Explicit steps that keep the energy (integrators.h). One step from (t, z):
 *
 *      direction     k_i = f(t + c_i h, z + h a_ij k_j),  d = b_i k_i
 *      factor        Newton's method for E(z + g h d) = E at the start of the motion, beginning at g = 1
 *      relaxed       z += g h d, t += g h; h is halved where no g within a tenth of 1 does it
 *      advance       the last step before an output: h is corrected until g h is the time that is left */
#include "motion/integrators.h"
#include "motion/turns.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "motion/stepping.h"

enum { most_iterations = 20, most_halvings = 3 };
static const double conserved = 1e-9; /* relative rate of the energy at the probes that counts as rounding */
static const double farthest = 0.1;   /* largest distance of the factor from 1 */
/* units of effort: of a step, and of the sums for each pair of stages */
static const double step_units = 100, stage_vectors = 0.7;
static const double rounding = 64 * DBL_EPSILON; /* of the energy, relative to its terms */

static const nh_tableau classical = {.stages = 4,
                                     .a = {[1] = {0.5}, [2] = {0, 0.5}, [3] = {0, 0, 1}},
                                     .b = {1. / 6, 1. / 3, 1. / 3, 1. / 6},
                                     .c = {0, 0.5, 0.5, 1}};

typedef struct {
    nh_programs *programs;
    nh_tableau tableau;
    size_t size, count;
    double t, step, energy;     /* energy: its value at the start */
    double *z, *z1, *stage, *d; /* stage: NH_MOST_STAGES x size */
    const double *times;
    long before;
} relaxation_work;

const char *nh_relaxation_refused(nh_programs *s)
{
    const nh_model *model = nh_programs_model(s);
    if (model->chart->implicit) return "the constraints are solved by Newton's method inside the equations of motion";
    if (nh_depends(model->dag, model->E, model->system->t)) return "time occurs in the energy";
    size_t size = model->m + model->n;
    for (size_t p = 0; p < model->chart->probes; p++) {
        const double *z = model->chart->probe + p * model->chart->width,
                     *e = nh_programs_at(s, NH_PROGRAM_GRADIENT, z[0], z + 1),
                     *f = nh_programs_at(s, NH_PROGRAM_RATE, z[0], z + 1);
        /* relative to the terms of dE/dt, which are large near the end of a chart */
        double terms = 0, energy = fabs(e[size]);
        for (size_t j = 0; j < size; j++) terms += fabs(e[j] * f[j]), energy += fabs(e[j] * z[1 + j]);
        terms += energy * nh_programs_pace(model, f);
        if (!(fabs(e[size + 1]) <= conserved * terms))
            return "the energy is not conserved: constant energy would give a wrong motion";
    }
    return model->chart->probes ? NULL : "the energy could not be tested at any point";
}

/* The direction d of a step h from (t, z); false where the equations are not finite. */
static bool direction(relaxation_work *k, double h)
{
    const nh_tableau *b = &k->tableau;
    memset(k->d, 0, k->size * sizeof *k->d);
    for (int i = 0; i < b->stages; i++) {
        for (size_t j = 0; j < k->size; j++) {
            double sum = 0;
            for (int l = 0; l < i; l++) sum += b->a[i][l] * k->stage[(size_t)l * k->size + j];
            k->z1[j] = k->z[j] + h * sum;
        }
        const double *f = nh_programs_at(k->programs, NH_PROGRAM_RATE, k->t + b->c[i] * h, k->z1);
        memcpy(k->stage + (size_t)i * k->size, f, k->size * sizeof *f);
        for (size_t j = 0; j < k->size; j++) k->d[j] += b->b[i] * f[j];
    }
    for (size_t j = 0; j < k->size; j++)
        if (!isfinite(k->d[j])) return false;
    return true;
}

/* Newton's method for E(z + g h d) = E at the start; NAN where there is no such g near 1.  Where the motion is nearly
 * steady E hardly depends on g: a step that keeps the energy to rounding by itself is left as it is. */
static double factor(relaxation_work *k, double h)
{
    double g = 1, last = INFINITY, before = nh_programs_at(k->programs, NH_PROGRAM_GRADIENT, k->t, k->z)[k->size],
           small = 0, alone = INFINITY;
    for (int i = 0; i < most_iterations; i++) {
        for (size_t j = 0; j < k->size; j++) k->z1[j] = k->z[j] + g * h * k->d[j];
        const double *e = nh_programs_at(k->programs, NH_PROGRAM_GRADIENT, k->t, k->z1);
        double slope = 0, sum = fabs(k->energy), off = e[k->size] - k->energy;
        for (size_t j = 0; j < k->size; j++) {
            slope += e[j] * h * k->d[j];
            sum += fabs(e[j] * k->z1[j]);
        }
        if (!isfinite(off)) return NAN;
        if (i == 0) small = rounding * sum, alone = fabs(e[k->size] - before);
        if (fabs(off) <= 2 * DBL_EPSILON * sum) return g;
        if (fabs(off) >= last) break;
        last = fabs(off);
        g -= off / slope;
        if (!(fabs(g - 1) <= farthest)) return alone <= small ? 1 : NAN;
    }
    return last <= small ? g : alone <= small ? 1 : NAN;
}

/* Makes one relaxed step of about *h; *h becomes the elapsed time. */
static bool relaxed(relaxation_work *k, double *h)
{
    for (int i = 0; i <= most_halvings; i++) {
        double g = direction(k, *h) ? factor(k, *h) : NAN;
        if (isfinite(g)) {
            for (size_t j = 0; j < k->size; j++) k->z1[j] = k->z[j] + g * *h * k->d[j];
            *h *= g;
            return true;
        }
        *h /= 2;
    }
    return false;
}

static nh_step relaxation_advance(double *time, nh_motion *motion, void *context)
{
    relaxation_work *k = context;
    nh_turns_renew(nh_programs_model(k->programs)->system, k->z, NULL);
    double target = k->times[motion->count], left = target - *time,
           steps = fmax(1, ceil(fabs(left) / k->step * (1 - 1e-3)));
    double h = left / steps, passed = h, exact = 4 * DBL_EPSILON * fmax(fabs(target), fabs(left));
    bool last = steps < 2, good = relaxed(k, &passed);
    for (int i = 0; last && good && i < most_iterations && fabs(passed - left) > exact && fabs(passed) > fabs(left) / 2;
         i++) {
        h *= left / passed;
        passed = h;
        good = relaxed(k, &passed);
    }
    motion->evaluations = nh_programs_evaluations(k->programs) - k->before;
    if (!good) {
        nh_motion_note(motion, "no factor near 1 keeps the energy near t = %.10g; use a smaller step", k->t);
        return NH_STEP_FAILED;
    }
    memcpy(k->z, k->z1, k->size * sizeof *k->z);
    *time = k->t = last && fabs(passed - left) <= 1e3 * exact ? target : *time + passed;
    return *time == k->times[k->count - 1] ? NH_STEP_LAST : NH_STEP_ON;
}

static bool relaxation_state(double time, double *state, void *context)
{
    relaxation_work *k = context;
    (void)time;
    memcpy(state, k->z, k->size * sizeof *state);
    return true;
}

static void relaxation_stuck(nh_motion *motion, void *context)
{
    (void)context;
    nh_motion_note(motion, "the step is too small for double precision near t = %.10g", motion->end_time);
}

nh_motion *nh_relaxation(nh_programs *programs, nh_relaxation_rule rule, const double *initial, size_t count,
                         const double *times, const nh_flow_options *given, nh_error *error)
{
    size_t size = nh_programs_model(programs)->m + nh_programs_model(programs)->n;
    nh_flow_options own = *given, *options = &own;
    own.rtol = 1; /* the method ignores it */
    const char *refused = nh_relaxation_refused(programs);
    relaxation_work k = {.programs = programs,
                         .tableau = classical,
                         .size = size,
                         .count = count,
                         .times = times,
                         .before = nh_programs_evaluations(programs)};
    if (refused) return nh_fail(error, NH_NUMERIC, "", "this method cannot be used here: %s", refused), NULL;
    if (rule == NH_RELAXATION_8 && !nh_tableau_rk8pd(&k.tableau))
        return nh_fail(error, NH_NUMERIC, "", "out of memory"), NULL;
    nh_motion *motion = nh_motion_start(size, size, initial, count, times, options, error);
    if (!motion || motion->complete) return motion;
    k.z = nh_alloc_array((3 + NH_MOST_STAGES) * size, sizeof *k.z);
    k.z1 = k.z + size, k.d = k.z1 + size, k.stage = k.d + size;
    k.t = times[0];
    k.step = options->step > 0 ? options->step : fabs(times[count - 1] - times[0]) / 100;
    memcpy(k.z, initial, size * sizeof *initial);
    k.energy = nh_programs_at(programs, NH_PROGRAM_GRADIENT, k.t, k.z)[size];
    nh_stepper stepper = {.context = &k,
                          .advance = relaxation_advance,
                          .state = relaxation_state,
                          .stuck = relaxation_stuck,
                          .step_effort =
                              step_units + stage_vectors * (double)k.tableau.stages * (double)(k.tableau.stages * size),
                          .rate = nh_programs_rate,
                          .rate_context = programs};
    nh_motion_run(motion, count, times, options, &stepper);
    nh_free(k.z);
    return motion;
}
