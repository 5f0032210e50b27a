/* summary_internal: declarations for summary*.c. */
#ifndef NH_SUMMARY_INTERNAL_H
#define NH_SUMMARY_INTERNAL_H

#include "document/summary.h"

typedef struct {
    const nh_analysis *r;
    nh_summary_style style;
    nh_text *out;
} nh_summary_writer;

void nh_summary_heading(nh_summary_writer *w, const char *text);
void nh_summary_evidence(nh_summary_writer *w); /* how it was found */
void nh_summary_motion(nh_summary_writer *w);   /* checked along a motion */

#endif
