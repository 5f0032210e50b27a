/* Impulses on the way: where the Lagrangian jumps, or the constraints begin to allow other velocities, a motion has an
 * impulse.  The equations of motion on both sides do not hold it, and the computed motion goes through without. */
#include "commands/simulate_internal.h"

#include "graph/print.h"
#include "integrals/region.h"

/* The first two times between which g(t, q) changes its sign; false: it does not. */
static bool passes(const nh_simulation *s, nh_ex g, double between[2])
{
    const nh_motion *motion = s->motion;
    const nh_model *o = s->model;
    double *z = nh_arena_alloc(s->arena, o->width * sizeof *z), value, before = 0;
    nh_tape *tape = nh_model_tape(o, 1, &g);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool found = false;
    for (size_t i = 0; i < motion->count && !found; i++) {
        z[0] = motion->time[i];
        for (size_t j = 0; j < o->m; j++) z[1 + j] = motion->state[i * motion->size + j];
        nh_tape_eval(tape, work, z, &value);
        found = value * before < 0;
        if (value != 0) before = value, between[found] = z[0];
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return found;
}

const char *nh_simulate_impulse(nh_simulation *s, const nh_options *options)
{
    if (!s->motion || s->motion->size < s->model->m) return NULL;
    nh_terrain terrain = nh_terrain_of(s->model, options, s->arena);
    for (size_t i = 0; i < terrain.impulses; i++) {
        double between[2];
        if (!passes(s, terrain.impulse[i], between)) continue;
        char *wall = nh_print_string(s->model->dag, terrain.impulse[i]);
        const char *words = nh_arena_printf(s->arena,
            "between t = %.6g and t = %.6g the motion crosses %s = 0, where it has an impulse that the equations of "
            "motion do not contain: what comes after it is no motion of the system", between[0], between[1], wall);
        nh_free(wall);
        return words;
    }
    return NULL;
}
