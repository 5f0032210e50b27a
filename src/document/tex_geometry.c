/* The geometry of a system, and its motion as formulas, as sections of a LaTeX document. */
#include "document/geometry_sheet.h"
#include "document/motion_sheet.h"
#include "document/tex_internal.h"

void nh_tex_geometry(nh_tex_writer *w, nh_arena *arena, const struct nh_theory *t)
{
    if (!t) return;
    nh_tex_add(w, "\\section{Geometry}\nIn ");
    nh_tex_chart(w, t->model->chart->name);
    nh_tex_words(w, ", with the numbers of the equations in \u010cech and Musilov\u00e1 (2014).");
    nh_tex_add(w, "\n");
    nh_sheet_tex(nh_geometry_sheet(arena, t, w->analysis), "subsection", w);
}

void nh_tex_explicit_motion(nh_tex_writer *w)
{
    nh_sheet *sheet = nh_motion_sheet(w->r);
    if (!sheet) return;
    sheet->section->title = ""; /* that of the section */
    nh_tex_add(w, "\\section{Explicit motion}\n");
    nh_sheet_tex(sheet, "subsection", w);
}
