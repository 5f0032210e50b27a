/* plane: at which values of two parameters does a system have more integrals polynomial in the velocities than for
 * almost all?
 *
 * As classify.h, for the linear system A(lambda, mu). Its rank is lower on curves and at isolated points: common zeros
 * of the determinants of compressions at three points of the configuration space (compression.h, common_curves.h).
 * Curves are lifted from several primes (special_curves.h) and the integrals are counted on each. Isolated points have
 * their mu among the roots of a polynomial, which is lifted too; on every line with a rational one of these the system
 * has one parameter, lambda, and is classified (classify.h).
 *
 * What is proved: a point that is special has, modulo each of the primes, residues on one of the curves or lines, or no
 * residues.  A pair of rationals up to a `height` lies on one of them then.  Random choices affect only how many lines
 * are examined in vain. */
#ifndef NH_PLANE_H
#define NH_PLANE_H

#include "classify/classify.h"
#include "classify/special_curves.h"

/* A curve, or a surface of three parameters (space.h). */
typedef struct {
    nh_special_surface polynomial;
    bool degenerate;
    size_t first, open; /* as in nh_classify_value */
    nh_classify_number number[NH_COUNT_HIGHEST_DEGREE + 1];
} nh_plane_curve;

/* A line mu = constant, whose value is a root of the polynomial. */
typedef struct {
    nh_special_factor across;
    /* its classification over lambda; NULL: mu is irrational, the line is a curve, or the run was ended */
    nh_classification *line;
} nh_plane_line;

typedef struct {
    nh_classify_number number; /* for almost all values */
    size_t known, unknowns;
    size_t power[2]; /* degrees of the linear system in lambda and mu */
    size_t size;     /* degrees of the determinants */
    bool lifted;
    size_t primes;
    uint64_t prime[NH_CLASSIFY_MOST_PRIMES];
    /* height up to which all pairs of rationals are covered; 0: curves of this or a lower degree are not lifted */
    double height;
    /* number of lines that were examined instead of determinants (plane_sweep.h); 0: determinants were used */
    size_t swept;
    /* of three parameters: sections from which the surfaces were found, and planes that were examined; `height` then
     * covers pairs in the planes in which nothing more was seen */
    size_t sections, planes;
} nh_plane_row;

/* A point that has more integrals than almost all points, and than almost all points of a curve on which it lies. */
typedef struct {
    size_t line, value; /* one of the values that the classification of a line found */
} nh_plane_point;

typedef struct {
    size_t rows, curves, lines, points, curve_capacity, line_capacity, point_capacity;
    nh_plane_row row[NH_COUNT_HIGHEST_DEGREE]; /* of degrees 1, 2, .. */
    /* special and degenerate curves, and curves on which A loses rank although there are not more integrals */
    nh_plane_curve *curve;
    nh_plane_line *line;
    nh_plane_point *point;
    const char *obstacle, *end; /* as in nh_classification */
} nh_plane;

/* `parameter` is lambda, `second` mu. */
nh_plane *nh_plane_classify(const nh_model *model, const nh_classify_question *question);
void nh_plane_free(nh_plane *plane);

#endif
