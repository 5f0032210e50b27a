/* For the files of two and of three parameters. */
#ifndef NH_PLANE_INTERNAL_H
#define NH_PLANE_INTERNAL_H

#include "classify/classify_internal.h"
#include "classify/plane.h"

/* Finds where the equations of this degree lose rank modulo one prime, at three points (at two points, intersections of
 * curves that belong to the points would remain), by series of the row's order; sizes go into the row.  False: a limit
 * was reached or the run ended. */
bool nh_plane_zeros(nh_classify_search *search, size_t degree, size_t prime, nh_plane_row *row, nh_common_curves *out);

/* Adds the curves that are not in the list yet. */
void nh_plane_take_curves(nh_plane_curve **list, size_t *count, size_t *capacity, const nh_special_surfaces *found,
                          bool degenerate);
/* Counts the integrals of this degree on each curve of this kind. */
void nh_plane_count_curves(nh_classify_search *search, nh_classify_kind kind, size_t degree, size_t almost_all,
                           size_t count, nh_plane_curve *curve);

#endif
