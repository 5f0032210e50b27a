/* invariant_forms: the quadratic forms that linear equations with constant coefficients leave invariant, up to a factor
 * exp(-c t):
 *
 *     z' = A z:   d/dt (exp(c t) z.S z) = 0  for all z   <=>   A^T S + S A + c S = 0,   S = S^T,
 *
 * Lyapunov's equation without a right-hand side, whose dimension is the number of pairs of eigenvalues of A with the
 * sum -c where A is diagonal.  It is solved over the field of the parameters, so that no eigenvalue is needed.
 * [V. I. Arnold, Mathematical Methods of Classical Mechanics, appendix 6: quadratic Hamiltonians] */
#ifndef NH_INVARIANT_FORMS_H
#define NH_INVARIANT_FORMS_H

#include "base/memory.h"
#include "graph/expr.h"

typedef struct {
    nh_dag *dag;
    size_t n, parameters;
    const nh_ex *z; /* n symbols; the forms are chosen as simple as possible in the first of them */
    const nh_ex *A; /* n x n, row by row, of numbers and parameters */
    nh_ex c;
    const nh_ex *parameter; /* symbols */
} nh_invariant_question;

typedef struct {
    const char *obstacle; /* why the forms are not known, or NULL */
    size_t count;
    nh_ex *form; /* a basis, without exp(c t): polynomials of z and the parameters without common factor */
} nh_invariant_forms;

/* In the arena; expressions belong to the graph.  The work of the field is counted (base/budget.h). */
nh_invariant_forms nh_invariant_forms_of(nh_arena *arena, const nh_invariant_question *question);

#endif
