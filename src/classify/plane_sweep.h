/* plane_sweep: where determinants of two parameters are too large, one line mu = a/b after another.
 *
 * On a line the system has one parameter, lambda.  Modulo one prime the values at which its linear system loses rank
 * are roots of chi at two points (classify.h).  Where all of them lie on known curves nothing else on the line is
 * special, up to a height of lambda; the other lines have to be classified.  All lines with mu = a/b up to a height
 * together cover every pair of rationals up to that height. */
#ifndef NH_PLANE_SWEEP_H
#define NH_PLANE_SWEEP_H

#include "classify/classify_internal.h"

/* Known special and degenerate curves, and lines that will be classified anyway (mu is a root of the polynomial). */
typedef struct {
    size_t curves, lines;
    const nh_special_curve *curve;
    const nh_special_factor *line;
} nh_plane_known;

typedef struct {
    size_t count, capacity;
    nh_special_factor *line; /* lines that have to be classified (mu is a root of each); on the heap */
    size_t examined;
    double height; /* height of the pairs of rationals that the other lines cover */
    bool curves;   /* there are more curves than are known: nothing was swept */
} nh_plane_sweep;

/* Examines the lines of this degree up to this height, without the known ones.  False: a limit was reached or the run
 * ended. */
bool nh_plane_sweep_lines(nh_classify_search *search, const nh_plane_known *known, size_t degree,
                          const nh_classify_number *number, size_t height, nh_plane_sweep *out);
void nh_plane_sweep_clear(nh_plane_sweep *sweep);

#endif
