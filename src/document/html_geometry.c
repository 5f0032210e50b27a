/* The geometry of a system, and its motion as formulas, as sections of a page. */
#include "document/geometry_sheet.h"
#include "document/html_internal.h"
#include "document/motion_sheet.h"

void nh_html_geometry(nh_html_writer *w, nh_arena *arena, const struct nh_theory *t)
{
    if (!t) return;
    nh_html_add(w, "<section id=\"geometry\"><h2>Geometry</h2>\n<p>In ");
    nh_html_chart_name(w, t->model->chart->name);
    nh_html_add(w, ", with the numbers of the equations in \u010cech and Musilov\u00e1 (2014).</p>\n");
    nh_sheet_html(nh_geometry_sheet(arena, t, w->analysis), "h3", w);
    nh_html_add(w, "</section>\n");
}

void nh_html_explicit_motion(nh_html_writer *w)
{
    nh_sheet *sheet = nh_motion_sheet(w->r);
    if (!sheet) return;
    sheet->section->title = ""; /* that of the section */
    nh_html_add(w, "<section id=\"explicit\"><h2>Explicit motion</h2>\n");
    nh_sheet_html(sheet, "h3", w);
    nh_html_add(w, "</section>\n");
}
