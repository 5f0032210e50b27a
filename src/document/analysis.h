/* analysis: an analysis as a document, as its first screen, as JSON, and as the top of a page. */
#ifndef NH_DOCUMENT_ANALYSIS_H
#define NH_DOCUMENT_ANALYSIS_H

#include "document/pen.h"
#include "document/provenance.h"
#include "document/stage.h"
#include "search/analysis.h"

/* fragment: LaTeX without preamble and end, to be read into another document by \input; its first lines say which
 * packages that document must load. */
void nh_analysis_write(const nh_analysis *result, nh_pen_style style, nh_text *out);

/* A heap string that ends in a newline; the caller frees it by nh_free. */
char *nh_analysis_json(const nh_analysis *result);

/* NULL where there is no motion.  nh_stage_free. */
nh_stage *nh_analysis_stage(const nh_analysis *result, const nh_run *run);

/* ---- the first screen, for a terminal: what is conserved, by which symmetry, how sure, can there be more? ---- */

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

#endif
