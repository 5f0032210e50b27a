/* darboux_generic: does what refutes at the given values of the parameters do so for almost all values?
 *
 * Let the inertia be constant and the potential homogeneous of degree k for all values a of the parameters.  Lines and
 * eigenvalues (c, lambda) are the zeros of polynomials; at a_0 there is one with an eigenvalue lambda_0 that is not in
 * the table.  Some component of these zeros through (a_0, c_0, lambda_0) lies over all a: where all lines of a
 * polynomial in two coordinates were tried because they are finitely many at a_0, and where c_0 is a line for all a.
 * lambda is equal to one value of the table on a proper closed part of it: on a hypersurface of a.  The table is
 * countable. */
#include <stdlib.h>

#include "absence/darboux_internal.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/monomials.h"
#include "graph/node.h"
#include "graph/num.h"

bool nh_darboux_algebraic(const nh_dag *dag, size_t symbols, const nh_ex *symbol, nh_ex e, bool *roots)
{
    nh_ex *node = NULL;
    size_t n = nh_nodes_in(dag, 1, &e, &node);
    bool good = true;
    for (size_t i = 0; i < n && good; i++) {
        nh_kind kind = nh_kind_of(dag, node[i]);
        bool known = kind != NH_SYMBOL;
        for (size_t j = 0; j < symbols && !known; j++) known = symbol[j] == node[i];
        good = known && kind != NH_FUNCTION && (kind != NH_NUMBER || nh_num_exact(nh_number_of(dag, node[i])));
        for (size_t j = 0; kind == NH_PRODUCT && j < nh_arity(dag, node[i]) && good; j++) {
            nh_ex exponent = nh_exponent_of(dag, node[i], j);
            good = nh_kind_of(dag, exponent) == NH_NUMBER && nh_num_short(nh_number_of(dag, exponent));
            if (good && nh_number_of(dag, exponent).q != 1 && nh_kind_of(dag, nh_child(dag, node[i], j)) != NH_NUMBER)
                *roots = true;
        }
    }
    nh_nodes_free(&node);
    return good;
}

/* ---- the degree ---- */

static bool among(nh_ex e, size_t n, const nh_ex *list)
{
    for (size_t i = 0; i < n; i++)
        if (list[i] == e) return true;
    return false;
}

static int by_index(const void *a, const void *b)
{
    const nh_ex *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

typedef struct {
    const nh_dag *dag;
    size_t below; /* nodes with a degree: children stand before their parents */
    const nh_ex *node;
    nh_num *degree;
} graded;

/* The degree of a sum, a power or a product from those of its parts; false: the terms of a sum have different ones. */
static bool degree_of_parts(const graded *g, nh_ex e, nh_num *out)
{
    const nh_dag *dag = g->dag;
    bool sum = nh_kind_of(dag, e) == NH_SUM;
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        nh_ex child = nh_child(dag, e, i);
        const nh_ex *found = bsearch(&child, g->node, g->below, sizeof *g->node, by_index);
        if (!found) return false;
        nh_num degree = g->degree[found - g->node];
        if (!sum) *out = nh_num_add(*out, nh_num_mul(degree, nh_number_of(dag, nh_exponent_of(dag, e, i))));
        else if (i && !nh_num_equal(degree, *out)) return false;
        else *out = degree;
    }
    /* A constant has the degree 0. */
    return !sum || nh_num_is(nh_constant_of(dag, e), 0) || nh_num_is(*out, 0);
}

/* A sum without the terms in which none of the symbols stands. */
static nh_ex without_constants(nh_dag *dag, size_t n, const nh_ex *symbol, nh_ex e)
{
    if (nh_kind_of(dag, e) != NH_SUM) return e;
    nh_ex out = nh_int(dag, 0);
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        bool varies = false;
        for (size_t j = 0; j < n && !varies; j++) varies = nh_depends(dag, nh_child(dag, e, i), symbol[j]);
        nh_ex coefficient = nh_number(dag, nh_coefficient_of(dag, e, i));
        if (varies) out = nh_add(dag, out, nh_mul(dag, coefficient, nh_child(dag, e, i)));
    }
    return out;
}

bool nh_darboux_degree(nh_dag *dag, size_t n, const nh_ex *symbol, nh_ex *e, nh_num *k)
{
    nh_ex varying = without_constants(dag, n, symbol, *e), *node = NULL;
    size_t nodes = nh_nodes_in(dag, 1, &varying, &node);
    graded g = {.dag = dag, .node = node, .degree = nh_alloc_array(nodes + 1, sizeof *g.degree)};
    bool good = true;
    for (; g.below < nodes && good; g.below++) {
        nh_ex part = node[g.below];
        nh_num degree = nh_num_int(among(part, n, symbol));
        if (nh_kind_of(dag, part) == NH_SUM || nh_kind_of(dag, part) == NH_PRODUCT)
            good = degree_of_parts(&g, part, &degree);
        g.degree[g.below] = degree;
    }
    if (good) *k = g.degree[nodes - 1], *e = varying;
    nh_free(g.degree);
    nh_nodes_free(&node);
    return good;
}

/* ---- for all values of the parameters ---- */

/* Of the Lagrangian with parameters as symbols: the entries of the inertia, and the potential. */
typedef struct {
    nh_ex inertia[NH_DARBOUX_MOST * NH_DARBOUX_MOST], potential;
} family;

static bool read_family(const nh_darboux_work *w, const nh_system *system, family *f)
{
    nh_dag *dag = w->dag;
    nh_ex zero[NH_DARBOUX_MOST];
    for (size_t i = 0; i < w->n; i++) zero[i] = nh_int(dag, 0);
    for (size_t i = 0; i < w->n; i++) {
        nh_ex momentum = nh_diff(dag, system->lagrangian, w->v[i]);
        for (size_t j = 0; j < w->n; j++) {
            nh_ex entry = nh_simplify_short(dag, nh_diff(dag, momentum, w->v[j]), 0);
            for (size_t l = 0; l < w->n; l++)
                if (nh_depends(dag, entry, w->q[l]) || nh_depends(dag, entry, w->v[l])) return false;
            if (nh_depends(dag, entry, system->t)) return false;
            f->inertia[i * w->n + j] = entry;
        }
        if (nh_normal_is_zero(dag, nh_substitute(dag, momentum, w->n, w->v, zero), 0) != NH_ZERO) return false;
    }
    f->potential = nh_neg(dag, nh_substitute(dag, system->lagrangian, w->n, w->v, zero));
    return true;
}

/* Is V(q) algebraic, and of the same degree for all values? */
static bool homogeneous(const nh_darboux_work *w, const nh_system *system, family *f)
{
    size_t all = w->n + system->parameters;
    bool roots = false;
    nh_num k;
    nh_ex *symbol = nh_alloc_array(all + 1, sizeof *symbol);
    for (size_t i = 0; i < all; i++) symbol[i] = i < w->n ? w->q[i] : system->parameter[i - w->n].symbol;
    bool good = nh_darboux_algebraic(w->dag, all, symbol, f->potential, &roots) &&
                nh_darboux_degree(w->dag, w->n, w->q, &f->potential, &k) && nh_num_is(k, w->out->degree);
    nh_free(symbol);
    return good;
}

/* Is V'(c) a multiple of M c for all values? */
static bool line_for_all(const nh_darboux_work *w, const family *f)
{
    nh_dag *dag = w->dag;
    nh_ex c[NH_DARBOUX_MOST], slope[NH_DARBOUX_MOST], momentum[NH_DARBOUX_MOST];
    for (size_t i = 0; i < w->n; i++) c[i] = w->line[i];
    if (w->triangle && !nh_darboux_triangle_place(dag, w->n, f->inertia, c)) return false;
    for (size_t i = 0; i < w->n; i++) {
        slope[i] = nh_substitute(dag, nh_diff(dag, f->potential, w->q[i]), w->n, w->q, c);
        momentum[i] = nh_int(dag, 0);
        for (size_t j = 0; j < w->n; j++)
            momentum[i] = nh_add(dag, momentum[i], nh_mul(dag, f->inertia[i * w->n + j], c[j]));
    }
    for (size_t i = 0; i < w->n; i++)
        for (size_t j = 0; j < i; j++) {
            nh_ex turn = nh_sub(dag, nh_mul(dag, slope[i], momentum[j]), nh_mul(dag, slope[j], momentum[i]));
            if (nh_normal_is_zero(dag, turn, 0) != NH_ZERO) return false;
        }
    return true;
}

bool nh_darboux_generic(const nh_darboux_work *w, const nh_system *system)
{
    family f;
    if (!read_family(w, system, &f) || !homogeneous(w, system, &f)) return false;
    if (!w->plane) return line_for_all(w, &f);
    return nh_monomials_has_degree(w->dag, f.potential, w->q[0]) &&
           nh_monomials_has_degree(w->dag, f.potential, w->q[1]);
}
