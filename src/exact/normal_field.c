/* The field of quotients of normal_quotient.h: its limits, and the relations of its generators.
 *
 * Every product adds its pairs of terms to the work of the field, and what exceeds the limits breaks the field: all
 * results mean nothing from then on, so that callers ask once at the end and need no check at each step. */
#include "exact/normal_quotient.h"

#include <math.h>

#include "base/budget.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "exact/normal_quotient_internal.h"

/* A product is refused when it needs more than this many term products per admitted term; a whole computation may use
 * `patience` times as many. */
enum { slack = 50, patience = 20, highest_degree = 1 << 30 };
/* After the budget is spent or the deadline is over, this part of the usual limit is still allowed, so that the results
 * so far are shown in short form. */
static const double hurried = 0.02;
/* A gcd is tried below this many pairs of terms and below this degree: a fraction that is not cancelled is still
 * correct. */
static const double gcd_pairs = 2e4;
static const slong gcd_degree = 60;

nh_quotient_field *nh_quotient_field_create(size_t generators, size_t max_terms)
{
    nh_quotient_field *f = nh_alloc(sizeof *f);
    f->declared = generators;
    f->generators = generators ? (slong)generators : 1;
    fmpz_mpoly_ctx_init(f->ctx, f->generators, ORD_LEX);
    f->exponent = nh_alloc_array((size_t)f->generators, sizeof *f->exponent);
    f->max_terms = (double)max_terms;
    f->max_work = slack * patience * f->max_terms;
    return f;
}

void nh_quotient_field_free(nh_quotient_field *field)
{
    if (!field) return;
    for (nh_quotient *q = field->all, *next; q; q = next) {
        next = q->next;
        fmpz_mpoly_clear(q->num, field->ctx);
        fmpz_mpoly_clear(q->den, field->ctx);
        nh_free(q);
    }
    for (size_t i = 0; i < field->relations; i++) {
        fmpz_mpoly_clear(field->relation[i].num, field->ctx);
        fmpz_mpoly_clear(field->relation[i].den, field->ctx);
    }
    nh_free(field->relation);
    nh_free(field->exponent);
    fmpz_mpoly_ctx_clear(field->ctx);
    nh_free(field);
}

nh_quotient_field_state nh_quotient_field_state_of(const nh_quotient_field *field) { return field->state; }

void nh_quotient_field_break(nh_quotient_field *field, nh_quotient_field_state why)
{
    if (field->state == NH_FIELD_FINE) field->state = why;
}

nh_quotient *nh_quotient_fresh(nh_quotient_field *f)
{
    if (nh_interrupted()) nh_quotient_field_break(f, NH_FIELD_TOO_LARGE);
    nh_quotient *q = nh_alloc(sizeof *q);
    fmpz_mpoly_init(q->num, f->ctx);
    fmpz_mpoly_init(q->den, f->ctx);
    fmpz_mpoly_one(q->den, f->ctx);
    q->next = f->all;
    return f->all = q;
}

/* ---- polynomials within limits ---- */

static double words(const fmpz_mpoly_t a) { return 1 + fabs((double)fmpz_mpoly_max_bits(a)) / 64; }

bool nh_quotient_field_spend(nh_quotient_field *f, double work)
{
    f->work += work;
    if (f->work > f->max_work || (f->work > hurried * f->max_work && (nh_budget_spent() || nh_late())) ||
        nh_interrupted())
        nh_quotient_field_break(f, NH_FIELD_TOO_LARGE);
    if (f->state == NH_FIELD_FINE) nh_work_add(NH_WORK_TERM, work); /* what is refused is not computed */
    return f->state == NH_FIELD_FINE;
}

void nh_quotient_field_check_size(nh_quotient_field *f, const fmpz_mpoly_t a)
{
    bool too_large = (double)a->length > f->max_terms;
    if (a->bits > 32 && a->length) { /* exponents are read as machine words */
        too_large |= !fmpz_mpoly_total_degree_fits_si(a, f->ctx);
        too_large |= !too_large && fmpz_mpoly_total_degree_si(a, f->ctx) > highest_degree;
    }
    if (too_large) nh_quotient_field_break(f, NH_FIELD_TOO_LARGE);
}

void nh_quotient_field_times(nh_quotient_field *f, fmpz_mpoly_t out, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    double pairs = (double)a->length * (double)b->length;
    if (pairs > slack * f->max_terms) nh_quotient_field_break(f, NH_FIELD_TOO_LARGE);
    if (!nh_quotient_field_spend(f, pairs * words(a) * words(b))) return;
    fmpz_mpoly_mul(out, a, b, f->ctx);
    nh_quotient_field_check_size(f, out);
}

static void times_power(nh_quotient_field *f, fmpz_mpoly_t p, const fmpz_mpoly_t base, ulong n)
{
    for (ulong i = 0; i < n && f->state == NH_FIELD_FINE; i++) nh_quotient_field_times(f, p, p, base);
}

bool nh_quotient_field_cheap_gcd(const nh_quotient_field *f, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    if (a->length == 1 || b->length == 1) return true;
    if ((double)a->length * (double)b->length > gcd_pairs) return false;
    for (slong g = 0; g < f->generators; g++)
        if (fmpz_mpoly_degree_si(a, g, f->ctx) > gcd_degree || fmpz_mpoly_degree_si(b, g, f->ctx) > gcd_degree)
            return false;
    return true;
}

static bool is_one(const nh_quotient_field *f, const fmpz_mpoly_t a) { return fmpz_mpoly_is_one(a, f->ctx); }

/* ---- relations ---- */

/* p = sum_j P_j g^(order j) with deg_g P_j < order: part[j] = P_j.  Subtracting the same exponent from every term of a
 * part keeps their order. */
static void split_by_power(nh_quotient_field *f, const nh_relation *r, const fmpz_mpoly_t p, fmpz_mpoly_struct *part)
{
    fmpz_t c;
    fmpz_init(c);
    for (slong i = 0; i < p->length; i++) {
        fmpz_mpoly_get_term_exp_ui(f->exponent, p, i, f->ctx);
        fmpz_mpoly_get_term_coeff_fmpz(c, p, i, f->ctx);
        ulong j = f->exponent[r->generator] / r->order;
        f->exponent[r->generator] %= r->order;
        fmpz_mpoly_push_term_fmpz_ui(part + j, c, f->exponent, f->ctx);
    }
    fmpz_clear(c);
}

/* p with g^order replaced by num/den, times den^J to stay a polynomial; returns J.  Where the value has lower powers of
 * g every step of Horner's rule is reduced again: its degree falls each time. */
static ulong reduce(nh_quotient_field *f, const nh_relation *r, fmpz_mpoly_t p)
{
    slong degree = fmpz_mpoly_degree_si(p, r->generator, f->ctx);
    if (degree < (slong)r->order) return 0;
    ulong top = (ulong)degree / r->order, scaled = 0;
    if (!nh_quotient_field_spend(f, (double)top)) return 0;
    fmpz_mpoly_struct *part = nh_alloc_array(top + 1, sizeof *part);
    for (ulong j = 0; j <= top; j++) fmpz_mpoly_init(part + j, f->ctx);
    split_by_power(f, r, p, part);
    fmpz_mpoly_swap(p, part + top, f->ctx);
    for (ulong j = top; j-- > 0 && f->state == NH_FIELD_FINE;) { /* Horner in num/den */
        nh_quotient_field_times(f, p, p, r->num);
        scaled++;
        if (!r->integral) times_power(f, part + j, r->den, scaled);
        fmpz_mpoly_add(p, p, part + j, f->ctx);
        if (r->mixed) scaled += reduce(f, r, p);
    }
    for (ulong j = 0; j <= top; j++) fmpz_mpoly_clear(part + j, f->ctx);
    nh_free(part);
    return scaled;
}

/* 1/r = r^(order-1) / r^order, so that equal quotients of roots look equal. */
static void lift_root(nh_quotient_field *f, const nh_relation *r, nh_quotient *q)
{
    if (fmpz_mpoly_degree_si(q->den, r->generator, f->ctx) < 1) return;
    ulong least = r->order;
    for (slong i = 0; i < q->den->length && least; i++) {
        fmpz_mpoly_get_term_exp_ui(f->exponent, q->den, i, f->ctx);
        if (f->exponent[r->generator] < least) least = f->exponent[r->generator];
    }
    if (!least || least == r->order) return;
    fmpz_mpoly_t g;
    fmpz_mpoly_init(g, f->ctx);
    fmpz_mpoly_gen(g, r->generator, f->ctx);
    times_power(f, q->num, g, r->order - least);
    times_power(f, q->den, g, r->order - least);
    fmpz_mpoly_clear(g, f->ctx);
}

static void apply(nh_quotient_field *f, const nh_relation *r, nh_quotient *q)
{
    ulong above = reduce(f, r, q->num), below = reduce(f, r, q->den);
    if (!r->pair && !r->mixed) {
        lift_root(f, r, q);
        above += reduce(f, r, q->num);
        below += reduce(f, r, q->den);
    }
    if (r->integral) return;
    if (below > above) times_power(f, q->num, r->den, below - above);
    else times_power(f, q->den, r->den, above - below);
}

void nh_quotient_cancel(nh_quotient_field *f, nh_quotient *q)
{
    if (is_one(f, q->den)) return;
    if (fmpz_mpoly_is_zero(q->num, f->ctx)) {
        fmpz_mpoly_one(q->den, f->ctx);
        return;
    }
    if (nh_quotient_field_cheap_gcd(f, q->num, q->den)) {
        fmpz_mpoly_t g;
        fmpz_mpoly_init(g, f->ctx);
        if (nh_quotient_field_spend(f, (double)(q->num->length + q->den->length)) &&
            nh_quotient_field_gcd(f, g, q->num, q->den) && !is_one(f, g)) {
            fmpz_mpoly_divexact(q->num, q->num, g, f->ctx);
            fmpz_mpoly_divexact(q->den, q->den, g, f->ctx);
        }
        fmpz_mpoly_clear(g, f->ctx);
    }
    if (fmpz_sgn(q->den->coeffs) >= 0) return;
    fmpz_mpoly_neg(q->num, q->num, f->ctx);
    fmpz_mpoly_neg(q->den, q->den, f->ctx);
}

/* Later relations first: their values contain earlier generators only. */
const nh_quotient *nh_quotient_normalise(nh_quotient_field *f, nh_quotient *q)
{
    for (int round = 0; round <= f->repeat; round++)
        for (size_t i = f->relations; i-- > 0 && f->state == NH_FIELD_FINE;) apply(f, &f->relation[i], q);
    if (f->state != NH_FIELD_FINE) return q;
    if (fmpz_mpoly_is_zero(q->den, f->ctx)) nh_quotient_field_break(f, NH_FIELD_UNDEFINED);
    else nh_quotient_cancel(f, q);
    nh_quotient_field_check_size(f, q->num);
    nh_quotient_field_check_size(f, q->den);
    return q;
}

static nh_relation *add_relation(nh_quotient_field *f)
{
    nh_grow(&f->relation, &f->capacity, f->relations + 1, sizeof *f->relation);
    nh_relation *r = &f->relation[f->relations++];
    *r = (nh_relation){0};
    fmpz_mpoly_init(r->num, f->ctx);
    fmpz_mpoly_init(r->den, f->ctx);
    return r;
}

void nh_quotient_field_relate(nh_quotient_field *field, size_t generator, unsigned order, const nh_quotient *value)
{
    if (field->state != NH_FIELD_FINE) return;
    nh_relation *r = add_relation(field);
    r->generator = (slong)generator;
    r->order = order;
    fmpz_mpoly_set(r->num, value->num, field->ctx);
    fmpz_mpoly_set(r->den, value->den, field->ctx);
    r->integral = is_one(field, r->den);
    r->mixed = nh_quotient_has(field, value, generator);
}

void nh_quotient_field_repeat(nh_quotient_field *field) { field->repeat = true; }

/* s^2 = 1 - c^2, s^2 = c^2 - 1, c^2 = 1 - s^2, c^2 = 1 + s^2 */
static void set_pair(nh_quotient_field *f, nh_relation *r, bool eliminate_cosine)
{
    r->generator = eliminate_cosine ? r->cosine : r->sine;
    fmpz_mpoly_gen(r->num, eliminate_cosine ? r->sine : r->cosine, f->ctx);
    fmpz_mpoly_mul(r->num, r->num, r->num, f->ctx);
    if (!r->hyperbolic) fmpz_mpoly_neg(r->num, r->num, f->ctx);
    if (r->hyperbolic && !eliminate_cosine) fmpz_mpoly_sub_ui(r->num, r->num, 1, f->ctx);
    else fmpz_mpoly_add_ui(r->num, r->num, 1, f->ctx);
}

void nh_quotient_field_relate_pair(nh_quotient_field *field, size_t s, size_t c, bool hyperbolic)
{
    nh_relation *r = add_relation(field);
    r->pair = r->integral = true;
    r->order = 2;
    r->hyperbolic = hyperbolic;
    r->sine = (slong)s;
    r->cosine = (slong)c;
    fmpz_mpoly_one(r->den, field->ctx);
    set_pair(field, r, false);
}

size_t nh_quotient_field_pairs(const nh_quotient_field *field)
{
    size_t count = 0;
    for (size_t i = 0; i < field->relations; i++) count += field->relation[i].pair;
    return count;
}

void nh_quotient_field_flip_pair(nh_quotient_field *field, size_t pair)
{
    for (size_t i = 0; i < field->relations; i++) {
        nh_relation *r = &field->relation[i];
        if (r->pair && pair-- == 0) {
            set_pair(field, r, r->generator == r->sine);
            return;
        }
    }
}
