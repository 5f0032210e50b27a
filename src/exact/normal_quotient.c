#include "exact/normal_quotient.h"

#include <math.h>
#include <stdlib.h>

#include "exact/normal_quotient_internal.h"
#include "graph/num.h"
#include "graph/num_long.h"

enum { conjugate_pairs = 500 };

/* A double as the dyadic rational that it is. */
static void set_double(nh_quotient_field *f, nh_quotient *q, double value)
{
    int exponent;
    double mantissa = ldexp(frexp(value, &exponent), 53);
    exponent -= 53;
    fmpz_t power;
    fmpz_init(power);
    fmpz_one(power);
    fmpz_mul_2exp(power, power, (ulong)abs(exponent));
    fmpz_mpoly_set_si(q->num, (slong)mantissa, f->ctx);
    if (exponent > 0) fmpz_mpoly_scalar_mul_fmpz(q->num, q->num, power, f->ctx);
    else fmpz_mpoly_set_fmpz(q->den, power, f->ctx);
    fmpz_clear(power);
}

static void set_long(nh_quotient_field *f, nh_quotient *q, nh_num value)
{
    mpq_t v;
    fmpz_t z;
    mpq_init(v);
    fmpz_init(z);
    nh_num_get_mpq(v, value);
    fmpz_set_mpz(z, mpq_numref(v));
    fmpz_mpoly_set_fmpz(q->num, z, f->ctx);
    fmpz_set_mpz(z, mpq_denref(v));
    fmpz_mpoly_set_fmpz(q->den, z, f->ctx);
    fmpz_clear(z);
    mpq_clear(v);
}

const nh_quotient *nh_quotient_number(nh_quotient_field *field, nh_num value)
{
    nh_quotient *q = nh_quotient_fresh(field);
    if (nh_num_short(value)) {
        fmpz_mpoly_set_si(q->num, value.p, field->ctx);
        fmpz_mpoly_set_si(q->den, value.q, field->ctx);
    } else if (nh_num_exact(value)) {
        set_long(field, q, value);
    } else {
        set_double(field, q, value.d);
        nh_quotient_cancel(field, q);
    }
    return q;
}

const nh_quotient *nh_quotient_power_of(nh_quotient_field *field, size_t generator, int64_t power)
{
    nh_quotient *q = nh_quotient_fresh(field);
    fmpz_mpoly_struct *side = power < 0 ? q->den : q->num;
    ulong n = power < 0 ? -(ulong)power : (ulong)power;
    fmpz_mpoly_one(q->num, field->ctx);
    fmpz_mpoly_gen(side, (slong)generator, field->ctx);
    if (n != 1 && !fmpz_mpoly_pow_ui(side, side, n, field->ctx)) nh_quotient_field_break(field, NH_FIELD_TOO_LARGE);
    return field->relations ? nh_quotient_normalise(field, q) : q;
}

const nh_quotient *nh_quotient_add(nh_quotient_field *field, const nh_quotient *a, const nh_quotient *b)
{
    nh_quotient *q = nh_quotient_fresh(field);
    if (!nh_quotient_field_spend(field, (double)(a->num->length + b->num->length))) return q;
    if (fmpz_mpoly_equal(a->den, b->den, field->ctx)) {
        fmpz_mpoly_add(q->num, a->num, b->num, field->ctx);
        fmpz_mpoly_set(q->den, a->den, field->ctx);
        nh_quotient_cancel(field, q); /* sums of reduced numerators are reduced */
        nh_quotient_field_check_size(field, q->num);
        return q;
    }
    fmpz_mpoly_t g, left, right;
    fmpz_mpoly_init(g, field->ctx);
    fmpz_mpoly_init(left, field->ctx);
    fmpz_mpoly_init(right, field->ctx);
    bool cheap = nh_quotient_field_cheap_gcd(field, a->den, b->den);
    if (!cheap || !nh_quotient_field_gcd(field, g, a->den, b->den)) fmpz_mpoly_one(g, field->ctx);
    fmpz_mpoly_divexact(left, b->den, g, field->ctx);
    fmpz_mpoly_divexact(right, a->den, g, field->ctx);
    nh_quotient_field_times(field, q->den, a->den, left);
    nh_quotient_field_times(field, left, left, a->num);
    nh_quotient_field_times(field, right, right, b->num);
    fmpz_mpoly_add(q->num, left, right, field->ctx);
    fmpz_mpoly_clear(g, field->ctx);
    fmpz_mpoly_clear(left, field->ctx);
    fmpz_mpoly_clear(right, field->ctx);
    return nh_quotient_normalise(field, q);
}

const nh_quotient *nh_quotient_mul(nh_quotient_field *field, const nh_quotient *a, const nh_quotient *b)
{
    nh_quotient *q = nh_quotient_fresh(field);
    nh_quotient_field_times(field, q->num, a->num, b->num);
    nh_quotient_field_times(field, q->den, a->den, b->den);
    return nh_quotient_normalise(field, q);
}

const nh_quotient *nh_quotient_inv(nh_quotient_field *field, const nh_quotient *a)
{
    nh_quotient *q = nh_quotient_fresh(field);
    fmpz_mpoly_set(q->num, a->den, field->ctx);
    fmpz_mpoly_set(q->den, a->num, field->ctx);
    return nh_quotient_normalise(field, q);
}

const nh_quotient *nh_quotient_pow(nh_quotient_field *field, const nh_quotient *a, int64_t n)
{
    if (n < 0) return nh_quotient_pow(field, nh_quotient_inv(field, a), -n);
    if (n == 1) return a;
    const nh_quotient *result = nh_quotient_number(field, nh_num_int(1));
    for (; n && field->state == NH_FIELD_FINE; n >>= 1) {
        if (n & 1) result = nh_quotient_mul(field, result, a);
        if (n > 1) a = nh_quotient_mul(field, a, a);
    }
    return result;
}

const nh_quotient *nh_quotient_scale(nh_quotient_field *field, const nh_quotient *a, nh_num c)
{
    if (nh_num_is(c, 1)) return a;
    return nh_quotient_mul(field, a, nh_quotient_number(field, c));
}

const nh_quotient *nh_quotient_again(nh_quotient_field *field, const nh_quotient *a)
{
    nh_quotient *q = nh_quotient_fresh(field);
    fmpz_mpoly_set(q->num, a->num, field->ctx);
    fmpz_mpoly_set(q->den, a->den, field->ctx);
    return nh_quotient_normalise(field, q);
}

bool nh_quotient_is_zero(const nh_quotient_field *field, const nh_quotient *a)
{
    return fmpz_mpoly_is_zero(a->num, field->ctx);
}

bool nh_quotient_equal(const nh_quotient_field *field, const nh_quotient *a, const nh_quotient *b)
{
    return fmpz_mpoly_equal(a->num, b->num, field->ctx) && fmpz_mpoly_equal(a->den, b->den, field->ctx);
}

bool nh_quotient_has(const nh_quotient_field *field, const nh_quotient *a, size_t generator)
{
    slong g = (slong)generator;
    return fmpz_mpoly_degree_si(a->num, g, field->ctx) > 0 || fmpz_mpoly_degree_si(a->den, g, field->ctx) > 0;
}

size_t nh_quotient_terms(const nh_quotient *a) { return (size_t)(a->num->length + a->den->length); }

/* (A + B r)^-1 = (A - B r)/(A^2 - B^2 r^2), with r from the last relation to the first. */
const nh_quotient *nh_quotient_rationalise(nh_quotient_field *field, const nh_quotient *a)
{
    for (size_t i = field->relations; i-- > 0 && field->state == NH_FIELD_FINE;) {
        slong g = field->relation[i].generator;
        if (field->relation[i].order != 2 || field->relation[i].mixed ||
            fmpz_mpoly_degree_si(a->den, g, field->ctx) != 1)
            continue;
        if ((double)(a->num->length + a->den->length) * (double)a->den->length > conjugate_pairs) return a;
        nh_quotient *q = nh_quotient_fresh(field);
        fmpz_mpoly_t conjugate;
        fmpz_mpoly_init(conjugate, field->ctx);
        fmpz_mpoly_derivative(conjugate, a->den, g, field->ctx); /* B */
        fmpz_mpoly_gen(q->num, g, field->ctx);
        fmpz_mpoly_mul(conjugate, conjugate, q->num, field->ctx);
        fmpz_mpoly_scalar_mul_si(conjugate, conjugate, -2, field->ctx);
        fmpz_mpoly_add(conjugate, conjugate, a->den, field->ctx);
        nh_quotient_field_times(field, q->num, a->num, conjugate);
        nh_quotient_field_times(field, q->den, a->den, conjugate);
        fmpz_mpoly_clear(conjugate, field->ctx);
        a = nh_quotient_normalise(field, q);
    }
    return a;
}

void nh_quotient_divide(nh_quotient_field *field, const nh_quotient *a, const nh_quotient **whole,
                        const nh_quotient **rest)
{
    nh_quotient *w = nh_quotient_fresh(field), *r = nh_quotient_fresh(field);
    fmpz_t scale; /* scale num = Q den + R */
    fmpz_init_set_ui(scale, 1);
    *whole = w;
    *rest = r;
    fmpz_mpoly_set(r->num, a->num, field->ctx);
    if (a->den->length > 1) fmpz_mpoly_quasidivrem(scale, w->num, r->num, a->num, a->den, field->ctx);
    fmpz_mpoly_scalar_mul_fmpz(r->den, a->den, scale, field->ctx);
    fmpz_mpoly_set_fmpz(w->den, scale, field->ctx);
    fmpz_clear(scale);
    nh_quotient_cancel(field, w);
    nh_quotient_cancel(field, r);
}

/* (s/den)^2 = num/den for s^2 = num den. */
const nh_quotient *nh_quotient_root(nh_quotient_field *field, const nh_quotient *a)
{
    nh_quotient *q = nh_quotient_fresh(field);
    fmpz_mpoly_t both;
    fmpz_mpoly_init(both, field->ctx);
    nh_quotient_field_times(field, both, a->num, a->den);
    bool good = field->state == NH_FIELD_FINE && fmpz_mpoly_sqrt(q->num, both, field->ctx);
    fmpz_mpoly_set(q->den, a->den, field->ctx);
    fmpz_mpoly_clear(both, field->ctx);
    if (good) nh_quotient_cancel(field, q);
    return good ? q : NULL;
}
