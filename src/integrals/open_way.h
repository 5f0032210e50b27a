/* open_way: can a motion get from one state to another, or does a pole of the Lagrangian lie between them?
 *
 * The straight way in (t, q, w).  Where a base of a negative power, or the argument of a logarithm, of L or of a force
 * changes its sign on it, and L grows without bound there, no motion passes: a potential 1/x^2 keeps x > 0 apart from x
 * < 0.  Nor does one where L is not real. */
#ifndef NH_OPEN_WAY_H
#define NH_OPEN_WAY_H

#include "geometry/model.h"

/* Borrows the model; nh_open_way_free. */
typedef struct nh_open_way nh_open_way;
nh_open_way *nh_open_way_create(const nh_model *model);
void nh_open_way_free(nh_open_way *way);

/* From one state (t, q, w, u) to another. */
bool nh_open_way_leads(nh_open_way *way, const double *from, const double *to);

#endif
