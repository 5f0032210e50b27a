/* residues: y' = a(x) y.  Solutions that are algebraic by construction stay open; residues that are not rational, poles of higher order and
 * polynomial parts are told with their place. */
#include <criterion/criterion.h>

#include <string.h>

#include "absence/residues.h"

/* a = num/den, both as text of FLINT: length and coefficients. */
static nh_residues *residues_of(nh_arena *arena, const char *num, const char *den)
{
    nh_linear_equation equation;
    fmpq_poly_t top, bottom;
    fmpq_poly_init(top);
    fmpq_poly_init(bottom);
    cr_assert(!fmpq_poly_set_str(top, num) && !fmpq_poly_set_str(bottom, den), "%s over %s", num, den);
    nh_linear_equation_init(&equation, 1);
    nh_linear_equation_set(&equation, 0, 0, top, bottom);
    nh_linear_equation_reduce(&equation);
    nh_residues *out = nh_residues_of(arena, &equation);
    nh_linear_equation_clear(&equation);
    fmpq_poly_clear(top);
    fmpq_poly_clear(bottom);
    return out;
}

/* Known cases.  The first is that of y exp(-1/x), which is single-valued beside 0; with residues +-i sqrt(2)/2 a loop multiplies y by
 * exp(-pi sqrt(2)). */
Test(residues, known)
{
    static const struct { const char *num, *den; nh_residue_verdict verdict; const char *factor, *residue; slong order; } list[] = {
        {"1  -1", "3  0 0 1", NH_RESIDUE_RATIONAL, "x", "0", 2},                 /* -1/x^2 */
        {"1  -2", "3  2 0 1", NH_RESIDUE_MEROMORPHIC, "x^2 + 2", "1/2*x", 1},      /* -2/(x^2 + 2) */
        {"2  0 1", "3  2 0 1", NH_RESIDUE_OPEN, NULL, NULL, 0},                  /* x/(x^2 + 2): y = (x^2 + 2)^(1/2) */
        {"2  0 1", "5  4 0 4 0 1", NH_RESIDUE_RATIONAL, "x^2 + 2", "0", 2},        /* x/(x^2 + 2)^2 */
        {"1  1", "5  4 0 4 0 1", NH_RESIDUE_MEROMORPHIC, "x^2 + 2", "-1/16*x", 2}, /* 1/(x^2 + 2)^2 */
        {"1  1", "4  0 0 0 1", NH_RESIDUE_RATIONAL, "x", "0", 3},                /* 1/x^3 */
        {"3  1 5 3", "4  0 0 0 2", NH_RESIDUE_RATIONAL, "x", "3/2", 3},
        {"1  1", "2  0 1", NH_RESIDUE_OPEN, NULL, NULL, 0},
        {"1  3", "1  2", NH_RESIDUE_RATIONAL, "1/x", "0", 2},                    /* exp(3 x/2) */
        {"3  5 0 1", "2  1 3", NH_RESIDUE_RATIONAL, "1/x", "-46/27", 3},         /* (x^2 + 5)/(3 x + 1), residue 46/27 at -1/3 */
        {"0", "1  1", NH_RESIDUE_OPEN, NULL, NULL, 0},
        {"2  3 1", "3  -1 -1 1", NH_RESIDUE_MEROMORPHIC, "x^2 - x - 1", "7/5*x - 1/5", 1}, /* real conjugate poles */
        /* A pole of higher order beside an irrational residue: the stronger verdict. */
        {"1  -2", "5  0 0 2 0 1", NH_RESIDUE_MEROMORPHIC, "x^2 + 2", "-1/4*x", 1},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_arena *arena = nh_arena_create();
        nh_residues *out = residues_of(arena, list[i].num, list[i].den);
        cr_expect_eq(out->verdict, list[i].verdict, "%s over %s: verdict %d", list[i].num, list[i].den, out->verdict);
        cr_expect_eq(out->order, list[i].order, "%s over %s: order %ld", list[i].num, list[i].den, (long)out->order);
        if (list[i].factor) {
            cr_expect(out->factor && !strcmp(out->factor, list[i].factor), "%s over %s: %s", list[i].num, list[i].den, out->factor);
            cr_expect(out->residue && !strcmp(out->residue, list[i].residue), "%s over %s: %s", list[i].num, list[i].den, out->residue);
        } else {
            cr_expect(!out->factor && !out->residue);
        }
        nh_arena_free(arena);
    }
}

static unsigned long state = 12345;
static long drawn(long most) /* -most .. most */
{
    state = (state * 6364136223846793005UL + 1442695040888963407UL);
    return (long)((state >> 33) % (unsigned long)(2 * most + 1)) - most;
}

/* a += c p'/p */
static void add_logarithm(fmpq_poly_t num, fmpq_poly_t den, const fmpq_poly_t p, const fmpq_t c)
{
    fmpq_poly_t slope;
    fmpq_poly_init(slope);
    fmpq_poly_derivative(slope, p);
    fmpq_poly_scalar_mul_fmpq(slope, slope, c);
    fmpq_poly_mul(slope, slope, den);
    fmpq_poly_mul(num, num, p);
    fmpq_poly_add(num, num, slope);
    fmpq_poly_mul(den, den, p);
    fmpq_poly_clear(slope);
}

static void draw_polynomial(fmpq_poly_t p, long degree)
{
    fmpq_poly_zero(p);
    for (long i = 0; i < degree; i++) fmpq_poly_set_coeff_si(p, i, drawn(5));
    fmpq_poly_set_coeff_si(p, degree, 1 + (drawn(2) + 2) % 3);
}

static nh_residue_verdict verdict_of(const fmpq_poly_t num, const fmpq_poly_t den)
{
    nh_linear_equation equation;
    nh_arena *arena = nh_arena_create();
    nh_linear_equation_init(&equation, 1);
    nh_linear_equation_set(&equation, 0, 0, num, den);
    nh_linear_equation_reduce(&equation);
    nh_residue_verdict verdict = nh_residues_of(arena, &equation)->verdict;
    nh_linear_equation_clear(&equation);
    nh_arena_free(arena);
    return verdict;
}

/* y = prod p_i(x)^(c_i) with any polynomials p_i and rationals c_i is algebraic, pulled back by any x -> r(x) too.  y exp(h) with a rational h is
 * not, but its residues are rational.  With a factor ((x - s)/(x + s))^(1/s), s = sqrt(2), residues are not rational; they stay so under every
 * x -> r(x). */
Test(residues, built_in)
{
    enum { turns = 200, most_parts = 4 };
    fmpq_poly_t num, den, p, h, top;
    fmpq_t c;
    fmpq_poly_init(num);
    fmpq_poly_init(den);
    fmpq_poly_init(p);
    fmpq_poly_init(h);
    fmpq_poly_init(top);
    fmpq_init(c);
    for (int turn = 0; turn < turns; turn++) {
        fmpq_poly_zero(num);
        fmpq_poly_one(den);
        long parts = 1 + (drawn(most_parts) + most_parts) % most_parts, pulled = 1 + turn % 3;
        for (long i = 0; i < parts; i++) {
            draw_polynomial(p, 1 + (drawn(3) + 3) % 3);
            draw_polynomial(h, pulled);
            if (turn % 2) fmpq_poly_compose(p, p, h);
            fmpq_set_si(c, drawn(20), (ulong)(1 + (drawn(6) + 6) % 7));
            add_logarithm(num, den, p, c);
        }
        cr_expect_eq(verdict_of(num, den), NH_RESIDUE_OPEN, "turn %d: an algebraic solution is refuted", turn);

        /* h' with h = top/p */
        draw_polynomial(p, 1 + turn % 2);
        draw_polynomial(top, 3);
        fmpq_poly_t slope, other;
        fmpq_poly_init(slope);
        fmpq_poly_init(other);
        fmpq_poly_derivative(slope, top);
        fmpq_poly_mul(slope, slope, p);
        fmpq_poly_derivative(other, p);
        fmpq_poly_mul(other, other, top);
        fmpq_poly_sub(slope, slope, other);
        fmpq_poly_mul(other, p, p);
        fmpq_poly_mul(num, num, other);
        fmpq_poly_mul(slope, slope, den);
        fmpq_poly_add(num, num, slope);
        fmpq_poly_mul(den, den, other);
        cr_expect_eq(verdict_of(num, den), NH_RESIDUE_RATIONAL, "turn %d: an exponential", turn);

        /* r'/(r^2 - 2) */
        draw_polynomial(h, pulled);
        fmpq_poly_mul(other, h, h);
        fmpq_poly_set_str(slope, "1  2");
        fmpq_poly_sub(other, other, slope);
        fmpq_poly_derivative(slope, h);
        fmpq_poly_mul(num, num, other);
        fmpq_poly_mul(slope, slope, den);
        fmpq_poly_add(num, num, slope);
        fmpq_poly_mul(den, den, other);
        cr_expect_eq(verdict_of(num, den), NH_RESIDUE_MEROMORPHIC, "turn %d: residues 1/sqrt(2)", turn);
        fmpq_poly_clear(slope);
        fmpq_poly_clear(other);
    }
    fmpq_poly_clear(num);
    fmpq_poly_clear(den);
    fmpq_poly_clear(p);
    fmpq_poly_clear(h);
    fmpq_poly_clear(top);
    fmpq_clear(c);
}
