/* form: the forms of a document. */
#ifndef NH_FORM_H
#define NH_FORM_H

#include <stdbool.h>

/* The forms of documents that have an option on the command line: its name, which is also that of the ink nh_pen_NAME;
 * the form; the member of nh_pen to which the ink writes. */
#define NH_PEN_FORM_TABLE(X)                                                                                           \
    X(html, NH_PEN_PAGE, page)                                                                                         \
    X(tex, NH_PEN_LATEX, tex)

#define X(name, form, writer) form,
typedef enum { NH_PEN_FORM_TABLE(X) NH_PEN_TEXT } nh_pen_form;
#undef X

/* `fragment`: LaTeX without preamble and end.  `verbose`: with all the numbers.  `colour`: for a terminal with
 * colours. */
typedef struct {
    nh_pen_form form;
    bool fragment, verbose, colour;
} nh_pen_style;

#endif
