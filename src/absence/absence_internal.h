/* absence_internal: the parts of absence.c. */
#ifndef NH_ABSENCE_INTERNAL_H
#define NH_ABSENCE_INTERNAL_H

#include "absence/absence.h"
#include "search/analysis.h"

/* The integrals of the list that are exactly proved, contain letters of the shape only and are single-valued: into
 * absence->known_current, known, many_valued, and as expressions. */
nh_known_integrals nh_absence_known(const nh_analysis *analysis, nh_absence *absence);

/* What the engines say of an equation, which has no obstacle; without the monodromy for a reason, or NULL.  False: the
 * computation was ended, and nothing is said. */
bool nh_absence_attempt_run(nh_arena *arena, const nh_closed_shape *shape, nh_absence_attempt *attempt, bool everything,
                            const char *without_monodromy);

#endif
