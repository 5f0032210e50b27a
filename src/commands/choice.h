/* choice: the methods and velocities that --accuracy compares for one motion. */
#ifndef NH_CHOICE_H
#define NH_CHOICE_H

#include "motion/accuracy.h"

typedef struct {
    nh_system *system;
    const nh_model *model;
    uint64_t seed;
    /* whether the model in coordinate velocities may be used, too: the user did not choose the chart */
    bool may_derive;
    double deriving; /* units of effort for the derivation of the model */
    nh_model *other; /* the model that was derived; or NULL */
    /* an argument of nh_trajectory_accurate; it points into this record, which must not move */
    nh_integration_plans ways;
} nh_choice;

/* Fills in the other fields; those up to `deriving` are the caller's.  `plain`: only the model's own velocities and
 * methods with error control can be used. nh_choice_close. */
void nh_choice_open(nh_choice *choice, bool plain);
void nh_choice_close(nh_choice *choice);

#endif
