/* scan_internal: the parts of a scan. */
#ifndef NH_SCAN_INTERNAL_H
#define NH_SCAN_INTERNAL_H

#include "commands/scan.h"

/* ---- scan_grid.c ---- */

/* Reads the grid of the request into the scan; false with a message. */
bool nh_scan_read_grid(nh_scan *scan, const nh_scan_request *request, nh_error *error);
/* Settings of a point, in the arena: the request's own, then the grid's, exact or as doubles. */
nh_setting *nh_scan_settings(const nh_scan *scan, const nh_scan_request *request, nh_arena *arena, size_t point,
                             bool exact, size_t *count);
/* The distance, in points, to the next value along an axis. */
size_t nh_scan_stride(const nh_scan *scan, size_t axis);
size_t nh_scan_index(const nh_scan *scan, size_t point, size_t axis);

/* ---- scan_manifest.c ---- */

/* Writes the folder's manifest unless it exists, and compares the question with it; `per_unit` and the seconds of a
 * unit are those of the manifest. */
bool nh_scan_manifest(nh_scan *scan, const nh_scan_request *request, double (*seconds_of_a_point)(void *context),
                      void *context, size_t *per_unit, const char **fingerprint, nh_error *error);

/* ---- scan_spaces.c ---- */

/* The ansatz spaces, named in the result. */
bool nh_scan_list_spaces(nh_scan *scan, const nh_scan_request *request, nh_error *error);
/* The smallest singular values at these settings, of one space or (SIZE_MAX) of all: value number `index` of each, or
 * (SIZE_MAX) the first that does not vanish. */
void nh_scan_spectra(const nh_scan *scan, const nh_scan_request *request, size_t settings, const nh_setting *setting,
                     size_t space, size_t index, double *smallest, size_t *vanishing);

/* ---- scan_jumps.c ---- */

/* A jump that has to be examined. */
typedef struct {
    nh_scan_kind kind;
    size_t axis, place;
    double generic;
    size_t spaces;                 /* of a dip: at most three spaces, the most promising first */
    size_t space[3], vanishing[3]; /* and the number of singular values that vanish around it */
} nh_scan_jump;

/* The jumps between the points that are known, in the arena of the scan; returns their number. */
size_t nh_scan_jumps(const nh_scan *scan, nh_scan_jump **out);

/* ---- scan_refine.c ---- */

/* The special value of a jump as a line; an empty object: there is none.  False: interrupted. */
bool nh_scan_refine(const nh_scan *scan, const nh_scan_request *request, const nh_scan_jump *jump, nh_text *line);
bool nh_scan_read_special(nh_scan *scan, const char *line, const nh_scan_jump *jump, nh_scan_special *out);

/* ---- scan_recognise.c ---- */

enum { NH_SCAN_MOST_GUESSES = 12 };
/* Constants of the expression language that may equal a number known up to `error`, the simplest first; in the
 * arena. */
size_t nh_scan_guess(nh_arena *arena, double value, double error, nh_setting *out);

#endif
