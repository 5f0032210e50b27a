#include "report/facts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

bool nh_facts_number(double value, int digits, nh_shown_number *out)
{
    if (!isfinite(value)) return false;
    nh_text_number(value, out->all, sizeof out->all);
    snprintf(out->mantissa, sizeof out->mantissa, "%.*g", digits, value);
    char *exponent = strchr(out->mantissa, 'e');
    out->has_power = exponent != NULL;
    out->power = 0;
    if (exponent) sscanf(exponent + 1, "%d", &out->power);
    if (exponent) *exponent = 0;
    return true;
}

void nh_facts_spectrum(const nh_spectrum *s, double number[NH_SPECTRUM_NUMBERS])
{
    const double all[NH_SPECTRUM_NUMBERS] = {(double)s->columns, (double)s->rank, (double)s->rows, (double)s->dimension, s->dimension && s->dimension <= s->rank ? s->spectrum[s->dimension - 1] : NAN,
                                             s->dimension < s->rank ? s->spectrum[s->dimension] : NAN, s->gap};
    memcpy(number, all, sizeof all);
}
