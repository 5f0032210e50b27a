/* kovacic_points: singular points, exponents, and the degrees that follow from them, in characteristic 0.
 * [docs/method.md, "No other integral"]
 *
 *     problem_begin    factors of the denominator; where 1 + 4 b is rational, and whether it is a square, exactly
 *     weights          the other exponents in balls
 *     degrees          all sums of exponents; those that may be whole numbers are kept */
#include "absence/kovacic_internal.h"

#include <flint/fmpz_poly_factor.h>

enum {
    first_bits = 128,
    most_bits = 512,
    wide = -40,              /* a ball of radius above 2^wide wants more bits */
    most_sums = 8192,        /* of exponents, else all degrees up to the largest are kept */
    most_exponent = 1000000, /* beyond it degrees are too large anyway */
    digits = 5               /* of a text */
};

/* ---- exact ---- */

/* Is the rational number a square?  Then `root` is its root. */
static bool rational_root(fmpq_t root, const fmpq_t square)
{
    bool is = fmpq_sgn(square) >= 0 && fmpz_is_square(fmpq_numref(square)) && fmpz_is_square(fmpq_denref(square));
    if (!is) return false;
    fmpz_sqrt(fmpq_numref(root), fmpq_numref(square));
    fmpz_sqrt(fmpq_denref(root), fmpq_denref(square));
    return true;
}

/* 1 + 4 b at the double poles: b = num/(den/f^2 f'^2) in Q[x]/(f), since (x - c)/f is 1/f'(c) at c. */
static void read_double(const nh_kovacic_problem *problem, nh_kovacic_place *place)
{
    fmpq_poly_t f, rest, inverse, other, one;
    fmpz_poly_t g;
    fmpq_poly_init(f);
    fmpq_poly_init(rest);
    fmpq_poly_init(inverse);
    fmpq_poly_init(other);
    fmpq_poly_init(one);
    fmpz_poly_init(g);
    fmpz_poly_div(g, problem->den, place->factor);
    fmpz_poly_div(g, g, place->factor);
    fmpq_poly_set_fmpz_poly(f, place->factor);
    fmpq_poly_set_fmpz_poly(rest, g);
    fmpq_poly_derivative(other, f);
    fmpq_poly_mul(other, other, other);
    fmpq_poly_mul(rest, rest, other);
    fmpq_poly_rem(rest, rest, f);
    fmpq_poly_xgcd(one, inverse, other, rest, f);
    fmpq_poly_set_fmpz_poly(other, problem->num);
    fmpq_poly_mul(other, other, inverse);
    fmpq_poly_rem(other, other, f);
    fmpq_poly_scalar_mul_si(other, other, 4);
    place->constant = fmpq_poly_length(other) <= 1;
    if (place->constant) {
        fmpq_poly_get_coeff_fmpq(place->square, other, 0);
        fmpq_add_si(place->square, place->square, 1);
        place->rational = rational_root(place->root, place->square);
    }
    fmpz_poly_clear(g);
    fmpq_poly_clear(one);
    fmpq_poly_clear(other);
    fmpq_poly_clear(inverse);
    fmpq_poly_clear(rest);
    fmpq_poly_clear(f);
}

static nh_kovacic_place *places_init(nh_arena *arena, size_t count)
{
    nh_kovacic_place *place = nh_arena_alloc(arena, count * sizeof *place);
    for (size_t i = 0; i < count; i++) {
        fmpz_poly_init(place[i].factor);
        fmpq_init(place[i].square);
        fmpq_init(place[i].root);
    }
    return place;
}

static void read_finite(nh_kovacic_problem *problem, nh_kovacic_place *place, slong order)
{
    place->order = order;
    place->irregular = order > 2;
    place->half = order == 1 ? 2 : place->irregular ? order / 2 : 1;
    if (order == 2) read_double(problem, place);
    if (place->irregular && order % 2) problem->odd = true;
}

static void read_infinity(nh_kovacic_problem *problem, nh_kovacic_place *place)
{
    slong order = fmpz_poly_degree(problem->den) - fmpz_poly_degree(problem->num);
    fmpz_poly_set_ui(place->factor, 1);
    place->order = order < 2 ? order : 2;
    place->irregular = order < 2;
    place->half = place->irregular ? order / 2 : 1;
    if (place->irregular) {
        if (order % 2) problem->odd = true;
        return;
    }
    if (order == 2) fmpq_set_fmpz_frac(place->square, fmpz_poly_lead(problem->num), fmpz_poly_lead(problem->den));
    fmpz_mul_ui(fmpq_numref(place->square), fmpq_numref(place->square), 4);
    fmpq_canonicalise(place->square);
    fmpq_add_si(place->square, place->square, 1);
    place->constant = true;
    place->rational = rational_root(place->root, place->square);
}

void nh_kovacic_problem_begin(nh_kovacic_problem *problem, nh_arena *arena, const fmpz_poly_t num,
                              const fmpz_poly_t den)
{
    fmpz_poly_factor_t factors;
    fmpz_poly_factor_init(factors);
    *problem = (nh_kovacic_problem){.arena = arena};
    fmpz_poly_init(problem->num);
    fmpz_poly_init(problem->den);
    fmpz_poly_set(problem->num, num);
    fmpz_poly_set(problem->den, den);
    fmpz_poly_factor(factors, den);
    problem->places = (size_t)factors->num;
    problem->place = places_init(arena, problem->places + 1);
    problem->at = nh_arena_alloc(arena, (nh_kovacic_most_poles + 1) * sizeof *problem->at);
    for (size_t i = 0; i < problem->places; i++) {
        nh_kovacic_place *place = problem->place + i;
        fmpz_poly_set(place->factor, factors->p + i);
        read_finite(problem, place, factors->exp[i]);
        for (slong k = 0; k < fmpz_poly_degree(place->factor); k++) problem->at[problem->poles++] = i;
    }
    read_infinity(problem, problem->place + problem->places);
    problem->at[problem->poles] = problem->places;
    problem->weight = _acb_vec_init((slong)problem->poles + 1);
    problem->pole = nh_arena_alloc(arena, (problem->poles + 1) * sizeof *problem->pole);
    problem->root = nh_arena_alloc(arena, (problem->poles + 1) * sizeof *problem->root);
    fmpz_poly_factor_clear(factors);
}

void nh_kovacic_problem_end(nh_kovacic_problem *problem)
{
    for (size_t i = 0; i <= problem->places; i++) {
        fmpz_poly_clear(problem->place[i].factor);
        fmpq_clear(problem->place[i].square);
        fmpq_clear(problem->place[i].root);
    }
    _acb_vec_clear(problem->weight, (slong)problem->poles + 1);
    fmpz_poly_clear(problem->den);
    fmpz_poly_clear(problem->num);
}

/* ---- balls ---- */

static void poles_of(const nh_kovacic_place *place, acb_ptr c, slong bits)
{
    if (fmpz_poly_degree(place->factor) > 1) {
        arb_fmpz_poly_complex_roots(c, place->factor, 0, bits);
        return;
    }
    fmpq_t root;
    fmpq_init(root);
    fmpq_set_fmpz_frac(root, fmpz_poly_get_coeff_ptr(place->factor, 0), fmpz_poly_lead(place->factor));
    fmpq_neg(root, root);
    acb_set_fmpq(c, root, bits);
    fmpq_clear(root);
}

/* t^order r at c, or x^o r at infinity (c NULL). */
static void series_at(const nh_kovacic_problem *problem, acb_srcptr c, slong order, slong terms, acb_poly_t out,
                      slong bits)
{
    acb_poly_t den;
    acb_poly_init(den);
    if (c) {
        acb_poly_set_fmpz_poly(out, problem->num, bits);
        acb_poly_set_fmpz_poly(den, problem->den, bits);
        acb_poly_taylor_shift(out, out, c, bits);
        acb_poly_taylor_shift(den, den, c, bits);
        acb_poly_shift_right(den, den, order); /* the coefficients below are 0 exactly */
    } else {
        fmpz_poly_t turned;
        fmpz_poly_init(turned);
        fmpz_poly_reverse(turned, problem->num, fmpz_poly_length(problem->num));
        acb_poly_set_fmpz_poly(out, turned, bits);
        fmpz_poly_reverse(turned, problem->den, fmpz_poly_length(problem->den));
        acb_poly_set_fmpz_poly(den, turned, bits);
        fmpz_poly_clear(turned);
    }
    acb_poly_div_series(out, out, den, terms, bits);
    acb_poly_clear(den);
}

/* Coefficient `term` of the root of a series.  Either root will do: one that is away from the branch cut. */
static void root_coefficient(acb_t out, acb_poly_t series, slong term, slong bits)
{
    bool left = arf_sgn(arb_midref(acb_realref(acb_poly_get_coeff_ptr(series, 0)))) < 0;
    if (left) acb_poly_neg(series, series);
    acb_poly_sqrt_series(series, series, term + 1, bits);
    acb_poly_get_coeff_acb(out, series, term);
    if (left) acb_mul_onei(out, out);
}

static void weight_at(const nh_kovacic_problem *problem, const nh_kovacic_place *place, acb_srcptr c, acb_t out,
                      slong bits)
{
    slong term = !place->irregular ? 0 : c ? place->order / 2 - 1 : 1 - place->order / 2;
    acb_zero(out);
    if (place->order == 1 && c) return;
    if (place->irregular && place->order % 2) return;
    acb_poly_t series;
    acb_poly_init(series);
    if (place->constant) {
        acb_t square;
        acb_init(square);
        acb_set_fmpq(square, place->square, bits);
        acb_poly_set_acb(series, square);
        acb_clear(square);
    } else {
        series_at(problem, c, place->order, term + 1, series, bits);
        if (!place->irregular) {
            acb_poly_scalar_mul_2exp_si(series, series, 2);
            acb_poly_add_si(series, series, 1, bits);
        }
    }
    if (acb_poly_length(series)) root_coefficient(out, series, term, bits);
    if (!place->irregular) acb_mul_2exp_si(out, out, -1);
    acb_poly_clear(series);
}

/* False: a ball is wide. */
static bool weights(nh_kovacic_problem *problem, slong bits)
{
    bool narrow = true;
    acb_ptr c = _acb_vec_init((slong)problem->poles + 1);
    for (size_t i = 0, first = 0; i <= problem->places; i++) {
        const nh_kovacic_place *place = problem->place + i;
        slong roots = fmpz_poly_degree(place->factor);
        if (roots) poles_of(place, c, bits);
        for (slong k = 0; k < (roots ? roots : 1); k++) {
            acb_ptr w = problem->weight + first++;
            weight_at(problem, place, roots ? c + k : NULL, w, bits);
            narrow = narrow && acb_is_finite(w) && mag_cmp_2exp_si(arb_radref(acb_realref(w)), wide) < 0 &&
                     mag_cmp_2exp_si(arb_radref(acb_imagref(w)), wide) < 0;
        }
    }
    _acb_vec_clear(c, (slong)problem->poles + 1);
    return narrow;
}

/* ---- degrees ---- */

const char *nh_kovacic_large(nh_arena *arena)
{
    return nh_arena_printf(arena, "polynomials of degree over %d had to be excluded", nh_kovacic_most_degree);
}

/* Sums  base/2 + Sum (count - 2 used) weight,  used = 0 .. count: equal weights are one term. */
typedef struct {
    slong base;
    size_t terms;
    acb_srcptr weight[nh_kovacic_most_poles + 1];
    const nh_kovacic_place *place[nh_kovacic_most_poles + 1];
    slong count[nh_kovacic_most_poles + 1], used[nh_kovacic_most_poles + 1];
    bool kept[nh_kovacic_most_degree + 1];
} sums;

static void add_term(sums *s, const nh_kovacic_place *place, acb_srcptr weight)
{
    if (place->order == 1 && fmpz_poly_degree(place->factor)) return;
    if (place->constant) {
        if (fmpq_is_zero(place->square)) return;
        for (size_t k = 0; k < s->terms; k++)
            if (s->place[k]->constant && fmpq_equal(s->place[k]->square, place->square)) {
                s->count[k]++;
                return;
            }
    }
    s->place[s->terms] = place;
    s->weight[s->terms] = weight;
    s->count[s->terms++] = 1;
}

/* Keeps what may be whole.  False: too large. */
static bool keep(sums *s, const acb_t sum)
{
    fmpz_t whole;
    fmpz_init(whole);
    bool good = true;
    if (acb_contains_int(sum)) {
        if (!arb_get_unique_fmpz(whole, acb_realref(sum)) || fmpz_cmp_si(whole, nh_kovacic_most_degree) > 0)
            good = false;
        else if (fmpz_sgn(whole) >= 0) s->kept[fmpz_get_si(whole)] = true;
    }
    fmpz_clear(whole);
    return good;
}

static bool all_sums(sums *s, slong bits)
{
    acb_t sum;
    acb_init(sum);
    bool good = true;
    for (size_t next = 0; next < s->terms + 1 && good;) {
        acb_set_si(sum, s->base);
        acb_mul_2exp_si(sum, sum, -1);
        for (size_t k = 0; k < s->terms; k++) acb_addmul_si(sum, s->weight[k], s->count[k] - 2 * s->used[k], bits);
        good = keep(s, sum);
        for (next = 0; next < s->terms && s->used[next] == s->count[next]; next++) s->used[next] = 0;
        if (next == s->terms) break;
        s->used[next]++;
    }
    acb_clear(sum);
    return good;
}

/* All from 0 to the largest real part. */
static bool up_to_largest(sums *s, slong bits)
{
    arb_t sum, size;
    fmpz_t whole;
    arb_init(sum);
    arb_init(size);
    fmpz_init(whole);
    arb_set_si(sum, s->base);
    arb_mul_2exp_si(sum, sum, -1);
    for (size_t k = 0; k < s->terms; k++) {
        arb_abs(size, acb_realref(s->weight[k]));
        arb_addmul_si(sum, size, s->count[k], bits);
    }
    arb_get_ubound_arf(arb_midref(size), sum, bits);
    arf_get_fmpz(whole, arb_midref(size), ARF_RND_CEIL);
    bool good = fmpz_cmp_si(whole, nh_kovacic_most_degree) <= 0;
    for (slong d = 0; good && fmpz_cmp_si(whole, d) >= 0; d++) s->kept[d] = true;
    fmpz_clear(whole);
    arb_clear(size);
    arb_clear(sum);
    return good;
}

static const char *exponent_text(const nh_kovacic_problem *problem, const nh_kovacic_place *place, acb_t w)
{
    nh_arena *arena = problem->arena;
    if (place->irregular) return nh_arena_printf(arena, "irregular of order %ld", (long)place->order);
    if (place->order == 1) return "1";
    if (place->rational) {
        char *text = fmpq_get_str(NULL, 10, place->root);
        const char *copy = nh_arena_strdup(arena, text);
        flint_free(text);
        return copy;
    }
    char *re = arb_get_str(acb_realref(w), digits, ARB_STR_NO_RADIUS),
         *im = arb_get_str(acb_imagref(w), digits, ARB_STR_NO_RADIUS);
    const char *text = arb_is_zero(acb_imagref(w))   ? nh_arena_strdup(arena, re)
                       : arb_is_zero(acb_realref(w)) ? nh_arena_printf(arena, "%s i", im)
                                                     : nh_arena_printf(arena, "%s + %s i", re, im);
    flint_free(im);
    flint_free(re);
    return text;
}

static void exponent_texts(const nh_kovacic_problem *problem, nh_kovacic *out)
{
    acb_t twice;
    acb_init(twice);
    out->exponent = nh_arena_alloc(problem->arena, (problem->poles + 1) * sizeof *out->exponent);
    for (size_t i = 0; i <= problem->poles; i++) {
        acb_mul_2exp_si(twice, problem->weight + i, 1);
        out->exponent[i] = exponent_text(problem, problem->place + problem->at[i], twice);
    }
    acb_clear(twice);
}

bool nh_kovacic_degrees(nh_kovacic_problem *problem, nh_kovacic *out)
{
    slong bits = first_bits;
    while (bits <= most_bits && !weights(problem, bits)) bits *= 2;
    exponent_texts(problem, out);
    if (bits > most_bits) out->obstacle = "exponents are not known to enough digits";
    if (problem->odd || out->obstacle) return !out->obstacle;
    sums *s = nh_arena_alloc(problem->arena, sizeof *s);
    size_t number = 1;
    s->base = problem->place[problem->places].half;
    for (size_t i = 0; i <= problem->poles; i++) {
        const nh_kovacic_place *place = problem->place + problem->at[i];
        if (i < problem->poles) s->base -= place->half;
        add_term(s, place, problem->weight + i);
    }
    for (size_t k = 0; k < s->terms && number <= most_sums; k++) number *= (size_t)s->count[k] + 1;
    if (!(number <= most_sums ? all_sums(s, bits) : up_to_largest(s, bits))) {
        out->obstacle =
            nh_arena_printf(problem->arena, "polynomials of degree over %d had to be excluded", nh_kovacic_most_degree);
        return false;
    }
    out->degree_of_p = nh_arena_alloc(problem->arena, sizeof s->kept / sizeof *s->kept * sizeof *out->degree_of_p);
    for (slong d = 0; d <= nh_kovacic_most_degree; d++)
        if (s->kept[d]) out->degree_of_p[out->degrees++] = d;
    return true;
}

/* ---- invariants ---- */

/* The least or the greatest whole number among  m/2 + (i - m/2) root,  i = 0 .. m;  m is even, so i = m/2 gives one. */
static slong extreme(const nh_kovacic_place *place, slong m, int side)
{
    slong best = m / 2;
    if (!place->constant || !place->rational) return best;
    fmpq_t value;
    fmpq_init(value);
    for (slong i = -m / 2; i <= m / 2; i++) {
        fmpq_mul_si(value, place->root, i);
        fmpq_add_si(value, value, m / 2);
        if (!fmpz_is_one(fmpq_denref(value))) continue;
        slong whole = fmpz_get_si(fmpq_numref(value));
        if (side * (whole - best) > 0) best = whole;
    }
    fmpq_clear(value);
    return best;
}

/* Is the exponent so large that degrees are, too? */
static bool too_large(const nh_kovacic_place *place)
{
    return place->rational &&
           (fmpz_cmp_si(fmpq_numref(place->root), most_exponent) > 0 || !fmpz_fits_si(fmpq_denref(place->root)));
}

void nh_kovacic_bounds(const nh_kovacic_problem *problem, nh_kovacic_invariant *invariant)
{
    slong m = invariant->m, degree = 0;
    bool large = false;
    invariant->lowest = nh_arena_alloc(problem->arena, (problem->poles + 1) * sizeof *invariant->lowest);
    for (size_t i = 0; i <= problem->poles; i++) {
        const nh_kovacic_place *place = problem->place + problem->at[i];
        large = too_large(place);
        if (large) break;
        if (i == problem->poles) {
            degree += place->irregular ? place->order : extreme(place, m, 1);
            break;
        }
        invariant->lowest[i] = place->irregular ? place->order : place->order == 1 ? 0 : extreme(place, m, -1);
        degree -= invariant->lowest[i];
    }
    invariant->degree = large ? nh_kovacic_most_degree + 1 : degree;
    invariant->possible = invariant->degree >= 0;
}
