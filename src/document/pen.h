/* pen: a document written once, for a page, for LaTeX and for a terminal.
 *
 * A document is a sequence of parts, which may hold parts; a part of words holds words, numbers, names and formulas.  A
 * form of output is one nh_pen_ink.  In formats, as of printf:  %s words; %zu and %ld a count; %.3g a number with so
 * many digits; {%s} words with names in parentheses, such as a chart has; <%s> a formula of the expression language;
 * $..$ letters of the theory, in the language of notation.h.  In rows | ends a cell, and a cell that begins with # is
 * the heading of its row; the words of a cell that begins with ! are also its kind, which gives it a colour on a page.
 * A column whose head begins with # holds numbers. */
#ifndef NH_PEN_H
#define NH_PEN_H

#include "document/form.h"
#include "document/formula.h"
#include "document/html_internal.h"
#include "document/notation.h"
#include "document/sheet.h"
#include "document/tex_internal.h"

/* SCREEN: folded, on pages only, and not when they are printed.  NAME: the title of a card, as a formula.  TAGS: the
 * properties of a card, one TAG each.  BESIDE: figures that stand side by side where there is room.  LETTERS: of the
 * theory, within words.  Of a sheet: SUBTITLE, below a heading of its section; REMARK, words between formulas; FORMULA,
 * a line, with the NUMBER of its equation, the LABEL of its left side, EQUALS and ZERO; WHERE, definitions. */
typedef enum {
    NH_PEN_SECTION,
    NH_PEN_CARD,
    NH_PEN_FOLD,
    NH_PEN_SCREEN,
    NH_PEN_WORDS,
    NH_PEN_ANSWER,
    NH_PEN_WARNING,
    NH_PEN_HEADING,
    NH_PEN_SUBHEADING,
    NH_PEN_NAME,
    NH_PEN_TAGS,
    NH_PEN_TAG,
    NH_PEN_FACTS,
    NH_PEN_FACT,
    NH_PEN_FACT_NAME,
    NH_PEN_BESIDE,
    NH_PEN_ROW,
    NH_PEN_CELL,
    NH_PEN_ROW_HEAD,
    NH_PEN_KIND,
    NH_PEN_LETTERS,
    NH_PEN_SUBTITLE,
    NH_PEN_REMARK,
    NH_PEN_FORMULA,
    NH_PEN_NUMBER,
    NH_PEN_LABEL,
    NH_PEN_EQUALS,
    NH_PEN_ZERO,
    NH_PEN_WHERE,
    NH_PEN_PARTS
} nh_pen_part;

/* A term of a sum: its sign, its coefficient, in parentheses where that is a sum, and its factor. */
typedef struct {
    bool first, minus, sum;
    const char *coefficient; /* in the expression language, "" for 1; NULL: too long for the option `shown`.. */
    double wanted;           /* .. which would have to be this */
    const char *factor;      /* letters of the theory, in the form's notation; "": none */
} nh_pen_term;

typedef struct {
    bool screen; /* has it parts for the screen? */
    /* it is for a terminal: without the user's own text, and without long explanations */
    bool brief;
    void (*begin)(void *to, const char *what);
    void (*links)(void *to, const char *sections);
    /* `id`: of a section; the class of an answer; the kind of a cell.  `title` may be NULL; for a kind it is a
     * remark. */
    void (*open)(void *to, nh_pen_part part, const char *id, const char *title);
    void (*close)(void *to, nh_pen_part part);
    void (*words)(void *to, const char *words);
    void (*number)(void *to, double value, int digits);
    void (*count)(void *to, size_t value);
    void (*names)(void *to, const char *words);
    void (*source)(void *to, const char *formula);
    void (*markup)(void *to, const char *text); /* in the language of the form: letters in its notation */
    void (*term)(void *to, const nh_pen_term *term);
    void (*equation)(void *to, const char *label, const char *formula); /* label = formula, as texts; label may be "" */
    void (*code)(void *to, const char *text);                           /* text as it is, on lines of its own */
    /* Formulas e that belong together, as the list has them; labels are names, or in the language of notation.h. */
    void (*formulas)(void *to, const nh_formula_list *list, size_t n, const char *const *label, const nh_ex *e);
    void (*table)(void *to, const char *caption, const char *heads); /* heads: separated by | */
    void (*table_end)(void *to);
    void (*plot)(void *to, nh_plot *plot, const char *caption);
    void (*series)(void *to, const nh_time_series *series);  /* a motion as plots over time; pages have a stage */
    void (*stage)(void *to, const nh_stage *stage);          /* the motion at the top of a page; NULL: no page */
    void (*symmetry)(void *to, const nh_symmetry *symmetry); /* the symmetry in words: its case, its bracket */
    void (*glossary)(void *to, const char *words);           /* the meaning of these words; on pages only */
    void (*end)(void *to, const nh_run *run);
    nh_notation_form notation; /* of letters */
} nh_pen_ink;

/* The subject of a document.  Formulas longer than `shown` are left out of the document, those longer than `written`
 * (0: none) out of the JSON. */
typedef struct {
    const nh_system *system;
    const nh_analysis_file *analysis;
    nh_dag *dag;
    const nh_chart *chart;
    double shown, written;
    const char *open[3]; /* names of parameters that have no value here, from the first one; NULL: there are no more */
} nh_pen_subject;

bool nh_pen_is_open(const nh_pen_subject *subject, const char *parameter);

/* For a text on a terminal. */
typedef struct {
    /* the buffer to which parts are written; the output, which receives it at the end with its lines folded */
    nh_text *out, *folded;
    nh_text text; /* the buffer that `out` points to until the end */
    nh_pen_subject of;
    bool colour;
    nh_text rows; /* the buffer that `out` points to within a table; its cells end by tabs */
    nh_text line; /* likewise within a formula or a remark, which is then broken */
    size_t cells; /* cells of the row, and tags of the card, so far */
} nh_plain_writer;

typedef struct {
    const nh_pen_ink *ink;
    void *to;
    nh_pen_subject of;
    nh_pen_style style;
    nh_html_writer page;
    nh_tex_writer tex;
    nh_plain_writer plain;
    size_t names;       /* number of names of repeated parts in sheets so far: one sequence for the document */
    bool forms;         /* have the forms phi^a been defined? */
    bool section, card; /* parts that are open */
    bool headed;        /* has this section a heading of its own? */
} nh_pen;

#define X(name, form, writer) extern const nh_pen_ink nh_pen_##name;
NH_PEN_FORM_TABLE(X)
#undef X
extern const nh_pen_ink nh_pen_plain;

/* Begins a document; `pen` must not move until its end. */
void nh_pen_begin(nh_pen *pen, nh_pen_style style, const nh_pen_subject *subject, const char *what, nh_text *out);
void nh_pen_end(nh_pen *pen, const nh_run *run);

/* Begins a section, or a card in it; it ends where the next one begins, and before the system and the glossary. */
void nh_pen_section(nh_pen *pen, const char *id, const char *title);
void nh_pen_card(nh_pen *pen, const char *title);
/* A card whose title is a place in the space of the parameters: equations separated by commas, with remarks in
 * parentheses. */
void nh_pen_place_card(nh_pen *pen, const char *where);
void nh_pen_card_end(nh_pen *pen);
/* The system as it was written; with a model its equations, with an analysis the kind of its constraints; then its
 * geometry, if there is one. */
void nh_pen_system(nh_pen *pen, const nh_model *model, const nh_analysis *analysis);
void nh_pen_geometry(nh_pen *pen, nh_arena *arena, const struct nh_theory *theory);
void nh_pen_glossary(nh_pen *pen, const char *words);
/* A table ends with nh_pen_table_end; heads are separated by |. */
void nh_pen_table(nh_pen *pen, const char *caption, const char *heads);
void nh_pen_table_end(nh_pen *pen);

void nh_pen_open(nh_pen *pen, nh_pen_part part, const char *id, const char *title);
void nh_pen_close(nh_pen *pen, nh_pen_part part);
/* adds words to the open part */
void nh_pen_say(nh_pen *pen, const char *format, ...) __attribute__((format(printf, 2, 3)));
void nh_pen_theory(nh_pen *pen, const char *words);  /* the same with $..$ */
void nh_pen_letters(nh_pen *pen, const char *label); /* letters of the theory, within words */
void nh_pen_words(nh_pen *pen, const char *format, ...) __attribute__((format(printf, 2, 3))); /* a paragraph */
/* an item of a list of facts */
void nh_pen_fact(nh_pen *pen, const char *name, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* nh_pen_close ends it */
void nh_pen_fact_begin(nh_pen *pen, const char *name);
void nh_pen_name(nh_pen *pen, const char *name); /* the name of a coordinate, a velocity, .., within words */
/* A field as the sum of its components times d/d(coordinate), within words. */
void nh_pen_field(nh_pen *pen, nh_dag *dag, size_t n, const char *const *coordinate, const nh_ex *component);
/* Formulas under headings; NULL: writes nothing. */
void nh_pen_sheet(nh_pen *pen, nh_sheet *sheet);
void nh_pen_row(nh_pen *pen, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* a cell of an open row */
void nh_pen_cell(nh_pen *pen, nh_pen_part part, const char *format, ...) __attribute__((format(printf, 3, 4)));
void nh_pen_heading(nh_pen *pen, const char *title); /* a heading within a section: it ends the card */
/* a heading within a card; `id`: its place on a page, or NULL */
void nh_pen_name_heading(nh_pen *pen, const char *id, const char *name);
void nh_pen_code(nh_pen *pen, const char *text);
void nh_pen_warning(nh_pen *pen, const char *text);
void nh_pen_plot(nh_pen *pen, nh_plot *plot, const char *caption);
/* label = e for formulas that belong together, with the user's abbreviations and names for repeated parts; labels are
 * names, or in the language of notation.h. */
void nh_pen_formulas(nh_pen *pen, size_t n, const char *const *label, const nh_ex *e);
void nh_pen_formula(nh_pen *pen, const char *label, nh_ex e);
bool nh_pen_is_name(const char *label);

#endif
