/* analysis_json: an analysis as JSON, schema version 1 (docs/formats.md). */
#ifndef NH_ANALYSIS_JSON_H
#define NH_ANALYSIS_JSON_H

#include "search/analysis.h"

/* A heap string that ends in a newline; the caller frees it by nh_free. */
char *nh_analysis_json(const nh_analysis *result);

#endif
