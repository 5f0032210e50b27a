/* analyze_request: the question that `analyze` answers. */
#ifndef NH_ANALYZE_REQUEST_H
#define NH_ANALYZE_REQUEST_H

#include "commands/choice.h"
#include "search/analysis.h"

typedef struct {
    const char *command;       /* as the user typed it, for reports; may be NULL */
    const char *system_path;   /* a file */
    const char *system_words;  /* how a command line names it; NULL: by its path */
    const char *analysis_path; /* or NULL: the program chooses */
    size_t settings;           /* --set, applied after the settings of the analysis file */
    const nh_setting *setting;
    nh_chart_choice chart; /* NH_CHART_AUTO: that of the analysis file */
    nh_options options;
    double accuracy;   /* accuracy of motions; 0: options.tolerance, unchecked */
    bool equations;    /* writes the geometry out */
    bool no_figures;   /* skips the figures of the analysis file: no output shows them */
    uint64_t left_out; /* rows of the search (search/staged_search.h) that a developer leaves out */
    bool model_only;   /* does not search: no output needs currents */
    /* these options take precedence over the analysis file's values */
    bool seed_given, samples_given, tolerance_given, until_given;
} nh_analyze_request;

#endif
