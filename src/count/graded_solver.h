/* graded_solver: how many power series of integrals polynomial in the velocities there are, modulo a prime.
 *
 *     Phi = sum over |alpha| <= d of c_alpha(z) w^alpha,      Gamma(Phi) = 0
 *
 * is a linear system of first order for the c_alpha, solved weight by weight: the coefficients of weight k + 1 enter
 * the equations of weight k through the symbol, which has constant coefficients; what it leaves free becomes a
 * parameter, what it cannot meet a condition on the parameters of before.
 *
 * N(r), the parameters that are free after the equations of weights 0 .. r - 1, bounds the number of integrals of
 * degree d from above, once the symbol is injective at some weight below r + 1 (docs/method.md, sec. 10). */
#ifndef NH_GRADED_SOLVER_H
#define NH_GRADED_SOLVER_H

#include "exact/jet_ring.h"

typedef enum { NH_ALL_DEGREES, NH_EVEN_DEGREES, NH_ODD_DEGREES } nh_parity;

typedef struct {
    const nh_jet_ring *ring;
    size_t n, fields;           /* velocities; X_1..X_n, and X_0 when fields > n */
    const nh_residue *field;    /* fields x variables series */
    const nh_residue *rate;     /* n x monomials series: w^l' (jet_equations.h) */
    size_t degree;
    nh_parity parity;           /* of |alpha|; it may be split where every term of Gamma changes it */
    size_t most_parameters;     /* beyond this many at a time, or this work, the system is given up */
    double most_work;           /* products of residues */
    bool keep;                  /* all coefficients of the solutions are wanted, not only the first */
} nh_graded_problem;

typedef struct {
    bool solved;                /* false: beyond the limits */
    size_t order, *total;       /* order + 1: N(r) for r = 0 .. order */
    bool injective;             /* the symbol was, from this weight on: */
    size_t injective_at;        /* k0 + 1: N(r) is a bound for r >= this */
    size_t unknowns, most;      /* coefficients; the largest number of parameters */
    size_t alphas;              /* monomials in the velocities */
    const uint8_t *alpha;       /* alphas x n: their exponents */
    /* alphas x (1 + variables) x N(order): c_alpha(0) and its derivatives along the coordinates, of every solution */
    nh_residue *jet;
    nh_residue *series;         /* alphas x size x N(order), when they are kept: c_alpha */
    double work;
    nh_arena *arena;
} nh_graded_count;

/* Weight after weight until the symbol is injective, or to a limit (`solved` is false).  Never NULL; the caller clears
 * it.  [docs/method.md, eqs. 29 and 30] */
nh_graded_count *nh_graded_solve(const nh_graded_problem *problem);

/* The same, going on where the solution of a lower order ended: *state is NULL, or comes from the same problem with
 * shorter series; it is kept for the next order, and the caller frees it.  Nothing is kept where coefficients are
 * (`keep`), or beyond the limits.  `work` is what the solution takes from the beginning. */
typedef struct nh_graded_state nh_graded_state;
nh_graded_count *nh_graded_continue(const nh_graded_problem *problem, nh_graded_state **state);
void nh_graded_state_free(nh_graded_state *state);

void nh_graded_count_clear(nh_graded_count *count);

#endif
