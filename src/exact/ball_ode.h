/* ball_ode: functions of one variable s, with many digits, for which a sum over words vanishes whatever the other
 * variables are:
 *
 *     sum_i ( f_i'(s) r b_i + f_i(s) c_i ) = 0,     b_i the words, c_i their rates, r the rate of s
 *
 * At one s, points of the other variables give linear equations B f' + R f = 0.  By least squares f' = M f, M = -(B^T
 * B)^-1 B^T R, and the remainder C f = (R + B M) f = 0 gives conditions.  So f solves a linear differential equation
 * with an initial value that satisfies these conditions and their consequences: the space is found near one s, in an
 * interval over which M is a polynomial to as many digits as are wanted, and then continued, interval by interval, by
 * power series: f' = h M f in x = (s - centre)/h gives (k+1) f_(k+1) = h sum_j M_j f_(k-j).  Where M has a singularity
 * the intervals get shorter, so that their number is the logarithm of its distance.  [Trefethen2013, ch. 8] */
#ifndef NH_BALL_ODE_H
#define NH_BALL_ODE_H

#include "exact/ball.h"

typedef struct nh_ball_ode nh_ball_ode;

/* Sets the ball's symbols to the point `sample` of the other variables, at s; the same number gives the same point.
 * False when there is none. */
typedef bool nh_ball_ode_point(void *context, nh_ball *ball, double s, size_t sample);

typedef struct {
    size_t words;
    const nh_ex *value, *slope; /* b_i, c_i */
    nh_ex variable_slope;       /* r */
    nh_ball_ode_point *point;
    void *context;
    double digits; /* digits of the solutions */
} nh_ball_ode_problem;

/* Bits that a ball needs for so many digits. */
long nh_ball_ode_bits(double digits);

/* Borrows the ball and what the problem points to. */
nh_ball_ode *nh_ball_ode_create(nh_ball *ball, const nh_ball_ode_problem *problem);
void nh_ball_ode_free(nh_ball_ode *ode);

/* The dimension of the space of solutions near `centre`, searched in an interval of at most this half width. */
size_t nh_ball_ode_start(nh_ball_ode *ode, double centre, double half);
/* Words that are combinations of others with functions of s as coefficients are left out: how many there are, and
 * which. */
size_t nh_ball_ode_words(const nh_ball_ode *ode);
size_t nh_ball_ode_word(const nh_ball_ode *ode, size_t i);
/* The size of word i. */
double nh_ball_ode_size(const nh_ball_ode *ode, size_t i);
/* Half width of the first interval. */
double nh_ball_ode_half(const nh_ball_ode *ode);

/* Continues towards `end`, with steps of at least `least` and at most as many as a series of some hundred terms can
 * bridge; returns the s that was reached. */
double nh_ball_ode_extend(nh_ball_ode *ode, double end, double least);

/* Chooses another basis of the same space: at s as many functions as possible are 1 for one solution and 0 for the
 * others, those of the first words before those of the last. */
void nh_ball_ode_normalise(nh_ball_ode *ode, double s);

/* f_i of solution v at s: out[i + v * words]. */
void nh_ball_ode_value(const nh_ball_ode *ode, double s, double *out);
/* The Taylor coefficients of f_i at the first centre, to x^(terms-1), x = s - centre: out[k + terms * (i + v * words)].
 */
void nh_ball_ode_taylor(const nh_ball_ode *ode, size_t terms, double *out);

/* The number of digits to which the sum vanishes for solution v at that point, bounded rigorously for the functions as
 * they were found.  False where the point has no value. */
bool nh_ball_ode_residual(nh_ball_ode *ode, double s, size_t sample, double *digits);

#endif
