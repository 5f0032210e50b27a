/* family: unknowns inside ansatz families (declared in unknowns.h). */
#include <string.h>

#include "graph/dag.h"
#include "integrals/unknowns.h"

bool nh_family_contains(const nh_model *model, const nh_family *f, nh_ex unknown)
{
    const nh_dag *d = model->dag;
    for (size_t i = 0; i < f->in_count; i++)
        if (nh_depends(d, f->in[i], unknown)) return true;
    if (f->kind == NH_FOURIER && nh_depends(d, f->frequency, unknown)) return true;
    for (size_t i = 0; i < f->terms; i++)
        if (nh_depends(d, f->term[i], unknown)) return true;
    for (size_t i = 0; i < f->parts; i++)
        if (nh_family_contains(model, &f->part[i], unknown)) return true;
    return false;
}

static const nh_ex *substitute_all(nh_arena *arena, nh_dag *dag, size_t count, const nh_ex *e, size_t n,
                                   const nh_ex *from, const nh_ex *to)
{
    nh_ex *out = nh_arena_alloc(arena, (count + 1) * sizeof *out);
    for (size_t i = 0; i < count; i++) out[i] = nh_substitute(dag, e[i], n, from, to);
    return out;
}

nh_family nh_family_substitute(nh_arena *arena, nh_dag *dag, const nh_family *f, size_t n, const nh_ex *from,
                               const nh_ex *to)
{
    nh_family g = *f;
    g.in = substitute_all(arena, dag, f->in_count, f->in, n, from, to);
    g.term = substitute_all(arena, dag, f->terms, f->term, n, from, to);
    if (f->kind == NH_FOURIER) g.frequency = nh_substitute(dag, f->frequency, n, from, to);
    nh_family *part = nh_arena_alloc(arena, (f->parts + 1) * sizeof *part);
    for (size_t i = 0; i < f->parts; i++) part[i] = nh_family_substitute(arena, dag, &f->part[i], n, from, to);
    g.part = part;
    return g;
}
