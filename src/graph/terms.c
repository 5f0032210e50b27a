#include "graph/terms.h"

#include "base/memory.h"

size_t nh_terms_of(nh_dag *d, nh_ex phi, nh_ex **out)
{
    nh_ex factor = nh_int(d, 1), sum = phi;
    for (size_t i = 0; nh_kind_of(d, phi) == NH_PRODUCT && i < nh_arity(d, phi); i++) {
        nh_ex base = nh_child(d, phi, i);
        if (nh_kind_of(d, base) != NH_SUM || !nh_is_number(d, nh_exponent_of(d, phi, i), 1)) continue;
        sum = base;
        factor = nh_div(d, phi, base);
        break;
    }
    size_t n = nh_kind_of(d, sum) == NH_SUM ? nh_arity(d, sum) : 0;
    nh_ex *e = nh_alloc_array(1 + n, sizeof *e);
    e[0] = phi;
    for (size_t j = 0; j < n; j++) e[1 + j] = nh_mul(d, factor, nh_mul(d, nh_number(d, nh_coefficient_of(d, sum, j)), nh_child(d, sum, j)));
    *out = e;
    return 1 + n;
}

nh_ex nh_terms_moduli(nh_dag *d, nh_ex e)
{
    if (nh_kind_of(d, e) != NH_SUM) return nh_call(d, NH_ABS, e);
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < nh_arity(d, e); i++)
        sum = nh_add(d, sum, nh_call(d, NH_ABS, nh_mul(d, nh_number(d, nh_coefficient_of(d, e, i)), nh_child(d, e, i))));
    return sum;
}
