/* spelling: an expression with the signs of books and of LaTeX, in the signs of the language. */
#ifndef NH_SPELLING_H
#define NH_SPELLING_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    const char *text;
    char *own;      /* of the caller's text a changed copy, or NULL */
    size_t *origin; /* byte of the caller's text from which each byte of `own` comes */
    size_t length;
} nh_spelling;

/* A minus sign, a dot or cross for `*`, a division sign, quotes and primes for ', dots over letters, superscripts, the
 * degree sign (deg), the root sign, blanks of any width, and of LaTeX \dot, \ddot, \frac, \sqrt, \cdot, \times, \left,
 * \right, spaces, braces and functions.  A text without any of them is its own spelling.  Greek letters stay: they are
 * parts of names (nh_name_spelled). */
nh_spelling nh_spelling_of(const char *text);
void nh_spelling_clear(nh_spelling *spelling);
/* The place in the caller's text of a place in the spelling. */
size_t nh_spelling_origin(const nh_spelling *spelling, size_t at);

#endif
