/* closed_subsystem: the smallest closed subsystem of a model that determines the observables.
 *
 * The states are z = (q, w), z' = f(t, z) = (rho, a).  The states that feed an observable, directly or through others
 * (dependency_graph.h), are a closed system: the rest of the model cannot influence the observables.  Conserved
 * currents may determine some of them, which then need no equation.  Kept states that feed no other kept state are
 * quadratures: they follow from the others by integration alone, in layers.  The remaining states are the core.
 *
 * A subsystem is constant after creation; its problem has its own work memory. */
#ifndef NH_CLOSED_SUBSYSTEM_H
#define NH_CLOSED_SUBSYSTEM_H

#include "base/text.h"
#include "motion/dynamics.h"
#include "motion/dependency_graph.h"

typedef struct {
    const nh_model *model;
    nh_arena *arena;
    size_t states;                  /* m + n of the whole model */
    size_t core, quadratures, kept; /* kept = core + quadratures */
    size_t levels;                  /* states that conserved currents determine */
    size_t *state; /* states, as indices into (q, w): the core, then the quadratures in an order in which they can be
                                       integrated, then those that currents determine, then those dropped */
    bool implicit; /* the equations contain implicit velocities */
    /* equations and watched expressions are analytic in all kept states: the end of a chart does not end the motion */
    bool smooth;
    nh_dependency_graph graph;
    /* rates of the kept states over points (t, q, w, u, c), NULL when nothing is kept; the Jacobian is NULL where it is
     * long */
    nh_tape *rate, *jacobian;
    /* values and slopes of the levels over the same points; the currents over (t, q, w, u) */
    nh_tape *removed, *currents;
    size_t walls;                             /* walls of the rates of the kept states (exact/walls.h) */
    nh_tape *wall;                            /* over the same points as rate; NULL: there are none */
    nh_tape *rate_of_all;                     /* rates of all states, over (t, q, w, u) */
    size_t instructions, instructions_of_all; /* of the right-hand sides */
} nh_closed_subsystem;

/* The subsystem for n watched expressions of the chart; conserved currents (there may be none) may determine states.
 * Never fails: the whole model is a closed subsystem of itself.  Keeps the model, which has to outlive it; the caller
 * frees it. */
nh_closed_subsystem *nh_closed_subsystem_create(const nh_model *model, size_t n, const nh_ex *watched, size_t currents,
                                                const nh_ex *current);
void nh_closed_subsystem_free(nh_closed_subsystem *subsystem);

/* The equations of the kept states, from z0 (m + n values) at time t.  Dropped states keep their initial values, and
 * currents the values that they have there.  The caller frees the result before the subsystem. */
typedef struct nh_closed_subsystem_run nh_closed_subsystem_run;
nh_closed_subsystem_run *nh_closed_subsystem_run_create(const nh_closed_subsystem *subsystem, double t,
                                                        const double *z0);
void nh_closed_subsystem_run_free(nh_closed_subsystem_run *run);
/* As nh_dynamics_jit and nh_dynamics_words. */
void nh_closed_subsystem_run_jit(nh_closed_subsystem_run *run, double patience);
const char *nh_closed_subsystem_run_words(const nh_closed_subsystem_run *run);
/* The level whose current does not determine its state, at the start or at the last evaluated point; -1: none. */
long nh_closed_subsystem_run_failed(const nh_closed_subsystem_run *run);
/* The problem for the integrators.  `whole`: the problem of the whole model, whose guards are watched unless the
 * subsystem is smooth; it must outlive the run.  May be NULL. */
nh_flow_problem nh_closed_subsystem_problem(nh_closed_subsystem_run *run, const nh_flow_problem *whole);
/* The point (t, q, w, u) that belongs to the kept states z; width entries.  False when the implicit velocities cannot
 * be found, or a current no longer determines its state. */
bool nh_closed_subsystem_point(nh_closed_subsystem_run *run, double t, const double *z, double *point);

/* "2 of 5 states integrated (omega, v), phi and x by quadrature, y not needed; 5 of 8 operations" */
void nh_closed_subsystem_words(const nh_closed_subsystem *subsystem, nh_text *out);
/* "the parameters jz3 and l2 have no influence, nor the body column"; empty when all matter. */
void nh_closed_subsystem_idle_words(const nh_closed_subsystem *subsystem, nh_text *out);
/* The name of state i of (q, w). */
const char *nh_closed_subsystem_state_name(const nh_closed_subsystem *subsystem, size_t i);

#endif
