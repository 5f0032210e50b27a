/* Impulses during a motion: where the Lagrangian jumps, or the constraints begin to allow other velocities, the
 * velocities of a motion jump.  The equations of motion on the two sides do not determine the jump, so motions end
 * there. */
#include "commands/simulate_internal.h"

#include "integrals/region.h"

size_t nh_simulate_impulses(nh_simulation *s, const nh_options *options, const nh_ex **impulse)
{
    nh_terrain *terrain = nh_arena_alloc(s->arena, sizeof *terrain);
    *terrain = nh_terrain_of(s->model, options, s->arena);
    *impulse = terrain->impulse;
    return terrain->impulses;
}
