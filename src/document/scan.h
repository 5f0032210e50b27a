/* scan: the result of `nhsym scan` as a document, JSON (docs/schema/scan.json) and CSV. */
#ifndef NH_DOCUMENT_SCAN_H
#define NH_DOCUMENT_SCAN_H

#include "base/text.h"
#include "commands/scan.h"
#include "document/pen.h"
#include "document/provenance.h"

/* A heap string (nh_free); `run` may be NULL. */
char *nh_scan_json(const nh_scan *scan, const nh_run *run);
/* A line per point. */
void nh_scan_csv(const nh_scan *scan, nh_text *out);
/* With curves over one parameter, or maps over two. */
void nh_scan_write(const nh_scan *scan, const nh_run *run, nh_pen_style style, nh_text *out);

#endif
