/* residues:
 *
 *     a = sum_f A_f/f^m + polynomial,   f irreducible over Q
 *     A/f^m  =  derivative + (s + t'/(m-1))/f^(m-1),   A = s f + t f'        (Hermite), until m = 1
 *     residue of a at a root of f:  A/f'  in Q[x]/(f)
 *
 * The residue at one root of f is rational iff this element is a constant; then it is so at all of them.  Where all
 * residues are rational, a power of y is exp(h) times a rational function with h in Q(x); h is a constant iff all poles
 * of a are simple and it vanishes at infinity. */
#include "absence/residues.h"

#include <flint/fmpz_poly_factor.h>

#include "absence/polynomial_text.h"

/* The factor in words, and the residue modulo it. */
static void say(nh_arena *arena, nh_residues *out, nh_residue_verdict verdict, const fmpz_poly_t f,
                const fmpq_poly_t residue)
{
    out->verdict = verdict;
    out->factor = nh_polynomial_text_whole(arena, f, "x");
    out->residue = nh_polynomial_text(arena, residue, "x");
}

/* out := a b modulo f */
static void product_modulo(fmpq_poly_t out, const fmpq_poly_t a, const fmpq_poly_t b, const fmpq_poly_t f)
{
    fmpq_poly_mul(out, a, b);
    fmpq_poly_rem(out, out, f);
}

/* out := the inverse of a modulo f, to which it is prime. */
static void inverse_modulo(fmpq_poly_t out, const fmpq_poly_t a, const fmpq_poly_t f)
{
    fmpq_poly_t one, other;
    fmpq_poly_init(one);
    fmpq_poly_init(other);
    fmpq_poly_xgcd(one, out, other, a, f);
    fmpq_poly_rem(out, out, f);
    fmpq_poly_clear(one);
    fmpq_poly_clear(other);
}

/* The residue of A/f^m, modulo f.  A is changed. */
static void hermite(fmpq_poly_t residue, fmpq_poly_t A, const fmpq_poly_t f, slong m)
{
    fmpq_poly_t slope, inverse, t, s;
    fmpq_poly_init(slope);
    fmpq_poly_init(inverse);
    fmpq_poly_init(t);
    fmpq_poly_init(s);
    fmpq_poly_derivative(slope, f);
    inverse_modulo(inverse, slope, f);
    for (; m > 1; m--) {
        fmpq_poly_rem(t, A, f);
        product_modulo(t, t, inverse, f);
        fmpq_poly_mul(s, t, slope);
        fmpq_poly_sub(s, A, s);
        fmpq_poly_div(s, s, f);
        fmpq_poly_derivative(t, t);
        fmpq_poly_scalar_div_si(t, t, m - 1);
        fmpq_poly_add(A, s, t);
    }
    fmpq_poly_rem(A, A, f);
    product_modulo(residue, A, inverse, f);
    fmpq_poly_clear(slope);
    fmpq_poly_clear(inverse);
    fmpq_poly_clear(t);
    fmpq_poly_clear(s);
}

/* The residue of num/den at the roots of a factor of den: A = num (den/f^m)^-1 modulo f^m. */
static void residue_at(fmpq_poly_t residue, const fmpq_poly_t num, const fmpq_poly_t den, const fmpq_poly_t f, slong m)
{
    fmpq_poly_t power, rest, A;
    fmpq_poly_init(power);
    fmpq_poly_init(rest);
    fmpq_poly_init(A);
    fmpq_poly_pow(power, f, (ulong)m);
    fmpq_poly_div(rest, den, power);
    fmpq_poly_rem(rest, rest, power);
    inverse_modulo(A, rest, power);
    fmpq_poly_rem(rest, num, power);
    product_modulo(A, A, rest, power);
    hermite(residue, A, f, m);
    fmpq_poly_clear(power);
    fmpq_poly_clear(rest);
    fmpq_poly_clear(A);
}

/* All finite poles.  A residue that is not rational ends the search; else the first pole of higher order is told. */
static void finite_poles(nh_arena *arena, nh_residues *out, const fmpq_poly_t num, const fmpz_poly_t den)
{
    fmpz_poly_factor_t parts;
    fmpq_poly_t f, whole, residue;
    fmpz_poly_factor_init(parts);
    fmpq_poly_init(f);
    fmpq_poly_init(whole);
    fmpq_poly_init(residue);
    fmpq_poly_set_fmpz_poly(whole, den);
    fmpz_poly_factor(parts, den);
    for (slong i = 0; i < parts->num && out->verdict != NH_RESIDUE_MEROMORPHIC; i++) {
        fmpq_poly_set_fmpz_poly(f, parts->p + i);
        residue_at(residue, num, whole, f, parts->exp[i]);
        bool rational = fmpq_poly_degree(residue) <= 0;
        if (rational && (parts->exp[i] == 1 || out->verdict == NH_RESIDUE_RATIONAL)) continue;
        say(arena, out, rational ? NH_RESIDUE_RATIONAL : NH_RESIDUE_MEROMORPHIC, parts->p + i, residue);
        out->order = parts->exp[i];
    }
    fmpz_poly_factor_clear(parts);
    fmpq_poly_clear(f);
    fmpq_poly_clear(whole);
    fmpq_poly_clear(residue);
}

/* With u = 1/x, y' = a y becomes dy/du = -a(1/u)/u^2 y; a = c/x + .. behind the polynomial part has the residue -c. */
static void infinity(nh_arena *arena, nh_residues *out, const fmpq_poly_t num, const fmpz_poly_t den)
{
    slong excess = fmpq_poly_degree(num) - fmpz_poly_degree(den), at = fmpz_poly_degree(den) - 1;
    if (excess < 0 || fmpq_poly_is_zero(num)) return;
    fmpq_poly_t whole, rest;
    fmpq_t residue, leading;
    fmpq_poly_init(whole);
    fmpq_poly_init(rest);
    fmpq_init(residue);
    fmpq_init(leading);
    fmpq_poly_set_fmpz_poly(whole, den);
    fmpq_poly_rem(rest, num, whole);
    if (at >= 0) fmpq_poly_get_coeff_fmpq(residue, rest, at);
    fmpq_poly_get_coeff_fmpq(leading, whole, at + 1);
    fmpq_div(residue, residue, leading);
    fmpq_neg(residue, residue);
    char *text = fmpq_get_str(NULL, 10, residue);
    *out = (nh_residues){
        .verdict = NH_RESIDUE_RATIONAL, .factor = "1/x", .residue = nh_arena_strdup(arena, text), .order = excess + 2};
    flint_free(text);
    fmpq_poly_clear(whole);
    fmpq_poly_clear(rest);
    fmpq_clear(residue);
    fmpq_clear(leading);
}

nh_residues *nh_residues_of(nh_arena *arena, const nh_linear_equation *equation)
{
    nh_residues *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_residues){.verdict = NH_RESIDUE_OPEN};
    fmpz_poly_t num, den, common;
    fmpq_poly_t top;
    fmpz_poly_init(num);
    fmpz_poly_init(den);
    fmpz_poly_init(common);
    fmpq_poly_init(top);
    /* What num and den have in common is no pole. */
    fmpz_poly_gcd(common, equation->num, equation->den);
    fmpz_poly_div(num, equation->num, common);
    fmpz_poly_div(den, equation->den, common);
    fmpq_poly_set_fmpz_poly(top, num);
    finite_poles(arena, out, top, den);
    if (out->verdict == NH_RESIDUE_OPEN) infinity(arena, out, top, den);
    fmpz_poly_clear(num);
    fmpz_poly_clear(den);
    fmpz_poly_clear(common);
    fmpq_poly_clear(top);
    return out;
}
