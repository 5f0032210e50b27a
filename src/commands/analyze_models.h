/* analyze_models: the models of a system, sampled where it moves. */
#ifndef NH_ANALYZE_MODELS_H
#define NH_ANALYZE_MODELS_H

#include "commands/request.h"
#include "search/analysis.h"

/* Makes the models of the question in the velocities that are asked for, and the other one where there are
 * quasi-velocities: on the branch of the initial state, with samples on the time scale of the forces and of the speeds
 * that the constraints allow.  What differs from what a reader expects is a warning.  False with a message. */
bool nh_analyze_models(nh_analysis *analysis, nh_analysis_question *question, const nh_request *request,
                       nh_error *error);

#endif
