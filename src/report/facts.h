/* facts: what the page and the LaTeX document say alike, each in its own markup. */
#ifndef NH_FACTS_H
#define NH_FACTS_H

#include "study/result.h"

/* A number for people: all its digits; the shown ones before the power of ten, with a minus sign; whether there is a power.  False: not finite. */
typedef struct {
    char all[40], mantissa[60];
    bool has_power;
    int power;
} nh_shown_number;
bool nh_facts_number(double value, int digits, nh_shown_number *out);

/* One linear problem in numbers, the first of them counts; NAN for what there is not. */
enum { NH_SPECTRUM_COUNTS = 4, NH_SPECTRUM_NUMBERS = 7 };
#define NH_SPECTRUM_HEADS "columns|independent|rows|null values|largest of them|next value|gap"
void nh_facts_spectrum(const nh_spectrum *spectrum, double number[NH_SPECTRUM_NUMBERS]);

#endif
