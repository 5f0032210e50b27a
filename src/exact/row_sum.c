/* Four products of residues fit into 64 bits: they are added up, then added in two halves of 32 bits, and divided once
 * at the end.
 *
 * A lane of 64 bits holds two residues of a row. The processor multiplies the lower halves of lanes in one instruction;
 * a compiler that sees two numbers of 64 bits takes three, and does not use what is known of them, so that this is
 * written with the instruction's name. */
#include "exact/row_sum.h"

#include <string.h>

#if defined __x86_64__ && defined __GNUC__
#include <immintrin.h>
#define HAS_LANES
#endif

enum { together = 4 };

typedef struct {
    nh_prime field;
    uint64_t carry; /* 2^32 modulo p */
    size_t count;
    const nh_residue *factor, *const *row;
} row_sum;

/* Where there are no lanes, and for a few columns. */
static void add_plain(const row_sum *s, size_t n, nh_residue *y)
{
    enum { block = 256 };
    uint64_t low[block], high[block];
    for (size_t from = 0; from < n; from += block) {
        size_t columns = n - from < block ? n - from : block;
        for (size_t j = 0; j < columns; j++) low[j] = y[from + j], high[j] = 0;
        for (size_t t = 0; t < s->count; t += together) {
            const nh_residue *f = s->factor + t, *a = s->row[t] + from, *b = s->row[t + 1] + from,
                             *c = s->row[t + 2] + from, *d = s->row[t + 3] + from;
            for (size_t j = 0; j < columns; j++) {
                uint64_t sum =
                    (uint64_t)f[0] * a[j] + (uint64_t)f[1] * b[j] + (uint64_t)f[2] * c[j] + (uint64_t)f[3] * d[j];
                low[j] += sum & UINT32_MAX;
                high[j] += sum >> 32;
            }
        }
        for (size_t j = 0; j < columns; j++)
            y[from + j] = nh_residue_reduce(s->field, nh_residue_reduce(s->field, low[j]) +
                                                          nh_residue_reduce(s->field, high[j]) * s->carry);
    }
}

#ifdef HAS_LANES
typedef uint64_t lanes_8 __attribute__((vector_size(64)));
typedef uint64_t lanes_4 __attribute__((vector_size(32)));
#define EIGHT __attribute__((target("avx512f")))
#define FOUR __attribute__((target("avx2")))
#define MULTIPLY_8(a, b) ((lanes_8)_mm512_mul_epu32((__m512i)(a), (__m512i)(b)))
#define MULTIPLY_4(a, b) ((lanes_4)_mm256_mul_epu32((__m256i)(a), (__m256i)(b)))

/* nh_residue_reduce of every lane; and out = y[from..] and what is added to it there: the first and the second
 * residues of the lanes apart. */
#define SUM(N, ISA)                                                                                                    \
    ISA static inline lanes_##N reduce_##N(nh_prime f, lanes_##N x)                                                    \
    {                                                                                                                  \
        const lanes_##N zero = {0}, p = zero + f.p;                                                                    \
        lanes_##N r = x - MULTIPLY_##N(MULTIPLY_##N(x >> 30, zero + f.inverse) >> 32, p);                              \
        r -= (lanes_##N)(r >= 2 * p) & 2 * p;                                                                          \
        return r - ((lanes_##N)(r >= p) & p);                                                                          \
    }                                                                                                                  \
    ISA static inline lanes_##N fold_##N(const row_sum *s, lanes_##N low, lanes_##N high)                              \
    {                                                                                                                  \
        const lanes_##N carry = (lanes_##N){0} + s->carry;                                                             \
        return reduce_##N(s->field, reduce_##N(s->field, low) + MULTIPLY_##N(reduce_##N(s->field, high), carry));      \
    }                                                                                                                  \
    ISA static void add_##N(const row_sum *s, size_t from, const nh_residue *y, nh_residue *out)                       \
    {                                                                                                                  \
        const lanes_##N zero = {0}, half = zero + UINT32_MAX;                                                          \
        lanes_##N x, first, second, first_high = zero, second_high = zero;                                             \
        memcpy(&x, y + from, sizeof x);                                                                                \
        first = x & half, second = x >> 32;                                                                            \
        for (size_t t = 0; t < s->count; t += together) {                                                              \
            lanes_##N a = zero, b = zero;                                                                              \
            for (size_t i = t; i < t + together; i++) {                                                                \
                const lanes_##N c = zero + s->factor[i];                                                               \
                memcpy(&x, s->row[i] + from, sizeof x);                                                                \
                a += MULTIPLY_##N(x, c);                                                                               \
                b += MULTIPLY_##N(x >> 32, c);                                                                         \
            }                                                                                                          \
            first += a & half, first_high += a >> 32;                                                                  \
            second += b & half, second_high += b >> 32;                                                                \
        }                                                                                                              \
        x = fold_##N(s, first, first_high) | fold_##N(s, second, second_high) << 32;                                   \
        memcpy(out, &x, sizeof x);                                                                                     \
    }
SUM(8, EIGHT)
SUM(4, FOUR)
#endif

typedef void add_columns(const row_sum *s, size_t from, const nh_residue *y, nh_residue *out);

/* For n columns: the fastest that this processor has, and how many columns it takes together; NULL: add_plain. */
static add_columns *fastest(size_t n, size_t *width)
{
#ifdef HAS_LANES
    if (n >= (*width = 16) && __builtin_cpu_supports("avx512f")) return add_8;
    if (n >= (*width = 8) && __builtin_cpu_supports("avx2")) return add_4;
#endif
    *width = n;
    return NULL;
}

/* The same for a number of rows that is a multiple of `together`. */
static void add(const row_sum *s, size_t n, nh_residue *y)
{
    enum { most_width = 16 };
    nh_residue last[most_width];
    size_t width;
    add_columns *columns = fastest(n, &width);
    if (!columns) {
        add_plain(s, n, y);
        return;
    }
    /* The last columns are among the others, too, where n is no multiple of the width: they are made first. */
    columns(s, n - width, y, last);
    for (size_t from = 0; from + width <= n; from += width) columns(s, from, y, y + from);
    memcpy(y + n - width, last, width * sizeof *last);
}

void nh_row_sum_add(nh_prime field, size_t n, nh_residue *y, size_t count, const nh_residue *factor,
                    const nh_residue *const *row)
{
    /* most: so many rows' columns, one after another, that the processor keeps them at hand */
    enum { few = 4, most = 64 };
    size_t t = 0;
    while (count > few && count - t >= together) {
        size_t rows = count - t < most ? (count - t) / together * together : most;
        add(&(row_sum){field, ((uint64_t)1 << 32) % field.p, rows, factor + t, row + t}, n, y);
        t += rows;
    }
    for (; t < count; t++) nh_residue_add_multiple(field, n, y, row[t], factor[t]);
}
