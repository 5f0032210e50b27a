/* The engines on one normal equation: what dimension do orbits of its group have at least?
 *
 * Kovacic's algorithm, residues and logarithms of higher order take milliseconds.  The monodromy in balls takes a
 * second, and is for --absence. */
#include "absence/absence_internal.h"
#include "absence/polynomial_text.h"
#include "base/progress.h"

/* An orbit of the blocks' group.  The first bound of the dimension, and where it comes from, is kept unless a later one
 * is larger, or as large and of the larger class of functions. */
static void bound(nh_absence_attempt *attempt, size_t of_blocks, bool rational)
{
    size_t orbit = nh_normal_equation_orbit(attempt->equation, of_blocks);
    if (orbit > attempt->orbit || (orbit == attempt->orbit && orbit && attempt->rational && !rational)) {
        attempt->orbit = orbit;
        attempt->rational = rational;
    }
}

/* "(x^2 - 1)/(2*x)": with whole coefficients that have no common factor. */
static const char *quotient_text(nh_arena *arena, const fmpq_poly_t num, const fmpq_poly_t den)
{
    fmpz_poly_t n, d;
    fmpz_t common, other;
    fmpz_poly_init(n);
    fmpz_poly_init(d);
    fmpz_init(common);
    fmpz_init(other);
    fmpq_poly_get_numerator(n, num);
    fmpq_poly_get_numerator(d, den);
    fmpz_poly_scalar_mul_fmpz(n, n, fmpq_poly_denref(den));
    fmpz_poly_scalar_mul_fmpz(d, d, fmpq_poly_denref(num));
    fmpz_poly_content(common, n);
    fmpz_poly_content(other, d);
    fmpz_gcd(common, common, other);
    if (fmpz_sgn(fmpz_poly_lead(d)) < 0) fmpz_neg(common, common);
    fmpz_poly_scalar_divexact_fmpz(n, n, common);
    fmpz_poly_scalar_divexact_fmpz(d, d, common);
    const char *above = nh_polynomial_text_whole(arena, n, "x"), *below = nh_polynomial_text_whole(arena, d, "x");
    const char *text = fmpz_poly_is_one(d) ? above : nh_arena_printf(arena, "(%s)/(%s)", above, below);
    fmpz_poly_clear(n);
    fmpz_poly_clear(d);
    fmpz_clear(common);
    fmpz_clear(other);
    return text;
}

/* Is exp(-int P) algebraic?  Then the factor between y and its normal form is. */
static bool algebraic_wronskian(nh_arena *arena, const fmpq_poly_t p, const fmpq_poly_t p_den)
{
    nh_linear_equation wronskian;
    nh_linear_equation_init(&wronskian, 1);
    nh_linear_equation_set(&wronskian, 0, 0, p, p_den);
    nh_linear_equation_reduce(&wronskian);
    bool algebraic = nh_residues_of(arena, &wronskian)->verdict == NH_RESIDUE_OPEN;
    nh_linear_equation_clear(&wronskian);
    return algebraic;
}

/* SL(2) moves a general vector in two directions, whatever the factor exp(-int P/2) is.  The triangular group does so
 * where that factor is algebraic; else it moves directions, which is one dimension. */
static void second_order(nh_arena *arena, nh_absence_attempt *attempt, const nh_linear_equation *block)
{
    enum { plane = 2 };
    fmpq_poly_t p, p_den, q, q_den;
    fmpz_poly_t r, r_den;
    fmpq_poly_init(p);
    fmpq_poly_init(p_den);
    fmpq_poly_init(q);
    fmpq_poly_init(q_den);
    fmpz_poly_init(r);
    fmpz_poly_init(r_den);
    if (nh_linear_equation_second_order(block, p, p_den, q, q_den)) {
        attempt->p = quotient_text(arena, p, p_den);
        attempt->q = quotient_text(arena, q, q_den);
        nh_linear_equation_normal_form(p, p_den, q, q_den, r, r_den);
        nh_kovacic *kovacic = attempt->kovacic = nh_kovacic_decide(arena, r, r_den);
        if (kovacic->group == NH_GROUP_SL2) bound(attempt, plane, !kovacic->regular);
        else if (kovacic->group == NH_GROUP_TRIANGULAR)
            bound(attempt, algebraic_wronskian(arena, p, p_den) ? plane : 1, !kovacic->regular);
        else attempt->obstacle = kovacic->obstacle;
    }
    fmpq_poly_clear(p);
    fmpq_poly_clear(p_den);
    fmpq_poly_clear(q);
    fmpq_poly_clear(q_den);
    fmpz_poly_clear(r);
    fmpz_poly_clear(r_den);
}

static void first_order(nh_arena *arena, nh_absence_attempt *attempt, const nh_linear_equation *block)
{
    nh_residues *residues = nh_residues_of(arena, block);
    if (residues->verdict == NH_RESIDUE_OPEN && attempt->residues) return;
    if (!attempt->residues || attempt->residues->verdict == NH_RESIDUE_OPEN) attempt->residues = residues;
    if (residues->verdict != NH_RESIDUE_OPEN) bound(attempt, 1, residues->verdict == NH_RESIDUE_RATIONAL);
    else if (!attempt->obstacle) attempt->obstacle = "all residues are rational";
}

/* Theorem L holds whatever the group of the first order is, if it is connected. */
static void higher_order(nh_arena *arena, const nh_closed_shape *shape, nh_absence_attempt *attempt, bool everything)
{
    nh_higher *higher = nh_higher_of(arena, shape, attempt->equation, everything);
    if (!higher->applies || nh_interrupted()) return;
    attempt->higher = higher;
    if (!attempt->obstacle || !attempt->kovacic || attempt->kovacic->group == NH_GROUP_OPEN)
        attempt->obstacle = higher->obstacle;
}

bool nh_absence_attempt_run(nh_arena *arena, const nh_closed_shape *shape, nh_absence_attempt *attempt, bool everything,
                            const char *without_monodromy)
{
    const nh_normal_equation *equation = attempt->equation;
    for (size_t i = 0; i < equation->blocks; i++) {
        const nh_linear_equation *block = &equation->block[i];
        /* one block's orbit is a bound for all of them; dimensions of several are never added */
        if (block->size == 1) first_order(arena, attempt, block);
        bool refuted = attempt->kovacic && attempt->kovacic->group == NH_GROUP_SL2;
        if (block->size == 2 && !refuted) second_order(arena, attempt, block);
    }
    if (nh_interrupted()) return false;
    if (attempt->orbit < equation->dimension) higher_order(arena, shape, attempt, everything);
    bool refuted = attempt->higher && attempt->higher->refuted;
    nh_monodromy *monodromy = without_monodromy ? NULL : nh_monodromy_try(arena, equation->blocks, equation->block);
    if (monodromy && !nh_interrupted()) {
        attempt->monodromy = monodromy;
        bound(attempt, attempt->monodromy->rank, false);
        if (!attempt->obstacle && !refuted) attempt->obstacle = attempt->monodromy->obstacle;
    }
    if (attempt->orbit == equation->dimension || refuted) attempt->obstacle = NULL;
    else if (!attempt->obstacle) attempt->obstacle = without_monodromy;
    return true;
}
