/* escape: escapes text from files and command lines for the output language.  (LaTeX's running text is
   document/tex_parts.c, JSON is json.c.) */
#ifndef NH_ESCAPE_H
#define NH_ESCAPE_H

#include <stdint.h>

#include "base/text.h"

/* One character of UTF-8: its length and *code; 0 when it is none (overlong, surrogate, cut off). */
size_t nh_utf8_decode(const char *text, size_t left, uint32_t *code);

/* Control characters, separators that editors do not show, and those that turn the direction of text (U+061C, U+200E,
 * U+200F, U+202A to U+202E, U+2066 to U+2069), by which a line can read otherwise than it is; not tabs and ends of
 * lines. */
bool nh_is_invisible(uint32_t code);

/* One line: ends of lines and tabs are blanks, what is invisible is a question mark.  The text of a comment that ends
   with its line (LaTeX). */
void nh_escape_line(const char *text, nh_text *out);
/* Between the signs of a comment in C: one line that neither ends it, opens another nor has trigraphs. */
void nh_escape_c_comment(const char *text, nh_text *out);
/* A field of a table of comma-separated values (RFC 4180), always in quotation marks. */
void nh_escape_csv(const char *text, nh_text *out);
/* XML: SVG, MathML, HTML, in text and in attributes. */
void nh_escape_xml(const char *text, nh_text *out);
/* Lines for a terminal: what could command it is a question mark. */
void nh_escape_terminal(const char *text, nh_text *out);

#endif
