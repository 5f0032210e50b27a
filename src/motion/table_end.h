/* table_end: does a motion end because it leaves a table?  Its function has no value outside (base/spline.h), so that
 * steps become as small as can be at the edge. */
#ifndef NH_TABLE_END_H
#define NH_TABLE_END_H

#include "geometry/model.h"
#include "motion/motion.h"

/* Writes the note of a motion that ended early near the edge of a table of the equations, at its last state, which
 * begins with the coordinates. */
void nh_table_end_explain(const nh_model *model, nh_motion *motion);

#endif
