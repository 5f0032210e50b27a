/* node: what an expression consists of. */
#ifndef NH_NODE_H
#define NH_NODE_H

#include <string.h>

#include "graph/expr.h"

/* The nodes of a graph, for the functions below, which are called so often that they are inline. */
typedef struct {
    uint8_t kind, op;      /* op: the function */
    uint32_t count, first; /* arguments: arg[first .. first+count-1] */
    uint32_t next;         /* hash chain: index + 1 */
    uint64_t hash, mask;
} nh_node;

typedef struct {
    nh_node *node;
    uint32_t *arg; /* sums: constant, term, coefficient, ...; products: coefficient, base, exponent, ... */
} nh_dag_nodes;    /* a graph begins with it */

static inline const nh_node *nh_node_of(const nh_dag *dag, nh_ex e) { return ((const nh_dag_nodes *)dag)->node + e; }

/* The i-th of its arguments. */
static inline nh_ex nh_argument_of(const nh_dag *dag, nh_ex e, size_t i)
{
    const nh_dag_nodes *all = (const nh_dag_nodes *)dag;
    return all->arg[all->node[e].first + i];
}

/* Properties of a node. */
static inline nh_kind nh_kind_of(const nh_dag *dag, nh_ex e) { return (nh_kind)nh_node_of(dag, e)->kind; }

/* Of a number. */
static inline nh_num nh_number_of(const nh_dag *dag, nh_ex e)
{
    const uint32_t *word = ((const nh_dag_nodes *)dag)->arg + nh_node_of(dag, e)->first;
    nh_num value;
    memcpy(&value.p, word, 8);
    memcpy(&value.q, word + 2, 8);
    memcpy(&value.d, word + 4, 8);
    return value;
}

const char *nh_name_of(const nh_dag *dag, nh_ex e); /* of a symbol */

/* Sum: number of terms besides the constant; product: number of factors; function: number of arguments. */
static inline size_t nh_arity(const nh_dag *dag, nh_ex e)
{
    const nh_node *n = nh_node_of(dag, e);
    if (n->kind == NH_FUNCTION) return n->count;
    return n->kind == NH_SUM || n->kind == NH_PRODUCT ? n->count / 2 : 0;
}

/* The constant of a sum, the coefficient of a product. */
static inline nh_num nh_constant_of(const nh_dag *dag, nh_ex e) { return nh_number_of(dag, nh_argument_of(dag, e, 0)); }

/* Term, base of a factor, or argument. */
static inline nh_ex nh_child(const nh_dag *dag, nh_ex e, size_t i)
{
    return nh_argument_of(dag, e, nh_kind_of(dag, e) == NH_FUNCTION ? i : 1 + 2 * i);
}

/* Of the i-th term of a sum. */
static inline nh_num nh_coefficient_of(const nh_dag *dag, nh_ex e, size_t i)
{
    return nh_number_of(dag, nh_argument_of(dag, e, 2 + 2 * i));
}

/* Of the i-th factor of a product. */
static inline nh_ex nh_exponent_of(const nh_dag *dag, nh_ex e, size_t i) { return nh_argument_of(dag, e, 2 + 2 * i); }

/* Declares a list of expressions, `nh_ex *name`, which is freed where its scope ends.  It is empty, and as long as what
 * the functions below put into it. */
#define NH_LIST(name) __attribute__((cleanup(nh_nodes_free))) nh_ex *name = NULL
void nh_nodes_free(nh_ex **list);
/* All symbols that occur in e, ascending; returns their number.  *list is a list, or NULL at first; what was in it is
 * gone. */
size_t nh_symbols_in(const nh_dag *dag, nh_ex e, nh_ex **list);
/* The function calls that occur in e, likewise. */
size_t nh_functions_in(const nh_dag *dag, nh_ex e, nh_ex **list);
/* The products that occur in e, likewise; powers are products as well. */
size_t nh_products_in(const nh_dag *dag, nh_ex e, nh_ex **list);
/* The bases of half powers likewise, each once: u of sqrt(u), of u^(-1/2), of u^(3/2). */
size_t nh_radicands_in(const nh_dag *dag, nh_ex e, nh_ex **list);
/* The nodes below n expressions and these themselves, each once, ascending: children first.  The caller frees them. */
size_t nh_nodes_in(const nh_dag *dag, size_t n, const nh_ex *e, nh_ex **out);
/* Their number for one expression. */
size_t nh_node_count(const nh_dag *dag, nh_ex e);

#endif
