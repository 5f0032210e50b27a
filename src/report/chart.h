/* chart: a comparison of methods as text, JSON and a drawing. */
#ifndef NH_REPORT_CHART_H
#define NH_REPORT_CHART_H

#include "base/text.h"
#include "study/chart.h"

void nh_comparison_text(const nh_comparison *comparison, bool verbose, nh_text *out);
/* A heap string (nh_free). */
char *nh_comparison_json(const nh_comparison *comparison);
/* Time against error of every run, one line per method and formulation, with the front of the best: an SVG file on its own. */
void nh_comparison_svg(const nh_comparison *comparison, nh_text *out);

#endif
