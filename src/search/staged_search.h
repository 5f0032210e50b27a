/* staged_search: an ansatz that grows in stages, for systems without an analysis file.
 *
 * Each stage is a list of families made of the system's own dictionary; its null space is searched for currents that do
 * not depend on those found before.  The search ends when as many independent currents are known as can exist locally,
 * when the stages are used up, or when the budget is. */
#ifndef NH_STAGED_SEARCH_H
#define NH_STAGED_SEARCH_H

#include "search/currents.h"

/* Fill result->found, result->stage, result->current (the spectrum of the last stage that found something, else of the
   largest). */
bool nh_staged_search_run(nh_analysis *result, nh_error *error);

/* The name of row i of the search, of which result->left_out leaves out some; NULL from the last one on. */
const char *nh_staged_search_row(size_t i);

#endif
