/* The parts of a document as a page. */
#include "base/memory.h"
#include "document/facts.h"
#include "document/pen.h"
#include "document/typeset.h"
#include "exact/normal.h"
#include "graph/print.h"

static const struct {
    /* text before the id or the title; before the title of a part that has one; at its end */
    const char *open, *titled, *close;
} markup[NH_PEN_PARTS] = {
    [NH_PEN_SECTION] = {"<section id=\"", "<h2>", "</section>\n"},
    [NH_PEN_CARD] = {"<article class=\"card\">\n", "<h3>", "</article>\n"},
    [NH_PEN_FOLD] = {"<details>", "<summary>", "</details>\n"},
    [NH_PEN_SCREEN] = {"<details class=\"screen\">", "<summary>", "</details>\n"},
    [NH_PEN_WORDS] = {"<p>", NULL, "</p>\n"},
    [NH_PEN_ANSWER] = {"<p class=\"answer ", NULL, "</p>\n"},
    [NH_PEN_WARNING] = {"<p class=\"warning\"><strong>Warning:</strong> ", NULL, "</p>\n"},
    [NH_PEN_HEADING] = {"", "<h3>", ""},
    [NH_PEN_SUBHEADING] = {"<h4>", NULL, "</h4>\n"},
    [NH_PEN_NAME] = {"<h3>", NULL, "</h3>\n"},
    [NH_PEN_TAGS] = {"<p class=\"tags\">", NULL, "</p>\n"},
    [NH_PEN_TAG] = {"<span>", NULL, "</span>"},
    [NH_PEN_BESIDE] = {"<div class=\"beside\">\n", NULL, "</div>\n"},
    [NH_PEN_FACTS] = {"<dl>\n", NULL, "</dl>\n"},
    [NH_PEN_FACT] = {"", NULL, "</dd>\n"},
    [NH_PEN_FACT_NAME] = {"<dt>", NULL, "</dt><dd>"},
    [NH_PEN_ROW] = {"<tr>", NULL, "</tr>\n"},
    [NH_PEN_CELL] = {"<td>", NULL, "</td>"},
    [NH_PEN_ROW_HEAD] = {"<th scope=\"row\">", NULL, "</th>"},
    [NH_PEN_KIND] = {"<td class=\"", NULL, "</td>"},
    [NH_PEN_LETTERS] = {"<math>", NULL, "</math>"},
    [NH_PEN_SUBTITLE] = {"", "<h4>", ""},
    [NH_PEN_REMARK] = {"<p>", NULL, "</p>\n"},
    [NH_PEN_FORMULA] = {"<div class=\"formula\">", NULL, "</div>\n"},
    [NH_PEN_NUMBER] = {"<math displaystyle=\"true\">", NULL, "</math> \u2002"},
    [NH_PEN_LABEL] = {"<math displaystyle=\"true\">", NULL, "</math> "},
    [NH_PEN_EQUALS] = {"<math><mo>=</mo></math> ", NULL, ""},
    [NH_PEN_ZERO] = {"<math><mn>0</mn></math>", NULL, ""},
    [NH_PEN_WHERE] = {"<div class=\"where\"><p>where</p>\n", NULL, "</div>\n"},
};

static void begin(void *to, const char *what) { nh_html_begin(to, what); }

static void links(void *to, const char *sections) { nh_html_links(to, sections); }

static void open(void *to, nh_pen_part part, const char *id, const char *title)
{
    if (part == NH_PEN_CARD || part == NH_PEN_SECTION) ((nh_html_writer *)to)->names = 0;
    nh_html_add(to, part == NH_PEN_NAME && id ? "<h3 id=\"" : markup[part].open);
    if (id) nh_html_text(to, id);
    /* shown when the pointer rests on it */
    if (part == NH_PEN_KIND && title && *title) nh_html_add(to, "\" title=\""), nh_html_text(to, title);
    if (id) nh_html_add(to, "\">");
    if (!title || !markup[part].titled) return;
    nh_html_add(to, markup[part].titled);
    nh_html_prose(to, title);
    nh_html_add(to, "</");
    nh_html_add(to, markup[part].titled + 1);
    nh_html_add(to, "\n");
}

static void close(void *to, nh_pen_part part) { nh_html_add(to, markup[part].close); }

static void words(void *to, const char *text) { nh_html_prose(to, text); }

static void number(void *to, double value, int digits) { nh_html_number(to, value, digits); }

static void count(void *to, size_t value) { nh_html_count(to, value); }

static void names(void *to, const char *text) { nh_html_chart_name(to, text); }

static void source(void *to, const char *formula) { nh_html_source(to, formula); }

static void add_markup(void *to, const char *text) { nh_html_add(to, text); }

static void put_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    nh_text_add(context, piece);
    if (follows != NH_FOLLOWS_NOTHING)
        nh_text_addf(context, "</math>%s<math displaystyle=\"true\">", follows == NH_FOLLOWS_FACTOR ? "\u00ad" : " ");
}

/* A line may break between the pieces of a coefficient, but neither behind a sign nor before the factor. */
static void term(void *to, const nh_pen_term *t)
{
    enum { widest = 30 }; /* letters of a piece: about the width of a phone */
    nh_html_writer *w = to;
    nh_text pieces;
    nh_text_init(&pieces);
    if (!t->coefficient && t->wanted < 1e9)
        nh_text_addf(&pieces, "<mtext>(too long; --option shown=%.0f shows it)</mtext>", t->wanted);
    else if (!t->coefficient) nh_text_add(&pieces, "<mtext>(too long for a page)</mtext>");
    else if (t->coefficient[0] && !nh_typeset_pieces(t->coefficient, NH_MATHML, widest, put_piece, &pieces))
        nh_text_add(&pieces, "<mtext>(nested too deep)</mtext>");
    const char *sign = t->first   ? (t->minus ? "<mo>\u2212</mo>" : "")
                       : t->minus ? "<mo form=\"infix\">\u2212</mo>"
                                  : "<mo form=\"infix\">+</mo>";
    nh_text_addf(w->out, "<math displaystyle=\"true\">%s%s%s%s%s%s</math> ", sign,
                 t->sum ? "<mo stretchy=\"false\">(</mo>" : "", nh_text_string(&pieces),
                 t->sum ? "<mo stretchy=\"false\">)</mo>" : "",
                 t->factor[0] && pieces.length ? "<mspace width=\"0.2em\"></mspace>" : "", t->factor);
    nh_text_clear(&pieces);
}

static void equation(void *to, const char *label, const char *formula)
{
    nh_html_add(to, "<div class=\"formula\">");
    if (*label) nh_html_source(to, label), nh_html_add(to, " <math><mo>=</mo></math> ");
    nh_html_source(to, formula);
    nh_html_add(to, "</div>\n");
}

static void code(void *to, const char *text) { nh_html_tagged(to, "pre", text); }

/* "", a name, or letters of the theory; and the sign behind it. */
static void put_label(nh_html_writer *w, const char *label)
{
    if (!label[0]) return;
    if (nh_pen_is_name(label)) nh_html_source(w, label);
    else nh_html_letters(w, label), nh_html_add(w, " ");
    nh_html_add(w, " <math><mo>=</mo></math> ");
}

static void put_formula(nh_html_writer *w, const char *label, nh_ex e)
{
    char *text = nh_print_string(w->dag, e);
    open(w, NH_PEN_FORMULA, NULL, NULL);
    put_label(w, label);
    nh_html_source(w, text);
    close(w, NH_PEN_FORMULA);
    nh_free(text);
}

static void put_too_long(nh_html_writer *w, const char *label, nh_ex e, double wanted)
{
    bool known = (double)nh_complexity(w->dag, e) <= w->written;
    nh_text words;
    nh_text_init(&words);
    nh_formula_left_out(wanted, &words);
    open(w, NH_PEN_FORMULA, NULL, NULL);
    put_label(w, label);
    nh_html_tagged(w, "em", nh_text_string(&words));
    nh_html_add(w, known ? "<em>; the JSON has it</em>" : "");
    close(w, NH_PEN_FORMULA);
    nh_text_clear(&words);
}

/* in_the_open: the short formulas, with the names that these need; else the long ones, with the names that only these
 * need, which are folded. */
static void put_list(nh_html_writer *w, const nh_formula_list *l, size_t n, const char *const *label, bool in_the_open)
{
    bool any = false;
    for (size_t i = 0; i < n; i++)
        if (l->stands[i] && l->short_enough[i] == in_the_open) put_formula(w, label[i], l->formula[i]);
    for (size_t k = 0; k < l->parts; k++) {
        if (!l->needed[k] || l->beside[k] != in_the_open) continue;
        if (!any) open(w, NH_PEN_WHERE, NULL, NULL);
        any = true;
        put_formula(w, l->part[k].name, l->part[k].value);
    }
    if (any) close(w, NH_PEN_WHERE);
}

static void formulas(void *to, const nh_formula_list *l, size_t n, const char *const *label, const nh_ex *e)
{
    nh_html_writer *w = to;
    size_t folded = 0;
    put_list(w, l, n, label, true);
    for (size_t i = 0; i < n; i++) {
        folded += l->stands[i] && !l->short_enough[i];
        if (!l->stands[i]) put_too_long(w, label[i], e[i], l->wanted);
    }
    if (!folded) return;
    nh_text_addf(w->out, "<details><summary>%zu long formula%s</summary>\n", folded, folded > 1 ? "s" : "");
    put_list(w, l, n, label, false);
    nh_html_add(w, "</details>\n");
}

static void table(void *to, const char *caption, const char *heads) { nh_html_table(to, caption, heads); }

static void table_end(void *to) { nh_html_table_end(to); }

static void plot(void *to, nh_plot *figure, const char *caption) { nh_html_figure(to, figure, caption); }

static void series(void *to, const nh_time_series *motion) { (void)to, (void)motion; }

static void stage(void *to, const nh_stage *motion) { nh_html_stage(to, motion); }

static void symmetry(void *to, const nh_symmetry *z)
{
    nh_text text;
    nh_text_init(&text);
    nh_facts_symmetry(z, NH_FACTS_PAGE, "; ", &text);
    nh_html_theory(to, nh_text_string(&text));
    nh_text_clear(&text);
}

static void glossary(void *to, const char *list) { nh_html_words(to, list); }

static void end(void *to, const nh_run *run)
{
    nh_html_repeat(to, run);
    nh_html_end(to);
}

const nh_pen_ink nh_pen_html = {true,     false,      begin,     links,    open,
                                close,    words,      number,    count,    names,
                                source,   add_markup, term,      equation, code,
                                formulas, table,      table_end, plot,     series,
                                stage,    symmetry,   glossary,  end,      NH_NOTATION_MATHML};
