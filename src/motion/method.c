#include "motion/integrators.h"
#include "motion/method.h"
#include "motion/turns.h"

#include <string.h>
#include <strings.h>

#include "base/text.h"

static const nh_method methods[] = {
    {"rk8pd", "GSL rk8pd", "explicit Runge-Kutta pair of order 8", NH_METHOD_GSL_ODEIV, NH_RK8PD, false, 0},
    {"rkf45", "GSL rkf45", "explicit Runge-Kutta pair of order 5", NH_METHOD_GSL_ODEIV, NH_RKF45, false, 0},
    {"msadams", "GSL msadams", "Adams's method, fixed-point iteration", NH_METHOD_GSL_ODEIV, NH_MSADAMS, false, 0},
    {"adams", "CVODE Adams", "Adams's method, Newton's iteration", NH_METHOD_CVODE, NH_ADAMS, false, 0},
    {"bdf", "CVODE BDF", "backward differentiation, for stiff equations", NH_METHOD_CVODE, NH_BDF, false, 0},
    {"dormand-prince", "ARKODE Dormand-Prince", "explicit Runge-Kutta pair of order 5", NH_METHOD_ARKODE,
     NH_DORMAND_PRINCE_5, false, 0},
    {"verner", "ARKODE Verner", "explicit Runge-Kutta pair of order 6", NH_METHOD_ARKODE, NH_VERNER_6, false, 0},
    {"fehlberg", "ARKODE Fehlberg", "explicit Runge-Kutta pair of order 8", NH_METHOD_ARKODE, NH_FEHLBERG_8, false, 0},
    {"esdirk", "ARKODE ESDIRK", "diagonally implicit Runge-Kutta pair of order 5, for stiff equations",
     NH_METHOD_ARKODE, NH_ESDIRK_5, false, 0},
    {"midpoint", "midpoint", "implicit midpoint rule, order 2", NH_METHOD_MIDPOINT, NH_MIDPOINT, false, 2},
    {"midpoint-4", "midpoint, order 4", "five implicit midpoint steps composed", NH_METHOD_MIDPOINT, NH_MIDPOINT, true,
     4},
    {"dalembert", "Lagrange-d'Alembert", "discrete Lagrange-d'Alembert principle, order 2", NH_METHOD_MIDPOINT,
     NH_LAGRANGE_DALEMBERT, false, 2},
    {"dalembert-4", "Lagrange-d'Alembert, order 4", "five discrete Lagrange-d'Alembert steps composed",
     NH_METHOD_MIDPOINT, NH_LAGRANGE_DALEMBERT, true, 4},
    {"energy", "energy-preserving", "almost-Poisson pair with the mean gradient, order 2", NH_METHOD_MIDPOINT,
     NH_ENERGY, false, 2},
    {"energy-4", "energy-preserving, order 4", "five energy-preserving steps composed", NH_METHOD_MIDPOINT, NH_ENERGY,
     true, 4},
    {"relaxation-4", "relaxation, order 4", "Runge-Kutta steps along which the energy is kept", NH_METHOD_RELAXATION,
     NH_RELAXATION_4, false, 4},
    {"relaxation-8", "relaxation, order 8", "Prince-Dormand steps along which the energy is kept", NH_METHOD_RELAXATION,
     NH_RELAXATION_8, false, 8},
};

size_t nh_method_count(void) { return sizeof methods / sizeof *methods; }
const nh_method *nh_method_at(size_t index) { return &methods[index]; }

const nh_method *nh_method_find(const char *name)
{
    for (size_t i = 0; i < nh_method_count(); i++)
        if (!strcmp(methods[i].name, name) || !strcmp(methods[i].word, name)) return &methods[i];
    return NULL;
}

/* Names of the same methods in other programs: SUNDIALS, SciPy, MATLAB, Hairer's codes, mechanics; some of these are
 * only similar. */
static const char *elsewhere(const char *word, bool exactly)
{
    static const char *const others[][2] = {{"ida", "bdf"},
                                            {"ode15s", "bdf"},
                                            {"ode23s", "bdf"},
                                            {"lsoda", "bdf"},
                                            {"vode", "bdf"},
                                            {"cvode", "bdf"},
                                            {"radau", "esdirk"},
                                            {"radau5", "esdirk"},
                                            {"ode113", "adams"},
                                            {"dopri5", "dormand-prince"},
                                            {"ode45", "dormand-prince"},
                                            {"rk45", "dormand-prince"},
                                            {"rk4", "rkf45"},
                                            {"rk5", "dormand-prince"},
                                            {"rk8", "rk8pd"},
                                            {"dop853", "rk8pd"},
                                            {"ode78", "rk8pd"},
                                            {"ode89", "rk8pd"},
                                            {"verlet", "dalembert"},
                                            {"leapfrog", "dalembert"},
                                            {"symplectic", "dalembert"},
                                            {"variational", "dalembert"},
                                            {"gauss", "midpoint"},
                                            {"implicit", "midpoint"}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (!strcasecmp(word, others[i][0]) || (!exactly && nh_text_nearest(word, others[i], 1))) return others[i][1];
    return NULL;
}

bool nh_method_given(const char *word, const nh_method **out, nh_error *error)
{
    const char *word_of[sizeof methods / sizeof *methods + 1] = {NH_METHOD_AUTOMATIC};
    *out = nh_method_find(word);
    if (*out || !strcmp(word, NH_METHOD_AUTOMATIC)) return true;
    for (size_t i = 0; i < nh_method_count(); i++) word_of[1 + i] = methods[i].word;
    const char *near = elsewhere(word, true);
    if (!near) near = nh_text_nearest(word, word_of, nh_method_count() + 1);
    if (!near) near = elsewhere(word, false);
    const nh_method *same = elsewhere(word, true) ? nh_method_find(near) : NULL;
    nh_fail(error, NH_USAGE, "", "there is no method `%s`", word);
    if (same)
        return nh_error_hint(error, "the nearest one here is `%s`: %s; `nhsym explain methods` lists them", near,
                             same->about);
    return near ? nh_error_hint(error, "did you mean `%s`? `nhsym explain methods` lists them", near)
                : nh_error_hint(error, "`nhsym explain methods` lists them");
}

static nh_motion *part_by(const void *by, const nh_flow_problem *problem, const double *initial, size_t count,
                          const double *times, const nh_flow_options *options, nh_error *error)
{
    const nh_method *method = by;
    nh_flow_options own = *options;
    switch (method->family) {
    case NH_METHOD_GSL_ODEIV:
        return nh_gsl_odeiv((nh_gsl_odeiv_method)method->kind, problem, initial, count, times, options, error);
    case NH_METHOD_ARKODE:
        return nh_arkode((nh_arkode_method)method->kind, problem, initial, count, times, options, error);
    default: own.method = (nh_flow_method)method->kind; return nh_cvode(problem, initial, count, times, &own, error);
    }
}

nh_motion *nh_method_flow(const nh_method *method, const nh_flow_problem *problem, const double *initial, size_t count,
                          const double *times, const nh_flow_options *options, nh_error *error)
{
    return problem->turns ? nh_turns_flow(part_by, method, problem, initial, count, times, options, error)
                          : part_by(method, problem, initial, count, times, options, error);
}

nh_motion *nh_method_steps(const nh_method *method, nh_programs *programs, const double *initial, size_t count,
                           const double *times, const nh_flow_options *options, nh_error *error)
{
    if (method->family == NH_METHOD_RELAXATION)
        return nh_relaxation(programs, (nh_relaxation_rule)method->kind, initial, count, times, options, error);
    return nh_midpoint(programs, (nh_midpoint_rule)method->kind, method->composed, initial, count, times, options,
                       error);
}

const char *nh_method_refused(const nh_method *method, nh_programs *programs)
{
    if (method->family == NH_METHOD_RELAXATION) return nh_relaxation_refused(programs);
    return method->family == NH_METHOD_MIDPOINT ? nh_midpoint_refused(programs, (nh_midpoint_rule)method->kind) : NULL;
}
