/* For the files of two and of three parameters. */
#ifndef NH_PLANE_INTERNAL_H
#define NH_PLANE_INTERNAL_H

#include "classify/classify_internal.h"
#include "classify/plane.h"

/* Where the equations of this degree lose rank, modulo one prime, at three points (two leave intersections of curves
 * that belong to them), by series of the row's order, into which sizes go. False: a limit or the end of the run. */
bool nh_plane_zeros(nh_classify_search *search, size_t degree, size_t prime, nh_plane_row *row, nh_common_curves *out);

/* Adds those that are not in the list yet. */
void nh_plane_take_curves(nh_plane_curve **list, size_t *count, size_t *capacity, const nh_special_surfaces *found,
                          bool degenerate);
/* How many integrals of this degree there are on each of them, which are of this kind. */
void nh_plane_count_curves(nh_classify_search *search, nh_classify_kind kind, size_t degree, size_t almost_all,
                           size_t count, nh_plane_curve *curve);

#endif
