/* tex_internal: LaTeX documents, for pdflatex or lualatex with amsmath and pgfplots.
 *
 * Formulas are paragraphs of mathematics, which TeX breaks between the pieces of nh_typeset_pieces; every number is
 * written \nhnumber{all its digits}{as shown}, with the digits of the JSON; plots contain their data. */
#ifndef NH_TEX_INTERNAL_H
#define NH_TEX_INTERNAL_H

#include "document/provenance.h"
#include "document/svg.h"
#include "search/analysis.h"

typedef struct {
    nh_text *out;
    const nh_system *system;
    nh_dag *dag;           /* graph of the formulas */
    double shown, written; /* options: longest formula in the document; in the JSON */
    bool fragment;         /* without preamble and end */
    size_t cells;          /* cells of the row so far */
    size_t names;          /* number of names of repeated parts so far */
} nh_tex_writer;

enum { NH_TEX_WIDEST = 46 }; /* letters in a piece of a formula: much shorter than a line */

/* Defines \nhformula{..}: a formula as a paragraph that TeX breaks between pieces. */
extern const char *const nh_tex_formula_macro;

void nh_tex_add(nh_tex_writer *w, const char *markup);
void nh_tex_words(nh_tex_writer *w, const char *text); /* escaped; letters that pdflatex does not know become [U+...] */
void nh_tex_code(nh_tex_writer *w, const char *text);  /* the same in typewriter, broken anywhere */
/* A number with so many significant digits, and all of them beside it in the source; a dash when it is not finite. */
void nh_tex_number(nh_tex_writer *w, double value, int digits);
void nh_tex_count(nh_tex_writer *w, size_t value);
/* A name within the text, as a formula when it is one of the language. */
void nh_tex_name(nh_tex_writer *w, const char *text);
/* Words that end in a list of names in parentheses: the names as formulas. */
void nh_tex_chart(nh_tex_writer *w, const char *name);
/* The preamble and the title of the system, which `what` follows, unless it is NULL.  The other one: how to repeat the
 * run. */
void nh_tex_head(nh_tex_writer *w, const char *what);
void nh_tex_repeat(nh_tex_writer *w, const nh_run *run);

/* A figure, drawn by pgfplots from the numbers themselves. */
void nh_tex_plot(nh_tex_writer *w, const nh_plot *plot, const char *caption);

#endif
