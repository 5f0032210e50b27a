#include "base/escape.h"

enum { LONGEST_CHARACTER = 4 }; /* bytes in UTF-8 */

/* What is left of the text, at most a character: the whole of a long one is not measured for each of them. */
static size_t left_of(const char *text)
{
    size_t left = 0;
    while (left < LONGEST_CHARACTER && text[left]) left++;
    return left;
}

static bool leads(char c) { return ((unsigned char)c & 0xC0) != 0x80; }

/* By the table of RFC 3629. */
size_t nh_utf8_decode(const char *text, size_t left, uint32_t *code)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    unsigned char lead = (unsigned char)text[0];
    size_t length = lead < 0x80 ? 1 : lead < 0xC0 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF8 ? 4 : 0;
    if (length == 0 || length > left) return 0;
    *code = length == 1 ? lead : lead & (0x7Fu >> length);
    for (size_t i = 1; i < length; i++) {
        if (leads(text[i])) return 0;
        *code = *code << 6 | ((unsigned char)text[i] & 0x3Fu);
    }
    bool surrogate = *code >= 0xD800 && *code <= 0xDFFF;
    return *code < least[length] || surrogate || *code > 0x10FFFF ? 0 : length;
}

void nh_utf8_add(nh_text *out, uint32_t code)
{
    static const unsigned char lead[] = {0, 0, 0xC0, 0xE0, 0xF0};
    size_t length = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    char bytes[4];
    for (size_t i = length; i-- > 1; code >>= 6) bytes[i] = (char)(0x80 | (code & 0x3F));
    bytes[0] = (char)(lead[length] | code);
    nh_text_add_n(out, bytes, length);
}

void nh_utf8_mend(const char *text, nh_text *out)
{
    for (size_t length; *text; text += length ? length : 1) {
        uint32_t code;
        length = nh_utf8_decode(text, left_of(text), &code);
        if (length) nh_text_add_n(out, text, length);
        else nh_utf8_add(out, 0xFFFD);
    }
}

bool nh_is_invisible(uint32_t code)
{
    if (code < 0x20) return code != '\t' && code != '\n' && code != '\r';
    bool turns = code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
                 (code >= 0x2066 && code <= 0x2069);
    return turns || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 || code == 0xFEFF ||
           code == 0xFFFE || code == 0xFFFF;
}

/* Reads the next character of the text, whose length goes to *bytes; '?' where it is invisible or not UTF-8. */
static const char *next(const char *text, size_t *bytes, size_t *written)
{
    uint32_t code = 0;
    size_t length = nh_utf8_decode(text, left_of(text), &code);
    bool good = length && !nh_is_invisible(code);
    *bytes = length ? length : 1;
    *written = good ? length : 1;
    return good ? text : "?";
}

static bool is_space(char c) { return c == '\n' || c == '\r' || c == '\t'; }

void nh_escape_line(const char *text, nh_text *out)
{
    for (size_t bytes, written; *text; text += bytes) {
        const char *c = next(text, &bytes, &written);
        nh_text_add_n(out, is_space(*c) ? " " : c, written);
    }
}

void nh_escape_c_comment(const char *text, nh_text *out)
{
    char last = ' ';
    for (size_t bytes, written; *text; text += bytes) {
        const char *c = next(text, &bytes, &written);
        char now = is_space(*c) ? ' ' : *c;
        bool pair = (last == '*' && now == '/') || (last == '/' && now == '*') || (last == '?' && now == '?');
        if (pair) nh_text_add(out, " ");
        nh_text_add_n(out, is_space(*c) ? " " : c, written);
        last = now;
    }
    /* whatever character follows */
    if (last == '*' || last == '/' || last == '?' || last == '\\') nh_text_add(out, " ");
}

void nh_escape_xml(const char *text, nh_text *out)
{
    for (size_t bytes, written; *text; text += bytes) {
        const char *c = next(text, &bytes, &written);
        switch (*c) {
        case '<': nh_text_add(out, "&lt;"); break;
        case '>': nh_text_add(out, "&gt;"); break;
        case '&': nh_text_add(out, "&amp;"); break;
        case '"': nh_text_add(out, "&quot;"); break;
        case '\'': nh_text_add(out, "&#39;"); break;
        default: nh_text_add_n(out, c, written);
        }
    }
}

void nh_escape_terminal(const char *text, nh_text *out)
{
    for (size_t bytes, written; *text; text += bytes) {
        const char *c = next(text, &bytes, &written);
        /* a carriage return alone would overwrite the line */
        nh_text_add_n(out, *c == '\r' && text[1] != '\n' ? "?" : c, written);
    }
}

void nh_escape_csv(const char *text, nh_text *out)
{
    nh_text_add(out, "\"");
    for (; *text; text++) nh_text_add(out, *text == '"' ? "\"\"" : (const char[]){*text, 0});
    nh_text_add(out, "\"");
}
