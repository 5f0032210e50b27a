/* graded_solver: how many power series of integrals polynomial in the velocities there are, modulo a prime.
 *
 *     Phi = sum over |alpha| <= d of c_alpha(z) w^alpha,      Gamma(Phi) = 0
 *
 * is a linear system of first order for the c_alpha, solved weight by weight: the coefficients of weight k + 1 enter
 * the equations of weight k through the symbol, which has constant coefficients.  Unknowns that the symbol leaves free
 * become parameters; equations that it cannot solve become conditions on earlier parameters.
 *
 * N(r), the parameters that are free after the equations of weights 0 .. r - 1, bounds the number of integrals of
 * degree d from above, once the symbol is injective at some weight below r + 1 (docs/method.md, sec. 10). */
#ifndef NH_GRADED_SOLVER_H
#define NH_GRADED_SOLVER_H

#include "exact/jet_ring.h"

typedef enum { NH_ALL_DEGREES, NH_EVEN_DEGREES, NH_ODD_DEGREES } nh_parity;

typedef struct {
    const nh_jet_ring *ring;
    size_t n, fields;        /* velocities; X_1..X_n, and X_0 when fields > n */
    const nh_residue *field; /* fields x variables series */
    const nh_residue *rate;  /* n x monomials series: w^l' (jet_equations.h) */
    size_t degree;
    nh_parity parity;       /* parity of |alpha|; a system splits where every term of Gamma changes it */
    size_t most_parameters; /* beyond so many parameters at a time, or so much work, the solver gives up */
    double most_work;       /* limit in products of residues */
    size_t threads;         /* 0: one */
    bool keep;              /* all coefficients of the solutions are wanted, not only their first jets */
    /* solutions of the same problem up to a lower order, to be continued; or 0 of them: start from the point */
    size_t from, from_order, from_size; /* their number; order; coefficients of their series */
    const nh_residue *from_series;      /* alphas x from_size x from */
    /* Phi + sum_j a_j (a combination of given solutions), for coordinates a_j on which nothing depends; or 0 of them */
    size_t left, given, stride;
    const nh_residue *left_rate, *solution; /* left x fields series: a_j'; alphas x size x stride, of which given */
} nh_graded_problem;

typedef struct {
    bool solved;           /* false: a limit was reached */
    size_t order, *total;  /* order + 1: N(r) for r = 0 .. order */
    bool injective;        /* the symbol was injective, from this weight on: */
    size_t injective_at;   /* k0 + 1: N(r) is an upper bound for r >= this */
    size_t unknowns, most; /* number of coefficients; the largest number of parameters */
    size_t alphas;         /* number of monomials in the velocities */
    const uint8_t *alpha;  /* alphas x n: their exponents */
    /* alphas x (1 + variables) x N(order): c_alpha(0) and its derivatives along the coordinates, for every solution */
    nh_residue *jet;
    nh_residue *series; /* alphas x size x N(order), when they are kept: c_alpha */
    bool extended;      /* some combination of the a_j times the given solutions can be part of one */
    double work;
    nh_arena *arena;
} nh_graded_count;

/* Solves weight after weight until the symbol is injective, or to a limit (`solved` is false).  Never NULL; the caller
 * clears it.  [docs/method.md, eqs. 29 and 30] */
nh_graded_count *nh_graded_solve(const nh_graded_problem *problem);

/* The same, continued from the solution of a lower order: *state is NULL, or comes from the same problem with shorter
 * series; it is updated for the next order, and the caller frees it.  Nothing is kept with `keep`, or beyond the
 * limits.  `work` is the whole work of the solution. */
typedef struct nh_graded_state nh_graded_state;
nh_graded_count *nh_graded_continue(const nh_graded_problem *problem, nh_graded_state **state);
void nh_graded_state_free(nh_graded_state *state);
size_t nh_graded_state_order(const nh_graded_state *state);

/* The solutions of the problem that the state comes from: alphas x size x *stride, of which *count.  NULL: beyond its
 * limit of work.  They are the state's, until it is continued. */
const nh_residue *nh_graded_state_solutions(nh_graded_state *state, const nh_graded_problem *problem, size_t *count,
                                            size_t *stride, double *work);

/* Frees what the count holds. */
void nh_graded_count_clear(nh_graded_count *count);

#endif
