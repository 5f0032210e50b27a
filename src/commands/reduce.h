/* reduce: the symmetry group of a system, its reduction, and the reduced motions compared with the full motion. */
#ifndef NH_REDUCE_H
#define NH_REDUCE_H

#include <time.h>

#include "motion/dynamics.h"
#include "reduction/chain.h"
#include "reduction/group.h"
#include "reduction/lagrange_poincare.h"
#include "reduction/linear.h"
#include "reduction/measure_conditions.h"
#include "reduction/momenta.h"
#include "reduction/poincare.h"
#include "reduction/quotient.h"
#include "reduction/reconstruct.h"
#include "reduction/second.h"
#include "reduction/quasi_symmetry.h"

typedef struct {
    const char *system_path;
    size_t settings;
    const nh_setting *setting;
    nh_chart_choice chart;
    const char *initial;      /* "phi=0, omega=2", or NULL; velocities that are not named follow from the constraints */
    bool project;             /* move velocities that violate the constraints to the nearest that do not */
    bool weak;                /* also symmetries that change L by a total derivative */
    /* "3; 1, 2": blocks of generators of the group that is divided out, the smallest normal subgroup last; NULL:
       found */
    const char *chain;
    /* "1,4=1/2; 4,4=3": entries of the inner product g0 of these generators, which chooses the lifts by stages; NULL:
       they are orthonormal */
    const char *inner;
    const char *group;        /* "1, 2, 5" (of the generators found) or "x=1; theta=1, x=-y, y=x", or NULL: chosen */
    /* to which reduced and full motions must agree: their methods and tolerances are chosen for it, options.tolerance
       is a hundredth of it; 0: none is asked for */
    double accuracy;
    bool equations;           /* with the objects of the theory written out */
    nh_options options;
} nh_reduce_request;

/* By which method a motion is computed where an accuracy is wanted. */
typedef struct {
    const char *method;       /* NULL: nothing was chosen */
    double tolerance, step;   /* one of them is NAN */
    /* of the full motion: how far a tighter one is from it; of a stage: from the full motion */
    double error;
    long evaluations;         /* of this motion, with the group's */
    double effort, seconds;   /* counted (base/effort.h), which decides; and the time, which is shown */
    const char *next;         /* of a stage: the second cheapest method; NULL: no other reaches it */
    double times;             /* as much counted work as this one the next needs */
    int runs;                 /* in search of it */
    bool held;
    char why[512];            /* all that in words, or what failed */
} nh_reduction_choice;

/* A symmetry that a stage does without, or a stage that there is not, and why. */
typedef struct {
    const char *what, *why;   /* "e3", "a Chaplygin stage" */
} nh_reduction_unused;

typedef enum {
    NH_STAGE_CHAPLYGIN,
    NH_STAGE_SECOND,
    NH_STAGE_POINCARE,
    NH_STAGE_SLICE,
    NH_STAGE_QUOTIENT
} nh_stage_kind;

/* What is shown of a stage where its objects are asked for. */
typedef struct {
    /* of the metric on the shape space: of the first and second kind; NULL where it is not known */
    const nh_ex *inverse;
    const nh_ex *locked;      /* second kind: of the locked inertia */
    const nh_lagrange_poincare *bundle; /* third kind */
} nh_reduction_theory;

/* The motion of a stage's equations, at the first `count` of the reduction's times. */
typedef struct {
    size_t count, m;          /* 0: there is none; coordinates of the action's kinetic */
    const double *q;          /* count x m: places, after reconstruction */
    size_t charted, momenta;  /* outputs before the slice or the velocities change for the first time; momenta */
    const double *p;          /* charted x momenta */
    const char **name;        /* of the momenta */
} nh_reduction_motion;

/* One stage, written on a slice through the initial state; `shown` is the same on the slice y = 0, where it is regular
   there. */
typedef struct {
    nh_stage_kind kind;
    char *group;              /* name of the group divided out */
    bool local;               /* a generator of it is many-valued on an angle */
    const nh_action *action;
    const nh_slice *slice, *shown_slice;
    const nh_reduced *reduced, *shown;
    const double *start;      /* (x, p) at the initial state, of `reduced` */
    const nh_chaplygin *chaplygin; /* shown; of the first kind */
    /* of the first kind, and of the second for an abelian group (its factor: for two shape coordinates at most) */
    nh_chaplygin_measure measure;
    nh_measure_conditions conditions; /* where there is no measure, or no factor: for which parameters there would be */
    const nh_second *second;  /* shown; of the second kind */
    bool by_stages;           /* third kind: were the equations by stages formed? */
    const nh_ideals *chain;
    nh_poincare poincare;
    nh_linear_momenta linear; /* of the shown equations; third and fourth kind */
    double linear_drift;      /* of these currents along the reduced motion; negative: not followed */
    /* compared with the full motion; false: a second stage whose shape moves under the first group, compared with the
       first */
    bool against_full;
    /* largest difference of a position, relative to the size that positions have had by then (angles: 1 + size) */
    double agreement;
    /* how well the full motion itself is known, measured where the agreement exceeds 100 tolerances; else 0 */
    double unsure;
    double reached;           /* time up to which */
    /* of the reduced motion, relative to the largest of its terms until then; negative: not followed */
    double energy_drift;
    /* second kind: of the spatial momentum, relative to the largest that one of this energy can have; negative: not
       followed */
    double momentum_drift;
    double seconds, speedup;  /* of the reduced motion; full over reduced */
    size_t restarts, charts;  /* of the group's coordinates; changes of the slice or of the velocities */
    nh_reduction_choice choice; /* with an accuracy */
    bool compared, complete;
    bool dependent;           /* it ended where the constraints become dependent */
    const nh_reduction_theory *theory; /* NULL: not asked for */
    nh_reduction_motion motion;
    char note[256];
} nh_reduction_stage;

struct nh_reduction {
    nh_arena *arena;
    nh_system *system;
    nh_model *model;          /* bare */
    nh_model *whole;          /* with its geometry, where a stage needs that; NULL */
    nh_frame_motion *frame;   /* of a quotient; NULL */
    nh_chart_choice chart;
    nh_kinetic *kinetic;
    /* the true one, where `kinetic` has the potential as a force (quasi_symmetry.h); else NULL */
    nh_kinetic *strict;
    size_t weaker;            /* symmetries that change L by a total derivative, beyond those counted in `all` */
    nh_group *all;            /* the whole symmetry group; NULL where fields were given */
    nh_group *group;          /* the one that is reduced by (may be `all`) */
    nh_options options;
    nh_state initial;
    double until, full_seconds;
    double wanted;            /* the accuracy; 0: none is asked for */
    nh_reduction_choice full; /* with an accuracy */
    const char *full_formulation;
    const double *times;      /* at which motions are given and compared */
    size_t full_count;        /* those that the full motion reaches, */
    const double *full_place; /* and its places: full_count x m */
    double full_reached;      /* time up to which the full motion is known well enough to be compared with */
    /* the slices that are shown, of the first stage and of the whole group, and their equations: good for every initial
       state */
    const nh_slice *kept[2];
    const nh_chaplygin *kept_chaplygin;
    const nh_reduced *kept_whole;
    bool brief;               /* motions only: no equations to show, no tests of measures and stages */
    size_t stages;
    nh_reduction_stage stage[4];
    nh_action action[4];      /* of the stages */
    nh_second second[2];
    nh_ideals chain;
    const char *chain_text, *inner_text;
    /* g0 of the generators of the stage that is written by stages, d x d; NULL: they are orthonormal */
    const nh_ex *inner;
    size_t unused_count;
    nh_reduction_unused unused[24];
    nh_momenta momenta;
    nh_chain_symmetries *joints; /* of the kinetic energy, joint by joint; NULL unless the system is given by bodies */
    nh_generator *of_joint;      /* joints->fields: those, with what they leave invariant */
    clock_t begin;
    bool partial;             /* the time limit left something out; a warning says so */
    size_t warnings;
    const char *warning[16];
    double seconds;
};

/* NULL with a message on bad input (a file, fields that are no symmetries or do not close, a singular place). */
nh_reduction *nh_reduction_create(const nh_reduce_request *request, nh_error *error);
/* The stages once more from another initial state, the sample point `place` of r->kinetic, with all that is compared
   (what is shown is not made again). */
bool nh_reduction_again(nh_reduction *reduction, size_t place, nh_error *error);

const char *nh_stage_kind_name(nh_stage_kind kind);
/* Is a stage's motion further from the full one than 100 tolerances and what the full one itself is unsure by?  (The
 * triangle's inequality: then it is further than 100 tolerances from the true motion.) */
bool nh_stage_apart(const nh_reduction_stage *stage, const nh_options *options);

#endif
