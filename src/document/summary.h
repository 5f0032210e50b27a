/* summary: the short report on a terminal. */
#ifndef NH_SUMMARY_H
#define NH_SUMMARY_H

#include "base/text.h"
#include "search/analysis.h"

typedef struct {
    bool colour, verbose;
} nh_summary_style;

void nh_summary(const nh_analysis *result, nh_summary_style style, nh_text *out);

#endif
