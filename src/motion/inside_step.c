/* States inside the last step (inside_step.h).
 *
 *      old ------------------ end         the integrator's own states at both ends
 *       \                  _/ |
 *        auxiliary step ---   | off      GSL's pair from `old` ends a little beside `end`
 *
 *      state(t) = auxiliary(t) + off ((t - before)/(now - before))^2      so that it is continuous at both ends
 *
 * Where many states are wanted (nh_inside_step_dense): the polynomial of degree 9 through states and rates at five
 * nodes, by divided differences with double nodes. */
#include "motion/inside_step.h"

#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "base/memory.h"

struct nh_inside_step {
    const nh_stepper *stepper;
    size_t size;
    double before, now;
    double *states;                   /* block of the six arrays that follow */
    double *old, *end, *off, *errors; /* states at both ends; distance of the auxiliary step from `end` */
    gsl_odeiv2_step *step; /* auxiliary step for steppers without states inside their steps; NULL: this one has them */
    gsl_odeiv2_system system;
    bool completed;       /* `off` belongs to this step */
    double *first, *last; /* rates at both ends, where they are known */
    bool first_known, last_known;
    double *newton; /* coefficients of the polynomial through the nodes, in Newton's form, highest last: TERMS x size */
    bool fitted;    /* they belong to this step */
};

/* Nodes of the polynomial, as parts of the step; each holds a state and its rates. */
enum { NODES = 5, TERMS = 2 * NODES };
static const double node[NODES] = {0, 0.25, 0.5, 0.75, 1};

static int call_rate(double t, const double *z, double *rate, void *context)
{
    const nh_stepper *s = ((nh_inside_step *)context)->stepper;
    return s->rate(t, z, rate, s->rate_context) ? GSL_SUCCESS : GSL_FAILURE;
}

nh_inside_step *nh_inside_step_create(const nh_motion *motion, const nh_stepper *stepper)
{
    size_t size = motion->size;
    nh_inside_step *c = nh_alloc(sizeof *c);
    *c = (nh_inside_step){
        .stepper = stepper, .size = size, .before = motion->end_time, .now = motion->end_time, .completed = true};
    c->old = c->states = nh_alloc_array(6 * size, sizeof *c->states);
    c->end = c->old + size, c->off = c->end + size, c->errors = c->off + size;
    c->first = c->errors + size, c->last = c->first + size;
    memcpy(c->old, motion->end_state, size * sizeof *c->old);
    memcpy(c->end, motion->end_state, size * sizeof *c->end);
    gsl_set_error_handler_off();
    c->system = (gsl_odeiv2_system){.function = call_rate, .dimension = size, .params = c};
    if (stepper->rate && !stepper->dense) c->step = nh_memory_got(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size));
    return c;
}

void nh_inside_step_free(nh_inside_step *c)
{
    if (!c) return;
    if (c->step) gsl_odeiv2_step_free(c->step);
    nh_free(c->newton);
    nh_free(c->states);
    nh_free(c);
}

bool nh_inside_step_take(nh_inside_step *c, double now)
{
    double *last = c->old;
    if (now == c->now || !c->stepper->state(now, c->errors, c->stepper->context)) return false;
    c->old = c->end, c->end = c->errors, c->errors = last;
    c->before = c->now, c->now = now;
    c->completed = c->fitted = false;
    double *rate = c->first;
    c->first = c->last, c->last = rate;
    c->first_known = c->last_known, c->last_known = false;
    return true;
}

double nh_inside_step_begin(const nh_inside_step *c) { return c->before; }
double nh_inside_step_end(const nh_inside_step *c) { return c->now; }
size_t nh_inside_step_size(const nh_inside_step *c) { return c->size; }

/* Integrates from `old` to z at a time in the step. */
static bool step_to(nh_inside_step *c, double time, double *z)
{
    memcpy(z, c->old, c->size * sizeof *z);
    return gsl_odeiv2_step_apply(c->step, c->before, time - c->before, z, c->errors, NULL, NULL, &c->system) ==
           GSL_SUCCESS;
}

bool nh_inside_step_state(double time, double *z, void *inside)
{
    nh_inside_step *c = inside;
    size_t size = c->size;
    if (time == c->before || time == c->now) return memcpy(z, time == c->now ? c->end : c->old, size * sizeof *z), true;
    if (!c->step) return c->stepper->state(time, z, c->stepper->context);
    if (!c->completed) {
        if (!step_to(c, c->now, c->off)) return false;
        for (size_t i = 0; i < size; i++) c->off[i] = c->end[i] - c->off[i];
        c->completed = true;
    }
    double part = (time - c->before) / (c->now - c->before);
    if (!step_to(c, time, z)) return false;
    for (size_t i = 0; i < size; i++) z[i] += part * part * c->off[i];
    return true;
}

static bool rate_at(nh_inside_step *c, double t, const double *z, double *rate, bool *known)
{
    if (!*known) *known = c->stepper->rate(t, z, rate, c->stepper->rate_context);
    return *known;
}

bool nh_inside_step_sketch(double time, double *z, void *inside)
{
    nh_inside_step *c = inside;
    double h = c->now - c->before, x = (time - c->before) / h, y = 1 - x;
    if (!c->stepper->rate || time == c->before || time == c->now) return nh_inside_step_state(time, z, inside);
    if (!rate_at(c, c->before, c->old, c->first, &c->first_known) ||
        !rate_at(c, c->now, c->end, c->last, &c->last_known))
        return false;
    /* Hermite's cubic */
    for (size_t i = 0; i < c->size; i++)
        z[i] = y * y * (1 + 2 * x) * c->old[i] + x * x * (1 + 2 * y) * c->end[i] +
               h * x * y * (y * c->first[i] - x * c->last[i]);
    return true;
}

/* The state and h times its rates at a node. */
static bool at_node(nh_inside_step *c, int k, double *z, double *rate)
{
    double h = c->now - c->before, t = k == NODES - 1 ? c->now : c->before + node[k] * h;
    if (!nh_inside_step_state(t, z, c)) return false;
    if (k == 0 && !rate_at(c, t, z, c->first, &c->first_known)) return false;
    if (k == NODES - 1 && !rate_at(c, t, z, c->last, &c->last_known)) return false;
    const double *known = k == 0 ? c->first : k == NODES - 1 ? c->last : rate;
    if (known == rate && !c->stepper->rate(t, z, rate, c->stepper->rate_context)) return false;
    for (size_t i = 0; i < c->size; i++) rate[i] = h * known[i];
    return true;
}

/* Divided differences over nodes that are all double. */
static bool fit(nh_inside_step *c)
{
    size_t n = c->size;
    double row[TERMS];
    if (!c->newton) c->newton = nh_alloc_array(TERMS * n, sizeof *c->newton);
    for (int k = 0; k < NODES; k++)
        if (!at_node(c, k, c->newton + 2 * (size_t)k * n, c->newton + (2 * (size_t)k + 1) * n)) return false;
    for (size_t i = 0; i < n; i++) {
        for (int j = 0; j < TERMS; j++) row[j] = c->newton[(size_t)(j - j % 2) * n + i];
        for (int order = 1; order < TERMS; order++)
            for (int j = TERMS - 1; j >= order; j--) {
                double width = node[j / 2] - node[(j - order) / 2];
                row[j] = width > 0 ? (row[j] - row[j - 1]) / width : c->newton[(size_t)j * n + i];
            }
        for (int j = 0; j < TERMS; j++) c->newton[(size_t)j * n + i] = row[j];
    }
    return c->fitted = true;
}

bool nh_inside_step_dense(double time, double *z, void *inside)
{
    nh_inside_step *c = inside;
    double x = (time - c->before) / (c->now - c->before);
    if (!c->stepper->rate || time == c->before || time == c->now || !(c->fitted || fit(c)))
        return nh_inside_step_state(time, z, inside);
    for (size_t i = 0; i < c->size; i++) z[i] = c->newton[(TERMS - 1) * c->size + i];
    for (int j = TERMS - 1; j-- > 0;)
        for (size_t i = 0; i < c->size; i++) z[i] = z[i] * (x - node[j / 2]) + c->newton[(size_t)j * c->size + i];
    return true;
}
