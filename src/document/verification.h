/* verification: the answer to `verify` as a document, and as JSON (schema version 1, docs/formats.md). */
#ifndef NH_VERDICT_REPORT_H
#define NH_VERDICT_REPORT_H

#include "base/text.h"
#include "document/pen.h"
#include "commands/verify.h"

/* "a constraint symmetry", "conserved", or another property that was tested. */
const char *nh_verification_noun(const nh_verification *verdict);
/* A heap string (nh_free) that ends in a newline; `run` may be NULL. */
char *nh_verification_json(const nh_verification *verdict, const nh_run *run);

void nh_verification_write(const nh_verification *verdict, const nh_run *run, nh_pen_style style, nh_text *out);

/* The chart whose velocities replace roots; NULL where the answer holds on one branch only, and would not hold with the
 * velocity. */
const nh_chart *nh_verification_chart(const nh_verification *verdict);
/* The branches of a quadratic constraint on which the answer holds: ", on both branches"; "" without branches. */
const char *nh_verification_branches(const nh_verification *verdict);

#endif
