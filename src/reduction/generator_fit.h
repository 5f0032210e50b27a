/* generator_fit: the combinations of a library's fields that leave a system invariant, by null vectors of their
 * conditions at the places of its kinetic data.
 *
 *     L_xi K = 0, xi(V) = 0  or  xi(L) = 0;   xi(f^a) = 0;   L_xi Q = 0;   xi = sum_k c_k b_k d/dq^(i_k)
 *
 * A column of the library may also be a whole field: it is a sum of terms b d/dq^i then. */
#ifndef NH_GENERATOR_FIT_H
#define NH_GENERATOR_FIT_H

#include "reduction/library.h"

typedef struct {
    const nh_kinetic *k;
    const nh_options *options;
    nh_library l;
    size_t m, n, d;        /* coordinates, columns, null vectors */
    double *scale;         /* m: K_ii^(-1/2), or 1 */
    double *vector, *size; /* n x d null vectors; n: root mean square of each scaled column */
    double last_null, first_other;
    size_t terms; /* of all columns together */
    nh_ex *b;
    size_t *component, *column;
} nh_generator_fit;

/* Sets the scales; k, options and m must be set. */
void nh_generator_fit_scale(nh_generator_fit *fit);
/* Finds the vectors, their sizes and singular values; the library, n and the scales must be set.  False with a message
 * when there is no place to fit at. */
bool nh_generator_fit_solve(nh_generator_fit *fit, nh_error *error);
void nh_generator_fit_clear(nh_generator_fit *fit);

#endif
