/* benchmark: a comparison of methods as text, JSON and a drawing. */
#ifndef NH_REPORT_CHART_H
#define NH_REPORT_CHART_H

#include "base/text.h"
#include "document/provenance.h"
#include "commands/robustness.h"

void nh_comparison_text(const nh_comparison *comparison, bool verbose, nh_text *out);
/* A heap string (nh_free); `stress` and `run` may be NULL. */
char *nh_comparison_json(const nh_comparison *comparison, const nh_stress *stress, const nh_run *run);
/* The fastest of the runs from..to-1 whose error is below the goal, or NULL; `reduced`: runs in the equations of a reduction
 * count too, and those that a guard complains about. */
const nh_measured *nh_comparison_fastest(const nh_comparison *comparison, size_t from, size_t to, double below, bool reduced);
void nh_stress_text(const nh_stress *stress, bool verbose, nh_text *out);
/* Time against error of every run, one line per method and formulation, with the front of the best: an SVG file on its own. */
void nh_comparison_svg(const nh_comparison *comparison, nh_text *out);

#endif
