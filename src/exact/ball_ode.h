/* ball_ode: functions of one variable s, with many digits, for which a sum over words vanishes whatever the other
 * variables are:
 *
 *     sum_i ( f_i'(s) r b_i + f_i(s) c_i ) = 0,     b_i the words, c_i their rates, r the rate of s
 *
 * At one s, points of the others give linear equations B f' + R f = 0.  By least squares f' = M f, M = -(B^T B)^-1 B^T
 * R, and what is left of the equations, C f = (R + B M) f = 0, are conditions.  So f is the solution of a linear
 * differential equation whose initial value C and its consequences leave free: the space is found near one s, in an
 * interval over which M is a polynomial to as many digits as are wanted, and then continued, interval by interval, by
 * power series: f' = h M f in x = (s - centre)/h gives (k+1) f_(k+1) = h sum_j M_j f_(k-j).  Where M has a singularity
 * the intervals get shorter, so that their number is the logarithm of its distance. [Trefethen2013, ch. 8] */
#ifndef NH_BALL_ODE_H
#define NH_BALL_ODE_H

#include "exact/ball.h"

typedef struct nh_ball_ode nh_ball_ode;

/* Set the ball's symbols to the point `sample` of the others, at s; the same point for the same number.  False when
 * there is none. */
typedef bool nh_ball_ode_point(void *context, nh_ball *ball, double s, size_t sample);

typedef struct {
    size_t words;
    const nh_ex *value, *slope; /* b_i, c_i */
    nh_ex variable_slope;       /* r */
    nh_ball_ode_point *point;
    void *context;
    double digits; /* to which the solutions are wanted */
} nh_ball_ode_problem;

/* Bits that a ball needs for so many digits. */
long nh_ball_ode_bits(double digits);

/* Borrows the ball and what the problem points to. */
nh_ball_ode *nh_ball_ode_create(nh_ball *ball, const nh_ball_ode_problem *problem);
void nh_ball_ode_free(nh_ball_ode *ode);

/* The dimension of the space of solutions near `centre`, looked for in an interval of at most this half width. */
size_t nh_ball_ode_start(nh_ball_ode *ode, double centre, double half);
/* Words that are combinations of others with functions of s are left out: how many there are, and which. */
size_t nh_ball_ode_words(const nh_ball_ode *ode);
size_t nh_ball_ode_word(const nh_ball_ode *ode, size_t i);
/* How large word i is. */
double nh_ball_ode_size(const nh_ball_ode *ode, size_t i);
/* Half width of the first interval. */
double nh_ball_ode_half(const nh_ball_ode *ode);

/* Continue towards `end`, with steps not below `least`, and not more of them than a series of some hundred terms can
 * follow; returns how far it came. */
double nh_ball_ode_extend(nh_ball_ode *ode, double end, double least);

/* Other solutions of the same space: at s as many functions as can be are 1 for one of them and 0 for the others, the
 * first words' rather than the last. */
void nh_ball_ode_normalise(nh_ball_ode *ode, double s);

/* f_i of solution v at s: out[i + v * words]. */
void nh_ball_ode_value(const nh_ball_ode *ode, double s, double *out);
/* The Taylor coefficients of f_i at the first centre, to x^(terms-1), x = s - centre: out[k + terms * (i + v * words)].
 */
void nh_ball_ode_taylor(const nh_ball_ode *ode, size_t terms, double *out);

/* To how many digits the sum vanishes for solution v at that point, bounded rigorously for the functions as they were
 * found.  False where there is none. */
bool nh_ball_ode_residual(nh_ball_ode *ode, double s, size_t sample, double *digits);

#endif
