#include "expr/lift.h"

#include <math.h>

#include "base/memory.h"

static nh_ex number(nh_dag *d, nh_num x, nh_lifted *table)
{
    if (nh_num_exact(x)) return nh_number(d, x);
    double size = fabs(nh_num_value(x));
    size_t i = 0;
    while (i < table->count && table->value[i] != size) i++;
    if (i == NH_MOST_LIFTED) {
        table->overflow = true;
        return nh_number(d, x);
    }
    if (i == table->count) {
        table->value[i] = size;
        table->symbol[i] = nh_symbol_fresh(d, "theta");
        table->count++;
    }
    return nh_num_value(x) < 0 ? nh_neg(d, table->symbol[i]) : table->symbol[i];
}

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
