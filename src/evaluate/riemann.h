/* riemann: solutions of (1 + z^2)^2 y'' = (a + b z + c z^2) y, with rigorous bounds (Arb).
 *
 * The first has y(0) = 1 and y'(0) = 0, the second 0 and 1; `prime` asks for y'. */
#ifndef NH_RIEMANN_H
#define NH_RIEMANN_H

#include <stdbool.h>

#include "evaluate/arb.h"

/* argument: a, b, c, z; the series are computed to about so many bits. */
void nh_riemann(acb_t out, bool second, bool prime, acb_srcptr argument, slong bits);

/* The same at a real place, which is fast where many places have the same a, b and c; not finite where one of them is
 * not. */
void nh_riemann_at(arb_t out, bool second, bool prime, const double *place, slong bits);

#endif
