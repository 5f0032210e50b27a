#include "reduction/runge.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

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

bool nh_runge(size_t n, nh_runge_rate *rate, void *context, double t0, double t1, double tolerance, double largest, size_t *steps, double *y)
{
    enum { most_steps = 20000 };
    problem p = {n, rate, context};
    double t = t0, step = (t1 - t0) / 10;
    gsl_odeiv2_system system = {rate_of, NULL, n, &p};
    gsl_error_handler_t *old = gsl_set_error_handler_off();
    gsl_odeiv2_step *stepper = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, n);
    gsl_odeiv2_control *control = gsl_odeiv2_control_y_new(tolerance, tolerance);
    gsl_odeiv2_evolve *evolve = gsl_odeiv2_evolve_alloc(n);
    bool good = stepper && control && evolve;
    size_t before = 0, none = most_steps;
    if (!steps) steps = &none;
    while (good && t != t1) {
        good = *steps > 0 && gsl_odeiv2_evolve_apply(evolve, control, stepper, &system, &t, t1, &step, y) == GSL_SUCCESS;
        size_t taken = evolve->count + evolve->failed_steps - before;
        before += taken;
        *steps -= taken < *steps ? taken : *steps;
        for (size_t j = 0; good && j < n; j++) good = fabs(y[j]) < largest;
    }
    if (evolve) gsl_odeiv2_evolve_free(evolve);
    if (control) gsl_odeiv2_control_free(control);
    if (stepper) gsl_odeiv2_step_free(stepper);
    gsl_set_error_handler(old);
    return good;
}
