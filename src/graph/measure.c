/* measure: see measure.h.  Each node is looked at once. */
#include "graph/measure.h"

#include <stdlib.h>

#include "base/memory.h"
#include "graph/function.h"
#include "graph/index.h"
#include "graph/node.h"
#include "graph/num.h"

/* ---- the length of a printed expression ---- */

static const size_t endless = SIZE_MAX / 4; /* a shared graph can be exponentially long on paper */

static size_t plus(size_t a, size_t b) { return a + b < endless ? a + b : endless; }

static size_t length_of(const nh_dag *dag, nh_ex e, nh_index *known);

static size_t number_length(nh_num c) { return (c.q > 1 ? 3 : 1) + (nh_num_value(c) < 0); }

/* The length that a number in front of something adds, with its operators. */
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
    if (!above) length = plus(length, above = 1);         /* 1/... */
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

/* What is left of `room` after the symbols and numbers of e, as they are printed; 0 where there is no room for all. */
static size_t room_behind(const nh_dag *dag, nh_ex e, size_t room)
{
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_SYMBOL || kind == NH_NUMBER) return room - (room > 0);
    for (size_t i = 0; i < nh_arity(dag, e) && room; i++) room = room_behind(dag, nh_child(dag, e, i), room);
    return room;
}

bool nh_complexity_within(const nh_dag *dag, nh_ex e, size_t most)
{
    return room_behind(dag, e, most + 1) && nh_complexity(dag, e) <= most;
}

/* ---- the order of expressions ---- */

/* A term with its coefficient, or a base with its exponent. */
typedef struct {
    const nh_dag *dag;
    nh_ex e, exponent;
    double coefficient;
} piece;

static int structure(const nh_dag *dag, nh_ex a, nh_ex b);

static int sign_of(double x) { return (x > 0) - (x < 0); }

static int by_structure(const void *left, const void *right)
{
    const piece *a = left, *b = right;
    int order = structure(a->dag, a->e, b->e);
    return order ? order : structure(a->dag, a->exponent, b->exponent);
}

static piece *pieces_of(const nh_dag *dag, nh_ex e)
{
    size_t n = nh_arity(dag, e);
    nh_kind kind = nh_kind_of(dag, e);
    piece *list = nh_alloc_array(n + 1, sizeof *list);
    for (size_t i = 0; i < n; i++) {
        nh_ex own = nh_child(dag, e, i);
        list[i] = (piece){dag, own, kind == NH_PRODUCT ? nh_exponent_of(dag, e, i) : own,
                          kind == NH_SUM ? nh_num_value(nh_coefficient_of(dag, e, i)) : 1};
    }
    if (kind != NH_FUNCTION) qsort(list, n, sizeof *list, by_structure);
    return list;
}

/* Compares term by term in their order; coefficients decide between sums of the same terms, the larger first. */
static int by_pieces(const nh_dag *dag, nh_ex a, nh_ex b)
{
    size_t n = nh_arity(dag, a);
    piece *x = pieces_of(dag, a), *y = pieces_of(dag, b);
    int order = 0;
    for (size_t i = 0; i < n && !order; i++) order = by_structure(&x[i], &y[i]);
    for (size_t i = 0; i < n && !order; i++) order = sign_of(y[i].coefficient - x[i].coefficient);
    nh_free(x);
    nh_free(y);
    if (order || nh_kind_of(dag, a) == NH_FUNCTION) return order;
    return sign_of(nh_num_value(nh_constant_of(dag, b)) - nh_num_value(nh_constant_of(dag, a)));
}

static int structure(const nh_dag *dag, nh_ex a, nh_ex b)
{
    if (a == b) return 0;
    nh_kind kind = nh_kind_of(dag, a);
    if (kind != nh_kind_of(dag, b)) return kind < nh_kind_of(dag, b) ? -1 : 1;
    if (kind == NH_SYMBOL) return a < b ? -1 : 1;
    if (kind == NH_NUMBER) return sign_of(nh_num_value(nh_number_of(dag, a)) - nh_num_value(nh_number_of(dag, b)));
    if (kind == NH_FUNCTION && nh_function_of(dag, a) != nh_function_of(dag, b))
        return nh_function_of(dag, a) < nh_function_of(dag, b) ? -1 : 1;
    if (nh_arity(dag, a) != nh_arity(dag, b)) return nh_arity(dag, a) < nh_arity(dag, b) ? -1 : 1;
    return by_pieces(dag, a, b);
}

/* The one with the earlier symbol comes first, where their symbols differ. */
static int by_symbols(const nh_dag *dag, nh_ex a, nh_ex b)
{
    NH_LIST(x);
    NH_LIST(y);
    size_t n = nh_symbols_in(dag, a, &x), m = nh_symbols_in(dag, b, &y), i = 0;
    while (i < n && i < m && x[i] == y[i]) i++;
    return i < n && i < m ? (x[i] < y[i] ? -1 : 1) : (n < m) - (n > m);
}

int nh_complexity_order(const nh_dag *dag, nh_ex a, nh_ex b)
{
    static const size_t longest = 3000;
    size_t x = nh_complexity(dag, a), y = nh_complexity(dag, b);
    if (x != y) return x < y ? -1 : 1;
    int order = by_symbols(dag, a, b);
    return order || x > longest ? order : structure(dag, a, b);
}

/* ---- depth ---- */

static size_t nesting(const nh_dag *dag, nh_ex e, nh_index *known)
{
    uint32_t found;
    size_t most = 0, n = nh_arity(dag, e);
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER || kind == NH_SYMBOL) return 0;
    if (nh_index_get(known, e, &found)) return found;
    for (size_t i = 0; i < n; i++) {
        nh_ex child = nh_child(dag, e, i), exponent = kind == NH_PRODUCT ? nh_exponent_of(dag, e, i) : 0;
        size_t here = nesting(dag, child, known) +
                      (kind == NH_FUNCTION || (kind == NH_PRODUCT && nh_kind_of(dag, child) == NH_SUM));
        if (here > most) most = here;
        if (kind == NH_PRODUCT &&
            (here = nesting(dag, exponent, known) + (nh_kind_of(dag, exponent) != NH_NUMBER)) > most)
            most = here;
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

/* ---- numbers ---- */

/* Is there a number in e for which `good` is false? */
static bool has_bad_number(const nh_dag *dag, nh_ex e, bool (*good)(nh_num), nh_index *seen)
{
    uint32_t known;
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER) return !good(nh_number_of(dag, e));
    if (kind == NH_SYMBOL || nh_index_get(seen, e, &known)) return false;
    nh_index_put(seen, e, 0);
    bool found = kind != NH_FUNCTION && !good(nh_constant_of(dag, e));
    for (size_t i = 0; i < nh_arity(dag, e) && !found; i++) {
        found = has_bad_number(dag, nh_child(dag, e, i), good, seen);
        if (kind == NH_SUM) found = found || !good(nh_coefficient_of(dag, e, i));
        if (kind == NH_PRODUCT) found = found || has_bad_number(dag, nh_exponent_of(dag, e, i), good, seen);
    }
    return found;
}

static bool all_numbers(const nh_dag *dag, nh_ex e, bool (*good)(nh_num))
{
    nh_index seen = {0};
    bool found = has_bad_number(dag, e, good, &seen);
    nh_index_clear(&seen);
    return !found;
}

bool nh_is_exact(const nh_dag *dag, nh_ex e) { return all_numbers(dag, e, nh_num_exact); }

bool nh_is_short(const nh_dag *dag, nh_ex e) { return all_numbers(dag, e, nh_num_short); }

/* ---- functions without singular points ---- */

static bool depends_on_any(const nh_dag *dag, nh_ex e, size_t symbols, const nh_ex *symbol)
{
    bool any = false;
    for (size_t k = 0; k < symbols && !any; k++) any = nh_depends(dag, e, symbol[k]);
    return any;
}

bool nh_is_entire(const nh_dag *dag, nh_ex e, size_t symbols, const nh_ex *symbol)
{
    NH_LIST(node);
    bool good = true;
    for (size_t i = nh_functions_in(dag, e, &node); i-- > 0 && good;) {
        nh_function f = nh_function_of(dag, node[i]);
        good = f == NH_SIN || f == NH_COS || f == NH_EXP || f == NH_SINH || f == NH_COSH || f == NH_TANH ||
               f == NH_ATAN || f == NH_ASINH || f == NH_PI || !depends_on_any(dag, node[i], symbols, symbol);
    }
    for (size_t i = nh_products_in(dag, e, &node); i-- > 0 && good;)
        for (size_t j = 0; j < nh_arity(dag, node[i]) && good; j++) {
            nh_ex base = nh_child(dag, node[i], j), power = nh_exponent_of(dag, node[i], j);
            bool whole = nh_kind_of(dag, power) == NH_NUMBER && nh_number_of(dag, power).q == 1 &&
                         nh_number_of(dag, power).p > 0;
            bool constant = !depends_on_any(dag, base, symbols, symbol) && !depends_on_any(dag, power, symbols, symbol);
            good = whole || constant;
        }
    return good;
}
