/* One step with h = 1 from z = 0, in which the j-th call of the right-hand side answers with the j-th unit vector: what the stepper asks
 * for and what it returns are rows of its tableau. */
#include "motion/tableau.h"

#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

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
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, NH_MOST_STAGES);
    if (!step) return false;
    int flag = gsl_odeiv2_step_apply(step, 0, 1, tableau->b, tableau->e, NULL, NULL, &system);
    gsl_odeiv2_step_free(step);
    return flag == GSL_SUCCESS;
}
