/* first_state: the state from which a motion begins where none is given, with few digits, as people write one. */
#ifndef NH_FIRST_STATE_H
#define NH_FIRST_STATE_H

#include "geometry/model.h"

/* Rounds a point of the chart (t, q, w, u; model->width values): positions only where no equation between positions
 * binds them; t becomes 0 where the equations of motion do not depend on it, or by inputs alone; a system
 * with inputs begins at rest.  v: the velocities of the m coordinates
 * there.  False: neither the rounded point nor the given one has finite velocities. */
bool nh_first_state(const nh_model *model, double *z, double *v);

#endif
