#include "exact/normal.h"

#include <math.h>

#include "graph/dag_internal.h"
#include "base/memory.h"
#include "exact/ball.h"
#include "exact/form.h"
#include "exact/straighten.h"
#include "graph/node.h"

enum {
    default_terms = 20000,
    few_terms = 500, /* with more than these a place is cheaper */
    most_symbols = 100,
    place_bits = 192
};

/* Has e a value other than zero at a place whose coordinates are 1/2 to 3/2?  Symbols with a relation have no value of
 * their own. */
static bool differs_somewhere(nh_dag *dag, nh_ex e)
{
    NH_LIST(symbol);
    size_t n = nh_symbols_in(dag, e, &symbol);
    if (n > most_symbols) return false;
    for (size_t i = 0; i < n; i++)
        if (nh_dag_power_rule(dag, symbol[i])) return false;
    nh_ball *ball = nh_ball_create(dag, place_bits);
    for (size_t i = 0; i < n; i++) nh_ball_set_ratio(ball, symbol[i], 500 + (int64_t)(619 * (i + 1)) % 1009, 1009);
    double mid, radius;
    bool differs = nh_ball_value(ball, e, &mid, &radius) && fabs(mid) > 2 * radius; /* both are rounded */
    nh_ball_free(ball);
    return differs;
}

static nh_zero_verdict is_zero_within(nh_dag *dag, nh_ex e, size_t max_terms)
{
    if (nh_kind_of(dag, e) == NH_NUMBER) return nh_is_zero(dag, e) ? NH_ZERO : NH_NONZERO;
    nh_forms forms;
    nh_form form;
    nh_forms_init(&forms, dag, false, max_terms);
    nh_quotient_field_state state = nh_form_make(&forms, e, false, &form);
    nh_zero_verdict verdict = state == NH_FIELD_TOO_LARGE ? NH_TOO_LARGE : NH_NONZERO;
    if (state == NH_FIELD_FINE && nh_quotient_is_zero(form.field, form.value)) verdict = NH_ZERO;
    nh_form_clear(&form);
    nh_forms_clear(&forms);
    return verdict;
}

/* A form that is long is seldom of zero: before it is made, a value at one place may say so. */
static nh_zero_verdict is_zero(nh_dag *dag, nh_ex e, size_t max_terms)
{
    if (max_terms > few_terms) {
        nh_zero_verdict verdict = is_zero_within(dag, e, few_terms);
        if (verdict != NH_TOO_LARGE) return verdict;
        if (differs_somewhere(dag, e)) return NH_NONZERO;
    }
    return is_zero_within(dag, e, max_terms);
}

nh_zero_verdict nh_normal_is_zero(nh_dag *dag, nh_ex e, size_t max_terms)
{
    nh_ex straight = e;
    max_terms = max_terms ? max_terms : default_terms;
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
