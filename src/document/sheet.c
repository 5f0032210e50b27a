/* sheet: collects lines in an arena, and writes them as JSON. */
#include "document/sheet.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/formula.h"
#include "document/notation.h"
#include "graph/dag.h"

/* Makes room for one more entry of a list in the arena: the list is copied when it doubles. */
static void *grown(nh_arena *arena, void *list, size_t count, size_t *room, size_t size)
{
    if (count < *room) return list;
    *room = *room ? 2 * *room : 8;
    void *more = nh_arena_alloc(arena, *room * size);
    if (count) memcpy(more, list, count * size);
    return more;
}

nh_sheet *nh_sheet_create(nh_arena *arena, nh_dag *dag)
{
    nh_sheet *s = nh_arena_alloc(arena, sizeof *s);
    *s = (nh_sheet){.arena = arena, .dag = dag, .shown = INFINITY, .written = INFINITY};
    return s;
}

const char *nh_sheet_label(nh_sheet *s, const char *format, ...)
{
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int length = vsnprintf(NULL, 0, format, list);
    char *text = nh_arena_alloc(s->arena, (size_t)length + 1);
    vsnprintf(text, (size_t)length + 1, format, again);
    va_end(list);
    va_end(again);
    return text;
}

void nh_sheet_begin(nh_sheet *s, const char *key, const char *title, const char *words)
{
    s->section = grown(s->arena, s->section, s->sections, &s->room, sizeof *s->section);
    s->section[s->sections++] = (nh_sheet_section){.key = key, .title = title, .words = words};
}

static nh_sheet_line *add_line(nh_arena *arena, nh_sheet_section *c)
{
    c->line = grown(arena, c->line, c->lines, &c->room, sizeof *c->line);
    nh_sheet_line *line = &c->line[c->lines++];
    *line = (nh_sheet_line){.tag = "", .label = ""};
    return line;
}

void nh_sheet_sum(nh_sheet *s, const char *tag, const char *label)
{
    nh_sheet_line *line = add_line(s->arena, &s->section[s->sections - 1]);
    line->tag = tag;
    line->label = label;
}

static nh_sheet_line *last(nh_sheet *s)
{
    nh_sheet_section *c = &s->section[s->sections - 1];
    return &c->line[c->lines - 1];
}

static void put_term(nh_arena *arena, nh_sheet_line *line, nh_ex coefficient, const char *factor)
{
    line->term = grown(arena, line->term, line->left + line->right, &line->room, sizeof *line->term);
    line->term[line->left + line->right++] = (nh_sheet_term){.coefficient = coefficient, .factor = factor};
}

void nh_sheet_add(nh_sheet *s, nh_ex coefficient, const char *factor)
{
    if (!nh_is_zero(s->dag, coefficient)) put_term(s->arena, last(s), coefficient, factor);
}

/* The terms so far become the left side. */
void nh_sheet_equals(nh_sheet *s)
{
    nh_sheet_line *line = last(s);
    line->left += line->right;
    line->right = 0;
}

void nh_sheet_formula(nh_sheet *s, const char *label, nh_ex e)
{
    nh_sheet_sum(s, "", label);
    put_term(s->arena, last(s), e, "");
}

void nh_sheet_words(nh_sheet *s, const char *words) { add_line(s->arena, &s->section[s->sections - 1])->words = words; }

/* ---- reading ---- */

static nh_ex as_shown(const nh_sheet *s, const nh_sheet_section *c, nh_ex e)
{
    return s->chart && !c->literal ? nh_chart_shown(s->chart, e) : e;
}

nh_sheet_section nh_sheet_brief(nh_sheet *s, size_t section, size_t *own)
{
    nh_sheet_section c = s->section[section];
    nh_formula_part part[NH_FORMULA_PARTS];
    size_t n = 0, at = 0;
    for (size_t i = 0; i < c.lines; i++) n += c.line[i].left + c.line[i].right;
    nh_ex *e = nh_arena_alloc(s->arena, (n + 1) * sizeof *e);
    nh_sheet_line *line = nh_arena_alloc(s->arena, (c.lines + NH_FORMULA_PARTS) * sizeof *line);
    if (c.lines) memcpy(line, c.line, c.lines * sizeof *line);
    for (size_t i = 0; i < c.lines; i++) {
        size_t terms = line[i].left + line[i].right;
        line[i].term = nh_arena_alloc(s->arena, (terms + 1) * sizeof *line[i].term);
        for (size_t j = 0; j < terms; j++) {
            line[i].term[j] = c.line[i].term[j];
            e[at++] = nh_formula_shortened(s->analysis, s->dag, as_shown(s, &c, c.line[i].term[j].coefficient));
        }
    }
    const nh_formula_room least = {s->shown, INFINITY, 1};
    nh_formula_room room = nh_formula_page(s->shown);
    room.all = INFINITY;
    bool needed[NH_FORMULA_PARTS], *stands = nh_alloc_array(n + 1, sizeof *stands);
    size_t parts = nh_formula_parts(s->dag, n, e, least, part);
    double wanted = nh_formula_fit(s->dag, n, e, parts, part, room, stands, needed);
    nh_formula_number(s->dag, n, e, parts, part, needed, 'S', &s->names); /* one sequence of names for the sheet */
    for (size_t i = at = 0; i < c.lines; i++)
        for (size_t j = 0; j < line[i].left + line[i].right; j++, at++) {
            line[i].term[j].coefficient = e[at];
            line[i].term[j].wanted = stands[at] ? 0 : wanted;
        }
    nh_free(stands);
    *own = c.lines;
    c.line = line;
    c.room = c.lines + NH_FORMULA_PARTS;
    for (size_t k = 0; k < parts; k++) {
        if (!needed[k]) continue;
        nh_sheet_line *def = add_line(s->arena, &c);
        def->label = nh_sheet_label(s, "<%s>", part[k].name);
        put_term(s->arena, def, part[k].value, "");
    }
    return c;
}

/* -J - m a^2 is written -(J + m a^2); a sum that is no shorter with opposite signs stays. */
static char *negative(const nh_sheet *s, nh_ex e, char *text, bool *minus)
{
    char *turned = nh_print_string(s->dag, nh_neg(s->dag, e));
    *minus = nh_formula_is_sum(turned) && turned[0] != '-' && strlen(turned) < strlen(text);
    nh_free(*minus ? text : turned);
    return *minus ? turned : text;
}

char *nh_sheet_coefficient(const nh_sheet *s, const nh_sheet_term *t, bool *minus, bool *sum)
{
    char *text = t->wanted > 0 ? NULL : nh_print_string(s->dag, t->coefficient);
    *minus = *sum = false;
    if (!text) return text;
    *sum = t->factor[0] && nh_formula_is_sum(text);
    *minus = text[0] == '-';
    if (*sum && *minus) text = negative(s, t->coefficient, text, minus);
    else if (*minus) memmove(text, text + 1, strlen(text));
    if (t->factor[0] && !strcmp(text, "1")) text[0] = 0;
    return text;
}

/* ---- JSON ---- */

static void put_label(nh_json *item, const char *key, const char *label)
{
    nh_text text;
    nh_text_init(&text);
    nh_notation_write(label, NH_NOTATION_TEXT, &text);
    nh_json_put_text(item, key, nh_text_string(&text));
    nh_text_clear(&text);
}

static void put_expression(const nh_sheet *s, const nh_sheet_section *c, nh_json *item, const char *key, nh_ex e)
{
    char *text = nh_print_short(s->dag, as_shown(s, c, e), s->written);
    nh_json_put_text(item, key, text);
    nh_free(text);
}

static void put_terms(const nh_sheet *s, const nh_sheet_section *c, nh_json *item, const char *key, size_t n,
                      const nh_sheet_term *term)
{
    nh_json *list = nh_json_put_array(item, key);
    for (size_t i = 0; i < n; i++) {
        nh_json *one = nh_json_add_object(list);
        put_expression(s, c, one, "coefficient", term[i].coefficient);
        put_label(one, "of", term[i].factor);
    }
}

static void put_words(nh_json *to, const char *words)
{
    nh_text text, part;
    bool label;
    nh_text_init(&text);
    for (; nh_notation_next(&words, &part, &label); nh_text_clear(&part)) {
        if (label) nh_notation_write(nh_text_string(&part), NH_NOTATION_TEXT, &text);
        else nh_text_add(&text, nh_text_string(&part));
    }
    nh_json_put_text(to, "words", nh_text_string(&text));
    nh_text_clear(&text);
}

void nh_sheet_json(nh_sheet *s, nh_json *to)
{
    for (size_t i = 0; i < s->sections; i++) {
        const nh_sheet_section *c = &s->section[i];
        nh_json *list = nh_json_put_array(to, c->key);
        for (size_t j = 0; j < c->lines; j++) {
            const nh_sheet_line *line = &c->line[j];
            nh_json *item = nh_json_add_object(list);
            if (line->words) {
                put_words(item, line->words);
                continue;
            }
            if (line->tag[0]) put_label(item, "number", line->tag);
            if (line->label[0]) put_label(item, "label", line->label);
            bool plain = line->left == 0 && line->right == 1 && !line->term[0].factor[0];
            if (plain) {
                put_expression(s, c, item, "expression", line->term[0].coefficient);
                continue;
            }
            bool zero = !line->label[0] && line->left == 0;
            put_terms(s, c, item, "terms", zero || line->label[0] ? line->right : line->left, line->term);
            if (!line->label[0]) put_terms(s, c, item, "equals", zero ? 0 : line->right, line->term + line->left);
        }
    }
}
