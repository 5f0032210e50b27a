/* plane_sweep: where determinants of two parameters are too large, one line mu = a/b after another.
 *
 * On a line the system has one parameter, lambda. Modulo one prime the values at which its linear system loses rank are
 * roots of chi at two points (classify.h). Where all of them lie on curves that are known nothing else is special on
 * the line, up to a height of lambda; other lines have to be classified. Lines with all mu = a/b up to a height leave
 * no pair of rationals up to it. */
#ifndef NH_PLANE_SWEEP_H
#define NH_PLANE_SWEEP_H

#include "classify/classify_internal.h"

/* Special and degenerate curves that are known, and lines that will be classified anyway: mu is the root. */
typedef struct {
    size_t curves, lines;
    const nh_special_curve *curve;
    const nh_special_factor *line;
} nh_plane_known;

typedef struct {
    size_t count, capacity;
    nh_special_factor *line; /* of those that have to be classified: mu is the root; on the heap */
    size_t examined;
    double height;           /* of pairs of rationals on the others */
    bool curves;             /* there are more curves than are known: nothing was swept */
} nh_plane_sweep;

/* Of this degree, by lines up to this height, without those that are known.  False: a limit or the end of the run. */
bool nh_plane_sweep_lines(nh_classify_search *search, const nh_plane_known *known, size_t degree,
                          const nh_classify_number *number, size_t height, nh_plane_sweep *out);
void nh_plane_sweep_clear(nh_plane_sweep *sweep);

#endif
