/* analysis_outline_internal: the sections of the document. */
#ifndef NH_ANALYSIS_OUTLINE_INTERNAL_H
#define NH_ANALYSIS_OUTLINE_INTERNAL_H

#include "document/analysis_outline.h"

void nh_analysis_write_meaning(nh_pen *pen, const nh_analysis *result,
                               const char *meaning); /* "momentum of phi", with the letter */
void nh_analysis_write_currents(nh_pen *pen, const nh_analysis *result);
void nh_analysis_write_series(nh_pen *pen, const nh_analysis *result, const nh_current *current);
void nh_analysis_write_motion(nh_pen *pen, const nh_analysis *result);
void nh_analysis_write_figures(nh_pen *pen, const nh_analysis *result);
void nh_analysis_write_search(nh_pen *pen, const nh_analysis *result);

#endif
