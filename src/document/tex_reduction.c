/* The reduction as a LaTeX document. */
#include <math.h>

#include "document/reduction.h"
#include "document/reduction_sheet.h"
#include "document/tex_internal.h"

static void words(void *to, const char *text)
{
    nh_tex_writer *w = to;
    nh_tex_words(w, text);
    nh_tex_add(w, "\n\n");
}

typedef struct {
    nh_tex_writer w;
    nh_dag *dag;
    const nh_reduction *r;
    size_t names; /* of repeated parts: one sequence for the document */
} document;

static void put(document *d, nh_sheet *s)
{
    s->names = d->names;
    nh_sheet_tex(s, &d->w);
    d->names = s->names;
}

static void remark(void *to, const char *text) { words(&((document *)to)->w, text); }

static void formula(void *to, const char *label, nh_ex e)
{
    document *d = to;
    nh_sheet *s = nh_sheet_create(d->r->arena, d->dag);
    s->shown = d->r->options.shown;
    nh_sheet_begin(s, "", "", "");
    nh_sheet_formula(s, nh_sheet_label(s, "<%s>", label), e);
    put(d, s);
}

static void section(nh_tex_writer *w, const char *title)
{
    nh_tex_add(w, "\\section{");
    nh_tex_words(w, title);
    nh_tex_add(w, "}\n");
}

static void stage(document *d, size_t number)
{
    const nh_reduction *r = d->r;
    const nh_reduction_stage *s = &r->stage[number];
    const char *local = s->local ? ", which acts only locally: many-valued on an angle" : "";
    nh_reduction_pen pen = {d, remark, formula};
    section(&d->w, nh_arena_printf(r->arena, "%s: %s %s%s", nh_reduction_stage_title(r, number), nh_reduction_stage_kind(s), s->group, local));
    nh_reduction_conditions(s, &pen);
    put(d, nh_reduction_equations_sheet(r, s));
    nh_reduction_remarks(r, s, &pen);
    nh_sheet *sheet = nh_reduction_sheet(r, s);
    if (sheet) put(d, sheet);
}

void nh_tex_reduction(const nh_reduction *r, const nh_run *run, nh_text *out)
{
    document d = {{.out = out, .system = r->system, .dag = r->kinetic->dag, .shown = run->shown, .written = INFINITY}, r->kinetic->dag, r, 0};
    nh_tex_head(&d.w, false, "reduction by symmetry");
    nh_tex_add(&d.w, "\\begingroup\\parindent=0pt\\emergencystretch=3em\n");
    for (size_t i = 0; i < r->warnings; i++) {
        nh_tex_add(&d.w, "\\textbf{Warning:} ");
        words(&d.w, r->warning[i]);
    }
    section(&d.w, "The group");
    if (r->all) put(&d, nh_reduction_group_sheet(r, r->all));
    if (r->group != r->all) put(&d, nh_reduction_group_sheet(r, r->group));
    for (size_t i = 0; i < r->stages; i++) stage(&d, i);
    if (r->unused_count) nh_tex_add(&d.w, "\\subsection*{What the stages do without, and why}\n");
    for (size_t i = 0; i < r->unused_count; i++) words(&d.w, nh_arena_printf(r->arena, "%s: %s.", r->unused[i].what, r->unused[i].why));
    if (r->stages && r->group->action.d) put(&d, nh_reduction_momenta_sheet(r));
    nh_tex_written(&d.w);
    nh_tex_repeat(&d.w, run);
    nh_tex_add(&d.w, "\\par\\endgroup\n\\end{document}\n");
}
