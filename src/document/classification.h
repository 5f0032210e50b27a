/* classification: the special values of a parameter as text and as JSON (docs/schema/classification.json). */
#ifndef NH_REPORT_CLASSIFICATION_H
#define NH_REPORT_CLASSIFICATION_H

#include "base/text.h"
#include "document/provenance.h"
#include "commands/classify.h"

void nh_classification_text(const nh_classified *classified, bool verbose, nh_text *out);
char *nh_classification_json(const nh_classified *classified, const nh_run *run);

#endif
