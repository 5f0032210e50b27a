#include "report/formula.h"

/* The user's own abbreviations, from the analysis file, instead of what they stand for. */
nh_ex nh_formula_abbreviate(const nh_result *r, nh_ex e)
{
    const nh_analysis *a = r->analysis;
    nh_dag *d = r->model->dag;
    for (size_t i = a ? a->definitions : 0; i-- > 0;) {
        nh_kind kind = nh_kind_of(d, a->definition[i].value);
        if (kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        nh_ex name = nh_symbol(d, a->definition[i].name), value = a->definition[i].value;
        bool root = kind == NH_PRODUCT && nh_arity(d, value) == 1 && nh_num_is(nh_constant_of(d, value), 1)
                    && nh_exponent_of(d, value, 0) == nh_ratio(d, 1, 2);
        e = root ? nh_substitute_root(d, e, nh_child(d, value, 0), name) : nh_substitute(d, e, 1, &value, &name);
    }
    return e;
}
