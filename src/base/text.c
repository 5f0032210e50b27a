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

/* 15 digits are what a decimal survives, 17 what a double needs; the first that reads back is the shortest. */
void nh_text_number(double value, char *out, size_t size)
{
    if (isnan(value)) {
        snprintf(out, size, "nan"); /* printf would write "-nan" for some */
        return;
    }
    if (value == 0)
        value = 0; /* "-0" means nothing to a reader */
    char digits[32] = "";
    for (int precision = 15; precision <= 17; precision++) {
        snprintf(digits, sizeof digits, "%.*g", precision, value);
        if (strtod(digits, NULL) == value)
            break;
    }
    snprintf(out, size, "%s", digits);
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

static bool is_prefix(const char *a, const char *b, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (lower(a[i]) != lower(b[i]))
            return false;
    return true;
}

/* Could `candidate` have been meant?  Not if every letter differs: `q` is no misspelt `y`. */
static bool near_enough(const char *word, size_t nw, const char *candidate, size_t nc, size_t apart)
{
    size_t allowed = nw <= 4 ? 1 : nw <= 8 ? 2 : 3;
    size_t shorter = smaller(nw, nc), longer = nw + nc - shorter;
    if (apart <= allowed && apart < longer)
        return true;
    return shorter >= 3 && is_prefix(word, candidate, shorter);
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
