#include "exact/normal.h"

#include "graph/dag_internal.h"
#include "exact/form.h"
#include "exact/straighten.h"

enum { default_terms = 20000 };

static nh_zero_verdict is_zero(nh_dag *dag, nh_ex e, size_t max_terms)
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

nh_zero_verdict nh_normal_is_zero(nh_dag *dag, nh_ex e, size_t max_terms)
{
    nh_ex straight = e;
    nh_zero_verdict verdict = NH_TOO_LARGE;
    if (nh_kind_of(dag, e) != NH_NUMBER && nh_straighten(dag, 1, &straight, 0, NULL))
        verdict = is_zero(dag, straight, max_terms);
    return verdict == NH_TOO_LARGE ? is_zero(dag, e, max_terms) : verdict;
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
