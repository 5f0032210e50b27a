/* sweep_internal: what sweep and its worker processes share. */
#ifndef NH_SWEEP_INTERNAL_H
#define NH_SWEEP_INTERNAL_H

#include <stdatomic.h>

#include "base/sweep.h"

void nh_sweep_say(const nh_sweep *sweep, size_t done, size_t all);
/* Computes a unit and writes its file; when the computation is interrupted, or its process ends, the lines so far are
 * kept. */
bool nh_sweep_do_unit(const nh_sweep *sweep, size_t unit, atomic_size_t *items_done, bool (*orphan)(void),
                      nh_error *error);
bool nh_sweep_do_in_workers(const nh_sweep *sweep, size_t units, const size_t *unit, nh_sweep_state *state,
                            nh_error *error);

#endif
