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

/* "t = 0 to 10. Reference: .., which .. confirms to 4e-13: the grey band." */
void nh_benchmark_put_reference(const nh_benchmark *comparison, nh_text *out);
const char *nh_benchmark_order_why(const nh_benchmark_order *order); /* "because ..", or "" */

/* For the discrete problem: */
const char *nh_fitted_word(const nh_fitted *fitted); /* "accurate", "too few", ...; in JSON the first is "right" */

/* Work against error, as plots that belong together: seconds and evaluations of motions; seconds, points and functions
 * of the discrete problem. */
enum { NH_BENCHMARK_PANELS = 3, NH_BENCHMARK_CURVES = 6, NH_BENCHMARK_ROWS = 4 };
typedef struct {
    const char *title, *caption;
    bool fit;              /* of the discrete problem */
    size_t panels, others; /* others: the number of curves that are shown by faint points only */
    nh_plot panel[NH_BENCHMARK_PANELS];
} nh_benchmark_row;
/* Returns their number; they live in the arena. */
size_t nh_benchmark_rows(const nh_benchmark *comparison, nh_arena *arena, nh_benchmark_row out[NH_BENCHMARK_ROWS]);

/* The section "Where methods fail"; robustness NULL: nothing. */
void nh_benchmark_write_robustness(nh_pen *pen, const nh_robustness *robustness);

/* The first screen; `maps` may be NULL. */
void nh_benchmark_write_answer(const nh_benchmark *comparison, const nh_robustness *maps, bool colour, nh_text *out);

#endif
