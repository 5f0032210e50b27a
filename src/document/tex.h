/* tex: an analysis as a LaTeX document, for pdflatex or lualatex with amsmath and pgfplots.
 *
 * Formulas are paragraphs of mathematics, which TeX breaks by its own measures between the pieces of nh_typeset_pieces; every number stands in
 * \nhnumber{all its digits}{as shown}, as the JSON has it; plots hold their data. */
#ifndef NH_TEX_H
#define NH_TEX_H

#include "base/text.h"
#include "commands/reduce.h"
#include "document/provenance.h"
#include "search/analysis.h"

/* fragment: without the lines before and after the body, to be read into another document by \input; its head says what that must load. */
void nh_tex(const nh_analysis *result, bool fragment, nh_text *out);

#endif
