/* kovacic: groups of equations whose groups are known. */
#include "kovacic_equations.h"
#include "sweep.h"

#include <criterion/criterion.h>

#include "absence/kovacic_internal.h"

static nh_arena *arena;
static fmpz_poly_q_t r, P, Q;

static void start(void)
{
    arena = nh_arena_create();
    fmpz_poly_q_init(r);
    fmpz_poly_q_init(P);
    fmpz_poly_q_init(Q);
}

static void stop(void)
{
    fmpz_poly_q_clear(Q);
    fmpz_poly_q_clear(P);
    fmpz_poly_q_clear(r);
    nh_arena_free(arena);
    flint_cleanup();
}

TestSuite(kovacic, .init = start, .fini = stop);

static const nh_kovacic *decide_after(ulong prime)
{
    return nh_kovacic_decide_after(arena, fmpz_poly_q_numref(r), fmpz_poly_q_denref(r), prime);
}

static const nh_kovacic *decide(void)
{
    return nh_kovacic_decide(arena, fmpz_poly_q_numref(r), fmpz_poly_q_denref(r));
}

/* By one prime, and by the next. */
static const nh_kovacic *expect(nh_kovacic_group group, const char *what)
{
    const nh_kovacic *one = decide(), *two = decide_after(one->prime);
    cr_expect_eq(one->group, group, "%s: %s, %s", what, nh_kovacic_word(one->group), one->obstacle);
    cr_expect_eq(two->group, group, "%s: %s modulo %lu", what, nh_kovacic_word(two->group), two->prime);
    cr_expect(two->prime != one->prime || !one->prime);
    cr_expect_eq(!one->obstacle, one->group == NH_GROUP_SL2 || one->group == NH_GROUP_TRIANGULAR);
    return one;
}

static const nh_kovacic *expect_text(nh_kovacic_group group, const char *text)
{
    put_text(r, text);
    return expect(group, text);
}

/* ---- reducible equations ---- */

/* r = w' + w^2 with w = 1/(x^2 - 2): one invariant line over Q(x), residues that are not rational. */
Test(kovacic, a_triangular_group_of_dimension_2_over_the_rationals)
{
    const nh_kovacic *k = expect_text(NH_GROUP_TRIANGULAR, "2  1 -2/5  4 0 -4 0 1");
    cr_expect_eq(k->riccati, 1);
    cr_expect(k->regular);
    cr_expect_eq(k->poles, 2);
    put_text(P, "1  3/3  -2 0 1");
    put_text(Q, "1  1/2  0 1");
    fmpz_poly_q_add(P, P, Q);
    of_solution(r, P);
    expect(NH_GROUP_TRIANGULAR, "w = 3/(x^2 - 2) + 1/x");
}

/* y = x^(1/3) (x - 1)^(34/15) (x - 5/39): modulo 13 the polynomial factor is constant.  Legendre's P_7: of degree 5. */
Test(kovacic, a_solution_whose_degree_falls_modulo_the_prime_is_seen)
{
    put_text(Q, "1  39/2  -5 39");
    put_pole(P, (ratio){1, 3}, 0);
    fmpz_poly_q_add(Q, Q, P);
    put_pole(P, (ratio){34, 15}, 1);
    fmpz_poly_q_add(Q, Q, P);
    of_solution(r, Q);
    const nh_kovacic *k = decide_after(12);
    cr_expect_eq(k->prime, 13);
    cr_expect_eq(k->poles, 2);
    cr_expect_eq(k->group, NH_GROUP_OPEN);
    cr_expect_geq(k->riccati, 1);
    expect(NH_GROUP_OPEN, "x^(1/3) (x - 1)^(34/15) (x - 5/39)");
}

static void legendre(ratio n)
{
    put_text(P, "2  0 -2/3  1 0 -1");
    put_text(Q, "1  1/3  1 0 -1");
    times(Q, (ratio){n.n * (n.n + n.d), n.d * n.d});
    of_second_order(r, P, Q);
}

Test(kovacic, legendre)
{
    legendre((ratio){7, 1});
    cr_expect_eq(decide_after(12)->prime, 13);
    cr_expect_eq(decide_after(12)->group, NH_GROUP_OPEN);
    cr_expect_geq(decide_after(12)->riccati, 1);
    legendre((ratio){1, 3});
    expect(NH_GROUP_SL2, "Legendre 1/3");
    legendre((ratio){2, 1});
    expect(NH_GROUP_OPEN, "Legendre 2");
    legendre((ratio){1, 2});
    expect(NH_GROUP_SL2, "Legendre 1/2");
    legendre((ratio){-1, 4});
    expect(NH_GROUP_SL2, "Legendre -1/4");
    legendre((ratio){399, 1});
    expect(NH_GROUP_OPEN, "Legendre 399");
    legendre((ratio){1001, 1});
    cr_expect_eq(decide()->group, NH_GROUP_UNDECIDED);
    cr_expect(strstr(decide()->obstacle, "400") != NULL);
}

/* ---- exact members ---- */

Test(kovacic, what_a_checker_needs_is_exact)
{
    put_text(r, "5  -3 0 -6 0 21/5  16 0 -32 0 16"); /* poles 1, -1 */
    const nh_kovacic *k = expect(NH_GROUP_SL2, "two poles");
    cr_assert_eq(k->poles, 2);
    for (size_t i = 0; i < 2; i++) {
        cr_expect_eq(k->pole[i] * k->pole[i] % k->prime, 1);
        cr_expect(k->double_pole[i]);
        cr_expect_lt(k->root[i], k->prime);
    }
    cr_expect_str_eq(k->r_den, "16*x^4-32*x^2+16");
    cr_expect_str_eq(k->den[1], "0");
    cr_expect_eq(k->den_length, 5);
}

Test(kovacic, exponents_are_told)
{
    const ratio s[3] = {{4, 9}, {2, 1}, {-1, 4}};
    hypergeometric(r, s);
    const nh_kovacic *k = expect(NH_GROUP_SL2, "exponents");
    cr_assert_eq(k->poles, 2);
    bool first = !strcmp(k->exponent[0], "2/3");
    cr_expect_str_eq(k->exponent[first ? 0 : 1], "2/3");
    cr_expect_str_eq(k->exponent[first ? 1 : 0], "1.4142");
    cr_expect_str_eq(k->exponent[2], "0.50000 i");
}

/* ---- no prime ---- */

/* A factor of degree 10 whose group has 3628800 elements: 1 prime in so many splits it. */
Test(kovacic, without_a_prime)
{
    put_text(r, "1  1/11  3 1 -4 0 0 2 0 0 1 5 7");
    const nh_kovacic *k = decide();
    cr_expect_eq(k->group, NH_GROUP_UNDECIDED);
    cr_expect(strstr(k->obstacle, "no prime"), "%s", k->obstacle);
    cr_expect_eq(k->prime, 0);
    cr_expect_null(k->pole);
}

Test(kovacic, nothing_and_too_much)
{
    fmpz_poly_q_zero(r);
    cr_expect_eq(decide()->group, NH_GROUP_OPEN);
    put_text(r, "1  1/2  -1 1");
    put_text(P, "2  0 1");
    for (long i = 2; i < 70; i++) { /* 1/((x - 1) .. (x - 69)) */
        fmpz_poly_q_t pole;
        fmpz_poly_q_init(pole);
        put_pole(pole, (ratio){1, 1}, i);
        fmpz_poly_q_mul(r, r, pole);
        fmpz_poly_q_clear(pole);
    }
    cr_expect_eq(decide()->group, NH_GROUP_UNDECIDED);
    cr_expect_not_null(decide()->obstacle);
}

/* Many poles, all choices of signs with a whole degree: the work is counted. */
Test(kovacic, many_poles)
{
    fmpz_poly_q_zero(P);
    for (long i = 0; i < 12; i++) {
        put_pole(Q, (ratio){1, 3}, i);
        fmpz_poly_q_add(P, P, Q);
    }
    of_solution(r, P);
    expect(NH_GROUP_OPEN, "12 poles, a solution");
    put_text(Q, "1  1/3  0 0 1");
    fmpz_poly_q_add(r, r, Q);
    const nh_kovacic *k = decide();
    cr_expect_eq(k->poles, 12);
    cr_expect_eq(k->group, NH_GROUP_SL2);
    cr_expect_eq(k->sign_vectors, k->degrees ? 4096 : 0);
}

/* ---- equations of mechanics ---- */

Test(kovacic, henon_heiles)
{
    static const struct {
        ratio B, eps;
        nh_kovacic_group group;
    } all[] = {
        {{1, 1}, {-1, 3}, NH_GROUP_SL2}, {{1, 1}, {1, 1}, NH_GROUP_SL2},   {{1, 1}, {16, 3}, NH_GROUP_SL2},
        {{1, 1}, {2, 1}, NH_GROUP_OPEN}, {{7, 3}, {2, 1}, NH_GROUP_OPEN},  {{1, 1}, {1, 3}, NH_GROUP_OPEN},
        {{16, 1}, {16, 3}, NH_GROUP_OPEN}, {{2, 1}, {1, 3}, NH_GROUP_OPEN}, {{1, 4}, {1, 3}, NH_GROUP_OPEN},
        {{1, 1}, {2, 3}, NH_GROUP_OPEN}, {{4, 1}, {2, 3}, NH_GROUP_OPEN},  {{1, 1}, {1, 5}, NH_GROUP_OPEN},
        {{5, 1}, {2, 15}, NH_GROUP_OPEN}, {{1, 1}, {0, 1}, NH_GROUP_SL2},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char what[80];
        snprintf(what, sizeof what, "B = %ld/%ld, eps = %ld/%ld", all[i].B.n, all[i].B.d, all[i].eps.n, all[i].eps.d);
        henon_heiles(r, all[i].B, all[i].eps, (ratio){1, 7});
        const nh_kovacic *k = expect(all[i].group, what);
        cr_expect_eq(k->regular, all[i].eps.n != 0, "%s", what);
    }
}

Test(kovacic, suslov)
{
    static const struct {
        ratio I1, I2;
        nh_kovacic_group group;
    } all[] = {
        {{1, 1}, {1, 1}, NH_GROUP_OPEN}, {{2, 1}, {1, 1}, NH_GROUP_SL2}, {{1, 1}, {2, 1}, NH_GROUP_SL2},
        {{3, 1}, {2, 1}, NH_GROUP_SL2},  {{8, 3}, {1, 1}, NH_GROUP_SL2}, {{3, 1}, {1, 1}, NH_GROUP_SL2},
        {{6, 1}, {1, 1}, NH_GROUP_SL2},  {{10, 1}, {1, 1}, NH_GROUP_SL2}, {{1, 1}, {3, 1}, NH_GROUP_OPEN},
        {{1, 1}, {6, 1}, NH_GROUP_OPEN},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char what[80];
        snprintf(what, sizeof what, "I1 = %ld/%ld, I2 = %ld/%ld", all[i].I1.n, all[i].I1.d, all[i].I2.n, all[i].I2.d);
        suslov(r, all[i].I1, all[i].I2);
        expect(all[i].group, what);
    }
}

Test(kovacic, the_contact_particle_in_quadratic_potentials_stays_open)
{
    static const ratio all[][2] = {{{1, 1}, {4, 1}},  {{7, 10}, {2, 5}}, {{1, 1}, {1, 1}},   {{1, 1}, {9, 1}},
                                   {{4, 1}, {1, 1}},  {{2, 1}, {1, 1}},  {{1, 1}, {2, 1}},   {{1, 1}, {3, 1}},
                                   {{9, 1}, {4, 1}},  {{1, 1}, {16, 1}}, {{0, 1}, {1, 1}},   {{1, 3}, {4, 3}},
                                   {{-2, 1}, {-8, 1}}, {{3, 1}, {4, 1}}, {{2, 1}, {9, 1}},   {{6, 1}, {1, 1}},
                                   {{1, 1}, {6, 1}}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char what[80];
        snprintf(what, sizeof what, "b = %ld/%ld, c = %ld/%ld", all[i][0].n, all[i][0].d, all[i][1].n, all[i][1].d);
        contact_particle(r, all[i][0], all[i][1]);
        expect(NH_GROUP_OPEN, what);
    }
}

/* ---- irregular points ---- */

/* y'' = (x^2/4 - a) y: solutions exp(-x^2/4) H(x) where a = n + 1/2, exp(x^2/4) H where a = -n - 1/2. */
static void weber(ratio a)
{
    put_text(r, "3  0 0 1/1  4");
    add_ratio(r, (ratio){-a.n, a.d});
}

/* y'' = (1 + (nu^2 - 1/4)/x^2) y: elementary where nu is half an odd number. */
static void bessel(ratio nu)
{
    put_text(r, "1  1/3  0 0 1");
    times(r, (ratio){4 * nu.n * nu.n - nu.d * nu.d, 4 * nu.d * nu.d});
    add_ratio(r, (ratio){1, 1});
}

/* y'' = (1/4 - kappa/x + (mu^2 - 1/4)/x^2) y: elementary where kappa + mu or kappa - mu is half an odd number. */
static void whittaker(ratio kappa, ratio mu)
{
    put_text(r, "1  1/3  0 0 1");
    times(r, (ratio){4 * mu.n * mu.n - mu.d * mu.d, 4 * mu.d * mu.d});
    put_text(P, "1  -1/2  0 1");
    times(P, kappa);
    fmpz_poly_q_add(r, r, P);
    add_ratio(r, (ratio){1, 4});
}

/* y'' = (2 q cos 2t - a) y with x = cos(t)^2:  sigma = 4 x (1 - x), P = sigma'/(2 sigma), Q = (a - 2 q (2 x - 1))/sigma. */
static void mathieu(long a, long q)
{
    fmpz_poly_q_t sigma;
    fmpz_poly_q_init(sigma);
    put_text(sigma, "3  0 4 -4");
    fmpz_poly_q_derivative(P, sigma);
    fmpz_poly_q_div(P, P, sigma);
    fmpz_poly_q_scalar_div_si(P, P, 2);
    put_text(Q, "2  0 1");
    times(Q, (ratio){-4 * q, 1});
    add_ratio(Q, (ratio){a + 2 * q, 1});
    fmpz_poly_q_div(Q, Q, sigma);
    of_second_order(r, P, Q);
    fmpz_poly_q_clear(sigma);
}

Test(kovacic, an_irregular_point_at_infinity)
{
    cr_expect(!expect_text(NH_GROUP_SL2, "2  0 1")->regular); /* Airy */
    expect_text(NH_GROUP_SL2, "4  0 0 0 1");
    expect_text(NH_GROUP_SL2, "5  0 0 0 0 1");
    expect_text(NH_GROUP_OPEN, "1  1");
    expect_text(NH_GROUP_OPEN, "1  -3/1  7");
    expect_text(NH_GROUP_OPEN, "5  2 4 3 2 1"); /* w^2 + w', w = x^2 + x + 1 */
    expect_text(NH_GROUP_SL2, "5  1 2 3 2 1");  /* w^2 */
    expect_text(NH_GROUP_OPEN, "5  0 4 0 0 1"); /* x exp(x^3/3) */
    expect_text(NH_GROUP_SL2, "5  0 3 0 0 1");
}

Test(kovacic, weber_is_elementary_where_it_is_known_to_be)
{
    for (long n = -3; n < 4; n++) {
        weber((ratio){2 * n + 1, 2});
        expect(NH_GROUP_OPEN, "a = n + 1/2");
        weber((ratio){3 * n + 1, 3});
        expect(NH_GROUP_SL2, "a = n + 1/3");
        weber((ratio){n, 1});
        expect(NH_GROUP_SL2, "a = n");
    }
}

Test(kovacic, bessel_and_whittaker)
{
    for (long n = 1; n < 9; n++) {
        bessel((ratio){2 * n - 1, 2});
        expect(NH_GROUP_OPEN, "Bessel, n + 1/2");
        bessel((ratio){3 * n + 1, 3});
        expect(NH_GROUP_SL2, "Bessel, n + 1/3");
        bessel((ratio){n, 4});
        expect(n % 4 == 2 ? NH_GROUP_OPEN : NH_GROUP_SL2, "Bessel, n/4");
    }
    whittaker((ratio){1, 3}, (ratio){1, 6});
    expect(NH_GROUP_OPEN, "Whittaker 1/3, 1/6");
    whittaker((ratio){-7, 3}, (ratio){1, 6});
    expect(NH_GROUP_OPEN, "Whittaker -7/3, 1/6");
    whittaker((ratio){1, 3}, (ratio){1, 3});
    expect(NH_GROUP_SL2, "Whittaker 1/3, 1/3");
    whittaker((ratio){1, 2}, (ratio){1, 3});
    expect(NH_GROUP_SL2, "Whittaker 1/2, 1/3");
}

Test(kovacic, mathieu)
{
    mathieu(1, 1);
    expect(NH_GROUP_SL2, "Mathieu 1, 1");
    mathieu(4, 3);
    expect(NH_GROUP_SL2, "Mathieu 4, 3");
    mathieu(2, 0);
    expect(NH_GROUP_OPEN, "Mathieu 2, 0");
}
