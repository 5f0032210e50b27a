/* reduction_internal: declarations for the document of a reduction. */
#ifndef NH_REDUCTION_DOCUMENT_INTERNAL_H
#define NH_REDUCTION_DOCUMENT_INTERNAL_H

#include "document/pen.h"
#include "document/reduction.h"

/* Facts of a stage: the assumptions that it needs. */
void nh_reduction_conditions(const nh_reduction_stage *stage, nh_pen *pen);
/* Remarks after its equations: measure, currents, chain and motions. */
void nh_reduction_remarks(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_pen *pen);
/* Figures of a stage's motion beside the full one; the JSON contains both. */
void nh_reduction_figures(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_pen *pen);
void nh_reduction_motion_json(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_json *to);
void nh_reduction_full_json(const nh_reduction *reduction, nh_json *to);

#endif
