/* html_internal: declarations for the sections of the pages. */
#ifndef NH_HTML_INTERNAL_H
#define NH_HTML_INTERNAL_H

#include "document/time_series.h"
#include "document/html.h"
#include "document/provenance.h"
#include "document/svg.h"

/* A page while it is written. */
typedef struct {
    nh_text *out;
    const nh_system *system;
    const nh_analysis_file *analysis; /* its abbreviations are used in formulas; or NULL */
    nh_dag *dag;                 /* of the formulas */
    const nh_chart *chart;       /* whose roots are shown as velocities; or NULL */
    double shown;                /* option `shown`: longer formulas are left to the JSON */
    double written;              /* option `written` */
    bool space;                  /* its motion has bodies in space */
    size_t figures;
    size_t names;                /* of repeated parts in this card or chart, so far: no two are alike */
    void (*sink)(void *context, const nh_plot *plot, const char *caption); /* NULL: figures go onto the page */
    void *context;
} nh_html_writer;

/* ---- parts ---- */

void nh_html_add(nh_html_writer *w, const char *markup);
void nh_html_text(nh_html_writer *w, const char *text);                 /* escaped */
void nh_html_prose(nh_html_writer *w, const char *text);                /* the same, with m^2 as people write it */
void nh_html_letters(nh_html_writer *w, const char *label); /* in the language of notation.h */
void nh_html_theory(nh_html_writer *w, const char *words);  /* words with labels between dollar signs */
void nh_html_tagged(nh_html_writer *w, const char *tag, const char *text); /* <tag>text</tag> */
/* A number with so many significant digits; a dash when it is not finite. */
void nh_html_number(nh_html_writer *w, double value, int digits);
void nh_html_count(nh_html_writer *w, size_t value);
/* A text of the expression language as a formula, broken where a line may end; as code when it is no formula. */
void nh_html_source(nh_html_writer *w, const char *text);
/* The same for a name within the text. */
void nh_html_name(nh_html_writer *w, const char *name);
/* Words with a list of names in parentheses at their end, such as a chart has: the names as formulas. */
void nh_html_chart_name(nh_html_writer *w, const char *name);
/* label = e for formulas that belong together, with the user's abbreviations: what occurs in them more than once gets
 * one name for all; or that one is too long for a page.  A label is "", a name, or MathML, which begins with <. */
void nh_html_formulas(nh_html_writer *w, size_t n, const char *const *label, const nh_ex *e);
/* A figure with its caption; the plot gets an id. */
void nh_html_figure(nh_html_writer *w, nh_plot *plot, const char *caption);
/* A table: its caption and column heads, separated by |; rows are between this and the end. */
void nh_html_table(nh_html_writer *w, const char *caption, const char *heads);
void nh_html_table_end(nh_html_writer *w);

/* ---- a page: the title, then the answer, then links to its sections ("id|name|id|name"), then what follows, then how
   to repeat it ---- */

void nh_html_begin(nh_html_writer *w, const char *what);
void nh_html_links(nh_html_writer *w, const char *sections);
/* What these words mean, between blanks as in "current symmetry": a section of its own. */
void nh_html_words(nh_html_writer *w, const char *words);
void nh_html_repeat(nh_html_writer *w, const nh_run *run);
void nh_html_end(nh_html_writer *w);

/* The slider with the drawing, and every line over time. */
void nh_html_time_series(nh_html_writer *w, const nh_time_series *course);

extern const char *const nh_html_font; /* WOFF2 in base 64 */
extern const char *const nh_html_style;
extern const char *const nh_html_script;
extern const char *const nh_html_space; /* of pages with bodies in space, before the other one */

#endif
