#include "integrals/real_where.h"

#include <math.h>
#include <string.h>

#include "exact/kernel.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

static int sign_of_symbol(const nh_model *model, nh_ex e)
{
    for (size_t i = 0; i < model->system->parameters; i++)
        if (model->parameter[i] == e) return (model->parameter_value[i] > 0) - (model->parameter_value[i] < 0);
    return 0;
}

/* The sign of e by the signs of the parameters; 0: either is possible. */
static int certain_sign(const nh_model *model, nh_ex e)
{
    const nh_dag *d = model->dag;
    nh_kind kind = nh_kind_of(d, e);
    if (kind == NH_SYMBOL) return sign_of_symbol(model, e);
    if (kind == NH_FUNCTION)
        return nh_function_of(d, e) == NH_EXP || nh_function_of(d, e) == NH_COSH || nh_function_of(d, e) == NH_PI;
    double constant = nh_num_value(kind == NH_NUMBER ? nh_number_of(d, e) : nh_constant_of(d, e));
    int sign = (constant > 0) - (constant < 0);
    if (kind == NH_NUMBER) return sign;
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        int own = certain_sign(model, nh_child(d, e, i));
        if (kind == NH_PRODUCT) {
            nh_ex x = nh_exponent_of(d, e, i);
            bool even = nh_kind_of(d, x) == NH_NUMBER && fmod(nh_num_value(nh_number_of(d, x)), 2) == 0;
            sign *= even || own > 0 ? 1 : nh_exponent_kind_of(d, x) == NH_EXPONENT_WHOLE ? own : 0;
        } else {
            own *= nh_num_value(nh_coefficient_of(d, e, i)) < 0 ? -1 : 1;
            if (own == 0 || (sign && own != sign)) return 0;
            sign = own;
        }
    }
    return sign;
}

/* Does it depend on the state, and have either sign in the sampling box or far beyond it, where the system itself is
 * real? */
static bool has_both_signs(const nh_model *model, nh_ex e)
{
    const nh_chart *c = model->chart;
    bool of_state = false, above = false, below = false;
    for (size_t j = 0; j < model->width; j++) of_state |= nh_depends(model->dag, e, c->symbol[j]);
    if (!of_state) return false;
    size_t count = 2 + model->n;
    nh_ex *all = nh_alloc_array(count, sizeof *all);
    double *value = nh_alloc_array(count, sizeof *value);
    all[0] = e;
    all[1] = model->Lbar;
    memcpy(all + 2, model->a, model->n * sizeof *all);
    nh_tape *tape = nh_model_tape(model, count, all);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *z = nh_alloc_array(model->width + 1, sizeof *z);
    for (size_t p = 0; p < 3 * c->probes; p++) {
        static const double stretch[] = {1, 4, 16};
        bool real = true;
        for (size_t j = 0; j < model->width; j++) {
            double middle = (c->low[j] + c->high[j]) / 2;
            z[j] = c->probe[p / 3 * c->width + j];
            if (p % 3 && j < model->width - c->implicit) z[j] = middle + stretch[p % 3] * (z[j] - middle);
        }
        if (p % 3 && !nh_chart_complete(c, z)) continue;
        nh_tape_eval(tape, work, z, value);
        for (size_t i = 1; i < count; i++) real &= isfinite(value[i]);
        above |= real && value[0] > 0;
        below |= real && value[0] < 0;
    }
    nh_free(z);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(value);
    nh_free(all);
    return above && below;
}

/* e without a positive number before it. */
static nh_ex without_number(nh_dag *d, nh_ex e)
{
    if (nh_kind_of(d, e) != NH_PRODUCT) return e;
    nh_num c = nh_constant_of(d, e), one = nh_num_int(nh_num_value(c) < 0 ? -1 : 1);
    return nh_mul(d, nh_number(d, nh_num_mul(one, nh_num_inv(c))), e);
}

static bool is_parametric(const nh_model *model, nh_ex e)
{
    bool parametric = false;
    for (size_t i = 0; i < model->system->parameters; i++) parametric |= nh_depends(model->dag, e, model->parameter[i]);
    for (size_t j = 0; j < model->width; j++) parametric &= !nh_depends(model->dag, e, model->chart->symbol[j]);
    return parametric;
}

static bool may_be_negative(const nh_model *model, nh_ex e)
{
    return (is_parametric(model, e) && certain_sign(model, e) == 0) || has_both_signs(model, e);
}

size_t nh_real_where_divisors(const nh_model *model, nh_ex e, nh_ex out[NH_MOST_REAL_WHERE])
{
    nh_dag *d = model->dag;
    NH_LIST(node);
    size_t count = 0, n = nh_products_in(d, e, &node);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < nh_arity(d, node[i]); k++) {
            nh_ex base = without_number(d, nh_child(d, node[i], k)), x = nh_exponent_of(d, node[i], k);
            bool divides = nh_kind_of(d, x) == NH_NUMBER && nh_num_value(nh_number_of(d, x)) < 0, known = false;
            for (size_t j = 0; j < count; j++) known |= out[j] == base;
            if (divides && !known && count < NH_MOST_REAL_WHERE && is_parametric(model, base) &&
                !certain_sign(model, base))
                out[count++] = base;
        }
    return count;
}

size_t nh_real_where(const nh_model *model, nh_ex e, nh_ex out[NH_MOST_REAL_WHERE])
{
    enum { most = 400 };
    nh_dag *d = model->dag;
    NH_LIST(node);
    size_t count = 0, n = nh_products_in(d, e, &node);
    for (size_t i = 0; i < n && i < most; i++)
        for (size_t k = 0; k < nh_arity(d, node[i]); k++) {
            nh_ex base = without_number(d, nh_child(d, node[i], k)), x = nh_exponent_of(d, node[i], k);
            bool even_root = nh_exponent_kind_of(d, x) == NH_EXPONENT_ROOT && nh_number_of(d, x).q % 2 == 0,
                 known = false;
            for (size_t j = 0; j < count; j++) known |= out[j] == base;
            if (even_root && !known && count < NH_MOST_REAL_WHERE && may_be_negative(model, base)) out[count++] = base;
        }
    n = nh_functions_in(d, e, &node);
    for (size_t i = 0; i < n && i < most; i++) {
        nh_ex argument = nh_function_of(d, node[i]) == NH_LOG ? nh_child(d, node[i], 0) : 0;
        bool known = argument == 0;
        for (size_t j = 0; j < count; j++) known |= out[j] == argument;
        if (!known && count < NH_MOST_REAL_WHERE && may_be_negative(model, argument)) out[count++] = argument;
    }
    return count;
}
