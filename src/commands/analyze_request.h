/* analyze_request: the question that `analyze` answers. */
#ifndef NH_ANALYZE_REQUEST_H
#define NH_ANALYZE_REQUEST_H

#include "commands/choice.h"
#include "search/analysis.h"

typedef struct {
    const char *command;         /* as it was typed, for reports; may be NULL */
    const char *system_path;     /* a file */
    const char *analysis_path;   /* or NULL: the program chooses */
    size_t settings;             /* --set, after the analysis' own */
    const nh_setting *setting;
    nh_chart_choice chart;       /* NH_CHART_AUTO: the analysis' choice */
    nh_options options;
    double accuracy;             /* of the motions; 0: that of options.tolerance, unchecked */
    bool equations;              /* with the geometry written out */
    bool no_figures;             /* skip the figures of the analysis file: no output shows them */
    bool model_only;             /* no search: no output needs currents */
    bool seed_given, samples_given, tolerance_given, until_given; /* these options outrank the analysis file's values */
} nh_analyze_request;

#endif
