/* classification: the special values of one parameter or of two as text, as JSON
 * (docs/schema/classification.json), as a page and as LaTeX. */
#ifndef NH_REPORT_CLASSIFICATION_H
#define NH_REPORT_CLASSIFICATION_H

#include "base/text.h"
#include "document/pen.h"
#include "commands/classify.h"

void nh_classification_text(const nh_classified *classified, bool verbose, nh_text *out);
char *nh_classification_json(const nh_classified *classified, const nh_run *run);

void nh_classification_plane_text(const nh_classified_plane *classified, bool verbose, nh_text *out);
char *nh_classification_plane_json(const nh_classified_plane *classified, const nh_run *run);

/* One of both is there. */
void nh_classification_write(const nh_classified *line, const nh_classified_plane *plane, const nh_run *run, nh_pen_style style, nh_text *out);

#endif
