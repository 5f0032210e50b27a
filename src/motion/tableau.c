/* Reads a tableau from one step with h = 1 from z = 0, in which the j-th call of the right-hand side returns the j-th
 * unit vector: the states that the stepper asks for and its result are rows of the tableau. */
#include "base/clones.h"
#include "motion/integrators.h"

#include <math.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "base/memory.h"

static int spy(double t, const double *z, double *rate, void *context)
{
    nh_tableau *tableau = context;
    int i = tableau->stages;
    if (i >= NH_MOST_STAGES) return GSL_EBADFUNC;
    tableau->c[i] = t;
    memcpy(tableau->a[i], z, sizeof tableau->a[i]);
    memset(rate, 0, NH_MOST_STAGES * sizeof *rate);
    rate[i] = 1;
    tableau->stages++;
    return GSL_SUCCESS;
}

bool nh_tableau_rk8pd(nh_tableau *tableau)
{
    *tableau = (nh_tableau){0};
    gsl_set_error_handler_off();
    gsl_odeiv2_system system = {.function = spy, .dimension = NH_MOST_STAGES, .params = tableau};
    gsl_odeiv2_step *step = nh_memory_got(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, NH_MOST_STAGES));
    int flag = gsl_odeiv2_step_apply(step, 0, 1, tableau->b, tableau->e, NULL, NULL, &system);
    gsl_odeiv2_step_free(step);
    return flag == GSL_SUCCESS;
}

/* ---- steps of many motions at once ---- */

NH_CLONES void nh_tableau_add(size_t count, int stages, const double *weight, double h, const double *k, size_t stride,
                              const double *z, double *to)
{
    memcpy(to, z, count * sizeof *to);
    for (int j = 0; j < stages; j++) {
        double x = h * weight[j];
        if (x == 0) continue;
        const double *from = k + (size_t)j * stride;
        for (size_t i = 0; i < count; i++) to[i] += x * from[i];
    }
}

NH_CLONES void nh_tableau_error(size_t kept, size_t lanes, double rtol, const double *atol, const double *error,
                                const double *z, const double *next, double *lane)
{
    for (size_t l = 0; l < lanes; l++) lane[l] = 0;
    for (size_t i = 0; i < kept; i++)
        for (size_t l = 0; l < lanes; l++) {
            double x = fabs(z[i * lanes + l]), y = fabs(next[i * lanes + l]),
                   e = fabs(error[i * lanes + l]) / (atol[i * lanes + l] + rtol * (x > y ? x : y));
            lane[l] = e > lane[l] || e != e ? e : lane[l];
        }
}
