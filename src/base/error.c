/* error: see error.h.  Messages are cut to their fixed fields, never in the middle of a UTF-8 character. */
#include "base/error.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

void nh_error_clear(nh_error *error)
{
    if (error) memset(error, 0, sizeof *error);
}

/* snprintf cuts at bytes: drop a UTF-8 character that was cut in two at the end of `text`. */
static void mend_tail(char *text)
{
    size_t length = strlen(text), begin = length;
    while (begin > 0 && ((unsigned char)text[begin - 1] & 0xC0) == 0x80) begin--;
    if (begin == 0) return;
    unsigned char lead = (unsigned char)text[begin - 1];
    size_t wanted = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : 0;
    if (length - begin < wanted) text[begin - 1] = '\0';
}

__attribute__((format(printf, 3, 0))) static void fill(char *out, size_t size, const char *format, va_list arguments)
{
    int needed = vsnprintf(out, size, format, arguments);
    if (needed < 0) out[0] = '\0';
    else if ((size_t)needed >= size) mend_tail(out);
}

/* A place that is too long loses its beginning: its end holds the line and the column. */
static void fill_where(char *out, size_t size, const char *where)
{
    static const char dots[] = "...";
    size_t length = strlen(where);
    if (length < size) {
        memcpy(out, where, length + 1);
        return;
    }
    const char *tail = where + length - (size - sizeof dots);
    while (((unsigned char)*tail & 0xC0) == 0x80) tail++;
    snprintf(out, size, "%s%s", dots, tail);
}

bool nh_fail(nh_error *error, nh_code code, const char *where, const char *format, ...)
{
    if (!error || error->code != NH_OK) return false;
    va_list arguments;
    va_start(arguments, format);
    fill(error->what, sizeof error->what, format, arguments);
    va_end(arguments);
    fill_where(error->where, sizeof error->where, where ? where : "");
    error->code = code;
    return false;
}

bool nh_error_hint(nh_error *error, const char *format, ...)
{
    if (!error || error->hint[0]) return false;
    va_list arguments;
    va_start(arguments, format);
    fill(error->hint, sizeof error->hint, format, arguments);
    va_end(arguments);
    return false;
}

bool nh_error_hint_near(nh_error *error, const char *written, const char *const *words, size_t count,
                        const char *otherwise)
{
    const char *near = nh_text_nearest(written, words, count);
    return near ? nh_error_hint(error, "did you mean `%s`?", near) : nh_error_hint(error, "%s", otherwise);
}

bool nh_error_hint_number(nh_error *error, const char *written)
{
    static const char digits[] = "0123456789";
    size_t sign = strspn(written, "+-"), whole = sign + strspn(written + sign, digits);
    if (whole == sign) return false;
    if (written[whole] == ',' && strspn(written + whole + 1, digits))
        return nh_error_hint(error, "use a decimal point: %.*s.%s", (int)whole, written, written + whole + 1);
    size_t number = whole + (written[whole] == '.') + strspn(written + whole + (written[whole] == '.'), digits);
    const char *unit = written + number + strspn(written + number, " ");
    bool other = (strchr("eE", *unit) && strpbrk(unit, digits)) || strchr("xX", *unit) || !strncmp(unit, "pi", 2);
    return isalpha((unsigned char)*unit) && !other /* a power of ten, hexadecimal digits, a multiple of pi */
               ? nh_error_hint(error, "numbers stand here without units: %.*s", (int)number, written)
               : false;
}

void nh_error_format(const nh_error *error, char *out, size_t size)
{
    if (size == 0) return;
    int needed = snprintf(out, size, "%s%s%s%s%s%s%s", error->where, error->where[0] ? ": " : "", error->what,
                          error->excerpt[0] ? "\n" : "", error->excerpt, error->hint[0] ? "\nhint: " : "", error->hint);
    if (needed < 0) out[0] = '\0';
    else if ((size_t)needed >= size) mend_tail(out);
}
