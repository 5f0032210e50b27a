/* gradient: reverse accumulation.  The adjoint of a node is d e/d node; a node hands its adjoint, times the derivative
 * of the node with respect to the child, to each child.  Children have smaller indices than their parents, so one walk
 * downwards sees every adjoint complete. */
#include "graph/dag.h"
#include "graph/dag_internal.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

typedef struct {
    nh_ex term;
    size_t next; /* + 1 */
} share;

typedef struct {
    nh_dag *dag;
    bool *needed;  /* on the way from e to a symbol */
    size_t *first; /* per node: index of the first part of its adjoint, + 1 */
    share *list;
    size_t count, capacity;
} sweep;

static void give(sweep *s, nh_ex node, nh_ex term)
{
    if (!s->needed[node] || nh_is_zero(s->dag, term)) return;
    nh_grow(&s->list, &s->capacity, s->count + 1, sizeof *s->list);
    s->list[s->count] = (share){term, s->first[node]};
    s->first[node] = ++s->count;
}

static nh_ex adjoint(const sweep *s, nh_ex node)
{
    size_t n = 0, k = 0;
    for (size_t i = s->first[node]; i; i = s->list[i - 1].next) n++;
    nh_ex *term = nh_alloc_array(n + 1, sizeof *term);
    nh_num *unit = nh_alloc_array(n + 1, sizeof *unit);
    for (size_t i = s->first[node]; i; i = s->list[i - 1].next) {
        term[k] = s->list[i - 1].term;
        unit[k++] = nh_num_int(1);
    }
    nh_ex sum = nh_linear(s->dag, n, unit, term);
    nh_free(unit);
    nh_free(term);
    return sum;
}

/* c prod b^y: y (c prod b^y) / b for b, (c prod b^y) log b for y. */
static void spread_product(sweep *s, nh_ex node, nh_ex a)
{
    nh_dag *d = s->dag;
    for (size_t i = 0; i < nh_arity(d, node); i++) {
        nh_ex b = nh_child(d, node, i), y = nh_exponent_of(d, node, i);
        if (s->needed[b]) give(s, b, nh_product(d, 4, (nh_ex[]){a, y, node, nh_pow(d, b, nh_int(d, -1))}));
        if (s->needed[y]) give(s, y, nh_product(d, 3, (nh_ex[]){a, node, nh_call(d, NH_LOG, b)}));
    }
}

static void spread_function(sweep *s, nh_ex node, nh_ex a)
{
    nh_dag *d = s->dag;
    for (size_t i = 0; i < nh_arity(d, node); i++) {
        nh_ex x = nh_child(d, node, i);
        if (s->needed[x]) give(s, x, nh_mul(d, a, nh_diff_argument(d, node, i)));
    }
}

static void spread(sweep *s, nh_ex node)
{
    nh_dag *d = s->dag;
    nh_kind kind = nh_kind_of(d, node);
    nh_ex a = adjoint(s, node);
    if (nh_is_zero(d, a)) return;
    if (kind == NH_PRODUCT) spread_product(s, node, a);
    else if (kind == NH_FUNCTION) spread_function(s, node, a);
    else if (kind == NH_SUM)
        for (size_t i = 0; i < nh_arity(d, node); i++)
            give(s, nh_child(d, node, i), nh_mul(d, a, nh_number(d, nh_coefficient_of(d, node, i))));
}

/* The nodes at or below e that contain one of the symbols; by index, children first. */
static void mark(const sweep *s, nh_ex e, size_t n, const nh_ex *symbol)
{
    const nh_dag *d = s->dag;
    for (nh_ex x = 0; x <= e; x++) {
        nh_kind kind = nh_kind_of(d, x);
        for (size_t i = 0; i < n; i++) s->needed[x] |= symbol[i] == x;
        if (kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        for (size_t i = 0; i < nh_arity(d, x) && !s->needed[x]; i++) {
            s->needed[x] = s->needed[nh_child(d, x, i)];
            if (kind == NH_PRODUCT) s->needed[x] |= s->needed[nh_exponent_of(d, x, i)];
        }
    }
}

void nh_gradient(nh_dag *dag, nh_ex e, size_t n, const nh_ex *symbol, nh_ex *out)
{
    sweep s = {.dag = dag,
               .needed = nh_alloc_array((size_t)e + 1, sizeof(bool)),
               .first = nh_alloc_array((size_t)e + 1, sizeof(size_t))};
    mark(&s, e, n, symbol);
    give(&s, e, nh_int(dag, 1));
    for (size_t x = (size_t)e + 1; x-- > 0;)
        if (s.first[x]) spread(&s, (nh_ex)x);
    for (size_t i = 0; i < n; i++)
        out[i] = symbol[i] <= e && s.first[symbol[i]] ? adjoint(&s, symbol[i]) : nh_int(dag, 0);
    nh_free(s.needed);
    nh_free(s.first);
    nh_free(s.list);
}
