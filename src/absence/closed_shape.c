/* closed_shape: the letters that matter, and why nothing can be said of some systems. */
#include "absence/closed_shape.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"

enum {
    longest = 1500,      /* nodes of all rates; longer ones have no normal forms within a second */
    longest_zero = 2000, /* terms of a normal form, where a letter may not matter */
};

/* Does the rate depend on the symbol?  It may contain it and not depend on it. */
static bool feels(nh_dag *dag, nh_ex rate, nh_ex symbol)
{
    return nh_depends(dag, rate, symbol) && nh_normal_is_zero(dag, nh_diff(dag, rate, symbol), longest_zero) != NH_ZERO;
}

/* Leaves out, again and again, coordinates that neither a remaining rate nor one of n functions depends on. */
static void leave_out(nh_closed_shape *shape, size_t n, const nh_ex *function)
{
    nh_dag *dag = shape->model->dag;
    for (size_t i = 0; i < shape->coordinates;) {
        bool used = false;
        for (size_t j = 0; j < shape->count && !used; j++) used = feels(dag, shape->rate[j], shape->letter[i]);
        for (size_t j = 0; j < n && !used; j++) used = feels(dag, function[j], shape->letter[i]);
        if (used) {
            i++;
            continue;
        }
        shape->left_out[shape->left++] = shape->letter[i];
        memmove(shape->letter + i, shape->letter + i + 1, (shape->count - i - 1) * sizeof(nh_ex));
        memmove(shape->rate + i, shape->rate + i + 1, (shape->count - i - 1) * sizeof(nh_ex));
        shape->count--;
        shape->coordinates--;
        i = 0;
    }
}

/* ---- angles ---- */

/* Is the call a sine, cosine or tangent of a whole multiple of the symbol plus something else? */
static bool is_periodic_call(nh_dag *dag, nh_ex call, nh_ex symbol)
{
    nh_function f = nh_function_of(dag, call);
    if (f != NH_SIN && f != NH_COS && f != NH_TAN) return false;
    nh_ex slope = nh_diff(dag, nh_child(dag, call, 0), symbol);
    return nh_kind_of(dag, slope) == NH_NUMBER && nh_number_of(dag, slope).q == 1;
}

/* An argument of such a call is not looked into. */
bool nh_closed_shape_periodic(nh_dag *dag, size_t n, const nh_ex *e, nh_ex symbol)
{
    NH_LIST(node);
    size_t count = nh_nodes_in(dag, n, e, &node), size = nh_dag_size(dag);
    bool *inside = nh_alloc_array(size, sizeof *inside), good = true; /* depends in a way that is not periodic */
    for (size_t k = 0; k < count; k++) {
        nh_ex at = node[k];
        nh_kind kind = nh_kind_of(dag, at);
        if (at == symbol) inside[at] = true;
        if (kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        if (kind == NH_FUNCTION && nh_arity(dag, at) == 1 && is_periodic_call(dag, at, symbol)) continue;
        for (size_t i = 0; i < nh_arity(dag, at); i++) {
            inside[at] |= inside[nh_child(dag, at, i)];
            if (kind == NH_PRODUCT) inside[at] |= inside[nh_exponent_of(dag, at, i)];
        }
    }
    for (size_t i = 0; i < n; i++) good = good && !inside[e[i]];
    nh_free(inside);
    return good;
}

static bool is_angle(const nh_closed_shape *shape, nh_ex symbol)
{
    bool occurs = false;
    for (size_t i = 0; i < shape->count; i++) occurs |= nh_depends(shape->model->dag, shape->rate[i], symbol);
    return occurs && nh_closed_shape_periodic(shape->model->dag, shape->count, shape->rate, symbol);
}

/* ---- obstacles ---- */

static const char *forbidden_call(const nh_dag *dag, nh_ex call)
{
    switch (nh_function_of(dag, call)) {
    case NH_UNSPECIFIED: return "the system contains a function without a formula";
    case NH_TABLE: return "the system contains a table of values";
    case NH_ABS:
    case NH_SIGN: return "the equations have kinks";
    default: return NULL;
    }
}

/* The first reason against these equations, or NULL. */
static const char *obstacle_of(const nh_closed_shape *shape)
{
    const nh_model *model = shape->model;
    nh_dag *dag = model->dag;
    NH_LIST(node);
    if (model->chart->implicit) return "some velocities are known as roots of the constraints only";
    if (model->system->driven) return "the system has an input over time";
    size_t count = nh_nodes_in(dag, shape->count, shape->rate, &node);
    for (size_t k = 0; k < count; k++) {
        nh_ex e = node[k];
        if (e == model->system->t) return "the equations contain the time";
        const char *why = nh_kind_of(dag, e) == NH_FUNCTION ? forbidden_call(dag, e) : NULL;
        if (why) return why;
        for (size_t p = 0; p < model->system->parameters; p++)
            if (model->system->parameter[p].input && e == model->system->parameter[p].symbol)
                return "the equations contain an input, which may change with time";
    }
    for (size_t i = 0; i < shape->count; i++)
        if (!nh_is_exact(dag, shape->rate[i])) return "the equations contain rounded numbers";
    return NULL;
}

nh_closed_shape *nh_closed_shape_of(nh_arena *arena, const nh_model *model)
{
    return nh_closed_shape_keeping(arena, model, 0, NULL);
}

nh_closed_shape *nh_closed_shape_keeping(nh_arena *arena, const nh_model *model, size_t n, const nh_ex *function)
{
    nh_closed_shape *shape = nh_arena_alloc(arena, sizeof *shape);
    size_t all = model->m + model->n;
    NH_LIST(node);
    shape->model = model;
    shape->count = all;
    shape->coordinates = model->m;
    shape->letter = nh_arena_alloc(arena, (all + 1) * sizeof(nh_ex));
    shape->rate = nh_arena_alloc(arena, (all + 1) * sizeof(nh_ex));
    shape->left_out = nh_arena_alloc(arena, (all + 1) * sizeof(nh_ex));
    shape->angle = nh_arena_alloc(arena, (all + 1) * sizeof(bool));
    for (size_t i = 0; i < all; i++) {
        shape->letter[i] = i < model->m ? model->system->coordinate[i].q : model->chart->w[i - model->m];
        shape->rate[i] = i < model->m ? model->rho[i] : model->a[i - model->m];
    }
    if (nh_nodes_in(model->dag, all, shape->rate, &node) > longest) {
        shape->obstacle = "the equations are too long";
        return shape;
    }
    leave_out(shape, n, function);
    shape->obstacle = obstacle_of(shape);
    for (size_t i = 0; i < shape->coordinates && !shape->obstacle; i++)
        shape->angle[i] = is_angle(shape, shape->letter[i]);
    return shape;
}
