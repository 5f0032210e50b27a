/* frame_velocities: the quasi-velocities of a system with orientations whose file chooses none: rates along the frame,
 * without those that the constraints determine. */
#include "graph/dag.h"
#include "system/embedding_internal.h"
#include "system/system_internal.h"

/* The system whose velocities are those along the frame: the velocity symbols of an orientation's coordinates stand for
 * its angular velocities. */
static nh_system along_frame(nh_system_reader *r)
{
    nh_system *system = r->system, copy = *system;
    copy.orientations = 0;
    copy.constraint = nh_system_take(r, system->constraints, sizeof *copy.constraint);
    for (size_t a = 0; a < system->constraints; a++) {
        nh_ex f = system->constraint[a].framed;
        for (size_t i = 0; i < system->orientations; i++) {
            const nh_orientation *o = &system->orientation[i];
            for (size_t k = 0; k < 3; k++)
                f = nh_substitute(system->dag, f, 1, &o->framed[k], &system->coordinate[o->first + k].v);
        }
        copy.constraint[a] = system->constraint[a];
        copy.constraint[a].lhs = f;
        copy.constraint[a].rhs = nh_int(system->dag, 0);
    }
    return copy;
}

/* The velocity that belongs to the rate along the frame with this number. */
static nh_ex velocity_of(const nh_system *system, size_t i)
{
    const nh_orientation *o = nh_orientation_of(system, i);
    return o ? o->omega[i - o->first] : system->coordinate[i].v;
}

bool nh_orientation_velocities(nh_system_reader *r)
{
    nh_system *system = r->system, frame = along_frame(r);
    size_t m = system->coordinates;
    nh_chart *c = nh_embedding_coordinates(&frame, 1, r->error);
    if (!c) return false;
    if (c->implicit) {
        nh_chart_free(c);
        nh_deck_fail(r->deck, system->constraint[0].node, 0, r->error,
                     "constraints that are not linear in the velocities need `velocities:` beside an orientation");
        return nh_error_hint(r->error, "velocities: {names: [..], map: [\"%s = ..\", ..]}",
                             system->orientation[0].word[0]);
    }
    system->quasi_velocity = nh_system_take(r, c->n, sizeof *system->quasi_velocity);
    system->quasi_framed = nh_system_take(r, m, sizeof *system->quasi_framed);
    system->quasi_map = nh_system_take(r, m, sizeof *system->quasi_map);
    for (size_t j = 0; j < c->n; j++) system->quasi_velocity[j] = velocity_of(system, c->free[j]);
    system->quasi = c->n;
    for (size_t i = 0; i < m; i++)
        system->quasi_framed[i] = nh_substitute(system->dag, c->rho[i], c->n, c->w, system->quasi_velocity);
    nh_orientation_map(system, system->quasi_framed, system->quasi_map);
    nh_chart_free(c);
    return true;
}
