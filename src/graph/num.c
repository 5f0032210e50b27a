#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "graph/num_long.h"

/* Exact arithmetic in 128 bit; larger numbers continue in GMP. */
typedef __int128 wide;

static wide wide_gcd(wide a, wide b)
{
    if (a < 0) a = -a;
    if (b < 0) b = -b;
    while (b) {
        wide r = a % b;
        a = b;
        b = r;
    }
    return a;
}

static nh_num inexact(double value) { return (nh_num){0, 0, value}; }

static void set_wide(mpz_t out, wide x)
{
    unsigned __int128 size = x < 0 ? -(unsigned __int128)x : (unsigned __int128)x;
    mpz_set_ui(out, (unsigned long)(size >> 64));
    mpz_mul_2exp(out, out, 64);
    mpz_add_ui(out, out, (unsigned long)size);
    if (x < 0) mpz_neg(out, out);
}

static nh_num reduced(wide p, wide q)
{
    if (q == 0) return inexact(p == 0 ? NAN : p > 0 ? INFINITY : -INFINITY);
    if (q < 0) {
        p = -p;
        q = -q;
    }
    wide g = wide_gcd(p, q);
    if (g > 1) {
        p /= g;
        q /= g;
    }
    if (p <= INT64_MAX && p >= -INT64_MAX && q <= INT64_MAX) return (nh_num){(int64_t)p, (int64_t)q, 0};
    mpq_t v;
    mpq_init(v);
    set_wide(mpq_numref(v), p);
    set_wide(mpq_denref(v), q);
    nh_num result = nh_num_of_mpq(v);
    mpq_clear(v);
    return result;
}

typedef void operation(mpq_t, const mpq_t, const mpq_t);

/* The same operation in as many bits as it needs. */
static nh_num at_length(operation *f, nh_num a, nh_num b)
{
    mpq_t x, y;
    mpq_init(x);
    mpq_init(y);
    nh_num_get_mpq(x, a);
    nh_num_get_mpq(y, b);
    f(x, x, y);
    nh_num result = nh_num_of_mpq(x);
    mpq_clear(x);
    mpq_clear(y);
    return result;
}

int64_t nh_gcd(int64_t a, int64_t b)
{
    while (b) {
        int64_t r = a % b;
        a = b;
        b = r;
    }
    return a < 0 ? -a : a;
}

nh_num nh_num_int(int64_t value) { return value == INT64_MIN ? inexact((double)value) : (nh_num){value, 1, 0}; }

nh_num nh_num_ratio(int64_t p, int64_t q) { return reduced(p, q); }

nh_num nh_num_real(double value)
{
    if (fabs(value) < 9007199254740992.0 && value == floor(value)) return nh_num_int((int64_t)value);
    return inexact(value);
}

/* The ratio p/q with a small q that rounds to this double, by continued fractions: 1/3, and not its seventeen
 * digits. */
static bool small_ratio(double value, nh_num *out)
{
    enum { most = 1000 };
    double x = fabs(value), whole = floor(x);
    if (!(x < 1e6)) return false;
    int64_t p[2] = {1, (int64_t)whole}, q[2] = {0, 1};
    while ((double)p[1] / (double)q[1] != fabs(value)) {
        if (x == whole) return false;
        x = 1 / (x - whole);
        whole = floor(x);
        if (!(whole < most)) return false;
        int64_t next[2] = {(int64_t)whole * p[1] + p[0], (int64_t)whole * q[1] + q[0]};
        if (next[1] > most) return false;
        p[0] = p[1], q[0] = q[1], p[1] = next[0], q[1] = next[1];
    }
    *out = nh_num_ratio(value < 0 ? -p[1] : p[1], q[1]);
    return true;
}

nh_num nh_num_decimal(double value)
{
    enum { many = 13 };
    char text[40];
    int precision = 15, exponent;
    if (!isfinite(value)) return inexact(value);
    do snprintf(text, sizeof text, "%.*e", precision - 1, value);
    while (strtod(text, NULL) != value && ++precision <= 17);
    char *e = strchr(text, 'e'), *point = strchr(text, '.'), *last = e - 1;
    nh_num ratio;
    while (*last == '0') last--;
    if (last - point >= many && small_ratio(value, &ratio)) return ratio;
    exponent = atoi(e + 1) - (int)(e - point - 1);
    *e = 0;
    memmove(point, point + 1, strlen(point));
    return nh_num_mul(nh_num_int(strtoll(text, NULL, 10)), nh_num_pow(nh_num_int(10), exponent));
}

bool nh_num_exact(nh_num a) { return a.q != 0; }

/* Rounded once: a decimal of 17 digits gives back the double that it was printed from. */
double nh_num_value(nh_num a)
{
    if (a.q <= 0) return a.d;
    return a.q == 1 ? (double)a.p : (double)((long double)a.p / (long double)a.q);
}

bool nh_num_equal(nh_num a, nh_num b)
{
    if (a.q || b.q) return a.q == b.q && a.p == b.p;
    return a.d == b.d || (isnan(a.d) && isnan(b.d));
}

nh_num nh_num_add(nh_num a, nh_num b)
{
    if (!a.q || !b.q) return nh_num_real(nh_num_value(a) + nh_num_value(b));
    wide p;
    if (a.q < 0 || b.q < 0 || __builtin_add_overflow((wide)a.p * b.q, (wide)b.p * a.q, &p))
        return at_length(mpq_add, a, b);
    return reduced(p, (wide)a.q * b.q);
}

nh_num nh_num_mul(nh_num a, nh_num b)
{
    if (nh_num_is(a, 0) || nh_num_is(b, 0)) return nh_num_int(0);
    if (!a.q || !b.q) return nh_num_real(nh_num_value(a) * nh_num_value(b));
    if (a.q < 0 || b.q < 0) return at_length(mpq_mul, a, b);
    return reduced((wide)a.p * b.p, (wide)a.q * b.q);
}

nh_num nh_num_inv(nh_num a)
{
    if (!a.q) return nh_num_real(1 / a.d);
    if (a.p == 0) return inexact(NAN);
    if (a.q < 0) return at_length(mpq_div, nh_num_int(1), a);
    return reduced(a.q, a.p);
}

nh_num nh_num_pow(nh_num a, int64_t n)
{
    if (n < 0) return nh_num_pow(nh_num_inv(a), n == INT64_MIN ? INT64_MAX : -n);
    if (!a.q) return nh_num_real(pow(a.d, (double)n));
    nh_num result = nh_num_int(1), square = a;
    for (int64_t m = n; m; m >>= 1) {
        if (m & 1) result = nh_num_mul(result, square);
        if (m > 1) square = nh_num_mul(square, square);
        if (!result.q || !square.q) return nh_num_real(pow(nh_num_value(a), (double)n));
    }
    return result;
}
