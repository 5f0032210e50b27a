/* deck_internal: see deck_internal.h. */
#include "system/deck_internal.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/escape.h"

bool nh_deck_is_break(char c) { return c == '\n' || c == '\r'; }

bool nh_deck_is_space(char c) { return c == ' ' || c == '\t' || nh_deck_is_break(c); }

/* Every UTF-8 character has exactly one byte that is not of the form 10xxxxxx. */
static bool leads(char c) { return ((unsigned char)c & 0xC0) != 0x80; }

static void add_line(nh_deck *deck, size_t byte)
{
    nh_grow(&deck->line, &deck->line_capacity, deck->lines + 1, sizeof *deck->line);
    deck->line[deck->lines++] = byte;
}

/* Lines end as editors count them: at \n, \r\n or a lone \r. */
static void index_source(nh_deck *deck)
{
    const char *s = deck->source;
    size_t code_points = 0;
    deck->before = nh_alloc_array(deck->length / NH_DECK_BLOCK + 1, sizeof *deck->before);
    add_line(deck, 0);
    for (size_t i = 0; i <= deck->length; i++) {
        if (i % NH_DECK_BLOCK == 0) deck->before[i / NH_DECK_BLOCK] = code_points;
        if (i == deck->length) break;
        code_points += leads(s[i]);
        if (s[i] == '\n' || (s[i] == '\r' && s[i + 1] != '\n')) add_line(deck, i + 1);
    }
}

nh_deck *nh_deck_create(const char *name, const char *text, size_t length)
{
    static const char mark[] = "\xEF\xBB\xBF";
    nh_deck *deck = nh_alloc(sizeof *deck);
    size_t skip = length >= 3 && memcmp(text, mark, 3) == 0 ? 3 : 0;
    deck->arena = nh_arena_create();
    deck->name = nh_arena_strdup(deck->arena, name);
    deck->length = length - skip;
    deck->source = nh_arena_alloc(deck->arena, deck->length + 1);
    if (deck->length) memcpy(deck->source, text + skip, deck->length);
    index_source(deck);
    return deck;
}

void nh_deck_free(nh_deck *deck)
{
    if (!deck) return;
    nh_deck_free(deck->included);
    nh_free(deck->before);
    nh_free(deck->line);
    nh_arena_free(deck->arena);
    nh_free(deck);
}

/* The number of code points before `byte`. */
static size_t code_point_of(const nh_deck *deck, size_t byte)
{
    size_t block = byte / NH_DECK_BLOCK, count = deck->before[block];
    for (size_t i = block * NH_DECK_BLOCK; i < byte; i++) count += leads(deck->source[i]);
    return count;
}

size_t nh_deck_byte_of(const nh_deck *deck, size_t code_point)
{
    size_t low = 0, high = deck->length / NH_DECK_BLOCK + 1;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (deck->before[middle] <= code_point) low = middle;
        else high = middle;
    }
    size_t byte = low * NH_DECK_BLOCK, count = deck->before[low];
    for (; byte < deck->length; byte++)
        if (leads(deck->source[byte]) && count++ == code_point) break;
    return byte;
}

void nh_deck_place(const nh_deck *deck, size_t byte, size_t *line, size_t *column)
{
    size_t low = 0, high = deck->lines;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (deck->line[middle] <= byte) low = middle;
        else high = middle;
    }
    *line = low + 1;
    *column = code_point_of(deck, byte) - code_point_of(deck, deck->line[low]) + 1;
}

/* The line as "  ...\n  ^"; a long one through a window around the caret.  Columns count from 0 here. */
static void excerpt(const nh_deck *deck, size_t line, size_t caret, char *out, size_t size)
{
    enum { WINDOW = 100 };
    static const char dots[] = "…";
    size_t begin = deck->line[line - 1], end = begin, width = 0, column = 0;
    while (end < deck->length && !nh_deck_is_break(deck->source[end])) width += leads(deck->source[end++]);
    size_t from = width <= WINDOW || caret < WINDOW / 2 ? 0 : caret - WINDOW / 2;
    if (width > WINDOW && from + WINDOW > width) from = width - WINDOW;
    size_t to = from + WINDOW;
    nh_text text;
    nh_text_init(&text);
    nh_text_add(&text, from > 0 ? "  …" : "  ");
    for (size_t i = begin; i < end; i++) {
        column += leads(deck->source[i]); /* of this character, from 1 */
        if (column > from && column <= to) nh_text_add_n(&text, deck->source[i] == '\t' ? " " : deck->source + i, 1);
    }
    nh_text_addf(&text, "%s\n  %*s^", width > to ? dots : "", (int)(caret - from + (from > 0)), "");
    snprintf(out, size, "%s", nh_text_string(&text));
    nh_text_clear(&text);
}

bool nh_deck_fail_hidden(const char *name, nh_error *error)
{
    nh_error_clear(error);
    nh_fail(error, NH_INPUT, name, "this included file is no part of a system");
    return nh_error_hint(error, "what is wrong in it is shown where its name ends in .yaml, .yml, .urdf or .xml");
}

bool nh_deck_fail_at(const nh_deck *deck, size_t byte, nh_error *error, const char *format, ...)
{
    if (!error || error->code != NH_OK) return false;
    if (deck->hidden) return nh_deck_fail_hidden(deck->name, error);
    char what[2 * sizeof error->what], where[2 * sizeof error->where];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    size_t line, column;
    while (byte > 0 && byte < deck->length && !leads(deck->source[byte])) byte--;
    nh_deck_place(deck, byte, &line, &column);
    size_t room = sizeof where / 2, skip = strlen(deck->name) > room ? strlen(deck->name) - room : 0;
    if (deck->code == NH_OK) snprintf(where, sizeof where, "%s:%zu:%zu", deck->name + skip, line, column);
    else snprintf(where, sizeof where, "%s:%zu", deck->name + skip, column);
    nh_fail(error, deck->code == NH_OK ? NH_INPUT : deck->code, where, "%s", what);
    excerpt(deck, line, column - 1, error->excerpt, sizeof error->excerpt);
    return false;
}

bool nh_deck_fail_typed(const char *option, const char *typed, size_t at, nh_error *error, const char *format, ...)
{
    nh_deck *deck = nh_deck_create(option, typed, strlen(typed));
    char what[2 * sizeof error->what];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    deck->code = NH_USAGE;
    nh_deck_fail_at(deck, at, error, "%s", what);
    nh_deck_free(deck);
    return false;
}

void nh_deck_shorten(const char *text, char out[NH_DECK_SHOWN])
{
    enum { MOST = 40 };
    size_t used = 0, column = 0;
    for (; *text; text++) {
        column += leads(*text);
        if (column > MOST || used > NH_DECK_SHOWN - 8) {
            memcpy(out + used, "…", strlen("…"));
            used += strlen("…");
            break;
        }
        out[used++] = nh_deck_is_space(*text) ? ' ' : *text;
    }
    out[used] = '\0';
}

/* Records what is wrong with the character at `byte`; true when nothing is. */
static bool judge(const nh_deck *deck, size_t byte, unsigned char original, size_t length, uint32_t code,
                  nh_error *error)
{
    if (length == 0) {
        nh_deck_fail_at(deck, byte, error, "the byte 0x%02X is not part of UTF-8 text", original);
        return nh_error_hint(error, "save the file in the encoding UTF-8");
    }
    if (code == 0) {
        nh_deck_fail_at(deck, byte, error, "there is a NUL byte in the text");
        return nh_error_hint(error, "is this a text file?");
    }
    nh_deck_fail_at(deck, byte, error, "there is an invisible character (U+%04X) in the text", (unsigned)code);
    return nh_error_hint(error, "remove it, or write a space or a new line instead");
}

/* The bad bytes become '?' in the deck's copy: the file is refused anyway, and its excerpt must be printable. */
bool nh_deck_check_text(nh_deck *deck, nh_error *error)
{
    size_t first = SIZE_MAX, first_length = 0;
    uint32_t first_code = 0;
    unsigned char original = 0;
    for (size_t i = 0, length; i < deck->length; i += length ? length : 1) {
        uint32_t code = 0;
        length = nh_utf8_decode(deck->source + i, deck->length - i, &code);
        if (length && !nh_is_invisible(code)) continue;
        if (first == SIZE_MAX) {
            first = i;
            first_length = length;
            first_code = code;
            original = (unsigned char)deck->source[i];
        }
        memset(deck->source + i, '?', length ? length : 1);
    }
    if (first == SIZE_MAX) return true;
    nh_free(deck->before);
    deck->lines = 0;
    index_source(deck); /* the replaced bytes count as characters of their own */
    return judge(deck, first, original, first_length, first_code, error);
}
