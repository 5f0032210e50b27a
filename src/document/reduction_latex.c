/* reduction_latex: the reduced equations as LaTeX for another document. */
#include <string.h>

#include "base/escape.h"
#include "base/memory.h"
#include "graph/print.h"
#include "document/typeset.h"
#include "document/reduction.h"
#include "document/tex_internal.h"

static void put_stage_name(const nh_reduction *r, size_t i, const char *before, nh_text *out)
{
    const nh_reduction_stage *s = &r->stage[i];
    const char *holds = nh_reduction_stage_holds(r, s);
    nh_text_addf(out, "%s%s (%s), by %s%s%s%s", before, nh_reduction_stage_title(r, i), nh_stage_kind_name(s->kind),
                 s->group, s->local ? ", which acts locally" : "", *holds ? ", a group of symmetries" : "", holds);
}

enum { wide_row = 60 }; /* letters that fit on a line beside the name */

static void put_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    (void)follows;
    nh_text_add(context, piece);
}

/* Rows of one alignment when all fit on a line, otherwise paragraphs that TeX breaks. */
static void put_stage_latex(const nh_reduction *r, const nh_reduction_stage *s, nh_text *out)
{
    nh_reduction_equation *e;
    size_t n = nh_reduction_equations(r, s, &e);
    bool rows = true;
    for (size_t k = 0; k < n; k++) {
        char *text = nh_print_short(r->kinetic->dag, e[k].value, r->options.written);
        rows = rows && text && nh_typeset_width(text) < wide_row;
        nh_free(text);
    }
    if (rows) nh_text_add(out, "\\begin{align*}\n");
    for (size_t k = 0; k < n; k++) {
        char *text = nh_print_short(r->kinetic->dag, e[k].value, r->options.written);
        if (!rows) nh_text_add(out, "\\nhformula{");
        nh_typeset(e[k].name, NH_LATEX, out);
        nh_text_add(out, rows ? " &= " : " = ");
        if (!text) nh_text_add(out, "\\text{(too long to be written out)}");
        else if (rows) nh_typeset(text, NH_LATEX, out);
        else nh_typeset_pieces(text, NH_LATEX, NH_TEX_WIDEST, put_piece, out);
        nh_text_add(out, !rows ? "}\n" : k + 1 < n ? " \\\\\n" : "\n");
        nh_free(text);
    }
    if (rows) nh_text_add(out, "\\end{align*}\n");
}

void nh_reduction_latex(const nh_reduction *r, nh_text *out)
{
    nh_text_add(out, "% ");
    nh_escape_line(r->system->title, out);
    nh_text_addf(out, ": reduced equations of motion, written by nhsym " NH_VERSION "; for the package amsmath\n%s",
                 nh_tex_formula_macro);
    for (size_t i = 0; i < r->stages; i++) {
        put_stage_name(r, i, "\n% ", out);
        nh_text_add(out, "\n");
        put_stage_latex(r, &r->stage[i], out);
    }
}
