/* reduce: the symmetry group of a system, its reduction, and the reduced motions compared with the full motion. */
#ifndef NH_REDUCE_H
#define NH_REDUCE_H

#include <time.h>

#include "commands/request.h"
#include "geometry/growth.h"
#include "motion/dynamics.h"
#include "reduction/chain.h"
#include "reduction/group.h"
#include "reduction/hamilton.h"
#include "reduction/lagrange_poincare.h"
#include "reduction/linear.h"
#include "reduction/measure_conditions.h"
#include "reduction/momenta.h"
#include "reduction/poincare.h"
#include "reduction/quotient.h"
#include "reduction/reconstruct.h"
#include "reduction/second.h"
#include "reduction/quasi_symmetry.h"

/* The method by which a motion is computed where an accuracy is requested. */
typedef struct {
    const char *method;     /* NULL: no method was chosen */
    double tolerance, step; /* one of them is NAN */
    /* of the full motion: distance of a motion with a tighter tolerance; of a stage: distance from the full motion */
    double error;
    long evaluations;       /* of this motion, with those of the motion in the group */
    double effort, seconds; /* counted work (base/effort.h), which decides; and the time, which is shown */
    const char *next;       /* of a stage: the second cheapest method; NULL: no other one reaches the accuracy */
    double times;           /* its counted work, relative to this one */
    int runs;               /* runs that the search took */
    bool held;
    char why[512]; /* the choice in words, or what failed */
} nh_reduction_choice;

/* A symmetry that a stage does not use, or a stage that does not exist, and why. */
typedef struct {
    const char *what, *why; /* "e3", "a Chaplygin stage" */
} nh_reduction_unused;

typedef enum {
    NH_STAGE_CHAPLYGIN,
    NH_STAGE_SECOND,
    NH_STAGE_POINCARE,
    NH_STAGE_SLICE,
    NH_STAGE_QUOTIENT
} nh_stage_kind;

/* The objects of a stage that are shown on request. */
typedef struct {
    /* of the metric on the shape space, in stages of the first and second kind; NULL where it is not known */
    const nh_ex *inverse;
    const nh_ex *locked;                /* second kind: of the locked inertia */
    const nh_lagrange_poincare *bundle; /* third kind */
} nh_reduction_theory;

/* The motion of a stage's equations, at the first `count` of the reduction's times. */
typedef struct {
    size_t count, m; /* 0: there is no motion; coordinates of the action's kinetic energy */
    const double *q; /* count x m: places, after reconstruction */
    /* outputs before the slice or the velocities change for the first time; number of momenta */
    size_t charted, momenta;
    const double *p;   /* charted x momenta */
    const char **name; /* names of the momenta */
} nh_reduction_motion;

/* One stage, written on a slice through the initial state; `shown` is the same stage on the slice y = 0, where that is
 * regular. */
typedef struct nh_reduction_stage {
    nh_stage_kind kind;
    char *group; /* name of the group that is divided out */
    bool local;  /* a generator of it is many-valued on an angle */
    const nh_action *action;
    const nh_slice *slice, *shown_slice;
    const nh_reduced *reduced, *shown;
    /* the equations that are shown against the true accelerations (of a second stage: those of the first) at
     * printed_states states of their slice: the largest difference, relative to the terms */
    double printed;
    size_t printed_states;
    const double *start;           /* (x, p) at the initial state, in the variables of `reduced` */
    const nh_chaplygin *chaplygin; /* shown; of the first kind */
    /* of the first kind, and of the second for an abelian group (its factor: for two shape coordinates at most) */
    nh_chaplygin_measure measure;
    /* where there is no measure, or no factor: for which parameters there would be one */
    nh_measure_conditions conditions;
    const nh_second *second; /* shown; of the second kind */
    bool by_stages;          /* third kind: were the equations by stages derived? */
    const nh_ideals *chain;
    nh_poincare poincare;
    nh_linear_momenta linear; /* of the shown equations; third and fourth kind */
    double linear_drift;      /* largest drift of these currents along the reduced motion; negative: not followed */
    /* was it compared with the full motion?  A second stage whose shape moves under the first group is compared with
     * the first stage */
    bool against_full;
    /* largest difference of a position, relative to the size that positions have had so far (angles: 1 + size) */
    double agreement;
    /* the error of the full motion, measured where the agreement exceeds 100 tolerances; else 0 */
    double unsure;
    double reached; /* time up to which they were compared */
    /* largest drift of the energy of the reduced motion, relative to the largest of its terms so far; negative: not
     * followed */
    double energy_drift;
    /* second kind: largest drift of the spatial momentum, relative to the largest momentum of this energy; negative:
     * not followed */
    double momentum_drift;
    double seconds, speedup;    /* seconds of the reduced motion; time of the full motion over it */
    size_t restarts, charts;    /* of the coordinates of the group; changes of the slice or the velocities */
    nh_reduction_choice choice; /* where an accuracy is requested */
    bool compared, complete;
    bool dependent;                    /* the motion ended where the constraints become dependent */
    const nh_reduction_theory *theory; /* NULL: not requested */
    nh_reduction_motion motion;
    char note[256];
    /* the same with names of their own for shape coordinates that the group moves, to be printed and exported, with
     * Hamilton's form; NULL: it moves none */
    const struct nh_reduction_stage *named;
    const nh_hamilton *hamilton; /* of such a stage; NULL: none, or not computed */
} nh_reduction_stage;

struct nh_reduction {
    nh_arena *arena;
    nh_system *system;
    nh_model *model;        /* bare */
    nh_model *whole;        /* with its geometry, where a stage needs that; NULL */
    nh_frame_motion *frame; /* of a quotient; NULL */
    nh_chart_choice chart;
    nh_kinetic *kinetic;
    /* the true one, where `kinetic` has the potential as a force (quasi_symmetry.h); else NULL */
    nh_kinetic *strict;
    size_t weaker;   /* symmetries that change L by a total derivative, beyond those counted in `all` */
    nh_group *all;   /* the whole symmetry group; NULL where fields were given */
    nh_group *group; /* the group that is divided out (may be `all`) */
    nh_options options;
    nh_state initial;
    double until, full_seconds;
    double wanted;            /* the requested accuracy; 0: none */
    nh_reduction_choice full; /* with an accuracy */
    const char *full_formulation;
    const double *times;      /* times at which motions are given and compared */
    size_t full_count;        /* how many of them the full motion reaches */
    const double *full_place; /* its places: full_count x m */
    double full_reached;      /* time up to which the full motion is accurate enough to be compared with */
    /* the slices that are shown, of the first stage and of the whole group, and their equations, which hold for every
     * initial state */
    const nh_slice *kept[2];
    const nh_chaplygin *kept_chaplygin;
    const nh_reduced *kept_whole;
    bool brief; /* computes motions only: no equations to show, no tests of measures and stages */
    size_t stages;
    nh_reduction_stage stage[4];
    nh_action action[4]; /* of the stages */
    nh_second second[2];
    nh_ideals chain;
    const char *chain_text, *inner_text;
    /* g0 of the generators of the stage whose equations are derived by stages, d x d; NULL: they are orthonormal */
    const nh_ex *inner;
    size_t unused_count;
    nh_reduction_unused unused[24];
    nh_momenta momenta;
    /* of linear constraints: how D grows by brackets (length 0: not computed), and sums of coordinates that it keeps
     * constant: up to m less the last rank */
    nh_growth growth;
    size_t leaf_count;
    nh_ex *leaf;
    /* displacements of joints that leave the kinetic energy invariant; NULL unless the system is given by bodies */
    nh_chain_symmetries *joints;
    nh_generator *of_joint; /* joints->fields: these fields, with what they leave invariant */
    clock_t begin;
    bool partial; /* the time limit caused an omission, which a warning names */
    size_t warnings;
    const char *warning[16];
    double seconds;
    const struct nh_simulation *motion; /* the whole motion, for a page that is being written; or NULL */
};

/* Finds the group and reduces; the caller frees the result.  NULL with a message on bad input (a file, fields that are
 * no symmetries or do not close, a singular place). */
nh_reduction *nh_reduction_create(const nh_request *request, nh_error *error);
/* Computes the stages once more from another initial state, the sample point `place` of r->kinetic, with all
 * comparisons (the shown equations are not computed again). */
bool nh_reduction_again(nh_reduction *reduction, size_t place, nh_error *error);

/* The name of the kind in JSON. */
const char *nh_stage_kind_name(nh_stage_kind kind);
/* Is a stage's motion further from the full one than 100 tolerances plus the error of the full one?  (Then, by the
 * triangle inequality, it is further than 100 tolerances from the true motion.) */
bool nh_stage_apart(const nh_reduction_stage *stage, const nh_options *options);

#endif
