/* reduction_sheet: the objects of a stage of a reduction as a sheet, in the letters of [ChhabraEmami2014] and [CendraDiaz2018]. */
#ifndef NH_REDUCTION_SHEET_H
#define NH_REDUCTION_SHEET_H

#include "commands/reduce.h"
#include "document/sheet.h"

/* Generators and brackets of a group. */
nh_sheet *nh_reduction_group_sheet(const nh_reduction *reduction, const nh_group *group);
/* The equations of a stage, with the fields that it divides out. */
nh_sheet *nh_reduction_equations_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* Conserved momenta of the group: one section. */
nh_sheet *nh_reduction_momenta_sheet(const nh_reduction *reduction);
/* NULL for stages without such objects, and where they were not asked for. */
nh_sheet *nh_reduction_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);

#endif
