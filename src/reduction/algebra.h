/* algebra: a finite-dimensional real Lie algebra by its structure constants.
 *
 *     [e_a, e_b] = C_ab^k e_k,     C_ab^k = c[(a*d + b)*d + k]
 *
 * The constants may be given in any basis.  Subspaces are orthonormal columns, d x dimension.  `small`: the threshold
 * for zero, relative to the largest constant. */
#ifndef NH_ALGEBRA_H
#define NH_ALGEBRA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

enum { NH_MOST_SERIES = 12 };

typedef struct {
    size_t d;
    double *c; /* d x d x d */
} nh_algebra;

/* Abelian: all structure constants are zero.  The caller clears it. */
nh_algebra nh_algebra_create(size_t d);
void nh_algebra_clear(nh_algebra *algebra);

/* [x, y] of two vectors of d numbers; out must not be one of them. */
void nh_algebra_bracket(const nh_algebra *algebra, const double *x, const double *y, double *out);
/* ad_x as a matrix: [x, y] = ad_x y (d x d, column-major). */
void nh_algebra_ad(const nh_algebra *algebra, const double *x, double *out);
/* (ad*_x mu)_b = C_ab^k x^a mu_k. */
void nh_algebra_coad(const nh_algebra *algebra, const double *x, const double *mu, double *out);

/* The same algebra in the basis f_j = sum_i t[i + j*d] e_i, or the subalgebra that r < d such vectors span; *off (may
 * be NULL): the distance of brackets from the span. */
nh_algebra nh_algebra_change(const nh_algebra *algebra, size_t r, const double *t, double *off);

/* d factors t such that the constants in the basis t_a e_a are as close to 1 in modulus as they can be, in the sense of
 * least squares of their logarithms: then none is small because of a unit. */
void nh_algebra_balance(const nh_algebra *algebra, double *t);

/* The centre, and the span of all brackets [u, w] of two subspaces; out is d x d; return the dimension. */
size_t nh_algebra_centre(const nh_algebra *algebra, double small, double *out);
size_t nh_algebra_brackets(const nh_algebra *algebra, size_t r, const double *u, size_t s, const double *w,
                           double small, double *out);
/* [g, g], and the radical; out is d x d; return the dimension. */
size_t nh_algebra_derived(const nh_algebra *algebra, double small, double *out);
size_t nh_algebra_radical(const nh_algebra *algebra, double small, double *out);
/* k_ij = C_ia^b C_jb^a. */
void nh_algebra_killing(const nh_algebra *algebra, double *out);
/* The distance of [e_a, x] from the span of r vectors x (0: an ideal). */
double nh_algebra_ideal(const nh_algebra *algebra, size_t r, const double *u);

typedef enum {
    NH_R,
    NH_SO3,
    NH_SL2R,
    NH_SE2,
    NH_E11,
    NH_HEISENBERG,
    NH_AFF1,
    NH_SE3,
    NH_BIANCHI4, /* the rest acts on the plane [g,g] by one eigenvalue and a Jordan block; V: as a multiple of 1 */
    NH_BIANCHI5,
    NH_BIANCHI6, /* with two real eigenvalues; VII: complex ones, with real parts */
    NH_BIANCHI7,
    NH_NIL_SO2, /* Heisenberg's algebra and its turns; its boosts */
    NH_NIL_SO11,
    NH_SO31,
    NH_SL3R,
    NH_SU21,
    NH_SU3,
    NH_SO5,
    NH_SO41,
    NH_SO32,
    NH_SO6,
    NH_SO51,
    NH_SO42,
    NH_SL4R,
    NH_SU31,
    NH_E21,
    NH_SE4,
    NH_ISO31, /* Poincare's */
    NH_OTHER_ALGEBRA
} nh_algebra_kind;

typedef struct {
    nh_algebra_kind kind;
    size_t dimension;
    double *basis; /* d x dimension, in the given basis */
} nh_algebra_piece;

/* What is known about an algebra: the dimensions of its series, and its indecomposable ideals, the largest first. */
typedef struct {
    size_t d, centre, radical, derived_length, lower_length, pieces;
    size_t derived[NH_MOST_SERIES], lower[NH_MOST_SERIES]; /* dimensions: g, [g,g], ... until they stay */
    nh_algebra_piece *piece;
} nh_algebra_report;

/* `cluster`: eigenvalues of a random element of the centroid whose distance is less than this part of the spectral
 * radius belong together; an algebra of more than `most` dimensions is not split. */
void nh_algebra_report_init(nh_algebra_report *report, const nh_algebra *algebra, double small, double cluster,
                            size_t most, uint64_t seed);
void nh_algebra_report_clear(nh_algebra_report *report);
/* "SE(2) x SO(2)^3"; closed[i]: the one-dimensional piece i is a circle (NULL: none is). */
void nh_algebra_name(const nh_algebra_report *report, const bool *closed, nh_text *out);

/* The kind of an indecomposable algebra. */
nh_algebra_kind nh_algebra_kind_of(const nh_algebra *algebra, double small, uint64_t seed);

#endif
