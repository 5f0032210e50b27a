/* linearization: the equations of motion in all coordinates, linearised at a state.
 *
 *     K v' + h + F^T mu = 0,   f(t, q, v) = 0,   P(q) = 0     [geometry/bordered.h]; P: constraints between positions
 *
 * At a state (q0, v0) with its accelerations and multipliers let w be the velocities of n independent coordinates, x
 * those of the coordinates that the constraints leave free in dq.  With B = df/dq:
 *
 *     F dv + B dq = 0                      dv = R dw + S dq
 *     d(F v' + g) = 0                      dv' = R dw' + E dq + H dw
 *     dq = T dx                            P_q dq = 0, and c^T F dq = 0 for all c with c^T B = 0
 *
 *     M dw' + C dw + N dx = 0,             M = R^T K R,  C = R^T (K H + d_v R),  N = R^T (K E + d_q + d_v S) T
 *     dx' = R_x dw + S_x T dx              d = derivative of K v' + h + F^T mu at constant v', mu
 *
 * The functions c^T F dq are constant along linear motions: without them each would give an eigenvalue 0.  At rest B
 * vanishes, and the linear constraints are integrable, as those of nonholonomic systems always are there
 * [NeimarkFufaev1972, ch. III].  Independent velocities are chosen at the state, by pivots: no chart is needed that is
 * singular there.  All values are balls; one that contains 0 with a radius below NH_LINEAR_DIGITS digits counts as 0.
 *
 * A coordinate on which no remaining rate depends (its column vanishes) is left out, again and again.  The rest is
 * closed; a motion is steady where its rates vanish. */
#ifndef NH_LINEARIZATION_H
#define NH_LINEARIZATION_H

#include "exact/ball_matrix.h"
#include "geometry/model.h"

enum { NH_LINEAR_DIGITS = 40 };

/* The expressions, of one system. */
typedef struct nh_linearization nh_linearization;
/* Keeps the system, which has to outlive it; nh_linearization_free. */
nh_linearization *nh_linearization_create(nh_system *system);
void nh_linearization_free(nh_linearization *linearization);

/* A state: expressions in parameters, 1 + 2m: t, q, v; and which of q and v were given (2m). */
typedef struct {
    const nh_ex *value;
    const bool *given;
    bool project; /* move positions and velocities onto the constraints */
} nh_linear_state;

/* Matrices are row by row. */
typedef struct {
    size_t m, k, n, s;    /* coordinates, constraints, independent velocities, independent coordinates */
    size_t *velocity;     /* n: the coordinates whose velocities w are */
    size_t *position;     /* s: the coordinates x */
    double t, *q, *v, *a; /* the state, and its accelerations: m each */
    double *M, *C, *N;    /* n x n, n x n, n x s */
    double *A;            /* (s + n) x (s + n), of (x, w); */
    double *R, *S, *T;    /* m x n, m x m, m x s */
    double error;         /* largest error of an entry */
    bool *closed;         /* s + n: is it one of the closed rest? */
    size_t size;          /* how many are */
    double residual;      /* the largest rate of one of these; 0 where all vanish */
    bool moves;           /* a coordinate that is left out moves */
    bool changes;         /* the closed part of A is another one at other states of the motion */
    size_t eigenvalues;   /* of the closed part of A; 0 where none were enclosed */
    nh_eigenvalue *eigenvalue;
} nh_linear_equations;

/* The linear equations at a state, for values of the parameters (as in the system).  The caller frees them.  NULL with
 * a message where the state violates the constraints, where the equations have no value, or a kink, or determine no
 * accelerations. */
nh_linear_equations *nh_linearization_at(nh_linearization *linearization, const double *parameter,
                                         const nh_linear_state *state, nh_error *error);
void nh_linear_equations_free(nh_linear_equations *equations);

#endif
