/* identities: seeded pairs of formulas that are equal but do not look so, for tests of whether a program that computes modulo primes sees it.
 *
 * A pair (left, right) is equal wherever all its letters are positive: a sum of roots is squared and the root is taken again, half, double and sums of angles stand
 * beside each other, logarithms are split, square roots are denested, powers have fractional exponents.  The letters are numbers, a coordinate x between 1/2 and 3/2, the time near 1 or a
 * parameter a = 2; so left - right is a zero by construction, and left + right is twice the right side, which must not be lost. */
#ifndef NH_TESTS_IDENTITIES_H
#define NH_TESTS_IDENTITIES_H

#include <stdint.h>
#include <stdio.h>

enum { identity_length = 200 };

typedef struct {
    uint64_t state;
    char u[40]; /* the letter */
    char left[identity_length], right[identity_length];
} identity;

static inline size_t identity_draw(identity *x, size_t n)
{
    uint64_t z = (x->state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (size_t)((z ^ (z >> 31)) % n);
}

/* Two square-free numbers that are not equal. */
static inline void identity_numbers(identity *x, int *m, int *n)
{
    static const int squarefree[] = {2, 3, 5, 6, 7, 10, 11, 13};
    size_t i = identity_draw(x, 8), j = identity_draw(x, 7);
    *m = squarefree[i];
    *n = squarefree[j + (j >= i)];
}

#define IDENTITY(l, ...) snprintf(x->left, identity_length, l, __VA_ARGS__)
#define EQUALS(r, ...) snprintf(x->right, identity_length, r, __VA_ARGS__)

/* Roots alone: of numbers, of the letter, nested. */
static inline void identity_of_roots(identity *x, size_t which)
{
    const char *u = x->u;
    int m, n, k = 1 + (int)identity_draw(x, 4);
    identity_numbers(x, &m, &n);
    switch (which) {
    case 0: IDENTITY("sqrt(%d+%d*sqrt(%d))", k * k + n, 2 * k, n), EQUALS("%d+sqrt(%d)", k, n); break;
    case 1: IDENTITY("sqrt(%d+2*sqrt(%d))", m + n, m * n), EQUALS("sqrt(%d)+sqrt(%d)", m, n); break;
    case 2: IDENTITY("sqrt(%d+%s+%d*sqrt(%s))", k * k, u, 2 * k, u), EQUALS("%d+sqrt(%s)", k, u); break;
    case 3: IDENTITY("sqrt(1+2*%s+2*sqrt(%s+%s^2))", u, u, u), EQUALS("sqrt(%s)+sqrt(1+%s)", u, u); break;
    case 4: IDENTITY("sqrt(%d*%s+%d+2*sqrt(%d*%s))", m, u, n, m * n, u), EQUALS("sqrt(%d)*sqrt(%s)+sqrt(%d)", m, u, n); break;
    case 5: IDENTITY("(1+3*%s+3*%s^2+%s^3)^(1/3)", u, u, u), EQUALS("1+%s", u); break;
    case 6: IDENTITY("%s^(3/4)*%s^(5/4)", u, u), EQUALS("%s^2", u); break;
    default: IDENTITY("sqrt(1+sqrt(%s)+2*%s^(1/4))", u, u), EQUALS("1+%s^(1/4)", u); break;
    }
}

/* Roots of sines, cosines and exponentials: half and double arguments. */
static inline void identity_of_halves(identity *x, size_t which)
{
    const char *u = x->u;
    switch (which) {
    case 0: IDENTITY("sqrt(1+cos(%s))", u), EQUALS("sqrt(2)*cos(%s/2)", u); break;
    case 1: IDENTITY("sqrt(1-cos(%s))", u), EQUALS("sqrt(2)*sin(%s/2)", u); break;
    case 2: IDENTITY("sqrt(1+sin(%s))", u), EQUALS("sin(%s/2)+cos(%s/2)", u, u); break;
    case 3: IDENTITY("sqrt(cosh(%s)-1)", u), EQUALS("sqrt(2)*sinh(%s/2)", u); break;
    case 4: IDENTITY("sqrt(1+cosh(%s))", u), EQUALS("sqrt(2)*cosh(%s/2)", u); break;
    case 5: IDENTITY("sqrt(exp(%s))", u), EQUALS("exp(%s/2)", u); break;
    case 6: IDENTITY("sqrt(1+exp(2*%s)+2*exp(%s))", u, u), EQUALS("1+exp(%s)", u); break;
    default: IDENTITY("sqrt(2+sqrt(2+2*cos(%s)))", u), EQUALS("2*cos(%s/4)", u); break;
    }
}

/* Addition theorems, logarithms, inverse functions, Wronskians. */
static inline void identity_of_functions(identity *x, size_t which)
{
    const char *u = x->u;
    int k = 2 + (int)identity_draw(x, 3);
    switch (which) {
    case 0: IDENTITY("sin(%d*%s+1)", k, u), EQUALS("sin(%d*%s)*cos(1)+cos(%d*%s)*sin(1)", k, u, k, u); break;
    case 1: IDENTITY("log(%s^2+%d*%s)", u, k, u), EQUALS("log(%s)+log(%s+%d)", u, u, k); break;
    case 2: IDENTITY("exp(%s)*exp(-%s/%d)", u, u, k), EQUALS("exp(%s-%s/%d)", u, u, k); break;
    case 3: IDENTITY("atan(%s)", u), EQUALS("asin(%s/sqrt(1+%s^2))", u, u); break;
    case 4: IDENTITY("2*atan(sqrt(%s))", u), EQUALS("acos((1-%s)/(1+%s))", u, u); break;
    case 5: IDENTITY("asinh(%s)", u), EQUALS("log(%s+sqrt(1+%s^2))", u, u); break;
    case 6: IDENTITY("bessel_j(0,%s)*bessel_y(1,%s)", u, u), EQUALS("bessel_j(1,%s)*bessel_y(0,%s)-2/(pi*%s)", u, u, u); break;
    default: IDENTITY("log(3+2*sqrt(2))*%s", u), EQUALS("2*log(1+sqrt(2))*%s", u); break;
    }
}

/* The pair number `seed`, in the letter u. */
static inline identity identity_make(uint64_t seed, const char *u)
{
    identity made = {.state = seed}, *x = &made;
    snprintf(x->u, sizeof x->u, "%s", u);
    size_t family = identity_draw(x, 3), which = identity_draw(x, 8);
    if (family == 0) identity_of_roots(x, which);
    else if (family == 1) identity_of_halves(x, which);
    else identity_of_functions(x, which);
    return made;
}

#endif
