/* analysis_stage: the motion of an analysis with its quantities, for the top of a page. */
#ifndef NH_ANALYSIS_STAGE_H
#define NH_ANALYSIS_STAGE_H

#include "document/provenance.h"
#include "document/stage.h"
#include "search/analysis.h"

/* NULL where there is no motion.  nh_stage_free. */
nh_stage *nh_analysis_stage(const nh_analysis *result, const nh_run *run);

#endif
