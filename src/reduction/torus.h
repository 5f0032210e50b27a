/* torus: which combinations of commuting symmetries may be circles though no generator is one.
 *
 * Two oscillators that turn at incommensurable rates under either of two generators turn one by one under combinations:
 * where the linear parts of the fields have the joint rates w_j(x), linear in the combination x, those x at which one
 * rate is 1 and the others 0 close. */
#ifndef NH_TORUS_H
#define NH_TORUS_H

#include "reduction/action.h"

/* n commuting combinations c of the generators (d x n).  The directions go to out (d x n); returns their number, at
 * most n.  Numbers only: the flow decides (nh_flows_closed). */
size_t nh_torus_directions(const nh_action *action, size_t n, const double *c, double *out);

#endif
