#include "report/facts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

bool nh_facts_number(double value, int digits, nh_shown_number *out)
{
    if (!isfinite(value)) return false;
    nh_text_number(value, out->all, sizeof out->all);
    char shown[60];
    snprintf(shown, sizeof shown, "%.*g", digits, value);
    char *exponent = strchr(shown, 'e');
    out->minus = shown[0] == '-';
    out->has_power = exponent != NULL;
    out->power = exponent ? atoi(exponent + 1) : 0;
    if (exponent) *exponent = 0;
    snprintf(out->mantissa, sizeof out->mantissa, "%s", shown + out->minus);
    if (out->has_power && !strcmp(out->mantissa, "1")) out->mantissa[0] = 0;
    return true;
}

const char *nh_facts_list(const char *text, char *words, size_t size)
{
    const char *list = strstr(text, " ("), *end = strrchr(text, ')');
    if (!list || !end || end[1]) return NULL;
    snprintf(words, size, "%.*s", (int)(list + 1 - text), text);
    return list + 2;
}

bool nh_facts_next(const char **list, char *name, size_t size)
{
    size_t length = strcspn(*list, ",)");
    if (!length) return false;
    snprintf(name, size, "%.*s", (int)length, *list);
    *list += length;
    *list += strspn(*list, ", ");
    return true;
}

void nh_facts_spectrum(const nh_spectrum *s, double number[NH_SPECTRUM_NUMBERS])
{
    const double all[NH_SPECTRUM_NUMBERS] = {(double)s->columns, (double)s->rank, (double)s->rows, (double)s->dimension, s->dimension && s->dimension <= s->rank ? s->spectrum[s->dimension - 1] : NAN,
                                             s->dimension < s->rank ? s->spectrum[s->dimension] : NAN, s->gap};
    memcpy(number, all, sizeof all);
}
