/* product: products and powers, the canonical constructors of dag.h.
 *
 * An atom (symbol, sum, function) has any exponent.  Other bases obey a relation,
 *
 *     (x y)^1 = x y,     |x|^2 = x^2,     2^1 = 2,
 *
 * so the constant of their exponent is kept in [0, 1), for |x| in [0, 2), and the rest goes to the atoms: a normal
 * form, whatever the order of multiplication. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/term_list.h"

nh_ex nh_product_without_number(nh_dag *dag, nh_ex e)
{
    if (nh_arity(dag, e) == 1 && nh_is_number(dag, nh_exponent_of(dag, e, 0), 1)) return nh_child(dag, e, 0);
    if (nh_num_is(nh_constant_of(dag, e), 1)) return e;
    nh_term_list b = {.c = nh_num_int(1)};
    for (size_t i = 0; i < nh_arity(dag, e); i++)
        nh_term_list_push(&b, (nh_term_list_item){.e = nh_child(dag, e, i), .x = nh_exponent_of(dag, e, i)});
    nh_ex result = nh_term_list_intern(dag, NH_PRODUCT, &b);
    nh_free(b.list);
    return result;
}

static bool is_integer(const nh_dag *dag, nh_ex e)
{
    return nh_kind_of(dag, e) == NH_NUMBER && nh_number_of(dag, e).q == 1;
}

static bool is_abs(const nh_dag *dag, nh_ex e)
{
    return nh_kind_of(dag, e) == NH_FUNCTION && nh_function_of(dag, e) == NH_ABS;
}

static void gather_factors(nh_dag *dag, nh_term_list *b, nh_ex e)
{
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER) {
        b->c = nh_num_mul(b->c, nh_number_of(dag, e));
    } else if (kind == NH_PRODUCT) {
        b->c = nh_num_mul(b->c, nh_constant_of(dag, e));
        for (size_t i = 0; i < nh_arity(dag, e); i++)
            nh_term_list_push(b, (nh_term_list_item){.e = nh_child(dag, e, i), .x = nh_exponent_of(dag, e, i)});
    } else {
        nh_term_list_push(b, (nh_term_list_item){.e = e, .x = nh_int(dag, 1)});
    }
}

static void merge_factors(nh_dag *dag, nh_term_list *b)
{
    if (b->count) qsort(b->list, b->count, sizeof *b->list, nh_term_list_order);
    size_t n = 0;
    for (size_t i = 0; i < b->count;) {
        nh_term_list_item x = b->list[i++];
        for (; i < b->count && b->list[i].e == x.e; i++) x.x = nh_add(dag, x.x, b->list[i].x);
        if (!nh_is_zero(dag, x.x)) b->list[n++] = x;
    }
    b->count = n;
}

/* n^(1/r) for a positive whole number, when it is whole; else 0. */
static int64_t exact_root(int64_t n, int64_t r)
{
    int64_t guess = (int64_t)llround(pow((double)n, 1.0 / (double)r));
    for (int64_t g = guess > 1 ? guess - 1 : 1; g <= guess + 1; g++) {
        __int128 power = 1;
        for (int64_t i = 0; i < r && power <= n; i++) power *= g;
        if (power == n) return g;
    }
    return 0;
}

/* The smallest prime in n > 1 and how often it divides n.  What has no prime below 1000 counts as a power of one. */
static int64_t prime_in(int64_t n, int64_t *times)
{
    for (int64_t d = 2; d < 1000 && d * d <= n; d++) {
        if (n % d) continue;
        for (*times = 0; n % d == 0; n /= d) ++*times;
        return d;
    }
    for (*times = 6; *times > 1; --*times) {
        int64_t root = exact_root(n, *times);
        if (root) return root;
    }
    return n;
}

static int64_t floor_of(nh_num x) { return x.p / x.q - (x.p % x.q < 0); }

/* n^x as whole powers and roots of primes. */
static void push_roots(nh_dag *dag, nh_term_list *b, int64_t n, nh_num x)
{
    while (n > 1) {
        int64_t times, prime = prime_in(n, &times);
        for (int64_t i = 0; i < times; i++) n /= prime;
        nh_num y = nh_num_mul(x, nh_num_int(times)), whole = nh_num_short(y) ? nh_num_int(floor_of(y)) : nh_num_int(0);
        b->c = nh_num_mul(b->c, nh_num_pow(nh_num_int(prime), whole.p));
        nh_num part = nh_num_add(y, nh_num_int(-whole.p));
        if (!nh_num_is(part, 0))
            nh_term_list_push(b, (nh_term_list_item){.e = nh_int(dag, prime), .x = nh_number(dag, part)});
    }
}

/* Splits a power of numbers into a coefficient and roots of primes; false if it must stay as it is. */
static bool split_number(nh_dag *dag, nh_term_list *b, nh_term_list_item power)
{
    if (nh_kind_of(dag, power.e) != NH_NUMBER || nh_kind_of(dag, power.x) != NH_NUMBER) return false;
    nh_num n = nh_number_of(dag, power.e), x = nh_number_of(dag, power.x);
    if (x.q == 1) {
        b->c = nh_num_mul(b->c, nh_num_pow(n, x.p));
        return true;
    }
    if (nh_num_value(n) < 0) return false;
    if (n.q == NH_LONG || x.q == NH_LONG) return false;
    if (n.p == 0 || !x.q) { /* inexact or zero */
        b->c = nh_num_mul(b->c, nh_num_real(pow(nh_num_value(n), nh_num_value(x))));
        return true;
    }
    int64_t times;
    if (n.q == 1 && x.p > 0 && x.p < x.q && prime_in(n.p, &times) == n.p) return false;
    push_roots(dag, b, n.p, x);
    push_roots(dag, b, n.q, nh_num_mul(x, nh_num_int(-1)));
    return true;
}

/* The s for which base^s is a product of other bases; 0 for an atom. */
static int64_t step_of(const nh_dag *dag, nh_ex base)
{
    nh_kind kind = nh_kind_of(dag, base);
    return is_abs(dag, base) ? 2 : kind == NH_NUMBER || kind == NH_PRODUCT;
}

/* base^s */
static nh_ex relation_of(nh_dag *dag, nh_ex base)
{
    return is_abs(dag, base) ? nh_powi(dag, nh_child(dag, base, 0), 2) : base;
}

/* The number of whole steps s in the constant of an exponent. */
static int64_t steps_in(const nh_dag *dag, nh_ex x, int64_t s)
{
    nh_kind kind = nh_kind_of(dag, x);
    nh_num c = nh_num_int(0);
    if (kind == NH_NUMBER) {
        c = nh_number_of(dag, x);
    } else if (kind == NH_SUM) {
        c = nh_constant_of(dag, x);
    } else if (kind == NH_PRODUCT && nh_arity(dag, x) == 1 && nh_is_number(dag, nh_exponent_of(dag, x, 0), 1)) {
        nh_ex sum = nh_child(dag, x, 0);
        if (nh_kind_of(dag, sum) == NH_SUM) c = nh_num_mul(nh_constant_of(dag, x), nh_constant_of(dag, sum));
    }
    c = nh_num_mul(c, nh_num_ratio(1, s));
    if (!nh_num_short(c) || fabs(nh_num_value(c)) > 1e18) return 0;
    return floor_of(c);
}

/* Moves whole steps of the exponents to the atoms; true when that changed something. */
static bool expand_factors(nh_dag *dag, nh_term_list *b)
{
    bool changed = false;
    for (size_t i = 0, n = b->count; i < n; i++) {
        nh_term_list_item x = b->list[i];
        if (split_number(dag, b, x)) {
            b->list[i].x = nh_int(dag, 0);
            changed = true;
            continue;
        }
        int64_t step = step_of(dag, x.e), k = step ? steps_in(dag, x.x, step) : 0;
        if (k == 0) continue;
        b->list[i].x = nh_add(dag, x.x, nh_int(dag, -k * step));
        gather_factors(dag, b, nh_powi(dag, relation_of(dag, x.e), k));
        changed = true;
    }
    return changed;
}

static nh_term_list_item *find_factor(const nh_term_list *b, nh_ex base)
{
    for (size_t i = 0; i < b->count; i++)
        if (b->list[i].e == base) return &b->list[i];
    return NULL;
}

/* Are all factors of the relation r divided out at least once? */
static bool all_below(const nh_dag *dag, const nh_term_list *b, const nh_term_list *r)
{
    for (size_t i = 0; i < r->count; i++) {
        const nh_term_list_item *f = find_factor(b, r->list[i].e);
        if (!f || nh_kind_of(dag, f->x) != NH_NUMBER || nh_kind_of(dag, r->list[i].x) != NH_NUMBER) return false;
        double ratio = nh_num_value(nh_number_of(dag, f->x)) / nh_num_value(nh_number_of(dag, r->list[i].x));
        if (!(ratio <= -1)) return false;
    }
    return r->count > 0;
}

/* 1/sqrt(x y) rather than sqrt(x y)/(x y), 1/|x| rather than |x|/x^2. */
static void take_back(nh_dag *dag, nh_term_list *b)
{
    bool changed = false;
    for (size_t i = 0; i < b->count; i++) {
        nh_ex base = b->list[i].e;
        int64_t step = step_of(dag, base);
        if (step == 0 || nh_kind_of(dag, base) == NH_NUMBER) continue;
        nh_term_list r = {.c = nh_num_int(1)};
        gather_factors(dag, &r, relation_of(dag, base));
        if (all_below(dag, b, &r)) {
            b->c = nh_num_mul(b->c, r.c);
            b->list[i].x = nh_add(dag, b->list[i].x, nh_int(dag, -step));
            for (size_t j = 0; j < r.count; j++) {
                nh_term_list_item *f = find_factor(b, r.list[j].e);
                f->x = nh_add(dag, f->x, r.list[j].x);
            }
            changed = true;
        }
        nh_free(r.list);
    }
    if (changed) merge_factors(dag, b);
}

/* 1/tan(pi/2), which is cot(pi/2) = 0. */
static bool has_zero_cotangent(nh_dag *dag, const nh_term_list *b)
{
    for (size_t i = 0; i < b->count; i++)
        if (is_integer(dag, b->list[i].x) && nh_number_of(dag, b->list[i].x).p < 0 &&
            nh_is_infinite_tangent(dag, b->list[i].e))
            return true;
    return false;
}

static nh_ex build_product(nh_dag *dag, nh_term_list *b)
{
    do merge_factors(dag, b);
    while (expand_factors(dag, b));
    if (nh_num_is(b->c, 0) || has_zero_cotangent(dag, b)) return nh_int(dag, 0);
    take_back(dag, b);
    if (b->count == 0) return nh_number(dag, b->c);
    if (b->count == 1 && nh_num_is(b->c, 1) && nh_is_number(dag, b->list[0].x, 1)) return b->list[0].e;
    return nh_term_list_intern(dag, NH_PRODUCT, b);
}

nh_ex nh_product(nh_dag *dag, size_t n, const nh_ex *factor)
{
    nh_term_list b = {.c = nh_num_int(1)};
    for (size_t i = 0; i < n; i++) gather_factors(dag, &b, factor[i]);
    nh_ex e = build_product(dag, &b);
    nh_free(b.list);
    return e;
}

nh_ex nh_mul(nh_dag *dag, nh_ex a, nh_ex b)
{
    if (nh_is_number(dag, a, 1)) return b;
    if (nh_is_number(dag, b, 1)) return a;
    return nh_product(dag, 2, (nh_ex[]){a, b});
}

nh_ex nh_div(nh_dag *dag, nh_ex a, nh_ex b) { return nh_mul(dag, a, nh_powi(dag, b, -1)); }

/* ---- powers ---- */

static bool is_exponential(const nh_dag *dag, nh_ex e)
{
    return nh_kind_of(dag, e) == NH_FUNCTION && nh_function_of(dag, e) == NH_EXP;
}

/* exp(u)^n = exp(n u), which is positive */
static nh_ex exponential_power(nh_dag *dag, nh_ex e, nh_ex n)
{
    return nh_call(dag, NH_EXP, nh_mul(dag, n, nh_child(dag, e, 0)));
}

static bool has_exponentials(const nh_dag *dag, nh_ex e)
{
    enum { most = 16 };
    NH_LIST(call);
    size_t n = nh_functions_in(dag, e, &call);
    bool found = n > most;
    for (size_t i = 0; i < n && !found; i++) found = is_exponential(dag, call[i]);
    return found;
}

/* (rest exp(u)^x)^n = rest^n exp(n x u) where the rest has no exponentials; exp(-u) (a exp(u) + b) stays as it is.
 * Returns the rest. */
static nh_ex take_exponentials(nh_dag *dag, nh_term_list *b, nh_ex product, nh_ex n)
{
    nh_ex rest = product, one = nh_int(dag, 1);
    for (size_t i = 0; nh_kind_of(dag, product) == NH_PRODUCT && i < nh_arity(dag, product); i++)
        if (!is_exponential(dag, nh_child(dag, product, i)) && has_exponentials(dag, nh_child(dag, product, i)))
            return product;
    if (is_exponential(dag, product)) {
        nh_term_list_push(b, (nh_term_list_item){.e = exponential_power(dag, product, n), .x = one});
        return one;
    }
    for (size_t i = 0; nh_kind_of(dag, product) == NH_PRODUCT && i < nh_arity(dag, product); i++) {
        nh_ex e = nh_child(dag, product, i), x = nh_exponent_of(dag, product, i);
        if (!is_exponential(dag, e)) continue;
        rest = nh_mul(dag, rest, nh_pow(dag, e, nh_neg(dag, x)));
        nh_term_list_push(b, (nh_term_list_item){.e = exponential_power(dag, e, nh_mul(dag, n, x)), .x = one});
    }
    return rest;
}

/* (c prod b^x)^n: for a whole n factor by factor; for other n, |c| and exponentials are taken out. */
static void push_power(nh_dag *dag, nh_term_list *b, nh_ex base, nh_ex n)
{
    nh_num c = nh_constant_of(dag, base);
    if (is_integer(dag, n)) {
        b->c = nh_num_pow(c, nh_number_of(dag, n).p);
        for (size_t i = 0; i < nh_arity(dag, base); i++)
            nh_term_list_push(
                b, (nh_term_list_item){.e = nh_child(dag, base, i), .x = nh_mul(dag, nh_exponent_of(dag, base, i), n)});
        return;
    }
    bool minus = nh_num_value(c) < 0;
    nh_ex size = nh_number(dag, minus ? nh_num_mul(c, nh_num_int(-1)) : c), rest = nh_product_without_number(dag, base);
    if (nh_kind_of(dag, n) == NH_NUMBER) rest = take_exponentials(dag, b, rest, n);
    if (!nh_is_number(dag, size, 1)) nh_term_list_push(b, (nh_term_list_item){.e = size, .x = n});
    nh_term_list_push(b, (nh_term_list_item){.e = minus ? nh_neg(dag, rest) : rest, .x = n});
}

nh_ex nh_pow(nh_dag *dag, nh_ex base, nh_ex exponent)
{
    if (nh_is_zero(dag, exponent) || nh_is_number(dag, base, 1)) return nh_int(dag, 1);
    if (nh_is_number(dag, exponent, 1)) return base;
    bool numeric = nh_kind_of(dag, exponent) == NH_NUMBER;
    if (nh_is_zero(dag, base) && numeric)
        return nh_num_value(nh_number_of(dag, exponent)) > 0 ? base : nh_real(dag, NAN);
    bool whole = !numeric || !nh_num_short(nh_number_of(dag, exponent)) || nh_number_of(dag, exponent).q == 1;
    if (!whole && is_exponential(dag, base)) return exponential_power(dag, base, exponent);
    nh_term_list b = {.c = nh_num_int(1)};
    if (nh_kind_of(dag, base) == NH_PRODUCT) push_power(dag, &b, base, exponent);
    else nh_term_list_push(&b, (nh_term_list_item){.e = base, .x = exponent});
    nh_ex e = build_product(dag, &b);
    nh_free(b.list);
    return e;
}

nh_ex nh_powi(nh_dag *dag, nh_ex base, int64_t exponent) { return nh_pow(dag, base, nh_int(dag, exponent)); }
nh_ex nh_sqrt(nh_dag *dag, nh_ex a) { return nh_pow(dag, a, nh_ratio(dag, 1, 2)); }
