/* The energies of parts of a system that move by themselves: of a particle in x^4 and in a uniform field the energy
 * gives x' only with z and z', which are known with t. */
#include <string.h>

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/terms.h"
#include "integrals/independence.h"
#include "search/quadratures_internal.h"

enum { most_states = 64 };

static size_t root_of(const size_t *parent, size_t x)
{
    while (parent[x] != x) x = parent[x];
    return x;
}

/* A coordinate, or else a velocity. */
static nh_ex state(const nh_model *model, size_t i)
{
    return i < model->m ? model->system->coordinate[i].q : model->chart->w[i - model->m];
}

/* The first state on which e depends, and all others joined to it; the number of states: there is none. */
static size_t join(const nh_model *model, size_t *parent, nh_ex e)
{
    size_t states = model->m + model->n, first = states;
    for (size_t i = 0; i < states; i++) {
        if (!nh_depends(model->dag, e, state(model, i))) continue;
        if (first == states) first = i;
        else parent[root_of(parent, i)] = root_of(parent, first);
    }
    return first;
}

/* The terms of the energy, by coordinates and velocities that occur together; 0: there are no two parts, or one is not
 * constant by itself. */
static size_t parts_of_energy(const nh_model *model, nh_ex part[most_states])
{
    nh_dag *d = model->dag;
    nh_ex *term; /* the first one is the sum itself */
    size_t states = model->m + model->n, terms = nh_terms_of(d, nh_canonical_sum(d, model->E), &term),
           parent[most_states], *first = nh_alloc_array(terms + 1, sizeof *first), count = 0;
    bool apart = states <= most_states;
    for (size_t i = 0; i < states && apart; i++) parent[i] = i;
    for (size_t s = 0; s < model->m && apart; s++) {
        size_t velocity = join(model, parent, model->rho[s]);
        if (velocity < states) parent[root_of(parent, velocity)] = root_of(parent, s);
    }
    for (size_t j = 1; j < terms && apart; j++) first[j] = join(model, parent, term[j]);
    for (size_t i = 0; i < states && apart; i++) {
        nh_ex e = nh_int(d, 0);
        for (size_t j = 1; j < terms; j++)
            if (first[j] < states && root_of(parent, first[j]) == i) e = nh_add(d, e, term[j]);
        if (nh_is_zero(d, e)) continue;
        apart = nh_quadratures_conserves(model, e);
        part[count++] = e;
    }
    nh_free(first);
    nh_free(term);
    return apart && count > 1 ? count : 0;
}

size_t nh_quadratures_with_parts(const nh_analysis *result, const nh_points *points, size_t n, nh_ex *current)
{
    const nh_model *model = result->question->model;
    nh_ex part[most_states], energy = 0;
    size_t at = 0, parts, kept = 0;
    for (size_t k = 0; k < result->list->count; k++)
        if (result->list->found[k].energy) energy = result->list->found[k].phi;
    while (at < n && current[at] != energy) at++;
    if (at == n || !(parts = parts_of_energy(model, part))) return n;
    nh_ex *list = nh_alloc_array(n + parts, sizeof *list);
    nh_independence *kind = nh_alloc_array(n + parts, sizeof *kind);
    for (size_t j = 0; j < n; j++)
        if (j != at) list[kept++] = current[j];
    for (size_t j = 0; j < parts; j++) {
        list[kept] = part[j];
        nh_independence_test(model, points, kept + 1, list, NULL, result->question->options.sure,
                             result->question->options.doubt, kind, NULL);
        kept += kind[kept] == NH_INDEPENDENT;
    }
    bool changed = kept >= n;
    if (changed) memcpy(current, list, kept * sizeof *list);
    nh_free(kind);
    nh_free(list);
    return changed ? kept : n;
}
