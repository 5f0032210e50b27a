/* ideal_chain: a Lie algebra along a chain g = n_0 > n_1 > ..., each an ideal of the one before [CendraDiaz2018, sec. 2
 * and 3].
 *
 * It need not be one of g: along a line in the plane, se(2) > R^2 > R, the brackets below are still those of n_j, and
 * nothing else is used (their theorem 2.3). Block j holds basis vectors that complete n_(j+1) to n_j.  With an inner
 * product g0 on g, the horizontal lift H_j : n_j/n_(j+1) -> n_j takes a class to its representative orthogonal to
 * n_(j+1); (H_0 H_1 ...) splits g: a vector in parts is xi = sum_j H_j xi_j.  With
 *
 *     a_j(x, y) = -( [H_j x, H_j y] - H_j block_j [H_j x, H_j y] ),      b_j(x, N) = [H_j x, N],  N in n_(j+1)
 *
 * the bracket in parts is                                                                           [CendraDiaz2018,
 * eq. 14]
 *
 *     [e, f]_i = block_i [H_i e_i, H_i f_i] + sum_(j<i) { -a_j(e_j, f_j) + b_j(e_j, sum_(k>j) H_k f_k) - b_j(f_j,
 *     sum_(k>j) H_k e_k) }_i
 *
 * and the Euler-Poincare equations are beta_i'(xi_i) = sum_l <beta_l, [eta, xi_i]_l>: the full pairing.  (The paper's
 * eq. 20 drops terms of it that do not vanish.) */
#ifndef NH_IDEAL_CHAIN_H
#define NH_IDEAL_CHAIN_H

#include "base/error.h"
#include "reduction/algebra.h"

typedef struct {
    size_t d, blocks;
    size_t *size, *start; /* blocks: number of basis vectors, and the first of them in `order` */
    size_t *order;        /* d: basis vectors, block after block */
    nh_algebra algebra;   /* in the order of the blocks */
    double *lift, *split; /* d x d: (H_0 H_1 ...), and its inverse; in the order of the blocks */
} nh_ideals;

/* `order` lists the basis vectors block after block; `metric` is g0 in the algebra's own basis (d x d, column-major).
 * Fails, naming the bracket, when some n_(j+1) is not an ideal of n_j. */
bool nh_ideals_init(nh_ideals *chain, const nh_algebra *algebra, size_t blocks, const size_t *size, const size_t *order,
                    const double *metric, nh_error *error);
void nh_ideals_clear(nh_ideals *chain);
/* A chain of ideals of g, spanned by basis vectors, as long as possible: the sizes of its blocks and the order; returns
 * the number of blocks. */
size_t nh_ideals_find(const nh_algebra *algebra, size_t *size, size_t *order);

/* Parts of a vector of the algebra's own basis, and back; parts of a covector (beta_j = H_j^T mu). */
void nh_ideals_split(const nh_ideals *chain, const double *xi, double *parts);
void nh_ideals_join(const nh_ideals *chain, const double *parts, double *xi);
void nh_ideals_split_covector(const nh_ideals *chain, const double *mu, double *beta);

/* The bracket of two vectors in parts, stage by stage. */
void nh_ideals_bracket(const nh_ideals *chain, const double *e, const double *f, double *out);
/* The right-hand side of the Euler-Poincare equations in parts: out_i(xi) = <beta, [eta, xi]> for xi in block i. */
void nh_ideals_euler_poincare(const nh_ideals *chain, const double *eta, const double *beta, double *out);

#endif
