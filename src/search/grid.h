/* grid: the sample points of the discrete problem, on the grid that the user chose (system/sample_grid.h).
 *
 *     sobol, halton   sequences in the box of the domain; velocities are moved onto the constraints
 *     tensor, sparse  nodes in the variables (t, q, w) on which the ansatz or the equations depend; the others, which
 *                     no equation contains, have values of Halton's sequence
 *     motion          states along motions that begin at Sobol points, as long as they stay in the domain
 *     file            the points of the user
 *
 * A grid with too few points, or whose points lie too specially (5 nodes do not see a polynomial of degree 5), has null
 * vectors that are no currents.  So the dimension of the null space is compared with that on Sobol points.  Without a
 * number from the user the grid grows until they agree; a number of the user is obeyed, or refused with the number with
 * which they do. */
#ifndef NH_SEARCH_GRID_H
#define NH_SEARCH_GRID_H

#include "integrals/ansatz.h"
#include "integrals/nullspace.h"
#include "search/analysis.h"

enum { NH_GRID_SPARE = 16 }; /* points beyond the number of columns that a fit needs */

/* The grid that a word of system/sample_grid.h names; NULL: it stays as it is.  A file of points has columns named t
 * (otherwise 0), the coordinates, and either the chart's velocities or those of all coordinates. */
bool nh_grid_choose(nh_arena *arena, const nh_model *model, const char *word, nh_grid *grid, nh_error *error);

/* Can an ansatz of so many columns be fitted with `wanted` points (0: as many as it needs) of the grid?  `ansatz` NULL:
 * it may depend on all variables.  False with a message, whose place is that of the user's number, and with
 * result->grid.needed. */
bool nh_grid_possible(nh_analysis *result, const nh_ansatz *ansatz, size_t columns, size_t wanted, nh_error *error);

/* The null space of the equations at points; NULL with a message. */
typedef nh_nullspace *nh_grid_solver(void *context, const nh_points *points, nh_error *error);

/* A null space on the grid of the question: with as many points as the user wants (`wanted`), otherwise (0) with as
 * many as it needs, `usual` or more.  Writes the report result->grid.  The caller frees both.  NULL with a message, as
 * above. */
nh_nullspace *nh_grid_solve(nh_analysis *result, const nh_ansatz *ansatz, size_t columns, size_t wanted, size_t usual,
                            uint64_t seed, nh_grid_solver *solve, void *context, nh_points **points, nh_error *error);

/* The points of the grid in the variables of the equations, `count` of them or a few more (of a file all), some of
 * which may be unusable.  NULL: there are none, with a message where the grid has too many variables. */
nh_points *nh_grid_points(const nh_model *model, const nh_options *options, const nh_grid *grid, size_t count,
                          uint64_t seed, nh_error *error);

#endif
