/* geometry_sheet: the geometry of a system (search/theory.h) as a sheet, in the letters of [CechMusilova2014]. */
#ifndef NH_GEOMETRY_SHEET_H
#define NH_GEOMETRY_SHEET_H

#include "document/sheet.h"
#include "search/theory.h"

/* `analysis`: the file whose abbreviations are used, or NULL. */
nh_sheet *nh_geometry_sheet(nh_arena *arena, const nh_theory *theory, const nh_analysis_file *analysis);
/* Its last sections: the space of constraint symmetries, where it was computed (symmetry_sheet.c). */
void nh_symmetry_sheet(nh_sheet *sheet, const nh_theory *theory);
/* The member `equations` of a result: null without a theory. */
void nh_geometry_json(nh_arena *arena, const nh_theory *theory, const nh_analysis_file *analysis, nh_json *to);

#endif
