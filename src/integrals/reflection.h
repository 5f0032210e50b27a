/* reflection: discrete symmetries of the equations of motion that change signs.
 *
 *     S: t -> e_0 t,  q^s -> e_s q^s (+ pi for an angle),  w^i -> f_i w^i,       e, f = +1 or -1
 *
 * is a symmetry when rho^s(Sz) = e_0 e_s rho^s(z) and a^i(Sz) = e_0 f_i a^i(z): then Gamma is carried to e_0 Gamma, so
 * that Phi o S is a current when Phi is, and the odd and the even part of every current are currents.  Found by trying
 * at random points: nothing is symbolic. */
#ifndef NH_REFLECTION_H
#define NH_REFLECTION_H

#include "integrals/field_rows.h"
#include "integrals/nullspace.h"
#include "integrals/points.h"
#include "integrals/rows.h"

typedef struct {
    signed char *sign; /* per coordinate of a point (t, q, w, u) */
    double *shift;     /* added after the sign: 0, or pi */
} nh_reflection;

typedef struct {
    nh_arena *arena;
    size_t count, width; /* count: generators, each of order two up to whole turns */
    nh_reflection *generator;
} nh_reflections;

/* Generators of the group of all such symmetries; none for systems with too many coordinates to try. */
nh_reflections *nh_reflections_find(const nh_model *model, const nh_points *points);
void nh_reflections_free(nh_reflections *reflections);

void nh_reflect(const nh_reflection *reflection, size_t width, const double *z, double *out);
/* first after second */
nh_reflection nh_reflections_product(const nh_reflections *reflections, const nh_reflection *first,
                                     const nh_reflection *second);

/* A large ansatz, split into parts that Gamma cannot mix.
 *
 * Under a reflection that the equations of motion have, most columns are odd or even; the null space is the direct sum
 * of those of the columns of equal parity.  Generators for which a column is neither are replaced by products of two,
 * or not used.  Parities are read off numerically. */

typedef struct {
    size_t count, largest; /* sectors; columns in the largest */
    /* count + 1: the columns of sector s are first[s] .. first[s+1]-1 of the ansatz, which has been put in that
       order */
    size_t *first;
} nh_sectors;

/* Sorts the ansatz by sector. */
nh_sectors nh_sectors_split(const nh_model *model, const nh_reflections *reflections, const nh_points *points,
                            nh_ansatz *ansatz);
void nh_sectors_clear(nh_sectors *sectors);

/* The null space of the equations of fields, or of currents where `fields` is NULL, sector by sector on up to `threads`
 * threads; the result does not depend on their number. Columns that are not finite at some point are left out. */
nh_nullspace *nh_sectors_solve(const nh_model *model, const nh_ansatz *ansatz, const nh_sectors *sectors,
                               const nh_field_bases *fields, const nh_points *points,
                               const nh_nullspace_options *options, size_t threads, nh_error *error);

#endif
