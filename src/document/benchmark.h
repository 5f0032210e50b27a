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
/* Every run as a row of comma-separated values; a missing value is an empty field. */
void nh_benchmark_csv(const nh_benchmark *comparison, nh_text *out);
/* The fastest of the runs from..to-1 whose error is below the goal, or NULL; `reduced`: runs of reduced equations count
 * too, and flagged ones. */
const nh_run_record *nh_benchmark_fastest(const nh_benchmark *comparison, size_t from, size_t to, double below,
                                          bool reduced);
/* A sentence for each observed order that is not as expected, at most so many, and how many more there are; false:
 * none. */
bool nh_benchmark_put_orders(const nh_benchmark *comparison, size_t most, nh_text *out);
/* A stand-alone SVG file: work against error of motions, of reduced equations and of the discrete problem, each as plots
 * of at most six methods with the front of the best runs. */
void nh_benchmark_svg(const nh_benchmark *comparison, nh_text *out);

#endif
