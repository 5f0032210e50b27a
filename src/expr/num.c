#include "expr/dag.h"

#include <math.h>

/* Exact arithmetic in 128 bit; what does not fit into 64 bit becomes a double. */
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
    if (p > INT64_MAX || p < -INT64_MAX || q > INT64_MAX) return nh_num_real((double)p / (double)q);
    return (nh_num){(int64_t)p, (int64_t)q, 0};
}

nh_num nh_num_int(int64_t value) { return value == INT64_MIN ? inexact((double)value) : (nh_num){value, 1, 0}; }

nh_num nh_num_ratio(int64_t p, int64_t q) { return reduced(p, q); }

nh_num nh_num_real(double value)
{
    if (fabs(value) < 9007199254740992.0 && value == floor(value)) return nh_num_int((int64_t)value);
    return inexact(value);
}

bool nh_num_exact(nh_num a) { return a.q > 0; }

/* Rounded once: a decimal of 17 digits is the double it was printed from. */
double nh_num_value(nh_num a)
{
    if (a.q == 0) return a.d;
    return a.q == 1 ? (double)a.p : (double)((long double)a.p / (long double)a.q);
}

bool nh_num_is(nh_num a, int64_t p) { return a.q == 1 && a.p == p; }

bool nh_num_equal(nh_num a, nh_num b)
{
    if (a.q || b.q) return a.q == b.q && a.p == b.p;
    return a.d == b.d || (isnan(a.d) && isnan(b.d));
}

nh_num nh_num_add(nh_num a, nh_num b)
{
    if (!a.q || !b.q) return nh_num_real(nh_num_value(a) + nh_num_value(b));
    wide p;
    if (__builtin_add_overflow((wide)a.p * b.q, (wide)b.p * a.q, &p))
        return nh_num_real(nh_num_value(a) + nh_num_value(b));
    return reduced(p, (wide)a.q * b.q);
}

nh_num nh_num_mul(nh_num a, nh_num b)
{
    if (nh_num_is(a, 0) || nh_num_is(b, 0)) return nh_num_int(0);
    if (!a.q || !b.q) return nh_num_real(nh_num_value(a) * nh_num_value(b));
    return reduced((wide)a.p * b.p, (wide)a.q * b.q);
}

nh_num nh_num_inv(nh_num a)
{
    if (!a.q) return nh_num_real(1 / a.d);
    if (a.p == 0) return inexact(NAN);
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
