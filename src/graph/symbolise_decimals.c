#include "graph/symbolise_decimals.h"

#include <math.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

/* The symbol of |value|, with its sign; `exact` is the same number.  The exponent 1/2 of a root and a rate 1/2 get
 * different symbols. */
static nh_ex symbol_of(nh_dag *d, double value, nh_ex exact, bool exponent, nh_lifted *table)
{
    double size = fabs(value);
    size_t i = 0;
    while (i < table->count && (table->value[i] != size || table->exponent[i] != exponent)) i++;
    if (i == NH_MOST_LIFTED) {
        table->overflow = true;
        return exact;
    }
    if (i == table->count) {
        table->value[i] = size;
        table->exponent[i] = exponent;
        table->exact[i] = value < 0 ? nh_neg(d, exact) : exact;
        table->symbol[i] = nh_symbol_fresh(d, "theta");
        table->count++;
    }
    return value < 0 ? nh_neg(d, table->symbol[i]) : table->symbol[i];
}

static nh_ex number(nh_dag *d, nh_num x, nh_lifted *table)
{
    nh_ex e = nh_number(d, x);
    return nh_num_exact(x) ? e : symbol_of(d, nh_num_value(x), e, false, table);
}

static nh_ex lift(nh_dag *d, nh_ex e, nh_lifted *table, nh_ex *image, bool *done)
{
    nh_kind kind = nh_kind_of(d, e);
    if (kind == NH_SYMBOL) return e;
    if (kind == NH_NUMBER) return number(d, nh_number_of(d, e), table);
    if (done[e]) return image[e];
    size_t n = nh_arity(d, e);
    nh_ex child[NH_MOST_ARGUMENTS] = {0}, out = kind == NH_FUNCTION ? 0 : number(d, nh_constant_of(d, e), table);
    for (size_t i = 0; i < n; i++) {
        nh_ex x = lift(d, nh_child(d, e, i), table, image, done);
        if (kind == NH_SUM) out = nh_add(d, out, nh_mul(d, number(d, nh_coefficient_of(d, e, i), table), x));
        else if (kind == NH_PRODUCT)
            out = nh_mul(d, out, nh_pow(d, x, lift(d, nh_exponent_of(d, e, i), table, image, done)));
        else child[i] = x;
    }
    if (kind == NH_FUNCTION) out = nh_call_any(d, nh_function_of(d, e), child);
    done[e] = true;
    return image[e] = out;
}

nh_ex nh_symbolise_decimals(nh_dag *d, nh_ex e, nh_lifted *table)
{
    nh_ex *image = nh_alloc_array((size_t)e + 1, sizeof *image);
    bool *done = nh_alloc_array((size_t)e + 1, sizeof *done);
    nh_ex out = lift(d, e, table, image, done);
    nh_free(done);
    nh_free(image);
    return out;
}

/* ---- numbers in arguments and exponents ---- */

typedef struct {
    nh_dag *dag;
    nh_symbolise_decimals_kind kind;
    size_t constants;
    const nh_ex *constant;
    nh_lifted *table;
} inside;

static nh_ex factor(const inside *s, double value, nh_ex exact, bool exponent)
{
    double step = s->kind == NH_SYMBOLISE_DECIMALS_ROUGH ? 2 : 1;
    bool meant = (s->kind == NH_SYMBOLISE_DECIMALS_ALL && !exponent) || step * value != round(step * value);
    return meant && value != 0 && isfinite(value) ? symbol_of(s->dag, value, exact, exponent, s->table) : exact;
}

/* Is it made of constants and numbers alone? */
static bool is_constant(const inside *s, nh_ex e)
{
    NH_LIST(symbol);
    size_t n = nh_symbols_in(s->dag, e, &symbol);
    for (size_t i = 0; i < n; i++) {
        size_t k = 0;
        while (k < s->constants && s->constant[k] != symbol[i]) k++;
        if (k == s->constants) return false;
    }
    return true;
}

static nh_ex lift_inside(const inside *s, nh_ex e);

/* Splits c sqrt(5) t into the number and the rest. */
static nh_ex lift_product(const inside *s, nh_ex e)
{
    nh_dag *d = s->dag;
    nh_num c = nh_constant_of(d, e);
    nh_ex exact = nh_number(d, c), rest = nh_int(d, 1);
    double value = nh_num_value(c);
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex base = nh_child(d, e, i), exponent = nh_exponent_of(d, e, i), power = nh_pow(d, base, exponent);
        if (nh_kind_of(d, base) == NH_NUMBER && nh_kind_of(d, exponent) == NH_NUMBER) {
            exact = nh_mul(d, exact, power);
            value *= pow(nh_num_value(nh_number_of(d, base)), nh_num_value(nh_number_of(d, exponent)));
        } else {
            rest = nh_mul(d, rest, power);
        }
    }
    return nh_mul(d, factor(s, value, exact, false), lift_inside(s, rest));
}

/* sum_i c_i t_i with symbols for the c_i. */
static nh_ex lift_argument(const inside *s, nh_ex a)
{
    nh_dag *d = s->dag;
    nh_kind kind = nh_kind_of(d, a);
    if (is_constant(s, a)) return a;
    if (kind == NH_PRODUCT) return lift_product(s, a);
    if (kind != NH_SUM) return nh_mul(d, factor(s, 1, nh_int(d, 1), false), lift_inside(s, a));
    nh_ex out = nh_number(d, nh_constant_of(d, a));
    for (size_t i = 0; i < nh_arity(d, a); i++) {
        nh_ex term = nh_mul(d, nh_number(d, nh_coefficient_of(d, a, i)), nh_child(d, a, i));
        out = nh_add(d, out, lift_argument(s, term));
    }
    return out;
}

static bool has_rates(nh_function f)
{
    return f == NH_EXP || f == NH_SIN || f == NH_COS || f == NH_TAN || f == NH_SINH || f == NH_COSH || f == NH_TANH;
}

static nh_ex lift_power(const inside *s, nh_ex base, nh_ex exponent)
{
    nh_dag *d = s->dag;
    bool plain = nh_kind_of(d, exponent) == NH_NUMBER;
    nh_ex lifted =
        plain ? factor(s, nh_num_value(nh_number_of(d, exponent)), exponent, true) : lift_inside(s, exponent);
    return nh_pow(d, lift_inside(s, base), lifted);
}

static nh_ex lift_inside(const inside *s, nh_ex e)
{
    nh_dag *d = s->dag;
    nh_kind kind = nh_kind_of(d, e);
    if (kind == NH_SYMBOL || kind == NH_NUMBER || is_constant(s, e)) return e;
    size_t n = nh_arity(d, e);
    if (kind == NH_FUNCTION && n == 1) {
        nh_function f = nh_function_of(d, e);
        nh_ex a = nh_child(d, e, 0);
        return nh_call(d, f, has_rates(f) ? lift_argument(s, a) : lift_inside(s, a));
    }
    if (kind == NH_FUNCTION) return e;
    nh_ex out = nh_number(d, nh_constant_of(d, e));
    for (size_t i = 0; i < n; i++) {
        if (kind == NH_PRODUCT) out = nh_mul(d, out, lift_power(s, nh_child(d, e, i), nh_exponent_of(d, e, i)));
        else
            out =
                nh_add(d, out, nh_mul(d, nh_number(d, nh_coefficient_of(d, e, i)), lift_inside(s, nh_child(d, e, i))));
    }
    return out;
}

nh_ex nh_symbolise_decimals_inside(nh_dag *d, nh_ex e, nh_symbolise_decimals_kind kind, size_t constants,
                                   const nh_ex *constant, nh_lifted *table)
{
    inside s = {.dag = d, .kind = kind, .constants = constants, .constant = constant, .table = table};
    return lift_inside(&s, e);
}
