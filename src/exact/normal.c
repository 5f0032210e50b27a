#include "exact/normal.h"

#include "graph/dag_internal.h"
#include "exact/form.h"

enum { default_terms = 20000 };

nh_zero_verdict nh_normal_is_zero(nh_dag *dag, nh_ex e, size_t max_terms)
{
    if (nh_kind_of(dag, e) == NH_NUMBER) return nh_is_zero(dag, e) ? NH_ZERO : NH_NONZERO;
    nh_forms forms;
    nh_form form;
    nh_forms_init(&forms, dag, false, max_terms ? max_terms : default_terms);
    nh_quotient_field_state state = nh_form_make(&forms, e, false, &form);
    nh_zero_verdict verdict = state == NH_FIELD_TOO_LARGE ? NH_TOO_LARGE : NH_NONZERO;
    if (state == NH_FIELD_FINE && nh_quotient_is_zero(form.field, form.value)) verdict = NH_ZERO;
    nh_form_clear(&form);
    nh_forms_clear(&forms);
    return verdict;
}

nh_ex nh_canonical(nh_dag *dag, nh_ex e, size_t max_terms)
{
    nh_forms forms;
    nh_forms_init(&forms, dag, false, max_terms ? max_terms : default_terms);
    e = nh_form_rewrite(&forms, e);
    nh_forms_clear(&forms);
    return e;
}

void nh_relate(nh_dag *dag, nh_ex symbol, unsigned order, nh_ex value)
{
    nh_grow(&dag->power, &dag->power_capacity, dag->power_count + 1, sizeof *dag->power);
    dag->power[dag->power_count++] = (nh_power_rule){symbol, value, order};
}

/* ---- how long it looks ---- */

static const size_t endless = SIZE_MAX / 4; /* a shared graph can be exponentially long on paper */

static size_t plus(size_t a, size_t b) { return a + b < endless ? a + b : endless; }

static size_t length_of(const nh_dag *dag, nh_ex e, nh_index *known);

static size_t number_length(nh_num c) { return (c.q > 1 ? 3 : 1) + (nh_num_value(c) < 0); }

/* A number in front of something: what it adds, with its operators. */
static size_t coefficient_length(nh_num c)
{
    if (!nh_num_short(c)) return 2;
    return (c.p != 1 && c.p != -1 ? 2 : 0) + (c.q != 1 ? 2 : 0);
}

static size_t in_parentheses(const nh_dag *dag, nh_ex e, nh_index *known)
{
    return plus(length_of(dag, e, known), nh_kind_of(dag, e) == NH_SUM);
}

static size_t sum_length(const nh_dag *dag, nh_ex e, nh_index *known)
{
    size_t n = nh_arity(dag, e), length = n - 1;
    nh_num constant = nh_constant_of(dag, e);
    if (!nh_num_is(constant, 0)) length += constant.q > 1 ? 4 : 2;
    for (size_t i = 0; i < n; i++) {
        length = plus(length, coefficient_length(nh_coefficient_of(dag, e, i)));
        length = plus(length, length_of(dag, nh_child(dag, e, i), known));
    }
    return length;
}

/* b^x with the sign of x left to the fraction bar */
static size_t factor_length(const nh_dag *dag, nh_ex base, nh_ex exponent, nh_index *known)
{
    if (nh_kind_of(dag, exponent) != NH_NUMBER)
        return plus(plus(in_parentheses(dag, base, known), 1), in_parentheses(dag, exponent, known));
    nh_num x = nh_number_of(dag, exponent);
    if (x.q == 1 && (x.p == 1 || x.p == -1)) return in_parentheses(dag, base, known);
    if (x.q == 2 && (x.p == 1 || x.p == -1)) return plus(1, length_of(dag, base, known));
    return plus(in_parentheses(dag, base, known), x.q > 1 ? 4 : 2);
}

static size_t product_length(const nh_dag *dag, nh_ex e, nh_index *known)
{
    size_t above = 0, below = 0, length = 0;
    nh_num c = nh_constant_of(dag, e);
    if (!nh_num_short(c) || (c.p != 1 && c.p != -1)) above++;
    if (c.q > 1) below++;
    length = above + below + (nh_num_value(c) < 0);
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        nh_ex x = nh_exponent_of(dag, e, i);
        bool under = nh_kind_of(dag, x) == NH_NUMBER && nh_num_value(nh_number_of(dag, x)) < 0;
        if (under) below++;
        else above++;
        length = plus(length, factor_length(dag, nh_child(dag, e, i), x, known));
    }
    if (!above) length = plus(length, above = 1); /* 1/... */
    return plus(length, above + below - 1 + (below > 1)); /* operators; a denominator in parentheses */
}

static size_t length_of(const nh_dag *dag, nh_ex e, nh_index *known)
{
    uint32_t found;
    size_t length = 1;
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_SYMBOL) return 1;
    if (kind == NH_NUMBER) return number_length(nh_number_of(dag, e));
    if (nh_index_get(known, e, &found)) return found == UINT32_MAX ? endless : found;
    if (kind == NH_SUM) length = sum_length(dag, e, known);
    else if (kind == NH_PRODUCT) length = product_length(dag, e, known);
    else
        for (size_t i = 0; i < nh_arity(dag, e); i++) length = plus(length, length_of(dag, nh_child(dag, e, i), known));
    nh_index_put(known, e, length < UINT32_MAX ? (uint32_t)length : UINT32_MAX);
    return length;
}

size_t nh_complexity(const nh_dag *dag, nh_ex e)
{
    nh_index known = {0};
    size_t length = length_of(dag, e, &known);
    nh_index_clear(&known);
    return length;
}

/* ---- how deep it is ---- */

static size_t nesting(const nh_dag *dag, nh_ex e, nh_index *known)
{
    uint32_t found;
    size_t most = 0, n = nh_arity(dag, e);
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER || kind == NH_SYMBOL) return 0;
    if (nh_index_get(known, e, &found)) return found;
    for (size_t i = 0; i < n; i++) {
        nh_ex child = nh_child(dag, e, i), exponent = kind == NH_PRODUCT ? nh_exponent_of(dag, e, i) : 0;
        size_t here = nesting(dag, child, known) + (kind == NH_FUNCTION || (kind == NH_PRODUCT && nh_kind_of(dag, child) == NH_SUM));
        if (here > most) most = here;
        if (kind == NH_PRODUCT && (here = nesting(dag, exponent, known) + (nh_kind_of(dag, exponent) != NH_NUMBER)) > most) most = here;
    }
    nh_index_put(known, e, (uint32_t)most);
    return most;
}

size_t nh_nesting(const nh_dag *dag, nh_ex e)
{
    nh_index known = {0};
    size_t most = nesting(dag, e, &known);
    nh_index_clear(&known);
    return most;
}
