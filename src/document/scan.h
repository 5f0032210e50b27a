/* scan: the result of `nhsym scan` as text, JSON (docs/schema/scan.json), CSV, pictures and a page. */
#ifndef NH_DOCUMENT_SCAN_H
#define NH_DOCUMENT_SCAN_H

#include "base/text.h"
#include "commands/scan.h"
#include "document/provenance.h"

void nh_scan_text(const nh_scan *scan, bool verbose, nh_text *out);
char *nh_scan_json(const nh_scan *scan, const nh_run *run);
/* A line per point. */
void nh_scan_csv(const nh_scan *scan, nh_text *out);
/* With curves over one parameter, maps over two. */
void nh_html_scan(const nh_scan *scan, const nh_run *run, nh_text *out);

/* "k = 2", "k = 1.7320508 (sqrt(3))", with the other parameters of the grid; in the scan's arena. */
const char *nh_scan_where(const nh_scan *scan, const nh_scan_special *special);
/* What happens there, in a sentence. */
const char *nh_scan_what(const nh_scan *scan, const nh_scan_special *special);
/* What a scan cannot see. */
extern const char *const nh_scan_caution;

#endif
