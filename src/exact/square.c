#include "exact/square.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"

bool nh_square_split(nh_dag *d, nh_ex e, nh_ex *outside, nh_ex *inside)
{
    *outside = nh_int(d, 1);
    *inside = e;
    if (nh_kind_of(d, e) == NH_NUMBER) return nh_num_short(nh_number_of(d, e));
    if (nh_kind_of(d, e) != NH_PRODUCT) return true;
    nh_num number = nh_constant_of(d, e);
    if (!nh_num_short(number)) return false;
    *inside = nh_mul(d, nh_int(d, number.p), nh_int(d, number.q));
    *outside = nh_ratio(d, 1, number.q);
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex base = nh_child(d, e, i), x = nh_exponent_of(d, e, i);
        nh_num power = nh_kind_of(d, x) == NH_NUMBER ? nh_number_of(d, x) : nh_num_real(0.5);
        if (!nh_num_short(power) || power.q != 1) return false;
        int64_t half = power.p >= 0 ? power.p / 2 : -((1 - power.p) / 2), odd = power.p - 2 * half;
        *outside = nh_mul(d, *outside, nh_powi(d, base, half));
        if (odd) *inside = nh_mul(d, *inside, base);
    }
    return true;
}

bool nh_square_split_quotient(nh_dag *d, nh_ex e, nh_ex *outside, nh_ex *inside)
{
    nh_ex N = nh_numerator(d, e), D = nh_simplify_short(d, nh_div(d, N, e), 0);
    if (!nh_square_split(d, nh_simplify_short(d, nh_mul(d, N, D), 0), outside, inside)) return false;
    *outside = nh_simplify_short(d, nh_div(d, *outside, D), 0);
    return true;
}

typedef struct {
    nh_dag *d;
    size_t most;
    int (*sign)(void *context, nh_ex e);
    void *context;
} splitter;

/* sqrt(u^2 v w) as u sqrt(v) sqrt(w), with the signs of the factors. */
static bool split_root(const splitter *c, nh_ex base, nh_ex *root)
{
    nh_dag *d = c->d;
    nh_ex outside, inside, e = nh_simplify_short(d, base, c->most);
    if (nh_kind_of(d, e) != NH_PRODUCT || !nh_square_split(d, e, &outside, &inside)) return false;
    int sign = c->sign(c->context, outside);
    if (sign == 0) return false;
    *root = sign > 0 ? outside : nh_neg(d, outside);
    if (nh_kind_of(d, inside) != NH_PRODUCT) {
        *root = nh_mul(d, *root, nh_sqrt(d, inside));
        return true;
    }
    nh_ex number = nh_number(d, nh_constant_of(d, inside));
    for (size_t i = 0; i < nh_arity(d, inside); i++) {
        nh_ex factor = nh_pow(d, nh_child(d, inside, i), nh_exponent_of(d, inside, i));
        sign = c->sign(c->context, factor);
        if (sign == 0) return false;
        if (sign < 0) number = nh_neg(d, number);
        *root = nh_mul(d, *root, nh_sqrt(d, sign > 0 ? factor : nh_neg(d, factor)));
    }
    *root = nh_mul(d, *root, nh_sqrt(d, number));
    return nh_num_value(nh_number_of(d, number)) > 0;
}

nh_ex nh_square_roots(nh_dag *d, nh_ex e, size_t most_length, int (*sign)(void *context, nh_ex e), void *context)
{
    splitter c = {d, most_length, sign, context};
    NH_LIST(product);
    nh_ex root;
    size_t n = nh_products_in(d, e, &product);
    for (size_t i = 0; i < n; i++)
        for (size_t f = 0; f < nh_arity(d, product[i]); f++) {
            nh_ex base = nh_child(d, product[i], f), x = nh_exponent_of(d, product[i], f);
            bool half = nh_kind_of(d, x) == NH_NUMBER && nh_number_of(d, x).q == 2 &&
                        nh_kind_of(d, base) != NH_NUMBER && nh_kind_of(d, base) != NH_SYMBOL;
            if (half && split_root(&c, base, &root)) e = nh_substitute_root(d, e, base, root);
        }
    return e;
}
