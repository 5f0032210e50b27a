/* Evaluates expressions with canonical arguments in the field of their kernels. */
#include "exact/form.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

typedef const nh_quotient *quotient;

static quotient eval_number(nh_form *f, nh_num c)
{
    if (nh_num_short(c) || !f->kernels.opaque) return nh_quotient_number(f->field, c);
    bool minus = c.d < 0;
    nh_ex size = nh_number(f->kernels.dag, minus ? nh_num_mul(c, nh_num_int(-1)) : c);
    quotient q = nh_quotient_power_of(f->field, nh_kernel_plain(&f->kernels, size), 1);
    return minus ? nh_quotient_scale(f->field, q, nh_num_int(-1)) : q;
}

/* Halving keeps the operands of long sums short. */
static quotient eval_terms(nh_form *f, nh_ex e, size_t from, size_t to)
{
    nh_dag *dag = f->kernels.dag;
    if (to - from == 1) {
        quotient term = nh_form_eval(f, nh_child(dag, e, from));
        nh_num c = nh_coefficient_of(dag, e, from);
        return nh_num_is(c, 1) ? term : nh_quotient_mul(f->field, eval_number(f, c), term);
    }
    size_t middle = from + (to - from) / 2;
    quotient left = eval_terms(f, e, from, middle);
    return nh_quotient_add(f->field, left, eval_terms(f, e, middle, to));
}

static quotient eval_sum(nh_form *f, nh_ex e)
{
    quotient q = eval_terms(f, e, 0, nh_arity(f->kernels.dag, e));
    nh_num c = nh_constant_of(f->kernels.dag, e);
    return nh_num_is(c, 0) ? q : nh_quotient_add(f->field, q, eval_number(f, c));
}

/* b^(p/q) with r = b^(1/n): b^w r^m, 0 <= m < n */
static quotient eval_root(nh_form *f, nh_ex base, nh_num x)
{
    bool minus = x.p < 0;
    nh_num size = minus ? nh_num_mul(x, nh_num_int(-1)) : x;
    int64_t multiple;
    size_t kernel = nh_kernel_find(&f->kernels, NH_KERNEL_ROOT, 0, base, size, &multiple);
    int64_t order = f->kernels.item[kernel].unit.q, whole = multiple / order, rest = multiple % order;
    if (minus) {
        whole = -whole - (rest > 0);
        rest = rest ? order - rest : 0;
    }
    quotient root = nh_quotient_power_of(f->field, kernel, rest);
    return whole ? nh_quotient_mul(f->field, nh_quotient_pow(f->field, nh_form_eval(f, base), whole), root) : root;
}

/* prod_i family(c_i t_i), of which exp is one and b^ another */
static quotient eval_growth(nh_form *f, nh_kernel_kind family, nh_ex base, nh_ex argument)
{
    nh_parts parts;
    nh_kernel_parts(&f->kernels, family, argument, &parts);
    quotient q = nh_quotient_number(f->field, nh_num_int(1));
    for (size_t i = 0; i < parts.count; i++) {
        nh_num c = parts.item[i].coefficient;
        bool minus = c.p < 0;
        if (minus) c.p = -c.p;
        int64_t multiple;
        size_t kernel = nh_kernel_find(&f->kernels, family, base, parts.item[i].atom, c, &multiple);
        q = nh_quotient_mul(f->field, q, nh_quotient_power_of(f->field, kernel, minus ? -multiple : multiple));
    }
    nh_free(parts.item);
    return q;
}

/* base^exponent by the kind of the exponent: whole, a fraction (a root's kernel), a kernel by itself, or c + rest. */
static quotient eval_power(nh_form *f, nh_ex base, nh_ex exponent)
{
    nh_dag *dag = f->kernels.dag;
    switch (nh_exponent_kind_of(dag, exponent)) {
    case NH_EXPONENT_WHOLE: {
        int64_t n = nh_number_of(dag, exponent).p;
        bool symbol = nh_kind_of(dag, base) == NH_SYMBOL;
        if (symbol) return nh_quotient_power_of(f->field, nh_kernel_plain(&f->kernels, base), n);
        return nh_quotient_pow(f->field, nh_form_eval(f, base), n);
    }
    case NH_EXPONENT_ROOT: return eval_root(f, base, nh_number_of(dag, exponent));
    case NH_EXPONENT_OPAQUE: {
        size_t kernel = nh_kernel_plain(&f->kernels, nh_pow(dag, base, exponent));
        return nh_quotient_power_of(f->field, kernel, 1);
    }
    default: break;
    }
    nh_ex rest, number = nh_exponent_number(dag, exponent, &rest);
    quotient q = eval_growth(f, NH_KERNEL_POWER, base, rest);
    return nh_is_zero(dag, number) ? q : nh_quotient_mul(f->field, eval_power(f, base, number), q);
}

static quotient eval_product(nh_form *f, nh_ex e)
{
    nh_dag *dag = f->kernels.dag;
    nh_num c = nh_constant_of(dag, e);
    quotient q = nh_num_is(c, 1) ? NULL : eval_number(f, c);
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        quotient factor = eval_power(f, nh_child(dag, e, i), nh_exponent_of(dag, e, i));
        q = q ? nh_quotient_mul(f->field, q, factor) : factor;
    }
    return q;
}

/* ---- functions ---- */

typedef struct {
    quotient cosine, sine; /* hyperbolic ones too */
} rotation;

/* The rotation by a + b. */
static rotation turn(nh_quotient_field *field, rotation a, rotation b)
{
    quotient cc = nh_quotient_mul(field, a.cosine, b.cosine), ss = nh_quotient_mul(field, a.sine, b.sine);
    quotient sc = nh_quotient_mul(field, a.sine, b.cosine), cs = nh_quotient_mul(field, a.cosine, b.sine);
    ss = nh_quotient_scale(field, ss, nh_num_int(-1));
    return (rotation){nh_quotient_add(field, cc, ss), nh_quotient_add(field, sc, cs)};
}

static rotation quarter(nh_quotient_field *field, int64_t turns)
{
    static const int sine[4] = {0, 1, 0, -1};
    return (rotation){nh_quotient_number(field, nh_num_int(sine[(turns + 1) & 3])),
                      nh_quotient_number(field, nh_num_int(sine[turns & 3]))};
}

static rotation rotation_of_part(nh_form *f, nh_kernel_kind family, nh_part part)
{
    int64_t turns, multiple;
    if (family == NH_KERNEL_SIN && nh_quarter_turns(f->kernels.dag, part, &turns)) return quarter(f->field, turns);
    bool minus = part.coefficient.p < 0;
    if (minus) part.coefficient.p = -part.coefficient.p;
    size_t sine = nh_kernel_find(&f->kernels, family, 0, part.atom, part.coefficient, &multiple);
    rotation one = {nh_quotient_power_of(f->field, f->kernels.item[sine].partner, 1),
                    nh_quotient_power_of(f->field, sine, 1)};
    rotation all = one;
    for (int64_t i = 1; i < multiple; i++) all = turn(f->field, all, one);
    if (minus) all.sine = nh_quotient_scale(f->field, all.sine, nh_num_int(-1));
    return all;
}

static rotation rotation_of(nh_form *f, nh_kernel_kind family, nh_ex argument)
{
    nh_parts parts;
    nh_kernel_parts(&f->kernels, family, argument, &parts);
    rotation all = {0};
    for (size_t i = 0; i < parts.count; i++) {
        rotation one = rotation_of_part(f, family, parts.item[i]);
        all = i ? turn(f->field, all, one) : one;
    }
    nh_free(parts.item);
    return parts.count ? all : quarter(f->field, 0);
}

/* cosh, sinh = (E +- 1/E)/2 with E = exp(a), unless they are kernels themselves */
static rotation hyperbolic(nh_form *f, nh_ex argument)
{
    if (f->kernels.literal) return rotation_of(f, NH_KERNEL_SINH, argument);
    quotient up = eval_growth(f, NH_KERNEL_EXP, 0, argument), down = nh_quotient_inv(f->field, up);
    quotient sum = nh_quotient_add(f->field, up, down);
    quotient difference = nh_quotient_add(f->field, up, nh_quotient_scale(f->field, down, nh_num_int(-1)));
    nh_num half = nh_num_ratio(1, 2);
    return (rotation){nh_quotient_scale(f->field, sum, half), nh_quotient_scale(f->field, difference, half)};
}

/* A function of canonical arguments as a polynomial in its kernels; a kernel of its own where it has no other. */
static quotient eval_function(nh_form *f, nh_ex e)
{
    nh_dag *dag = f->kernels.dag;
    nh_function function = nh_function_of(dag, e);
    nh_ex a = nh_arity(dag, e) ? nh_child(dag, e, 0) : 0;
    int64_t multiple;
    rotation r;
    switch (function) {
    case NH_SIN: return rotation_of(f, NH_KERNEL_SIN, a).sine;
    case NH_COS: return rotation_of(f, NH_KERNEL_SIN, a).cosine;
    case NH_SINH: return hyperbolic(f, a).sine;
    case NH_COSH: return hyperbolic(f, a).cosine;
    case NH_TAN:
    case NH_TANH:
        r = function == NH_TAN ? rotation_of(f, NH_KERNEL_SIN, a) : hyperbolic(f, a);
        return nh_quotient_mul(f->field, r.sine, nh_quotient_inv(f->field, r.cosine));
    case NH_EXP: return eval_growth(f, NH_KERNEL_EXP, 0, a);
    case NH_ABS:
        return nh_quotient_power_of(f->field,
                                    nh_kernel_find(&f->kernels, NH_KERNEL_ABS, 0, a, nh_num_int(1), &multiple), 1);
    default: return nh_quotient_power_of(f->field, nh_kernel_plain(&f->kernels, e), 1);
    }
}

const nh_quotient *nh_form_eval(nh_form *f, nh_ex e)
{
    uint32_t known;
    if (nh_index_get(&f->known, e, &known)) return f->of[known];
    quotient q;
    switch (nh_kind_of(f->kernels.dag, e)) {
    case NH_NUMBER: q = eval_number(f, nh_number_of(f->kernels.dag, e)); break;
    case NH_SYMBOL: q = nh_quotient_power_of(f->field, nh_kernel_plain(&f->kernels, e), 1); break;
    case NH_SUM: q = eval_sum(f, e); break;
    case NH_PRODUCT: q = eval_product(f, e); break;
    default: q = eval_function(f, e);
    }
    nh_grow(&f->of, &f->capacity, f->count + 1, sizeof *f->of);
    nh_index_put(&f->known, e, (uint32_t)f->count);
    return f->of[f->count++] = q;
}
