#include "integrals/places.h"

#include "base/memory.h"
#include "graph/diff.h"
#include "graph/node.h"

static bool moves(const nh_model *model, nh_ex e)
{
    bool any = false;
    for (size_t s = 0; s < model->m && !any; s++) any = nh_depends(model->dag, e, model->system->coordinate[s].v);
    for (size_t i = 0; i < model->n && !any; i++) any = nh_depends(model->dag, e, model->chart->w[i]);
    return any;
}

static bool has_position(const nh_model *model, nh_ex e)
{
    bool any = nh_depends(model->dag, e, model->system->t);
    for (size_t s = 0; s < model->m && !any; s++) any = nh_depends(model->dag, e, model->system->coordinate[s].q);
    return any;
}

static bool is_place(const nh_model *model, nh_ex e)
{
    if (nh_kind_of(model->dag, e) != NH_SUM || moves(model, e)) return false;
    bool linear = !has_position(model, nh_diff(model->dag, e, model->system->t)), some = false;
    for (size_t s = 0; s < model->m; s++) {
        nh_ex slope = nh_diff(model->dag, e, model->system->coordinate[s].q);
        linear &= !has_position(model, slope);
        some |= !nh_is_zero(model->dag, slope);
    }
    return some && !linear;
}

size_t nh_places_of(const nh_model *model, nh_ex out[NH_MOST_PLACES])
{
    const nh_system *system = model->system;
    nh_ex *e = nh_alloc_array(1 + 2 * system->constraints, sizeof *e), *node;
    size_t n = 0, found = 0;
    e[n++] = system->lagrangian;
    for (size_t a = 0; a < system->constraints; a++)
        e[n++] = system->constraint[a].lhs, e[n++] = system->constraint[a].rhs;
    size_t count = nh_nodes_in(model->dag, n, e, &node);
    for (size_t i = 0; i < count && found < NH_MOST_PLACES; i++)
        if (is_place(model, node[i])) out[found++] = node[i];
    nh_free(node);
    nh_free(e);
    return found;
}
