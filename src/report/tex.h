/* tex: an analysis as a LaTeX document, for pdflatex or lualatex with amsmath. */
#ifndef NH_TEX_H
#define NH_TEX_H

#include "base/text.h"
#include "study/result.h"

void nh_tex(const nh_result *result, nh_text *out);

#endif
