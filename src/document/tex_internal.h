/* tex_internal: LaTeX documents, for pdflatex or lualatex with amsmath and pgfplots.
 *
 * Formulas are paragraphs of mathematics, which TeX breaks by its own measures between the pieces of nh_typeset_pieces;
 * every number stands in \nhnumber{all its digits}{as shown}, as the JSON has it; plots hold their data. */
#ifndef NH_TEX_INTERNAL_H
#define NH_TEX_INTERNAL_H

#include "document/provenance.h"
#include "document/svg.h"
#include "search/analysis.h"

typedef struct {
    nh_text *out;
    const nh_system *system;
    const nh_analysis_file *analysis; /* its abbreviations are used in formulas; or NULL */
    nh_dag *dag;                      /* of the formulas */
    const nh_chart *chart;            /* whose roots are shown as velocities; or NULL */
    double shown, written;            /* options: longer formulas are left out; are in the JSON */
    bool fragment;                    /* without the lines before and after the body */
    size_t cells;                     /* of the row, so far */
    size_t names;                     /* of repeated parts of formulas, so far */
} nh_tex_writer;

enum { NH_TEX_WIDEST = 46 }; /* letters in a piece of a formula: well within a line */

/* Definition of \nhformula{..}: a formula as a paragraph that TeX breaks between pieces. */
extern const char *const nh_tex_formula_macro;

void nh_tex_add(nh_tex_writer *w, const char *markup);
void nh_tex_words(nh_tex_writer *w, const char *text); /* escaped; letters that pdflatex does not know as [U+...] */
void nh_tex_code(nh_tex_writer *w, const char *text);  /* the same in typewriter, broken anywhere */
/* A number with so many significant digits, and all of them beside it in the source; a dash when it is not finite. */
void nh_tex_number(nh_tex_writer *w, double value, int digits);
void nh_tex_count(nh_tex_writer *w, size_t value);
/* A name within the text, as a formula when it is one of the language. */
void nh_tex_name(nh_tex_writer *w, const char *text);
/* Words with a list of names in parentheses at their end, such as a chart has. */
void nh_tex_chart(nh_tex_writer *w, const char *name);
/* label = text on lines of its own, broken where it is too long; label may be "". */
void nh_tex_display(nh_tex_writer *w, const char *label, const char *text);
/* Formulas under each other, with the user's abbreviations and with names for what is repeated.  Their labels in LaTeX,
 * such as Z_{\dot{x}}, or ""; and as text, for a formula that is nested too deep for LaTeX. */
void nh_tex_formulas(nh_tex_writer *w, size_t n, const char *const *latex, const char *const *plain, const nh_ex *e);

/* What stands before the body; `what` follows the title of the system, or is NULL.  And how to repeat the run. */
void nh_tex_head(nh_tex_writer *w, const char *what);
void nh_tex_repeat(nh_tex_writer *w, const nh_run *run);

/* A figure, drawn by pgfplots from the numbers themselves. */
void nh_tex_plot(nh_tex_writer *w, const nh_plot *plot, const char *caption);

#endif
