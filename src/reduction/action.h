/* action: a group by its infinitesimal generators, and the kind of reduction that it allows.
 *
 * With E = (e_a) (m x d) and D = ker omega, at generic points:
 *
 *     free                 rank E = d
 *     dimension assumption V + D = TQ: rank [E, D] = m                 [ChhabraEmami2014, eq. 2.7], [CendraDiaz2007,
 *     sec. 2]
 *     dim S, S = D cap V   d + (m - f) - rank [E, D]
 *     Chaplygin            S = 0 and V + D = TQ
 *
 * Left action: [e_a, e_b] = c_ab^k e_k as fields gives the Lie algebra constants C_ab^k = -c_ab^k. */
#ifndef NH_ACTION_H
#define NH_ACTION_H

#include "reduction/algebra.h"
#include "reduction/invariance.h"

typedef struct {
    const nh_kinetic *kinetic;
    size_t d;
    nh_generator *generator; /* d */
    nh_algebra algebra;      /* C */
    nh_ex *constant;         /* d x d x d: the same as expressions of the parameters (constants.h) */
    bool exact;              /* they are known exactly, not by numbers at the sample points */
    bool closes;
    double closure;  /* largest residual of a bracket, relative */
    size_t worst[2]; /* the bracket with the largest residual */
    /* d x d: this bracket is no combination of the generators; its constants are 0 and have no meaning */
    bool *outside;
    size_t orbit;       /* rank E at generic points; d - orbit: isotropy */
    bool free;          /* at every sample point */
    double least;       /* the least sigma_min / sigma_max of E, columns scaled */
    size_t least_place; /* index of that sample point */
    bool dimension_assumption, chaplygin;
    size_t intersection;   /* dim S */
    double transversality; /* Chaplygin: the least sigma_min / sigma_max of omega on V */
} nh_action;

enum { NH_ACTION_PLACES = 16 }; /* sample points at which fields are compared */

/* The generators are copied (the expressions live in the kinetic's graph). */
void nh_action_init(nh_action *action, const nh_kinetic *kinetic, size_t d, const nh_generator *generator,
                    const nh_options *options);
void nh_action_clear(nh_action *action);
/* A part of nh_action_init: algebra, constant, closes, closure, worst and outside from the generators. */
void nh_action_find_constants(nh_action *action, const nh_options *options);

/* Can the group be divided out: are its fields invariant, independent, closed, and free at the sample points?  The
 * message names the field, the bracket or the point. */
bool nh_action_check(const nh_action *action, const nh_options *options, nh_error *error);
/* Does the orbit through a place have the dimension of generic orbits? */
bool nh_action_check_at(const nh_action *action, const double *q, const nh_options *options, nh_error *error);
/* Its dimension there. */
size_t nh_action_orbit_at(const nh_action *action, const double *q, const nh_options *options);

/* Combinations f_j = sum_a t[a + j*d] e_a as an action of their own; exact where the numbers are whole. */
void nh_action_sub(nh_action *out, const nh_action *action, size_t r, const double *t, const nh_options *options);

/* E at a place, m x d, column-major. */
void nh_action_values(const nh_action *action, const double *q, double *E);

/* Constant combinations of generators that lie in D everywhere (horizontal symmetries): basis columns c (d x count),
   echelon form. */
size_t nh_action_horizontal(const nh_action *action, const nh_options *options, double *c);

/* Constants c (d) with omega(c^a e_a) + b = 0 everywhere: a symmetry that satisfies affine constraints itself, so that
 * E - c^a e_a . p is conserved [FassoSansonetto2016].  False when there are none. */
bool nh_action_moving(const nh_action *action, double *c);

/* The flow of sum_a c[a] e_a for the time t, of a place q (overwritten). */
typedef struct nh_flows nh_flows;
/* Keeps the action, which has to outlive it.  c: d numbers, q: m coordinates.  False where the flow ends before t, or
 * leaves all bounds. */
nh_flows *nh_flows_create(const nh_action *action);
void nh_flows_free(nh_flows *flows);
bool nh_flows_move(nh_flows *flows, const double *c, double t, double *q);
/* Does the flow of sum_a c[a] e_a return, angles counted modulo 2 pi?  Tried are the times 2 pi and 4 pi, and the
 * periods that the eigenvalues of its Jacobian suggest. */
bool nh_flows_closed(nh_flows *flows, const double *c);

#endif
