/* classification: the special values of one parameter or of two as text, and as JSON (docs/schema/classification.json). */
#ifndef NH_REPORT_CLASSIFICATION_H
#define NH_REPORT_CLASSIFICATION_H

#include "base/text.h"
#include "document/provenance.h"
#include "commands/classify.h"

void nh_classification_text(const nh_classified *classified, bool verbose, nh_text *out);
char *nh_classification_json(const nh_classified *classified, const nh_run *run);

void nh_classification_plane_text(const nh_classified_plane *classified, bool verbose, nh_text *out);
char *nh_classification_plane_json(const nh_classified_plane *classified, const nh_run *run);

#endif
