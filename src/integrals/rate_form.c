/* rate_form: equal forms, one step after the other, each only where signs at the probes allow it.
 *
 *     without_signs     sign(u) = |u|/u
 *     in_half_angles    sin, cos of 2 a and 2 a + pi by those of a
 *     fourth_roots      (N/D)^(k/4) = N^(k/4)/D^(k/4)
 *     squares_out       sqrt(u^2 v) = |u| sqrt(v) */
#include "integrals/rate_form.h"

#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/named_function.h"
#include "graph/node.h"

/* sign(u) as |u|/u, of which the normal form knows the square. */
static nh_ex without_signs(nh_dag *d, nh_ex e)
{
    enum { most = 32 };
    NH_LIST(call);
    nh_ex by[most];
    size_t n = nh_functions_in(d, e, &call), signs = 0;
    for (size_t i = 0; i < n && n <= most; i++) {
        if (nh_function_of(d, call[i]) != NH_SIGN) continue;
        nh_ex u = nh_child(d, call[i], 0);
        by[signs] = nh_div(d, nh_call(d, NH_ABS, u), u);
        call[signs++] = call[i];
    }
    return signs ? nh_substitute(d, e, signs, call, by) : e;
}

/* sin and cos of 2 a, and of 2 a + pi, by those of a, where one of these stands in e: equal radicands then have one
 * form. */
static nh_ex in_half_angles(nh_dag *d, nh_ex e)
{
    enum { most = 32 };
    NH_LIST(call);
    nh_ex by[most], whole[most], one = nh_int(d, 1), two = nh_int(d, 2);
    size_t n = nh_functions_in(d, e, &call), doubled = 0;
    for (size_t i = 0; i < n && n <= most; i++)
        for (size_t k = 0; k < n; k++) {
            nh_function f = nh_function_of(d, call[i]), g = nh_function_of(d, call[k]);
            bool waves = (f == NH_SIN || f == NH_COS) && (g == NH_SIN || g == NH_COS);
            if (!waves) continue;
            nh_ex half = nh_child(d, call[k], 0), apart = nh_sub(d, nh_child(d, call[i], 0), nh_mul(d, two, half));
            if (!nh_is_zero(d, apart) && apart != nh_pi(d)) continue;
            nh_ex sign = nh_int(d, nh_is_zero(d, apart) ? 1 : -1), sine = nh_call(d, NH_SIN, half);
            nh_ex value = f == NH_COS ? nh_sub(d, one, nh_mul(d, two, nh_powi(d, sine, 2)))
                                      : nh_product(d, 3, (nh_ex[]){two, sine, nh_call(d, NH_COS, half)});
            whole[doubled] = call[i];
            by[doubled++] = nh_mul(d, sign, value);
            break;
        }
    return nh_substitute(d, e, doubled, whole, by);
}

/* sqrt(e) in another form: where e is c u^2 with a constant c, and u has one sign on the domain, without the square
 * below the root; of a constant over e' as one over a root.  0: there is none.  `decisive`: the parameters on which
 * that sign depends. */
static nh_ex root_of(const nh_model *model, nh_ex e, bool *decisive)
{
    nh_dag *d = model->dag;
    nh_ex outside, inside;
    bool square = nh_square_split(d, e, &outside, &inside) && nh_model_is_constant(model, inside);
    int sign = square && !nh_model_is_constant(model, outside) ? nh_model_sign(model, outside) : 0;
    for (size_t i = 0; i < model->system->parameters && sign; i++)
        decisive[i] |= nh_depends(d, outside, model->parameter[i]);
    if (sign) return nh_product(d, 3, (nh_ex[]){nh_int(d, sign), outside, nh_sqrt(d, inside)});
    bool below = nh_model_is_constant(model, nh_numerator(d, e));
    return below ? nh_powi(d, nh_sqrt(d, nh_simplify_short(d, nh_powi(d, e, -1), 0)), -1) : 0;
}

/* sqrt(u^2 v) as |u| sqrt(v), where |u| stands in e, and without squares: nothing else says that they belong
 * together.  The outer roots first: they are known as they stand. */
static nh_ex squares_out(const nh_model *model, nh_ex e, bool *decisive)
{
    enum { most = 32 };
    nh_dag *d = model->dag;
    NH_LIST(base);
    NH_LIST(call);
    nh_ex one = nh_int(d, 1);
    size_t calls = nh_functions_in(d, e, &call), n = nh_radicands_in(d, e, &base);
    for (size_t k = n; k-- > 0 && n <= most;) {
        nh_ex rest = nh_simplify_short(d, base[k], 0), outside = one;
        if (nh_model_is_constant(model, rest)) continue;
        for (size_t i = 0; i < calls && calls <= most; i++) {
            if (nh_function_of(d, call[i]) != NH_ABS) continue;
            nh_ex other = nh_simplify_short(d, nh_div(d, rest, nh_powi(d, nh_child(d, call[i], 0), 2)), 0);
            if (nh_complexity(d, other) >= nh_complexity(d, rest)) continue;
            outside = nh_mul(d, outside, call[i]);
            rest = other;
        }
        nh_ex root = root_of(model, rest, decisive);
        if (!root && outside == one) continue;
        e = nh_substitute_root(d, e, base[k], nh_mul(d, outside, root ? root : nh_sqrt(d, rest)));
    }
    return e;
}

/* The powers k/4 and k/2 of N/D with those of N and D, where both are positive: sums of quotients have one form. */
static nh_ex fourth_roots(const nh_model *model, nh_ex e)
{
    enum { most = 64 };
    nh_dag *d = model->dag;
    NH_LIST(product);
    size_t n = nh_products_in(d, e, &product);
    for (size_t i = 0; i < n && n <= most; i++)
        for (size_t k = 0; k < nh_arity(d, product[i]); k++) {
            nh_ex base = nh_child(d, product[i], k), x = nh_exponent_of(d, product[i], k);
            if (nh_kind_of(d, x) != NH_NUMBER || nh_number_of(d, x).q != 4) continue;
            nh_ex above = nh_numerator(d, base), below = nh_simplify_short(d, nh_div(d, above, base), 0), outside,
                  inside;
            if (nh_is_number(d, below, 1) || nh_model_sign(model, above) <= 0) continue;
            if (!nh_square_split(d, below, &outside, &inside) || nh_model_sign(model, inside) <= 0) continue;
            nh_ex size = nh_model_sign(model, outside) < 0 ? nh_neg(d, outside) : outside;
            nh_ex root = nh_div(d, nh_sqrt(d, above), nh_mul(d, size, nh_sqrt(d, inside)));
            if (nh_model_sign(model, root) > 0) e = nh_substitute_positive_root(d, e, base, root);
        }
    return e;
}

nh_ex nh_rate_form(const nh_model *model, nh_ex e, bool *decisive)
{
    nh_dag *d = model->dag;
    nh_ex positive = without_signs(d, e);
    if (positive == e && !nh_named_function_has_elliptic(d, e)) return e;
    return squares_out(model, fourth_roots(model, in_half_angles(d, positive)), decisive);
}
