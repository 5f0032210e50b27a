/* unfinished: the document of a run that ended before it had a result: the system and the step at which the run ended. */
#ifndef NH_UNFINISHED_H
#define NH_UNFINISHED_H

#include "base/text.h"
#include "document/provenance.h"

typedef struct {
    const nh_system *system;
    const nh_run *run;
    const char *doing; /* or "" */
    const char *why;   /* "the time limit of 1 s was reached" */
    bool search;       /* of `analyze`: it has a verdict */
} nh_unfinished;

void nh_unfinished_text(const nh_unfinished *unfinished, nh_text *out);
char *nh_unfinished_json(const nh_unfinished *unfinished);
void nh_unfinished_page(const nh_unfinished *unfinished, nh_text *out);

#endif
