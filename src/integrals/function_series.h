/* function_series: currents whose coefficients are functions of one variable s, a coordinate or t:
 *
 *     Phi = sum_i f_i(s) b_i,     Gamma(Phi) = sum_i ( f_i' Gamma(s) b_i + f_i Gamma(b_i) ) = 0
 *
 * on the whole submanifold.  The words b_i are functions of the rest (and of s).  The f_i are found with many digits
 * [ball_ode.h] in an interval of s and given there as Chebyshev series in doubles; beyond the interval they say
 * nothing. */
#ifndef NH_FUNCTION_SERIES_H
#define NH_FUNCTION_SERIES_H

#include "base/option.h"
#include "geometry/model.h"
#include "integrals/points.h"

typedef struct nh_series_search nh_series_search;

/* The space of such currents near the middle of the sampling interval of `variable`. */
nh_series_search *nh_series_open(const nh_model *model, nh_ex variable, size_t words, const nh_ex *word,
                                 const nh_options *options);
void nh_series_close(nh_series_search *search);
/* Its dimension, and the words that occur in it. */
size_t nh_series_count(const nh_series_search *search);
size_t nh_series_words(const nh_series_search *search);

/* Near the middle alone: current k as a polynomial in the variable, and `count` points at which that is one to
 * rounding.  NULL: there are none. */
nh_ex nh_series_near(const nh_series_search *search, size_t k);
nh_points *nh_series_points(const nh_series_search *search, size_t count);

/* The same space on the sampling interval, or on the largest part of it for which series up to the option
 * `series_degree` suffice. */
typedef struct {
    double low, high;
    size_t words, count, degree;
    nh_ex *word;
    double *size;        /* of each word: coefficients are compared after multiplication by it */
    double *coefficient; /* of T_j((2 s - low - high)/(high - low)) in f_i of current k: [(k * words + i) * (degree + 1)
                            + j] */
    /* the point at which the functions are simplest: there each of certain words has coefficient 1 in one current and 0
     * in the others */
    double at;
    size_t *alone; /* per current: this word; `words` where there is none */
    /* per current: the digits to which its rate cancels, with more digits in the coefficients than doubles have */
    double *digits;
} nh_series_space;

/* As far as `beyond` where that is more.  In the arena.  False when the space could not be continued. */
bool nh_series_extend(nh_series_search *search, double beyond, nh_arena *arena, nh_series_space *out);

/* (2 s - low - high)/(high - low), and T_0..T_degree of it, as expressions. */
void nh_series_polynomials(nh_dag *dag, nh_ex variable, double low, double high, size_t degree, nh_ex *T);

#endif
