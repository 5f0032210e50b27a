/* unfinished: the document of a run that ended before it had a result: the system and the step at which the run
   ended. */
#ifndef NH_UNFINISHED_H
#define NH_UNFINISHED_H

#include "document/pen.h"

typedef struct {
    const nh_system *system;
    const char *doing; /* or "" */
    const char *why;   /* "the time limit of 1 s was reached" */
    bool search;       /* the run of `analyze`, which has a verdict */
} nh_unfinished;

/* A heap string (nh_free). */
char *nh_unfinished_json(const nh_unfinished *unfinished, const nh_run *run);
void nh_unfinished_write(const nh_unfinished *unfinished, const nh_run *run, nh_pen_style style, nh_text *out);

#endif
