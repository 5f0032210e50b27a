/* linear_equation: linear differential equations with rational coefficients,
 *
 *     dY/dx = A(x) Y,   A = num/den,   num and den in Z[x]
 *
 * What a particular motion leaves for the engines (kovacic.h, monodromy.h, residues.h). */
#ifndef NH_LINEAR_EQUATION_H
#define NH_LINEAR_EQUATION_H

#include <flint/fmpq_poly.h>
#include <flint/fmpz_poly.h>
#include <stdbool.h>

#include "base/memory.h"

typedef struct {
    size_t size;
    fmpz_poly_struct *num; /* size x size, row-major */
    fmpz_poly_t den;       /* not 0; without content in common with all of num */
} nh_linear_equation;

/* All of num 0, den 1; the caller clears it by nh_linear_equation_clear. */
void nh_linear_equation_init(nh_linear_equation *equation, size_t size);
void nh_linear_equation_clear(nh_linear_equation *equation);
/* Entry (i, j) of A becomes the value; call nh_linear_equation_reduce after the last. */
void nh_linear_equation_set(nh_linear_equation *equation, size_t i, size_t j, const fmpq_poly_t num,
                            const fmpq_poly_t den);
/* Cancels what all entries and den have in common. */
void nh_linear_equation_reduce(nh_linear_equation *equation);

/* y'' + P y' + Q y = 0 for the first unknown of an equation of size 2; P, Q as reduced quotients.  False: the size is
 * not 2, or the matrix is triangular. */
bool nh_linear_equation_second_order(const nh_linear_equation *equation, fmpq_poly_t p_num, fmpq_poly_t p_den,
                                     fmpq_poly_t q_num, fmpq_poly_t q_den);
/* r = P^2/4 + P'/2 - Q, reduced, of y'' = r y. */
void nh_linear_equation_normal_form(const fmpq_poly_t p_num, const fmpq_poly_t p_den, const fmpq_poly_t q_num,
                                    const fmpq_poly_t q_den, fmpz_poly_t r_num, fmpz_poly_t r_den);

#endif
