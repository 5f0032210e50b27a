#include "expr/dag.h"
#include "expr/kernel.h"

static bool inexact(const nh_dag *dag, nh_ex e, nh_index *seen)
{
    uint32_t known;
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER) return !nh_num_exact(nh_number_of(dag, e));
    if (kind == NH_SYMBOL || nh_index_get(seen, e, &known)) return false;
    nh_index_put(seen, e, 0);
    bool found = kind != NH_FUNCTION && !nh_num_exact(nh_constant_of(dag, e));
    for (size_t i = 0; i < nh_arity(dag, e) && !found; i++) {
        found = inexact(dag, nh_child(dag, e, i), seen);
        if (kind == NH_SUM) found = found || !nh_num_exact(nh_coefficient_of(dag, e, i));
        if (kind == NH_PRODUCT) found = found || inexact(dag, nh_exponent_of(dag, e, i), seen);
    }
    return found;
}

bool nh_is_inexact(const nh_dag *dag, nh_ex e)
{
    nh_index seen = {0};
    bool found = inexact(dag, e, &seen);
    nh_index_clear(&seen);
    return found;
}
