/* stage: the first screen of a page: the motion as a moving picture with sliders, its conserved quantities as a table,
 * and its plots. */
#ifndef NH_STAGE_H
#define NH_STAGE_H

#include "commands/live.h"
#include "document/time_series.h"

/* A line of the table. */
typedef struct {
    /* "Energy", or "": its symbol; what it means; "the symmetry in time"; "for all m"; a place of the page; each may
     * be "" */
    const char *name, *doc, *from, *sure, *anchor;
    const char *label;   /* of the formula: "E", "p_x", or "" */
    nh_ex value;         /* in the words of readers: E, not -E */
    bool proved, series; /* series: it has no formula */
    double drift;        /* of the program's own motion; NAN: not known */
} nh_stage_row;

typedef struct {
    const nh_time_series *series;
    const nh_observables *tracks; /* line j of the series is track j */
    nh_live *live;
    const char *command; /* "nhsym simulate sleigh": to be continued by options */
    size_t rows;         /* those of the live quantities, in order */
    const nh_stage_row *row;
} nh_stage;

/* The series and the live model of a stage; NULL: nothing happens. */
void nh_stage_free(nh_stage *stage);

#endif
