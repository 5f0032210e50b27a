/* monomials: an expression as a polynomial in some of its symbols, whose coefficients are expressions in the others. */
#ifndef NH_MONOMIALS_H
#define NH_MONOMIALS_H

#include "graph/expr.h"

typedef struct {
    size_t symbols, count;
    unsigned char *exponent; /* count x symbols */
    nh_ex *coefficient;      /* of each monomial; their sum times the monomials is the expression */
} nh_monomials;

/* Is e a polynomial in the symbol: is it nowhere in an argument of a function, in an exponent, or below a power that is
 * no whole positive number? */
bool nh_monomials_has_degree(const nh_dag *dag, nh_ex e, nh_ex symbol);

/* Multiplies e out in the symbols (at most 32), in which it is a polynomial.  False: that would take more than `most`
 * coefficients, also of parts of e.  nh_monomials_clear frees what *out holds. */
bool nh_monomials_of(nh_dag *dag, nh_ex e, size_t symbols, const nh_ex *symbol, size_t most, nh_monomials *out);
void nh_monomials_clear(nh_monomials *m);

#endif
