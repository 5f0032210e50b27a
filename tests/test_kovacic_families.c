/* kovacic: families of equations, those with a table and those that have solutions by construction. */
#include "kovacic_equations.h"
#include "sweep.h"

#include <criterion/criterion.h>

#include "absence/kovacic_internal.h"

static nh_arena *arena;
static fmpz_poly_q_t r, map, pulled;

static void start(void)
{
    arena = nh_arena_create();
    fmpz_poly_q_init(r);
    fmpz_poly_q_init(map);
    fmpz_poly_q_init(pulled);
}

static void stop(void)
{
    fmpz_poly_q_clear(pulled);
    fmpz_poly_q_clear(map);
    fmpz_poly_q_clear(r);
    nh_arena_free(arena);
    flint_cleanup();
}

TestSuite(kovacic_families, .init = start, .fini = stop);

static const nh_kovacic *decide(const fmpz_poly_q_t equation)
{
    return nh_kovacic_decide(arena, fmpz_poly_q_numref(equation), fmpz_poly_q_denref(equation));
}

/* ---- straight motions in homogeneous potentials of degree k ---- */

enum { parts = 7200 };

/* Rows a + b (m + n j)^2 of the table of Morales-Ruiz and Ramis; a and b in parts. */
static const struct {
    long k, a, b, m, n;
} row[] = {
    {3, -300, 1200, 1, 3},  {3, -300, 675, 1, 4},   {3, -300, 432, 1, 5},   {3, -300, 432, 2, 5},   {-3, 7500, -1200, 1, 3},
    {-3, 7500, -675, 1, 4}, {-3, 7500, -432, 1, 5}, {-3, 7500, -432, 2, 5}, {4, -900, 1600, 1, 3},  {-4, 8100, -1600, 1, 3},
    {5, -1620, 2000, 1, 3}, {5, -1620, 720, 2, 5},  {-5, 8820, -2000, 1, 3}, {-5, 8820, -720, 2, 5},
};

enum { largest_j = 30, most_eigenvalues = 4000 };

/* Eigenvalues are n/(parts |k|).  All of the table with abs(lambda) <= 12 go into the list; returns their number. */
static size_t table_of(long k, long *list)
{
    size_t count = 0;
    long size = labs(k);
    for (long j = -largest_j; j <= largest_j; j++) {
        list[count++] = parts * size * j + parts / 2 * size * k * j * (j - 1);
        list[count++] = parts / 2 * (k < 0 ? 1 - k : k - 1) + parts / 2 * size * k * j * (j + 1);
        for (size_t i = 0; i < sizeof row / sizeof *row; i++)
            if (row[i].k == k) list[count++] = size * (row[i].a + row[i].b * (row[i].m + row[i].n * j) * (row[i].m + row[i].n * j));
    }
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (labs(list[i]) <= 12 * parts * size) list[kept++] = list[i];
    return kept;
}

static int by_number(const void *a, const void *b)
{
    long x = *(const long *)a, y = *(const long *)b;
    return (x > y) - (x < y);
}

static bool is_in(const long *list, size_t count, long n)
{
    for (size_t i = 0; i < count; i++)
        if (list[i] == n) return true;
    return false;
}

/* The hypergeometric equation with exponent differences 1/k, 1/2 and sqrt((k - 2)^2 + 8 k lambda)/(2 k). */
Test(kovacic_families, the_table_of_morales_ruiz_and_ramis)
{
    static const long degree[] = {1, -1, 3, -3, 4, -4, 5, -5, 6, 7, -7}, part[] = {1, 2, 3, 4, 8, 24};
    long table[most_eigenvalues], all[most_eigenvalues];
    size_t pairs = 0, tried = 0, differ = 0;
    for (size_t i = 0; i < sizeof degree / sizeof *degree; i++) {
        long k = degree[i], size = labs(k);
        size_t known = table_of(k, table), count = known;
        memcpy(all, table, known * sizeof *all);
        for (size_t b = 0; b < sizeof part / sizeof *part; b++)
            for (long a = -3 * part[b]; a <= 3 * part[b]; a++) all[count++] = a * (parts / part[b]) * size;
        qsort(all, count, sizeof *all, by_number);
        for (size_t n = 0; n < count; n++) {
            if (n && all[n] == all[n - 1]) continue;
            if (!sweep_tries(pairs++, 1, 10)) continue;
            const ratio s[3] = {{1, k * k}, {1, 4}, {900 * (k - 2) * (k - 2) + (k < 0 ? -1 : 1) * all[n], 3600 * k * k}};
            hypergeometric(r, s);
            const nh_kovacic *out = decide(r);
            bool allowed = is_in(table, known, all[n]);
            tried++;
            if (out->group == (allowed ? NH_GROUP_OPEN : NH_GROUP_SL2)) continue;
            differ++;
            cr_expect(false, "k = %ld, lambda = %ld/%ld: %s, %s", k, all[n], parts * size, nh_kovacic_word(out->group), out->obstacle);
        }
    }
    cr_expect_eq(pairs, 1702, "%zu pairs", pairs);
    cr_expect_eq(differ, 0);
    cr_log_info("%zu of %zu pairs, %zu differ", tried, pairs, differ);
}

/* ---- by construction ---- */

static void draw_map(uint64_t *state, long degree)
{
    fmpz_poly_t common;
    fmpz_poly_init(common);
    do {
        do {
            fmpz_poly_q_zero(map);
            for (long i = 0; i <= degree; i++) {
                fmpz_poly_set_coeff_si(fmpz_poly_q_numref(map), i, drawn(state, -3, 3));
                fmpz_poly_set_coeff_si(fmpz_poly_q_denref(map), i, drawn(state, -3, 3));
            }
        } while (fmpz_poly_is_zero(fmpz_poly_q_denref(map)) || fmpz_poly_is_zero(fmpz_poly_q_numref(map)));
        fmpz_poly_gcd(common, fmpz_poly_q_numref(map), fmpz_poly_q_denref(map));
        fmpz_poly_q_canonicalise(map);
    } while (fmpz_poly_degree(common) > 0 ||
             (fmpz_poly_degree(fmpz_poly_q_numref(map)) < 1 && fmpz_poly_degree(fmpz_poly_q_denref(map)) < 1));
    fmpz_poly_clear(common);
}

/* w = Sum of three rational residues, and of 0 to 2 zeros of the polynomial; `poles` 2: with exp(1/(x - c)) too. */
static void draw_reducible(uint64_t *state, bool irregular)
{
    fmpz_poly_q_t w, term;
    fmpz_poly_q_init(w);
    fmpz_poly_q_init(term);
    fmpz_poly_q_zero(w);
    for (size_t i = 0; i < 3; i++) {
        put_pole(term, (ratio){drawn(state, -3, 3), drawn(state, 1, 3)}, drawn(state, -4, 4));
        fmpz_poly_q_add(w, w, term);
    }
    long zeros = drawn(state, 0, 2);
    for (long i = 0; i < zeros; i++) {
        put_pole(term, (ratio){1, 1}, 5 + i);
        fmpz_poly_q_add(w, w, term);
    }
    if (irregular) {
        put_pole(term, (ratio){drawn(state, 1, 3), drawn(state, 1, 3)}, drawn(state, -2, 2));
        fmpz_poly_q_mul(term, term, term);
        fmpz_poly_q_add(w, w, term);
        if (drawn(state, 0, 1)) {
            put_text(term, "2  1 2");
            fmpz_poly_q_add(w, w, term);
        }
    }
    of_solution(r, w);
    fmpz_poly_q_clear(term);
    fmpz_poly_q_clear(w);
}

/* How many equations are SL(2), open, triangular, undecided. */
typedef struct {
    size_t of[4];
} tally;

static void count_in(tally *t, const fmpz_poly_q_t equation, bool solvable)
{
    const nh_kovacic *out = decide(equation), *again;
    again = nh_kovacic_decide_after(arena, fmpz_poly_q_numref(equation), fmpz_poly_q_denref(equation), out->prime);
    cr_expect_eq(again->group, out->group, "(%s)/(%s): modulo %lu", out->r_num, out->r_den, again->prime);
    t->of[out->group]++;
    if (solvable && out->group == NH_GROUP_SL2) cr_expect(false, "SL(2) instead of open: (%s)/(%s)", out->r_num, out->r_den);
    if (!solvable && out->group == NH_GROUP_OPEN) cr_expect(false, "open instead of SL(2): (%s)/(%s): %s", out->r_num, out->r_den, out->obstacle);
    if (out->group == NH_GROUP_UNDECIDED) cr_log_info("undecided: (%s)/(%s): %s", out->r_num, out->r_den, out->obstacle);
}

enum { each = 25, each_whole = 2000 };

static size_t times_of_each(void) { return sweep_whole() ? each_whole : sweep_sanitized() ? 3 : each; }

Test(kovacic_families, reducible_equations_are_never_called_irreducible)
{
    tally t = {{0}};
    uint64_t state = 5;
    for (size_t i = 0; i < times_of_each(); i++) {
        draw_reducible(&state, false);
        if (!fmpz_poly_q_is_zero(r)) count_in(&t, r, true);
        draw_reducible(&state, true);
        count_in(&t, r, true);
    }
    cr_expect_eq(t.of[NH_GROUP_SL2], 0);
    cr_expect_eq(t.of[NH_GROUP_TRIANGULAR], 0); /* all exponents are rational, or a point is irregular */
    cr_expect_eq(t.of[NH_GROUP_UNDECIDED], 0);
}

Test(kovacic_families, finite_and_dihedral_groups_are_never_called_SL2)
{
    tally t = {{0}};
    uint64_t state = 7;
    for (size_t i = 0; i < times_of_each(); i++) {
        long n = drawn(&state, 2, 7), q = drawn(&state, 0, 2);
        const ratio all[][3] = {{{1, 4}, {1, 4}, {1, n * n}},       {{1, 4}, {1, 4}, {q == 2 ? 5 : 2 + q, 1}},
                                {{1, 9}, {1, 4}, {1, 9}},           {{1, 9}, {1, 4}, {1, 16}},
                                {{1, 9}, {1, 4}, {1, 25}}};
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
            hypergeometric(r, all[k]);
            draw_map(&state, drawn(&state, 1, 2));
            pull_back(pulled, r, map);
            count_in(&t, pulled, true);
        }
    }
    cr_expect_eq(t.of[NH_GROUP_SL2], 0);
    cr_expect_eq(t.of[NH_GROUP_TRIANGULAR], 0);
}

Test(kovacic_families, generic_hypergeometric_equations_are_SL2)
{
    static const long numerator[] = {1, 2, 4, 5};
    tally t = {{0}};
    uint64_t state = 11;
    for (size_t i = 0; i < times_of_each(); i++) {
        long n = numerator[drawn(&state, 0, 3)];
        const ratio s[3] = {{1, 9}, {1, 4}, {n * n, 49}};
        hypergeometric(r, s);
        draw_map(&state, drawn(&state, 1, 2));
        pull_back(pulled, r, map);
        count_in(&t, pulled, false);
    }
    cr_expect_eq(t.of[NH_GROUP_SL2], times_of_each());
}

/* y = x^(1/4) exp(+-2 sqrt(x)) and what maps make of it: a torus and its normalizer, with irregular points. */
Test(kovacic_families, irregular_dihedral_groups_are_never_called_SL2)
{
    tally t = {{0}};
    uint64_t state = 13;
    put_text(r, "2  -3 16/3  0 0 16");
    count_in(&t, r, true);
    for (size_t i = 0; i < 2 * times_of_each(); i++) {
        draw_map(&state, drawn(&state, 1, 3));
        pull_back(pulled, r, map);
        count_in(&t, pulled, true);
    }
    cr_expect_eq(t.of[NH_GROUP_SL2], 0);
    cr_expect_eq(t.of[NH_GROUP_TRIANGULAR], 0);
    cr_expect_eq(t.of[NH_GROUP_UNDECIDED], 0);
}

/* Bessel's and Airy's equations behind maps. */
Test(kovacic_families, irregular_SL2)
{
    tally t = {{0}};
    uint64_t state = 17;
    for (size_t i = 0; i < times_of_each(); i++) {
        put_text(r, i % 2 ? "2  0 1" : "3  -5 0 36/3  0 0 36"); /* y'' = x y; nu = 1/3 */
        draw_map(&state, drawn(&state, 1, 3));
        pull_back(pulled, r, map);
        count_in(&t, pulled, false);
    }
    cr_expect_eq(t.of[NH_GROUP_SL2], times_of_each());
}

/* Solutions with y_1 y_2 = sqrt(v) and the Wronskian sqrt(c): with L = v'/(2 v),  r = L'/2 + L^2/4 + c/(4 v).  The
 * group is a torus, its normalizer, or a part of them, with conjugate poles and exponents of all kinds. */
Test(kovacic_families, what_has_a_product_of_solutions_is_never_called_SL2)
{
    tally t = {{0}};
    uint64_t state = 19;
    for (size_t i = 0; i < 2 * times_of_each(); i++) {
        draw_map(&state, drawn(&state, 1, 3));
        if (drawn(&state, 0, 1)) fmpz_poly_q_mul(map, map, map);
        fmpz_poly_q_derivative(r, map);
        fmpz_poly_q_div(r, r, map);
        fmpz_poly_q_scalar_div_si(r, r, 4);
        of_solution(pulled, r);
        fmpz_poly_q_inv(r, map);
        times(r, (ratio){drawn(&state, -5, 5), drawn(&state, 1, 4)});
        fmpz_poly_q_add(pulled, pulled, r);
        if (!fmpz_poly_q_is_zero(pulled)) count_in(&t, pulled, true);
    }
    cr_expect_eq(t.of[NH_GROUP_SL2], 0);
    cr_expect_eq(t.of[NH_GROUP_TRIANGULAR], 0);
    cr_expect_eq(t.of[NH_GROUP_UNDECIDED], 0);
}

/* exp(int w) with w any rational function, of poles of order 1 and 2 at conjugate points. */
Test(kovacic_families, a_solution_with_a_rational_logarithmic_derivative_is_never_called_SL2)
{
    tally t = {{0}};
    uint64_t state = 23;
    for (size_t i = 0; i < 2 * times_of_each(); i++) {
        draw_map(&state, drawn(&state, 1, 3));
        if (drawn(&state, 0, 2) == 2) fmpz_poly_q_mul(map, map, map);
        of_solution(r, map);
        if (!fmpz_poly_q_is_zero(r)) count_in(&t, r, true);
    }
    cr_expect_eq(t.of[NH_GROUP_SL2], 0);
    cr_expect_leq(20 * t.of[NH_GROUP_UNDECIDED], t.of[NH_GROUP_OPEN]); /* other signs give degrees over 400 */
}

/* y'' = (x^2/4 - a) y behind maps: elementary for a half an odd number. */
Test(kovacic_families, weber_behind_maps)
{
    tally t = {{0}};
    uint64_t state = 29;
    for (size_t i = 0; i < times_of_each(); i++) {
        long twice = drawn(&state, -7, 7);
        put_text(r, "3  0 0 1/1  4");
        add_ratio(r, (ratio){-twice, 2});
        draw_map(&state, drawn(&state, 1, 2));
        pull_back(pulled, r, map);
        count_in(&t, pulled, twice % 2);
    }
    cr_expect_eq(t.of[NH_GROUP_SL2] + t.of[NH_GROUP_OPEN], times_of_each());
}
