/* geometry_sheet: the geometry of a system (search/theory.h) as a sheet, in the letters of [CechMusilova2014]. */
#ifndef NH_GEOMETRY_SHEET_H
#define NH_GEOMETRY_SHEET_H

#include "document/sheet.h"
#include "search/theory.h"

/* `analysis`: the file whose abbreviations are used, or NULL. */
nh_sheet *nh_geometry_sheet(nh_arena *arena, const nh_theory *theory, const nh_analysis_file *analysis);
/* Its last sections: the space of constraint symmetries, where it was computed (symmetry_sheet.c). */
void nh_symmetry_sheet(nh_sheet *sheet, const nh_theory *theory);
/* The member `key` of a result, as `equations`: null without a theory. */
void nh_geometry_json(nh_arena *arena, const nh_theory *theory, const nh_analysis_file *analysis, nh_json *to,
                      const char *key);

/* What a reader looks for first, in the chart of the model: sections in this order, some without lines. */
enum {
    NH_OVERVIEW_VELOCITIES,
    NH_OVERVIEW_LAGRANGIAN,
    NH_OVERVIEW_FIELDS,
    NH_OVERVIEW_FORCES,
    NH_OVERVIEW_INERTIA,
    NH_OVERVIEW_EQUATIONS,
    NH_OVERVIEW_MULTIPLIERS
};
nh_sheet *nh_geometry_overview(nh_arena *arena, const nh_model *model, const nh_options *options);

#endif
