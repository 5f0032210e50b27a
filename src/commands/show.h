/* show: the geometry of a system, without a question about a current: its chart, its fields, the coefficients of its
 * equations. */
#ifndef NH_SHOW_H
#define NH_SHOW_H

#include "commands/request.h"
#include "geometry/model.h"
#include "search/theory.h"

typedef struct {
    nh_arena *arena;
    nh_system *system;
    nh_model *model, *other; /* in the chart that was chosen; in coordinate velocities beside quasi ones, or NULL */
    nh_options options;
    nh_theory *own,
        *theory; /* in that chart; in coordinate velocities (perhaps the same); NULL before nh_shown_complete */
} nh_shown;

/* NULL with a message; nh_shown_free. */
nh_shown *nh_shown_create(const nh_request *request, nh_error *error);
/* Derives `own` and `theory`, which a first screen does not need: of a long Lagrangian they take long. */
void nh_shown_complete(nh_shown *shown);
void nh_shown_free(nh_shown *shown);

/* The model in coordinate velocities, for one in quasi-velocities of a system with constraints; else NULL. */
nh_model *nh_shown_other(const nh_model *model, const nh_options *options);

#endif
