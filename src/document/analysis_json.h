/* result_json: an analysis as JSON, schema version 1 (docs/formats.md). */
#ifndef NH_RESULT_JSON_H
#define NH_RESULT_JSON_H

#include "study/result.h"

/* A heap string (nh_free), ending in a newline. */
char *nh_result_json(const nh_result *result);

#endif
