/* relation_solve: the linear algebra of relation.h, over the field K of the constant kernels.
 *
 *     sum_j c_j N_j = 0,   N_j = sum_m a_mj m,   a_mj in K,   m: monomials in the kernels that are not constant
 *
 * Rank, support and a sparse set of independent equations are found with random values of the constants modulo a prime;
 * only that small system is solved over K, and the solution is verified in the equation. */
#ifndef NH_RELATION_SOLVE_H
#define NH_RELATION_SOLVE_H

#include "exact/relation_rows.h"

typedef enum {
    /* unique up to a factor; coefficient[] holds it: polynomials of the parameters without common factor */
    NH_RELATION_UNIQUE,
    NH_RELATION_NONE,
    NH_RELATION_SEVERAL,  /* the relations form a space of dimension two or more */
    NH_RELATION_TOO_LARGE /* more terms than max_terms, or an inexact constant occurs */
} nh_relation_verdict;

/* The verdict; when unique, c[j] gets quotients without denominators and without common factor. */
nh_relation_verdict nh_relation_solve(const nh_relation_system *system, const nh_quotient **c);

/* The null vector of n - 1 independent rows, like c of the verdict; false where it is too large or one of its entries
 * is zero. */
struct nh_relation_rows;
bool nh_relation_solve_rows(struct nh_relation_rows *rows, const size_t *chosen, const nh_quotient **c);

/* Multiplies all q[j] by a common factor so that none has a denominator, not even one that a relation brings.  False,
 * with the field broken, when that is too large. */
bool nh_relation_clear_denominators(nh_quotient_field *field, size_t n, const nh_quotient **q);

/* Multiplies q[j], whose first entry is not zero, so that they become polynomials without common factor; false as
 * above. */
bool nh_relation_make_primitive(nh_quotient_field *field, size_t n, const nh_quotient **q);

/* Is the denominator a number? */
bool nh_relation_is_polynomial(const nh_quotient_field *field, const nh_quotient *q);

#endif
