/* sectors: a large ansatz, split into parts that Gamma cannot mix.
 *
 * Under a reflection that the equations of motion have, most columns are odd or even; the null space is the direct sum
 * of those of the columns of equal parity.  Generators for which a column is neither are replaced by products of two,
 * or not used.  Parities are read off numerically. */
#ifndef NH_SECTORS_H
#define NH_SECTORS_H

#include "integrals/nullspace.h"
#include "integrals/reflection.h"
#include "integrals/rows.h"

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

/* The null space of the current route, sector by sector on up to `threads` threads; the result does not depend on their
 * number. Columns that are not finite at some point are left out. */
nh_nullspace *nh_sectors_solve(const nh_model *model, const nh_ansatz *ansatz, const nh_sectors *sectors,
                               const nh_points *points, const nh_nullspace_options *options, size_t threads,
                               nh_error *error);

#endif
