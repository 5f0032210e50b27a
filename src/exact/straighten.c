#include "exact/straighten.h"

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/dag_internal.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_sums = 40, least_sums = 3 };

typedef struct {
    nh_dag *dag;
    size_t sums, used;
    nh_ex sum[most_sums], used_symbol[most_sums];
} lines;

static bool is_in(size_t n, const nh_ex *list, nh_ex e)
{
    bool found = false;
    for (size_t i = 0; i < n && !found; i++) found = list[i] == e;
    return found;
}

/* Adds e, without a number in front of it, to the sums if it is a sum of symbols times numbers. */
static void take_sum(lines *l, nh_ex e)
{
    nh_dag *d = l->dag;
    bool factor = nh_kind_of(d, e) == NH_PRODUCT && nh_arity(d, e) == 1 && nh_is_number(d, nh_exponent_of(d, e, 0), 1);
    if (factor) e = nh_child(d, e, 0);
    bool sum = nh_kind_of(d, e) == NH_SUM && nh_arity(d, e) > 1;
    for (size_t i = 0; sum && i < nh_arity(d, e); i++)
        sum = nh_kind_of(d, nh_child(d, e, i)) == NH_SYMBOL && nh_num_short(nh_coefficient_of(d, e, i));
    if (sum && l->sums < most_sums && !is_in(l->sums, l->sum, e)) l->sum[l->sums++] = e;
}

static void collect(lines *l, nh_ex e)
{
    nh_dag *d = l->dag;
    NH_LIST(found);
    size_t n = nh_functions_in(d, e, &found);
    for (size_t i = 0; i < n; i++) {
        nh_function f = nh_function_of(d, found[i]);
        if (f == NH_SIN || f == NH_COS || f == NH_TAN || f == NH_SINH || f == NH_COSH || f == NH_TANH || f == NH_EXP)
            take_sum(l, nh_child(d, found[i], 0));
    }
    n = nh_products_in(d, e, &found);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < nh_arity(d, found[i]); k++) {
            nh_ex exponent = nh_exponent_of(d, found[i], k);
            if (nh_kind_of(d, exponent) == NH_NUMBER && nh_num_value(nh_number_of(d, exponent)) < 0)
                take_sum(l, nh_child(d, found[i], k));
        }
}

/* s := (s - rest)/c turns the sum c s + rest into s, for a symbol s that no sum before has become.  False: all of its
   symbols have. */
static bool replacement(lines *l, nh_ex sum, size_t constants, const nh_ex *constant, nh_ex *symbol, nh_ex *value)
{
    nh_dag *d = l->dag;
    for (size_t i = 0; i < nh_arity(d, sum); i++) {
        nh_ex s = nh_child(d, sum, i), c = nh_number(d, nh_coefficient_of(d, sum, i));
        if (is_in(l->used, l->used_symbol, s) || is_in(constants, constant, s)) continue;
        *symbol = s;
        *value = nh_div(d, nh_sub(d, s, nh_sub(d, sum, nh_mul(d, c, s))), c);
        return true;
    }
    return false;
}

bool nh_straighten(nh_dag *d, size_t n, nh_ex *e, size_t constants, const nh_ex *constant)
{
    lines l = {.dag = d};
    if (d->power_count) return false; /* symbols that satisfy something are no free variables */
    for (size_t i = 0; i < n; i++) collect(&l, e[i]);
    if (l.sums < least_sums) return false;
    for (size_t k = 0; k < l.sums; k++) {
        nh_ex sum = l.sum[k], symbol, value;
        if (nh_kind_of(d, sum) == NH_SYMBOL) l.used_symbol[l.used++] = sum;
        if (nh_kind_of(d, sum) != NH_SUM || !replacement(&l, sum, constants, constant, &symbol, &value)) continue;
        l.used_symbol[l.used++] = symbol;
        for (size_t i = k + 1; i < l.sums; i++) l.sum[i] = nh_substitute(d, l.sum[i], 1, &symbol, &value);
        for (size_t i = 0; i < n; i++) e[i] = nh_substitute(d, e[i], 1, &symbol, &value);
    }
    return true;
}
