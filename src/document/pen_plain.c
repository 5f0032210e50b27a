/* The parts of a document as text for a terminal: without figures, links, the glossary and the system's file. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/pen.h"
#include "document/screen.h"
#include "graph/print.h"

static const struct {
    const char *open, *close; /* text before the title, or the part; at its end */
    bool titled;
} markup[NH_PEN_PARTS] = {
    [NH_PEN_SECTION] = {"\n", "", true},
    [NH_PEN_CARD] = {"\n", "", true},
    [NH_PEN_FOLD] = {"", "", false},
    [NH_PEN_WORDS] = {"  ", "\n", false},
    [NH_PEN_ANSWER] = {"", "\n", false},
    [NH_PEN_WARNING] = {"warning: ", "\n", false},
    [NH_PEN_HEADING] = {"\n", "", true},
    [NH_PEN_FACTS] = {"", "", false},
    [NH_PEN_FACT] = {"", "\n", false},
    [NH_PEN_FACT_NAME] = {"  ", ": ", false},
    [NH_PEN_SCREEN] = {"", "", false},
    [NH_PEN_SUBHEADING] = {"\n", "\n", false},
    [NH_PEN_NAME] = {"\n", "", false},
    [NH_PEN_TAGS] = {"", "\n", false},
    [NH_PEN_TAG] = {"", "", false},
    [NH_PEN_BESIDE] = {"", "", false},
    [NH_PEN_ROW] = {"", "\n", false},
    [NH_PEN_CELL] = {"", "", false},
    [NH_PEN_ROW_HEAD] = {"", "", false},
    [NH_PEN_KIND] = {"", "", false},
    [NH_PEN_LETTERS] = {"", "", false},
    [NH_PEN_SUBTITLE] = {"\n", "", true},
    [NH_PEN_REMARK] = {"", "", false},
    [NH_PEN_FORMULA] = {"", "", false},
    [NH_PEN_NUMBER] = {"", "  ", false},
    [NH_PEN_LABEL] = {"", "", false},
    [NH_PEN_EQUALS] = {" = ", "", false},
    [NH_PEN_ZERO] = {"0", "", false},
    [NH_PEN_WHERE] = {"  where\n", "", false},
};

enum { line_width = 80, line_indent = 2, formula_hang = 6 };

static void words(void *to, const char *text)
{
    nh_plain_writer *w = to;
    nh_text_add(w->out, text);
}

static void bold(nh_plain_writer *w, const char *text)
{
    nh_text_addf(w->out, w->colour ? "\033[1m%s\033[0m" : "%s", text);
}

static void begin(void *to, const char *what)
{
    nh_plain_writer *w = to;
    (void)what;
    w->folded = w->out;
    w->out = &w->text;
    nh_text_init(w->out);
    nh_text none;
    nh_text_init(&none);
    nh_screen_begin(w->out, w->colour, w->of.system, w->of.open, &none);
}

static void links(void *to, const char *sections) { (void)to, (void)sections; }

static void open(void *to, nh_pen_part part, const char *id, const char *title)
{
    nh_plain_writer *w = to;
    (void)id;
    if (part == NH_PEN_ROW || part == NH_PEN_TAGS) w->cells = 0;
    if ((part == NH_PEN_CELL || part == NH_PEN_ROW_HEAD || part == NH_PEN_KIND) && w->cells++) words(w, "\t");
    if (part == NH_PEN_TAG) words(w, w->cells++ ? "; " : ": ");
    if (part == NH_PEN_FORMULA || part == NH_PEN_REMARK) w->out = &w->line, nh_text_init(w->out);
    if (markup[part].titled && !title) return;
    words(w, markup[part].open);
    if (markup[part].titled) bold(w, title), words(w, "\n");
}

static void close(void *to, nh_pen_part part)
{
    nh_plain_writer *w = to;
    words(w, markup[part].close);
    if (part != NH_PEN_FORMULA && part != NH_PEN_REMARK) return;
    w->out = &w->text;
    if (part == NH_PEN_FORMULA) nh_screen_broken(line_indent, formula_hang, nh_text_string(&w->line), w->out);
    else nh_screen_paragraph(line_indent, line_indent, nh_text_string(&w->line), w->out);
    nh_text_clear(&w->line);
}

static void number(void *to, double value, int digits)
{
    nh_plain_writer *w = to;
    if (isfinite(value)) nh_text_addf(w->out, "%.*g", digits, value);
    else words(w, "-");
}

static void count(void *to, size_t value) { nh_text_addf(((nh_plain_writer *)to)->out, "%zu", value); }

static void term(void *to, const nh_pen_term *t)
{
    nh_plain_writer *w = to;
    nh_text instead;
    nh_text_init(&instead);
    if (!t->factor[0]) nh_formula_left_out(t->wanted, &instead);
    else if (t->wanted < 1e9) nh_text_addf(&instead, "(too long; --option shown=%.0f shows it)", t->wanted);
    else nh_text_add(&instead, "(too long)");
    const char *text = t->coefficient ? t->coefficient : nh_text_string(&instead);
    words(w, !t->first ? (t->minus ? " - " : " + ") : t->minus ? "-" : "");
    nh_text_addf(w->out, t->sum ? "(%s)%s%s" : "%s%s%s", text, text[0] && t->factor[0] ? " " : "", t->factor);
    nh_text_clear(&instead);
}

static void equation(void *to, const char *label, const char *formula)
{
    nh_text_addf(((nh_plain_writer *)to)->out, *label ? "  %s = %s\n" : "  %s%s\n", label, formula);
}

static void code(void *to, const char *text) { nh_text_addf(((nh_plain_writer *)to)->out, "  %s\n", text); }

/* label = value, with names for repeated parts of long ones, which follow. */
static void put_formula(nh_plain_writer *w, const char *label, char *value)
{
    open(w, NH_PEN_FORMULA, NULL, NULL);
    if (nh_pen_is_name(label)) words(w, label);
    else nh_notation_write(label, NH_NOTATION_TEXT, w->out);
    nh_text_addf(w->out, " = %s", value);
    close(w, NH_PEN_FORMULA);
    nh_free(value);
}

static void formulas(void *to, const nh_formula_list *l, size_t n, const char *const *label, const nh_ex *e)
{
    nh_plain_writer *w = to;
    nh_dag *d = w->of.dag;
    nh_text left_out;
    (void)e;
    nh_text_init(&left_out);
    nh_formula_left_out(l->wanted, &left_out);
    for (size_t i = 0; i < n; i++)
        put_formula(w, label[i],
                    l->stands[i] ? nh_print_string(d, l->formula[i]) : nh_strdup(nh_text_string(&left_out)));
    if (l->named) open(w, NH_PEN_WHERE, NULL, NULL);
    for (size_t k = 0; k < l->parts; k++)
        if (l->needed[k]) put_formula(w, l->part[k].name, nh_print_string(d, l->part[k].value));
    nh_text_clear(&left_out);
}

/* ---- tables ---- */

enum { most_columns = 24 };

typedef struct {
    size_t count, length[most_columns];
    const char *cell[most_columns];
} row_cells;

/* A row of the buffer, and the rest behind it. */
static const char *read_row(const char *at, row_cells *row)
{
    *row = (row_cells){0};
    for (bool more = true; more; at++) {
        size_t length = strcspn(at, "\t\n");
        if (row->count < most_columns) row->cell[row->count] = at, row->length[row->count++] = length;
        at += length;
        more = *at == '\t';
    }
    return at;
}

static size_t width_of(const char *text, size_t length)
{
    size_t width = 0;
    for (size_t i = 0; i < length; i++) width += ((unsigned char)text[i] & 0xc0) != 0x80;
    return width;
}

/* The first column, and the columns from..to-1; `moved`: the first column is the last. */
static void put_columns(nh_plain_writer *w, const char *rows, const size_t *width, size_t from, size_t to, bool moved)
{
    row_cells row;
    for (const char *at = rows; *at;) {
        at = read_row(at, &row);
        size_t end = to < row.count ? to : row.count, shown = end > from ? 1 + end - from : 1, pad = 2;
        for (size_t i = 0; i < shown; i++) {
            size_t j = (i + moved) % shown, k = j ? from + j - 1 : 0;
            if (!row.length[k] && i + 1 == shown) continue;
            nh_text_addf(w->out, "%*s%.*s", (int)pad, "", (int)row.length[k], row.cell[k]);
            pad = 2 + width[k] - width_of(row.cell[k], row.length[k]);
        }
        words(w, "\n");
    }
}

/* The table in columns.  Where it is too wide for the line: a first column that is the widest holds words, and is moved
 * to the end; otherwise the columns that have no room stand below, each group with the first column. */
static void put_rows(nh_plain_writer *w, const char *rows)
{
    size_t width[most_columns] = {0}, all = 0, widest = 0, columns = 0, to;
    row_cells row;
    for (const char *at = rows; *at;) {
        at = read_row(at, &row);
        if (row.count > columns) columns = row.count;
        for (size_t k = 0; k < row.count; k++)
            width[k] = (size_t)fmax((double)width[k], (double)width_of(row.cell[k], row.length[k]));
    }
    for (size_t k = 0; k < columns; k++) {
        all += width[k] ? width[k] + 2 : 0;
        if (k && width[k] > widest) widest = width[k];
    }
    size_t first = width[0] + 2;
    bool words_first = width[0] >= widest && all - first <= line_width, parts = first + widest + 2 <= line_width;
    if (all <= line_width || words_first || !parts) {
        put_columns(w, rows, width, 1, columns, all > line_width);
        return;
    }
    for (size_t from = 1; from < columns; from = to) {
        size_t used = first;
        for (to = from; to < columns && used + width[to] + 2 <= line_width; to++) used += width[to] + 2;
        if (from > 1) words(w, "\n");
        put_columns(w, rows, width, from, to, false);
    }
}

static void table(void *to, const char *caption, const char *heads)
{
    nh_plain_writer *w = to;
    nh_text_addf(w->out, *caption ? "\n%s\n" : "%s", caption);
    w->out = &w->rows;
    nh_text_init(w->out);
    for (const char *c = heads; *c; c++)
        if (*c != '#') nh_text_add_n(w->out, *c == '|' ? "\t" : c, 1);
    words(w, "\n");
}

static void table_end(void *to)
{
    nh_plain_writer *w = to;
    w->out = &w->text;
    put_rows(w, nh_text_string(&w->rows));
    nh_text_clear(&w->rows);
}

/* ---- figures: where the axis is logarithmic, a bar for each value, or for the largest of some ---- */

/* A bar between two powers of ten. */
static const char *bar(double value, double lowest, double top)
{
    static const char *const bars[] = {"\u2581", "\u2582", "\u2583", "\u2584", "\u2585", "\u2586", "\u2587", "\u2588"};
    enum { heights = sizeof bars / sizeof *bars };
    double part = (log10(fmax(value, 1e-300)) - lowest) / fmax(top - lowest, 1);
    return bars[(size_t)fmin(fmax(heights * part, 0), heights - 1)];
}

static void put_bars(nh_plain_writer *w, const nh_curve *c, bool timed, double lowest, double top)
{
    enum { most_bars = 48 };
    size_t most_here = timed ? most_bars / 2 : most_bars, n = c->count < most_here ? c->count : most_here;
    for (size_t k = 0; k < n; k++) {
        double most = 0;
        for (size_t i = k * c->count / n; i < (k + 1) * c->count / n; i++) most = fmax(most, c->y[i * c->y_stride]);
        words(w, bar(most, lowest, top));
    }
    words(w, "\n");
}

static void plot(void *to, nh_plot *p, const char *caption)
{
    nh_plain_writer *w = to;
    double top = 0;
    (void)caption;
    if (!p->log_y) return;
    for (size_t k = 0; k < p->curves; k++)
        for (size_t i = 0; i < p->curve[k].count; i++)
            top = fmax(top, log10(fmax(p->curve[k].y[i * p->curve[k].y_stride], 1)));
    for (size_t k = 0; k < p->curves; k++) {
        nh_text_addf(w->out, p->curves > 1 ? "  %s, %s: " : "  %s: ", p->title, p->curve[k].name);
        put_bars(w, &p->curve[k], p->timed, log10(p->floor), top);
    }
}

static void put_number(void *to, double value, int digits)
{
    open(to, NH_PEN_CELL, NULL, NULL);
    number(to, value, digits);
}

/* The observables at a few times. */
static void series(void *to, const nh_time_series *c)
{
    enum { rows = 5, digits = 8 };
    nh_text heads;
    nh_text_init(&heads);
    for (size_t j = 0; j < c->lines; j++)
        if (c->line[j].kind == NH_TRACK_WATCH) nh_text_addf(&heads, "|%s", c->line[j].name);
    if (heads.length && c->count >= rows) {
        nh_text_add(&heads, "|");
        table(to, "", nh_arena_printf(c->model->arena, "t%.*s", (int)heads.length - 1, nh_text_string(&heads)));
        for (size_t i = 0; i < rows; i++) {
            size_t at = i * (c->count - 1) / (rows - 1);
            open(to, NH_PEN_ROW, NULL, NULL);
            put_number(to, c->time[at], digits / 2);
            for (size_t j = 0; j < c->lines; j++)
                if (c->line[j].kind == NH_TRACK_WATCH) put_number(to, c->line[j].value[at * c->line[j].stride], digits);
            close(to, NH_PEN_ROW);
        }
        table_end(to);
    }
    nh_text_clear(&heads);
}

static void symmetry(void *to, const nh_symmetry *z)
{
    nh_facts_symmetry(z, NH_FACTS_TEXT, "; ", ((nh_plain_writer *)to)->out);
}

static void glossary(void *to, const char *list) { (void)to, (void)list; }

static void end(void *to, const nh_run *run)
{
    nh_plain_writer *w = to;
    if (run && isfinite(run->seconds)) nh_text_addf(w->out, "\n%.0f ms\n", 1e3 * run->seconds);
    nh_screen_fold(nh_text_string(&w->text), w->folded);
    nh_text_clear(&w->text);
}

const nh_pen_ink nh_pen_plain = {false, true,   begin, links,    open,     close, words,           number, count,
                                 words, words,  words, term,     equation, code,  formulas,        table,  table_end,
                                 plot,  series, NULL,  symmetry, glossary, end,   NH_NOTATION_TEXT};
