/* dag_substitution: an expression with other parts, in the same graph or in another one (dag.h). */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/dag_internal.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

/* The expression e of `from` with images in `dag` for its parts. */
static nh_ex rebuild_in(nh_dag *dag, const nh_dag *from, nh_ex e, const nh_ex *image)
{
    nh_kind kind = nh_kind_of(from, e);
    size_t n = nh_arity(from, e);
    if (kind == NH_FUNCTION) {
        nh_ex argument[NH_MOST_ARGUMENTS];
        for (size_t i = 0; i < n; i++) argument[i] = image[nh_child(from, e, i)];
        return nh_call_any(dag, nh_function_of(from, e), argument);
    }
    nh_ex *part = nh_alloc_array(n + 1, sizeof *part), result;
    nh_num *scale = nh_alloc_array(n + 1, sizeof *scale);
    for (size_t i = 0; i < n; i++) {
        part[i] = image[nh_child(from, e, i)];
        if (kind == NH_SUM) scale[i] = nh_coefficient_of(from, e, i);
        else part[i] = nh_pow(dag, part[i], image[nh_exponent_of(from, e, i)]);
    }
    part[n] = nh_number(dag, nh_constant_of(from, e));
    scale[n] = nh_num_int(1);
    result = kind == NH_SUM ? nh_linear(dag, n + 1, scale, part) : nh_product(dag, n + 1, part);
    nh_free(scale);
    nh_free(part);
    return result;
}

static nh_ex rebuild(nh_dag *dag, nh_ex e, const nh_ex *image) { return rebuild_in(dag, dag, e, image); }

void nh_dag_bring(nh_dag *dag, const nh_dag *copy, size_t n, nh_ex *e)
{
    nh_ex *node, *image = nh_alloc_array(copy->node_count, sizeof *image);
    size_t count = nh_nodes_in(copy, n, e, &node);
    for (size_t i = 0; i < count; i++) {
        nh_ex x = node[i];
        nh_kind kind = nh_kind_of(copy, x);
        if (x < copy->copied) image[x] = x;
        else if (kind == NH_NUMBER) image[x] = nh_number(dag, nh_number_of(copy, x));
        else if (kind == NH_SYMBOL) image[x] = nh_symbol_fresh(dag, nh_name_of(copy, x));
        else image[x] = rebuild_in(dag, copy, x, image);
    }
    for (size_t i = 0; i < n; i++) e[i] = image[e[i]];
    nh_free(image);
    nh_free(node);
}

nh_ex nh_substitute(nh_dag *dag, nh_ex e, size_t count, const nh_ex *from, const nh_ex *to)
{
    uint32_t *node;
    size_t n = nh_nodes_in(dag, 1, &e, &node);
    nh_ex *image = nh_alloc_array((size_t)e + 1, sizeof *image);
    for (size_t i = 0; i < n; i++) {
        nh_ex x = node[i];
        image[x] = x;
        bool replaced = false;
        for (size_t j = 0; j < count && !replaced; j++) {
            if (from[j] != x) continue;
            image[x] = to[j];
            replaced = true;
        }
        if (replaced || dag->all.node[x].kind <= NH_SYMBOL) continue;
        bool changed = false;
        const nh_node *y = &dag->all.node[x];
        for (uint32_t j = 0; j < y->count; j++) {
            nh_ex child = dag->all.arg[y->first + j];
            changed |= image[child] != child;
        }
        if (changed) image[x] = rebuild(dag, x, image);
    }
    nh_ex result = image[e];
    nh_free(image);
    nh_free(node);
    return result;
}

nh_ex nh_substitute_calls(nh_dag *dag, nh_ex e, nh_ex (*by)(void *context, nh_ex call), void *context)
{
    NH_LIST(call);
    size_t n = nh_functions_in(dag, e, &call), count = 0;
    nh_ex *value = nh_alloc_array(n + 1, sizeof *value);
    for (size_t i = 0; i < n; i++) {
        value[count] = by(context, call[i]);
        if (value[count] && value[count] != call[i]) call[count++] = call[i];
    }
    if (count) e = nh_substitute(dag, e, count, call, value);
    nh_free(value);
    return e;
}

static nh_ex substitute_root(nh_dag *dag, nh_ex e, nh_ex base, nh_ex root, int64_t most_order)
{
    uint32_t *node;
    size_t n = nh_nodes_in(dag, 1, &e, &node);
    nh_ex *image = nh_alloc_array((size_t)e + 1, sizeof *image);
    for (size_t i = 0; i < n; i++) {
        nh_ex x = node[i];
        image[x] = dag->all.node[x].kind > NH_SYMBOL ? rebuild(dag, x, image) : x;
        if (dag->all.node[x].kind != NH_PRODUCT) continue;
        nh_ex product = nh_number(dag, nh_constant_of(dag, x));
        for (size_t j = 0; j < nh_arity(dag, x); j++) {
            nh_ex b = nh_child(dag, x, j), y = nh_exponent_of(dag, x, j);
            nh_num power = dag->all.node[y].kind == NH_NUMBER ? nh_number_of(dag, y) : nh_num_int(1);
            bool rooted = b == base && power.q % 2 == 0 && power.q <= most_order;
            product = nh_mul(dag, product,
                             rooted ? nh_pow(dag, root, nh_ratio(dag, power.p, power.q / 2))
                                    : nh_pow(dag, image[b], image[y]));
        }
        image[x] = product;
    }
    nh_ex result = image[e];
    nh_free(image);
    nh_free(node);
    return result;
}

nh_ex nh_substitute_root(nh_dag *dag, nh_ex e, nh_ex base, nh_ex root)
{
    return substitute_root(dag, e, base, root, 2);
}

nh_ex nh_substitute_positive_root(nh_dag *dag, nh_ex e, nh_ex base, nh_ex root)
{
    return substitute_root(dag, e, base, root, INT64_MAX);
}
