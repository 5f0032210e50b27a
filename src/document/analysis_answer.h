/* analysis_answer: the first screen of an analysis, for a terminal: what is conserved, by which symmetry, how sure, and
 * whether there can be more.  All else is in the document (document/analysis_outline.h). */
#ifndef NH_ANALYSIS_ANSWER_H
#define NH_ANALYSIS_ANSWER_H

#include "search/analysis.h"

/* At most 40 lines of 80 columns, unless the answer itself needs more. */
void nh_analysis_write_answer(const nh_analysis *result, bool colour, nh_text *out);

#endif
