/* space: at which values of three parameters does a system have more integrals polynomial in the velocities than for
 * almost all?
 *
 * In a plane nu = constant the system has two parameters (plane.h). There, modulo a prime, the curves that are special
 * are sections of special surfaces, and isolated points have their mu among the roots of a polynomial: the section of a
 * *wall*, a cylinder over a curve in mu and nu. Both are polynomials in nu too, found from sections at several nu
 * (special_surfaces.h), lifted from several primes and factored. The integrals are counted on each surface.
 *
 * Curves and points of three parameters lie on surfaces, on walls, or in planes nu = constant.  Planes nu = a/b up to a
 * height are examined for anything special besides sections of surfaces and walls.  Inside of a surface, a wall or a
 * plane the question has two parameters.
 *
 * What is proved: in a plane that was looked at, a point that is special has, modulo each of the primes, residues on
 * one of the surfaces or walls, or no residues. A pair of rationals up to a `height` lies on one of them then. Nothing
 * is said about other nu. */
#ifndef NH_SPACE_H
#define NH_SPACE_H

#include "classify/plane.h"
#include "classify/special_surfaces.h"

typedef struct {
    size_t rows, surfaces, walls, planes, surface_capacity, wall_capacity, plane_capacity;
    nh_plane_row row[NH_COUNT_HIGHEST_DEGREE]; /* of degrees 1, 2, .. */
    nh_plane_curve *surface; /* special and degenerate ones, and ones on which A loses rank although there are not
                              * more integrals */
    nh_special_surface *wall;
    nh_special_surface *plane;  /* planes nu = a/b in which something else may be special */
    const char *obstacle, *end; /* as in nh_classification */
} nh_space;

/* `parameter` is lambda, `second` mu, `third` nu. */
nh_space *nh_space_classify(const nh_model *model, const nh_classify_question *question);
void nh_space_free(nh_space *space);

#endif
