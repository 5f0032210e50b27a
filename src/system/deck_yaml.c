/* deck_yaml: see deck_yaml.h.
 *
 * Most of these errors come from an expression that YAML reads in another way, so that most hints say where quotes
 * help. */
#include "system/deck_internal.h"

#include <ctype.h>
#include <string.h>

typedef struct {
    const char *problem, *context; /* parts of libyaml's words; a NULL context matches any */
    bool at_context;               /* point at the context, where the misunderstanding began */
    const char *what;              /* NULL: a value cannot begin with the character there */
    const char *hint;
} rewording;

static const rewording table[] = {
    {"cannot start any token", NULL, false, NULL, NH_DECK_QUOTE_HINT},
    {"alphabetic or numeric", NULL, true, NULL, NH_DECK_QUOTE_HINT},
    {"undefined tag handle", NULL, true, NULL, NH_DECK_QUOTE_HINT},
    {"incompatible YAML document", NULL, false, "unsupported version of YAML", "remove this line"},
    {"", "block scalar", true, NULL, NH_DECK_QUOTE_HINT},
    {"", "a tag", true, NULL, NH_DECK_QUOTE_HINT},
    {"", "directive", true, "YAML reads a line that begins with `%` as a directive", NH_DECK_QUOTE_HINT},
    {"unexpected end of stream", "quoted scalar", true, "this quote is not closed",
     "a value that begins with a quote ends with the same quote; an expression that begins with one goes into double "
     "quotes"},
    {"document indicator", "quoted scalar", true, "this quote is not closed",
     "close it before the line that begins with --- or ..."},
    {"mapping values are not allowed", NULL, false, "this `:` is not allowed here",
     "put a text that contains `: ` in double quotes; keys of one map begin in the same column"},
    {"find expected ':'", "simple key", true, "expected `key: value`",
     "write a space after the colon; indent a continued value deeper than its key"},
    {"block sequence entries", NULL, false, "a list item `- ` is not allowed here",
     "begin the list on a line of its own, or put the expression in double quotes"},
    {"mapping keys are not allowed", NULL, false, NULL, NH_DECK_QUOTE_HINT},
    {"node content", NULL, false, "expected a value here",
     "write the value, or put an expression with commas in double quotes"},
    {"<document start>", NULL, false, "this line does not continue the text above",
     "keys of one map begin in the same column; put an expression with quotes or brackets in double quotes"},
    {"unexpected ':'", NULL, false, "this `:` is not allowed here", NH_DECK_QUOTE_HINT},
};

/* Only blanks between `from` and the end? */
static bool nothing_after(const nh_deck *deck, size_t from)
{
    while (from < deck->length && nh_deck_is_space(deck->source[from])) from++;
    return from == deck->length;
}

static size_t line_of(const nh_deck *deck, size_t byte)
{
    size_t line, column;
    nh_deck_place(deck, byte, &line, &column);
    return line;
}

/* Inside { } or [ ] there is neither a comma nor the closing bracket. */
static bool explain_bracket(const nh_deck *deck, size_t at, size_t since, nh_error *error)
{
    bool map = deck->source[since] == '{';
    char open = map ? '{' : '[', close = map ? '}' : ']';
    size_t line = line_of(deck, since);
    if (nothing_after(deck, at)) {
        nh_deck_fail_at(deck, since, error, "this `%c` is not closed", open);
        return nh_error_hint(error, "add `%c`, or write an expression that contains `%c` in double quotes", close,
                             open);
    }
    nh_deck_fail_at(deck, at, error, "expected `,` or `%c` in the %s that begins with `%c` in line %zu", close,
                    map ? "map" : "list", open, line);
    if (line_of(deck, at) != line) return nh_error_hint(error, "is the `%c` in line %zu closed?", open, line);
    if (map && deck->source[at] == ':') return nh_error_hint(error, "is there a `,` before each key?");
    return nh_error_hint(error, NH_DECK_QUOTE_HINT);
}

/* A line that belongs neither to its map nor to its list; or text after a value, as the + 1 of `x: 'a' + 1`. */
static bool explain_misfit(const nh_deck *deck, size_t at, const char *kind, size_t since, nh_error *error)
{
    size_t before = at;
    if (deck->source[at] == ':') {
        nh_deck_fail_at(deck, at, error, "there is no key before the `:`");
        return nh_error_hint(error, "write `key: value`");
    }
    while (before > 0 && (deck->source[before - 1] == ' ' || deck->source[before - 1] == '\t')) before--;
    if (before > 0 && !nh_deck_is_break(deck->source[before - 1])) {
        nh_deck_fail_at(deck, at, error, "unexpected text after the end of the value");
        return deck->source[at] == ',' ? nh_error_hint(error, "a list of several values stands in brackets, [ and ]")
                                       : nh_error_hint(error, NH_DECK_QUOTE_HINT ", all of it");
    }
    nh_deck_fail_at(deck, at, error, "this line does not fit the %s that begins in line %zu", kind,
                    line_of(deck, since));
    return nh_error_hint(error, "start all entries of a map, and all items of a list, in the same column");
}

static bool explain_tab(const nh_deck *deck, size_t at, nh_error *error)
{
    nh_deck_fail_at(deck, at, error, "YAML needs spaces here, not a tab");
    return nh_error_hint(error, "indent with spaces");
}

/* libyaml stands at the backslash or behind the letter that follows it. */
static bool explain_escape(const nh_deck *deck, size_t at, nh_error *error)
{
    while (at > 0 && deck->source[at] != '\\') at--;
    nh_deck_fail_at(deck, at, error, "a backslash in double quotes begins an escape sequence; this is not one");
    return nh_error_hint(error, "write \\\\ for a backslash, or use single quotes");
}

/* The line in which the byte stands, as it is meant: `L = x` or `L:x` for `L: x`, `a: b: 1` for `a: {b: 1}`. */
static bool hint_line(const nh_deck *deck, size_t at, nh_error *error)
{
    const char *source = deck->source;
    while (at > 0 && !nh_deck_is_break(source[at - 1])) at--;
    size_t end = at, key, next;
    while (end < deck->length && !nh_deck_is_break(source[end])) end++;
    while (at < end && source[at] == ' ') at++;
    for (key = at; key < end && (isalnum((unsigned char)source[key]) || source[key] == '_'); key++) continue;
    for (next = key; next < end && source[next] == ' '; next++) continue;
    if (key == at || next + 1 >= end) return false;
    const char *rest = source + next + 1 + strspn(source + next + 1, " ");
    int length = (int)(source + end - rest), word = (int)(key - at);
    if (length <= 0 || length > 120) return false;
    bool top = !at || nh_deck_is_break(source[at - 1]);
    if (source[next] == '=' && top && strpbrk(rest, "+-*/^(") && strpbrk(rest, "+-*/^(") < rest + length)
        return nh_error_hint(error,
                             "write `%.*s: %.*s` if this is a key; other quantities stand under `definitions:`, "
                             "as `- %.*s = %.*s`",
                             word, source + at, length, rest, word, source + at, length, rest),
               true;
    if (source[next] == '=')
        return nh_error_hint(error, "write a colon after the key: `%.*s: %.*s`", word, source + at, length, rest), true;
    if (source[next] != ':') return false;
    if (source[next + 1] != ' ')
        return nh_error_hint(error, "write a space after the colon: `%.*s: %.*s`", word, source + at, length, rest),
               true;
    const char *value = nh_arena_strndup(deck->arena, rest, (size_t)length);
    return strchr(value, ':') && !strpbrk(value, "{}[]\"'") &&
           (nh_error_hint(error, "write `%.*s: {%.*s}`", word, source + at, length, rest), true);
}

static bool matches(const rewording *row, const char *problem, const char *context)
{
    return strstr(problem, row->problem) && (!row->context || (context && strstr(context, row->context)));
}

/* The place of an end of file on an empty line: the last word. */
static size_t visible(const nh_deck *deck, size_t at)
{
    if (nothing_after(deck, at))
        while (at > 0 && nh_deck_is_space(deck->source[at - 1])) at--;
    return at;
}

/* The line before, if it is `name = ...`: with it, this one is a single text; else `at`. */
static size_t equation_before(const nh_deck *deck, size_t at)
{
    size_t line = at;
    while (line > 0 && !nh_deck_is_break(deck->source[line - 1])) line--;
    size_t before = line ? line - 1 : 0;
    while (before > 0 && !nh_deck_is_break(deck->source[before - 1])) before--;
    size_t word = before;
    while (isalnum((unsigned char)deck->source[word]) || deck->source[word] == '_') word++;
    size_t sign = word + strspn(deck->source + word, " ");
    return line && word > before && deck->source[sign] == '=' ? before : at;
}

bool nh_deck_explain(const nh_deck *deck, const char *problem, size_t at, const char *context, size_t since,
                     nh_error *error)
{
    if (deck->source[at] == '\t' || strstr(problem, "tab character")) return explain_tab(deck, at, error);
    if (strstr(problem, "expected ',' or")) return explain_bracket(deck, at, since, error);
    if (strstr(problem, "did not find expected key")) return explain_misfit(deck, at, "map", since, error);
    if (strstr(problem, "'-' indicator")) return explain_misfit(deck, at, "list", since, error);
    if (strstr(problem, "escape c") || strstr(problem, "hexdecimal")) return explain_escape(deck, at, error);
    at = visible(deck, at);
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        const rewording *row = &table[i];
        if (!matches(row, problem, context)) continue;
        size_t spot = row->at_context ? since : at, equation = equation_before(deck, spot);
        if (!row->context && strstr(row->problem, "mapping values") && equation < spot) {
            nh_deck_fail_at(deck, equation, error, "expected `key: value`");
            if (hint_line(deck, equation, error)) return false;
        }
        if (row->what) nh_deck_fail_at(deck, spot, error, "%s", row->what);
        else nh_deck_fail_at(deck, spot, error, "a value cannot begin with `%.1s`", deck->source + spot);
        if (row->what && strchr(row->what, ':') && hint_line(deck, spot, error)) return false;
        return nh_error_hint(error, "%s", row->hint);
    }
    return nh_deck_fail_at(deck, at, error, "this is not YAML: %s%s%s", context ? context : "", context ? ", " : "",
                           problem);
}
