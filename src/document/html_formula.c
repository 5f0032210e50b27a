/* Formulas on a page. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/typeset.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/html_internal.h"

enum { widest = 30 }; /* symbols of a piece: about the width of a phone; a wider piece scrolls by itself */

/* Without the <mrow> around single symbols, which would be most of a formula's text. */
static void add_compact(nh_text *out, const char *piece)
{
    static const char row[] = "<mrow>", end[] = "</mrow>";
    for (const char *c = piece, *next; *c; c = next) {
        const char *inner = c + sizeof row - 1, *close = !strncmp(c, row, sizeof row - 1) && inner[0] == '<' &&
                                                                 inner[1] == 'm' && strchr("in", inner[2])
                                                             ? strstr(inner, "</m")
                                                             : NULL;
        const char *after = close ? close + sizeof "</mi>" - 1 : NULL;
        next = c + 1;
        if (after && after[-1] == '>' && !strncmp(after, end, sizeof end - 1)) {
            nh_text_add_n(out, inner, (size_t)(after - inner));
            next = after + sizeof end - 1;
        } else {
            nh_text_add_n(out, c, 1);
        }
    }
}

/* Where a line breaks between factors the page shows a dot: the sign of a soft hyphen (page/page.css). */
static void write_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    nh_html_writer *w = context;
    nh_html_add(w, "<math displaystyle=\"true\">");
    add_compact(w->out, piece);
    nh_html_add(w, "</math>");
    if (follows != NH_FOLLOWS_NOTHING) nh_html_add(w, follows == NH_FOLLOWS_FACTOR ? "\u00ad" : " ");
}

void nh_html_source(nh_html_writer *w, const char *text)
{
    if (!nh_typeset_pieces(text, NH_MATHML, widest, write_piece, w)) nh_html_tagged(w, "code", text);
}

/* The same for a name within the text. */
static void write_name(nh_html_writer *w, const char *name)
{
    nh_text formula;
    nh_text_init(&formula);
    if (nh_typeset(name, NH_MATHML, &formula)) nh_text_addf(w->out, "<math>%s</math>", nh_text_string(&formula));
    else nh_html_text(w, name);
    nh_text_clear(&formula);
}

void nh_html_chart_name(nh_html_writer *w, const char *name)
{
    char words[200], one[200];
    const char *list = nh_facts_list(name, words, sizeof words);
    nh_html_text(w, list ? words : name);
    if (!list) return;
    nh_html_add(w, "<span class=\"word\">(");
    for (bool first = true; nh_facts_next(&list, one, sizeof one); first = false) {
        nh_html_text(w, first ? "" : ", ");
        write_name(w, one);
    }
    nh_html_add(w, ")</span>");
}

/* A name, or MathML, which begins with <. */
static void put_label(nh_html_writer *w, const char *label)
{
    if (!label[0]) return;
    if (label[0] == '<') nh_text_addf(w->out, "<math>%s</math> ", label);
    else nh_html_source(w, label);
    nh_html_add(w, " <math><mo>=</mo></math> ");
}

static void line(nh_html_writer *w, const char *label, nh_ex e)
{
    char *text = nh_print_string(w->dag, e);
    nh_html_add(w, "<div class=\"formula\">");
    put_label(w, label);
    nh_html_source(w, text);
    nh_html_add(w, "</div>\n");
    nh_free(text);
}

static void too_long(nh_html_writer *w, const char *label, nh_ex e, double wanted)
{
    bool known = (double)nh_complexity(w->dag, e) <= w->written;
    nh_text words;
    nh_text_init(&words);
    nh_formula_left_out(wanted, &words);
    nh_html_add(w, "<div class=\"formula\">");
    put_label(w, label);
    nh_html_tagged(w, "em", nh_text_string(&words));
    nh_html_add(w, known ? "<em>; the JSON has it</em></div>\n" : "</div>\n");
    nh_text_clear(&words);
}

/* The formulas that are short enough, or the others, with the names that only they need. */
static void put_list(nh_html_writer *w, const nh_formula_list *l, size_t n, const char *const *label, bool beside)
{
    bool any = false;
    for (size_t i = 0; i < n; i++)
        if (l->stands[i] && l->short_enough[i] == beside) line(w, label[i], l->formula[i]);
    for (size_t k = 0; k < l->parts; k++) {
        if (!l->needed[k] || l->beside[k] != beside) continue;
        if (!any) nh_html_add(w, "<div class=\"where\"><p>where</p>\n");
        any = true;
        line(w, l->part[k].name, l->part[k].value);
    }
    if (any) nh_html_add(w, "</div>\n");
}

void nh_html_formulas(nh_html_writer *w, size_t n, const char *const *label, const nh_ex *e)
{
    nh_ex *brief = nh_alloc_array(n + 1, sizeof *brief);
    size_t folded = 0;
    for (size_t i = 0; i < n; i++)
        brief[i] = nh_formula_shortened(w->analysis, w->dag, w->chart ? nh_chart_shown(w->chart, e[i]) : e[i]);
    nh_formula_list l = nh_formula_list_make(w->dag, n, brief, w->shown, &w->names);
    put_list(w, &l, n, label, true);
    for (size_t i = 0; i < n; i++) {
        folded += l.stands[i] && !l.short_enough[i];
        if (!l.stands[i]) too_long(w, label[i], e[i], l.wanted);
    }
    if (folded) {
        nh_text_addf(w->out, "<details><summary>%zu long formula%s</summary>\n", folded, folded > 1 ? "s" : "");
        put_list(w, &l, n, label, false);
        nh_html_add(w, "</details>\n");
    }
    nh_formula_list_clear(&l);
    nh_free(brief);
}
