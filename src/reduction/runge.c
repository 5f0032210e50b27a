#include "reduction/runge.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

#include "base/memory.h"
#include "base/progress.h"

typedef struct {
    size_t n;
    nh_runge_rate *rate;
    void *context;
} problem;

static int rate_of(double t, const double *y, double *rate, void *context)
{
    problem *p = context;
    if (nh_interrupted() || !p->rate(t, y, rate, p->context)) return GSL_EBADFUNC;
    for (size_t i = 0; i < p->n; i++)
        if (!isfinite(rate[i])) return GSL_EBADFUNC;
    return GSL_SUCCESS;
}

/* The units of errors: the size that a state has, or moves by; of a state that is zero and does not move yet, the size
 * that it moves by after the others have moved; 1 for a state that nothing moves.  False when the rates cannot be
 * computed. */
static bool sizes_at(problem *p, double t, double way, const double *y, double *size)
{
    size_t n = p->n;
    double *rate = nh_alloc_array(2 * n + 1, sizeof *rate), *to = rate + n;
    bool good = rate_of(t, y, rate, p) == GSL_SUCCESS, more = good;
    for (size_t i = 0; i < n && good; i++) size[i] = fmax(fabs(y[i]), fabs(way * rate[i]));
    for (size_t level = 1; level < n && more; level++) {
        for (size_t i = 0; i < n; i++) to[i] = y[i] + way * rate[i];
        if (rate_of(t + way, to, rate, p) != GSL_SUCCESS) break;
        more = false;
        for (size_t i = 0; i < n; i++) {
            if (size[i] > 0 || rate[i] == 0) continue;
            size[i] = fabs(way * rate[i]);
            more = true;
        }
    }
    for (size_t i = 0; i < n && good; i++)
        if (!(size[i] > 0)) size[i] = 1;
    nh_free(rate);
    return good;
}

static bool run(problem *p, double t0, double t1, double tolerance, double largest, const double *size, size_t *steps,
                double *y)
{
    size_t n = p->n, before = 0;
    double t = t0, step = (t1 - t0) / 10;
    gsl_odeiv2_system system = {rate_of, NULL, n, p};
    gsl_odeiv2_step *stepper = nh_memory_got(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, n));
    gsl_odeiv2_control *control = nh_memory_got(gsl_odeiv2_control_scaled_new(tolerance, tolerance, 1, 0, size, n));
    gsl_odeiv2_evolve *evolve = nh_memory_got(gsl_odeiv2_evolve_alloc(n));
    bool good = true;
    while (good && t != t1) {
        good =
            *steps > 0 && gsl_odeiv2_evolve_apply(evolve, control, stepper, &system, &t, t1, &step, y) == GSL_SUCCESS;
        size_t taken = evolve->count + evolve->failed_steps - before;
        before += taken;
        *steps -= taken < *steps ? taken : *steps;
        for (size_t j = 0; good && j < n; j++) good = fabs(y[j]) < largest * size[j];
    }
    if (evolve) gsl_odeiv2_evolve_free(evolve);
    if (control) gsl_odeiv2_control_free(control);
    if (stepper) gsl_odeiv2_step_free(stepper);
    return good;
}

static bool start(size_t n, nh_runge_rate *rate, void *context, double t0, double t1, double tolerance, double largest,
                  bool sized, size_t *steps, double *y)
{
    problem p = {n, rate, context};
    gsl_error_handler_t *old = gsl_set_error_handler_off();
    double *size = nh_alloc_array(n + 1, sizeof *size);
    for (size_t i = 0; i < n; i++) size[i] = 1;
    bool good = (!sized || sizes_at(&p, t0, t1 - t0, y, size)) && run(&p, t0, t1, tolerance, largest, size, steps, y);
    gsl_set_error_handler(old);
    nh_free(size);
    return good;
}

enum { most_steps = 20000 };

bool nh_runge(size_t n, nh_runge_rate *rate, void *context, double t0, double t1, double tolerance, double largest,
              size_t *steps, double *y)
{
    size_t none = most_steps;
    return start(n, rate, context, t0, t1, tolerance, largest, false, steps ? steps : &none, y);
}

bool nh_runge_sized(size_t n, nh_runge_rate *rate, void *context, double t0, double t1, double tolerance,
                    double largest, double *y)
{
    size_t none = most_steps;
    return start(n, rate, context, t0, t1, tolerance, largest, true, &none, y);
}
