#include "document/screen.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/sheet.h"
#include "graph/print.h"

void nh_screen_title(const nh_system *s, bool colour, nh_text *out)
{
    enum { width = 80 };
    size_t column = nh_text_width(s->title);
    nh_text_addf(out, colour ? "\033[1m%s\033[0m" : "%s", s->title);
    for (size_t i = 0; i < s->parameters; i++) {
        char one[120];
        snprintf(one, sizeof one, "%s = %.6g%s", s->parameter[i].name, s->parameter[i].value,
                 i + 1 < s->parameters ? "," : "");
        bool fits = column + nh_text_width(one) + 3 <= width;
        nh_text_addf(out, "%s%s", !fits ? "\n  " : i ? " " : "   ", one);
        column = (fits ? column + (i ? 1 : 3) : 2) + nh_text_width(one);
    }
    nh_text_add(out, "\n");
}

void nh_screen_say(nh_text *out, size_t indent, nh_text *words)
{
    while (words->length && words->data[words->length - 1] == ' ') words->data[--words->length] = 0;
    if (words->length) nh_sheet_paragraph(indent, indent, nh_text_string(words), out);
    nh_text_clear(words);
}

void nh_screen_formula(nh_text *out, bool colour, const char *lines)
{
    for (const char *at = lines; *at;) {
        size_t length = strcspn(at, "\n");
        nh_text_add(out, colour ? "\033[36m" : "");
        nh_text_add_n(out, at, length);
        nh_text_add(out, colour ? "\033[0m\n" : "\n");
        at += length + (at[length] == '\n');
    }
}

void nh_screen_equation(const char *label, nh_dag *d, nh_ex e, nh_text *out)
{
    nh_text line;
    nh_text_init(&line);
    char *value = nh_print_string(d, e);
    nh_text_addf(&line, "%s = %s", label, value);
    nh_sheet_broken(2, 2 + NH_SCREEN_HANG, nh_text_string(&line), out);
    nh_free(value);
    nh_text_clear(&line);
}

size_t nh_screen_count(const char *text)
{
    size_t n = 0;
    for (; *text; text++) n += *text == '\n';
    return n;
}
