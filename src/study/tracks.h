/* tracks: what is followed along the test motion, for reports: states, energy, currents, watched quantities, and the drawing. */
#ifndef NH_TRACKS_H
#define NH_TRACKS_H

#include "study/result.h"

/* Fills result->track: every quantity has a name and is a function of the chart.  watch[i] of the validation is then track[i]. */
void nh_tracks_list(nh_result *result);

/* The same as the motion wants it: result->tracks entries, in the result's arena. */
const nh_watch *nh_tracks_watches(const nh_result *result);

#endif
