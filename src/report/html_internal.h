/* What the sections of the page share. */
#ifndef NH_HTML_INTERNAL_H
#define NH_HTML_INTERNAL_H

#include "report/html.h"
#include "report/svg.h"

typedef struct {
    const nh_result *r;
    nh_text *out;
    size_t figures;
    nh_figure_sink *sink; /* NULL: figures go onto the page */
    void *context;
} nh_html_writer;

/* ---- parts ---- */

void nh_html_add(nh_html_writer *w, const char *markup);
void nh_html_text(nh_html_writer *w, const char *text);                 /* escaped */
void nh_html_tagged(nh_html_writer *w, const char *tag, const char *text); /* <tag>text</tag> */
/* A number with so many significant digits; a dash when it is not finite. */
void nh_html_number(nh_html_writer *w, double value, int digits);
void nh_html_count(nh_html_writer *w, size_t value);
/* A text of the expression language as a formula, broken between the terms of a sum; as code when it is too wide or no formula. */
void nh_html_source(nh_html_writer *w, const char *text);
/* label = e, with the user's abbreviations; when it is too long for a page, how long it is.  label may be "". */
void nh_html_formula(nh_html_writer *w, const char *label, nh_ex e);
/* A figure with its caption; the plot gets an id. */
void nh_html_figure(nh_html_writer *w, nh_plot *plot, const char *caption);

/* ---- sections, in the order of the page ---- */

void nh_html_system(nh_html_writer *w);
void nh_html_currents(nh_html_writer *w);
void nh_html_evidence(nh_html_writer *w);
void nh_html_motion(nh_html_writer *w);
void nh_html_repeat(nh_html_writer *w);

/* The plots of these sections alone. */
void nh_html_motion_plots(nh_html_writer *w);
void nh_html_evidence_plots(nh_html_writer *w);

extern const char *const nh_html_style;
extern const char *const nh_html_script;

#endif
