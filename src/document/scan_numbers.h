/* scan_numbers: any number that analyze, reduce or the count of integrals can give, as a source of a scan.
 *
 * A number is named by its path in the command's JSON, as in group.dimension or currents.0.drift; for a list it is the
 * number of its entries, for a truth value 1 or 0.  Times are refused: they differ from run to run. */
#ifndef NH_SCAN_NUMBERS_H
#define NH_SCAN_NUMBERS_H

#include "commands/request.h"
#include "commands/scan.h"

/* Makes a source of request->of and request->number, which lives in the arena.  False with a message: there is no such
 * command or number. */
bool nh_scan_numbers(nh_arena *arena, const nh_request *request, nh_scan_source *out, nh_error *error);

#endif
