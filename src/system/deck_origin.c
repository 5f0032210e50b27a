/* deck_origin: from a byte of a scalar's text back to the byte of the file that it came from.
 *
 * libyaml returns texts unquoted, unescaped and folded; the source is walked once more in parallel with the text,
 * by the same rules, until the text has advanced by `offset` bytes:
 *
 *     plain, '...', "..."   whitespace with k line breaks -> one space (k = 1) or k - 1 newlines (k > 1)
 *     '...'                 '' -> '
 *     "..."                 \x.. -> one character; \ at the end of a line -> nothing
 *     | and >               the header line and the indentation of each line -> nothing; a line break -> newline,
 *                           space or nothing
 *
 * A wrong turn could only misplace a caret: every loop is bounded by the end of the scalar. */
#include "system/deck_internal.h"

#include <stdlib.h>
#include <string.h>

/* A scalar in the source, being walked: source[at] is where text[done] came from. */
typedef struct {
    const char *source, *text;
    size_t at, end, done;
} walk;

static size_t break_length(const walk *w, size_t at)
{
    return w->source[at] == '\r' && at + 1 < w->end && w->source[at + 1] == '\n' ? 2 : 1;
}

/* Skip whitespace and line breaks from `at`; counts the breaks. */
static size_t skip_space(const walk *w, size_t at, size_t *breaks)
{
    *breaks = 0;
    while (at < w->end && nh_deck_is_space(w->source[at])) {
        if (nh_deck_is_break(w->source[at])) {
            at += break_length(w, at);
            ++*breaks;
        } else {
            at++;
        }
    }
    return at;
}

static size_t utf8_length(unsigned long code) { return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4; }

/* A numeric escape \xHH, \uHHHH, \UHHHHHHHH: `digits` hexadecimal digits after two characters. */
static void step_code(walk *w, size_t digits)
{
    char number[9] = "";
    if (w->at + 2 + digits > w->end) digits = w->end - w->at - 2;
    memcpy(number, w->source + w->at + 2, digits);
    w->done += utf8_length(strtoul(number, NULL, 16));
    w->at += 2 + digits;
}

static void step_escape(walk *w)
{
    size_t breaks;
    if (w->at + 2 > w->end) {
        w->at = w->end;
        return;
    }
    switch (w->source[w->at + 1]) {
    case 'x': step_code(w, 2); return;
    case 'u': step_code(w, 4); return;
    case 'U': step_code(w, 8); return;
    case 'N':
    case '_': w->done += 2; break; /* U+0085, U+00A0 */
    case 'L':
    case 'P': w->done += 3; break; /* U+2028, U+2029 */
    case '\n':
    case '\r':
        w->at = skip_space(w, w->at + 1, &breaks);
        w->done += breaks - 1; /* the first break is swallowed, empty lines after it are not */
        return;
    default: w->done += 1;
    }
    w->at += 2;
}

/* One step through a plain or quoted scalar. */
static void step_flow(walk *w, char quote)
{
    size_t breaks, next = skip_space(w, w->at, &breaks);
    char here = w->source[w->at];
    if (breaks > 0) {
        w->at = next;
        w->done += breaks == 1 ? 1 : breaks - 1;
    } else if (quote == '"' && here == '\\') {
        step_escape(w);
    } else {
        w->at += quote == '\'' && here == '\'' ? 2 : 1;
        w->done++;
    }
}

static size_t find_flow(walk *w, char quote, size_t offset)
{
    size_t last = w->at;
    while (w->done < offset && w->at < w->end) {
        last = w->at;
        step_flow(w, quote);
    }
    if (w->done > offset) /* the byte is inside the result of the last step */
        return last;
    size_t breaks = 0; /* an escaped line break produces nothing: go on to what follows it */
    while (quote == '"' && w->at + 1 < w->end && w->source[w->at] == '\\' && nh_deck_is_break(w->source[w->at + 1])) {
        size_t next = skip_space(w, w->at + 1, &breaks);
        if (breaks > 1) break;
        w->at = next;
    }
    return w->at;
}

/* Spaces before the first character of the first line that has one; the text's lines lost the same number each. */
static size_t margin(const char *text, size_t at, size_t end)
{
    size_t begin = at;
    for (; at < end && nh_deck_is_space(text[at]); at++)
        if (nh_deck_is_break(text[at])) begin = at + 1;
    return at - begin;
}

static void skip_header(walk *w)
{
    while (w->at < w->end && !nh_deck_is_break(w->source[w->at])) w->at++;
    if (w->at < w->end) w->at += break_length(w, w->at);
}

static void skip_indent(walk *w, size_t indent)
{
    for (size_t i = 0; i < indent && w->at < w->end && w->source[w->at] == ' '; i++) w->at++;
}

static size_t find_block(walk *w, size_t offset)
{
    skip_header(w);
    size_t in_source = margin(w->source, w->at, w->end), in_text = margin(w->text, 0, strlen(w->text));
    size_t indent = in_source > in_text ? in_source - in_text : 0;
    skip_indent(w, indent);
    while (w->at < w->end) {
        char here = w->source[w->at], wanted = w->text[w->done];
        bool at_break = nh_deck_is_break(here), kept = wanted == '\n' || wanted == ' ';
        if (w->done >= offset && (!at_break || kept || !wanted)) break;
        if (at_break) {
            w->at += break_length(w, w->at);
            w->done += kept;
            skip_indent(w, indent);
        } else {
            w->at++;
            w->done += wanted != '\0';
        }
    }
    return w->at;
}

/* The place of "unexpected end": right after the last word, not after the blanks and line breaks that follow it. */
static size_t trim(const char *text, size_t offset)
{
    size_t length = strlen(text);
    if (offset > length) offset = length;
    for (size_t i = offset; i < length; i++)
        if (!nh_deck_is_space(text[i])) return offset;
    while (offset > 0 && nh_deck_is_space(text[offset - 1])) offset--;
    return offset;
}

size_t nh_deck_origin(const nh_deck *deck, const nh_deck_node *node, size_t offset)
{
    if (node->kind != NH_DECK_SCALAR || node->begin == node->end) return node->begin;
    walk w = {.source = deck->source, .text = node->text, .at = node->begin, .end = node->end};
    char first = node->plain ? 'a' : deck->source[node->begin];
    offset = trim(node->text, offset);
    if (first == '|' || first == '>') return find_block(&w, offset);
    if (first == '"' || first == '\'') {
        w.at++; /* the quotes themselves are no text */
        w.end = w.end - 1 > w.at ? w.end - 1 : w.at;
        return find_flow(&w, first, offset);
    }
    return find_flow(&w, '\0', offset);
}
