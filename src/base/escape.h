/* escape: escapes text from files and command lines for the output language.  (LaTeX's running text is
   document/tex_parts.c, JSON is json.c.) */
#ifndef NH_ESCAPE_H
#define NH_ESCAPE_H

#include <stdint.h>

#include "base/text.h"

/* Decodes one character of UTF-8 to *code and returns its length in bytes; 0 when the bytes are no character (overlong,
 * surrogate, cut off). */
size_t nh_utf8_decode(const char *text, size_t left, uint32_t *code);

/* Adds one character. */
void nh_utf8_add(nh_text *out, uint32_t code);

/* Text in which bytes that are no UTF-8 have become U+FFFD. */
void nh_utf8_mend(const char *text, nh_text *out);

/* Control characters, separators that editors do not show, and characters that change the direction of text (U+061C,
 * U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069), so that a line reads otherwise than it is; not tabs and ends of
 * lines. */
bool nh_is_invisible(uint32_t code);

/* Text on one line: ends of lines and tabs become blanks, invisible characters question marks.  For comments that end
 * with their line (LaTeX). */
void nh_escape_line(const char *text, nh_text *out);
/* Text inside a comment of C: one line that does not end the comment, does not open another and has no trigraphs. */
void nh_escape_c_comment(const char *text, nh_text *out);
/* A field of a table of comma-separated values (RFC 4180), always in quotation marks. */
void nh_escape_csv(const char *text, nh_text *out);
/* XML: SVG, MathML, HTML, in text and in attributes. */
void nh_escape_xml(const char *text, nh_text *out);
/* Lines for a terminal: control characters, which a terminal would obey, become question marks. */
void nh_escape_terminal(const char *text, nh_text *out);

#endif
