/* html: pages, which are self-contained: no network, no other file.
 *
 * Pages are well-formed XML.  Every number stands in <data value="..."> with all its digits, as the JSON has it; plots
 * are inline SVG, formulas MathML.  Text from files is escaped.  The script on the page draws the motion from the same
 * data as the JSON. */
#ifndef NH_HTML_H
#define NH_HTML_H

#include <stdbool.h>
#include <stddef.h>

/* The figures of a page one by one, each a stand-alone SVG document: returns the next one, NULL after the last, and
 * advances *at. */
const char *nh_html_next_figure(const char **at, size_t *length);
/* Does this text begin like figure number `number`, counted from 1? */
bool nh_html_is_figure(const char *text, size_t number);

#endif
