/* analysis_json_internal: declarations for analysis_json*.c. */
#ifndef NH_ANALYSIS_JSON_INTERNAL_H
#define NH_ANALYSIS_JSON_INTERNAL_H

#include "base/json.h"
#include "document/analysis_json.h"

/* the motion, and the largest changes of the currents along it */
void nh_analysis_json_validation(const nh_analysis *result, nh_json *to);
void nh_analysis_json_stated(const nh_analysis *result, nh_json *to);  /* what the system file says of currents */
void nh_analysis_json_figures(const nh_analysis *result, nh_json *to); /* those of the analysis file */
/* How many numbers along the motion are not finite. */
size_t nh_analysis_json_holes(const nh_analysis *result);
void nh_analysis_json_completeness(const nh_analysis *result, nh_json *to); /* how many integrals there are */
void nh_analysis_json_stages(const nh_analysis *result, nh_json *to);       /* which stages were tried */

#endif
