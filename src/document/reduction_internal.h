/* reduction_internal: parts of the document of a reduction; the objects of a stage as sheets, in the letters of
 * [ChhabraEmami2014] and [CendraDiaz2018]. */
#ifndef NH_REDUCTION_DOCUMENT_INTERNAL_H
#define NH_REDUCTION_DOCUMENT_INTERNAL_H

#include "base/text.h"
#include "commands/reduce.h"
#include "document/pen.h"
#include "document/reduction.h"
#include "document/sheet.h"
#include "reduction/hamilton.h"

/* Facts of a stage: the assumptions that it needs. */
void nh_reduction_conditions(const nh_reduction_stage *stage, nh_pen *pen);
/* Remarks after its equations: measure, currents, chain and motions. */
void nh_reduction_remarks(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_pen *pen);
/* Figures of a stage's motion beside the full one; the JSON contains both. */
void nh_reduction_figures(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_pen *pen);
void nh_reduction_motion_json(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_json *to);
void nh_reduction_full_json(const nh_reduction *reduction, nh_json *to);

void nh_reduction_write_answer(const nh_reduction *reduction, bool colour, nh_text *out);

/* How many functions of the positions the constraints alone keep constant; 0 where this is not known. */
size_t nh_reduction_leaves(const nh_reduction *reduction);
/* "constant by the constraints alone, .." after these functions: the growth vector. */
void nh_reduction_growth_words(const nh_reduction *reduction, nh_text *out);
void nh_reduction_growth_json(const nh_reduction *reduction, nh_json *to);

/* ---- sheets ---- */

/* The brackets of a group's generators: one section. */
nh_sheet *nh_reduction_brackets_sheet(const nh_reduction *reduction, const nh_action *group);
/* The equations of a stage: one section without a heading. */
nh_sheet *nh_reduction_equations_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* Formulas to which the remarks on a stage refer: the density of its measure and the matrix of its linear momenta; NULL
 * where there are none. */
nh_sheet *nh_reduction_remarks_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* NULL for stages without such objects, and where they were not requested. */
nh_sheet *nh_reduction_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);

/* Hamilton's form of a stage, in the reduction's arena; NULL where it has none. */
const nh_hamilton *nh_reduction_hamilton(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* H and Upsilon with the momenta as variables; NULL where a stage has no such form. */
nh_sheet *nh_reduction_hamilton_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);
void nh_reduction_hamilton_json(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_json *to);
/* K_rs of the kinetic energy; of a stage K(e_a, e_b) for its group; what Upsilon lacks of a force of a Lagrangian. NULL
 * where there is none. */
nh_sheet *nh_reduction_metric_sheet(const nh_reduction *reduction);
void nh_reduction_metric_json(const nh_reduction *reduction, nh_json *to);
nh_sheet *nh_reduction_inertia_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);
nh_sheet *nh_reduction_helmholtz_sheet(const nh_reduction *reduction, const nh_reduction_stage *stage);
void nh_reduction_helmholtz_json(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_json *to);

#endif
