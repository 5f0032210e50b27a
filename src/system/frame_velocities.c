/* frame_velocities: the quasi-velocities of a system with orientations whose file chooses none: rates along the frame,
 * without those that the constraints determine. */
#include "graph/dag.h"
#include "system/embedding_internal.h"
#include "system/system_internal.h"

/* The system whose velocities are those along the frame: the velocity symbols of an orientation's coordinates stand for
 * its angular velocities. */
static nh_system along_frame(nh_system_reader *r)
{
    nh_system *s = r->system, copy = *s;
    copy.orientations = 0;
    copy.constraint = nh_system_take(r, s->constraints, sizeof *copy.constraint);
    for (size_t a = 0; a < s->constraints; a++) {
        nh_ex f = s->constraint[a].framed;
        for (size_t i = 0; i < s->orientations; i++) {
            const nh_orientation *o = &s->orientation[i];
            for (size_t k = 0; k < 3; k++)
                f = nh_substitute(s->dag, f, 1, &o->framed[k], &s->coordinate[o->first + k].v);
        }
        copy.constraint[a] = s->constraint[a];
        copy.constraint[a].lhs = f;
        copy.constraint[a].rhs = nh_int(s->dag, 0);
    }
    return copy;
}

/* The velocity that belongs to the rate along the frame with this number. */
static nh_ex velocity_of(const nh_system *s, size_t i)
{
    const nh_orientation *o = nh_orientation_of(s, i);
    return o ? o->omega[i - o->first] : s->coordinate[i].v;
}

bool nh_orientation_velocities(nh_system_reader *r)
{
    nh_system *s = r->system, frame = along_frame(r);
    size_t m = s->coordinates;
    nh_chart *c = nh_embedding_coordinates(&frame, 1, r->error);
    if (!c) return false;
    if (c->implicit) {
        nh_chart_free(c);
        nh_deck_fail(r->deck, s->constraint[0].node, 0, r->error,
                     "constraints that are not linear in the velocities need `velocities:` beside an orientation");
        return nh_error_hint(r->error, "velocities: {names: [..], map: [\"%s = ..\", ..]}", s->orientation[0].word[0]);
    }
    s->quasi_velocity = nh_system_take(r, c->n, sizeof *s->quasi_velocity);
    s->quasi_framed = nh_system_take(r, m, sizeof *s->quasi_framed);
    s->quasi_map = nh_system_take(r, m, sizeof *s->quasi_map);
    for (size_t j = 0; j < c->n; j++) s->quasi_velocity[j] = velocity_of(s, c->free[j]);
    s->quasi = c->n;
    for (size_t i = 0; i < m; i++) s->quasi_framed[i] = nh_substitute(s->dag, c->rho[i], c->n, c->w, s->quasi_velocity);
    nh_orientation_map(s, s->quasi_framed, s->quasi_map);
    nh_chart_free(c);
    return true;
}
