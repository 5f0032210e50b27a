/* analyze_known: what an analysis says of the currents that the system file states. */
#ifndef NH_ANALYZE_KNOWN_H
#define NH_ANALYZE_KNOWN_H

#include "search/analysis.h"

/* Fills result->stated, in the order of the file, and warns of statements that are false.  An interrupted run leaves
 * out the rest. */
void nh_analyze_known(nh_analysis *result);

#endif
