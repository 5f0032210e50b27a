#include "document/pen.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/formula.h"
#include "document/typeset.h"
#include "graph/print.h"

void nh_pen_begin(nh_pen *p, nh_pen_style style, const nh_pen_subject *s, const char *what, nh_text *out)
{
    double written = s->written > 0 ? s->written : INFINITY;
    *p = (nh_pen){.of = *s,
                  .style = style,
                  .page = {.out = out, .system = s->system, .dag = s->dag, .shown = s->shown, .written = written},
                  .tex = {.out = out,
                          .system = s->system,
                          .dag = s->dag,
                          .shown = s->shown,
                          .written = written,
                          .fragment = style.fragment},
                  .plain = {.out = out, .of = *s, .colour = style.colour}};
#define X(name, form, writer) {&nh_pen_##name, &p->writer},
    const struct {
        const nh_pen_ink *ink;
        void *to;
    } of[] = {NH_PEN_FORM_TABLE(X){&nh_pen_plain, &p->plain}};
#undef X
    p->ink = of[style.form].ink;
    p->to = of[style.form].to;
    p->ink->begin(p->to, what);
}

/* ---- sections and cards ---- */

void nh_pen_card_end(nh_pen *p)
{
    if (p->card) nh_pen_close(p, NH_PEN_CARD);
    p->card = false;
}

static void section_end(nh_pen *p)
{
    nh_pen_card_end(p);
    if (p->section) nh_pen_close(p, NH_PEN_SECTION);
    p->section = false;
}

bool nh_pen_is_open(const nh_pen_subject *subject, const char *parameter)
{
    size_t i = 0, most = sizeof subject->open / sizeof *subject->open;
    while (i < most && subject->open[i] && strcmp(subject->open[i], parameter)) i++;
    return i < most && subject->open[i];
}

void nh_pen_section(nh_pen *p, const char *id, const char *title)
{
    section_end(p);
    nh_pen_open(p, NH_PEN_SECTION, id, title);
    p->section = true;
}

void nh_pen_card(nh_pen *p, const char *title)
{
    nh_pen_card_end(p);
    nh_pen_open(p, NH_PEN_CARD, NULL, title);
    p->card = true;
}

void nh_pen_glossary(nh_pen *p, const char *words)
{
    section_end(p);
    p->ink->glossary(p->to, words);
}

void nh_pen_table(nh_pen *p, const char *caption, const char *heads) { p->ink->table(p->to, caption, heads); }

void nh_pen_table_end(nh_pen *p) { p->ink->table_end(p->to); }

void nh_pen_end(nh_pen *p, const nh_run *run)
{
    section_end(p);
    p->ink->end(p->to, run);
}

void nh_pen_open(nh_pen *p, nh_pen_part part, const char *id, const char *title)
{
    if (part == NH_PEN_SECTION) p->headed = false;
    if (part == NH_PEN_CARD || part == NH_PEN_HEADING) p->headed = true;
    p->ink->open(p->to, part, id, title);
}

void nh_pen_close(nh_pen *p, nh_pen_part part) { p->ink->close(p->to, part); }

/* ---- formats ---- */

/* A part that holds letters of the theory. */
static void put_notation(nh_pen *p, nh_pen_part part, const char *label)
{
    nh_text letters;
    nh_text_init(&letters);
    nh_notation_write(label, p->ink->notation, &letters);
    nh_pen_open(p, part, NULL, NULL);
    p->ink->markup(p->to, nh_text_string(&letters));
    nh_pen_close(p, part);
    nh_text_clear(&letters);
}

void nh_pen_letters(nh_pen *p, const char *label) { put_notation(p, NH_PEN_LETTERS, label); }

static void plain(nh_pen *p, const char *from, const char *to)
{
    nh_text text, part;
    bool label;
    nh_text_init(&text);
    nh_text_add_n(&text, from, (size_t)(to - from));
    for (const char *rest = nh_text_string(&text); nh_notation_next(&rest, &part, &label); nh_text_clear(&part)) {
        if (label) nh_pen_letters(p, nh_text_string(&part));
        else p->ink->words(p->to, nh_text_string(&part));
    }
    nh_text_clear(&text);
}

void nh_pen_theory(nh_pen *p, const char *words) { plain(p, words, words + strlen(words)); }

/* One argument; *at points to its %, and afterwards behind it.  The list is passed as a pointer, so that the caller
 * continues behind what was read. */
static void argument(nh_pen *p, const char **at, char before, va_list *list)
{
    const char *c = *at + 1;
    int digits = *c == '.' ? (int)strtol(c + 1, (char **)&c, 10) : 6;
    if (*c == 's') {
        const char *text = va_arg(*list, const char *);
        if (before == '{') p->ink->names(p->to, text);
        else if (before == '<') p->ink->source(p->to, text);
        else p->ink->words(p->to, text);
    } else if (*c == 'z') {
        p->ink->count(p->to, va_arg(*list, size_t));
        c++;
    } else if (*c == 'l') {
        p->ink->count(p->to, (size_t)va_arg(*list, long));
        c++;
    } else {
        p->ink->number(p->to, va_arg(*list, double), digits);
    }
    *at = c + 1;
}

/* Up to the end of the format, or of its cell. */
static const char *write_format(nh_pen *p, const char *format, bool cells, va_list *list)
{
    const char *from = format, *at = format;
    while (*at && !(cells && *at == '|')) {
        if (*at != '%') {
            at++;
            continue;
        }
        char before = at > from ? at[-1] : 0;
        bool marked = before == '{' || before == '<';
        plain(p, from, at - marked);
        argument(p, &at, before, list);
        from = at += marked;
    }
    plain(p, from, at);
    return at;
}

void nh_pen_say(nh_pen *p, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    write_format(p, format, false, &list);
    va_end(list);
}

void nh_pen_words(nh_pen *p, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    write_format(p, format, false, &list);
    nh_pen_close(p, NH_PEN_WORDS);
    va_end(list);
}

void nh_pen_fact_begin(nh_pen *p, const char *name)
{
    nh_pen_open(p, NH_PEN_FACT, NULL, NULL);
    nh_pen_open(p, NH_PEN_FACT_NAME, NULL, NULL);
    plain(p, name, name + strlen(name));
    nh_pen_close(p, NH_PEN_FACT_NAME);
}

void nh_pen_fact(nh_pen *p, const char *name, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    nh_pen_fact_begin(p, name);
    write_format(p, format, false, &list);
    nh_pen_close(p, NH_PEN_FACT);
    va_end(list);
}

void nh_pen_row(nh_pen *p, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
    for (bool more = true; more;) {
        nh_pen_part part = *format == '#' ? NH_PEN_ROW_HEAD : *format == '!' ? NH_PEN_KIND : NH_PEN_CELL;
        format += part != NH_PEN_CELL;
        const char *kind = part == NH_PEN_KIND ? va_arg(list, const char *) : NULL;
        nh_pen_open(p, part, kind, NULL);
        if (kind) p->ink->words(p->to, kind), format += strlen("%s");
        else format = write_format(p, format, true, &list);
        nh_pen_close(p, part);
        more = *format == '|';
        format += more;
    }
    nh_pen_close(p, NH_PEN_ROW);
    va_end(list);
}

void nh_pen_cell(nh_pen *p, nh_pen_part part, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    nh_pen_open(p, part, NULL, NULL);
    write_format(p, format, false, &list);
    nh_pen_close(p, part);
    va_end(list);
}

void nh_pen_heading(nh_pen *p, const char *title)
{
    nh_pen_card_end(p);
    nh_pen_open(p, NH_PEN_HEADING, NULL, title);
    nh_pen_close(p, NH_PEN_HEADING);
}

void nh_pen_name_heading(nh_pen *p, const char *id, const char *name)
{
    nh_pen_open(p, NH_PEN_NAME, id, NULL);
    p->ink->source(p->to, name);
    nh_pen_close(p, NH_PEN_NAME);
}

/* The number of letters of `text` that are a formula: its longest beginning, up to a comma or a parenthesis, that has
 * an equals sign or is a number, and belongs to the language. */
static size_t formula_length(const char *text)
{
    nh_text one;
    size_t found = 0;
    nh_text_init(&one);
    for (size_t n = strlen(text); n && !found; n--) {
        bool ends = !text[n] || text[n] == ',' || text[n] == ')' || !strncmp(text + n, " (", 2);
        if (!ends || !(memchr(text, '=', n) || strchr("-0123456789", text[0]))) continue;
        nh_text_clear(&one);
        nh_text_add_n(&one, text, n);
        if (nh_typeset_width(nh_text_string(&one)) > 0) found = n;
    }
    nh_text_clear(&one);
    return found;
}

void nh_pen_place_card(nh_pen *p, const char *where)
{
    nh_pen_card(p, p->ink->brief ? where : NULL);
    if (p->ink->brief) return;
    nh_pen_open(p, NH_PEN_NAME, NULL, NULL);
    for (const char *at = where; *at;) {
        bool begins = *at != ' ' && (at == where || strchr(" (,", at[-1]));
        size_t n = begins ? formula_length(at) : 0, length = n ? n : strchr(" (,)", *at) ? 1 : strcspn(at, " (,)");
        nh_text part;
        nh_text_init(&part);
        nh_text_add_n(&part, at, length);
        if (n) p->ink->source(p->to, nh_text_string(&part));
        else p->ink->words(p->to, nh_text_string(&part));
        nh_text_clear(&part);
        at += length;
    }
    nh_pen_close(p, NH_PEN_NAME);
}

void nh_pen_code(nh_pen *p, const char *text) { p->ink->code(p->to, text); }

void nh_pen_warning(nh_pen *p, const char *text)
{
    nh_pen_open(p, NH_PEN_WARNING, NULL, NULL);
    p->ink->words(p->to, text);
    nh_pen_close(p, NH_PEN_WARNING);
}

void nh_pen_formula(nh_pen *p, const char *label, nh_ex e) { nh_pen_formulas(p, 1, &label, &e); }

void nh_pen_formulas(nh_pen *p, size_t n, const char *const *label, const nh_ex *e)
{
    const nh_pen_subject *of = &p->of;
    size_t one_list = 0, *names = p->style.form == NH_PEN_PAGE    ? &p->page.names
                                  : p->style.form == NH_PEN_LATEX ? &p->tex.names
                                                                  : &one_list;
    nh_ex *brief = nh_alloc_array(n + 1, sizeof *brief);
    for (size_t i = 0; i < n; i++)
        brief[i] = nh_formula_shortened(of->analysis, of->dag, of->chart ? nh_chart_shown(of->chart, e[i]) : e[i]);
    nh_formula_list list = nh_formula_list_make(of->dag, n, brief, of->shown, names);
    p->ink->formulas(p->to, &list, n, label, e);
    nh_formula_list_clear(&list);
    nh_free(brief);
}

bool nh_pen_is_name(const char *label) { return !label[strcspn(label, "\\{}<>[] =")]; }

void nh_pen_plot(nh_pen *p, nh_plot *plot, const char *caption) { p->ink->plot(p->to, plot, caption); }

void nh_pen_name(nh_pen *p, const char *name)
{
    char *label = nh_alloc_array(strlen(name) + 3, 1);
    snprintf(label, strlen(name) + 3, "<%s>", name);
    nh_pen_letters(p, label);
    nh_free(label);
}

/* c d/dx + ...: a coefficient that is a sum stands in parentheses. */
void nh_pen_field(nh_pen *p, nh_dag *d, size_t n, const char *const *coordinate, const nh_ex *component)
{
    bool first = true;
    for (size_t i = 0; i < n; i++) {
        if (nh_is_zero(d, component[i])) continue;
        char *text = nh_print_string(d, component[i]), label[200];
        bool sum = nh_formula_is_sum(text), minus = !sum && text[0] == '-';
        p->ink->words(p->to, first ? "" : " ");
        if (minus || !first) nh_pen_letters(p, minus ? "-" : "+");
        p->ink->words(p->to, first ? "" : " ");
        if (strcmp(text + minus, "1")) nh_pen_say(p, sum ? "(<%s>) " : "<%s> ", text + minus);
        snprintf(label, sizeof label, "\\frac{\\p}{\\p<%.180s>}", coordinate[i]);
        nh_pen_letters(p, label);
        nh_free(text);
        first = false;
    }
}

/* ---- formulas under headings ---- */

static void put_terms(nh_pen *p, const nh_sheet *s, size_t n, const nh_sheet_term *term)
{
    if (n == 0) nh_pen_open(p, NH_PEN_ZERO, NULL, NULL);
    for (size_t i = 0; i < n; i++) {
        nh_pen_term t = {.first = i == 0, .wanted = term[i].wanted};
        char *coefficient = nh_sheet_coefficient(s, &term[i], &t.minus, &t.sum);
        nh_text factor;
        nh_text_init(&factor);
        nh_notation_write(term[i].factor, p->ink->notation, &factor);
        t.coefficient = coefficient;
        t.factor = nh_text_string(&factor);
        p->ink->term(p->to, &t);
        nh_text_clear(&factor);
        nh_free(coefficient);
    }
}

static void put_line(nh_pen *p, const nh_sheet *s, const nh_sheet_line *line)
{
    bool labelled = line->label[0];
    nh_pen_open(p, NH_PEN_FORMULA, NULL, NULL);
    if (line->tag[0]) put_notation(p, NH_PEN_NUMBER, line->tag);
    if (labelled) put_notation(p, NH_PEN_LABEL, line->label);
    else put_terms(p, s, line->left ? line->left : line->right, line->term);
    nh_pen_open(p, NH_PEN_EQUALS, NULL, NULL);
    put_terms(p, s, labelled || line->left ? line->right : 0, line->term + line->left);
    nh_pen_close(p, NH_PEN_FORMULA);
}

static void put_remark(nh_pen *p, const char *words)
{
    nh_pen_open(p, NH_PEN_REMARK, NULL, NULL);
    nh_pen_theory(p, words);
    nh_pen_close(p, NH_PEN_REMARK);
}

/* One sequence of names of repeated parts for the document; the titles are below the heading of the section, if it has
 * one. */
void nh_pen_sheet(nh_pen *p, nh_sheet *s)
{
    if (!s) return;
    s->names = p->names;
    for (size_t i = 0; i < s->sections; i++) {
        size_t own;
        nh_sheet_section c = nh_sheet_brief(s, i, &own);
        nh_pen_part title = p->headed ? NH_PEN_SUBTITLE : NH_PEN_HEADING;
        if (c.title[0]) p->ink->open(p->to, title, NULL, c.title), p->ink->close(p->to, title);
        if (c.words[0]) put_remark(p, c.words);
        for (size_t j = 0; j < c.lines; j++) {
            if (j == own) nh_pen_open(p, NH_PEN_WHERE, NULL, NULL);
            if (c.line[j].words) put_remark(p, c.line[j].words);
            else put_line(p, s, &c.line[j]);
        }
        if (c.lines > own) nh_pen_close(p, NH_PEN_WHERE);
    }
    p->names = s->names;
}
