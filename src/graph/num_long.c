#include "graph/num_long.h"

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/recovery.h"

enum { most_bits = 4096, most_kept = 1 << 20 };

static struct {
    pthread_mutex_t lock;
    size_t count, capacity, slots;
    mpq_t *value;    /* `count` numbers; indices begin at 1 */
    size_t *slot;    /* open addressing, a power of two; 0: free */
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
