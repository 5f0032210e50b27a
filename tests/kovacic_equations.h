/* kovacic_equations: equations y'' = r y for the tests of Kovacic's algorithm, by formulas over Q(x). */
#ifndef NH_TESTS_KOVACIC_EQUATIONS_H
#define NH_TESTS_KOVACIC_EQUATIONS_H

#include <flint/fmpq.h>
#include <flint/fmpz_poly_q.h>
#include <stdint.h>

/* A rational number as two small ones. */
typedef struct {
    long n, d;
} ratio;

/* "2  1 3" is 1 + 3 x: the coefficients' number, two blanks, the coefficients; a quotient has "/". */
static inline void put_text(fmpz_poly_q_t f, const char *text) { fmpz_poly_q_set_str(f, text); }

static inline void add_ratio(fmpz_poly_q_t f, ratio c)
{
    fmpz_poly_q_t number;
    fmpz_poly_q_init(number);
    fmpz_poly_q_one(number);
    fmpz_poly_q_scalar_mul_si(number, number, c.n);
    fmpz_poly_q_scalar_div_si(number, number, c.d);
    fmpz_poly_q_add(f, f, number);
    fmpz_poly_q_clear(number);
}

static inline void put_ratio(fmpz_poly_q_t f, ratio c)
{
    fmpz_poly_q_zero(f);
    add_ratio(f, c);
}

static inline void times(fmpz_poly_q_t f, ratio c)
{
    fmpz_poly_q_scalar_mul_si(f, f, c.n);
    fmpz_poly_q_scalar_div_si(f, f, c.d);
}

/* c/(x - a) */
static inline void put_pole(fmpz_poly_q_t f, ratio c, long a)
{
    fmpz_poly_q_t one;
    fmpz_poly_q_init(one);
    put_text(f, "2  0 1");
    add_ratio(f, (ratio){-a, 1});
    put_ratio(one, c);
    fmpz_poly_q_div(f, one, f);
    fmpz_poly_q_clear(one);
}

/* r = w' + w^2, of the solution exp(int w). */
static inline void of_solution(fmpz_poly_q_t r, const fmpz_poly_q_t w)
{
    fmpz_poly_q_t square;
    fmpz_poly_q_init(square);
    fmpz_poly_q_mul(square, w, w);
    fmpz_poly_q_derivative(r, w);
    fmpz_poly_q_add(r, r, square);
    fmpz_poly_q_clear(square);
}

/* r = P^2/4 + P'/2 - Q, of y'' + P y' + Q y = 0. */
static inline void of_second_order(fmpz_poly_q_t r, const fmpz_poly_q_t P, const fmpz_poly_q_t Q)
{
    fmpz_poly_q_t half;
    fmpz_poly_q_init(half);
    fmpz_poly_q_scalar_div_si(half, P, 2);
    of_solution(r, half);
    fmpz_poly_q_sub(r, r, Q);
    fmpz_poly_q_clear(half);
}

/* The hypergeometric equation with the squares s of its exponent differences at 0, 1 and infinity. */
static inline void hypergeometric(fmpz_poly_q_t r, const ratio s[3])
{
    fmpz_poly_q_t term, number;
    fmpz_poly_q_init(term);
    fmpz_poly_q_init(number);
    put_text(r, "1  1/3  0 0 4"); /* 1/(4 x^2) */
    put_ratio(number, (ratio){s[0].d - s[0].n, s[0].d});
    fmpz_poly_q_mul(r, r, number);
    put_text(term, "1  1/3  4 -8 4");
    put_ratio(number, (ratio){s[1].d - s[1].n, s[1].d});
    fmpz_poly_q_mul(term, term, number);
    fmpz_poly_q_add(r, r, term);
    put_text(term, "1  1/3  0 4 -4");
    put_ratio(number, (ratio){s[0].d - s[0].n, s[0].d});
    add_ratio(number, (ratio){-s[1].n, s[1].d});
    add_ratio(number, s[2]);
    fmpz_poly_q_mul(term, term, number);
    fmpz_poly_q_add(r, r, term);
    fmpz_poly_q_neg(r, r);
    fmpz_poly_q_clear(number);
    fmpz_poly_q_clear(term);
}

/* The polynomial f at the rational function g. */
static inline void polynomial_at(fmpz_poly_q_t out, const fmpz_poly_t f, const fmpz_poly_q_t g)
{
    fmpz_poly_q_t coefficient;
    fmpz_poly_q_init(coefficient);
    fmpz_poly_q_zero(out);
    for (slong i = fmpz_poly_degree(f); i >= 0; i--) {
        fmpz_poly_q_mul(out, out, g);
        fmpz_poly_q_one(coefficient);
        fmpz_poly_scalar_mul_fmpz(fmpz_poly_q_numref(coefficient), fmpz_poly_q_numref(coefficient),
                                  fmpz_poly_get_coeff_ptr(f, i));
        if (!fmpz_is_zero(fmpz_poly_get_coeff_ptr(f, i))) fmpz_poly_q_add(out, out, coefficient);
    }
    fmpz_poly_q_clear(coefficient);
}

/* The normal form of the equation of y(f(x)):  r(f) f'^2 - (f'''/f' - 3/2 (f''/f')^2)/2. */
static inline void pull_back(fmpz_poly_q_t out, const fmpz_poly_q_t r, const fmpz_poly_q_t f)
{
    fmpz_poly_q_t first, second, third, part;
    fmpz_poly_q_init(first);
    fmpz_poly_q_init(second);
    fmpz_poly_q_init(third);
    fmpz_poly_q_init(part);
    fmpz_poly_q_derivative(first, f);
    fmpz_poly_q_derivative(second, first);
    fmpz_poly_q_derivative(third, second);
    polynomial_at(out, fmpz_poly_q_numref(r), f);
    polynomial_at(part, fmpz_poly_q_denref(r), f);
    fmpz_poly_q_div(out, out, part);
    fmpz_poly_q_mul(out, out, first);
    fmpz_poly_q_mul(out, out, first);
    fmpz_poly_q_div(third, third, first);
    fmpz_poly_q_scalar_div_si(third, third, 2);
    fmpz_poly_q_sub(out, out, third);
    fmpz_poly_q_div(second, second, first);
    fmpz_poly_q_mul(second, second, second);
    times(second, (ratio){3, 4});
    fmpz_poly_q_add(out, out, second);
    fmpz_poly_q_clear(part);
    fmpz_poly_q_clear(third);
    fmpz_poly_q_clear(second);
    fmpz_poly_q_clear(first);
}

/* Motions near x = 0 of  V = (x^2 + B y^2)/2 + x^2 y + eps y^3  at the level h:  y'^2 = S = 2 h - B y^2 - 2 eps y^3,
 * P = S'/(2 S), Q = (1 + 2 y)/S. */
static inline void henon_heiles(fmpz_poly_q_t r, ratio B, ratio eps, ratio h)
{
    fmpz_poly_q_t S, P, Q;
    fmpz_poly_q_init(S);
    fmpz_poly_q_init(P);
    fmpz_poly_q_init(Q);
    put_text(S, "2  0 1");
    times(S, (ratio){-2 * eps.n, eps.d});
    add_ratio(S, (ratio){-B.n, B.d});
    put_text(P, "3  0 0 1");
    fmpz_poly_q_mul(S, S, P);
    add_ratio(S, (ratio){2 * h.n, h.d});
    fmpz_poly_q_derivative(P, S);
    fmpz_poly_q_div(P, P, S);
    fmpz_poly_q_scalar_div_si(P, P, 2);
    put_text(Q, "2  1 2");
    fmpz_poly_q_div(Q, Q, S);
    of_second_order(r, P, Q);
    fmpz_poly_q_clear(Q);
    fmpz_poly_q_clear(P);
    fmpz_poly_q_clear(S);
}

/* A body with a fixed direction of no rotation, inertias I1 and I2, potential gamma_3, level 1/3; x = tan(angle/2):
 * c = (1 - x^2)/(1 + x^2), sigma = (1 + x^2)^2 (1/3 - c)/(2 I2), P = sigma'/(2 sigma), Q = -c/(I1 sigma). */
static inline void suslov(fmpz_poly_q_t r, ratio I1, ratio I2)
{
    fmpz_poly_q_t c, sigma, P, Q;
    fmpz_poly_q_init(c);
    fmpz_poly_q_init(sigma);
    fmpz_poly_q_init(P);
    fmpz_poly_q_init(Q);
    put_text(c, "3  1 0 -1/3  1 0 1");
    put_text(P, "5  1 0 2 0 1");
    fmpz_poly_q_neg(sigma, c);
    add_ratio(sigma, (ratio){1, 3});
    fmpz_poly_q_mul(sigma, sigma, P);
    times(sigma, (ratio){I2.d, 2 * I2.n});
    fmpz_poly_q_derivative(P, sigma);
    fmpz_poly_q_div(P, P, sigma);
    fmpz_poly_q_scalar_div_si(P, P, 2);
    fmpz_poly_q_div(Q, c, sigma);
    times(Q, (ratio){-I1.d, I1.n});
    of_second_order(r, P, Q);
    fmpz_poly_q_clear(Q);
    fmpz_poly_q_clear(P);
    fmpz_poly_q_clear(sigma);
    fmpz_poly_q_clear(c);
}

/* A particle with z' = y x' in V = (b x^2 + c y^2)/2 near x = 0 at the level 1/2:  S = 1 - c y^2,
 * P = (y S - c y (1 + y^2))/((1 + y^2) S), Q = b/((1 + y^2) S). */
static inline void contact_particle(fmpz_poly_q_t r, ratio b, ratio c)
{
    fmpz_poly_q_t S, P, Q;
    fmpz_poly_q_init(S);
    fmpz_poly_q_init(P);
    fmpz_poly_q_init(Q);
    put_text(S, "3  0 0 1");
    times(S, (ratio){-c.n, c.d});
    add_ratio(S, (ratio){1, 1});
    put_text(P, "2  0 1");
    times(P, (ratio){-c.n, c.d});
    fmpz_poly_q_div(P, P, S);
    put_text(Q, "2  0 1/3  1 0 1");
    fmpz_poly_q_add(P, P, Q);
    put_text(Q, "1  1/3  1 0 1");
    fmpz_poly_q_div(Q, Q, S);
    times(Q, b);
    of_second_order(r, P, Q);
    fmpz_poly_q_clear(Q);
    fmpz_poly_q_clear(P);
    fmpz_poly_q_clear(S);
}

/* Numbers that are the same in every run. */
static inline long drawn(uint64_t *state, long low, long high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (long)((*state >> 33) % (uint64_t)(high - low + 1));
}

#endif
