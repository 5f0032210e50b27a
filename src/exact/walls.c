#include "exact/walls.h"

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/named_function.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_nested = 6 };

static void put(nh_walls *w, nh_ex e, bool edge)
{
    for (size_t i = 0; i < w->count; i++) {
        if (w->e[i] != e) continue;
        w->edge[i] = w->edge[i] && edge;
        w->cut[i] = w->cut[i] && w->cutting;
        return;
    }
    w->left_out |= w->count == NH_MOST_WALLS;
    if (w->count == NH_MOST_WALLS) return;
    w->e[w->count] = e;
    w->cut[w->count] = w->cutting;
    w->edge[w->count++] = edge;
}

static void put_part(nh_walls *w, nh_ex e)
{
    for (size_t i = 0; i < w->parts; i++)
        if (w->part[i] == e) return;
    w->left_out |= w->parts == NH_MOST_WALL_PARTS;
    if (w->parts < NH_MOST_WALL_PARTS) w->part[w->parts++] = e;
}

static bool is_even(const nh_dag *d, nh_ex exponent)
{
    nh_num x = nh_kind_of(d, exponent) == NH_NUMBER ? nh_number_of(d, exponent) : nh_num_int(1);
    return x.q == 1 && x.p % 2 == 0;
}

static void put_factors(nh_walls *w, nh_dag *d, nh_ex e, bool edge, int depth);

/* base^exponent, a factor of a term below a root or a sign: adds its pole. */
static void put_pole(nh_walls *w, nh_dag *d, nh_ex base, nh_ex exponent, bool edge, int depth)
{
    bool number = nh_kind_of(d, exponent) == NH_NUMBER, even = is_even(d, exponent);
    bool negative = number && nh_num_value(nh_number_of(d, exponent)) < 0;
    if (negative) put_factors(w, d, base, edge && !even, depth + 1);
    else if (nh_kind_of(d, base) == NH_FUNCTION && nh_function_of(d, base) == NH_TAN)
        put_factors(w, d, nh_call(d, NH_COS, nh_child(d, base, 0)), edge && !even, depth + 1);
}

/* The poles of a sum, which may change its sign there like 1/x + 1, or be large on both sides like 1/x^2 + 1, whose
 * root is sqrt(x^2 + 1)/|x|. */
static void put_poles_of_terms(nh_walls *w, nh_dag *d, nh_ex sum, bool edge, int depth)
{
    for (size_t i = 0; i < nh_arity(d, sum); i++) {
        nh_ex term = nh_child(d, sum, i);
        bool product = nh_kind_of(d, term) == NH_PRODUCT;
        for (size_t k = 0; k < (product ? nh_arity(d, term) : 1); k++)
            put_pole(w, d, product ? nh_child(d, term, k) : term, product ? nh_exponent_of(d, term, k) : nh_int(d, 1),
                     edge, depth);
    }
}

/* The factors of an expression that vanishes on a wall: for a product all bases, since a quotient changes its sign at a
 * pole, too.  `edge`: under a root. */
static void put_factors(nh_walls *w, nh_dag *d, nh_ex e, bool edge, int depth)
{
    nh_kind kind = nh_kind_of(d, e);
    w->left_out |= depth > most_nested && kind != NH_NUMBER && kind != NH_SYMBOL;
    if (kind == NH_NUMBER || (depth > most_nested && kind != NH_SYMBOL)) return;
    if (kind == NH_FUNCTION && nh_function_of(d, e) == NH_ABS) {
        put_factors(w, d, nh_child(d, e, 0), false, depth + 1);
    } else if (kind == NH_PRODUCT) {
        for (size_t i = 0; i < nh_arity(d, e); i++)
            put_factors(w, d, nh_child(d, e, i), edge && !is_even(d, nh_exponent_of(d, e, i)), depth + 1);
    } else if (kind != NH_FUNCTION || nh_function_of(d, e) != NH_EXP) {
        nh_ex factored = kind == NH_SUM && depth == 0 ? nh_simplify_short(d, e, 0) : e;
        if (factored != e) {
            put_factors(w, d, factored, edge, depth + 1);
            return;
        }
        put(w, e, edge);
        if (kind == NH_SUM) put_poles_of_terms(w, d, e, edge, depth);
    }
}

/* Where v is infinite: the bases of its negative powers, and the cosines of its tangents. */
static void put_poles(nh_walls *w, nh_dag *d, nh_ex v, int depth)
{
    nh_kind kind = nh_kind_of(d, v);
    if (kind == NH_NUMBER || kind == NH_SYMBOL) return;
    w->left_out |= depth > most_nested;
    if (depth > most_nested) return;
    if (kind == NH_FUNCTION && nh_function_of(d, v) == NH_TAN)
        put_factors(w, d, nh_call(d, NH_COS, nh_child(d, v, 0)), false, 0);
    for (size_t i = 0; i < nh_arity(d, v); i++) {
        nh_ex x = kind == NH_PRODUCT ? nh_exponent_of(d, v, i) : nh_int(d, 1), base = nh_child(d, v, i);
        if (nh_kind_of(d, x) != NH_NUMBER || nh_num_value(nh_number_of(d, x)) < 0) put_factors(w, d, base, false, 0);
        if (kind != NH_FUNCTION || nh_function_of(d, v) != NH_TAN) put_poles(w, d, base, depth + 1);
    }
}

/* Where 1 - m sin(u)^2 vanishes for an amplitude u = 2 atan(..): another branch goes on there. */
static void put_branch(nh_walls *w, nh_dag *d, nh_ex e)
{
    nh_ex angle = nh_mul(d, nh_ratio(d, 1, 2), nh_child(d, e, 0));
    bool twice = nh_kind_of(d, angle) == NH_FUNCTION && nh_function_of(d, angle) == NH_ATAN;
    if (twice) put_factors(w, d, nh_simplify_short(d, nh_powi(d, nh_named_function_rate(d, e, 0), -2), 0), false, 0);
}

/* The walls of one function call, as in the table of walls.h. */
static void put_function(nh_walls *w, nh_dag *d, nh_ex e)
{
    size_t n = nh_arity(d, e);
    nh_ex v = n ? nh_child(d, e, 0) : 0, last = n ? nh_child(d, e, n - 1) : 0, one = nh_int(d, 1);
    nh_function f = nh_function_of(d, e);
    w->cutting = f == NH_ATAN2 || f == NH_ATAN || f == NH_ASIN || f == NH_ACOS;
    switch (f) {
    case NH_ATAN2:
        put_part(w, last);
        put_factors(w, d, v, false, 0);
        break;
    case NH_ABS:
    case NH_SIGN: put_factors(w, d, v, false, 0); break;
    case NH_ATAN: put_poles(w, d, v, 0); break;
    case NH_ASIN:
    case NH_ACOS: put_factors(w, d, nh_sub(d, one, nh_powi(d, v, 2)), false, 0); break;
    case NH_ACOSH: put_factors(w, d, nh_sub(d, v, one), false, 0); break;
    case NH_HYPERU:
    case NH_HYPERU_PRIME:
    case NH_BESSEL_J:
    case NH_BESSEL_J_PRIME:
    case NH_BESSEL_Y:
    case NH_BESSEL_Y_PRIME:
    case NH_BESSEL_I:
    case NH_BESSEL_I_PRIME:
    case NH_BESSEL_K:
    case NH_BESSEL_K_PRIME: put_factors(w, d, last, false, 0); break;
    case NH_LEGENDRE_P:
    case NH_LEGENDRE_P_PRIME:
    case NH_LEGENDRE_Q:
    case NH_LEGENDRE_Q_PRIME: put_factors(w, d, nh_sub(d, one, nh_powi(d, last, 2)), false, 0); break;
    case NH_HYP2F1:
    case NH_HYP2F1_PRIME: put_factors(w, d, nh_sub(d, one, last), false, 0); break;
    case NH_ELLIPTIC_F: put_branch(w, d, e); break;
    default: break;
    }
    w->cutting = false;
}

/* The walls of functions and roots, or the poles.  Operands have smaller indices: going downwards from the top, each
 * node is visited once. */
static void add_below(nh_walls *w, nh_dag *d, nh_ex top, bool poles)
{
    bool *wanted = nh_alloc_array((size_t)top + 1, sizeof *wanted);
    wanted[top] = true;
    for (size_t k = (size_t)top + 1; k-- > 0;) {
        nh_ex e = (nh_ex)k;
        nh_kind kind = nh_kind_of(d, e);
        if (!wanted[k] || kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        if (kind == NH_FUNCTION && !poles) put_function(w, d, e);
        else if (kind == NH_FUNCTION && nh_function_of(d, e) == NH_LOG) put_factors(w, d, nh_child(d, e, 0), false, 0);
        for (size_t i = 0; i < nh_arity(d, e); i++) {
            wanted[nh_child(d, e, i)] = true;
            if (kind != NH_PRODUCT) continue;
            nh_ex x = nh_exponent_of(d, e, i);
            bool whole = nh_kind_of(d, x) == NH_NUMBER && nh_number_of(d, x).q == 1;
            if (poles) put_pole(w, d, nh_child(d, e, i), x, false, 0);
            else if (!whole) put_factors(w, d, nh_child(d, e, i), true, 0);
            wanted[x] |= !poles;
        }
    }
    nh_free(wanted);
}

void nh_walls_add(nh_walls *w, nh_dag *d, nh_ex top) { add_below(w, d, top, false); }

void nh_walls_add_poles(nh_walls *w, nh_dag *d, nh_ex top) { add_below(w, d, top, true); }

size_t nh_walls_between(nh_dag *d, size_t n, const nh_ex *e, size_t inputs, const nh_ex *in, nh_ex *wall)
{
    nh_walls w = {0};
    size_t count = 0;
    for (size_t i = 0; i < n; i++) nh_walls_add(&w, d, e[i]);
    for (size_t i = 0; i < w.count; i++) {
        bool varies = false;
        for (size_t j = 0; j < inputs; j++) varies |= nh_depends(d, w.e[i], in[j]);
        if (varies && !w.edge[i]) wall[count++] = w.e[i];
    }
    return count;
}

/* ---- on one side ---- */

typedef struct {
    nh_dag *d;
    nh_ex (*sign)(void *context, nh_ex u);
    void *context;
} chosen;

static nh_ex on_its_side(void *chosen_, nh_ex call)
{
    const chosen *c = chosen_;
    nh_function f = nh_function_of(c->d, call);
    nh_ex u = f == NH_ABS || f == NH_SIGN ? nh_child(c->d, call, 0) : 0, s = u ? c->sign(c->context, u) : 0;
    return s && f == NH_ABS ? nh_mul(c->d, s, u) : s;
}

nh_ex nh_walls_piece(nh_dag *d, nh_ex e, nh_ex (*sign)(void *context, nh_ex u), void *context)
{
    chosen c = {d, sign, context};
    nh_ex before = 0;
    for (int level = 0; level < most_nested && e != before; level++) {
        before = e;
        e = nh_substitute_calls(d, e, on_its_side, &c);
    }
    return e;
}

nh_ex nh_walls_side(nh_wall_sides *sides, nh_ex u)
{
    nh_ex sign = nh_call(sides->dag, NH_SIGN, u);
    for (size_t k = 0; k < sides->count; k++)
        if (sides->sign[k] == sign) return sides->symbol[k];
    sides->left_out |= sides->count == NH_MOST_SIDES;
    if (sides->left_out) return 0;
    sides->sign[sides->count] = sign;
    return sides->symbol[sides->count++] = nh_symbol_fresh(sides->dag, "side");
}

nh_ex nh_walls_signs(const nh_wall_sides *sides, nh_ex e)
{
    return nh_substitute(sides->dag, e, sides->count, sides->symbol, sides->sign);
}
