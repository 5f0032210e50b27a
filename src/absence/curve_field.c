#include "absence/curve_field.h"

void nh_curve_field_init(nh_curve_field *field)
{
    fmpz_poly_init(field->num);
    fmpz_poly_init(field->den);
    fmpz_poly_set_coeff_ui(field->num, 1, 1);
    fmpz_poly_set_ui(field->den, 1);
}

void nh_curve_field_clear(nh_curve_field *field)
{
    fmpz_poly_clear(field->num);
    fmpz_poly_clear(field->den);
}

void nh_curve_field_element_init(nh_curve_element *e)
{
    fmpz_poly_init(e->even);
    fmpz_poly_init(e->odd);
    fmpz_poly_init(e->den);
    fmpz_poly_set_ui(e->den, 1);
}

void nh_curve_field_element_clear(nh_curve_element *e)
{
    fmpz_poly_clear(e->even);
    fmpz_poly_clear(e->odd);
    fmpz_poly_clear(e->den);
}

nh_curve_element *nh_curve_field_elements(size_t count)
{
    nh_curve_element *e = nh_alloc_array(count + 1, sizeof *e);
    for (size_t i = 0; i < count; i++) nh_curve_field_element_init(&e[i]);
    return e;
}

void nh_curve_field_elements_free(nh_curve_element *e, size_t count)
{
    for (size_t i = 0; i < count; i++) nh_curve_field_element_clear(&e[i]);
    nh_free(e);
}

void nh_curve_field_set(nh_curve_element *out, const nh_curve_element *a)
{
    fmpz_poly_set(out->even, a->even);
    fmpz_poly_set(out->odd, a->odd);
    fmpz_poly_set(out->den, a->den);
}

void nh_curve_field_set_fmpq(nh_curve_element *out, const fmpq_t a)
{
    fmpz_poly_set_fmpz(out->even, fmpq_numref(a));
    fmpz_poly_zero(out->odd);
    fmpz_poly_set_fmpz(out->den, fmpq_denref(a));
}

void nh_curve_field_set_si(nh_curve_element *out, slong a)
{
    fmpz_poly_set_si(out->even, a);
    fmpz_poly_zero(out->odd);
    fmpz_poly_set_ui(out->den, 1);
}

void nh_curve_field_set_x(nh_curve_element *out)
{
    nh_curve_field_set_si(out, 0);
    fmpz_poly_set_coeff_ui(out->even, 1, 1);
}

void nh_curve_field_set_w(nh_curve_element *out)
{
    nh_curve_field_set_si(out, 0);
    fmpz_poly_set_ui(out->odd, 1);
}

bool nh_curve_field_is_zero(const nh_curve_element *a)
{
    return fmpz_poly_is_zero(a->even) && fmpz_poly_is_zero(a->odd);
}

bool nh_curve_field_equal(const nh_curve_element *a, const nh_curve_element *b)
{
    return fmpz_poly_equal(a->even, b->even) && fmpz_poly_equal(a->odd, b->odd) && fmpz_poly_equal(a->den, b->den);
}

bool nh_curve_field_is_even(const nh_curve_element *a) { return fmpz_poly_is_zero(a->odd); }

bool nh_curve_field_is_odd(const nh_curve_element *a) { return fmpz_poly_is_zero(a->even); }

/* Cancels what even, odd and den have in common. */
static void reduce(nh_curve_element *e)
{
    fmpz_poly_t common;
    fmpz_poly_init(common);
    fmpz_poly_gcd(common, e->even, e->den);
    fmpz_poly_gcd(common, common, e->odd);
    if (fmpz_sgn(fmpz_poly_lead(common)) != fmpz_sgn(fmpz_poly_lead(e->den))) fmpz_poly_neg(common, common);
    if (!fmpz_poly_is_one(common)) {
        fmpz_poly_div(e->even, e->even, common);
        fmpz_poly_div(e->odd, e->odd, common);
        fmpz_poly_div(e->den, e->den, common);
    }
    fmpz_poly_clear(common);
}

void nh_curve_field_add(nh_curve_element *out, const nh_curve_element *a, const nh_curve_element *b)
{
    fmpz_poly_t common, of_a, of_b, product;
    fmpz_poly_init(common);
    fmpz_poly_init(of_a);
    fmpz_poly_init(of_b);
    fmpz_poly_init(product);
    fmpz_poly_gcd(common, a->den, b->den);
    fmpz_poly_div(of_a, b->den, common);
    fmpz_poly_div(of_b, a->den, common);
    fmpz_poly_mul(product, b->even, of_b);
    fmpz_poly_mul(common, a->even, of_a);
    fmpz_poly_add(common, common, product);
    fmpz_poly_mul(product, b->odd, of_b);
    fmpz_poly_mul(of_b, a->odd, of_a);
    fmpz_poly_add(product, product, of_b);
    fmpz_poly_mul(out->den, a->den, of_a);
    fmpz_poly_swap(out->even, common);
    fmpz_poly_swap(out->odd, product);
    fmpz_poly_clear(common);
    fmpz_poly_clear(of_a);
    fmpz_poly_clear(of_b);
    fmpz_poly_clear(product);
    reduce(out);
}

void nh_curve_field_scale(nh_curve_element *out, const nh_curve_element *a, const fmpq_t c)
{
    fmpz_poly_scalar_mul_fmpz(out->even, a->even, fmpq_numref(c));
    fmpz_poly_scalar_mul_fmpz(out->odd, a->odd, fmpq_numref(c));
    fmpz_poly_scalar_mul_fmpz(out->den, a->den, fmpq_denref(c));
    reduce(out);
}

/* (a0 + a1 w)(b0 + b1 w) = (a0 b0 den + a1 b1 num)/den + (a0 b1 + a1 b0) w */
void nh_curve_field_mul(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a,
                        const nh_curve_element *b)
{
    fmpz_poly_t even, odd, other;
    fmpz_poly_init(even);
    fmpz_poly_init(odd);
    fmpz_poly_init(other);
    fmpz_poly_mul(even, a->even, b->even);
    fmpz_poly_mul(odd, a->even, b->odd);
    fmpz_poly_mul(other, a->odd, b->even);
    fmpz_poly_add(odd, odd, other);
    fmpz_poly_mul(other, a->odd, b->odd);
    fmpz_poly_mul(out->den, a->den, b->den);
    if (!fmpz_poly_is_zero(other)) {
        fmpz_poly_mul(other, other, field->num);
        fmpz_poly_mul(even, even, field->den);
        fmpz_poly_add(even, even, other);
        fmpz_poly_mul(odd, odd, field->den);
        fmpz_poly_mul(out->den, out->den, field->den);
    }
    fmpz_poly_swap(out->even, even);
    fmpz_poly_swap(out->odd, odd);
    fmpz_poly_clear(even);
    fmpz_poly_clear(odd);
    fmpz_poly_clear(other);
    reduce(out);
}

void nh_curve_field_submul(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a,
                           const nh_curve_element *b)
{
    if (nh_curve_field_is_zero(a) || nh_curve_field_is_zero(b)) return;
    nh_curve_element product;
    nh_curve_field_element_init(&product);
    nh_curve_field_mul(field, &product, a, b);
    fmpz_poly_neg(product.even, product.even);
    fmpz_poly_neg(product.odd, product.odd);
    nh_curve_field_add(out, out, &product);
    nh_curve_field_element_clear(&product);
}

/* den/(even + odd w) = den (even - odd w) field.den/(even^2 field.den - odd^2 field.num) */
bool nh_curve_field_inv(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a)
{
    if (nh_curve_field_is_zero(a)) return false;
    fmpz_poly_t norm, other;
    fmpz_poly_init(norm);
    fmpz_poly_init(other);
    fmpz_poly_sqr(norm, a->even);
    fmpz_poly_mul(norm, norm, field->den);
    fmpz_poly_sqr(other, a->odd);
    fmpz_poly_mul(other, other, field->num);
    fmpz_poly_sub(norm, norm, other);
    bool good = !fmpz_poly_is_zero(norm);
    if (good) {
        fmpz_poly_mul(other, a->den, field->den);
        fmpz_poly_mul(out->odd, a->odd, other);
        fmpz_poly_neg(out->odd, out->odd);
        fmpz_poly_mul(out->even, a->even, other);
        fmpz_poly_swap(out->den, norm);
        reduce(out);
    }
    fmpz_poly_clear(norm);
    fmpz_poly_clear(other);
    return good;
}

bool nh_curve_field_pow(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a, slong n)
{
    nh_curve_element base;
    nh_curve_field_element_init(&base);
    nh_curve_field_set(&base, a);
    bool good = n >= 0 || nh_curve_field_inv(field, &base, a);
    ulong exponent = n < 0 ? 0 - (ulong)n : (ulong)n;
    nh_curve_field_set_si(out, 1);
    for (; good && exponent; exponent >>= 1) {
        if (exponent & 1) nh_curve_field_mul(field, out, out, &base);
        if (exponent > 1) nh_curve_field_mul(field, &base, &base, &base);
    }
    nh_curve_field_element_clear(&base);
    return good;
}

/* The sign of a/b, b with a positive leading coefficient, on a side; 0: it has none, or a pole. */
static int sign_of(const fmpz_poly_t a, const fmpz_poly_t b, nh_curve_side side)
{
    int far = fmpz_sgn(fmpz_poly_lead(a));
    bool odd = (fmpz_poly_degree(a) + fmpz_poly_degree(b)) % 2 != 0;
    if (side != NH_CURVE_NEAR) return side == NH_CURVE_FAR_BELOW && odd ? -far : far;
    return fmpz_sgn(a->coeffs) * fmpz_sgn(b->coeffs);
}

bool nh_curve_field_sqrt(nh_curve_element *out, const nh_curve_element *a, nh_curve_side side)
{
    if (!nh_curve_field_is_even(a) || nh_curve_field_is_zero(a)) return false;
    fmpz_poly_t product, root;
    fmpz_poly_init(product);
    fmpz_poly_init(root);
    fmpz_poly_mul(product, a->even, a->den);
    int sign = fmpz_poly_sqrt(root, product) ? sign_of(root, a->den, side) : 0;
    if (sign) {
        fmpz_poly_set(out->den, a->den);
        if (sign < 0) fmpz_poly_neg(root, root);
        fmpz_poly_swap(out->even, root);
        fmpz_poly_zero(out->odd);
        reduce(out);
    }
    fmpz_poly_clear(product);
    fmpz_poly_clear(root);
    return sign != 0;
}

/* out = (n/d)' */
static void quotient_rule(fmpz_poly_t num, fmpz_poly_t den, const fmpz_poly_t n, const fmpz_poly_t d)
{
    fmpz_poly_t slope;
    fmpz_poly_init(slope);
    fmpz_poly_derivative(slope, n);
    fmpz_poly_mul(num, slope, d);
    fmpz_poly_derivative(slope, d);
    fmpz_poly_mul(slope, slope, n);
    fmpz_poly_sub(num, num, slope);
    fmpz_poly_sqr(den, d);
    fmpz_poly_clear(slope);
}

/* w' = (w^2)'/(2 w^2) w */
void nh_curve_field_derivative(const nh_curve_field *field, nh_curve_element *out, const nh_curve_element *a)
{
    nh_curve_element even, odd, slope;
    nh_curve_field_element_init(&even);
    nh_curve_field_element_init(&odd);
    nh_curve_field_element_init(&slope);
    quotient_rule(even.even, even.den, a->even, a->den);
    quotient_rule(odd.odd, odd.den, a->odd, a->den);
    fmpz_poly_set(slope.odd,
                  a->odd); /* a1 w (w^2)'/(2 w^2), of the quotient num/den: (num' den - num den')/(2 num den) */
    fmpz_poly_set(slope.den, a->den);
    nh_curve_element rate;
    nh_curve_field_element_init(&rate);
    quotient_rule(rate.even, rate.den, field->num, field->den);
    fmpz_poly_mul(rate.den, field->num, field->den);
    fmpz_poly_scalar_mul_ui(rate.den, rate.den, 2);
    reduce(&rate);
    nh_curve_field_mul(field, &slope, &slope, &rate);
    nh_curve_field_add(out, &even, &odd);
    nh_curve_field_add(out, out, &slope);
    nh_curve_field_element_clear(&rate);
    nh_curve_field_element_clear(&even);
    nh_curve_field_element_clear(&odd);
    nh_curve_field_element_clear(&slope);
}
