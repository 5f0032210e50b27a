/* dependency_graph: the dependence of a model's states on each other, and the states that a known current determines.
 *
 * State j feeds a function e of the chart when de/dz_j is not identically zero.  A derivative that vanishes at all
 * probes of the chart counts as zero when its normal form is zero, or when balls of 40 digits around its values at the
 * probes contain zero (sums that cancel in M^-1 A).
 *
 * A current Phi = A(z) z_j + B(t, z) that is conserved determines the state z_j = (c - B)/A, c = Phi at the start,
 * wherever A keeps its sign: this state, a velocity for the most part, needs no equation.  States that feed others only
 * through Phi may be dropped. */
#ifndef NH_DEPENDENCY_GRAPH_H
#define NH_DEPENDENCY_GRAPH_H

#include "geometry/model.h"

typedef struct {
    nh_ex current, constant; /* Phi, and the symbol of its value */
    size_t state;            /* of (q, w): the one that it determines */
    /* of that state: (c - B)/A, and A; functions of the remaining states and of the constants */
    nh_ex value, slope;
} nh_level;

typedef struct {
    const nh_model *model;
    size_t states, watches, levels;
    nh_ex *row; /* rates of the states, then the watched expressions, without the states of the levels */
    nh_level *level;
    bool *feeds;   /* [i * states + j]: j feeds row i; only of rows that are needed */
    bool *kept;    /* states with an equation */
    bool implicit; /* the equations contain implicit velocities */
    size_t count;  /* number of kept states */
    size_t cost;   /* instructions of their equations, and ten for each state that is integrated */
} nh_dependency_graph;

/* The closed system of the watched expressions. n conserved currents of the chart: each removes a state if fewer states
 * are left then, and the equations cost less. */
void nh_dependency_graph_init(nh_dependency_graph *graph, const nh_model *model, size_t watches, const nh_ex *watched,
                              size_t n, const nh_ex *current);
void nh_dependency_graph_clear(nh_dependency_graph *graph);

/* Is no watched expression, no equation of a kept state and no current in use a function of this symbol? */
bool nh_dependency_graph_ignores(const nh_dependency_graph *graph, nh_ex symbol);

/* Does Gamma(Phi) vanish identically, by the same test? */
bool nh_dependency_graph_conserved(const nh_model *model, nh_ex current);

/* Momenta dL/dv^s of coordinates that do not occur in the Lagrangian, whose velocities occur in no constraint, and
 * without force: expressions of the chart into `out` (m entries); returns their number. */
size_t nh_dependency_graph_cyclic(const nh_model *model, nh_ex *out);

/* Points (t, q, w, u, c): the inputs of tapes over rows. */
nh_tape *nh_dependency_graph_tape(const nh_dependency_graph *graph, size_t n, const nh_ex *e, size_t fixed,
                                  const nh_ex *symbol, const double *value);

#endif
