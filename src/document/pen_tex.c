/* The parts of a document as LaTeX. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/facts.h"
#include "document/pen.h"
#include "document/typeset.h"
#include "exact/normal.h"
#include "graph/print.h"

static const struct {
    const char *open, *titled, *close; /* text before the title; before it where there is one; at the end of the part */
} markup[NH_PEN_PARTS] = {
    [NH_PEN_SECTION] = {"", "\\section{", "\n"},
    [NH_PEN_CARD] = {"", "\\subsection*{", "\n"},
    [NH_PEN_FOLD] = {"", "\\par\\medskip\\textit{", "\n"},
    [NH_PEN_SCREEN] = {"", NULL, ""},
    [NH_PEN_WORDS] = {"", NULL, "\n\n"},
    [NH_PEN_ANSWER] = {"", NULL, "\n\n"},
    [NH_PEN_WARNING] = {"\\textbf{Warning:} ", NULL, "\n\n"},
    [NH_PEN_HEADING] = {"", "\\subsection*{", ""},
    [NH_PEN_SUBHEADING] = {"\\subsubsection*{", NULL, "}\n"},
    [NH_PEN_NAME] = {"\\subsection*{", NULL, "}\n"},
    [NH_PEN_TAGS] = {"{\\small ", NULL, "\\par}\n"},
    [NH_PEN_TAG] = {"", NULL, "\\quad "},
    [NH_PEN_BESIDE] = {"", NULL, ""},
    [NH_PEN_FACTS] = {"", NULL, ""},
    [NH_PEN_FACT] = {"", NULL, "\\par\n"},
    [NH_PEN_FACT_NAME] = {"\\par\\textit{", NULL, "}: "},
    [NH_PEN_ROW] = {"", NULL, "\\tabularnewline\n"},
    [NH_PEN_CELL] = {"", NULL, ""},
    [NH_PEN_ROW_HEAD] = {"", NULL, ""},
    [NH_PEN_KIND] = {"", NULL, ""},
    [NH_PEN_LETTERS] = {"$", NULL, "$"},
    [NH_PEN_SUBTITLE] = {"", "\\subsubsection*{", ""},
    [NH_PEN_REMARK] = {"", NULL, "\\par\n"},
    [NH_PEN_FORMULA] = {"\\nhformula{", NULL, "}\n"},
    [NH_PEN_NUMBER] = {"", NULL, "\\quad "},
    [NH_PEN_LABEL] = {"", NULL, ""},
    [NH_PEN_EQUALS] = {" = ", NULL, ""},
    [NH_PEN_ZERO] = {"0", NULL, ""},
    [NH_PEN_WHERE] = {"where\\par\n", NULL, ""},
};

static void begin(void *to, const char *what)
{
    nh_tex_head(to, what);
    nh_tex_add(to, "\\begingroup\\parindent=0pt\\emergencystretch=3em\n");
}

/* The source of the system stands where a page has its links. */
static void links(void *to, const char *sections)
{
    nh_tex_writer *w = to;
    const char *source = w->system->source;
    (void)sections;
    if (source && source[0]) nh_tex_add(w, "\\textit{System:} "), nh_tex_words(w, source), nh_tex_add(w, "\n\n");
}

/* Cells are separated by &, which is written before every cell but the first of its row. */
static void open(void *to, nh_pen_part part, const char *id, const char *title)
{
    nh_tex_writer *w = to;
    (void)id;
    if (part == NH_PEN_ROW) w->cells = 0;
    if ((part == NH_PEN_CELL || part == NH_PEN_ROW_HEAD || part == NH_PEN_KIND) && w->cells++) nh_tex_add(w, " & ");
    nh_tex_add(w, markup[part].open);
    if (!title || !markup[part].titled) return;
    nh_tex_add(w, markup[part].titled);
    nh_tex_words(w, title);
    nh_tex_add(w, "}\n");
}

static void close(void *to, nh_pen_part part) { nh_tex_add(to, markup[part].close); }

static void words(void *to, const char *text) { nh_tex_words(to, text); }

static void number(void *to, double value, int digits) { nh_tex_number(to, value, digits); }

static void count(void *to, size_t value) { nh_tex_count(to, value); }

static void names(void *to, const char *text) { nh_tex_chart(to, text); }

static void source(void *to, const char *formula)
{
    nh_tex_writer *w = to;
    nh_text latex;
    nh_text_init(&latex);
    if (nh_typeset(formula, NH_LATEX, &latex)) nh_text_addf(w->out, "$%s$", nh_text_string(&latex));
    else nh_tex_code(w, formula);
    nh_text_clear(&latex);
}

static void add_markup(void *to, const char *text) { nh_tex_add(to, text); }

static void put_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    nh_text_addf(context, "%s\n", piece);
}

static void term(void *to, const nh_pen_term *t)
{
    nh_tex_writer *w = to;
    const char *text = t->coefficient;
    nh_tex_add(w, !t->first ? (t->minus ? "\\nhbreak - " : "\\nhbreak + ") : t->minus ? "-" : "");
    nh_tex_add(w, t->sum ? "(" : "");
    if (!text && t->wanted < 1e9) nh_text_addf(w->out, "(\\text{too long; -{}-option shown=%.0f shows it})", t->wanted);
    else if (!text) nh_tex_add(w, "(\\text{too long for a page})");
    else if (text[0] && !nh_typeset_pieces(text, NH_LATEX, NH_TEX_WIDEST, put_piece, w->out))
        nh_tex_add(w, "(\\text{nested too deep})");
    nh_tex_add(w, t->sum ? ")" : "");
    nh_tex_add(w, t->factor[0] && text && text[0] ? "\\," : "");
    nh_tex_add(w, t->factor);
}

/* latex = text as a formula; where the text is no formula of the language, plain = text. */
static void display(nh_tex_writer *w, const nh_text *latex, const char *plain, const char *text)
{
    nh_text formula;
    nh_text_init(&formula);
    if (nh_typeset_pieces(text, NH_LATEX, NH_TEX_WIDEST, put_piece, &formula)) {
        nh_text_addf(w->out, latex->length ? "\\nhformula{%s = %s}\n" : "\\nhformula{%s%s}\n", nh_text_string(latex),
                     nh_text_string(&formula));
    } else { /* such as a formula that is nested too deep */
        nh_tex_add(w, "\\par{\\footnotesize\\raggedright ");
        nh_tex_code(w, plain);
        nh_tex_add(w, plain[0] ? " = " : "");
        nh_tex_code(w, text);
        nh_tex_add(w, "\\par}\n");
    }
    nh_text_clear(&formula);
}

static void equation(void *to, const char *label, const char *formula)
{
    nh_text latex;
    nh_text_init(&latex);
    if (label[0]) nh_typeset(label, NH_LATEX, &latex);
    display(to, &latex, label, formula);
    nh_text_clear(&latex);
}

static void code(void *to, const char *text)
{
    nh_tex_code(to, text);
    nh_tex_add(to, "\\par\n");
}

/* A name, or words, or letters of the theory, within a formula. */
static void put_label(const char *label, nh_text *out)
{
    nh_tex_writer inner = {.out = out};
    if (!label[0]) return;
    if (!nh_pen_is_name(label)) nh_notation_write(label, NH_NOTATION_LATEX, out);
    else if (!nh_typeset(label, NH_LATEX, out))
        nh_text_add(out, "\\text{"), nh_tex_words(&inner, label), nh_text_add(out, "}");
}

static void put_formula(nh_tex_writer *w, const char *label, nh_ex e)
{
    char *text = nh_print_string(w->dag, e);
    nh_text latex;
    nh_text_init(&latex);
    put_label(label, &latex);
    display(w, &latex, label, text);
    nh_text_clear(&latex);
    nh_free(text);
}

static void put_too_long(nh_tex_writer *w, const char *label, nh_ex e, double wanted)
{
    bool known = (double)nh_complexity(w->dag, e) <= w->written;
    nh_text words;
    nh_text_init(&words);
    nh_formula_left_out(wanted, &words);
    nh_tex_add(w, "\\par $");
    put_label(label, w->out);
    nh_tex_add(w, "$ = ");
    nh_tex_words(w, nh_text_string(&words));
    nh_text_addf(w->out, "%s.\\par\n", known ? "; the JSON has it" : "");
    nh_text_clear(&words);
}

static void formulas(void *to, const nh_formula_list *l, size_t n, const char *const *label, const nh_ex *e)
{
    nh_tex_writer *w = to;
    for (size_t i = 0; i < n; i++) {
        if (l->stands[i]) put_formula(w, label[i], l->formula[i]);
        else put_too_long(w, label[i], e[i], l->wanted);
    }
    if (l->named) nh_tex_add(w, "\\par where\\par\n");
    for (size_t k = 0; k < l->parts; k++)
        if (l->needed[k]) put_formula(w, l->part[k].name, l->part[k].value);
}

/* The heads of the columns, under a line, on every page. */
static void put_heads(nh_tex_writer *w, size_t n, const char *heads)
{
    for (size_t length; n-- > 0; heads += length + (heads[length] == '|')) {
        length = strcspn(heads, "|");
        char *head = nh_alloc_array(length + 1, 1);
        memcpy(head, heads, length);
        double value;
        if (nh_facts_head(head, &value)) nh_tex_number(w, value, 2);
        else nh_tex_words(w, *head == '#' ? head + 1 : head);
        nh_tex_add(w, n ? " & " : "\\tabularnewline\\hline\\noalign{\\vskip 2pt}");
        nh_free(head);
    }
}

/* Columns of equal width that fill the line, smaller and closer where there are many.  The caption is part of the first
 * head, so that no page break separates it from the rows. */
static void table(void *to, const char *caption, const char *heads)
{
    enum { many = 7 };
    nh_tex_writer *w = to;
    size_t n = 1;
    for (const char *c = heads; *c; c++) n += *c == '|';
    nh_text_addf(w->out, "{%s\\begin{longtable}{*{%zu}{p{\\dimexpr\\linewidth/%zu-2\\tabcolsep\\relax}}}\n",
                 n < many ? "\\footnotesize" : "\\scriptsize\\tabcolsep=2pt", n, n);
    nh_text_addf(w->out, "\\multicolumn{%zu}{l}{\\normalsize ", n);
    nh_tex_words(w, caption);
    nh_tex_add(w, "}\\tabularnewline[4pt]\n");
    put_heads(w, n, heads);
    nh_tex_add(w, "\\endfirsthead\n");
    put_heads(w, n, heads);
    nh_tex_add(w, "\\endhead\n");
}

static void table_end(void *to) { nh_tex_add(to, "\\end{longtable}}\n"); }

static void plot(void *to, nh_plot *figure, const char *caption) { nh_tex_plot(to, figure, caption); }

static void draw(void *to, const nh_plot *figure, const char *caption) { nh_tex_plot(to, figure, caption); }

/* The plots of the page; its other contents are for a screen. */
static void series(void *to, const nh_time_series *motion)
{
    nh_tex_writer *w = to;
    nh_text rest;
    nh_text_init(&rest);
    nh_html_writer page = {
        .out = &rest, .system = w->system, .dag = w->dag, .shown = w->shown, .sink = draw, .context = w};
    nh_html_still(&page, motion);
    nh_html_plots(&page, motion);
    nh_text_clear(&rest);
}

static void symmetry(void *to, const nh_symmetry *z)
{
    nh_tex_writer *w = to;
    nh_facts_symmetry(z, NH_FACTS_TEX, "; ", w->out);
}

static void glossary(void *to, const char *list) { (void)to, (void)list; }

static void end(void *to, const nh_run *run)
{
    nh_tex_writer *w = to;
    nh_tex_repeat(w, run);
    nh_tex_add(w, w->fragment ? "\\par\\endgroup\n" : "\\par\\endgroup\n\\end{document}\n");
}

const nh_pen_ink nh_pen_tex = {false,    false,      begin,     links,    open,
                               close,    words,      number,    count,    names,
                               source,   add_markup, term,      equation, code,
                               formulas, table,      table_end, plot,     series,
                               NULL,     symmetry,   glossary,  end,      NH_NOTATION_LATEX};
