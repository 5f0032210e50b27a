/* typeset: formulas as MathML and LaTeX.
 *
 * From the text of an expression or equation, as a user wrote it or as nh_print wrote it, to MathML
 * [w3.org/TR/mathml-core] or LaTeX: the choices of the text (order of terms, what is factored out) are kept.  x'
 * becomes a dot, Greek names become letters, x_1 and x1 get subscripts. */
#ifndef NH_TYPESET_H
#define NH_TYPESET_H

#include <stdbool.h>

#include "base/text.h"

typedef enum { NH_MATHML, NH_LATEX } nh_typeset_form;

/* Adds the formula, without <math> or $, to `out`.  False, with nothing added, when the text does not belong to the
 * language, or is nested too deep. */
bool nh_typeset(const char *text, nh_typeset_form form, nh_text *out);

/* A name for labels of plots, as plain text: phi1' becomes φ1′. */
void nh_typeset_plain(const char *name, nh_text *out);

/* The pieces that a line may be broken between, none of them much wider than `widest` letters: the terms of a sum, each
 * with its sign, and the contents of wide terms.  Together they are the formula; in LaTeX each but the first begins
 * with a penalty, as for TeX's own breaking of paragraphs.  Returns how many there are, calling `piece` for each; 0 as
 * above. */
/* Before a factor of the same product: a line that breaks there needs an operator. */
typedef enum { NH_FOLLOWS_NOTHING, NH_FOLLOWS_TERM, NH_FOLLOWS_FACTOR } nh_typeset_follows;
typedef void nh_typeset_piece(void *context, const char *formula, nh_typeset_follows follows);
size_t nh_typeset_pieces(const char *text, nh_typeset_form form, double widest, nh_typeset_piece *piece, void *context);

/* The width of a formula, in letters, about; 0 when the text is no formula. */
double nh_typeset_width(const char *text);

#endif
