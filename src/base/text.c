/* text: see text.h. */
#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void nh_text_init(nh_text *text)
{
    *text = (nh_text){0};
}

void nh_text_clear(nh_text *text)
{
    nh_free(text->data);
    nh_text_init(text);
}

const char *nh_text_string(const nh_text *text)
{
    return text->data ? text->data : "";
}

void nh_text_add_n(nh_text *text, const char *string, size_t length)
{
    nh_grow(&text->data, &text->capacity, text->length + length + 1, 1);
    if (length)
        memcpy(text->data + text->length, string, length);
    text->length += length;
    text->data[text->length] = '\0';
}

void nh_text_add(nh_text *text, const char *string)
{
    nh_text_add_n(text, string, strlen(string));
}

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
 * mostly numbers, and printf takes longest: so it is asked once, for 17 digits, and fewer are found by rounding
 * those. */

enum { most_digits = 17, least_digits = 15 };

/* A number 0.d1 d2 ... d_count * 10^(exponent + 1). */
typedef struct {
    bool negative;
    int count, exponent;
    char digit[most_digits];
} decimal;

static decimal decimal_of(double value, int count)
{
    char text[32];
    decimal d = {.negative = value < 0, .count = count};
    snprintf(text, sizeof text, "%.*e", count - 1, fabs(value));
    d.digit[0] = text[0];
    memcpy(d.digit + 1, text + 2, (size_t)count - 1);
    d.exponent = atoi(text + count + 2);
    return d;
}

/* As many of its digits; a tie of what is left over is the value's own matter. */
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

/* As printf's %g. */
static void put_decimal(char *out, const decimal *d)
{
    int count = d->count, whole = d->exponent + 1;
    while (count > 1 && d->digit[count - 1] == '0') count--;
    if (d->exponent < -4 || d->exponent >= d->count) {
        put_exponential(out, d, count);
        return;
    }
    if (d->negative) *out++ = '-';
    if (whole <= 0) out += sprintf(out, "0.%.*s", -whole, "0000");
    else out = put_digits(out, d, 0, whole);
    if (whole > 0 && count > whole) *out++ = '.';
    if (count > whole) out = put_digits(out, d, whole > 0 ? whole : 0, count);
    *out = '\0';
}

static bool reads_back(const decimal *d, double value)
{
    char text[32];
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
    snprintf(out, size, "%s", text);
}

static const char *skip_digits(const char *s)
{
    while (isdigit((unsigned char)*s))
        s++;
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
    if (digits == 0)
        return false;
    if (*s == 'e' || *s == 'E') {
        s += s[1] == '+' || s[1] == '-' ? 2 : 1;
        if (!isdigit((unsigned char)*s))
            return false;
        s = skip_digits(s);
    }
    return *s == '\0';
}

bool nh_text_to_number(const char *text, double *out)
{
    if (!nh_text_is_number(text))
        return false;
    double value = strtod(text, NULL);
    bool zero = strcspn(text, "123456789") >= strcspn(text, "eE"); /* no other digit before the exponent */
    if (!isfinite(value) || (value == 0 && !zero))
        return false;
    *out = value;
    return true;
}

enum { WORD_MAX = 63 }; /* longer words are no typing errors of each other */

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Damerau-Levenshtein distance (optimal string alignment: no substring is edited twice), case ignored:
 *
 *     d[i][j] = min( d[i-1][j] + 1, d[i][j-1] + 1, d[i-1][j-1] + [a_i != b_j], d[i-2][j-2] + 1 if swapped )
 *
 * Only three rows are kept. */
static size_t distance(const char *a, size_t na, const char *b, size_t nb)
{
    size_t row[3][WORD_MAX + 1];
    for (size_t j = 0; j <= nb; j++)
        row[0][j] = j;
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

/* How many letters both begin with. */
static size_t common_start(const char *a, const char *b)
{
    size_t n = 0;
    while (a[n] && lower(a[n]) == lower(b[n])) n++;
    return n;
}

/* Could `candidate` have been meant?  Not if every letter differs: `q` is no misspelt `y`.  A beginning, as `coord`,
 * and a longer one with another last letter, as `coords`, are taken for the word. */
static bool near_enough(const char *word, size_t nw, const char *candidate, size_t nc, size_t apart)
{
    size_t allowed = nw <= 4 ? 1 : nw <= 8 ? 2 : 3;
    size_t shorter = smaller(nw, nc), longer = nw + nc - shorter;
    if (apart <= allowed && apart < longer)
        return true;
    size_t common = common_start(word, candidate);
    return (shorter >= 3 && common == shorter) || (shorter >= 6 && common + 1 == shorter);
}

const char *nh_text_nearest(const char *word, const char *const *candidates, size_t count)
{
    const char *nearest = NULL;
    size_t least = 0, nw = strlen(word);
    if (nw == 0 || nw > WORD_MAX)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        size_t nc = strlen(candidates[i]);
        if (nc > WORD_MAX)
            continue;
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
        if (((unsigned char)*string & 0xC0) != 0x80)
            width++;
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
