/* benchmark: a comparison of methods as text, JSON, a page, LaTeX, a table and a drawing. */
#ifndef NH_DOCUMENT_BENCHMARK_H
#define NH_DOCUMENT_BENCHMARK_H

#include "base/text.h"
#include "document/pen.h"
#include "commands/robustness.h"

/* A heap string (nh_free); `maps` and `run` may be NULL. */
char *nh_benchmark_json(const nh_benchmark *comparison, const nh_robustness *maps, const nh_run *run);
void nh_benchmark_write(const nh_benchmark *comparison, const nh_robustness *maps, const nh_run *run,
                        nh_pen_style style, nh_text *out);
/* Every run as a row of comma-separated values; what is not there is empty. */
void nh_benchmark_csv(const nh_benchmark *comparison, nh_text *out);
/* The fastest of the runs from..to-1 whose error is below the goal, or NULL; `reduced`: runs in the equations of a
 * reduction count too, and those that are flagged. */
const nh_run_record *nh_benchmark_fastest(const nh_benchmark *comparison, size_t from, size_t to, double below,
                                          bool reduced);
/* Time against error of every run, one line per method and formulation, with the front of the best: an SVG file on its
   own. */
void nh_benchmark_svg(const nh_benchmark *comparison, nh_text *out);

#endif
