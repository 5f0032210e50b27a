/* text: see text.h. */
#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void nh_text_init(nh_text *text) { *text = (nh_text){0}; }

void nh_text_clear(nh_text *text)
{
    nh_free(text->data);
    nh_text_init(text);
}

const char *nh_text_string(const nh_text *text) { return text->data ? text->data : ""; }

void nh_text_cut(nh_text *text, size_t length)
{
    if (length >= text->length) return;
    text->length = length;
    text->data[length] = 0;
}

void nh_text_add_n(nh_text *text, const char *string, size_t length)
{
    nh_grow(&text->data, &text->capacity, text->length + length + 1, 1);
    if (length) memcpy(text->data + text->length, string, length);
    text->length += length;
    text->data[text->length] = '\0';
}

void nh_text_add(nh_text *text, const char *string) { nh_text_add_n(text, string, strlen(string)); }

void nh_text_addf(nh_text *text, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length >= 0) {
        size_t room = (size_t)length + 1;
        nh_grow(&text->data, &text->capacity, text->length + room, 1);
        vsnprintf(text->data + text->length, room, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
}

/* ---- numbers ----
 *
 * 15 digits are what a decimal survives, 17 what a double needs; the first that reads back is the shortest.  Output is
 * mostly numbers, and printf takes longest: so the digits of numbers of usual size come from integers of 128 bits.  For
 * other numbers printf is asked once, for 17 digits, and those are rounded to fewer. */

enum { most_digits = 17, least_digits = 15 };
__extension__ typedef unsigned __int128 nh_wide;

/* A number 0.d1 d2 ... d_count * 10^(exponent + 1). */
typedef struct {
    bool negative;
    int count, exponent;
    char digit[most_digits];
} decimal;

/* A number whose decimals need at most 128 bits: mantissa / 2^shift, both exact. */
typedef struct {
    uint64_t mantissa;
    int shift;
} binary;

/* Numbers that 10^0 to 10^21 bring to 15 and to 17 digits: 53 bits by 70 at most, and the shift stays below that. */
static bool short_enough(double value, binary *b)
{
    enum { bits = 52, bias = 1075 };
    uint64_t all, one = (uint64_t)1 << bits;
    double size = fabs(value);
    if (!(size > 2e-5 && size < 9e13)) return false;
    memcpy(&all, &size, sizeof all);
    *b = (binary){(all & (one - 1)) | one, bias - (int)(all >> bits)};
    return true;
}

static nh_wide power_of_ten(int n)
{
    static const uint64_t power[] = {1,       10,       100,       1000,       10000,       100000,
                                     1000000, 10000000, 100000000, 1000000000, 10000000000, 100000000000};
    enum { most = sizeof power / sizeof *power - 1 };
    return n <= most ? (nh_wide)power[n] : (nh_wide)power[most] * power[n - most];
}

/* value 10^power, rounded to the nearest whole number, half to even, as printf rounds. */
static uint64_t scaled(const binary *b, int power)
{
    nh_wide product = b->mantissa * power_of_ten(power), whole = product >> b->shift;
    nh_wide rest = product - (whole << b->shift), half = (nh_wide)1 << (b->shift - 1);
    return (uint64_t)whole + (rest > half || (rest == half && (whole & 1)));
}

static decimal decimal_exactly(const binary *b, double value, int count)
{
    decimal d = {.negative = value < 0, .count = count, .exponent = (int)floor(log10(fabs(value)))};
    uint64_t digits = scaled(b, count - 1 - d.exponent), least = (uint64_t)power_of_ten(count - 1);
    if (digits < least) digits = scaled(b, count - 1 - --d.exponent); /* the logarithm was rounded */
    if (digits >= 10 * least) digits = scaled(b, count - 1 - ++d.exponent);
    for (int i = count - 1; i >= 0; i--, digits /= 10) d.digit[i] = (char)('0' + digits % 10);
    return d;
}

static decimal decimal_of(double value, int count)
{
    char text[32];
    binary b;
    if (short_enough(value, &b)) return decimal_exactly(&b, value, count);
    decimal d = {.negative = value < 0, .count = count};
    snprintf(text, sizeof text, "%.*e", count - 1, fabs(value));
    d.digit[0] = text[0];
    memcpy(d.digit + 1, text + 2, (size_t)count - 1);
    d.exponent = atoi(text + count + 2);
    return d;
}

/* Rounds to so many of its digits; the value itself decides a tie. */
static decimal rounded(const decimal *d, int count, double value)
{
    decimal out = *d;
    bool tie = d->digit[count] == '5';
    for (int i = count + 1; i < d->count; i++) tie = tie && d->digit[i] == '0';
    if (tie) return decimal_of(value, count);
    out.count = count;
    if (d->digit[count] < '5') return out;
    int i = count - 1;
    for (; i >= 0 && out.digit[i] == '9'; i--) out.digit[i] = '0';
    if (i >= 0) return out.digit[i]++, out;
    out.digit[0] = '1';
    out.exponent++;
    return out;
}

static char *put_digits(char *out, const decimal *d, int from, int to)
{
    memcpy(out, d->digit + from, (size_t)(to - from));
    return out + (to - from);
}

static void put_exponential(char *out, const decimal *d, int count)
{
    if (d->negative) *out++ = '-';
    out = put_digits(out, d, 0, 1);
    if (count > 1) *out++ = '.';
    out = put_digits(out, d, 1, count);
    int e = abs(d->exponent);
    *out++ = 'e';
    *out++ = d->exponent < 0 ? '-' : '+';
    if (e >= 100) *out++ = (char)('0' + e / 100);
    *out++ = (char)('0' + e / 10 % 10);
    *out++ = (char)('0' + e % 10);
    *out = '\0';
}

/* The layout of printf's %g. */
static void put_decimal(char *out, const decimal *d)
{
    int count = d->count, whole = d->exponent + 1;
    while (count > 1 && d->digit[count - 1] == '0') count--;
    if (d->exponent < -4 || d->exponent >= d->count) {
        put_exponential(out, d, count);
        return;
    }
    if (d->negative) *out++ = '-';
    if (whole > 0) out = put_digits(out, d, 0, whole);
    else {
        memcpy(out, "0.0000", (size_t)(2 - whole));
        out += 2 - whole;
    }
    if (whole > 0 && count > whole) *out++ = '.';
    if (count > whole) out = put_digits(out, d, whole > 0 ? whole : 0, count);
    *out = '\0';
}

/* |digits / 10^j - mantissa / 2^shift| <= 1 / 2^(shift + 1), multiplied by 10^j 2^(shift + 1); at equality the even
   mantissa is read. */
static bool nearest(const binary *b, const decimal *d)
{
    nh_wide ten = power_of_ten(d->count - 1 - d->exponent), own = b->mantissa * ten;
    uint64_t digits = 0;
    for (int i = 0; i < d->count; i++) digits = 10 * digits + (uint64_t)(d->digit[i] - '0');
    nh_wide read = (nh_wide)digits << b->shift, off = 2 * (read > own ? read - own : own - read);
    return off < ten || (off == ten && b->mantissa % 2 == 0);
}

static bool reads_back(const decimal *d, double value)
{
    char text[32];
    binary b;
    /* the neighbour below a power of 2 is half as far */
    bool even_steps = short_enough(value, &b) && b.mantissa != (uint64_t)1 << 52;
    if (even_steps) return nearest(&b, d);
    put_exponential(text, d, d->count);
    return strtod(text, NULL) == value;
}

void nh_text_number(double value, char *out, size_t size)
{
    char text[32] = "0"; /* "-0" means nothing to a reader */
    /* printf would write "-nan" for some */
    if (!isfinite(value)) snprintf(text, sizeof text, "%s", isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
    else if (value != 0) {
        decimal all = decimal_of(value, most_digits), best = all;
        for (int count = most_digits - 1; count >= least_digits; count--) {
            decimal fewer = rounded(&all, count, value);
            if (!reads_back(&fewer, value)) break;
            best = fewer;
        }
        put_decimal(text, &best);
    }
    size_t length = strlen(text);
    if (size == 0) return;
    if (length >= size) length = size - 1;
    memcpy(out, text, length);
    out[length] = '\0';
}

static const char *skip_digits(const char *s)
{
    while (isdigit((unsigned char)*s)) s++;
    return s;
}

bool nh_text_is_number(const char *s)
{
    s += *s == '+' || *s == '-';
    const char *whole = s;
    s = skip_digits(s);
    size_t digits = (size_t)(s - whole);
    if (*s == '.') {
        const char *fraction = ++s;
        s = skip_digits(s);
        digits += (size_t)(s - fraction);
    }
    if (digits == 0) return false;
    if (*s == 'e' || *s == 'E') {
        s += s[1] == '+' || s[1] == '-' ? 2 : 1;
        if (!isdigit((unsigned char)*s)) return false;
        s = skip_digits(s);
    }
    return *s == '\0';
}

bool nh_text_to_number(const char *text, double *out)
{
    if (!nh_text_is_number(text)) return false;
    double value = strtod(text, NULL);
    bool zero = strcspn(text, "123456789") >= strcspn(text, "eE"); /* no other digit before the exponent */
    if (!isfinite(value) || (value == 0 && !zero)) return false;
    *out = value;
    return true;
}

bool nh_text_to_parts(const char *text, double *top, double *bottom)
{
    char word[64];
    size_t length = strcspn(text, "/");
    *bottom = 1;
    if (!text[length]) return nh_text_to_number(text, top);
    if (length >= sizeof word) return false;
    memcpy(word, text, length);
    word[length] = 0;
    return nh_text_to_number(word, top) && nh_text_to_number(text + length + 1, bottom) && *bottom != 0;
}

bool nh_text_to_ratio(const char *text, double *out)
{
    double a, b;
    if (!nh_text_to_parts(text, &a, &b) || !isfinite(a / b) || (a != 0 && a / b == 0)) return false;
    *out = a / b;
    return true;
}

enum { WORD_MAX = 63 }; /* longer words are not compared */

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

static size_t smaller(size_t a, size_t b) { return a < b ? a : b; }

/* Damerau-Levenshtein distance (optimal string alignment: no substring is edited twice), case ignored:
 *
 *     d[i][j] = min( d[i-1][j] + 1, d[i][j-1] + 1, d[i-1][j-1] + [a_i != b_j], d[i-2][j-2] + 1 if swapped )
 *
 * Only three rows are kept. */
static size_t distance(const char *a, size_t na, const char *b, size_t nb)
{
    size_t row[3][WORD_MAX + 1];
    for (size_t j = 0; j <= nb; j++) row[0][j] = j;
    for (size_t i = 1; i <= na; i++) {
        size_t *now = row[i % 3], *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];
        now[0] = i;
        for (size_t j = 1; j <= nb; j++) {
            bool same = lower(a[i - 1]) == lower(b[j - 1]);
            size_t best = smaller(smaller(last[j], now[j - 1]) + 1, last[j - 1] + !same);
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                best = smaller(best, before[j - 2] + 1);
            now[j] = best;
        }
    }
    return row[na % 3][nb];
}

/* How many first letters both have in common. */
static size_t common_start(const char *a, const char *b)
{
    size_t n = 0;
    while (a[n] && lower(a[n]) == lower(b[n])) n++;
    return n;
}

/* Can `candidate` have been meant?  Not if every letter differs: `q` is no misspelt `y`.  A beginning of it, as
 * `coord`, and a longer word with another last letter, as `coords`, are taken for it. */
static bool near_enough(const char *word, size_t nw, const char *candidate, size_t nc, size_t apart)
{
    size_t allowed = nw <= 4 ? 1 : nw <= 8 ? 2 : 3;
    size_t shorter = smaller(nw, nc), longer = nw + nc - shorter;
    if (apart <= allowed && apart < longer) return true;
    size_t common = common_start(word, candidate);
    return (shorter >= 3 && common == shorter) || (shorter >= 6 && common + 1 == shorter);
}

const char *nh_text_nearest(const char *word, const char *const *candidates, size_t count)
{
    const char *nearest = NULL;
    size_t least = 0, nw = strlen(word);
    if (nw == 0 || nw > WORD_MAX) return NULL;
    for (size_t i = 0; i < count; i++) {
        size_t nc = strlen(candidates[i]);
        if (nc > WORD_MAX) continue;
        size_t apart = distance(word, nw, candidates[i], nc);
        if (near_enough(word, nw, candidates[i], nc, apart) && (!nearest || apart < least)) {
            nearest = candidates[i];
            least = apart;
        }
    }
    return nearest;
}

size_t nh_text_width(const char *string)
{
    size_t width = 0;
    for (; *string; string++)
        if (((unsigned char)*string & 0xC0) != 0x80) width++;
    return width;
}

uint64_t nh_text_fingerprint(uint64_t before, const char *bytes, size_t length)
{
    static const uint64_t offset = 0xcbf29ce484222325, prime = 0x100000001b3;
    uint64_t h = before ^ offset;
    for (size_t i = 0; i < length; i++) h = (h ^ (unsigned char)bytes[i]) * prime;
    return h ^ offset;
}

size_t nh_text_entry(const char *text, const char *separators)
{
    size_t length = 0;
    for (int depth = 0; text[length] && (depth > 0 || !strchr(separators, text[length])); length++)
        depth += (text[length] == '(') - (text[length] == ')');
    return length;
}
