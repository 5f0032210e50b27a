/* Monodromy in balls: known exponents, a continuation in floating numbers, and what is proved of orbits. */
#include <criterion/criterion.h>
#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "absence/monodromy_internal.h"
#include "sweep.h"

/* ---- equations ---- */

typedef struct {
    fmpq_poly_t num, den;
} quotient;

static quotient of(const char *num, const char *den)
{
    quotient q;
    fmpq_poly_init(q.num);
    fmpq_poly_init(q.den);
    cr_assert_eq(fmpq_poly_set_str(q.num, num), 0, "%s", num);
    cr_assert_eq(fmpq_poly_set_str(q.den, den), 0, "%s", den);
    return q;
}

static void put(nh_linear_equation *e, size_t i, size_t j, quotient q)
{
    nh_linear_equation_set(e, i, j, q.num, q.den);
    fmpq_poly_clear(q.num);
    fmpq_poly_clear(q.den);
}

static void negate(quotient *q) { fmpq_poly_neg(q->num, q->num); }

/* (y, y') of y'' + p y' + q y = 0 */
static nh_linear_equation second_order(quotient p, quotient q)
{
    nh_linear_equation e;
    nh_linear_equation_init(&e, 2);
    negate(&p);
    negate(&q);
    put(&e, 0, 1, of("1  1", "1  1"));
    put(&e, 1, 0, q);
    put(&e, 1, 1, p);
    nh_linear_equation_reduce(&e);
    return e;
}

/* S'/(2 S) */
static quotient half_log_derivative(const fmpq_poly_t S)
{
    quotient q = of("0", "1  1");
    fmpq_poly_derivative(q.num, S);
    fmpq_poly_scalar_mul_ui(q.den, S, 2);
    return q;
}

/* Motions near x = 0 of (x^2 + B y^2)/2 + x^2 y + eps y^3 at the level h:  S = 2h - B y^2 - 2 eps y^3. */
static nh_linear_equation henon_heiles(const char *S)
{
    quotient q = of("2  1 2", S), p = half_log_derivative(q.den);
    return second_order(p, q);
}

/* Motions near the z-axis of (a1 x^2 + a2 y^2 + z^2)/2 + (c1 x^2 + c2 y^2 + 2 c3 xy) z - z^3/3 at the level 1/11. */
static const char level[] = "4  2/11 0 -1 2/3";
static nh_linear_equation block4(const char *k11, const char *k12, const char *k22)
{
    nh_linear_equation e;
    nh_linear_equation_init(&e, 4);
    const char *k[4] = {k11, k12, k12, k22};
    for (size_t i = 0; i < 2; i++) {
        put(&e, i, 2 + i, of("1  1", "1  1"));
        for (size_t j = 0; j < 2; j++) {
            quotient q = of(k[2 * i + j], level);
            negate(&q);
            put(&e, 2 + i, j, q);
        }
        quotient s = of("0", level), p = half_log_derivative(s.den);
        negate(&p);
        put(&e, 2 + i, 2 + i, p);
        fmpq_poly_clear(s.num);
        fmpq_poly_clear(s.den);
    }
    nh_linear_equation_reduce(&e);
    return e;
}


/* A(x) = residue/(x - c) + ..: one more term. */
static void add_residue(nh_linear_equation *e, const long *residue, long c)
{
    fmpz_poly_t linear, old;
    fmpz_poly_init(linear);
    fmpz_poly_init(old);
    fmpz_poly_set_coeff_si(linear, 1, 1);
    fmpz_poly_set_coeff_si(linear, 0, -c);
    for (size_t k = 0; k < e->size * e->size; k++) {
        fmpz_poly_scalar_mul_si(old, e->den, residue[k]);
        fmpz_poly_mul(e->num + k, e->num + k, linear);
        fmpz_poly_add(e->num + k, e->num + k, old);
    }
    fmpz_poly_mul(e->den, e->den, linear);
    fmpz_poly_clear(linear);
    fmpz_poly_clear(old);
}

static nh_linear_equation first_order(const char *num, const char *den)
{
    nh_linear_equation e;
    nh_linear_equation_init(&e, 1);
    put(&e, 0, 0, of(num, den));
    nh_linear_equation_reduce(&e);
    return e;
}

/* ---- what is expected ---- */

/* The answer's numbers; the equations are cleared, the obstacle is copied. */
typedef struct {
    size_t rank, size, words;
    long bits;
    char obstacle[200];
} answer;

static answer answer_of(const nh_monodromy *m, nh_arena *arena, size_t blocks, nh_linear_equation *block)
{
    answer a = {.rank = m->rank, .size = m->size, .words = m->words, .bits = m->bits};
    cr_expect_eq(!m->obstacle, m->rank == m->size);
    snprintf(a.obstacle, sizeof a.obstacle, "%s", m->obstacle ? m->obstacle : "");
    nh_arena_free(arena);
    for (size_t b = 0; b < blocks; b++) nh_linear_equation_clear(block + b);
    return a;
}

static answer try(size_t blocks, nh_linear_equation *block)
{
    nh_arena *arena = nh_arena_create();
    return answer_of(nh_monodromy_try(arena, blocks, block), arena, blocks, block);
}

static answer at_bits(size_t blocks, nh_linear_equation *block, long bits)
{
    nh_arena *arena = nh_arena_create();
    return answer_of(nh_monodromy_of(arena, blocks, block, bits), arena, blocks, block);
}

/* The printed ball contains the sum of exp(2 pi i rho), and says so with many digits. */
static void contains(const char *text, size_t exponents, const char *const *rho)
{
    char re[200], im[200];
    const char *plus = strstr(text, " + ");
    cr_assert(plus && strlen(text) < sizeof re, "%s", text);
    snprintf(re, sizeof re, "%.*s", (int)(plus - text), text);
    snprintf(im, sizeof im, "%.*s", (int)strlen(plus) - 5, plus + 3);
    acb_t ball, sum, term;
    fmpq_t q;
    acb_init(ball);
    acb_init(sum);
    acb_init(term);
    fmpq_init(q);
    cr_assert_eq(arb_set_str(acb_realref(ball), re, 300), 0, "%s", re);
    cr_assert_eq(arb_set_str(acb_imagref(ball), im, 300), 0, "%s", im);
    for (size_t k = 0; k < exponents; k++) {
        cr_assert_eq(fmpq_set_str(q, rho[k], 10), 0);
        fmpq_mul_2exp(q, q, 1);
        arb_sin_cos_pi_fmpq(acb_imagref(term), acb_realref(term), q, 300);
        acb_add(sum, sum, term, 300);
    }
    cr_expect(acb_overlaps(ball, sum), "%s", text);
    cr_expect(mag_cmp_2exp_si(arb_radref(acb_realref(ball)), -60) < 0, "%s", text);
    fmpq_clear(q);
    acb_clear(ball);
    acb_clear(sum);
    acb_clear(term);
}

/* ---- one step ---- */

/* y' = y/(3 x) from 1 to 3/2 + i: the cube root; and a rotation by a complex angle. */
Test(monodromy, line)
{
    nh_linear_equation e[2] = {first_order("1  1/3", "2  0 1")};
    nh_linear_equation_init(e + 1, 2);
    put(e + 1, 0, 1, of("1  1", "1  1"));
    put(e + 1, 1, 0, of("1  -1", "1  1"));
    for (long bits = 64; bits <= 1024; bits *= 4) {
        nh_monodromy_sum sum;
        cr_assert(nh_monodromy_sum_init(&sum, 2, e, bits));
        acb_t z, h, exact, c;
        acb_mat_t T, R;
        acb_init(z);
        acb_init(h);
        acb_init(exact);
        acb_init(c);
        acb_mat_init(T, 1, 1);
        acb_mat_init(R, 2, 2);
        acb_one(z);
        acb_set_d_d(h, 0.5, 1);
        cr_assert(nh_monodromy_line(&sum, 0, z, h, T));
        acb_add(exact, z, h, 2 * bits);
        acb_root_ui(exact, exact, 3, 2 * bits);
        cr_expect(acb_contains(acb_mat_entry(T, 0, 0), exact), "%ld bits", bits);
        cr_expect(acb_rel_accuracy_bits(acb_mat_entry(T, 0, 0)) > bits - 20, "%ld bits", bits);
        cr_assert(nh_monodromy_line(&sum, 1, z, h, R));
        acb_sin_cos(exact, c, h, 2 * bits);
        cr_expect(acb_contains(acb_mat_entry(R, 0, 0), c) && acb_contains(acb_mat_entry(R, 0, 1), exact));
        acb_neg(exact, exact);
        cr_expect(acb_contains(acb_mat_entry(R, 1, 1), c) && acb_contains(acb_mat_entry(R, 1, 0), exact));
        cr_expect(acb_rel_accuracy_bits(acb_mat_entry(R, 1, 0)) > bits - 20, "%ld bits", bits);
        acb_set_d_d(h, -3, 0); /* through the singular point */
        cr_expect_not(nh_monodromy_line(&sum, 0, z, h, T));
        acb_clear(z);
        acb_clear(h);
        acb_clear(exact);
        acb_clear(c);
        acb_mat_clear(T);
        acb_mat_clear(R);
        nh_monodromy_sum_clear(&sum);
    }
    nh_linear_equation_clear(e);
    nh_linear_equation_clear(e + 1);
}

/* Large coefficients: y' = 10^4 y over a step of length 1 is done in parts. */
Test(monodromy, strong)
{
    nh_linear_equation e = first_order("1  10000", "1  1");
    nh_monodromy_sum sum;
    cr_assert(nh_monodromy_sum_init(&sum, 1, &e, 256));
    acb_t z, h;
    acb_mat_t T;
    acb_init(z);
    acb_init(h);
    acb_mat_init(T, 1, 1);
    acb_one(h);
    cr_assert(nh_monodromy_line(&sum, 0, z, h, T));
    cr_expect_gt(sum.steps, 100);
    acb_set_ui(h, 10000);
    acb_exp(h, h, 512);
    cr_expect(acb_overlaps(acb_mat_entry(T, 0, 0), h));
    cr_expect(acb_rel_accuracy_bits(acb_mat_entry(T, 0, 0)) > 200);
    acb_one(h);
    sum.limit = sum.work + 1000;
    cr_expect_not(nh_monodromy_line(&sum, 0, z, h, T), "work has a limit");
    acb_clear(z);
    acb_clear(h);
    acb_mat_clear(T);
    nh_monodromy_sum_clear(&sum);
    nh_linear_equation_clear(&e);
}

/* ---- local exponents ---- */

/* Gauss: exponents 0, 1 - c at 0; 0, c - a - b at 1; a, b at infinity. */
Test(monodromy, hypergeometric)
{
    /* a = 1/3, b = 1/5, c = 1/7:  x (1 - x) y'' + (c - (a + b + 1) x) y' - a b y = 0 */
    nh_linear_equation e = second_order(of("2  1/7 -23/15", "3  0 1 -1"), of("1  -1/15", "3  0 1 -1"));
    nh_arena *arena = nh_arena_create();
    nh_monodromy *m = nh_monodromy_of(arena, 1, &e, 256);
    cr_assert_eq(m->singular, 2);
    bool zero_first = false;
    nh_monodromy_sum sum;
    cr_assert(nh_monodromy_sum_init(&sum, 1, &e, 256));
    zero_first = acb_is_zero(sum.point);
    contains(m->trace[!zero_first], 2, (const char *[]){"0", "6/7"});
    contains(m->trace[zero_first], 2, (const char *[]){"0", "-41/105"});
    nh_monodromy_element loop[2];
    for (size_t i = 0; i < 2; i++) {
        loop[i] = nh_monodromy_element_new(&sum);
        cr_assert(nh_monodromy_loop(&sum, i, loop[i]));
    }
    acb_mat_mul(loop[0], loop[0], loop[1], 256); /* around both, the wrong way around infinity */
    acb_t trace;
    acb_init(trace);
    acb_mat_trace(trace, loop[0], 256);
    char *re = arb_get_str(acb_realref(trace), 20, 0), *im = arb_get_str(acb_imagref(trace), 20, 0), text[200];
    snprintf(text, sizeof text, "%s + %s i", re, im);
    contains(text, 2, (const char *[]){"-1/3", "-1/5"});
    flint_free(re);
    flint_free(im);
    acb_clear(trace);
    for (size_t i = 0; i < 2; i++) nh_monodromy_element_free(&sum, loop[i]);
    nh_monodromy_sum_clear(&sum);
    nh_linear_equation_clear(&e);
    nh_arena_free(arena);
}

/* Bessel: regular at 0, irregular at infinity; nu = 1/5. */
Test(monodromy, bessel)
{
    nh_linear_equation e = second_order(of("1  1", "2  0 1"), of("3  -1/25 0 1", "3  0 0 1"));
    nh_arena *arena = nh_arena_create();
    nh_monodromy *m = nh_monodromy_of(arena, 1, &e, 256);
    cr_assert_eq(m->singular, 1);
    contains(m->trace[0], 2, (const char *[]){"1/5", "-1/5"});
    cr_expect_eq(m->rank, 0);
    cr_expect_str_eq(m->obstacle, "every multiplier found has absolute value 1");
    nh_linear_equation_clear(&e);
    nh_arena_free(arena);
}

/* Three unknowns: residues with the eigenvalues 1, 2, 3 over 7 in other bases. */
Test(monodromy, residues)
{
    static const long residue[3][9] = {
        {1, 5, -2, 0, 2, 1, 0, 0, 3}, {3, 0, 0, 1, 1, 0, -4, 2, 2}, {2, -1, -1, 0, 1, 0, 0, 4, 3}};
    nh_linear_equation e;
    nh_linear_equation_init(&e, 3);
    for (int k = 0; k < 3; k++) add_residue(&e, residue[k], (k * k * 3 + k) % 11 - 4);
    fmpz_poly_scalar_mul_si(e.den, e.den, 7);
    nh_linear_equation_reduce(&e);
    nh_arena *arena = nh_arena_create();
    nh_monodromy *m = nh_monodromy_of(arena, 1, &e, 256);
    cr_assert_eq(m->singular, 3);
    for (size_t i = 0; i < 3; i++) contains(m->trace[i], 3, (const char *[]){"1/7", "2/7", "3/7"});
    cr_expect_eq(m->rank, 3, "%s", m->obstacle);
    nh_linear_equation_clear(&e);
    nh_arena_free(arena);
}

/* ---- the same loops in floating numbers ---- */

static double complex value(const fmpz_poly_struct *p, double complex x)
{
    double complex v = 0;
    for (slong k = fmpz_poly_degree(p); k >= 0; k--) {
        fmpz_t c;
        fmpz_init(c);
        fmpz_poly_get_coeff_fmpz(c, p, k);
        v = v * x + fmpz_get_d(c);
        fmpz_clear(c);
    }
    return v;
}

enum { most = 4, pieces = 256 };

static void slope(const nh_linear_equation *e, double complex x, double complex h, const double complex *y,
                  double complex *out)
{
    size_t n = e->size;
    double complex a[most * most], d = value(e->den, x);
    for (size_t k = 0; k < n * n; k++) a[k] = h * value(e->num + k, x) / d;
    for (size_t i = 0; i < n * n; i++) {
        out[i] = 0;
        for (size_t k = 0; k < n; k++) out[i] += a[i / n * n + k] * y[k * n + i % n];
    }
}

/* The classical method of Runge and Kutta from a to b. */
static void runge_kutta(const nh_linear_equation *e, double complex a, double complex b, double complex *y)
{
    double complex h = (b - a) / pieces, k[4][most * most], t[most * most];
    size_t n = e->size * e->size;
    for (int s = 0; s < pieces; s++) {
        double complex x = a + s * h;
        slope(e, x, h, y, k[0]);
        for (size_t i = 0; i < n; i++) t[i] = y[i] + k[0][i] / 2;
        slope(e, x + h / 2, h, t, k[1]);
        for (size_t i = 0; i < n; i++) t[i] = y[i] + k[1][i] / 2;
        slope(e, x + h / 2, h, t, k[2]);
        for (size_t i = 0; i < n; i++) t[i] = y[i] + k[2][i];
        slope(e, x + h, h, t, k[3]);
        for (size_t i = 0; i < n; i++) y[i] += (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]) / 6;
    }
}

static double complex floating(const acb_t z)
{
    return arf_get_d(arb_midref(acb_realref(z)), ARF_RND_NEAR) +
           I * arf_get_d(arb_midref(acb_imagref(z)), ARF_RND_NEAR);
}

static void floating_path(const nh_linear_equation *e, const nh_monodromy_path *path, double complex *y)
{
    for (size_t i = 0; i < e->size * e->size; i++) y[i] = i % (e->size + 1) == 0;
    for (size_t k = 1; k < path->count; k++)
        runge_kutta(e, floating(path->vertex + k - 1), floating(path->vertex + k), y);
}

/* loop go^-1.. : the loop satisfies go loop = around go. */
static void same_loops(nh_linear_equation *e)
{
    nh_monodromy_sum sum;
    cr_assert(nh_monodromy_sum_init(&sum, 1, e, 256));
    for (size_t i = 0; i < sum.points; i++) {
        nh_monodromy_element loop = nh_monodromy_element_new(&sum);
        cr_assert(nh_monodromy_loop(&sum, i, loop));
        nh_monodromy_path go = {0}, around = {0};
        cr_assert(nh_monodromy_paths(&sum, i, &go, &around));
        cr_expect(acb_equal(around.vertex, around.vertex + around.count - 1), "the path is closed, exactly");
        double complex there[most * most], circle[most * most];
        floating_path(e, &go, there);
        floating_path(e, &around, circle);
        size_t n = e->size;
        for (size_t r = 0; r < n; r++)
            for (size_t c = 0; c < n; c++) {
                double complex left = 0, right = 0;
                double scale = 1;
                for (size_t k = 0; k < n; k++) {
                    double complex g = floating(acb_mat_entry(loop, (slong)k, (slong)c));
                    left += there[r * n + k] * g;
                    right += circle[r * n + k] * there[k * n + c];
                    scale += cabs(there[r * n + k] * g);
                }
                cr_expect_lt(cabs(left - right), 1e-8 * scale, "point %zu, entry %zu %zu", i, r, c);
            }
        double complex trace = 0;
        for (size_t r = 0; r < n; r++) trace += circle[r * n + r];
        acb_t exact;
        acb_init(exact);
        acb_mat_trace(exact, loop, 256);
        cr_expect_lt(cabs(trace - floating(exact)), 1e-8 * (1 + cabs(trace)), "point %zu", i);
        acb_clear(exact);
        nh_monodromy_path_clear(&go);
        nh_monodromy_path_clear(&around);
        nh_monodromy_element_free(&sum, loop);
    }
    nh_monodromy_sum_clear(&sum);
    nh_linear_equation_clear(e);
}

static const char classical[] = "4  2/7 0 -1 2/3", kdv[] = "4  2/7 0 -1 -4";

Test(monodromy, floating)
{
    nh_linear_equation e = henon_heiles(classical);
    same_loops(&e);
    e = block4("2  1 2", "2  0 3", "2  2 4");
    same_loops(&e);
    e = second_order(of("3  1 5 2", "5  2 1 0 -3 4"), of("3  7 -1 2", "6  1 3 1 -1 0 2"));
    same_loops(&e);
    e = second_order(of("1  1", "2  0 1"), of("3  1 2 1", "5  0 0 0 0 1")); /* irregular at 0 */
    same_loops(&e);
}

/* Balls of few bits contain what balls of many bits say: remainders and roundings are bounded. */
static void nested(nh_linear_equation *e)
{
    nh_monodromy_sum fine, coarse;
    cr_assert(nh_monodromy_sum_init(&fine, 1, e, 256));
    acb_t exact, trace;
    acb_init(exact);
    acb_init(trace);
    for (size_t i = 0; i < fine.points; i++) {
        nh_monodromy_element loop = nh_monodromy_element_new(&fine);
        cr_assert(nh_monodromy_loop(&fine, i, loop));
        acb_mat_trace(exact, loop, 256);
        cr_expect(mag_cmp_2exp_si(arb_radref(acb_realref(exact)), -150) < 0);
        nh_monodromy_element_free(&fine, loop);
        for (long bits = 40; bits <= 120; bits += 80) {
            cr_assert(nh_monodromy_sum_init(&coarse, 1, e, bits));
            loop = nh_monodromy_element_new(&coarse);
            if (nh_monodromy_loop(&coarse, i, loop)) {
                acb_mat_trace(trace, loop, bits);
                cr_expect(acb_overlaps(trace, exact), "point %zu, %ld bits", i, bits);
                cr_expect(bits < 100 || mag_cmp_2exp_si(arb_radref(acb_realref(trace)), -20) < 0);
            }
            nh_monodromy_element_free(&coarse, loop);
            nh_monodromy_sum_clear(&coarse);
        }
    }
    acb_clear(exact);
    acb_clear(trace);
    nh_monodromy_sum_clear(&fine);
    nh_linear_equation_clear(e);
}

Test(monodromy, nested)
{
    nh_linear_equation e = henon_heiles(classical);
    nested(&e);
    e = second_order(of("3  1 5 2", "5  2 1 0 -3 4"), of("3  7 -1 2", "6  1 3 1 -1 0 2"));
    if (sweep_whole()) nested(&e);
    else nh_linear_equation_clear(&e);
    e = second_order(of("1  1", "2  0 1"), of("3  1 2 1", "5  0 0 0 0 1"));
    nested(&e);
}

/* ---- ranks ---- */

Test(monodromy, henon_heiles)
{
    /* S at the level 1/7, and what is proved: everything, or what an integrable system leaves */
    static const struct {
        const char *name, *S;
        size_t rank;
    } row[] = {{"classical", classical, 2},
               {"(1,1)", "4  2/7 0 -1 -2", 2},
               {"(1,16/3)", "4  2/7 0 -1 -32/3", 2},
               {"KdV (1,2)", kdv, 1},
               {"SK (1,1/3)", "4  2/7 0 -1 -2/3", 0},
               {"KK (16,16/3)", "4  2/7 0 -16 -32/3", 0}};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        nh_linear_equation e = henon_heiles(row[k].S);
        answer a = try(1, &e);
        cr_expect_eq(a.rank, row[k].rank, "%s: %zu, %s", row[k].name, a.rank, a.obstacle);
        cr_expect_eq(a.bits, 256, "%s: more bits cannot help", row[k].name);
    }
}

/* P and Q of y'' + P y' + Q y = 0 for motions near others, in the moving coordinate or in the tangent of half of an
 * angle; "open": an integrable system, or one about which the first order says nothing. */
Test(monodromy, systems)
{
    static const struct {
        const char *name, *p, *p_den, *q, *q_den;
        size_t rank;
    } row[] = {
        {"swinging Atwood machine, 2", "2  -2 5", "3  0 -1 2", "1  -3", "3  0 -1 2", 2},
        {"swinging Atwood machine, 8/3", "2  -6 25", "3  0 -3 10", "1  -11", "3  0 -3 10", 2},
        {"swinging Atwood machine, 3, open", "2  -2 10", "3  0 -1 4", "1  -4", "3  0 -1 4", 0},
        {"swinging Atwood machine, 5", "2  -2 20", "3  0 -1 8", "1  -6", "3  0 -1 8", 2},
        {"spring pendulum", "2  -5 3", "3  -5 -10 3", "2  3 -3", "4  0 -5 -10 3", 2},
        {"top of Kovalevskaya, open", "0", "1  1", "5  27 -48 234 -48 27", "9  4 -48 160 -144 312 -144 160 -48 4", 1},
        {"top of Goryachev and Chaplygin, open", "0", "1  1", "1  6", "5  1 -12 38 -12 1", 0},
        {"top 3 3 1", "0", "1  1", "5  223 -120 914 -120 223", "9  36 -432 1440 -1296 2808 -1296 1440 -432 36", 2},
        {"top 5 5 2", "0", "1  1", "5  639 -648 3762 -648 639", "9  100 -1200 4000 -3600 7800 -3600 4000 -1200 100", 2},
        {"Suslov 1:1, open", "4  0 1 0 4", "5  -1 0 1 0 2", "3  -3 0 3", "7  -1 0 0 0 3 0 2", 0},
        {"Suslov 2:1", "4  0 1 0 4", "5  -1 0 1 0 2", "3  -3 0 3", "7  -2 0 0 0 6 0 4", 2},
        {"Suslov 1:2", "4  0 1 0 4", "5  -1 0 1 0 2", "3  -6 0 6", "7  -1 0 0 0 3 0 2", 2}};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        if (!sweep_tries(k, 7, 12)) continue;
        nh_linear_equation e = second_order(of(row[k].p, row[k].p_den), of(row[k].q, row[k].q_den));
        answer a = try(1, &e);
        cr_expect_eq(a.rank, row[k].rank, "%s: %zu, %s", row[k].name, a.rank, a.obstacle);
    }
}

/* At infinity the exponents solve rho^2 + rho/2 = 1/eps = -3, and exp(2 pi i rho) add up to -2 i cosh(pi sqrt(47)/2):
 * the loops around all points, one after another as they are seen from the base. */
Test(monodromy, infinity)
{
    nh_linear_equation e = henon_heiles(classical);
    nh_monodromy_sum sum;
    cr_assert(nh_monodromy_sum_init(&sum, 1, &e, 256));
    cr_assert_eq(sum.points, 3);
    acb_t base;
    acb_init(base);
    nh_monodromy_base(&sum, base);
    nh_monodromy_element loop[3];
    double angle[3];
    size_t order[3] = {0, 1, 2};
    for (size_t i = 0; i < 3; i++) {
        loop[i] = nh_monodromy_element_new(&sum);
        cr_assert(nh_monodromy_loop(&sum, i, loop[i]));
        angle[i] = carg(floating(sum.point + i) - floating(base));
    }
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k + 1 < 3; k++)
            if (angle[order[k]] > angle[order[k + 1]]) {
                size_t t = order[k];
                order[k] = order[k + 1];
                order[k + 1] = t;
            }
    for (int way = 0; way < 2; way++) {
        acb_mat_t all;
        acb_t trace, sum_of, pi;
        acb_init(sum_of);
        acb_init(pi);
        acb_mat_init(all, 2, 2);
        acb_init(trace);
        acb_mat_one(all);
        for (size_t k = 0; k < 3; k++) acb_mat_mul(all, loop[order[way ? 2 - k : k]], all, 256);
        acb_mat_trace(trace, all, 256);
        acb_set_ui(sum_of, 47);
        acb_sqrt(sum_of, sum_of, 300);
        acb_const_pi(pi, 300);
        acb_mul(sum_of, sum_of, pi, 300);
        acb_mul_2exp_si(sum_of, sum_of, -1);
        acb_cosh(sum_of, sum_of, 300);
        acb_mul_2exp_si(sum_of, sum_of, 1);
        acb_div_onei(sum_of, sum_of);
        cr_expect_eq(acb_overlaps(trace, sum_of), way == 0);
        cr_expect(acb_rel_accuracy_bits(trace) > 150);
        acb_clear(trace);
        acb_clear(sum_of);
        acb_clear(pi);
        acb_mat_clear(all);
    }
    for (size_t i = 0; i < 3; i++) nh_monodromy_element_free(&sum, loop[i]);
    acb_clear(base);
    nh_monodromy_sum_clear(&sum);
    nh_linear_equation_clear(&e);
}

/* An integrable system: never more than 1, whatever the bits and the level. */
Test(monodromy, integrable)
{
    for (long bits = 32; bits <= 1024; bits *= 2) {
        if (bits > 512 && !sweep_whole()) continue;
        nh_linear_equation e = henon_heiles(kdv);
        cr_expect_leq(at_bits(1, &e, bits).rank, 1, "%ld bits", bits);
    }
    for (int level_number = 1; level_number < 60; level_number++) {
        if (!sweep_tries((size_t)level_number, 19, 29)) continue;
        char S[60];
        snprintf(S, sizeof S, "4  2/%d 0 -%d -4", 3 + level_number, 1 + level_number % 5);
        nh_linear_equation e = henon_heiles(S);
        cr_expect_leq(at_bits(1, &e, 256).rank, 1, "%s", S);
    }
}

Test(monodromy, three_degrees_of_freedom)
{
    nh_linear_equation e = block4("2  1 2", "2  0 3", "2  2 4");
    answer a = try(1, &e);
    cr_expect_eq(a.rank, 4, "%s", a.obstacle);
    e = block4("2  1 1", "2  0 2/5", "2  3 2");
    a = try(1, &e);
    cr_expect_eq(a.rank, 4, "%s", a.obstacle);
}

/* Two equal blocks with SL(2): x_1 y_2 - x_2 y_1 is an integral, so 3 and not 4. */
Test(monodromy, equal_blocks)
{
    for (long bits = 96; bits <= 192; bits *= 2) {
        nh_linear_equation e[2] = {henon_heiles(level), henon_heiles(level)};
        answer a = at_bits(2, e, bits);
        cr_expect_eq(a.rank, 3, "%zu, %s", a.rank, a.obstacle);
    }
    nh_linear_equation e[2] = {henon_heiles(level), henon_heiles(level)};
    answer a = try(2, e);
    cr_expect_eq(a.bits, 256);
    cr_expect_str_eq(a.obstacle, "the elements found move a general vector in 3 of 4 dimensions");
    /* together, the eigenvalues are not simple */
    *e = block4("2  1 2", "0", "2  1 2");
    a = try(1, e);
    cr_expect_eq(a.rank, 0);
    cr_expect_str_eq(a.obstacle, "eigenvalues were not separated with 256 bits");
}

Test(monodromy, sums)
{
    nh_linear_equation e[3] = {henon_heiles(classical), henon_heiles("4  2/7 0 -1 -2")};
    cr_expect_eq(try(2, e).rank, 4, "different blocks are independent");
    /* |mu| is exp(pi) around i, and its square: one torus of dimension 1 */
    e[0] = first_order("1  1", "3  1 0 1");
    cr_expect_eq(try(1, e).rank, 1);
    e[0] = first_order("1  1", "3  1 0 1");
    e[1] = first_order("1  2", "3  1 0 1");
    cr_expect_eq(try(2, e).rank, 1);
    /* other points: independent */
    e[0] = first_order("1  1", "3  1 0 1");
    e[1] = first_order("1  1", "3  2 0 1");
    cr_expect_eq(try(2, e).rank, 2);
    /* SL(2) and a torus, and what never moves */
    e[0] = henon_heiles(classical);
    e[1] = first_order("1  1", "3  1 0 1");
    cr_expect_eq(try(2, e).rank, 3);
    e[0] = henon_heiles(classical);
    e[1] = second_order(of("0", "1  1"), of("0", "1  1"));
    e[2] = first_order("1  1", "3  1 0 1");
    answer a = try(3, e);
    cr_expect_eq(a.rank, 3, "%zu of %zu: the second block is left out", a.rank, a.size);
}

/* Rotations have orbits of dimension 2, and skew-symmetric coefficients give rotations. */
Test(monodromy, rotations)
{
    static const long residue[3][9] = {
        {0, 1, 2, -1, 0, -1, -2, 1, 0}, {0, -2, 1, 2, 0, 3, -1, -3, 0}, {0, 1, -1, -1, 0, 1, 1, -1, 0}};
    nh_linear_equation e;
    nh_linear_equation_init(&e, 3);
    for (int k = 0; k < 3; k++) add_residue(&e, residue[k], k * k + k);
    fmpz_poly_scalar_mul_si(e.den, e.den, 5);
    nh_linear_equation_reduce(&e);
    answer a = try(1, &e);
    cr_expect_eq(a.rank, 2, "%zu, %s", a.rank, a.obstacle);
}

/* ---- what cannot be decided ---- */

Test(monodromy, nothing)
{
    nh_linear_equation e;
    nh_linear_equation_init(&e, 2);
    put(&e, 0, 1, of("2  1 3", "1  1"));
    put(&e, 1, 0, of("1  -5", "1  1"));
    answer a = try(1, &e);
    cr_expect_eq(a.rank, 0);
    cr_expect_str_eq(a.obstacle, "there is no singular point: every closed path gives the identity");
    cr_expect_eq(try(0, &e).size, 0);
    /* residues +-1/(2 sqrt 2): no root of unity, but of absolute value 1 */
    e = first_order("1  1", "3  -2 0 1");
    a = try(1, &e);
    cr_expect_eq(a.rank, 0);
    cr_expect_str_eq(a.obstacle, "every multiplier found has absolute value 1");
    e = first_order("1  -1", "3  0 0 1"); /* exp(1/x), irregular */
    cr_expect_eq(try(1, &e).rank, 0);
    e = second_order(of("0", "1  1"), of("1  -1", "5  0 0 0 0 1")); /* x exp(+-1/x) */
    a = try(1, &e);
    cr_expect_eq(a.rank, 0);
    cr_expect_str_eq(a.obstacle, "eigenvalues were not separated with 256 bits");
    e = second_order(of("1  1", "2  0 1"), of("0", "1  1")); /* 1 and log x: unipotent */
    cr_expect_eq(try(1, &e).rank, 0);
}

/* Singular points at 0, 10^-30 and 1, and Henon-Heiles among them. */
Test(monodromy, near_points)
{
    nh_linear_equation e[2] = {
        first_order("1  1", "3  0 -1 1000000000000000000000000000000"), henon_heiles(classical)};
    nh_arena *arena = nh_arena_create();
    nh_monodromy *m = nh_monodromy_of(arena, 2, e, 256);
    cr_assert_eq(m->singular, 5);
    cr_expect_eq(m->rank, 2, "%s", m->obstacle); /* exponents 1 and -1 */
    nh_arena_free(arena);
    nh_linear_equation_clear(e);
    nh_linear_equation_clear(e + 1);
    /* 10^-200 from 1: more bits are needed than there are */
    fmpz_t far;
    fmpz_init(far);
    fmpz_set_ui(far, 10);
    fmpz_pow_ui(far, far, 400);
    nh_linear_equation_init(e, 1);
    fmpz_poly_set_coeff_fmpz(e->den, 2, far);
    fmpz_mul_si(far, far, -2);
    fmpz_poly_set_coeff_fmpz(e->den, 1, far);
    fmpz_divexact_si(far, far, -2);
    fmpz_sub_ui(far, far, 1);
    fmpz_poly_set_coeff_fmpz(e->den, 0, far);
    fmpz_poly_set_coeff_ui(e->num, 0, 1);
    arena = nh_arena_create();
    m = nh_monodromy_of(arena, 1, e, 256);
    cr_expect_eq(m->rank, 0);
    cr_expect(m->obstacle && strstr(m->obstacle, "singular points"), "%s", m->obstacle);
    nh_arena_free(arena);
    fmpz_clear(far);
    nh_linear_equation_clear(e);
}
