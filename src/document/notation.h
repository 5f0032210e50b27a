/* notation: the letters of the theory, for labels and for the factors behind coefficients.
 *
 * A label is written once, in a small language, and shown as text (Abar_phi), MathML or LaTeX:
 *
 *     <phi'>            a name of the system, as formulas have it; letters and digits outside of < > likewise
 *     \bar{A} \tilde{Z} \hat{A} \breve{A}   accents;  _{..} ^{..}  scripts behind a name or a closed group
 *     \frac{..}{..}     a fraction, in text with a stroke;  \p  the sign of a partial derivative, \pc and \dcp  those
 *                       with the index c
 *     \form \eps      the letter of the forms phi^a, that of the Euler operators
 *     ( ) [ ] , + - = blank     themselves */
#ifndef NH_NOTATION_H
#define NH_NOTATION_H

#include "base/text.h"

typedef enum { NH_NOTATION_TEXT, NH_NOTATION_MATHML, NH_NOTATION_LATEX } nh_notation_form;

/* Adds the label in one of its forms. */
void nh_notation_write(const char *label, nh_notation_form form, nh_text *out);

/* For words with labels between dollar signs: writes the next part into `part` (the caller clears it), and says whether
 * it is a label; false after the last. */
bool nh_notation_next(const char **words, nh_text *part, bool *label);

#endif
