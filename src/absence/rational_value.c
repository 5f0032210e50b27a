#include "graph/num_long.h"

#include "absence/rational_value.h"

#include "exact/ball.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/num.h"

nh_ex nh_rational_value_at(const nh_rational_value_place *place, nh_ex e)
{
    return nh_simplify(place->dag, nh_substitute(place->dag, e, place->count, place->symbol, place->value));
}

bool nh_rational_value_of(nh_dag *dag, nh_ex e, fmpq_t out)
{
    NH_LIST(symbol);
    if (nh_symbols_in(dag, e, &symbol)) return false;
    if (nh_kind_of(dag, e) != NH_NUMBER) e = nh_simplify(dag, e);
    if (nh_kind_of(dag, e) != NH_NUMBER || !nh_num_exact(nh_number_of(dag, e))) return false;
    mpq_t value;
    mpq_init(value);
    nh_num_get_mpq(value, nh_number_of(dag, e));
    fmpq_set_mpq(out, value);
    mpq_clear(value);
    return true;
}

nh_ex nh_rational_value_number(nh_dag *dag, const fmpq_t value)
{
    mpq_t copy;
    mpq_init(copy);
    fmpq_get_mpq(copy, value);
    nh_ex out = nh_number(dag, nh_num_of_mpq(copy));
    mpq_clear(copy);
    return out;
}

bool nh_rational_value_differs(nh_dag *dag, nh_ex e)
{
    enum { bits = 192 };
    if (nh_kind_of(dag, e) == NH_NUMBER) return nh_num_value(nh_number_of(dag, e)) != 0;
    nh_ball *ball = nh_ball_create(dag, bits);
    bool differs = nh_ball_excludes_zero(ball, e);
    nh_ball_free(ball);
    return differs;
}

/* Is the value of e at the place certainly not 0? */
static bool differs(const nh_rational_value_place *place, nh_ex e)
{
    return nh_rational_value_differs(place->dag,
                                     nh_substitute(place->dag, e, place->count, place->symbol, place->value));
}

/* A base may vanish only below a whole positive exponent. */
static bool regular_product(const nh_rational_value_place *place, nh_ex e)
{
    const nh_dag *dag = place->dag;
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        nh_ex exponent = nh_exponent_of(dag, e, i), base = nh_child(dag, e, i);
        if (nh_kind_of(dag, exponent) != NH_NUMBER) return false;
        nh_num power = nh_number_of(dag, exponent);
        if (!(nh_num_short(power) && power.q == 1 && power.p > 0) && !differs(place, base)) return false;
    }
    return true;
}

static bool regular_call(const nh_rational_value_place *place, nh_ex e)
{
    nh_dag *dag = place->dag;
    switch (nh_function_of(dag, e)) {
    case NH_SIN:
    case NH_COS:
    case NH_SINH:
    case NH_COSH:
    case NH_EXP:
    case NH_PI: return true;
    case NH_TAN: return differs(place, nh_call(dag, NH_COS, nh_child(dag, e, 0)));
    case NH_TANH: return differs(place, nh_call(dag, NH_COSH, nh_child(dag, e, 0)));
    case NH_LOG: return differs(place, nh_child(dag, e, 0));
    default: return false;
    }
}

bool nh_rational_value_analytic(const nh_rational_value_place *place, nh_ex e)
{
    nh_dag *dag = place->dag;
    nh_ex *node = NULL;
    size_t n = nh_nodes_in(dag, 1, &e, &node);
    bool good = true;
    for (size_t i = 0; i < n && good; i++) {
        bool known = false;
        switch (nh_kind_of(dag, node[i])) {
        case NH_NUMBER: good = nh_num_exact(nh_number_of(dag, node[i])); break;
        case NH_SYMBOL:
            for (size_t j = 0; j < place->count && !known; j++) known = place->symbol[j] == node[i];
            good = known;
            break;
        case NH_SUM: break;
        case NH_PRODUCT: good = regular_product(place, node[i]); break;
        case NH_FUNCTION: good = regular_call(place, node[i]); break;
        }
    }
    nh_nodes_free(&node);
    return good;
}
