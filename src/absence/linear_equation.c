#include "absence/linear_equation.h"

void nh_linear_equation_init(nh_linear_equation *equation, size_t size)
{
    equation->size = size;
    equation->num = nh_alloc((size * size + 1) * sizeof *equation->num);
    for (size_t k = 0; k < size * size; k++) fmpz_poly_init(equation->num + k);
    fmpz_poly_init(equation->den);
    fmpz_poly_set_ui(equation->den, 1);
}

void nh_linear_equation_clear(nh_linear_equation *equation)
{
    for (size_t k = 0; k < equation->size * equation->size; k++) fmpz_poly_clear(equation->num + k);
    nh_free(equation->num);
    fmpz_poly_clear(equation->den);
    equation->size = 0;
    equation->num = NULL;
}

/* n/d over the integers, reduced, d with a positive leading coefficient. */
static void reduced_quotient(fmpz_poly_t n, fmpz_poly_t d, const fmpq_poly_t num, const fmpq_poly_t den)
{
    fmpz_poly_t common;
    fmpz_poly_init(common);
    fmpq_poly_get_numerator(n, num);
    fmpq_poly_get_numerator(d, den);
    fmpz_poly_scalar_mul_fmpz(n, n, fmpq_poly_denref(den));
    fmpz_poly_scalar_mul_fmpz(d, d, fmpq_poly_denref(num));
    fmpz_poly_gcd(common, n, d);
    fmpz_poly_div(n, n, common);
    fmpz_poly_div(d, d, common);
    if (fmpz_sgn(fmpz_poly_lead(d)) < 0) {
        fmpz_poly_neg(n, n);
        fmpz_poly_neg(d, d);
    }
    fmpz_poly_clear(common);
}

void nh_linear_equation_set(nh_linear_equation *equation, size_t i, size_t j, const fmpq_poly_t num,
                            const fmpq_poly_t den)
{
    fmpz_poly_t n, d, common;
    fmpz_poly_init(n);
    fmpz_poly_init(d);
    fmpz_poly_init(common);
    reduced_quotient(n, d, num, den);
    fmpz_poly_gcd(common, equation->den, d);
    fmpz_poly_div(d, d, common); /* what the common denominator lacks */
    for (size_t k = 0; k < equation->size * equation->size; k++) fmpz_poly_mul(equation->num + k, equation->num + k, d);
    fmpz_poly_div(common, equation->den, common);
    fmpz_poly_mul(equation->num + i * equation->size + j, n, common);
    fmpz_poly_mul(equation->den, equation->den, d);
    fmpz_poly_clear(n);
    fmpz_poly_clear(d);
    fmpz_poly_clear(common);
}

void nh_linear_equation_reduce(nh_linear_equation *equation)
{
    size_t entries = equation->size * equation->size;
    fmpz_poly_t common;
    fmpz_poly_init(common);
    fmpz_poly_set(common, equation->den);
    for (size_t k = 0; k < entries; k++) fmpz_poly_gcd(common, common, equation->num + k);
    if (fmpz_sgn(fmpz_poly_lead(common)) != fmpz_sgn(fmpz_poly_lead(equation->den))) fmpz_poly_neg(common, common);
    for (size_t k = 0; k < entries; k++) fmpz_poly_div(equation->num + k, equation->num + k, common);
    fmpz_poly_div(equation->den, equation->den, common);
    fmpz_poly_clear(common);
}

/* ---- quotients of polynomials over Q ---- */

typedef struct {
    fmpq_poly_t num, den;
} quotient;

static void quotient_init(quotient *q)
{
    fmpq_poly_init(q->num);
    fmpq_poly_init(q->den);
    fmpq_poly_set_ui(q->den, 1);
}

static void quotient_clear(quotient *q)
{
    fmpq_poly_clear(q->num);
    fmpq_poly_clear(q->den);
}

static void quotient_reduce(quotient *q)
{
    fmpq_poly_t common;
    fmpq_poly_init(common);
    fmpq_poly_gcd(common, q->num, q->den);
    fmpq_poly_div(q->num, q->num, common);
    fmpq_poly_div(q->den, q->den, common);
    fmpq_poly_clear(common);
}

static void quotient_entry(quotient *q, const nh_linear_equation *equation, size_t k)
{
    fmpq_poly_set_fmpz_poly(q->num, equation->num + k);
    fmpq_poly_set_fmpz_poly(q->den, equation->den);
    quotient_reduce(q);
}

/* a += factor b */
static void quotient_add(quotient *a, int factor, const quotient *b)
{
    fmpq_poly_t other;
    fmpq_poly_init(other);
    fmpq_poly_mul(other, b->num, a->den);
    fmpq_poly_scalar_mul_si(other, other, factor);
    fmpq_poly_mul(a->num, a->num, b->den);
    fmpq_poly_add(a->num, a->num, other);
    fmpq_poly_mul(a->den, a->den, b->den);
    quotient_reduce(a);
    fmpq_poly_clear(other);
}

static void quotient_mul(quotient *a, const quotient *b)
{
    fmpq_poly_mul(a->num, a->num, b->num);
    fmpq_poly_mul(a->den, a->den, b->den);
    quotient_reduce(a);
}

static void quotient_derivative(quotient *out, const quotient *a)
{
    fmpq_poly_t other;
    fmpq_poly_init(other);
    fmpq_poly_derivative(out->num, a->num);
    fmpq_poly_mul(out->num, out->num, a->den);
    fmpq_poly_derivative(other, a->den);
    fmpq_poly_mul(other, other, a->num);
    fmpq_poly_sub(out->num, out->num, other);
    fmpq_poly_mul(out->den, a->den, a->den);
    quotient_reduce(out);
    fmpq_poly_clear(other);
}

/* b'/b */
static void quotient_logarithmic(quotient *out, const quotient *b)
{
    quotient slope;
    quotient_init(&slope);
    quotient_derivative(&slope, b);
    fmpq_poly_set(out->num, b->den);
    fmpq_poly_set(out->den, b->num);
    quotient_mul(out, &slope);
    quotient_clear(&slope);
}

/* y1' = a y1 + b y2, y2' = c y1 + d y2 with b not 0:  y1'' = (a + d + b'/b) y1' + (a' - a b'/b + b c - a d) y1. */
static void eliminate(const quotient *a, const quotient *b, const quotient *c, const quotient *d, quotient *p,
                      quotient *q)
{
    quotient slope, term;
    quotient_init(&slope);
    quotient_init(&term);
    quotient_logarithmic(&slope, b);
    quotient_add(p, -1, a);
    quotient_add(p, -1, d);
    quotient_add(p, -1, &slope);
    quotient_derivative(&term, a);
    quotient_add(q, -1, &term);
    quotient_mul(&slope, a);
    quotient_add(q, 1, &slope);
    fmpq_poly_set(term.num, b->num);
    fmpq_poly_set(term.den, b->den);
    quotient_mul(&term, c);
    quotient_add(q, -1, &term);
    fmpq_poly_set(term.num, a->num);
    fmpq_poly_set(term.den, a->den);
    quotient_mul(&term, d);
    quotient_add(q, 1, &term);
    quotient_clear(&slope);
    quotient_clear(&term);
}

bool nh_linear_equation_second_order(const nh_linear_equation *equation, fmpq_poly_t p_num, fmpq_poly_t p_den,
                                     fmpq_poly_t q_num, fmpq_poly_t q_den)
{
    enum { a, b, c, d, entries };
    if (equation->size != 2 || fmpz_poly_is_zero(equation->num + b) || fmpz_poly_is_zero(equation->num + c))
        return false;
    quotient e[entries], p, q;
    for (size_t k = 0; k < entries; k++) {
        quotient_init(&e[k]);
        quotient_entry(&e[k], equation, k);
    }
    quotient_init(&p);
    quotient_init(&q);
    eliminate(&e[a], &e[b], &e[c], &e[d], &p, &q);
    fmpq_poly_set(p_num, p.num);
    fmpq_poly_set(p_den, p.den);
    fmpq_poly_set(q_num, q.num);
    fmpq_poly_set(q_den, q.den);
    for (size_t k = 0; k < entries; k++) quotient_clear(&e[k]);
    quotient_clear(&p);
    quotient_clear(&q);
    return true;
}

void nh_linear_equation_normal_form(const fmpq_poly_t p_num, const fmpq_poly_t p_den, const fmpq_poly_t q_num,
                                    const fmpq_poly_t q_den, fmpz_poly_t r_num, fmpz_poly_t r_den)
{
    enum { half = 2, quarter = 4 };
    quotient p, slope, r;
    quotient_init(&p);
    quotient_init(&slope);
    quotient_init(&r);
    fmpq_poly_set(p.num, p_num);
    fmpq_poly_set(p.den, p_den);
    quotient_reduce(&p);
    quotient_derivative(&slope, &p);
    fmpq_poly_scalar_div_ui(slope.num, slope.num, half);
    fmpq_poly_set(r.num, p.num);
    fmpq_poly_set(r.den, p.den);
    quotient_mul(&r, &p);
    fmpq_poly_scalar_div_ui(r.num, r.num, quarter);
    quotient_add(&r, 1, &slope);
    fmpq_poly_set(p.num, q_num);
    fmpq_poly_set(p.den, q_den);
    quotient_add(&r, -1, &p);
    reduced_quotient(r_num, r_den, r.num, r.den);
    quotient_clear(&p);
    quotient_clear(&slope);
    quotient_clear(&r);
}
