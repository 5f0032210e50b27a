/* ball_box: how well functions of several variables on a box solve linear equations of first order, with rigorous
 * bounds.
 *
 *     R_b(s) = sum_a ( sum_j A_baj(s) d f_a/d s_j + B_ba(s) f_a ),     f_a polynomials of degree K in s
 *
 * R_b is interpolated at N = K + m + 1 Chebyshev nodes in each of r variables, where its values are balls.  Let A~ be
 * the polynomials of degree m that interpolate the A: with them in their place R_b is a polynomial that the N nodes
 * reproduce.  So with Lebesgue's constant L of N nodes [Trefethen2013, thm. 15.2]
 *
 *     |R_b| <= L^r max over the nodes |R_b| + (1 + L^r) sum_a ( sum_j |A - A~| |d f_a/d s_j| + |B - B~| |f_a| ),
 *     |A - A~| <= sum_j l^(j-1) 2 (h_j/2)^(m+1) max |d^(m+1) A/d s_j^(m+1)|/(m+1)!,    l: of m + 1 nodes,
 *
 * where the last coefficient of Taylor is enclosed about all points of the box at once [ball_series.h].  The box is
 * halved along all edges until these bounds are small. */
#ifndef NH_BALL_BOX_H
#define NH_BALL_BOX_H

#include "exact/ball.h"

enum { NH_BOX_VARIABLES = 3 };

typedef struct {
    size_t variables, functions, equations;
    const nh_ex *variable;
    const nh_ex *along; /* A: [(b * functions + a) * variables + j], in the variables alone */
    const nh_ex *plain; /* B: [b * functions + a] */
} nh_box_equations;

/* Functions on a box as sums of c_i prod_j T_(k_ij)((2 s_j - low_j - high_j)/(high_j - low_j)). */
typedef struct {
    double low[NH_BOX_VARIABLES], high[NH_BOX_VARIABLES]; /* meant as the decimals that they are printed as */
    size_t degree, terms;
    const unsigned char *index; /* k: terms x variables */
    size_t count;               /* solutions */
    const double *coefficient;  /* [(solution * functions + a) * terms + i] */
} nh_box_functions;

/* For every solution an upper bound of sum_b |R_b| on the box, out[count].  False where none below `wanted` was found
   for all of them with the work that this is allowed. */
bool nh_ball_box_bound(const nh_dag *dag, const nh_box_equations *equations, const nh_box_functions *functions,
                       double wanted, double *out);

#endif
