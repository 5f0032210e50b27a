/* A sheet as sections of a page. */
#include "base/memory.h"
#include "document/notation.h"
#include "document/sheet.h"
#include "document/typeset.h"

enum { widest = 30 }; /* letters of a piece: about the width of a phone */

static void notation(nh_html_writer *w, const char *label)
{
    if (!label[0]) return;
    nh_html_add(w, "<math displaystyle=\"true\">");
    nh_notation_write(label, NH_NOTATION_MATHML, w->out);
    nh_html_add(w, "</math> ");
}

static void put_words(nh_html_writer *w, const char *words)
{
    nh_html_add(w, "<p>");
    nh_html_theory(w, words);
    nh_html_add(w, "</p>\n");
}

static void put_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    nh_text_add(context, piece);
    if (follows != NH_FOLLOWS_NOTHING)
        nh_text_addf(context, "</math>%s<math displaystyle=\"true\">", follows == NH_FOLLOWS_FACTOR ? "\u00ad" : " ");
}

/* A line may break between the pieces of a coefficient, but neither behind a sign nor before the factor. */
static void put_term(const nh_sheet *s, const nh_sheet_term *term, bool first, nh_html_writer *w)
{
    bool minus, sum;
    char *text = nh_sheet_coefficient(s, term, &minus, &sum);
    nh_text pieces;
    nh_text_init(&pieces);
    if (!text && term->wanted < 1e9)
        nh_text_addf(&pieces, "<mtext>(too long; --option shown=%.0f shows it)</mtext>", term->wanted);
    else if (!text) nh_text_add(&pieces, "<mtext>(too long for a page)</mtext>");
    else if (text[0] && !nh_typeset_pieces(text, NH_MATHML, widest, put_piece, &pieces))
        nh_text_add(&pieces, "<mtext>(nested too deep)</mtext>");
    const char *sign = first   ? (minus ? "<mo>\u2212</mo>" : "")
                       : minus ? "<mo form=\"infix\">\u2212</mo>"
                               : "<mo form=\"infix\">+</mo>";
    nh_text_addf(w->out, "<math displaystyle=\"true\">%s%s%s%s", sign, sum ? "<mo stretchy=\"false\">(</mo>" : "",
                 nh_text_string(&pieces), sum ? "<mo stretchy=\"false\">)</mo>" : "");
    if (term->factor[0] && pieces.length) nh_html_add(w, "<mspace width=\"0.2em\"></mspace>");
    nh_notation_write(term->factor, NH_NOTATION_MATHML, w->out);
    nh_html_add(w, "</math> ");
    nh_text_clear(&pieces);
    nh_free(text);
}

static void terms(const nh_sheet *s, size_t n, const nh_sheet_term *term, nh_html_writer *w)
{
    if (n == 0) nh_html_add(w, "<math><mn>0</mn></math>");
    for (size_t i = 0; i < n; i++) put_term(s, &term[i], i == 0, w);
}

static void put_line(const nh_sheet *s, const nh_sheet_line *line, nh_html_writer *w)
{
    nh_html_add(w, "<div class=\"formula\">");
    notation(w, line->tag);
    if (line->tag[0]) nh_html_add(w, "\u2002");
    notation(w, line->label);
    if (!line->label[0]) terms(s, line->left ? line->left : line->right, line->term, w);
    nh_html_add(w, "<math><mo>=</mo></math> ");
    if (line->label[0]) terms(s, line->right, line->term, w);
    else terms(s, line->left ? line->right : 0, line->term + line->left, w);
    nh_html_add(w, "</div>\n");
}

void nh_sheet_html(nh_sheet *s, const char *heading, nh_html_writer *w)
{
    for (size_t i = 0; i < s->sections; i++) {
        size_t own;
        nh_sheet_section c = nh_sheet_brief(s, i, &own);
        if (c.title[0]) nh_html_tagged(w, heading, c.title);
        if (c.words[0]) put_words(w, c.words);
        for (size_t j = 0; j < c.lines; j++) {
            if (j == own) nh_html_add(w, "<div class=\"where\"><p>where</p>\n");
            if (c.line[j].words) put_words(w, c.line[j].words);
            else put_line(s, &c.line[j], w);
        }
        if (c.lines > own) nh_html_add(w, "</div>\n");
    }
}
