#include "integrals/places.h"

#include "base/memory.h"
#include "graph/diff.h"
#include "graph/node.h"

static bool moves(const nh_model *o, nh_ex e)
{
    bool any = false;
    for (size_t s = 0; s < o->m && !any; s++) any = nh_depends(o->dag, e, o->system->coordinate[s].v);
    for (size_t i = 0; i < o->n && !any; i++) any = nh_depends(o->dag, e, o->chart->w[i]);
    return any;
}

static bool has_position(const nh_model *o, nh_ex e)
{
    bool any = nh_depends(o->dag, e, o->system->t);
    for (size_t s = 0; s < o->m && !any; s++) any = nh_depends(o->dag, e, o->system->coordinate[s].q);
    return any;
}

static bool is_place(const nh_model *o, nh_ex e)
{
    if (nh_kind_of(o->dag, e) != NH_SUM || moves(o, e)) return false;
    bool linear = !has_position(o, nh_diff(o->dag, e, o->system->t)), some = false;
    for (size_t s = 0; s < o->m; s++) {
        nh_ex slope = nh_diff(o->dag, e, o->system->coordinate[s].q);
        linear &= !has_position(o, slope);
        some |= !nh_is_zero(o->dag, slope);
    }
    return some && !linear;
}

size_t nh_places_of(const nh_model *o, nh_ex out[NH_MOST_PLACES])
{
    const nh_system *y = o->system;
    nh_ex *e = nh_alloc_array(1 + 2 * y->constraints, sizeof *e), *node;
    size_t n = 0, found = 0;
    e[n++] = y->lagrangian;
    for (size_t a = 0; a < y->constraints; a++) e[n++] = y->constraint[a].lhs, e[n++] = y->constraint[a].rhs;
    size_t count = nh_nodes_in(o->dag, n, e, &node);
    for (size_t i = 0; i < count && found < NH_MOST_PLACES; i++)
        if (is_place(o, node[i])) out[found++] = node[i];
    nh_free(node);
    nh_free(e);
    return found;
}
