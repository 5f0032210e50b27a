/* scan: the result of `nhsym scan` as a document, JSON (docs/schema/scan.json) and CSV. */
#ifndef NH_DOCUMENT_SCAN_H
#define NH_DOCUMENT_SCAN_H

#include "base/text.h"
#include "commands/request.h"
#include "commands/scan.h"
#include "document/pen.h"
#include "document/provenance.h"

/* A heap string (nh_free); `run` may be NULL. */
char *nh_scan_json(const nh_scan *scan, const nh_run *run);
/* A line per point. */
void nh_scan_csv(const nh_scan *scan, nh_text *out);
/* With curves over one parameter, or maps over two. */
void nh_scan_write(const nh_scan *scan, const nh_run *run, nh_pen_style style, nh_text *out);

/* Any number that analyze, reduce or the count of integrals can give, as a source of a scan.
 *
 * A number is named by its path in the command's JSON, as in group.dimension or currents.0.drift; for a list it is the
 * number of its entries, for a truth value 1 or 0.  Times are refused: they differ from run to run. */

/* Makes a source of request->of and request->number, which lives in the arena.  False with a message: there is no such
 * command or number. */
bool nh_scan_numbers(nh_arena *arena, const nh_request *request, nh_scan_source *out, nh_error *error);

#endif
