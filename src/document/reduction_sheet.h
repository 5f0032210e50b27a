/* reduction_sheet: the objects of a stage of a reduction as a sheet, in the letters of [ChhabraEmami2014] and
   [CendraDiaz2018]. */
#ifndef NH_REDUCTION_SHEET_H
#define NH_REDUCTION_SHEET_H

#include "commands/reduce.h"
#include "document/sheet.h"

/* The brackets of a group's generators: one section. */
nh_sheet *nh_reduction_brackets_sheet(const nh_reduction *reduction, const nh_action *group);
/* The equations of a stage: one section without a heading. */
nh_sheet *nh_reduction_equations_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* Formulas to which the remarks on a stage refer: the density of its measure and the matrix of its linear momenta; NULL
 * where there are none. */
nh_sheet *nh_reduction_remarks_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* NULL for stages without such objects, and where they were not requested. */
nh_sheet *nh_reduction_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);

#endif
