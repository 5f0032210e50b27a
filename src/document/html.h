/* html: results as self-contained pages: no network, no other file.
 *
 * Pages are well-formed XML.  Every number stands in <data value="..."> with all its digits, as the JSON has it; plots are inline SVG, formulas
 * MathML.  Text from files is escaped.  The script on the page draws what the JSON tells of the motion. */
#ifndef NH_HTML_H
#define NH_HTML_H

#include "base/text.h"
#include "document/provenance.h"
#include "document/svg.h"
#include "commands/reduce.h"
#include "search/analysis.h"
#include "commands/simulate.h"
#include "commands/robustness.h"

void nh_html(const nh_analysis *result, nh_text *out);

/* The figures of a page one by one, each a stand-alone SVG document: where the next begins, NULL after the last.  Moves *at on. */
const char *nh_html_next_figure(const char **at, size_t *length);
/* Does this text begin as the figure of that number does, from 1? */
bool nh_html_is_figure(const char *text, size_t number);

/* The plots of one section of a page, for a report of another form.  They last for the call. */
typedef enum { NH_SECTION_MOTION, NH_SECTION_FIGURES, NH_SECTION_SEARCH } nh_html_section;
typedef void nh_figure_sink(void *context, const nh_plot *plot, const char *caption);
void nh_html_plots(const nh_analysis *result, nh_html_section section, nh_figure_sink *sink, void *context);

#endif
