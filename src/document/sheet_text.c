/* A sheet as text of 80 columns. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/formula.h"
#include "document/notation.h"
#include "document/sheet.h"
#include "graph/print.h"

enum { line_width = 80, line_indent = 2 };

/* Where a line of at most `room` characters is best broken: before a + or - with few open parentheses, otherwise after
 * a factor; 0: nowhere. */
static size_t break_at(const char *text, size_t room)
{
    size_t best = 0;
    int depth = 0, least = 1 << 20;
    for (size_t i = 0; i < room && text[i]; i++) {
        depth += (text[i] == '(') - (text[i] == ')');
        bool equal = text[i + 1] == '=' && i > room / 4; /* not right after a label */
        if (i == 0 || text[i] != ' ' || (!equal && text[i + 1] != '+' && text[i + 1] != '-') || text[i + 2] != ' ')
            continue;
        if (depth > least && i < best + room / 2) continue;
        least = depth;
        best = i;
    }
    for (size_t i = room; i > room / 2 && !best; i--)
        if (text[i - 1] == '*' || text[i - 1] == ' ') best = i;
    return best;
}

/* The break between words: at the last blank with at most `room` columns before it, or at the first one. */
static size_t blank_at(const char *text, size_t room)
{
    size_t cut = 0, column = 0;
    for (size_t i = 0; text[i] && (column <= room || !cut); i++) {
        if (text[i] == ' ' && i) cut = i;
        column += ((unsigned char)text[i] & 0xc0) != 0x80;
    }
    return cut;
}

/* Breaks the text so that nothing extends beyond the last column; `hang`: indentation of all lines but the first. */
static void put_broken(nh_text *out, size_t indent, size_t hang, const char *text,
                       size_t (*where)(const char *, size_t))
{
    nh_text_addf(out, "%*s", (int)indent, "");
    for (size_t room = line_width - indent; nh_text_width(text) > room; room = line_width - hang) {
        size_t cut = where(text, room);
        if (!cut) break;
        nh_text_add_n(out, text, cut);
        text += cut + (text[cut] == ' ');
        nh_text_addf(out, "\n%*s", (int)hang, "");
    }
    nh_text_addf(out, "%s\n", text);
}

static void wrapped(nh_text *out, size_t indent, const char *text)
{
    put_broken(out, indent, indent + 4, text, break_at);
}
static void wrapped_words(nh_text *out, size_t indent, size_t hang, const char *text)
{
    put_broken(out, indent, hang, text, blank_at);
}

void nh_sheet_paragraph(size_t indent, size_t hang, const char *words, nh_text *out)
{
    wrapped_words(out, indent, hang, words + strspn(words, " "));
}

void nh_sheet_broken(size_t indent, size_t hang, const char *formula, nh_text *out)
{
    put_broken(out, indent, hang, formula, break_at);
}

void nh_sheet_plain(const char *words, nh_text *out)
{
    nh_text part;
    bool label;
    for (; nh_notation_next(&words, &part, &label); nh_text_clear(&part)) {
        if (label) nh_notation_write(nh_text_string(&part), NH_NOTATION_TEXT, out);
        else nh_text_add(out, nh_text_string(&part));
    }
}

static void put_words(nh_text *out, const char *words)
{
    nh_text text;
    nh_text_init(&text);
    nh_sheet_plain(words, &text);
    wrapped_words(out, line_indent, line_indent, nh_text_string(&text));
    nh_text_clear(&text);
}

static char *left_out(const nh_sheet_term *term)
{
    nh_text words;
    nh_text_init(&words);
    if (!term->factor[0]) nh_formula_left_out(term->wanted, &words);
    else if (term->wanted < 1e9) nh_text_addf(&words, "(too long; --option shown=%.0f shows it)", term->wanted);
    else nh_text_add(&words, "(too long)");
    char *out = nh_strdup(nh_text_string(&words));
    nh_text_clear(&words);
    return out;
}

static void terms(const nh_sheet *s, size_t n, const nh_sheet_term *term, nh_text *out)
{
    if (n == 0) nh_text_add(out, "0");
    for (size_t i = 0; i < n; i++) {
        bool minus, sum;
        char *text = nh_sheet_coefficient(s, &term[i], &minus, &sum);
        if (!text) text = left_out(&term[i]);
        nh_text_add(out, i ? (minus ? " - " : " + ") : minus ? "-" : "");
        nh_text_addf(out, sum ? "(%s)%s" : "%s%s", text, text[0] && term[i].factor[0] ? " " : "");
        nh_notation_write(term[i].factor, NH_NOTATION_TEXT, out);
        nh_free(text);
    }
}

static void put_line(const nh_sheet *s, const nh_sheet_line *line, nh_text *out)
{
    nh_text text;
    nh_text_init(&text);
    nh_notation_write(line->tag, NH_NOTATION_TEXT, &text);
    nh_text_add(&text, line->tag[0] ? "  " : "");
    nh_notation_write(line->label, NH_NOTATION_TEXT, &text);
    if (!line->label[0]) terms(s, line->left ? line->left : line->right, line->term, &text);
    nh_text_add(&text, " = ");
    if (line->label[0]) terms(s, line->right, line->term, &text);
    else terms(s, line->left ? line->right : 0, line->term + line->left, &text);
    wrapped(out, line_indent, nh_text_string(&text));
    nh_text_clear(&text);
}

void nh_sheet_text(nh_sheet *s, bool colour, nh_text *out)
{
    for (size_t i = 0; i < s->sections; i++) {
        size_t own;
        nh_sheet_section c = nh_sheet_brief(s, i, &own);
        if (c.title[0]) nh_text_addf(out, "\n%s%s%s\n", colour ? "\033[1m" : "", c.title, colour ? "\033[0m" : "");
        if (c.words[0]) put_words(out, c.words);
        for (size_t j = 0; j < c.lines; j++) {
            if (j == own) nh_text_addf(out, "%*swhere\n", line_indent, "");
            if (c.line[j].words) put_words(out, c.line[j].words);
            else put_line(s, &c.line[j], out);
        }
    }
}

void nh_sheet_fold(const char *text, nh_text *out)
{
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n"), indent = strspn(line, " ");
        nh_text one;
        nh_text_init(&one);
        nh_text_add_n(&one, line + indent, length - indent);
        wrapped_words(out, indent, indent + line_indent, nh_text_string(&one));
        nh_text_clear(&one);
        line += length + (line[length] == '\n');
    }
}

static void put_formula(nh_text *out, size_t indent, const char *label, char *value)
{
    nh_text text;
    nh_text_init(&text);
    nh_text_addf(&text, "%s = %s", label, value);
    wrapped(out, indent, nh_text_string(&text));
    nh_text_clear(&text);
    nh_free(value);
}

void nh_sheet_formulas(nh_dag *d, size_t n, const char *const *label, const nh_ex *value, size_t indent, double shown,
                       nh_text *out)
{
    size_t names = 0;
    nh_text words;
    nh_text_init(&words);
    nh_formula_list l = nh_formula_list_make(d, n, value, shown, &names);
    nh_formula_left_out(l.wanted, &words);
    for (size_t i = 0; i < n; i++)
        put_formula(out, indent, label[i],
                    l.stands[i] ? nh_print_string(d, l.formula[i]) : nh_strdup(nh_text_string(&words)));
    if (l.named) nh_text_addf(out, "%*swhere\n", (int)indent, "");
    for (size_t k = 0; k < l.parts; k++)
        if (l.needed[k]) put_formula(out, indent, l.part[k].name, nh_print_string(d, l.part[k].value));
    nh_text_clear(&words);
    nh_formula_list_clear(&l);
}
