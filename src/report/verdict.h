/* verdict: the answer to `verify` as text and as JSON (schema version 1, docs/formats.md). */
#ifndef NH_VERDICT_REPORT_H
#define NH_VERDICT_REPORT_H

#include "base/text.h"
#include "report/run.h"
#include "study/verify.h"

void nh_verdict_text(const nh_verdict_of_one *verdict, bool field, double shown, nh_text *out);
/* A heap string (nh_free), ending in a newline; `run` may be NULL. */
char *nh_verdict_json(const nh_verdict_of_one *verdict, const nh_run *run);

#endif
