/* sheet: formulas under headings, which nh_pen_sheet writes for text, page and LaTeX, and nh_sheet_json as JSON.
 *
 * A line is   label = c_1 f_1 + c_2 f_2 + ...   with expressions c and letters f of the theory (notation.h), or an
 *             equation, with such a sum on both sides; or words.  Lines belong to sections. */
#ifndef NH_SHEET_H
#define NH_SHEET_H

#include "base/json.h"
#include "problem/analysis_file.h"

typedef struct {
    nh_ex coefficient;
    const char *factor; /* notation; "": none */
    double wanted;      /* 0: it is shown; otherwise it is left out, and the option `shown` that would show it */
} nh_sheet_term;

typedef struct {
    const char *tag;   /* notation: the number of an equation, "(17)"; "" */
    const char *label; /* notation; "": an equation, whose left side is a sum */
    const char *words; /* words instead of a formula; else NULL */
    size_t left, right, room;
    nh_sheet_term *term; /* the terms of the left side, then those of the right side */
} nh_sheet_line;

typedef struct {
    const char *key, *title; /* name in the JSON; heading */
    const char *words;       /* the meaning of the letters; "" */
    bool literal;            /* roots are shown as roots */
    size_t lines, room;
    nh_sheet_line *line;
} nh_sheet_section;

typedef struct {
    nh_arena *arena;
    nh_dag *dag;
    const nh_analysis_file *analysis; /* analysis file whose abbreviations text and page use; or NULL */
    const nh_chart *chart;            /* chart whose dependent velocities replace roots; or NULL */
    double shown, written;            /* options: longest formula in text and page; in the JSON */
    size_t sections, room;
    nh_sheet_section *section;
    size_t names; /* number of names of repeated parts so far */
} nh_sheet;

/* ---- writing: to the last section, or its last line ---- */

/* An empty sheet, which lives in the arena; begin a section before adding lines. */
nh_sheet *nh_sheet_create(nh_arena *arena, nh_dag *dag);
void nh_sheet_begin(nh_sheet *sheet, const char *key, const char *title, const char *words);
/* label = e */
void nh_sheet_formula(nh_sheet *sheet, const char *label, nh_ex e);
/* label = the terms that follow.  With a tag and without a label: an equation, (tag) terms = 0, or, after
 * nh_sheet_equals, terms = terms. */
void nh_sheet_sum(nh_sheet *sheet, const char *tag, const char *label);
/* writes nothing where the coefficient is 0 */
void nh_sheet_add(nh_sheet *sheet, nh_ex coefficient, const char *factor);
void nh_sheet_equals(nh_sheet *sheet);
void nh_sheet_words(nh_sheet *sheet, const char *words);
/* A label in the arena. */
const char *nh_sheet_label(nh_sheet *sheet, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* ---- reading ---- */

/* The section as text and page show it: with the user's abbreviations, and with names for repeated parts of long
 * formulas, which are defined in lines after the first `own` ones. */
nh_sheet_section nh_sheet_brief(nh_sheet *sheet, size_t section, size_t *own);
/* A coefficient before its factor: its sign, and the rest, which needs parentheses where it is a sum; "" for 1.  NULL:
 * too long.  The caller frees it. */
char *nh_sheet_coefficient(const nh_sheet *sheet, const nh_sheet_term *term, bool *minus, bool *sum);

void nh_sheet_json(nh_sheet *sheet, nh_json *to); /* a member of `to` for each section */

#endif
