/* live: the model of a motion as JavaScript, for pages and for `export --to js` (docs/export.md). */
#ifndef NH_DOCUMENT_LIVE_H
#define NH_DOCUMENT_LIVE_H

#include "commands/live.h"
#include "document/provenance.h"
#include "search/analysis.h"

/* The function of an expression that JavaScript has no form of here; NULL: it can be written. */
const char *nh_live_js_lacks(const nh_dag *dag, nh_ex e);

/* `var nhsymModel = {..};`, with the functions that it calls.  Where these have more than `most` characters, the model
 * is written without them, and live->why says so. */
enum { NH_LIVE_MOST = 100000 };
void nh_live_js(nh_live *live, const nh_observables *tracks, size_t most, nh_text *out);

/* The motion of an analysis, with these tracks, which begin with its own; NULL where it has none.  The caller frees it
 * (nh_live_free). */
nh_live *nh_live_of_analysis(const nh_analysis *result, const nh_observables *tracks);
/* Can it be written?  Otherwise the reason. */
bool nh_live_possible(const nh_analysis *result, nh_error *error);
/* As a file for Node and for pages: with the integrator. */
void nh_live_js_file(const nh_analysis *result, nh_text *out);

/* "nhsym simulate sleigh --set k=3": the command line of a motion, to be continued by its initial state and end. */
const char *nh_live_command(nh_arena *arena, const nh_run *run, const nh_system *system);

/* A text as a string of JavaScript that may stand in a page. */
void nh_live_js_text(const char *text, nh_text *out);

#endif
