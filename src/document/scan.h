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

/* How many special values with this one's exact value, numbers and direction are listed, if it is the first of them; else 0. */
size_t nh_scan_alike(const nh_scan *scan, size_t special);
/* "k = 2", "k = sqrt(3) = 1.7320508", with the other parameters of the grid, or for how many of their values; in the
 * scan's arena. */
const char *nh_scan_where(const nh_scan *scan, size_t special);
/* What happens there, in a sentence. */
const char *nh_scan_what(const nh_scan *scan, const nh_scan_special *special);
/* What a scan cannot see. */
extern const char *const nh_scan_caution;

#endif
