/* A sheet as subsections of a LaTeX document. */
#include "base/memory.h"
#include "document/notation.h"
#include "document/sheet.h"
#include "document/typeset.h"

static void put_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    nh_text_addf(context, "%s\n", piece);
}

static void notation(nh_tex_writer *w, const char *label) { nh_notation_write(label, NH_NOTATION_LATEX, w->out); }

static void terms(const nh_sheet *s, size_t n, const nh_sheet_term *term, nh_tex_writer *w)
{
    if (n == 0) nh_tex_add(w, "0");
    for (size_t i = 0; i < n; i++) {
        bool minus, sum;
        char *text = nh_sheet_coefficient(s, &term[i], &minus, &sum);
        nh_tex_add(w, i ? (minus ? "\\nhbreak - " : "\\nhbreak + ") : minus ? "-" : "");
        nh_tex_add(w, sum ? "(" : "");
        if (!text && term[i].wanted < 1e9)
            nh_text_addf(w->out, "(\\text{too long; -{}-option shown=%.0f shows it})", term[i].wanted);
        else if (!text) nh_tex_add(w, "(\\text{too long for a page})");
        else if (text[0] && !nh_typeset_pieces(text, NH_LATEX, NH_TEX_WIDEST, put_piece, w->out))
            nh_tex_add(w, "(\\text{nested too deep})");
        nh_tex_add(w, sum ? ")" : "");
        nh_tex_add(w, term[i].factor[0] && text && text[0] ? "\\," : "");
        notation(w, term[i].factor);
        nh_free(text);
    }
}

static void put_line(const nh_sheet *s, const nh_sheet_line *line, nh_tex_writer *w)
{
    nh_tex_add(w, "\\nhformula{");
    notation(w, line->tag);
    nh_tex_add(w, line->tag[0] ? "\\quad " : "");
    notation(w, line->label);
    if (!line->label[0]) terms(s, line->left ? line->left : line->right, line->term, w);
    nh_tex_add(w, " = ");
    if (line->label[0]) terms(s, line->right, line->term, w);
    else terms(s, line->left ? line->right : 0, line->term + line->left, w);
    nh_tex_add(w, "}\n");
}

static void put_words(nh_tex_writer *w, const char *words)
{
    nh_text part;
    bool label;
    for (; nh_notation_next(&words, &part, &label); nh_text_clear(&part)) {
        if (label) nh_tex_add(w, "$"), notation(w, nh_text_string(&part)), nh_tex_add(w, "$");
        else nh_tex_words(w, nh_text_string(&part));
    }
    nh_tex_add(w, "\\par\n");
}

void nh_sheet_tex(nh_sheet *s, const char *heading, nh_tex_writer *w)
{
    for (size_t i = 0; i < s->sections; i++) {
        size_t own;
        nh_sheet_section c = nh_sheet_brief(s, i, &own);
        if (c.title[0]) {
            nh_text_addf(w->out, "\\%s*{", heading);
            nh_tex_words(w, c.title);
            nh_tex_add(w, "}\n");
        }
        if (c.words[0]) put_words(w, c.words);
        for (size_t j = 0; j < c.lines; j++) {
            if (j == own) nh_tex_add(w, "where\\par\n");
            if (c.line[j].words) put_words(w, c.line[j].words);
            else put_line(s, &c.line[j], w);
        }
    }
}
