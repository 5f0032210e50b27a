/* A common zero of polynomials P_i(x, p) that lies at a known point, in closed form (common_zero.h).
 *
 *      P_1, P_2, ..       irreducible factors that contain an unknown and vanish at the point, the shortest   (pick)
 *          |              roots of p without unknowns eliminated: res_r(P, b r^m - a)   (without_roots)
 *      eliminate x_l      resultants of pairs, for each l other than k
 *          |              fewer P_i than unknowns: derivatives are added     (add_derivatives)
 *      isolate            G(x_k, p), the one of the lowest degree in x_k
 *          |
 *      solve              a x + b,  a x^2 + b x + c,  a x^4 + b x^2 + c:  x = (rational + factor sqrt(..))^(1/outer)
 *
 * Of the branches of a root the one that has the known value is taken. Everything large is given up, because
 * resultants grow quickly. */
#include "exact/common_zero.h"

#include <math.h>

#include "exact/normal_quotient_internal.h"
#include "graph/num.h"

enum { most_terms = 400, most_degree = 60, most_bits = 400, most_list = 16, most_square = 1000 };
static const double vanishing = 1e-8,
                    /* bounds: of a polynomial relative to its terms; of the difference of two values of the unknown */
    same = 1e-6;

typedef struct {
    const nh_zero_point *at;
    nh_quotient_field *field;
    const fmpz_mpoly_ctx_struct *ctx;
    fmpz_mpoly_struct item[most_list];
    size_t count;
} list;

static void list_init(list *l, const nh_zero_point *at)
{
    *l = (list){.at = at, .field = at->field, .ctx = at->field->ctx};
}

static void list_clear(list *l)
{
    for (size_t i = 0; i < l->count; i++) fmpz_mpoly_clear(&l->item[i], l->ctx);
    l->count = 0;
}

/* Removes entry i; those after it move up. */
static void list_remove(list *l, size_t i)
{
    fmpz_mpoly_clear(&l->item[i], l->ctx);
    for (; i + 1 < l->count; i++) l->item[i] = l->item[i + 1];
    l->count--;
}

/* ---- values ---- */

/* The value of p at the point; `size`: the sum of the absolute values of its terms. */
static double value_of(const list *l, const fmpz_mpoly_struct *p, double *size)
{
    double sum = 0;
    fmpz_t c;
    fmpz_init(c);
    *size = 0;
    for (slong i = 0; i < p->length; i++) {
        fmpz_mpoly_get_term_coeff_fmpz(c, p, i, l->ctx);
        fmpz_mpoly_get_term_exp_ui(l->field->exponent, p, i, l->ctx);
        double term = fmpz_get_d(c);
        for (slong g = 0; g < l->field->generators; g++)
            if (l->field->exponent[g]) term *= pow(l->at->value[g], (double)l->field->exponent[g]);
        sum += term;
        *size += fabs(term);
    }
    fmpz_clear(c);
    return sum;
}

/* P| relative to the sum of the absolute values of its terms. */
static bool vanishes(const list *l, const fmpz_mpoly_struct *p)
{
    double size, value = value_of(l, p, &size);
    return isfinite(size) && fabs(value) <= vanishing * size;
}

static bool small(const list *l, const fmpz_mpoly_struct *p)
{
    if (p->length > most_terms || fmpz_mpoly_max_bits(p) > most_bits || fmpz_mpoly_max_bits(p) < -most_bits)
        return false;
    return fmpz_mpoly_total_degree_fits_si(p, l->ctx) && fmpz_mpoly_total_degree_si(p, l->ctx) <= most_degree;
}

static slong degree(const list *l, const fmpz_mpoly_struct *p, size_t generator)
{
    return fmpz_mpoly_degree_si(p, (slong)generator, l->ctx);
}

/* ---- irreducible factors ---- */

static bool has_unknown(const list *l, const fmpz_mpoly_struct *p)
{
    for (size_t i = 0; i < l->at->unknowns; i++)
        if (degree(l, p, l->at->unknown[i]) > 0) return true;
    return false;
}

/* Eliminates the roots in p of expressions without unknowns: r^m = a/b. */
static bool without_roots(const list *l, fmpz_mpoly_struct *p)
{
    nh_quotient_field *f = l->field;
    fmpz_mpoly_t power;
    bool good = true;
    fmpz_mpoly_init(power, l->ctx);
    for (size_t i = f->relations; i-- > 0 && good;) {
        const nh_relation *r = &f->relation[i];
        if (fmpz_mpoly_degree_si(p, r->generator, l->ctx) <= 0) continue;
        fmpz_mpoly_gen(power, r->generator, l->ctx);
        good = fmpz_mpoly_pow_ui(power, power, r->order, l->ctx);
        fmpz_mpoly_mul(power, power, r->den, l->ctx);
        fmpz_mpoly_sub(power, power, r->num, l->ctx);
        good = good && fmpz_mpoly_resultant(p, p, power, r->generator, l->ctx) && !fmpz_mpoly_is_zero(p, l->ctx) &&
               small(l, p);
    }
    fmpz_mpoly_clear(power, l->ctx);
    return good;
}

/* p := its simplest irreducible factor that contains an unknown and vanishes at the point. */
static bool pick(const list *l, fmpz_mpoly_struct *p)
{
    fmpz_mpoly_factor_t f;
    slong best = -1;
    if (fmpz_mpoly_is_zero(p, l->ctx) || !small(l, p) || !without_roots(l, p)) return false;
    fmpz_mpoly_factor_init(f, l->ctx);
    bool good = fmpz_mpoly_factor(f, p, l->ctx);
    for (slong i = 0; i < f->num && good; i++) {
        if (!has_unknown(l, f->poly + i) || !vanishes(l, f->poly + i)) continue;
        if (best < 0 || f->poly[i].length < f->poly[best].length) best = i;
    }
    if (good && best >= 0) {
        fmpz_mpoly_set(p, f->poly + best, l->ctx);
        if (fmpz_sgn(p->coeffs) < 0) fmpz_mpoly_neg(p, p, l->ctx);
    }
    fmpz_mpoly_factor_clear(f, l->ctx);
    return good && best >= 0;
}

/* Adds its irreducible part to the list, unless it is there. */
static void add(list *l, const fmpz_mpoly_struct *p)
{
    fmpz_mpoly_t q;
    fmpz_mpoly_init(q, l->ctx);
    fmpz_mpoly_set(q, p, l->ctx);
    bool fresh = l->count < most_list && pick(l, q);
    for (size_t i = 0; i < l->count && fresh; i++) fresh = !fmpz_mpoly_equal(q, &l->item[i], l->ctx);
    if (fresh) {
        fmpz_mpoly_init(&l->item[l->count], l->ctx);
        fmpz_mpoly_swap(&l->item[l->count++], q, l->ctx);
    }
    fmpz_mpoly_clear(q, l->ctx);
}

/* the zeros of u^2 + v^2 are isolated; there its derivatives vanish as well */
static void add_derivatives(list *l)
{
    size_t count = l->count;
    fmpz_mpoly_t p;
    fmpz_mpoly_init(p, l->ctx);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < l->at->unknowns; k++) {
            fmpz_mpoly_derivative(p, &l->item[i], (slong)l->at->unknown[k], l->ctx);
            if (vanishes(l, p)) add(l, p);
        }
    fmpz_mpoly_clear(p, l->ctx);
}

/* ---- elimination ---- */

/* The item of the lowest positive degree in the generator; the count when there is none. */
static size_t lowest(const list *l, size_t generator)
{
    size_t best = l->count;
    for (size_t i = 0; i < l->count; i++) {
        slong d = degree(l, &l->item[i], generator);
        if (d > 0 && (best == l->count || d < degree(l, &l->item[best], generator))) best = i;
    }
    return best;
}

/* A bound for the number of terms of the resultant of a and b: it has degree deg a in the coefficients of b, and deg b
 * in those of a.  Beyond the limit it takes seconds, and its roots cannot be written in closed form. */
static bool resultant_is_small(const list *l, const fmpz_mpoly_struct *a, const fmpz_mpoly_struct *b, size_t generator)
{
    static const double most = 1e7;
    double terms = 1, in_a = (double)degree(l, a, generator), in_b = (double)degree(l, b, generator);
    for (size_t g = 0; g < (size_t)l->field->generators; g++)
        if (g != generator) terms *= 1 + in_a * (double)degree(l, b, g) + in_b * (double)degree(l, a, g);
    return terms <= most;
}

/* Replaces the list by what does not contain the generator, and the resultants of the others with one of the lowest
 * degree. */
static void eliminate(list *l, size_t generator)
{
    list out;
    fmpz_mpoly_t r;
    size_t pivot = lowest(l, generator);
    if (pivot == l->count) return;
    list_init(&out, l->at);
    fmpz_mpoly_init(r, l->ctx);
    for (size_t i = 0; i < l->count; i++) {
        if (degree(l, &l->item[i], generator) <= 0) add(&out, &l->item[i]);
        else if (i != pivot && resultant_is_small(l, &l->item[pivot], &l->item[i], generator) &&
                 fmpz_mpoly_resultant(r, &l->item[pivot], &l->item[i], (slong)generator, l->ctx))
            add(&out, r);
    }
    fmpz_mpoly_clear(r, l->ctx);
    list_clear(l);
    *l = out;
}

/* Leaves polynomials in unknown k alone, the one of the lowest degree first. */
static bool isolate(list *l, size_t k)
{
    for (size_t i = 0; i < l->at->unknowns; i++)
        if (i != k) eliminate(l, l->at->unknown[i]);
    size_t best = lowest(l, l->at->unknown[k]);
    if (best == l->count) return false;
    fmpz_mpoly_swap(&l->item[0], &l->item[best], l->ctx);
    while (l->count > 1) list_remove(l, l->count - 1);
    return true;
}

/* ---- solutions ---- */

static const nh_quotient *quotient(const list *l, const fmpz_mpoly_struct *num, const fmpz_mpoly_struct *den)
{
    nh_quotient *q = nh_quotient_fresh(l->field);
    fmpz_mpoly_set(q->num, num, l->ctx);
    if (den) fmpz_mpoly_set(q->den, den, l->ctx);
    return nh_quotient_normalise(l->field, q);
}

/* c = s^2 r, r without small squares; both positive. */
static void split_number(const fmpz_t c, fmpz_t s, fmpz_t r)
{
    fmpz_abs(r, c);
    fmpz_one(s);
    for (ulong d = 2; d < most_square; d++)
        while (fmpz_fdiv_ui(r, d * d) == 0) {
            fmpz_divexact_ui(r, r, d * d);
            fmpz_mul_ui(s, s, d);
        }
}

/* |p| = square^2 prod_i root_i: the roots join the solution, with the given power. */
static bool split_square(const list *l, const fmpz_mpoly_struct *p, int power, fmpz_mpoly_struct *square,
                         nh_zero_root *out)
{
    fmpz_mpoly_factor_t f;
    fmpz_mpoly_t part;
    fmpz_t s, r;
    fmpz_init(s);
    fmpz_init(r);
    fmpz_mpoly_init(part, l->ctx);
    fmpz_mpoly_factor_init(f, l->ctx);
    bool good = small(l, p) && fmpz_mpoly_factor(f, p, l->ctx) && f->num + 1 + (slong)out->roots <= NH_MOST_ROOTS;
    if (good) {
        split_number(f->constant, s, r);
        fmpz_mpoly_set_fmpz(square, s, l->ctx);
        fmpz_mpoly_set_fmpz(part, r, l->ctx);
    }
    for (slong i = -1; i < f->num && good; i++) {
        slong e = i < 0 ? 1 : fmpz_get_si(f->exp + i);
        double size;
        if (i >= 0) {
            fmpz_mpoly_set(part, f->poly + i, l->ctx);
            if (value_of(l, part, &size) < 0) fmpz_mpoly_neg(part, part, l->ctx);
        }
        if (e % 2 && !fmpz_mpoly_is_one(part, l->ctx)) {
            out->power[out->roots] = power;
            out->root[out->roots++] = quotient(l, part, NULL);
        }
        good = fmpz_mpoly_pow_ui(part, part, (ulong)(e / 2), l->ctx);
        fmpz_mpoly_mul(square, square, part, l->ctx);
    }
    fmpz_mpoly_factor_clear(f, l->ctx);
    fmpz_mpoly_clear(part, l->ctx);
    fmpz_clear(s);
    fmpz_clear(r);
    return good;
}

/* a u^2 + c = 0 with u > 0: u = sqrt(-c/a) */
static bool pure_root(const list *l, const fmpz_mpoly_struct *a, const fmpz_mpoly_struct *c, nh_zero_root *out)
{
    fmpz_mpoly_t above, below;
    fmpz_mpoly_init(above, l->ctx);
    fmpz_mpoly_init(below, l->ctx);
    bool good = split_square(l, c, 1, above, out) && split_square(l, a, -1, below, out);
    if (good) {
        out->rational = nh_quotient_number(l->field, nh_num_int(0));
        out->factor = quotient(l, above, below);
    }
    fmpz_mpoly_clear(above, l->ctx);
    fmpz_mpoly_clear(below, l->ctx);
    return good;
}

/* a u^2 + b u + c = 0: u = (-b +- sqrt(b^2 - 4 a c))/(2 a), the one with this value */
static bool mixed_root(const list *l, const fmpz_mpoly_struct *a, const fmpz_mpoly_struct *b,
                       const fmpz_mpoly_struct *c, double u, nh_zero_root *out)
{
    fmpz_mpoly_t d, twice, square;
    double size, at_d, at_b = value_of(l, b, &size), at_a = value_of(l, a, &size);
    fmpz_mpoly_init(d, l->ctx);
    fmpz_mpoly_init(twice, l->ctx);
    fmpz_mpoly_init(square, l->ctx);
    fmpz_mpoly_mul(twice, a, c, l->ctx);
    fmpz_mpoly_scalar_mul_si(twice, twice, -4, l->ctx);
    fmpz_mpoly_mul(d, b, b, l->ctx);
    fmpz_mpoly_add(d, d, twice, l->ctx);
    at_d = value_of(l, d, &size);
    bool good = at_d > vanishing * size && split_square(l, d, 1, square, out);
    if (good) {
        double at_square = value_of(l, square, &size), wanted = 2 * at_a * u + at_b; /* = +- sqrt(d) */
        good = fabs(fabs(wanted) - sqrt(at_d)) <= same * (fabs(wanted) + fabs(at_b));
        fmpz_mpoly_scalar_mul_si(twice, a, -2, l->ctx);
        out->rational = quotient(l, b, twice);
        if ((wanted > 0) == (at_square > 0)) fmpz_mpoly_neg(twice, twice, l->ctx);
        out->factor = quotient(l, square, twice);
    }
    fmpz_mpoly_clear(d, l->ctx);
    fmpz_mpoly_clear(twice, l->ctx);
    fmpz_mpoly_clear(square, l->ctx);
    return good;
}

/* The coefficients of x^0 .. x^4. */
static bool coefficients(const list *l, const fmpz_mpoly_struct *p, size_t generator, fmpz_mpoly_struct *c)
{
    slong variable = (slong)generator, most = degree(l, p, generator);
    for (slong i = 0; i <= most && most <= 4; i++) {
        ulong e = (ulong)i;
        fmpz_mpoly_get_coeff_vars_ui(&c[i], p, &variable, &e, 1, l->ctx);
    }
    return most >= 1 &&
           (most <= 2 || (most == 4 && fmpz_mpoly_is_zero(&c[1], l->ctx) && fmpz_mpoly_is_zero(&c[3], l->ctx)));
}

/* P(x) = 0 of degree one or two in x, or in x^2. */
static bool solve(const list *l, const fmpz_mpoly_struct *p, size_t generator, nh_zero_root *out)
{
    fmpz_mpoly_struct c[5];
    double x = l->at->value[generator];
    for (size_t i = 0; i < 5; i++) fmpz_mpoly_init(&c[i], l->ctx);
    bool good = coefficients(l, p, generator, c);
    slong most = degree(l, p, generator), step = most == 4 ? 2 : 1;
    *out = (nh_zero_root){.outer = (unsigned)step};
    if (good && most == 1) {
        fmpz_mpoly_neg(&c[1], &c[1], l->ctx);
        out->rational = quotient(l, &c[0], &c[1]);
    } else if (good) {
        good = fmpz_mpoly_is_zero(&c[step], l->ctx)
                   ? pure_root(l, &c[2 * step], &c[0], out)
                   : mixed_root(l, &c[2 * step], &c[step], &c[0], pow(x, (double)step), out);
    }
    for (size_t i = 0; i < 5; i++) fmpz_mpoly_clear(&c[i], l->ctx);
    return good && nh_quotient_field_state_of(l->field) == NH_FIELD_FINE;
}

bool nh_common_zero(const nh_zero_point *point, size_t equations, const nh_quotient *const *equation, size_t k,
                    nh_zero_root *out)
{
    list l;
    list_init(&l, point);
    for (size_t i = 0; i < equations; i++) add(&l, equation[i]->num);
    if (l.count > 0 && l.count < point->unknowns) add_derivatives(&l);
    bool good = isolate(&l, k) && solve(&l, &l.item[0], point->unknown[k], out);
    list_clear(&l);
    return good;
}
