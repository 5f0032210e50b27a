/* form: the forms that a document has. */
#ifndef NH_FORM_H
#define NH_FORM_H

#include <stdbool.h>

/* The forms of documents that have an option of the command line: its name, which is that of the ink nh_pen_NAME, too;
 * the form; the member of nh_pen that the ink writes to. */
#define NH_PEN_FORM_TABLE(X)    \
    X(html, NH_PEN_PAGE, page)  \
    X(tex,  NH_PEN_LATEX, tex)

#define X(name, form, writer) form,
typedef enum { NH_PEN_FORM_TABLE(X) NH_PEN_TEXT } nh_pen_form;
#undef X

/* `fragment`: LaTeX without the lines before and after the body.  `verbose`: with all the numbers.  `colour`: a
   terminal that has it. */
typedef struct {
    nh_pen_form form;
    bool fragment, verbose, colour;
} nh_pen_style;

#endif
