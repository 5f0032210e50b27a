/* Which of the integrals found hold directions of a normal equation: those that are exactly proved, contain letters of
 * the shape only, and have one value at each state near a complex motion. */
#include <math.h>

#include "absence/absence_internal.h"
#include "graph/function.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "integrals/gradient_rank.h"

enum { longest_zero = 5000 /* terms of a normal form */ };

const nh_current *nh_absence_current(const nh_analysis *analysis, size_t index)
{
    const nh_current_list *list = analysis->list;
    return index < list->count ? &list->found[index] : &list->further[index - list->count].current;
}

/* sin, cos, exp and the like have one value everywhere; the others, a logarithm say, have many. */
static bool one_value(nh_function f)
{
    switch (f) {
    case NH_SIN:
    case NH_COS:
    case NH_TAN:
    case NH_SINH:
    case NH_COSH:
    case NH_TANH:
    case NH_EXP:
    case NH_PI: return true;
    default: return false;
    }
}

/* Does a symbol of e vary along a motion? */
static bool varies(const nh_model *model, nh_ex e) { return !nh_model_is_constant(model, e); }

/* Is this product, as a node, without powers of what varies but whole ones, and square roots that `roots` have? */
static bool whole_powers(const nh_model *model, nh_ex product, size_t roots, const nh_ex *root)
{
    const nh_dag *d = model->dag;
    for (size_t i = 0; i < nh_arity(d, product); i++) {
        nh_ex base = nh_child(d, product, i), exponent = nh_exponent_of(d, product, i);
        if (!varies(model, base) && !varies(model, exponent)) continue;
        if (nh_kind_of(d, exponent) != NH_NUMBER) return false;
        nh_num x = nh_number_of(d, exponent);
        if (x.q == 1) continue;
        bool letter = false; /* a root that stands in the equations of motion is a letter of theirs */
        for (size_t k = 0; k < roots && x.q == 2; k++) letter = letter || root[k] == base;
        if (!letter) return false;
    }
    return true;
}

/* The radicands of square roots in the equations of motion. */
static size_t roots_of(nh_arena *arena, const nh_closed_shape *shape, nh_ex **out)
{
    size_t count = 0;
    *out = NULL;
    for (size_t i = 0; i < shape->count; i++) {
        NH_LIST(list);
        size_t n = nh_radicands_in(shape->model->dag, shape->rate[i], &list);
        nh_ex *more = nh_arena_alloc(arena, (count + n + 1) * sizeof *more);
        for (size_t k = 0; k < count; k++) more[k] = (*out)[k];
        for (size_t k = 0; k < n; k++) more[count + k] = list[k];
        *out = more;
        count += n;
    }
    return count;
}

static bool single_valued(const nh_model *model, nh_ex e, size_t roots, const nh_ex *root)
{
    const nh_dag *d = model->dag;
    nh_ex *node;
    size_t n = nh_nodes_in(d, 1, &e, &node);
    bool good = true;
    for (size_t i = 0; i < n && good; i++) {
        if (!varies(model, node[i])) continue;
        if (nh_kind_of(d, node[i]) == NH_FUNCTION) good = one_value((nh_function)nh_node_of(d, node[i])->op);
        if (nh_kind_of(d, node[i]) == NH_PRODUCT) good = whole_powers(model, node[i], roots, root);
    }
    nh_free(node);
    return good;
}

/* Does e contain a coordinate that is left out, or the time? */
static bool left_out(const nh_closed_shape *shape, nh_ex e)
{
    const nh_dag *d = shape->model->dag;
    for (size_t i = 0; i < shape->left; i++)
        if (nh_depends(d, e, shape->left_out[i])) return true;
    return nh_depends(d, e, shape->model->system->t);
}

/* Without the coordinates that are left out, where they stand in e and cancel, as cos(p)^2 + sin(p)^2. */
static nh_ex without_left_out(const nh_closed_shape *shape, nh_ex e)
{
    nh_dag *d = shape->model->dag;
    const nh_ex zero = nh_int(d, 0);
    for (size_t i = 0; i < shape->left; i++) {
        if (!nh_depends(d, e, shape->left_out[i])) continue;
        nh_ex slope = nh_diff(d, e, shape->left_out[i]), there = nh_substitute(d, e, 1, &shape->left_out[i], &zero);
        if (!nh_is_exact(d, slope) || nh_normal_is_zero(d, slope, longest_zero) != NH_ZERO) return e;
        if (nh_is_exact(d, there)) e = there; /* else it has no value there */
    }
    return e;
}

/* Exact, proved, with letters of the shape only; many_valued counts those of the list that are not of one value.  *e is
 * the integral. */
static bool usable(const nh_analysis *analysis, nh_absence *absence, size_t roots, const nh_ex *root, size_t k,
                   nh_ex *e)
{
    const nh_current *current = nh_absence_current(analysis, k);
    if (!current->proof.proved || current->proof.sided || current->series || current->fitted) return false;
    *e = without_left_out(absence->shape, current->phi);
    if (left_out(absence->shape, *e)) return false;
    if (single_valued(absence->shape->model, *e, roots, root)) return true;
    absence->many_valued += k < analysis->list->count;
    return false;
}

nh_known_integrals nh_absence_known(const nh_analysis *analysis, nh_absence *absence)
{
    nh_arena *arena = analysis->arena;
    const nh_model *model = absence->shape->model;
    size_t n = analysis->list->count + analysis->list->furthers, count = 0, roots;
    nh_ex *root, *integral = nh_arena_alloc(arena, (n + 1) * sizeof *integral);
    bool *generic = nh_arena_alloc(arena, n + 1);
    nh_known_integrals known = {.integral = integral, .generic = generic};
    roots = roots_of(arena, absence->shape, &root);
    absence->known_current = nh_arena_alloc(arena, (n + 1) * sizeof *absence->known_current);
    size_t energy = SIZE_MAX;
    for (size_t k = 0; k < n; k++) {
        const nh_current *current = nh_absence_current(analysis, k);
        if (!usable(analysis, absence, roots, root, k, &integral[count])) continue;
        /* levels are told of the energy itself, and not of a multiple of it */
        if (current->energy) integral[count] = model->E;
        /* those that a ball proves to be independent of the ones before */
        nh_rank rank = nh_rank_decide(model, count, integral, analysis->question->options.doubt);
        if (rank.answer != NH_RANK_GROWS || !rank.proved) continue;
        generic[count] = current->proof.all_parameters;
        if (current->energy) energy = count;
        absence->known_current[count++] = k;
    }
    absence->known = known.count = count;
    known.energy = energy < count ? energy : count;
    return known;
}
