/* benchmark_internal: parts of the report of a benchmark. */
#ifndef NH_DOCUMENT_BENCHMARK_INTERNAL_H
#define NH_DOCUMENT_BENCHMARK_INTERNAL_H

#include "commands/robustness.h"
#include "document/pen.h"

/* The remarks about the reference, at most so many sentences. */
enum { NH_BENCHMARK_WARNINGS = 2 };
size_t nh_benchmark_warnings(const nh_benchmark *comparison, const char *out[NH_BENCHMARK_WARNINGS]);

const char *nh_run_record_set_by(const nh_run_record *record); /* "tolerance", "step" */
double nh_run_record_set_to(const nh_run_record *record);

/* For each of these errors the fastest run with a smaller error is named. */
enum { NH_BENCHMARK_GOALS = 4 };
extern const double nh_benchmark_goal[NH_BENCHMARK_GOALS];

/* For the discrete problem: */
const char *nh_fitted_word(const nh_fitted *fitted); /* "accurate", "too few", ...; in JSON the first is "right" */

/* The section "Where methods fail"; robustness NULL: nothing. */
void nh_benchmark_write_robustness(nh_pen *pen, const nh_robustness *robustness);

/* The first screen; `maps` may be NULL. */
void nh_benchmark_write_answer(const nh_benchmark *comparison, const nh_robustness *maps, bool colour, nh_text *out);

#endif
