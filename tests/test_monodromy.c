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

#include <time.h>
static void show(const char *name, size_t blocks, nh_linear_equation *e)
{
    nh_arena *arena = nh_arena_create();
    clock_t t0 = clock();
    nh_monodromy *m = nh_monodromy_try(arena, blocks, e);
    printf("%-12s %zu of %zu, %ld bits, %zu points, %zu steps, %zu words, %.3f s: %s\n", name, m->rank, m->size, m->bits, m->singular, m->steps, m->words,
           (double)(clock() - t0) / CLOCKS_PER_SEC, m->obstacle ? m->obstacle : "");
    for (size_t i = 0; m->trace && i < m->singular * blocks; i++) printf("    %s\n", m->trace[i]);
    for (size_t b = 0; b < blocks; b++) nh_linear_equation_clear(e + b);
    nh_arena_free(arena);
}

Test(monodromy, bench)
{
    const char *name[] = {"classical", "1,1", "1,16/3", "kdv", "sk", "kk"};
    const char *S[] = {"4  2/7 0 -1 2/3", "4  2/7 0 -1 -2", "4  2/7 0 -1 -32/3", "4  2/7 0 -1 -4", "4  2/7 0 -1 -2/3", "4  2/7 0 -16 -32/3"};
    for (int i = 0; i < 6; i++) {
        nh_linear_equation e = henon_heiles(S[i]);
        show(name[i], 1, &e);
    }
    nh_linear_equation e = block4("2  1 2", "2  0 3", "2  2 4");
    show("block4", 1, &e);
    e = block4("2  1 1", "2  0 2/5", "2  3 2");
    show("block4b", 1, &e);
    e = block4("2  1 2", "0", "2  1 2");
    show("repeated", 1, &e);
    nh_linear_equation two[2];
    for (int k = 0; k < 2; k++) two[k] = henon_heiles(level);
    show("two", 2, two);
}
