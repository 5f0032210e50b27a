/* Expressions as truncated power series modulo a prime: e(z) up to the order of the ring, where the symbols are
 * series.
 *
 *         symbols set by nh_jet_eval_set                 CONSTANT: kept for all later evaluations
 *             |                                          VARYING:  forgotten when a symbol that varies is set anew
 *        a stack of nodes, operands first                UNKNOWN:  not computed yet
 *             |
 *        compute: by the kind of the node
 *             sum, product, power         jet_ring.h
 *             exp, sin, log, atan ..      constant terms from the point (jet_point.h), the rest by the Euler field
 *             primitives, solutions       f = int P, f' = P + Q f, f'' = P f' + Q f: recurrences, too
 *             unspecified functions       random derivatives, which depend on the residue of the argument only
 *
 * Every node of the graph is computed once; an expression that occurs in many others costs no more than one that
 * occurs in one. Where a constant term does not exist (a pole, a root of a non-residue), the point is `unlucky`, and
 * the caller takes another one. */
#include "exact/jet_eval.h"

#include <string.h>

#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

typedef enum { UNKNOWN, CONSTANT, VARYING } state;

struct nh_jet_eval {
    nh_jet_point *point;
    const nh_jet_ring *ring;
    nh_dag *dag;
    nh_jet_table of;
    nh_residue **value; /* of.value */
    nh_arena *arena;    /* of the values */
    nh_residue *factor; /* room for two series, of products */
    /* nodes that have memory for a value; those computed that vary; those to be computed */
    nh_ex *touched, *changing, *stack;
    size_t touches, touched_capacity, changes, change_capacity, stack_capacity;
    bool unlucky;
};

nh_jet_eval *nh_jet_eval_create(nh_jet_point *point, const nh_jet_ring *ring)
{
    nh_jet_eval *v = nh_alloc(sizeof *v);
    size_t nodes = nh_dag_size(point->dag);
    *v = (nh_jet_eval){.point = point, .ring = ring, .dag = point->dag, .arena = nh_arena_create()};
    if (point->spare.nodes >= nodes) {
        v->of = point->spare;
        point->spare = (nh_jet_table){0};
    } else {
        v->of.nodes = nodes + nodes / 4; /* the graph may grow until the next evaluation */
        v->of.value = nh_alloc_array(v->of.nodes, sizeof *v->of.value);
        v->of.state = nh_alloc_array(v->of.nodes, sizeof *v->of.state);
    }
    v->value = v->of.value;
    v->factor = nh_arena_alloc(v->arena, 2 * ring->size * sizeof *v->factor);
    return v;
}

void nh_jet_eval_free(nh_jet_eval *v)
{
    if (!v) return;
    for (size_t i = 0; i < v->touches; i++) {
        v->value[v->touched[i]] = NULL;
        v->of.state[v->touched[i]] = UNKNOWN;
    }
    nh_jet_table less = v->of;
    if (v->of.nodes > v->point->spare.nodes) {
        less = v->point->spare;
        v->point->spare = v->of;
    }
    nh_free(less.value);
    nh_free(less.state);
    nh_arena_free(v->arena);
    nh_free(v->touched);
    nh_free(v->changing);
    nh_free(v->stack);
    nh_free(v);
}

/* Makes room for the value of a node: only a few nodes of a large graph have one. */
static nh_residue *room(nh_jet_eval *v, nh_ex e)
{
    size_t size = v->ring->size * sizeof **v->value;
    if (v->value[e]) return memset(v->value[e], 0, size);
    nh_grow(&v->touched, &v->touched_capacity, v->touches + 1, sizeof *v->touched);
    v->touched[v->touches++] = e;
    return v->value[e] = nh_arena_alloc(v->arena, size);
}

void nh_jet_eval_set(nh_jet_eval *v, nh_ex symbol, const nh_residue *series, bool varies)
{
    for (size_t i = 0; varies && i < v->changes; i++) v->of.state[v->changing[i]] = UNKNOWN;
    if (varies) v->changes = 0;
    memcpy(room(v, symbol), series, v->ring->size * sizeof *series);
    v->of.state[symbol] = varies ? VARYING : CONSTANT;
}

/* ---- one node ---- */

/* p/q modulo the prime; unlucky where the prime divides q. */
static nh_residue number(nh_jet_eval *v, nh_num a)
{
    nh_residue r = 0;
    if (!nh_jet_point_number(v->point, a, &r)) v->unlucky = true;
    return r;
}

/* sum_i c_i e_i + c */
static void sum(nh_jet_eval *v, nh_ex e, nh_residue *out)
{
    nh_jet_constant(v->ring, number(v, nh_constant_of(v->dag, e)), out);
    for (size_t i = 0; i < nh_arity(v->dag, e); i++)
        nh_jet_add_multiple(v->ring, out, number(v, nh_coefficient_of(v->dag, e, i)), v->value[nh_child(v->dag, e, i)]);
}

/* base^n for a whole n: by the recurrence where the base does not vanish at the point, otherwise by squaring. */
static void whole_power(nh_jet_eval *v, const nh_residue *base, int64_t n, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    if (n == 2) {
        nh_jet_mul(r, base, base, out);
        return;
    }
    if (base[0]) { /* by the recurrence */
        nh_residue at = nh_residue_power(r->field, base[0], (uint64_t)(n < 0 ? -n : n));
        nh_jet_power(r, base, nh_residue_of(r->field, n), n < 0 ? nh_residue_inverse(r->field, at) : at, out);
        return;
    }
    v->unlucky |= n < 0;
    nh_residue *square = nh_alloc_array(2 * r->size, sizeof *square), *product = square + r->size;
    memcpy(square, base, r->size * sizeof *square);
    nh_jet_constant(r, 1, out);
    for (uint64_t k = (uint64_t)(n < 0 ? 0 : n); k; k >>= 1) {
        if (k & 1) {
            nh_jet_mul(r, out, square, product);
            memcpy(out, product, r->size * sizeof *out);
        }
        nh_jet_mul(r, square, square, product);
        memcpy(square, product, r->size * sizeof *square);
    }
    nh_free(square);
}

/* base^(p/q): the constant term is the root that the point chose for the base, the rest follows by nh_jet_power; a
 * base that is known to be a square P^2 gives P^p instead (q = 2). */
static void power(nh_jet_eval *v, nh_ex base, nh_num exponent, nh_residue *out)
{
    const nh_residue *b = v->value[base];
    nh_residue at, s = number(v, exponent);
    const nh_jet_kernel *k = exponent.q == 2 ? nh_jet_point_dependent(v->point, base) : NULL;
    if (exponent.q == 1 || k) {
        whole_power(v, k ? v->value[k->P] : b, exponent.p, out);
    } else if (b[0] && nh_jet_point_root(v->point, base, b[0], exponent, &at)) {
        nh_jet_power(v->ring, b, s, at, out);
    } else {
        v->unlucky = true;
    }
}

/* c prod_i base_i^(n_i) */
static void product(nh_jet_eval *v, nh_ex e, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    nh_residue *factor = v->factor, *both = factor + r->size;
    for (size_t i = 0; i < nh_arity(v->dag, e) && !v->unlucky; i++) {
        nh_num x = nh_number_of(v->dag, nh_exponent_of(v->dag, e, i));
        const nh_residue *with = v->value[nh_child(v->dag, e, i)];
        if (!nh_num_is(x, 1)) {
            power(v, nh_child(v->dag, e, i), x, factor);
            with = factor;
        }
        if (i > 0) nh_jet_mul(r, out, with, both);
        memcpy(out, i > 0 ? both : with, r->size * sizeof *out);
    }
    if (!nh_num_is(nh_constant_of(v->dag, e), 1)) nh_jet_scale(r, out, number(v, nh_constant_of(v->dag, e)));
}

/* tan = sin/cos, and the hyperbolic functions by exp: numerator and denominator */
static void divide(nh_jet_eval *v, const nh_residue *top, const nh_residue *bottom, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    if (!bottom[0]) {
        v->unlucky = true;
        return;
    }
    nh_residue *inverse = nh_alloc_array(r->size, sizeof *inverse);
    nh_jet_power(r, bottom, (nh_residue)(r->field.p - 1), nh_residue_inverse(r->field, bottom[0]), inverse);
    nh_jet_mul(r, top, inverse, out);
    nh_free(inverse);
}

static void circular(nh_jet_eval *v, nh_ex e, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    nh_ex argument = nh_child(v->dag, e, 0);
    nh_function f = nh_function_of(v->dag, e);
    nh_residue *sine = nh_alloc_array(2 * r->size, sizeof *sine), *cosine = sine + r->size, s, c;
    v->unlucky |= !nh_jet_point_circle(v->point, argument, &s, &c);
    if (!v->unlucky) {
        nh_jet_circle(r, v->value[argument], s, c, sine, cosine);
        if (f == NH_TAN) divide(v, sine, cosine, out);
        else memcpy(out, f == NH_SIN ? sine : cosine, r->size * sizeof *out);
    }
    nh_free(sine);
}

/* exp(u), or with exp(-u) the hyperbolic functions. */
static void exponential(nh_jet_eval *v, nh_ex e, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    nh_ex argument = nh_child(v->dag, e, 0);
    nh_function f = nh_function_of(v->dag, e);
    nh_residue *up = nh_alloc_array(4 * r->size, sizeof *up), *down = up + r->size, *sine = down + r->size,
               *cosine = sine + r->size, at;
    nh_jet_point_exponential(v->point, argument, &at);
    nh_jet_exponential(r, v->value[argument], at, up);
    if (f == NH_EXP) {
        memcpy(out, up, r->size * sizeof *out);
    } else {
        nh_residue half = nh_residue_inverse(r->field, 2), minus = nh_residue_negative(r->field, half);
        nh_jet_power(r, up, (nh_residue)(r->field.p - 1), nh_residue_inverse(r->field, at), down);
        nh_jet_add_multiple(r, sine, half, up);
        nh_jet_add_multiple(r, sine, minus, down);
        nh_jet_add_multiple(r, cosine, half, up);
        nh_jet_add_multiple(r, cosine, half, down);
        if (f == NH_TANH) divide(v, sine, cosine, out);
        else memcpy(out, f == NH_SINH ? sine : cosine, r->size * sizeof *out);
    }
    nh_free(up);
}

/* f'(u) of the inverse functions and the logarithm: 1/u, 1/(1 + u^2), 1/(1 - u^2), or what the point knows. */
static bool slope(nh_jet_eval *v, nh_ex e, const nh_residue *u, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    nh_function f = nh_function_of(v->dag, e);
    nh_residue minus = (nh_residue)(r->field.p - 1);
    const nh_jet_kernel *k = nh_jet_point_inverse(v->point, e);
    if (k) memcpy(out, v->value[k->P], r->size * sizeof *out);
    if (k) return true;
    nh_residue *inner = nh_alloc_array(2 * r->size, sizeof *inner), *square = inner + r->size;
    nh_jet_mul(r, u, u, square);
    nh_jet_constant(r, 1, inner);
    nh_jet_add_multiple(r, inner, f == NH_ATANH ? minus : 1, square);
    if (f == NH_LOG) memcpy(inner, u, r->size * sizeof *inner);
    bool good = inner[0] != 0;
    if (good) nh_jet_power(r, inner, minus, nh_residue_inverse(r->field, inner[0]), out);
    nh_free(inner);
    return good;
}

/* E(atan2(y, x)) = (x E(y) - y E(x))/(x^2 + y^2) */
static bool angle(nh_jet_eval *v, const nh_residue *y, const nh_residue *x, nh_residue at, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    nh_residue *work = nh_alloc_array(4 * r->size, sizeof *work), *top = work + r->size, *bottom = top + r->size,
               *rate = bottom + r->size;
    nh_jet_euler(r, y, work);
    nh_jet_add_product(r, top, x, work);
    nh_jet_euler(r, x, work);
    nh_jet_sub_product(r, top, y, work);
    nh_jet_add_product(r, bottom, x, x);
    nh_jet_add_product(r, bottom, y, y);
    divide(v, top, bottom, rate);
    if (!v->unlucky) nh_jet_euler_inverse(r, rate, at, out);
    nh_free(work);
    return !v->unlucky;
}

/* Logarithms, inverse functions, atan2, |u| and sign(u): a constant term of the point's, then E(f) = f'(u) E(u). */
static void primitive(nh_jet_eval *v, nh_ex e, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    nh_function f = nh_function_of(v->dag, e);
    nh_residue at = nh_jet_point_free_value(v->point, e), root;
    if (f == NH_PI) {
        nh_jet_constant(r, at, out);
        return;
    }
    const nh_residue *u = v->value[nh_child(v->dag, e, 0)];
    if (f == NH_ABS || f == NH_SIGN) { /* the sign for which it is a square */
        nh_residue sign = u[0] && nh_residue_root(r->field, u[0], 2, &root) ? 1 : (nh_residue)(r->field.p - 1);
        v->unlucky |= !u[0];
        nh_jet_constant(r, f == NH_SIGN ? sign : 0, out);
        if (f == NH_ABS) nh_jet_add_multiple(r, out, sign, u);
    } else if (f == NH_ATAN2) {
        v->unlucky |= !angle(v, u, v->value[nh_child(v->dag, e, 1)], at, out);
    } else {
        nh_residue *rate = nh_alloc_array(r->size, sizeof *rate);
        if (slope(v, e, u, rate)) nh_jet_integral(r, u, rate, at, out);
        else v->unlucky = true;
        nh_free(rate);
    }
}

/* Solves f' = P + Q f, exact to one order more at each step; one of the arguments varies. */
static void first_order(nh_jet_eval *v, const nh_jet_kernel *k, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    const nh_residue *u = v->value[nh_child(v->dag, k->key, k->place)];
    nh_residue *prime = nh_alloc_array(r->size, sizeof *prime);
    for (size_t i = 0; i < nh_arity(v->dag, k->key); i++)
        v->unlucky |= i != k->place && v->of.state[nh_child(v->dag, k->key, i)] == VARYING;
    nh_jet_constant(r, k->value, out);
    for (size_t order = 0; order < r->order; order++) {
        memcpy(prime, v->value[k->P], r->size * sizeof *prime);
        nh_jet_add_product(r, prime, v->value[k->Q], out);
        nh_jet_integral(r, u, prime, k->value, out);
    }
    nh_free(prime);
}

/* Solves f'' = P f' + Q f: E(f) = f' E(u) and E(f') = f'' E(u), exact to one order more at each step. */
static void solution(nh_jet_eval *v, nh_ex e, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    const nh_jet_kernel *k = nh_jet_point_solution(v->point, e);
    if (k->kind == NH_JET_FIRST_ORDER) {
        first_order(v, k, out);
        return;
    }
    const nh_residue *u = v->value[nh_child(v->dag, e, nh_arity(v->dag, e) - 1)];
    nh_residue *f = nh_alloc_array(3 * r->size, sizeof *f), *prime = f + r->size, *second = prime + r->size;
    nh_jet_constant(r, k->value, f);
    nh_jet_constant(r, k->sine, prime);
    for (size_t order = 0; order < r->order; order++) {
        nh_jet_mul(r, v->value[k->P], prime, second);
        nh_jet_add_product(r, second, v->value[k->Q], f);
        nh_jet_integral(r, u, prime, k->value, out);
        memcpy(f, out, r->size * sizeof *f);
        nh_jet_integral(r, u, second, k->sine, out);
        memcpy(prime, out, r->size * sizeof *prime);
    }
    memcpy(out, e == k->key ? f : prime, r->size * sizeof *out);
    nh_free(f);
}

/* The n-th derivative of an unspecified function at u = u_0 + w: sum_k V^(n+k)(u_0) w^k/k! with random derivatives at
 * the residue u_0, the same wherever the argument has this value. */
static void unspecified(nh_jet_eval *v, nh_ex e, nh_residue *out)
{
    const nh_jet_ring *r = v->ring;
    int64_t f = nh_number_of(v->dag, nh_child(v->dag, e, 0)).p, n = nh_number_of(v->dag, nh_child(v->dag, e, 1)).p;
    const nh_residue *u = v->value[nh_child(v->dag, e, 2)];
    nh_residue *w = nh_alloc_array(2 * r->size, sizeof *w), *next = w + r->size, at = u[0];
    memcpy(w, u, r->size * sizeof *w);
    w[0] = 0;
    nh_jet_constant(r, 0, out);
    for (size_t k = r->order + 1; k-- > 0;) {
        nh_jet_mul(r, out, w, next);
        nh_jet_scale(r, next, nh_residue_inverse(r->field, (nh_residue)(k + 1)));
        memcpy(out, next, r->size * sizeof *out);
        out[0] = nh_jet_point_derivative(v->point, f, n + (int64_t)k, at);
    }
    nh_free(w);
}

static bool is_solution(const nh_jet_eval *v, nh_ex e)
{
    nh_function f = nh_kind_of(v->dag, e) == NH_FUNCTION ? nh_function_of(v->dag, e) : NH_PI;
    return nh_is_named_function(f) && f != NH_UNSPECIFIED;
}

/* The value of one node whose operands are known. */
static void compute(nh_jet_eval *v, nh_ex e)
{
    nh_residue *out = room(v, e);
    switch (nh_kind_of(v->dag, e)) {
    case NH_NUMBER: nh_jet_constant(v->ring, number(v, nh_number_of(v->dag, e)), out); break;
    case NH_SYMBOL: v->unlucky = true; return; /* the symbol is not set */
    case NH_SUM: sum(v, e, out); break;
    case NH_PRODUCT: product(v, e, out); break;
    default:
        switch (nh_function_of(v->dag, e)) {
        case NH_SIN:
        case NH_COS:
        case NH_TAN: circular(v, e, out); break;
        case NH_EXP:
        case NH_SINH:
        case NH_COSH:
        case NH_TANH: exponential(v, e, out); break;
        case NH_UNSPECIFIED: unspecified(v, e, out); break;
        default:
            if (is_solution(v, e)) solution(v, e, out);
            else primitive(v, e, out);
        }
    }
    v->of.state[e] = CONSTANT;
    for (size_t i = 0; nh_kind_of(v->dag, e) != NH_NUMBER && i < nh_arity(v->dag, e); i++)
        if (v->of.state[nh_child(v->dag, e, i)] == VARYING) v->of.state[e] = VARYING;
    if (v->of.state[e] != VARYING) return;
    nh_grow(&v->changing, &v->change_capacity, v->changes + 1, sizeof *v->changing);
    v->changing[v->changes++] = e;
}

/* The i-th expression that must be known before e; false behind the last. */
static bool operand(nh_jet_eval *v, nh_ex e, size_t i, nh_ex *out)
{
    nh_kind kind = nh_kind_of(v->dag, e);
    size_t arity = kind == NH_NUMBER || kind == NH_SYMBOL ? 0 : nh_arity(v->dag, e);
    if (i < arity) *out = nh_child(v->dag, e, i);
    if (i < arity) return true;
    if (kind == NH_PRODUCT && i < 2 * arity) { /* the functions that roots are */
        nh_num x = nh_number_of(v->dag, nh_exponent_of(v->dag, e, i - arity));
        const nh_jet_kernel *root = x.q == 2 ? nh_jet_point_dependent(v->point, nh_child(v->dag, e, i - arity)) : NULL;
        *out = root ? root->P : nh_child(v->dag, e, i - arity);
        return true;
    }
    if (i > arity + 1) return false;
    const nh_jet_kernel *k = nh_jet_point_inverse(v->point, e);
    if (k) *out = k->P;
    if (k || !is_solution(v, e)) return k && i == arity;
    k = nh_jet_point_solution(v->point, e);
    *out = i == arity ? k->P : k->Q;
    return true;
}

/* Evaluates e and what it is made of, operands first. */
static void compute_all(nh_jet_eval *v, nh_ex e)
{
    size_t depth = 0;
    nh_grow(&v->stack, &v->stack_capacity, 1, sizeof *v->stack);
    v->stack[depth++] = e;
    while (depth && !v->unlucky) {
        nh_ex top = v->stack[depth - 1], child = top;
        size_t before = depth;
        for (size_t i = 0; v->of.state[top] == UNKNOWN && operand(v, top, i, &child); i++) {
            if (v->of.state[child] != UNKNOWN) continue;
            nh_grow(&v->stack, &v->stack_capacity, depth + 1, sizeof *v->stack);
            v->stack[depth++] = child;
        }
        if (depth > before) continue;
        if (v->of.state[top] == UNKNOWN) compute(v, top);
        depth--;
    }
}

/* ---- several expressions ---- */

/* out: n x ring->size. */
bool nh_jet_eval_all(nh_jet_eval *v, size_t n, const nh_ex *e, nh_residue *out)
{
    for (size_t k = 0; k < n && !v->unlucky; k++) compute_all(v, e[k]);
    for (size_t k = 0; k < n && !v->unlucky; k++)
        memcpy(out + k * v->ring->size, v->value[e[k]], v->ring->size * sizeof *out);
    return !v->unlucky;
}

/* Does a kernel belong to the family of exp and log, or to that of sin, cos and their inverses? */
static bool belongs(const nh_jet_eval *v, const nh_jet_kernel *k, bool real)
{
    if (k->kind == NH_JET_CIRCLE || k->kind == NH_JET_EXPONENTIAL)
        return (k->kind == NH_JET_EXPONENTIAL) == real && nh_kind_of(v->dag, k->key) != NH_NUMBER &&
               !(k->kind == NH_JET_CIRCLE && nh_jet_point_is_pi(v->point, k->key));
    if (k->kind != NH_JET_FREE) return false;
    nh_function f = nh_function_of(v->dag, k->key);
    if (f == NH_ABS || f == NH_SIGN || f == NH_PI) return false;
    return (f == NH_LOG || f == NH_ASINH || f == NH_ACOSH || f == NH_ATANH) == real;
}

bool nh_jet_eval_atoms(nh_jet_eval *v, bool real, size_t *count, nh_residue *out)
{
    const nh_jet_point *x = v->point;
    bool good = true;
    *count = 0;
    for (size_t i = 0; i < x->kernels && good; i++) {
        if (!belongs(v, &x->kernel[i], real)) continue;
        nh_residue *series = out ? out + *count * v->ring->size : NULL;
        good = !out || nh_jet_eval_all(v, 1, &x->kernel[i].key, series);
        if (out) series[0] = 0;
        ++*count;
    }
    return good;
}
