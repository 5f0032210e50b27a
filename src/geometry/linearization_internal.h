/* linearization_internal: declarations for linearization*.c. */
#ifndef NH_LINEARIZATION_INTERNAL_H
#define NH_LINEARIZATION_INTERNAL_H

#include "exact/ball.h"
#include "exact/ball_arb.h"
#include "geometry/linearization.h"

/* Expressions in t, q, v, the accelerations a and the multipliers mu; matrices row by row. */
struct nh_linearization {
    nh_system *system;
    nh_dag *dag;
    nh_arena *arena;
    size_t m, k, p;           /* p: constraints between positions */
    nh_ex *q, *v, *a, *mu;    /* symbols */
    nh_ex *K, *h, *F, *g, *f; /* m x m, m, k x m, k, k */
    nh_ex *P, *P_q;           /* p; p x m */
    nh_ex *B;                 /* k x m: df/dq */
    nh_ex *d_q, *d_v;         /* m x m: derivatives of K a + h + F^T mu */
    nh_ex *c_q, *c_v;         /* k x m: derivatives of F a + g */
    size_t walls;
    nh_ex *wall;
};

/* One evaluation. */
typedef struct {
    const nh_linearization *l;
    nh_ball *ball;
    long bits;
    arb_t begin, t;  /* the time of the state, and of one beside it */
    arb_ptr q, v, a; /* m each: the state, as mid-points, and its accelerations */
    size_t n, s;
    bool chosen;       /* are these chosen?  At other states they stay */
    size_t *dependent; /* k coordinates; those of w behind them, n */
    size_t *fixed;     /* m - s coordinates; those of x behind them, s */
    arb_mat_t R, S, T, M, C, N, A;
} nh_linear_work;

/* ---- matrices of balls ---- */

/* The values of rows x columns expressions; false where one has none. */
bool nh_linear_load(nh_ball *ball, size_t rows, size_t columns, const nh_ex *e, arb_mat_t out);
/* Is |x| below 10^-NH_LINEAR_DIGITS scale? */
bool nh_linear_vanishes(const arb_t x, double scale);
double nh_linear_largest(const arb_mat_t A);
/* Gauss and Jordan: rows are exchanged and combined until the first `rank` rows have a unit column each; the columns
 * are taken in the given order, those with small pivots last.  Writes them to pivot, and behind them the other columns
 * of `order`.  Returns the rank. */
size_t nh_linear_eliminate(arb_mat_t A, size_t columns, const size_t *order, size_t *pivot, long bits);

/* ---- states ---- */

/* Sets q and v to a state that satisfies the constraints to all bits. */
bool nh_linear_start(nh_linear_work *w, const nh_linear_state *state, nh_error *error);
/* Newton's steps for P(q) = 0, moving the coordinates that are `free` by least squares.  Writes the first step's size,
 * relative to 1 + |q|; false where they do not converge. */
bool nh_linear_positions(nh_linear_work *w, const bool *free, double *first_step);
/* The dependent velocities from the constraints. */
bool nh_linear_dependent_velocities(nh_linear_work *w);
/* Sets the symbols of the ball to q and v. */
void nh_linear_set(nh_linear_work *w);
/* The order in which coordinates become dependent: those that are `last` come last. */
void nh_linear_order(const nh_linearization *l, const bool *last, size_t *order);

/* ---- the linear equations at the state ---- */

/* Fills everything behind q and v. */
bool nh_linear_matrices(nh_linear_work *w, nh_error *error);

#endif
