/* classification: the special values of one, two or three parameters as a document, and as JSON
 * (docs/schema/classification.json). */
#ifndef NH_REPORT_CLASSIFICATION_H
#define NH_REPORT_CLASSIFICATION_H

#include "base/text.h"
#include "document/pen.h"
#include "commands/classify.h"
#include "commands/classify_absence.h"

char *nh_classification_json(const nh_classified *classified, const nh_run *run);
void nh_classification_write(const nh_classified *classified, const nh_run *run, nh_pen_style style, nh_text *out);

/* The same of the question for which values of a parameter there may be another integral. */
char *nh_classification_absence_json(const nh_classified_absence *classified, const nh_run *run);
void nh_classification_absence_write(const nh_classified_absence *classified, const nh_run *run, nh_pen_style style,
                                     nh_text *out);

#endif
