/* classification: the special values of one, two or three parameters as a document, and as JSON
 * (docs/schema/classification.json). */
#ifndef NH_REPORT_CLASSIFICATION_H
#define NH_REPORT_CLASSIFICATION_H

#include "base/text.h"
#include "document/pen.h"
#include "commands/classify.h"

char *nh_classification_json(const nh_classified *classified, const nh_run *run);
char *nh_classification_plane_json(const nh_classified_plane *classified, const nh_run *run);
char *nh_classification_space_json(const nh_classified_space *classified, const nh_run *run);

/* Exactly one of the three is not NULL. */
void nh_classification_write(const nh_classified *line, const nh_classified_plane *plane,
                             const nh_classified_space *space, const nh_run *run, nh_pen_style style, nh_text *out);

#endif
