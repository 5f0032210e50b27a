/* analyze: from a system and a question to currents, symmetries and their validation.
 *
 *     system -> model -> points -> (unknowns) -> rows -> null space -> echelon -> currents -> motion -> result */
#ifndef NH_ANALYZE_H
#define NH_ANALYZE_H

#include "commands/choice.h"
#include "commands/request.h"
#include "search/analysis.h"

/* Runs an analysis; the caller frees the result.  NULL with a message when nothing can be said; otherwise a result,
 * perhaps partial, with warnings. */
nh_analysis *nh_analysis_create(const nh_request *request, nh_error *error);

#endif
