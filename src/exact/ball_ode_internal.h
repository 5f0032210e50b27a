/* ball_ode_internal: declarations for ball_ode*.c. */
#ifndef NH_BALL_ODE_INTERNAL_H
#define NH_BALL_ODE_INTERNAL_H

#include "exact/ball_internal.h"
#include "exact/ball_ode.h"

enum { NH_ODE_TERMS = 112, NH_ODE_PIECES = 96, NH_ODE_SPARE = 4 };

/* f = sum_k f_k x^k, x = (s - centre)/half in [-1, 1]. */
typedef struct {
    double centre, half;
    arb_ptr f; /* (k * words + i) * dimension + v */
} nh_ode_piece;

struct nh_ball_ode {
    nh_ball *ball;
    nh_ball_ode_problem q;
    long bits;
    size_t words, *word, samples, *sample, dimension;
    long *scale;  /* word i has the size 2^scale[i], and f_i is multiplied by that */
    double rate;  /* log10 of the largest entry of R */
    double guess; /* for the choice of the next half width */
    size_t pieces;
    nh_ode_piece *piece;
};

/* Counts so many products of two numbers. */
void nh_ode_work(const nh_ball_ode *ode, double products);
/* z += x y, of mid-points. */
void nh_ode_add_product(arb_ptr z, arb_srcptr x, arb_srcptr y, long bits);
/* log10 |v| of the mid-point; the largest of a matrix. */
double nh_ode_size(arb_srcptr v);
double nh_ode_largest(const arb_mat_t a);

/* Chooses samples at which everything has a value, then the words that are no combinations of earlier ones. */
bool nh_ode_choose(nh_ball_ode *ode, double s);
/* Computes M, and C = R + B M unless C is NULL. */
bool nh_ode_equation(nh_ball_ode *ode, double s, arb_mat_t M, arb_mat_t *C);
/* Solves on one interval about `centre`, with f_0 given there: as wide as possible, and at most of half width
 * `half`. */
bool nh_ode_add_piece(nh_ball_ode *ode, double centre, double half, double least, arb_srcptr start);
/* The values of the functions at s, from one piece; `derivative`: their derivatives by s. */
void nh_ode_evaluate(const nh_ball_ode *ode, const nh_ode_piece *piece, double s, bool derivative, arb_ptr out);

#endif
