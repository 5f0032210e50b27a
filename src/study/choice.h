/* choice: from what --accuracy may choose: what was kept of these equations, and what is measured for this motion and kept for the next. */
#ifndef NH_CHOICE_H
#define NH_CHOICE_H

#include "motion/accuracy.h"
#include "study/ranking.h"

typedef struct {
    nh_arena *arena;
    nh_system *system;
    const nh_model *model;
    uint64_t seed;
    bool remember;    /* read and keep; otherwise it only measures */
    bool may_derive;  /* the model in coordinate velocities, too: the chart was not chosen by the user */
    double deriving;  /* seconds that the model took */
    double begin, end;
    nh_ranking ranking; /* that was kept; its count is 0 where there is none that tells */
    nh_model *other;    /* that was derived; or NULL */
    nh_ways ways;       /* to be given to nh_trajectory_accurate while this stays where it is */
} nh_choice;

/* For an accuracy; `plain`: only the model's own velocities and methods with error control can be used.  The fields up to `end` are filled in.  nh_choice_close. */
void nh_choice_open(nh_choice *choice, double eps, bool plain);
void nh_choice_close(nh_choice *choice);

/* The model in coordinate velocities, derived when that was not done before; NULL: it cannot be had or is of no use. */
const nh_model *nh_choice_derive(nh_choice *choice);

#endif
