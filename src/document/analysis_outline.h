/* analysis_outline: the answer to `analyze` as a document, for page and LaTeX. */
#ifndef NH_ANALYSIS_OUTLINE_H
#define NH_ANALYSIS_OUTLINE_H

#include "document/pen.h"

/* fragment: LaTeX without preamble and end, to be read into another document by \input; its first lines say which
 * packages that document must load. */
void nh_analysis_write(const nh_analysis *result, nh_pen_style style, nh_text *out);

#endif
