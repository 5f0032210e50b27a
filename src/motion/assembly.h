/* assembly: positions that satisfy the equations between positions: closed loops, and wheels that touch their surface.
 *
 * The equations of motion contain the derivatives of e(t, q) = 0 alone.  The nearest position to q0 in the metric K of
 * the kinetic energy at q0 minimises (q - q0)^T K (q - q0) on e = 0: Newton's method of least norm finds a position,
 * and
 *
 *     q <- q0 + K^-1 J^T (J K^-1 J^T)^+ (J (q - q0) - e),   J = de/dq,
 *
 * moves it to the nearest one, a projection as in [HairerLubichWanner2006, sec. IV.4].  Where J is singular at q0, as
 * in a straight linkage, it begins beside q0; far from e = 0 the second iteration may not converge, and the position is
 * near, not nearest. */
#ifndef NH_ASSEMBLY_H
#define NH_ASSEMBLY_H

#include "geometry/model.h"

typedef struct nh_assembly nh_assembly;

/* The equations of a model, which it borrows; NULL where there are none. */
nh_assembly *nh_assembly_create(const nh_model *model);
void nh_assembly_free(nh_assembly *assembly);

/* The first equation that q (m values) does not satisfy, in words, or NULL; its value, and about how far q is from
 * where it vanishes. e counts as zero relative to its terms, or to its change by a small part of each coordinate. */
const char *nh_assembly_violated(nh_assembly *assembly, double t, const double *q, double *value, double *distance);

/* Moves q to the nearest position that satisfies all equations; coordinates that are `held` (m flags; NULL: none) do
 * not move.  False where none was found; q is then as before. */
bool nh_assembly_move(nh_assembly *assembly, double t, const bool *held, double *q);

#endif
