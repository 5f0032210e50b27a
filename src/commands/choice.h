/* choice: the methods and velocities that --accuracy compares for one motion. */
#ifndef NH_CHOICE_H
#define NH_CHOICE_H

#include "motion/accuracy.h"

typedef struct {
    nh_system *system;
    const nh_model *model;
    uint64_t seed;
    bool may_derive;  /* the model in coordinate velocities, too: the chart was not chosen by the user */
    double deriving;  /* units of effort that the model took */
    nh_model *other;    /* that was derived; or NULL */
    nh_integration_plans ways;       /* to be given to nh_trajectory_accurate while this stays where it is */
} nh_choice;

/* `plain`: only the model's own velocities and methods with error control can be used.  The fields up to `deriving` are
   filled in.  nh_choice_close. */
void nh_choice_open(nh_choice *choice, bool plain);
void nh_choice_close(nh_choice *choice);

#endif
