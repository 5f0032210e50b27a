/* export_latex: a document that the user can edit: a paragraph for each function, with formulas aligned where they fit
 * on a line and names for parts of long ones. */
#include <stdlib.h>
#include <string.h>

#include "base/escape.h"
#include "document/export_internal.h"
#include "document/tex_internal.h"
#include "document/typeset.h"
#include "graph/measure.h"
#include "graph/node.h"

enum { widest_row = 60, longest_whole = 150 }; /* letters of a line; the longest formula without names for its parts */

/* The letter of an array; NULL: its entries have names of their own. */
static const char *letter_of(const char *name)
{
    static const char *const letters[][2] = {
        {"mass", "M"},       {"bias", "h"},      {"jacobian", "F"},        {"drift", "g"},    {"violation", "f"},
        {"force", "A"},      {"momentum", "p"},  {"multiplier", "\\mu"},   {"reaction", "R"}, {"energy", "E"},
        {"lagrangian", "L"}, {"zeta", "\\zeta"}, {"gradient", "\\partial"}};
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
        if (!strcmp(letters[i][0], name)) return letters[i][1];
    return NULL;
}

/* A name as a formula; x'' has two dots. */
static void put_name(const char *name, nh_text *out)
{
    size_t length = strlen(name);
    bool twice = length > 2 && !strcmp(name + length - 2, "''");
    char *base = nh_strdup(name);
    if (twice) base[length - 2] = 0;
    if (twice) nh_text_add(out, "\\ddot{");
    if (!nh_typeset(base, NH_LATEX, out)) {
        nh_text_add(out, "\\mathrm{");
        for (const char *c = base; *c; c++) nh_text_addf(out, *c == '_' ? "\\_" : "%c", *c);
        nh_text_add(out, "}");
    }
    if (twice) nh_text_add(out, "}");
    nh_free(base);
}

static void put_left(const nh_export_function *f, const nh_export_array *a, size_t row, size_t column, nh_text *out)
{
    const char *letter = letter_of(a->name), *label = nh_export_label(f, a, row);
    size_t states = 0;
    if (!letter && *label) {
        put_name(label, out);
        return;
    }
    bool slope = !strcmp(a->name, "gradient");
    if (slope) {
        nh_text_add(out, "\\partial ");
        put_name(label, out);
        nh_text_add(out, "/\\partial ");
        if (column == 0) nh_text_add(out, "t");
        else if (states = f->argument[0].rows, column <= states)
            put_name(nh_export_label(f, &f->argument[0], column - 1), out);
        else put_name(nh_export_label(f, &f->argument[1], column - 1 - states), out);
        return;
    }
    nh_text_add(out, letter ? letter : a->name);
    if (a->rows == 1 && a->columns == 1) return;
    nh_text_add(out, "_{");
    if (*label) put_name(label, out);
    else nh_text_addf(out, "%zu", row + 1);
    if (a->columns > 1) nh_text_add(out, *label && a->columns == a->rows ? "\\," : ",");
    if (a->columns > 1 && a->columns == a->rows && *label) put_name(nh_export_label(f, a, column), out);
    else if (a->columns > 1) nh_text_addf(out, "%zu", column + 1);
    nh_text_add(out, "}");
}

/* ---- rows: a left side in LaTeX and a right side in the expression language ---- */

typedef struct {
    char *left, *right;
} row;

typedef struct {
    row *list;
    size_t count, capacity;
} rows;

static void add_row(rows *r, const char *left, const char *right)
{
    nh_grow(&r->list, &r->capacity, r->count + 1, sizeof *r->list);
    r->list[r->count++] = (row){nh_strdup(left), nh_strdup(right)};
}

static void put_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    nh_text_add(context, piece);
}

/* Aligns several short formulas; a long one becomes a paragraph that TeX breaks. */
static void put_rows(rows *r, nh_text *out)
{
    bool aligned = false;
    for (size_t i = 0; i < r->count; i++) {
        row *at = &r->list[i];
        bool fits = nh_typeset_width(at->right) < widest_row;
        if (aligned) nh_text_add(out, fits ? " \\\\\n" : "\n\\end{align*}\n");
        if (fits && !aligned) nh_text_add(out, "\\begin{align*}\n");
        nh_text_addf(out, fits ? "%s &= " : "\\nhformula{%s = ", at->left);
        if (fits) nh_typeset(at->right, NH_LATEX, out);
        else nh_typeset_pieces(at->right, NH_LATEX, NH_TEX_WIDEST, put_piece, out);
        if (!fits) nh_text_add(out, "}\n");
        aligned = fits;
        nh_free(at->left);
        nh_free(at->right);
    }
    if (aligned) nh_text_add(out, "\n\\end{align*}\n");
    nh_free(r->list);
    *r = (rows){0};
}

/* Statements `name = expression`, one on each line. */
static void add_statements(rows *r, nh_text *lines)
{
    for (char *line = lines->data; line && *line;) {
        size_t length = strcspn(line, "\n");
        char *equal = strstr(line, " = ");
        nh_text left;
        nh_text_init(&left);
        line[length] = *equal = 0;
        put_name(line, &left);
        add_row(r, nh_text_string(&left), equal + 3);
        nh_text_clear(&left);
        line += length + 1;
    }
    nh_text_clear(lines);
}

/* ---- functions ---- */

typedef struct {
    const nh_export_function *f;
    nh_source *code;
    nh_text lines; /* the statements of the code */
    nh_text *out;
} writer;

static char *formula(writer *w, nh_ex e)
{
    nh_source_put(w->code, e);
    char *text = nh_strdup(nh_text_string(&w->lines));
    nh_text_clear(&w->lines);
    return text;
}

static void add_array(writer *w, rows *r, const nh_export_array *a)
{
    for (size_t i = 0; i < a->rows; i++)
        for (size_t j = 0; j < a->columns; j++) {
            nh_ex e = a->e[i * a->columns + j];
            bool square = a->columns > 1 && a->rows == a->columns,
                 again = square && j < i && a->e[j * a->columns + i] == e;
            if (again || (a->columns > 1 && nh_is_zero(w->f->dag, e))) continue;
            nh_text left;
            nh_text_init(&left);
            put_left(w->f, a, i, j, &left);
            char *right = formula(w, e);
            bool itself = !letter_of(a->name) && !strcmp(right, nh_export_label(w->f, a, i)); /* phi'' = phi'' */
            if (!itself) add_row(r, nh_text_string(&left), right);
            nh_free(right);
            nh_text_clear(&left);
        }
}

/* The rows of matrix unknown = right as equations; for an iteration, right = 0. */
static void put_solve(writer *w, const nh_export_solve *s)
{
    nh_dag *d = w->f->dag;
    nh_text_add(w->out,
                s->newton ? "Dependent velocities satisfy\n" : "Unknowns are determined by\n\\begin{gather*}\n");
    rows r = {0};
    if (s->newton) {
        for (size_t i = 0; i < s->n; i++) {
            char *right = formula(w, s->right[i]);
            add_row(&r, "0", right);
            nh_free(right);
        }
        put_rows(&r, w->out);
        return;
    }
    for (size_t i = 0; i < s->n; i++) {
        bool any = false;
        for (size_t j = 0; j < s->n; j++) {
            if (nh_is_zero(d, s->matrix[i * s->n + j])) continue;
            nh_text_addf(w->out, any ? " + A_{%zu,%zu}\\, " : "A_{%zu,%zu}\\, ", i + 1, j + 1);
            put_name(nh_name_of(d, s->unknown[j]), w->out);
            any = true;
        }
        nh_text_addf(w->out, " = b_{%zu}%s\n", i + 1, i + 1 < s->n ? " \\\\" : "");
    }
    nh_text_add(w->out, "\\end{gather*}\nwith\n");
    nh_export_array A = {.name = "A", .rows = s->n, .columns = s->n > 1 ? s->n : 1, .e = s->matrix},
                    b = {.name = "b", .rows = s->n, .columns = 1, .e = s->right};
    const char **none = nh_alloc_array(s->n + 1, sizeof *none);
    for (size_t i = 0; i < s->n; i++) none[i] = "";
    A.label = b.label = none;
    add_array(w, &r, &A);
    add_array(w, &r, &b);
    put_rows(&r, w->out);
    nh_free(none);
}

static void put_function(const nh_export *x, const nh_export_function *f, nh_text *out)
{
    nh_arena *arena = nh_arena_create();
    nh_ex *e;
    size_t n = nh_export_expressions(f, arena, &e);
    writer w = {.f = f, .out = out};
    nh_text words;
    rows r = {0};
    bool whole = true;
    nh_text_init(&words);
    nh_text_init(&w.lines);
    nh_export_words(x, f, "", &words);
    nh_text_addf(out, "\n\\subsection*{");
    nh_tex_words(&(nh_tex_writer){.out = out}, f->name);
    nh_text_add(out, "}\n");
    nh_tex_words(&(nh_tex_writer){.out = out}, nh_text_string(&words));
    nh_text_add(out, "\n");
    nh_text_clear(&words);
    w.code = nh_source_create(&nh_source_plain, f->dag, &w.lines);
    for (size_t i = 0; i < n; i++) whole = whole && nh_complexity(f->dag, e[i]) <= longest_whole;
    if (whole) nh_source_whole(w.code);
    else nh_source_plan(w.code, n, e);
    nh_source_parts(w.code, n, e);
    if (w.lines.length) {
        add_statements(&r, &w.lines);
        put_rows(&r, out);
    }
    for (size_t i = 0; i < f->solves; i++) put_solve(&w, &f->solve[i]);
    for (size_t i = 0; i < f->results; i++) add_array(&w, &r, &f->result[i]);
    if (r.count) put_rows(&r, out);
    nh_source_free(w.code);
    nh_text_clear(&w.lines);
    nh_arena_free(arena);
}

void nh_export_latex(const nh_export *x, nh_text *out)
{
    nh_text_add(out, "% ");
    nh_escape_line(x->system->title, out);
    nh_text_addf(out,
                 "; exported by nhsym " NH_VERSION
                 "\n\\documentclass{article}\n\\usepackage[margin=2.5cm]{geometry}\n\\usepackage{amsmath}"
                 "\n\\usepackage[T1]{fontenc}\n\\allowdisplaybreaks\n%s\\begin{document}\n\\section*{",
                 nh_tex_formula_macro);
    nh_tex_words(&(nh_tex_writer){.out = out}, x->system->title);
    nh_text_add(out, "}\n");
    for (size_t i = 0; i < x->notes; i++) {
        nh_tex_words(&(nh_tex_writer){.out = out}, x->note[i]);
        nh_text_add(out, ".\n\n");
    }
    for (size_t i = 0; i < x->functions; i++) put_function(x, &x->function[i], out);
    nh_text_add(out, "\\end{document}\n");
}
