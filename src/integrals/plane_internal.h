/* For the files of two and of three parameters. */
#ifndef NH_PLANE_INTERNAL_H
#define NH_PLANE_INTERNAL_H

#include "integrals/classify_internal.h"
#include "integrals/plane.h"

/* Where the equations of this degree lose rank, modulo one prime, at three points (two leave intersections of curves
 * that belong to them), by series of the row's order, into which sizes go. False: a limit or the end of the run. */
bool nh_plane_zeros(nh_classify_search *search, size_t degree, size_t prime, nh_plane_row *row, nh_common_curves *out);

#endif
