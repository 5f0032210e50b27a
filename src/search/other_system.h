/* other_system: a system made from another one, in which the search is easier, and whose currents are currents of the
 * first in other words. */
#ifndef NH_OTHER_SYSTEM_H
#define NH_OTHER_SYSTEM_H

#include "search/analysis.h"

/* The search of a whole analysis. */
typedef bool nh_whole_search(nh_analysis *analysis, nh_error *error);

/* The same system, with room for so many more parameters and constraints; without known currents and robustness maps.
 * In the arena; all else is shared with the first. */
nh_system *nh_other_system_copy(nh_arena *arena, const nh_system *system, size_t parameters, size_t constraints);
/* A new parameter of it.  There must be room. */
void nh_other_system_parameter(nh_system *system, const char *name, nh_ex symbol, double value);

/* An analysis of such a system, with the options of the first, in its arena; nothing is found yet.  NULL: it has no
 * model. */
nh_analysis *nh_other_system_open(const nh_analysis *first, nh_system *system, nh_chart_choice choice);
void nh_other_system_close(nh_analysis *other);

#endif
