/* html: an analysis as one page that needs nothing else: no network, no other file.
 *
 * Well-formed as XML too.  Every number stands in <data value="..."> with all its digits, as the JSON has it; plots are inline SVG, formulas
 * MathML.  Text from files is escaped.  The script on the page draws what nh_result_json tells under validation.motion. */
#ifndef NH_HTML_H
#define NH_HTML_H

#include "base/text.h"
#include "report/svg.h"
#include "study/result.h"

void nh_html(const nh_result *result, nh_text *out);

/* The figures of a page one by one, each a stand-alone SVG document: where the next begins, NULL after the last.  Moves *at on. */
const char *nh_html_next_figure(const char **at, size_t *length);

/* The plots of a page, for a report of another form: those of the motion, then those of the search.  They last for the call. */
typedef void nh_figure_sink(void *context, const nh_plot *plot, const char *caption);
void nh_html_motion_figures(const nh_result *result, nh_figure_sink *sink, void *context);
void nh_html_search_figures(const nh_result *result, nh_figure_sink *sink, void *context);

#endif
