#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "expr/normal.h"
#include "expr/print.h"
#include "expr/typeset.h"
#include "report/formula.h"
#include "report/html_internal.h"

enum { widest = 60 }; /* symbols of a piece that is not broken */

void nh_html_add(nh_html_writer *w, const char *markup) { nh_text_add(w->out, markup); }
void nh_html_text(nh_html_writer *w, const char *text) { nh_svg_escape(text, w->out); }

void nh_html_tagged(nh_html_writer *w, const char *tag, const char *text)
{
    nh_text_addf(w->out, "<%s>", tag);
    nh_html_text(w, text);
    nh_text_addf(w->out, "</%s>", tag);
}

void nh_html_number(nh_html_writer *w, double value, int digits)
{
    char all[40], shown[60];
    if (!isfinite(value)) {
        nh_html_add(w, "\u2013");
        return;
    }
    nh_text_number(value, all, sizeof all);
    snprintf(shown, sizeof shown, "%.*g", digits, value);
    char *exponent = strchr(shown, 'e');
    nh_text_addf(w->out, "<data value=\"%s\">", all);
    if (exponent) *exponent = 0;
    if (shown[0] == '-') nh_html_add(w, "\u2212");
    nh_html_add(w, shown + (shown[0] == '-'));
    if (exponent) {
        int power = 0;
        sscanf(exponent + 1, "%d", &power);
        nh_text_addf(w->out, "\u00b710<sup>%s%d</sup>", power < 0 ? "\u2212" : "", power < 0 ? -power : power);
    }
    nh_html_add(w, "</data>");
}

void nh_html_count(nh_html_writer *w, size_t value) { nh_text_addf(w->out, "<data value=\"%zu\">%zu</data>", value, value); }

/* ---- formulas ---- */

static void widths(void *context, const char *piece)
{
    size_t *most = context, n = 0;
    for (const char *c = piece; (c = strstr(c, "<m")); c++) n += c[2] == 'i' || c[2] == 'n' || (c[2] == 'o' && c[3] == '>');
    if (n > *most) *most = n;
}

static void write_piece(void *context, const char *piece)
{
    nh_html_writer *w = context;
    nh_text_addf(w->out, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" displaystyle=\"true\"><mrow>%s</mrow></math> ", piece);
}

void nh_html_source(nh_html_writer *w, const char *text)
{
    size_t most = 0;
    const char *equal = strchr(text, '=');
    if (equal && nh_typeset_pieces(text, NH_MATHML, widths, &most) && most > widest / 2) { /* the sides of a long equation may be broken */
        char *left = nh_strdup(text);
        left[equal - text] = 0;
        nh_html_source(w, left);
        nh_html_add(w, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\"><mo>=</mo></math> ");
        nh_html_source(w, equal + 1);
        nh_free(left);
        return;
    }
    if (nh_typeset_pieces(text, NH_MATHML, widths, &most) && most <= widest) nh_typeset_pieces(text, NH_MATHML, write_piece, w);
    else nh_html_tagged(w, "code", text);
}

void nh_html_formula(nh_html_writer *w, const char *label, nh_ex e)
{
    nh_dag *d = w->r->model->dag;
    nh_ex brief = nh_formula_abbreviate(w->r, e);
    char *text = nh_print_short(d, brief, w->r->options.shown);
    nh_html_add(w, "<div class=\"formula\">");
    if (label[0]) {
        nh_html_source(w, label);
        nh_html_add(w, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\"><mo>=</mo></math> ");
    }
    if (text) nh_html_source(w, text);
    else {
        bool known = (double)nh_complexity(d, e) <= w->r->options.written;
        nh_html_add(w, known ? "<em>too long for a page; the JSON has it</em>" : "<em>too long to be written out</em>");
    }
    nh_html_add(w, "</div>\n");
    nh_free(text);
}

void nh_html_figure(nh_html_writer *w, nh_plot *plot, const char *caption)
{
    char id[40];
    if (w->sink) {
        w->sink(w->context, plot, caption);
        return;
    }
    snprintf(id, sizeof id, "fig%zu", ++w->figures);
    plot->id = id;
    nh_html_add(w, "<figure>");
    nh_svg_plot(plot, w->out);
    nh_html_tagged(w, "figcaption", caption);
    nh_html_add(w, "</figure>\n");
}
