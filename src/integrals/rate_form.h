/* rate_form: rates with signs or elliptic integrals in a form in which the normal form sees that they vanish.
 *
 * It treats |u| and every root as a function of its own, of which it knows the square only: sqrt(u^2 v) is then not
 * |u| sqrt(v), and (N/D)^(1/4) has nothing to do with sqrt(N). */
#ifndef NH_RATE_FORM_H
#define NH_RATE_FORM_H

#include "geometry/model.h"

/* A form that is equal on the domain of the model.  decisive[i], one for each parameter, is set where that follows from
 * the signs that functions of this parameter have at the probes, with the value that it has. */
nh_ex nh_rate_form(const nh_model *model, nh_ex e, bool *decisive);

#endif
