/* parse_fault: what is wrong with a text, in words, and the text that would be right. */
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "graph/parse_internal.h"

typedef nh_parser parser;

enum { max_shown = 96 /* bytes of a text that is proposed as a whole */ };

bool nh_parse_fail(parser *p, size_t offset, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(p->fault->what, sizeof p->fault->what, format, list);
    va_end(list);
    p->fault->offset = offset;
    p->fault->hint[0] = 0;
    return false;
}

bool nh_parse_has_no_value(parser *p) { return !(p->fault->undefined = true); }

bool nh_parse_hint(parser *p, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(p->fault->hint, sizeof p->fault->hint, format, list);
    va_end(list);
    return false;
}

/* The bytes [begin, end) of the text around [from, to) that are shown: all, or as many as fit of the term. */
static void shown(const parser *p, size_t from, size_t to, size_t *begin, size_t *end)
{
    static const char ends[] = "+-=,;";
    size_t length = strlen(p->text);
    bool whole = length <= max_shown;
    int open = 0;
    for (*begin = whole ? 0 : from; *begin > 0 && from - *begin < max_shown / 2; --*begin) {
        char c = p->text[*begin - 1];
        open += (c == ')') - (c == '(');
        if (!whole && (open < 0 || (!open && strchr(ends, c)))) break;
    }
    open = 0;
    for (*end = whole ? length : to; *end < length && *end - to < max_shown / 2; ++*end) {
        char c = p->text[*end];
        open += (c == '(') - (c == ')');
        if (!whole && (open < 0 || (!open && strchr(ends, c)))) break;
    }
    while (*begin < from && strchr(" \n", p->text[*begin])) ++*begin;
    while (*end > to && strchr(" \n", p->text[*end - 1])) --*end;
}

/* The text with the change; false: it does not fit. */
static bool changed(const parser *p, nh_parse_change c, char *out, size_t size)
{
    size_t begin, end;
    shown(p, c.from, c.to, &begin, &end);
    int n = snprintf(out, size, "%.*s%s%.*s", (int)(c.from - begin), p->text + begin, c.with, (int)(end - c.to),
                     p->text + c.to);
    return n > 0 && (size_t)n < size;
}

bool nh_parse_propose(parser *p, size_t from, size_t to, const char *with)
{
    char text[sizeof p->fault->hint - 16];
    return changed(p, (nh_parse_change){from, to, with}, text, sizeof text) && nh_parse_hint(p, "write `%s`", text);
}

bool nh_parse_propose_two(parser *p, nh_parse_change one, nh_parse_change other)
{
    char first[sizeof p->fault->hint / 2 - 12], second[sizeof first];
    if (!changed(p, one, first, sizeof first)) return false;
    if (!changed(p, other, second, sizeof second)) return nh_parse_hint(p, "write `%s`", first);
    return nh_parse_hint(p, "write `%s`, or `%s`", first, second);
}

/* A hint for common mistakes: 9,81 for 9.81; two equations in one text; a quote at one end only. */
static bool hint_separator(parser *p)
{
    const char *at = p->text + p->at;
    if (*at == '"') return nh_parse_hint(p, "a value that ends with a quote begins with one, too");
    if (*at != ',') return false;
    if (p->at && isdigit((unsigned char)at[-1]) && isdigit((unsigned char)at[1])) {
        nh_parse_propose(p, p->at, p->at + 1, ".");
        char write[sizeof p->fault->hint];
        strcpy(write, p->fault->hint);
        return nh_parse_hint(p, "decimals are written with a point: %.200s", write);
    }
    if (p->equation) return nh_parse_hint(p, "each equation is an item of its own: [\"x' = y'\", \"y' = z'\"]");
    return false;
}

/* |x| is abs(x), and square brackets are parentheses. */
static bool hint_closed(parser *p, char open)
{
    size_t begin = p->at, end = begin + 1 + strcspn(p->text + begin + 1, open == '[' ? "]" : "|");
    char text[100];
    if (!p->text[end]) return false;
    int n =
        snprintf(text, sizeof text, "%s(%.*s)", open == '[' ? "" : "abs", (int)(end - begin - 1), p->text + begin + 1);
    return n < (int)sizeof text && nh_parse_propose(p, begin, end + 1, text);
}

/* Names the wrong character in words. */
static bool unexpected(parser *p, const char *wanted)
{
    char c = nh_parse_peek(p);
    if (!c) return nh_parse_fail(p, p->at, "the expression ends here, but %s was expected", wanted);
    if ((unsigned char)c >= 0x80) {
        size_t length;
        const char *plain = nh_name_of_sign(p->text + p->at), *letter = nh_name_of_letter(p->text + p->at, &length);
        nh_parse_fail(p, p->at, "a character that the expression language does not have; %s was expected", wanted);
        if (plain) return nh_parse_hint(p, "write `%s`", plain);
        return nh_parse_hint(p, "names consist of the letters a-z, A-Z, digits and _%s%s%s", letter ? ": write `" : "",
                             letter ? letter : "", letter ? "`" : "");
    }
    if (iscntrl((unsigned char)c))
        return nh_parse_fail(p, p->at, "a control character cannot stand here; %s was expected", wanted);
    nh_parse_fail(p, p->at, "`%c` cannot stand here; %s was expected", c, wanted);
    if (c == ',' || c == '"') return hint_separator(p);
    if (c == '\\')
        return nh_parse_hint(p, "of LaTeX, Greek letters, \\dot, \\frac, \\sqrt, \\cdot and functions are read");
    if (c == '|' || c == '[') return hint_closed(p, c);
    if ((c == '<' || c == '>') && p->equation)
        return nh_parse_hint(p, "only equations can be written: where a motion is looked at, `domain:` says");
    if (c == '=' && p->equation) return nh_parse_hint(p, "an equation has one `=` between two expressions");
    if (c == '=')
        return nh_parse_hint(p, "an equation is expected only under constraints, forces, definitions and the map of "
                                "velocities");
    return false;
}

bool nh_parse_no_operator(parser *p, const char *closing)
{
    char c = nh_parse_peek(p);
    long top, bottom;
    size_t fraction = nh_parse_fraction(p->text + p->at, &top, &bottom), end = nh_parse_token_end(p);
    bool operand = fraction || isalnum((unsigned char)c) || c == '_' || nh_parse_begins_name(p) || c == '(';
    if (!operand) return unexpected(p, closing);
    nh_parse_fail(p, p->at, "an operator is missing before this");
    char value[16];
    snprintf(value, sizeof value, "+%ld/%ld", top, bottom);
    if (fraction && p->number_end == end) return nh_parse_propose(p, end, p->at + fraction, value); /* 1½ */
    bool thousands = p->number_end == end && isdigit((unsigned char)c) && strspn(p->text + p->at, "0123456789") == 3;
    return nh_parse_propose(p, end, p->at, thousands ? "" : "*"); /* 1 000 */
}

bool nh_parse_no_operand(parser *p) { return unexpected(p, "a number, a name or `(`"); }
