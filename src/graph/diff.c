#include "graph/diff.h"

#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/dag_internal.h"
#include "graph/function.h"
#include "graph/named_function.h"
#include "graph/node.h"
#include "graph/num.h"

/* ---- the memo: open addressing on (e, x) ---- */

static nh_diff_memo *memo_slot(nh_diff_memo *memo, size_t capacity, uint64_t key)
{
    size_t i = (size_t)(key * 0x9e3779b97f4a7c15u >> 20) & (capacity - 1);
    while (memo[i].key && memo[i].key != key) i = (i + 1) & (capacity - 1);
    return &memo[i];
}

static void memo_grow(nh_dag *dag)
{
    size_t capacity = dag->memo_capacity ? 2 * dag->memo_capacity : 1024;
    nh_diff_memo *memo = nh_alloc_array(capacity, sizeof *memo);
    for (size_t i = 0; i < dag->memo_capacity; i++)
        if (dag->memo[i].key) *memo_slot(memo, capacity, dag->memo[i].key) = dag->memo[i];
    nh_free(dag->memo);
    dag->memo = memo;
    dag->memo_capacity = capacity;
}

static uint64_t memo_key(nh_ex e, nh_ex x) { return ((uint64_t)e << 32 | x) + 1; }

static bool memo_get(const nh_dag *dag, nh_ex e, nh_ex x, nh_ex *out)
{
    if (!dag->memo_capacity) return false;
    const nh_diff_memo *slot = memo_slot(dag->memo, dag->memo_capacity, memo_key(e, x));
    *out = slot->value;
    return slot->key != 0;
}

static void memo_put(nh_dag *dag, nh_ex e, nh_ex x, nh_ex value)
{
    if (2 * (dag->memo_count + 1) > dag->memo_capacity) memo_grow(dag);
    nh_diff_memo *slot = memo_slot(dag->memo, dag->memo_capacity, memo_key(e, x));
    if (!slot->key) dag->memo_count++;
    *slot = (nh_diff_memo){memo_key(e, x), value};
}

void nh_diff_rule(nh_dag *dag, nh_ex u, nh_ex x, nh_ex value)
{
    nh_grow(&dag->rule, &dag->rule_capacity, dag->rule_count + 1, sizeof *dag->rule);
    dag->rule[dag->rule_count++] = (nh_diff_rule_entry){u, x, value};
    if (dag->memo_capacity) memset(dag->memo, 0, dag->memo_capacity * sizeof *dag->memo);
    dag->memo_count = 0;
}

/* ---- derivatives of single functions ---- */

static nh_ex square(nh_dag *d, nh_ex a) { return nh_powi(d, a, 2); }
static nh_ex one_plus(nh_dag *d, int sign, nh_ex a2) { return nh_add(d, nh_int(d, 1), nh_mul(d, nh_int(d, sign), a2)); }
static nh_ex inverse(nh_dag *d, nh_ex a) { return nh_powi(d, a, -1); }
static nh_ex inverse_sqrt(nh_dag *d, nh_ex a) { return nh_pow(d, a, nh_ratio(d, -1, 2)); }

/* f'(a); `e` is f(a) itself. */
static nh_ex outer(nh_dag *d, nh_function f, nh_ex e, nh_ex a)
{
    switch (f) {
    case NH_SIN: return nh_call(d, NH_COS, a);
    case NH_COS: return nh_neg(d, nh_call(d, NH_SIN, a));
    case NH_TAN: return one_plus(d, 1, square(d, e));
    case NH_ASIN: return inverse_sqrt(d, one_plus(d, -1, square(d, a)));
    case NH_ACOS: return nh_neg(d, inverse_sqrt(d, one_plus(d, -1, square(d, a))));
    case NH_ATAN: return inverse(d, one_plus(d, 1, square(d, a)));
    case NH_SINH: return nh_call(d, NH_COSH, a);
    case NH_COSH: return nh_call(d, NH_SINH, a);
    case NH_TANH: return one_plus(d, -1, square(d, e));
    case NH_ASINH: return inverse_sqrt(d, one_plus(d, 1, square(d, a)));
    case NH_ACOSH:
        return nh_mul(d, inverse_sqrt(d, nh_add(d, a, nh_int(d, -1))), inverse_sqrt(d, nh_add(d, a, nh_int(d, 1))));
    case NH_ATANH: return inverse(d, one_plus(d, -1, square(d, a)));
    case NH_EXP: return e;
    case NH_LOG: return inverse(d, a);
    case NH_ABS: return nh_call(d, NH_SIGN, a);
    default: return nh_int(d, 0); /* sign: zero away from its jump; pi */
    }
}

/* d atan2(y, x) = (x dy - y dx)/(x^2 + y^2) */
static nh_ex angle(nh_dag *d, nh_ex e, size_t i)
{
    nh_ex y = nh_child(d, e, 0), x = nh_child(d, e, 1);
    return nh_div(d, i ? nh_neg(d, y) : x, nh_add(d, square(d, y), square(d, x)));
}

nh_ex nh_diff_argument(nh_dag *d, nh_ex e, size_t i)
{
    nh_function f = nh_function_of(d, e);
    if (f == NH_ATAN2) return angle(d, e, i);
    return nh_is_named_function(f) ? nh_named_function_rate(d, e, i) : outer(d, f, e, nh_child(d, e, i));
}

static nh_ex diff_function(nh_dag *d, nh_ex e, nh_ex x)
{
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex da = nh_diff(d, nh_child(d, e, i), x);
        if (!nh_is_zero(d, da)) sum = nh_add(d, sum, nh_mul(d, nh_diff_argument(d, e, i), da));
    }
    return sum;
}

/* (b^y)' / b^y * ... : the derivative of one factor b^y, written without dividing by b. */
static nh_ex diff_factor(nh_dag *d, nh_ex b, nh_ex y, nh_ex x)
{
    nh_ex db = nh_diff(d, b, x), dy = nh_diff(d, y, x);
    nh_ex result = nh_int(d, 0);
    if (!nh_is_zero(d, db)) {
        nh_ex lower = nh_pow(d, b, nh_add(d, y, nh_int(d, -1)));
        result = nh_mul(d, nh_mul(d, y, lower), db);
    }
    if (!nh_is_zero(d, dy)) {
        nh_ex term = nh_mul(d, nh_mul(d, nh_pow(d, b, y), nh_call(d, NH_LOG, b)), dy);
        result = nh_add(d, result, term);
    }
    return result;
}

/* (c prod f)' = sum of (c prod f) f'/f; the factor f cancels exactly in the canonical form. */
static nh_ex diff_product(nh_dag *d, nh_ex e, nh_ex x)
{
    size_t n = nh_arity(d, e);
    nh_ex *term = nh_alloc_array(n, sizeof *term);
    nh_num *unit = nh_alloc_array(n, sizeof *unit);
    for (size_t i = 0; i < n; i++) {
        unit[i] = nh_num_int(1);
        nh_ex b = nh_child(d, e, i), y = nh_exponent_of(d, e, i);
        nh_ex df = diff_factor(d, b, y, x);
        term[i] = nh_is_zero(d, df) ? df : nh_product(d, 3, (nh_ex[]){e, nh_pow(d, b, nh_neg(d, y)), df});
    }
    nh_ex result = nh_linear(d, n, unit, term);
    nh_free(unit);
    nh_free(term);
    return result;
}

static nh_ex diff_sum(nh_dag *d, nh_ex e, nh_ex x)
{
    size_t n = nh_arity(d, e);
    nh_ex *term = nh_alloc_array(n, sizeof *term);
    nh_num *c = nh_alloc_array(n, sizeof *c);
    for (size_t i = 0; i < n; i++) {
        c[i] = nh_coefficient_of(d, e, i);
        term[i] = nh_diff(d, nh_child(d, e, i), x);
    }
    nh_ex result = nh_linear(d, n, c, term);
    nh_free(c);
    nh_free(term);
    return result;
}

static nh_ex diff_symbol(const nh_dag *d, nh_ex u, nh_ex x)
{
    for (size_t i = 0; i < d->rule_count; i++)
        if (d->rule[i].u == u && d->rule[i].x == x) return d->rule[i].value;
    return 0; /* node 0 is the number 0 */
}

/* With rules, an expression without x may depend on it through an implicit symbol. */
static bool constant_in(const nh_dag *d, nh_ex e, nh_ex x)
{
    uint64_t mask = d->all.node[e].mask;
    if (mask & d->all.node[x].mask) return false;
    for (size_t i = 0; i < d->rule_count; i++)
        if (d->rule[i].x == x && (mask & d->all.node[d->rule[i].u].mask)) return false;
    return true;
}

/* The derivative, if it is known without computing that of a child; otherwise false. */
static bool known(const nh_dag *dag, nh_ex e, nh_ex x, nh_ex *out)
{
    *out = e == x; /* the nodes 0 and 1 are the numbers 0 and 1 */
    if (e == x || constant_in(dag, e, x)) return true;
    if (nh_kind_of(dag, e) != NH_SYMBOL) return memo_get(dag, e, x, out);
    *out = diff_symbol(dag, e, x);
    return true;
}

typedef struct {
    nh_ex *list;
    size_t count, capacity;
} todo;

/* Adds the nodes that e needs and that are not known yet; returns whether there are any. */
static bool push_needed(const nh_dag *dag, todo *t, nh_ex e, nh_ex x)
{
    size_t before = t->count;
    const nh_node *n = &dag->all.node[e];
    for (uint32_t i = 0; i < n->count; i++) {
        nh_ex child = dag->all.arg[n->first + i], ignored;
        if (known(dag, child, x, &ignored)) continue;
        nh_grow(&t->list, &t->capacity, t->count + 1, sizeof *t->list);
        t->list[t->count++] = child;
    }
    return t->count > before;
}

/* d e/d x of a node whose children are known. */
static nh_ex diff_node(nh_dag *dag, nh_ex e, nh_ex x)
{
    switch (nh_kind_of(dag, e)) {
    case NH_SUM: return diff_sum(dag, e, x);
    case NH_PRODUCT: return diff_product(dag, e, x);
    default: return diff_function(dag, e, x);
    }
}

/* With a stack of its own: expressions may be deeper than the machine's stack. */
nh_ex nh_diff(nh_dag *dag, nh_ex e, nh_ex x)
{
    nh_ex result;
    if (known(dag, e, x, &result)) return result;
    todo t = {0};
    nh_grow(&t.list, &t.capacity, 1, sizeof *t.list);
    t.list[t.count++] = e;
    while (t.count) {
        nh_ex top = t.list[t.count - 1];
        if (push_needed(dag, &t, top, x)) continue;
        t.count--;
        if (!known(dag, top, x, &result)) memo_put(dag, top, x, diff_node(dag, top, x));
    }
    nh_free(t.list);
    known(dag, e, x, &result);
    return result;
}

nh_ex nh_diff_along(nh_dag *dag, nh_ex e, size_t n, const nh_ex *symbol, const nh_ex *component)
{
    nh_ex *term = nh_alloc_array(n + 1, sizeof *term);
    nh_num *unit = nh_alloc_array(n + 1, sizeof *unit);
    for (size_t i = 0; i < n; i++) {
        unit[i] = nh_num_int(1);
        if (!nh_is_zero(dag, component[i])) term[i] = nh_mul(dag, component[i], nh_diff(dag, e, symbol[i]));
    }
    nh_ex result = nh_linear(dag, n, unit, term); /* terms left out are node 0, the number 0 */
    nh_free(unit);
    nh_free(term);
    return result;
}
