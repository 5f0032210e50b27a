/* The parts of a document as text for a terminal, which has neither figures, nor links, nor what others say already: the glossary, the system's file. */
#include <math.h>

#include "base/memory.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/notation.h"
#include "document/pen.h"

static const struct {
    const char *open, *close; /* before the title, or the part; at its end */
    bool titled;
} markup[NH_PEN_PARTS] = {
    [NH_PEN_SECTION] = {"\n", "", true}, [NH_PEN_CARD] = {"\n", "", true},
    [NH_PEN_FOLD] = {"\n", "", true},    [NH_PEN_WORDS] = {"  ", "\n", false},
    [NH_PEN_ANSWER] = {"", "\n", false}, [NH_PEN_WARNING] = {"warning: ", "\n", false},
    [NH_PEN_HEADING] = {"\n", "", true}, [NH_PEN_FACTS] = {"", "", false},
    [NH_PEN_FACT] = {"", "\n", false},   [NH_PEN_FACT_NAME] = {"  ", ": ", false},
    [NH_PEN_SCREEN] = {"", "", false},   [NH_PEN_SUBHEADING] = {"\n", "\n", false},
    [NH_PEN_NAME] = {"\n  ", "\n", false}, [NH_PEN_TAGS] = {"  ", "\n", false},
    [NH_PEN_TAG] = {"", ". ", false},    [NH_PEN_BESIDE] = {"", "", false},
    [NH_PEN_ROW] = {"  ", "\n", false},  [NH_PEN_CELL] = {"", "", false},
    [NH_PEN_ROW_HEAD] = {"", "", false}, [NH_PEN_KIND] = {"", "", false},
};

static void words(void *to, const char *text)
{
    nh_plain_writer *w = to;
    nh_text_add(w->out, text);
}

static void bold(nh_plain_writer *w, const char *text)
{
    nh_text_addf(w->out, w->colour ? "\033[1m%s\033[0m" : "%s", text);
}

/* The title with the values of the parameters. */
static void begin(void *to, const char *what)
{
    nh_plain_writer *w = to;
    const nh_system *s = w->of.system;
    (void)what;
    w->folded = w->out;
    w->out = &w->text;
    nh_text_init(w->out);
    bold(w, s->title);
    nh_text_addf(w->out, "   %s", s->parameters ? "with " : "no parameters");
    for (size_t i = 0; i < s->parameters; i++)
        nh_text_addf(w->out, "%s%s = %.6g", i ? ", " : "", s->parameter[i].name, s->parameter[i].value);
    nh_text_add(w->out, "\n");
}

static void links(void *to, const char *sections) { (void)to, (void)sections; }

static void open(void *to, nh_pen_part part, const char *id, const char *title)
{
    nh_plain_writer *w = to;
    (void)id;
    if (part == NH_PEN_ROW) w->cells = 0;
    if ((part == NH_PEN_CELL || part == NH_PEN_ROW_HEAD || part == NH_PEN_KIND) && w->cells++) words(w, "  ");
    if (markup[part].titled && !title) return;
    words(w, markup[part].open);
    if (markup[part].titled) bold(w, title), words(w, "\n");
}

static void close(void *to, nh_pen_part part) { words(to, markup[part].close); }

static void number(void *to, double value, int digits)
{
    nh_plain_writer *w = to;
    if (isfinite(value)) nh_text_addf(w->out, "%.*g", digits, value);
    else words(w, "-");
}

static void count(void *to, size_t value) { nh_text_addf(((nh_plain_writer *)to)->out, "%zu", value); }

static void letters(void *to, const char *label)
{
    nh_notation_write(label, NH_NOTATION_TEXT, ((nh_plain_writer *)to)->out);
}

static void equation(void *to, const char *label, const char *formula)
{
    nh_text_addf(((nh_plain_writer *)to)->out, *label ? "    %s = %s\n" : "    %s%s\n", label, formula);
}

static void code(void *to, const char *text) { nh_text_addf(((nh_plain_writer *)to)->out, "    %s\n", text); }

static void formulas(void *to, size_t n, const char *const *label, const nh_ex *e)
{
    enum { indent = 4 };
    nh_plain_writer *w = to;
    const nh_pen_subject *of = &w->of;
    nh_text *name = nh_alloc_array(n + 1, sizeof *name);
    const char **shown = nh_alloc_array(n + 1, sizeof *shown);
    nh_ex *brief = nh_alloc_array(n + 1, sizeof *brief);
    for (size_t i = 0; i < n; i++) {
        brief[i] = nh_formula_shortened(of->analysis, of->dag, of->chart ? nh_chart_shown(of->chart, e[i]) : e[i]);
        nh_text_init(&name[i]);
        if (nh_pen_is_name(label[i])) nh_text_add(&name[i], label[i]);
        else nh_notation_write(label[i], NH_NOTATION_TEXT, &name[i]);
        shown[i] = nh_text_string(&name[i]);
    }
    nh_sheet_formulas(of->dag, n, shown, brief, indent, of->shown, w->out);
    for (size_t i = 0; i < n; i++) nh_text_clear(&name[i]);
    nh_free(brief);
    nh_free(shown);
    nh_free(name);
}

static void sheet(void *to, nh_sheet *formulas_of, bool headed)
{
    nh_plain_writer *w = to;
    (void)headed;
    nh_sheet_text(formulas_of, w->colour, w->out);
}

static void table(void *to, const char *caption, const char *heads)
{
    nh_plain_writer *w = to;
    nh_text_addf(w->out, "\n%s\n  ", caption);
    for (const char *c = heads; *c; c++) nh_text_addf(w->out, *c == '|' ? "  " : "%c", *c);
    words(w, "\n");
}

static void table_end(void *to) { words(to, "\n"); }

static void plot(void *to, nh_plot *figure, const char *caption) { (void)to, (void)figure, (void)caption; }

static void series(void *to, const nh_time_series *motion) { (void)to, (void)motion; }

static void symmetry(void *to, const nh_symmetry *z)
{
    nh_facts_symmetry(z, NH_FACTS_TEXT, "; ", ((nh_plain_writer *)to)->out);
}

static void glossary(void *to, const char *list) { (void)to, (void)list; }

static void end(void *to, const nh_run *run)
{
    nh_plain_writer *w = to;
    (void)run;
    nh_sheet_fold(nh_text_string(&w->text), w->folded);
    nh_text_clear(&w->text);
}

const nh_pen_ink nh_pen_plain = {false, true, begin, links, open, close, words, number, count, words, words, letters, equation, code, formulas,
                                 sheet, table, table_end, plot, series, symmetry, glossary, end};
