#include "graph/terms.h"

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/index.h"
#include "graph/node.h"
#include "graph/num.h"

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
    for (size_t j = 0; j < n; j++)
        e[1 + j] = nh_mul(d, factor, nh_mul(d, nh_number(d, nh_coefficient_of(d, sum, j)), nh_child(d, sum, j)));
    *out = e;
    return 1 + n;
}

nh_ex nh_terms_moduli(nh_dag *d, nh_ex e)
{
    if (nh_kind_of(d, e) != NH_SUM) return nh_call(d, NH_ABS, e);
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < nh_arity(d, e); i++)
        sum =
            nh_add(d, sum, nh_call(d, NH_ABS, nh_mul(d, nh_number(d, nh_coefficient_of(d, e, i)), nh_child(d, e, i))));
    return sum;
}

static nh_ex uncancelled(nh_dag *d, nh_ex e, nh_index *known);

static nh_ex uncancelled_sum(nh_dag *d, nh_ex e, nh_index *known)
{
    nh_num constant = nh_constant_of(d, e);
    nh_ex sum = nh_call(d, NH_ABS, nh_number(d, constant));
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex c = nh_call(d, NH_ABS, nh_number(d, nh_coefficient_of(d, e, i)));
        sum = nh_add(d, sum, nh_mul(d, c, uncancelled(d, nh_child(d, e, i), known)));
    }
    return sum;
}

static nh_ex uncancelled_product(nh_dag *d, nh_ex e, nh_index *known)
{
    nh_ex product = nh_call(d, NH_ABS, nh_number(d, nh_constant_of(d, e)));
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex base = nh_child(d, e, i), x = nh_exponent_of(d, e, i);
        bool whole = nh_kind_of(d, x) == NH_NUMBER && nh_num_short(nh_number_of(d, x)) && nh_number_of(d, x).q == 1 &&
                     nh_number_of(d, x).p > 0;
        product = nh_mul(d, product,
                         whole ? nh_pow(d, uncancelled(d, base, known), x) : nh_call(d, NH_ABS, nh_pow(d, base, x)));
    }
    return product;
}

/* `known`: a shared graph has exponentially many paths. */
static nh_ex uncancelled(nh_dag *d, nh_ex e, nh_index *known)
{
    uint32_t before;
    nh_kind kind = nh_kind_of(d, e);
    if (kind != NH_SUM && kind != NH_PRODUCT) return nh_call(d, NH_ABS, e);
    if (nh_index_get(known, e, &before)) return before;
    nh_ex size = kind == NH_SUM ? uncancelled_sum(d, e, known) : uncancelled_product(d, e, known);
    nh_index_put(known, e, size);
    return size;
}

nh_ex nh_terms_uncancelled(nh_dag *d, nh_ex e)
{
    nh_index known = {0};
    nh_ex size = uncancelled(d, e, &known);
    nh_index_clear(&known);
    return size;
}

/* The exponent of a base in a term, if it is whole and not negative; otherwise 0. */
static int64_t exponent_in(const nh_dag *d, nh_ex term, nh_ex base)
{
    if (term == base) return 1;
    for (size_t k = 0; nh_kind_of(d, term) == NH_PRODUCT && k < nh_arity(d, term); k++) {
        nh_ex x = nh_exponent_of(d, term, k);
        if (nh_child(d, term, k) != base || nh_kind_of(d, x) != NH_NUMBER) continue;
        nh_num e = nh_number_of(d, x);
        return e.q == 1 && e.p > 0 ? e.p : 0;
    }
    return 0;
}

nh_ex nh_terms_common(nh_dag *d, nh_ex sum)
{
    nh_ex first = nh_child(d, sum, 0), out = nh_int(d, 1);
    bool product = nh_kind_of(d, first) == NH_PRODUCT;
    if (!nh_num_is(nh_constant_of(d, sum), 0)) return out;
    for (size_t k = 0; k < (product ? nh_arity(d, first) : 1); k++) {
        nh_ex base = product ? nh_child(d, first, k) : first;
        int64_t least = exponent_in(d, first, base);
        for (size_t i = 1; i < nh_arity(d, sum) && least; i++) {
            int64_t e = exponent_in(d, nh_child(d, sum, i), base);
            if (e < least) least = e;
        }
        out = nh_mul(d, out, nh_powi(d, base, least));
    }
    return out;
}
