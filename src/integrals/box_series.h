/* box_series: currents polynomial in the velocities whose coefficients are functions of several variables,
 * coordinates and perhaps t, without closed form:
 *
 *     Phi = sum_alpha f_alpha(s) w^alpha,     q^s' = rho^s(s, w),  w^i' = a^i(s, w),  polynomials in w:
 *     coefficient of w^beta in Gamma(Phi) = sum_alpha ( sum_j [w^(beta - alpha)] s_j' d f_alpha/d s_j
 *                                                       + [w^beta] Gamma(w^alpha) f_alpha ) = 0
 *
 * On a box the f_alpha are Chebyshev series in all variables up to a total degree.  At more points than there are
 * unknowns the equations are linear ones for the coefficients; their null vectors, which stand apart from the other
 * singular vectors, are the currents.  What they are worth is bounded afterwards [ball_box.h]. */
#ifndef NH_BOX_SERIES_H
#define NH_BOX_SERIES_H

#include "exact/ball_box.h"
#include "geometry/model.h"
#include "integrals/points.h"

typedef struct {
    const nh_model *model;
    size_t degree;
    bool split; /* only |alpha| = degree modulo 2: Gamma changes this parity */
    size_t words;
    nh_ex *word;                /* w^alpha, the highest |alpha| first */
    unsigned char *exponent;    /* words x n */
    nh_box_equations equations; /* with the parameters at their values */
} nh_box_series;

/* In the arena.  NULL where the equations for functions of these variables contain others, or are not polynomial in
 * the velocities of degree two (one for q'), or are very long. */
nh_box_series *nh_box_series_create(const nh_model *model, size_t variables, const nh_ex *variable, size_t degree,
                                    nh_arena *arena);

/* The coordinates on which the equations of motion depend, and those on which their rates do, and so on, and t where
 * it occurs: their number, into out when there are NH_BOX_VARIABLES at most. */
size_t nh_box_series_shape(const nh_model *model, nh_ex out[NH_BOX_VARIABLES]);

/* The largest total degree that is worth its work for so many words. */
size_t nh_box_series_degree(const nh_box_series *series, size_t most_columns);

/* The solutions on this box.  Each has 1 as the value at the centre of a function, or of a derivative in units of the
 * box, at which the others have 0, values before derivatives.  In the arena; count is 0 where no space stands apart. */
nh_box_functions nh_box_series_solve(const nh_box_series *series, const double *low, const double *high, size_t degree,
                                     nh_arena *arena);

/* Points of the submanifold over the box. */
nh_points *nh_box_series_points(const nh_box_series *series, const nh_box_functions *functions, size_t count,
                                uint64_t seed);

/* The word whose value solution k has at the centre of the box, its function being 1 there and the others 0; `words`:
   there is none. */
size_t nh_box_series_alone(const nh_box_series *series, const nh_box_functions *functions, size_t k);

/* Solution k as an expression: T_k(u) = cos(k acos u), real on the box alone. */
nh_ex nh_box_series_expression(const nh_box_series *series, const nh_box_functions *functions, size_t k);

#endif
