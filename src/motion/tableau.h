/* tableau: the coefficients of GSL's explicit pair of order 8, read from the stepper itself. */
#ifndef NH_TABLEAU_H
#define NH_TABLEAU_H

#include <stdbool.h>

enum { NH_MOST_STAGES = 16 };

typedef struct {
    int stages;
    double a[NH_MOST_STAGES][NH_MOST_STAGES], b[NH_MOST_STAGES], c[NH_MOST_STAGES];
    double e[NH_MOST_STAGES]; /* weights of the error estimate */
} nh_tableau;

/* Stage i: k_i = f(t + c_i h, z + h a_ij k_j);  the new state is z + h b_i k_i, its error h e_i k_i.  False when out of memory. */
bool nh_tableau_rk8pd(nh_tableau *tableau);

#endif
