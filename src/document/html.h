/* html: pages, which are self-contained: no network, no other file.
 *
 * Pages are well-formed XML.  Every number stands in <data value="..."> with all its digits, as the JSON has it; plots
 * are inline SVG, formulas MathML.  Text from files is escaped.  The script on the page draws what the JSON tells of
 * the motion. */
#ifndef NH_HTML_H
#define NH_HTML_H

#include <stdbool.h>
#include <stddef.h>

/* The figures of a page one by one, each a stand-alone SVG document: where the next begins, NULL after the last.  Moves
   *at on. */
const char *nh_html_next_figure(const char **at, size_t *length);
/* Does this text begin as the figure of that number does, from 1? */
bool nh_html_is_figure(const char *text, size_t number);

#endif
