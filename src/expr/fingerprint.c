#include "expr/fingerprint.h"

#include <flint/nmod.h>
#include <stdlib.h>

#include "base/memory.h"
#include "expr/num_long.h"

typedef struct {
    const nh_dag *dag;
    nmod_t field;
    uint64_t *value; /* per node */
    bool *wanted;
} evaluation;

/* A place that looks random (the finalizer of SplitMix64). */
static uint64_t place(const evaluation *v, uint64_t kind, uint64_t x)
{
    x += 0x9e3779b97f4a7c15u * (kind + 1);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (x ^ (x >> 31)) % v->field.n;
}

enum { BY_POSITION, BY_NAME, OF_DOUBLE, OF_FUNCTION, OF_ROOT, OF_POWER, OF_ZERO, OF_PAIR, OF_LIST };

static uint64_t named(const evaluation *v, const char *name)
{
    uint64_t h = 0xcbf29ce484222325u; /* Fowler, Noll and Vo */
    for (; *name; name++) h = (h ^ (unsigned char)*name) * 0x100000001b3u;
    return place(v, BY_NAME, h);
}

static uint64_t inverse(const evaluation *v, uint64_t x) { return x ? nmod_inv(x, v->field) : place(v, OF_ZERO, 0); }

static uint64_t of_number(const evaluation *v, nh_num a)
{
    if (!nh_num_exact(a)) {
        union {
            double d;
            uint64_t bits;
        } same = {.d = nh_num_value(a)};
        return place(v, OF_DOUBLE, same.bits);
    }
    mpq_t q;
    mpq_init(q);
    nh_num_get_mpq(q, a);
    uint64_t top = mpz_fdiv_ui(mpq_numref(q), v->field.n), bottom = mpz_fdiv_ui(mpq_denref(q), v->field.n);
    mpq_clear(q);
    return nmod_mul(top, inverse(v, bottom), v->field);
}

/* base^exponent: whole powers are powers of the field, those with a denominator whole powers of a root. */
static uint64_t of_power(const evaluation *v, uint64_t base, nh_ex exponent)
{
    nh_num x = nh_kind_of(v->dag, exponent) == NH_NUMBER ? nh_number_of(v->dag, exponent) : nh_num_real(0.5);
    if (nh_kind_of(v->dag, exponent) != NH_NUMBER || !nh_num_short(x)) return place(v, OF_POWER, place(v, OF_PAIR, base) ^ v->value[exponent]);
    if (x.q != 1) base = place(v, OF_ROOT + 16 * (uint64_t)x.q, base);
    uint64_t power = nmod_pow_ui(base, (ulong)llabs(x.p), v->field);
    return x.p < 0 ? inverse(v, power) : power;
}

static uint64_t of_function(const evaluation *v, nh_ex e)
{
    nh_function f = nh_function_of(v->dag, e);
    uint64_t kind = OF_FUNCTION + 16 * (uint64_t)(f + 1), n = v->field.n, argument = nh_arity(v->dag, e) ? v->value[nh_child(v->dag, e, 0)] : 0;
    if (nh_arity(v->dag, e) == 2) return place(v, kind, place(v, OF_PAIR, argument) ^ v->value[nh_child(v->dag, e, 1)]);
    /* odd and even functions are, so that it does not matter which sign was taken out */
    bool other = argument > n / 2, odd = f == NH_SIN || f == NH_TAN || f == NH_ASIN || f == NH_ATAN || f == NH_SINH || f == NH_TANH || f == NH_ASINH || f == NH_ATANH || f == NH_SIGN;
    bool even = f == NH_COS || f == NH_COSH || f == NH_ABS;
    uint64_t out = place(v, kind, other && (odd || even) ? n - argument : argument);
    return other && odd && out ? n - out : out;
}

static uint64_t of_node(const evaluation *v, nh_ex e)
{
    const nh_dag *d = v->dag;
    uint64_t out;
    switch (nh_kind_of(d, e)) {
    case NH_NUMBER: return of_number(v, nh_number_of(d, e));
    case NH_SYMBOL: return named(v, nh_name_of(d, e));
    case NH_SUM:
        out = of_number(v, nh_constant_of(d, e));
        for (size_t i = 0; i < nh_arity(d, e); i++) out = nmod_add(out, nmod_mul(of_number(v, nh_coefficient_of(d, e, i)), v->value[nh_child(d, e, i)], v->field), v->field);
        return out;
    case NH_PRODUCT:
        out = of_number(v, nh_constant_of(d, e));
        for (size_t i = 0; i < nh_arity(d, e); i++) out = nmod_mul(out, of_power(v, v->value[nh_child(d, e, i)], nh_exponent_of(d, e, i)), v->field);
        return out;
    default: return of_function(v, e);
    }
}

/* Operands stand before what is made of them. */
static void want(evaluation *v, nh_ex top)
{
    for (size_t e = top + 1; e-- > 0;) {
        nh_kind kind = nh_kind_of(v->dag, (nh_ex)e);
        if (!v->wanted[e] || kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        for (size_t i = 0; i < nh_arity(v->dag, (nh_ex)e); i++) {
            v->wanted[nh_child(v->dag, (nh_ex)e, i)] = true;
            if (kind == NH_PRODUCT) v->wanted[nh_exponent_of(v->dag, (nh_ex)e, i)] = true;
        }
    }
}

uint64_t nh_fingerprint(const nh_dag *dag, size_t n, const nh_ex *e, size_t n_in, const nh_ex *in, size_t n_fixed, const nh_ex *fixed, const double *value)
{
    evaluation v = {.dag = dag, .value = nh_alloc_array(nh_dag_size(dag) + 1, sizeof *v.value), .wanted = nh_alloc_array(nh_dag_size(dag) + 1, sizeof *v.wanted)};
    nmod_init(&v.field, ((ulong)1 << 61) - 1);
    nh_ex top = 0;
    for (size_t k = 0; k < n; k++) {
        v.wanted[e[k]] = true;
        if (e[k] > top) top = e[k];
    }
    want(&v, top);
    uint64_t *known = nh_alloc_array(nh_dag_size(dag) + 1, sizeof *known); /* 1 + value of the symbols that were given */
    for (size_t i = 0; i < n_in; i++) known[in[i]] = 1 + place(&v, BY_POSITION, i);
    for (size_t i = 0; i < n_fixed; i++) known[fixed[i]] = 1 + of_number(&v, nh_num_decimal(value[i]));
    for (size_t i = 0; n && i <= top; i++)
        if (v.wanted[i]) v.value[i] = known[i] ? known[i] - 1 : of_node(&v, (nh_ex)i);
    uint64_t out = place(&v, OF_LIST, n);
    for (size_t k = 0; k < n; k++) out = place(&v, OF_LIST, out ^ v.value[e[k]]);
    nh_free(known);
    nh_free(v.wanted);
    nh_free(v.value);
    return out;
}
