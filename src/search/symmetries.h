/* symmetries: the constraint symmetry of every current that was found, and of every piece. */
#ifndef NH_SYMMETRIES_H
#define NH_SYMMETRIES_H

#include "search/analysis.h"

/* Fills in `has_symmetry` and `symmetry`, on several threads; the result does not depend on their number.  A symmetry
 * that cannot be computed is a warning. */
void nh_symmetries_find(nh_analysis *result);

#endif
