/* reduce_internal: shared by reduce.c (the question), reduce_full.c (the full motion), reduce_stages.c (the stages),
 * reduce_compare.c (their motions), reduce_whole.c (the whole group at once) and reduce_quotient.c (other systems),
 * reduce_unused.c (what is not used, and why), reduce_integrable.c (what else is constant), reduce_named.c
 * (names on slices). */
#ifndef NH_REDUCE_INTERNAL_H
#define NH_REDUCE_INTERNAL_H

#include <float.h>
#include <math.h>

#include "commands/reduce.h"

/* the last one in tolerances */
enum { NH_REDUCTION_OUTPUTS = 81, NH_REDUCTION_STEPS = 100000, NH_REDUCTION_ALLOWED = 100 };

/* The error weights in nh_flow_options of every motion that is compared: errors are relative to the size that each
 * state has had. */
static inline double nh_reduction_absolute(const nh_reduction *r) { return fmax(r->options.absolute, DBL_MIN); }

/* reduce_start.c: the state of q->initial, with velocities changed so that they satisfy the constraints; refused where
 * the given velocities do not. */
bool nh_reduction_initial(nh_reduction *reduction, const nh_request *request, nh_error *error);

/* The full motion with which stages are compared. */
typedef struct {
    nh_reduction *r;
    double *times;           /* NH_REDUCTION_OUTPUTS */
    size_t reached;          /* outputs of the full motion */
    double *full;            /* the places, outputs x m */
    double rtol;             /* tolerance of every motion that is compared */
    const nh_method *method; /* method of the reference, where it was not chosen for an accuracy */
    double finest;           /* its tolerance */
    double unsure;           /* see nh_reduction_unsure; 0: not measured */
} nh_reduction_bench;

/* Computes the reference, and the tolerance of all motions; where an accuracy is requested, by the method that reaches
 * it at least cost. */
bool nh_reduction_full_motion(nh_reduction_bench *bench, nh_error *error);
/* The same by a method that is chosen for r->wanted: its error is measured in the distance that decides, and is a
 * quarter of that.  False: the motion does not reach its end, or its equations could not be derived; r->full.why says
 * so, and nothing else has changed. */
bool nh_reduction_full_accurate(nh_reduction_bench *bench);
/* Returns the number of outputs up to which two motions (rows of m or more) are at most `allowed` apart, and the
 * largest distance: for angles modulo 2 pi, relative to 1 + the largest of their sizes, for other coordinates relative
 * to the largest of theirs, so far along the motion. */
size_t nh_reduction_reliable(const nh_kinetic *kinetic, size_t count, const double *a, size_t a_stride, const double *b,
                             size_t b_stride, double allowed, double *farthest);
/* The size of each coordinate at the first output, which is the least size to which differences are relative: of a
 * motion in rows of m or more. */
void nh_reduction_first_sizes(const nh_kinetic *kinetic, size_t count, const double *a, size_t stride, double *size);
/* The largest distance of full motions with two larger tolerances from the reference, but at most
 * NH_REDUCTION_ALLOWED tolerances. */
double nh_reduction_unsure(nh_reduction_bench *bench);

/* The slice through a place, and the one that is shown: y = 0 where that is regular. */
void nh_reduction_make_slices(nh_reduction *reduction, const nh_action *action, const double *q, nh_slice **through,
                              nh_slice **shown);
nh_reduction_stage *nh_reduction_new_stage(nh_reduction *reduction, nh_stage_kind kind, const nh_action *action);
/* The motion of a stage, and the motion with which it is compared. */
typedef struct {
    /* in its charts, from a place and its velocity in the coordinates of the action's kinetic ... */
    nh_atlas *atlas;
    const double *q, *v;
    const double *z; /* ... or (atlas NULL) on the stage's slice alone, from this state */
    size_t outputs;
    const double *want; /* positions, `stride` apart, at the first `reached` outputs */
    size_t stride, reached;
} nh_reduction_time_series;

/* Computes one motion, with reconstruction or without. */
nh_reconstruction *nh_reduction_follow(const nh_reduction_bench *bench, const nh_reduction_stage *stage,
                                       const nh_reduction_time_series *course, bool group,
                                       const nh_reconstruct_how *how, nh_error *error);
/* The largest distance between a reconstructed motion and its counterpart, as far as both go. */
double nh_reduction_farthest(const nh_reduction_stage *stage, const nh_reduction_time_series *course,
                             const nh_reconstruction *motion);
/* The cheapest motion that agrees with the full one to r->wanted, or, where none does, the nearest; and its method.
 * NULL: none could be started. */
nh_reconstruction *nh_reduction_choose(nh_reduction_bench *bench, nh_reduction_stage *stage,
                                       const nh_reduction_time_series *course, nh_reconstruct_how *how);
/* Integrates, reconstructs and compares; fills in the results of the stage. */
void nh_reduction_compare(nh_reduction_bench *bench, nh_reduction_stage *stage, const nh_reduction_time_series *course);
/* The same from the initial state, compared with the full motion; frees the atlas. */
void nh_reduction_compare_full(nh_reduction_bench *bench, nh_reduction_stage *stage, nh_atlas *atlas);

/* A subset of the generators that acts freely, as large as possible; the whole group when it acts freely. */
bool nh_reduction_free_subgroup(nh_reduction *reduction, nh_action *out);
/* Divides a group out at once, with the equations by stages where V + D = TQ. */
bool nh_reduction_whole(nh_reduction_bench *bench, const nh_action *action, nh_error *error);

/* The model with its geometry, on the branch of the initial state. */
bool nh_reduction_whole_model(nh_reduction *reduction, nh_error *error);
/* Divides a group out of equations of any kind that it leaves invariant (quotient.h); finds what is conserved there. */
bool nh_reduction_quotient(nh_reduction_bench *bench, const nh_action *action, nh_error *error);
bool nh_reduction_quotient_momenta(nh_reduction *reduction, nh_error *error);

/* Says why there is no Chaplygin stage, and why a second one does not use some generators. used (of the group's
 * generators): those of the first or the second stage; for a field that normalises the first group (or NULL) condition
 * (ii) decides. */
void nh_reduction_no_chaplygin(nh_reduction *reduction);
void nh_reduction_not_in_second(nh_reduction *reduction, const nh_chaplygin *first, const bool *used,
                                const bool *normalises);

/* What the constraints alone keep constant, and momenta of symmetries of L only along which the reaction vanishes. */
void nh_reduction_integrable(nh_reduction *reduction);

/* Computes the objects of the stages that --equations shows. */
void nh_reduction_write_out(nh_reduction *reduction);

/* The stages as they are printed, where a group moves shape coordinates. */
void nh_reduction_name_moved(nh_reduction *reduction);

/* Is the deadline past?  Then adds a warning that names the step that is skipped. */
bool nh_reduction_late(nh_reduction *reduction, const char *what);
/* Adds a warning to the result. */
void nh_reduction_warn(nh_reduction *reduction, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Chooses the stages, carries them out and compares their motions with the full one. */
bool nh_reduction_stages(nh_reduction *reduction, nh_error *error);

#endif
