#include "motion/method.h"

#include <string.h>

static const nh_method methods[] = {
    {"GSL rk8pd", "explicit Runge-Kutta pair of order 8", NH_METHOD_EXPLICIT, NH_RK8PD, false, false},
    {"GSL rkf45", "explicit Runge-Kutta pair of order 5", NH_METHOD_EXPLICIT, NH_RKF45, false, false},
    {"GSL msadams", "Adams's method, fixed-point iteration", NH_METHOD_EXPLICIT, NH_MSADAMS, false, false},
    {"CVODE Adams", "Adams's method, Newton's iteration", NH_METHOD_CVODE, NH_ADAMS, false, false},
    {"CVODE BDF", "backward differentiation, for stiff equations", NH_METHOD_CVODE, NH_BDF, false, false},
    {"ARKODE Dormand-Prince", "explicit Runge-Kutta pair of order 5", NH_METHOD_PAIRS, NH_DORMAND_PRINCE_5, false, false},
    {"ARKODE Verner", "explicit Runge-Kutta pair of order 6", NH_METHOD_PAIRS, NH_VERNER_6, false, false},
    {"ARKODE Fehlberg", "explicit Runge-Kutta pair of order 8", NH_METHOD_PAIRS, NH_FEHLBERG_8, false, false},
    {"midpoint", "implicit midpoint rule, order 2", NH_METHOD_MIDPOINT, NH_MIDPOINT, false, true},
    {"midpoint, order 4", "five implicit midpoint steps composed", NH_METHOD_MIDPOINT, NH_MIDPOINT, true, true},
    {"Lagrange-d'Alembert", "discrete Lagrange-d'Alembert principle, order 2", NH_METHOD_MIDPOINT, NH_LAGRANGE_DALEMBERT, false, true},
    {"Lagrange-d'Alembert, order 4", "five discrete Lagrange-d'Alembert steps composed", NH_METHOD_MIDPOINT, NH_LAGRANGE_DALEMBERT, true, true},
    {"energy-preserving", "almost-Poisson pair with the mean gradient, order 2", NH_METHOD_MIDPOINT, NH_ENERGY, false, true},
    {"energy-preserving, order 4", "five energy-preserving steps composed", NH_METHOD_MIDPOINT, NH_ENERGY, true, true},
};

size_t nh_method_count(void) { return sizeof methods / sizeof *methods; }
const nh_method *nh_method_at(size_t index) { return &methods[index]; }

const nh_method *nh_method_find(const char *name)
{
    for (size_t i = 0; i < nh_method_count(); i++)
        if (!strcmp(methods[i].name, name)) return &methods[i];
    return NULL;
}

nh_motion *nh_method_flow(const nh_method *method, const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                          const nh_flow_options *options, nh_error *error)
{
    nh_flow_options own = *options;
    switch (method->family) {
    case NH_METHOD_EXPLICIT: return nh_explicit((nh_explicit_method)method->kind, problem, initial, count, times, options, error);
    case NH_METHOD_PAIRS: return nh_pairs((nh_pairs_method)method->kind, problem, initial, count, times, options, error);
    default:
        own.method = (nh_flow_method)method->kind;
        return nh_flow(problem, initial, count, times, &own, error);
    }
}
