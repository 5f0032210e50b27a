#include "document/reduction.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "exact/normal.h"
#include "graph/print.h"
#include "reduction/section.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/reduction_sheet.h"
#include "graph/dag.h"
#include "graph/node.h"

/* Simplified, unless it is so large that nobody would read it. */
static nh_ex shortened(const nh_reduction *r, nh_ex e)
{
    enum { largest = 4000 };
    return nh_node_count(r->kinetic->dag, e) < largest ? nh_simplify(r->kinetic->dag, e) : e;
}

size_t nh_reduction_equations(const nh_reduction *r, const nh_reduction_stage *s, nh_reduction_equation **out)
{
    const nh_reduced *o = s->shown;
    nh_dag *d = r->kinetic->dag;
    nh_arena *arena = r->kinetic->arena;
    size_t n = 0;
    nh_reduction_equation *e = nh_arena_alloc(arena, (o->n + 2 * o->r + o->d + 1) * sizeof *e);
    for (size_t i = 0; i < o->r && !o->plain; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t j = 0; j < o->r; j++) sum = nh_add(d, sum, nh_mul(d, o->M[i * o->r + j], o->w[j]));
        e[n++] = (nh_reduction_equation){o->momentum[i], shortened(r, sum)};
    }
    for (size_t i = 0; i < o->n; i++) {
        bool trivial = false; /* x' is itself one of the velocities */
        for (size_t j = 0; j < o->r; j++) trivial |= o->dx[i] == o->w[j];
        if (!trivial) e[n++] = (nh_reduction_equation){nh_name_of(d, o->x[i]), shortened(r, o->dx[i])};
        if (!trivial) e[n - 1].name = nh_arena_printf(arena, "%s'", e[n - 1].name);
    }
    for (size_t i = 0; i < o->r; i++)
        e[n++] = (nh_reduction_equation){nh_arena_printf(arena, "%s'", o->momentum[i]), shortened(r, o->F[i])};
    for (size_t a = 0; a < o->d; a++)
        e[n++] = (nh_reduction_equation){
            nh_arena_printf(arena, "%s_%zu", s->kind == NH_STAGE_SECOND ? "eta" : "zeta", a + 1),
            shortened(r, o->zeta[a])};
    *out = e;
    return n;
}

const char *nh_reduction_joint_name(const nh_reduction *r, size_t joint)
{
    const nh_chain *c = r->system->chain;
    return nh_arena_printf(r->kinetic->arena, "joint of %s", c->body[c->joint[joint].child].name);
}
