/* tableau: the coefficients of GSL's explicit pair of order 8, read from the stepper itself, and its steps for many
   motions at once. */
#ifndef NH_TABLEAU_H
#define NH_TABLEAU_H

#include <stdbool.h>
#include <stddef.h>

enum { NH_MOST_STAGES = 16 };

typedef struct {
    int stages;
    double a[NH_MOST_STAGES][NH_MOST_STAGES], b[NH_MOST_STAGES], c[NH_MOST_STAGES];
    double e[NH_MOST_STAGES]; /* weights of the error estimate */
} nh_tableau;

/* Stage i: k_i = f(t + c_i h, z + h a_ij k_j);  the new state is z + h b_i k_i, its error h e_i k_i.  False when out of
   memory. */
bool nh_tableau_rk8pd(nh_tableau *tableau);

/* to = z + h (weight_j k_j summed over the stages), `count` numbers; k_j at k + j * stride. */
void nh_tableau_add(size_t count, int stages, const double *weight, double h, const double *k, size_t stride,
                    const double *z, double *to);

/* Of each lane, max_i |error_i| / (atol_i + rtol max(|z_i|, |next_i|)); state i of lane l at [i * lanes + l]. */
void nh_tableau_error(size_t kept, size_t lanes, double rtol, const double *atol, const double *error, const double *z,
                      const double *next, double *lane);

#endif
