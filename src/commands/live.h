/* live: a motion as functions that a page computes anew when a reader changes a number (document/live.h writes them).
 *
 *     rhs         rate of the state: (q, w) of a chart that is regular everywhere, otherwise (q, v) of all coordinates,
 *                 with the multipliers as unknowns
 *     observe     the values that are followed: coordinates, velocities, energy, multipliers, numbers of the drawing
 *     quantities  conserved quantities, and the sums of the moduli of their terms
 *     conditions  what a state has to satisfy: equations between positions, then constraints of the velocities
 */
#ifndef NH_LIVE_H
#define NH_LIVE_H

#include "commands/export.h"
#include "problem/observables.h"

/* A quantity that is, or should be, conserved. */
typedef struct {
    const char *name;
    nh_ex value, in_velocities;  /* in the chart; in (t, q, q'), or 0: not known */
    bool proved, all_parameters; /* proved: for the given parameters at least */
    const nh_ex *fixed;          /* parameters that must keep their values (integrals/fixed.h); or NULL */
} nh_live_quantity;

typedef struct {
    const nh_model *model;
    const nh_observables *tracks; /* what is followed; first the coordinates and all velocities */
    const double *first;          /* the values of these states at the begin */
    double begin, end;
    size_t quantities;
    const nh_live_quantity *quantity;
} nh_live_request;

typedef struct {
    nh_export *code; /* the functions above, in this order; those that are not needed are missing */
    const char *why; /* why a page cannot compute the motion; NULL: it can */
    const nh_model *model;
    size_t states;
    const char **state;      /* names, as after --initial */
    const nh_ex *symbol;     /* the same as symbols */
    double *initial, *floor; /* floor: the error of a state is relative to max(|state|, floor) */
    double begin, end;
    size_t tracks;       /* those of the request that `observe` computes; all with `why` */
    const size_t *track; /* their indices in the request */
    size_t quantities;
    const nh_live_quantity *quantity;
    const bool *without; /* per quantity: the language cannot write it, and it is 0 here */
} nh_live;

/* Can a language write this expression?  NULL: it can; otherwise the function that it lacks. */
typedef const char *nh_live_lacks(const nh_dag *dag, nh_ex e);

/* Borrows all of the request.  The caller frees the result. */
nh_live *nh_live_create(const nh_live_request *request, nh_live_lacks *lacks);
/* Gives the functions up: all tracks are then those of a motion that was computed. */
void nh_live_leave(nh_live *live, const nh_observables *tracks, const char *why);
void nh_live_free(nh_live *live);

#endif
