/* constant_text: the value of an expression of numbers, as people write numbers: 2*pi, 90deg, 1/3. */
#ifndef NH_CONSTANT_TEXT_H
#define NH_CONSTANT_TEXT_H

#include <stdbool.h>

/* False, with *out unchanged, where the text is no expression of numbers with a finite value. */
bool nh_constant_text(const char *text, double *out);

#endif
