#include "graph/num.h"

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/recovery.h"
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

/* ---- numbers too long for 64 bits (num_long.h) ---- */

enum { most_bits = 4096, most_kept = 1 << 20 };

static struct {
    pthread_mutex_t lock;
    size_t count, capacity, slots;
    mpq_t *value; /* `count` numbers; indices begin at 1 */
    size_t *slot; /* open addressing, a power of two; 0: free */
} table = {.lock = PTHREAD_MUTEX_INITIALIZER};

static void clear_table(void)
{
    for (size_t i = 1; i <= table.count; i++) mpq_clear(table.value[i]);
    nh_free(table.value);
    nh_free(table.slot);
    table.value = NULL;
    table.slot = NULL;
    table.count = table.capacity = table.slots = 0;
}

static size_t hash_mpz(size_t h, const mpz_t z)
{
    for (size_t i = 0; i < mpz_size(z); i++)
        h = (h ^ mpz_getlimbn(z, (mp_size_t)i)) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
    return h;
}

static size_t hash(const mpq_t v) { return hash_mpz(hash_mpz(mpq_sgn(v) < 0, mpq_numref(v)), mpq_denref(v)); }

static size_t place_of(const mpq_t v)
{
    size_t at = hash(v) & (table.slots - 1);
    while (table.slot[at] && !mpq_equal(table.value[table.slot[at]], v)) at = (at + 1) & (table.slots - 1);
    return at;
}

static void grow(void)
{
    if (2 * (table.count + 1) < table.slots) return;
    if (table.slots == 0) atexit(clear_table);
    size_t slots = table.slots ? 2 * table.slots : 256;
    size_t *slot = nh_alloc_array(slots, sizeof *slot);
    nh_free(table.slot);
    table.slot = slot;
    table.slots = slots;
    for (size_t i = 1; i <= table.count; i++) table.slot[place_of(table.value[i])] = i;
}

/* The index of the number, which is added if it is new; 0 when there are too many. */
static size_t keep(const mpq_t v)
{
    nh_held held;
    nh_hold(&held, &table.lock);
    grow();
    size_t at = place_of(v);
    if (!table.slot[at] && table.count < most_kept) {
        nh_grow(&table.value, &table.capacity, table.count + 2, sizeof *table.value);
        mpq_t *kept = &table.value[table.count + 1]; /* it is counted once it is completely written */
        mpq_init(*kept);
        mpq_set(*kept, v);
        table.slot[at] = ++table.count;
    }
    size_t index = table.slot[at];
    nh_release(&held);
    return index;
}

/* GMP truncates: takes the nearer one of the two neighbours. */
static double nearest(const mpq_t v)
{
    double low = mpq_get_d(v), high = nextafter(low, mpq_sgn(v) * INFINITY);
    if (!isfinite(low) || !isfinite(high)) return low;
    mpq_t a, b;
    mpq_init(a);
    mpq_init(b);
    mpq_set_d(a, low);
    mpq_sub(a, v, a);
    mpq_set_d(b, high);
    mpq_sub(b, b, v);
    mpq_abs(a, a);
    mpq_abs(b, b);
    double value = mpq_cmp(b, a) < 0 ? high : low;
    mpq_clear(a);
    mpq_clear(b);
    return value;
}

static bool fits(const mpz_t z) { return mpz_fits_slong_p(z) && mpz_get_si(z) != INT64_MIN; }

nh_num nh_num_of_mpq(const mpq_t v)
{
    if (fits(mpq_numref(v)) && fits(mpq_denref(v)))
        return (nh_num){mpz_get_si(mpq_numref(v)), mpz_get_si(mpq_denref(v)), 0};
    double d = nearest(v);
    bool moderate = mpz_sizeinbase(mpq_numref(v), 2) <= most_bits && mpz_sizeinbase(mpq_denref(v), 2) <= most_bits;
    size_t index = moderate ? keep(v) : 0; /* beyond the range of doubles, too: d is 0 or infinite then */
    return index ? (nh_num){(int64_t)index, NH_LONG, d} : nh_num_real(d);
}

void nh_num_get_mpq(mpq_t out, nh_num a)
{
    if (a.q == NH_LONG) {
        nh_held held;
        nh_hold(&held, &table.lock);
        mpq_set(out, table.value[a.p]);
        nh_release(&held);
        return;
    }
    mpz_set_si(mpq_numref(out), a.p);
    mpz_set_si(mpq_denref(out), a.q);
}

void nh_num_split(nh_num a, nh_num *top, nh_num *bottom)
{
    enum { most_digits = 60 };
    *top = nh_num_short(a) ? nh_num_int(a.p) : a;
    *bottom = nh_num_int(nh_num_short(a) ? a.q : 1);
    if (a.q != NH_LONG || nh_num_equal(nh_num_decimal(a.d), a)) return;
    mpq_t v, one;
    mpq_init(v);
    mpq_init(one);
    nh_num_get_mpq(v, a);
    if (mpz_sizeinbase(mpq_numref(v), 10) + mpz_sizeinbase(mpq_denref(v), 10) <= most_digits) {
        mpz_set(mpq_numref(one), mpq_denref(v));
        *bottom = nh_num_of_mpq(one);
        mpz_set(mpq_numref(one), mpq_numref(v));
        *top = nh_num_of_mpq(one);
    }
    mpq_clear(one);
    mpq_clear(v);
}

/* 1.25e-400: doubles end at 1e-308 and 1e308. */
static void write_far(const mpq_t v, char *buffer, size_t size)
{
    enum { digits = 17, bits = 128 };
    mpf_t f;
    mp_exp_t exponent;
    char text[digits + 3];
    mpf_init2(f, bits);
    mpf_set_q(f, v);
    mpf_get_str(text, &exponent, 10, digits, f);
    mpf_clear(f);
    bool minus = text[0] == '-';
    const char *first = text + minus;
    snprintf(buffer, size, "%s%c%s%se%ld", minus ? "-" : "", first[0], first[1] ? "." : "", first + 1,
             (long)exponent - 1);
}

void nh_num_write(nh_num x, nh_text *out)
{
    char buffer[100];
    mpq_t v;
    mpq_init(v);
    if (nh_num_exact(x)) nh_num_get_mpq(v, x);
    bool whole =
        x.q == 1 || (x.q == NH_LONG && mpz_cmp_ui(mpq_denref(v), 1) == 0 &&
                     mpz_sizeinbase(mpq_numref(v), 10) < sizeof buffer - 2 && !nh_num_equal(nh_num_decimal(x.d), x));
    bool far = x.q == NH_LONG && (fabs(x.d) < DBL_MIN || !isfinite(x.d));
    if (far) write_far(v, buffer, sizeof buffer);
    else if (whole) mpz_get_str(buffer, 10, mpq_numref(v));
    else nh_text_number(nh_num_value(x), buffer, sizeof buffer);
    mpq_clear(v);
    nh_text_add(out, buffer);
}

nh_num nh_num_of_digits(const char *digits, size_t count)
{
    char *text = nh_alloc(count + 1);
    memcpy(text, digits, count);
    mpq_t v;
    mpq_init(v);
    mpz_set_str(mpq_numref(v), text, 10);
    nh_num result = nh_num_of_mpq(v);
    mpq_clear(v);
    nh_free(text);
    return result;
}
