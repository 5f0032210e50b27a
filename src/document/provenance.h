/* provenance: the data to repeat a run: command, files, seed, versions, machine. */
#ifndef NH_PROVENANCE_H
#define NH_PROVENANCE_H

#include "base/json.h"
#include "base/option.h"
#include "system/system.h"

typedef struct {
    const char *command, *system_path, *analysis_path; /* NULL: not known, or none */
    double seed, shown;                                /* the option `shown`: the longest formula of a page */
    double seconds;                                    /* NAN where the report gives it elsewhere, or not at all */
    const char *system_words;                          /* the system as a command line names it; NULL: by its path */
} nh_run;

/* Adds `title`, `parameters` (unless they exist) and `run`. */
void nh_run_json(const nh_run *run, const nh_system *system, nh_json *to);

#endif
