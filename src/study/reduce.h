/* reduce: the symmetry group of a system, what kind of reduction it allows, the reduction, and the reduced motions against the full one. */
#ifndef NH_REDUCE_H
#define NH_REDUCE_H

#include "motion/dynamics.h"
#include "reduction/group.h"
#include "reduction/linear.h"
#include "reduction/momenta.h"
#include "reduction/poincare.h"
#include "reduction/reconstruct.h"
#include "reduction/second.h"

typedef struct {
    const char *system_path;
    size_t settings;
    const nh_setting *setting;
    nh_chart_choice chart;
    const char *initial;      /* "phi=0, omega=2", or NULL; velocities that are not named follow from the constraints */
    bool project;             /* move velocities that violate the constraints to the nearest that do not */
    const char *chain;        /* "3; 1, 2": blocks of generators of the group that is divided out, the smallest normal subgroup last; NULL: found */
    const char *group;        /* "1, 2, 5" (of the generators found) or "x=1; theta=1, x=-y, y=x", or NULL: chosen */
    nh_options options;
} nh_reduce_request;

typedef enum { NH_STAGE_CHAPLYGIN, NH_STAGE_SECOND, NH_STAGE_POINCARE, NH_STAGE_SLICE } nh_stage_kind;

/* One stage, written on a slice through the initial state; `shown` is the same on the slice y = 0, where it is regular there. */
typedef struct {
    nh_stage_kind kind;
    char *group;              /* name of the group divided out */
    const nh_action *action;
    const nh_slice *slice, *shown_slice;
    const nh_reduced *reduced, *shown;
    const double *start;      /* (x, p) at the initial state, of `reduced` */
    const nh_chaplygin *chaplygin; /* shown; of the first kind */
    nh_chaplygin_measure measure;  /* of the first kind, and of the second for an abelian group (its factor: for two shape coordinates at most) */
    const nh_second *second;  /* shown; of the second kind */
    bool by_stages;           /* third kind: were the equations by stages formed? */
    const nh_ideals *chain;
    nh_poincare poincare;
    nh_linear_momenta linear; /* of the shown equations; third and fourth kind */
    double linear_drift;      /* of these currents along the reduced motion; negative: not followed */
    bool against_full;        /* compared with the full motion; false: a second stage whose shape moves under the first group, compared with the first */
    double agreement;         /* largest difference of a position, relative to 1 + size */
    double reached;           /* time up to which */
    double energy_drift;      /* of the reduced motion, relative */
    double momentum_drift;    /* second kind: of the spatial momentum */
    double seconds, speedup;  /* of the reduced motion; full over reduced */
    size_t restarts;
    bool compared, complete;
    char note[256];
} nh_reduction_stage;

typedef struct {
    nh_arena *arena;
    nh_system *system;
    nh_model *model;          /* bare */
    nh_kinetic *kinetic;
    nh_group *all;            /* the whole symmetry group; NULL where fields were given */
    nh_group *group;          /* the one that is reduced by (may be `all`) */
    nh_options options;
    nh_state initial;
    double until, full_seconds;
    size_t stages;
    nh_reduction_stage stage[4];
    nh_action action[4];      /* of the stages */
    nh_second second[2];
    nh_ideals chain;
    const char *chain_text;
    nh_momenta momenta;
    size_t warnings;
    const char *warning[16];
    double seconds;
} nh_reduction;

/* NULL with a message on bad input (a file, fields that are no symmetries or do not close, a singular place). */
nh_reduction *nh_reduce(const nh_reduce_request *request, nh_error *error);
void nh_reduction_free(nh_reduction *reduction);

const char *nh_stage_kind_name(nh_stage_kind kind);

#endif
