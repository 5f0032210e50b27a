/* analysis_answer: the first screen of an analysis, for a terminal: what is conserved, by which symmetry, how sure, and
 * whether there can be more.  All else is in the document (document/analysis_outline.h). */
#ifndef NH_ANALYSIS_ANSWER_H
#define NH_ANALYSIS_ANSWER_H

#include "search/analysis.h"

/* At most 40 lines of 80 columns, unless the answer itself needs more. */
void nh_analysis_write_answer(const nh_analysis *result, bool colour, nh_text *out);

/* ---- for other first screens ---- */

/* "All 5 conserved quantities that can exist were found and proved." */
void nh_analysis_answer_headline(const nh_analysis *result, nh_text *out);
/* Can there be more?  Adds nothing where the headline says that there cannot. */
void nh_analysis_answer_completeness(const nh_analysis *result, nh_text *out);

/* ---- of one quantity ---- */

/* With its sign as readers know it: E and not -E. */
nh_ex nh_analysis_answer_shown(const nh_analysis *result, const nh_current *found);
/* How sure it is: of a proved one " for all m, k" or "", after "proved"; of another one a sentence without its end. */
const char *nh_analysis_answer_proof(const nh_analysis *result, const nh_current *found);

#endif
