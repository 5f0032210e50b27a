/* typeset: formulas for the eye.
 *
 * From the text of an expression or equation, as a user wrote it or as nh_print wrote it, to MathML [w3.org/TR/mathml-core] or LaTeX: the
 * choices of the text (order of terms, what is factored out) are kept.  x' becomes a dot, Greek names become letters, x_1 and x1 get subscripts. */
#ifndef NH_TYPESET_H
#define NH_TYPESET_H

#include <stdbool.h>

#include "base/text.h"

typedef enum { NH_MATHML, NH_LATEX } nh_typeset_form;

/* Adds the formula, without <math> or $, to `out`.  False, and nothing added, when the text is not one of the language, or nested too deep. */
bool nh_typeset(const char *text, nh_typeset_form form, nh_text *out);

/* A name for labels of plots, as plain text: phi1' becomes φ1′. */
void nh_typeset_plain(const char *name, nh_text *out);

/* The pieces that a line may be broken before: the terms of a sum, each with its sign; of a long product or fraction, those of its longest sum.  Returns how many there are, calling `piece` for
 * each with the formula of it; 0 as above. */
typedef void nh_typeset_piece(void *context, const char *formula);
size_t nh_typeset_pieces(const char *text, nh_typeset_form form, nh_typeset_piece *piece, void *context);

/* MathML in pieces that are at most `widest` symbols wide, as far as a formula can be taken apart: what is too wide is broken inside products, fractions and
 * parentheses, too.  Between two pieces a line may end.  As above otherwise. */
size_t nh_typeset_lines(const char *text, size_t widest, nh_typeset_piece *piece, void *context);

#endif
