/* html_internal: declarations for the sections of the pages. */
#ifndef NH_HTML_INTERNAL_H
#define NH_HTML_INTERNAL_H

#include "document/time_series.h"
#include "document/html.h"
#include "document/provenance.h"
#include "document/stage.h"
#include "document/svg.h"

/* A page while it is being written. */
typedef struct {
    nh_text *out;
    const nh_system *system;
    nh_dag *dag;           /* graph of the formulas */
    double shown;          /* option `shown`: longer formulas are only in the JSON */
    double written;        /* option `written` */
    const nh_stage *stage; /* the motion at its top; or NULL */
    bool headed;           /* is its header closed? */
    size_t figures;
    size_t names; /* number of names of repeated parts in this card or chart so far: all are different */
    void (*sink)(void *context, const nh_plot *plot, const char *caption); /* NULL: figures are written to the page */
    void *context;
} nh_html_writer;

/* ---- parts ---- */

void nh_html_add(nh_html_writer *w, const char *markup);
void nh_html_text(nh_html_writer *w, const char *text);                    /* escaped */
void nh_html_prose(nh_html_writer *w, const char *text);                   /* the same, with m^2 as a superscript */
void nh_html_letters(nh_html_writer *w, const char *label);                /* in the language of notation.h */
void nh_html_theory(nh_html_writer *w, const char *words);                 /* words with labels between dollar signs */
void nh_html_tagged(nh_html_writer *w, const char *tag, const char *text); /* <tag>text</tag> */
/* A number with so many significant digits; a dash when it is not finite. */
void nh_html_number(nh_html_writer *w, double value, int digits);
void nh_html_count(nh_html_writer *w, size_t value);
/* A text of the expression language as a formula, broken where a line may end; as code when it is no formula. */
void nh_html_source(nh_html_writer *w, const char *text);
/* Words that end in a list of names in parentheses: the names as formulas. */
void nh_html_chart_name(nh_html_writer *w, const char *name);
/* A figure with its caption; the plot gets an id. */
void nh_html_figure(nh_html_writer *w, nh_plot *plot, const char *caption);
/* Begins a table: its caption and column heads, separated by |; rows follow until the end. */
void nh_html_table(nh_html_writer *w, const char *caption, const char *heads);
void nh_html_table_end(nh_html_writer *w);

/* ---- a page: the title, the answer, links to its sections ("id|name|id|name"), the sections, and how to repeat the
 * run ---- */

void nh_html_begin(nh_html_writer *w, const char *what);
void nh_html_head_end(nh_html_writer *w); /* the end of the header; later calls do nothing */
void nh_html_links(nh_html_writer *w, const char *sections);
/* A section with the meaning of these words of the glossary, separated by blanks as in "current symmetry". */
void nh_html_words(nh_html_writer *w, const char *words);
void nh_html_repeat(nh_html_writer *w, const nh_run *run);
void nh_html_end(nh_html_writer *w);

/* The motion with its quantities, at the top of a page. */
void nh_html_stage(nh_html_writer *w, const nh_stage *stage);
/* Of a motion: its path, or its bodies at one time; all quantities over time. */
void nh_html_still(nh_html_writer *w, const nh_time_series *series);
void nh_html_plots(nh_html_writer *w, const nh_time_series *series);
/* A plot that the page's script draws anew; `what`: its heading, with the unit behind the / of `axis`. */
void nh_html_live_figure(nh_html_writer *w, nh_plot *plot, const char *what, const char *axis);

#endif
