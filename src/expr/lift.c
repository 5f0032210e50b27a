#include "expr/lift.h"

#include <math.h>

#include "base/memory.h"

/* The symbol of |x|, with its sign. */
static nh_ex symbol_of(nh_dag *d, nh_num x, nh_lifted *table)
{
    double size = fabs(nh_num_value(x));
    bool minus = nh_num_value(x) < 0;
    size_t i = 0;
    while (i < table->count && table->value[i] != size) i++;
    if (i == NH_MOST_LIFTED) {
        table->overflow = true;
        return nh_number(d, x);
    }
    if (i == table->count) {
        table->value[i] = size;
        table->exact[i] = minus ? nh_num_mul(x, nh_num_int(-1)) : x;
        table->symbol[i] = nh_symbol_fresh(d, "theta");
        table->count++;
    }
    return minus ? nh_neg(d, table->symbol[i]) : table->symbol[i];
}

static nh_ex number(nh_dag *d, nh_num x, nh_lifted *table) { return nh_num_exact(x) ? nh_number(d, x) : symbol_of(d, x, table); }

static nh_ex lift(nh_dag *d, nh_ex e, nh_lifted *table, nh_ex *image, bool *done)
{
    nh_kind kind = nh_kind_of(d, e);
    if (kind == NH_SYMBOL) return e;
    if (kind == NH_NUMBER) return number(d, nh_number_of(d, e), table);
    if (done[e]) return image[e];
    size_t n = nh_arity(d, e);
    nh_ex child[2] = {0}, out = kind == NH_FUNCTION ? 0 : number(d, nh_constant_of(d, e), table);
    for (size_t i = 0; i < n; i++) {
        nh_ex x = lift(d, nh_child(d, e, i), table, image, done);
        if (kind == NH_SUM) out = nh_add(d, out, nh_mul(d, number(d, nh_coefficient_of(d, e, i), table), x));
        else if (kind == NH_PRODUCT) out = nh_mul(d, out, nh_pow(d, x, lift(d, nh_exponent_of(d, e, i), table, image, done)));
        else child[i] = x;
    }
    if (kind == NH_FUNCTION) out = n == 2 ? nh_call2(d, nh_function_of(d, e), child[0], child[1]) : n == 1 ? nh_call(d, nh_function_of(d, e), child[0]) : e;
    done[e] = true;
    return image[e] = out;
}

nh_ex nh_lift(nh_dag *d, nh_ex e, nh_lifted *table)
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
    nh_lift_kind kind;
    size_t constants;
    const nh_ex *constant;
    nh_lifted *table;
} inside;

static bool is_meant(nh_lift_kind kind, nh_num x, bool exponent)
{
    double v = nh_num_value(x), step = kind == NH_LIFT_ROUGH ? 2 : 1;
    if (v == 0 || !isfinite(v)) return false;
    return (kind == NH_LIFT_ALL && !exponent) || step * v != round(step * v);
}

static nh_ex factor(const inside *s, nh_num x, bool exponent)
{
    return is_meant(s->kind, x, exponent) ? symbol_of(s->dag, x, s->table) : nh_number(s->dag, x);
}

/* Nothing but constants, and numbers. */
static bool is_constant(const inside *s, nh_ex e)
{
    enum { most = 64 };
    nh_ex symbol[most];
    size_t n = nh_symbols_in(s->dag, e, symbol, most);
    for (size_t i = 0; i < n && i < most; i++) {
        size_t k = 0;
        while (k < s->constants && s->constant[k] != symbol[i]) k++;
        if (k == s->constants) return false;
    }
    return n <= most;
}

static nh_ex lift_inside(const inside *s, nh_ex e);

/* sum_i c_i t_i with symbols for the c_i. */
static nh_ex lift_argument(const inside *s, nh_ex a)
{
    nh_dag *d = s->dag;
    nh_kind kind = nh_kind_of(d, a);
    if (is_constant(s, a)) return a;
    if (kind == NH_PRODUCT) {
        nh_num c = nh_constant_of(d, a);
        return nh_mul(d, factor(s, c, false), lift_inside(s, nh_mul(d, nh_number(d, nh_num_inv(c)), a)));
    }
    if (kind != NH_SUM) return nh_mul(d, factor(s, nh_num_int(1), false), lift_inside(s, a));
    nh_ex out = nh_number(d, nh_constant_of(d, a));
    for (size_t i = 0; i < nh_arity(d, a); i++) {
        nh_ex term = nh_mul(d, nh_number(d, nh_coefficient_of(d, a, i)), nh_child(d, a, i));
        out = nh_add(d, out, lift_argument(s, term));
    }
    return out;
}

static bool has_rates(nh_function f) { return f == NH_EXP || f == NH_SIN || f == NH_COS || f == NH_TAN || f == NH_SINH || f == NH_COSH || f == NH_TANH; }

static nh_ex lift_power(const inside *s, nh_ex base, nh_ex exponent)
{
    nh_dag *d = s->dag;
    bool plain = nh_kind_of(d, exponent) == NH_NUMBER;
    return nh_pow(d, lift_inside(s, base), plain ? factor(s, nh_number_of(d, exponent), true) : lift_inside(s, exponent));
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
        else out = nh_add(d, out, nh_mul(d, nh_number(d, nh_coefficient_of(d, e, i)), lift_inside(s, nh_child(d, e, i))));
    }
    return out;
}

nh_ex nh_lift_inside(nh_dag *d, nh_ex e, nh_lift_kind kind, size_t constants, const nh_ex *constant, nh_lifted *table)
{
    inside s = {.dag = d, .kind = kind, .constants = constants, .constant = constant, .table = table};
    return lift_inside(&s, e);
}
