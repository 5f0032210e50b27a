/* verify: tests whether a function is a first integral, or a field a constraint symmetry.
 *
 * A current is confirmed by proof or by its digits, and shown with the field it comes from; or refuted with a point at
 * which its rate is not zero.  A field Z^0, Z^s is a constraint symmetry when zeta^i from it satisfies (N0), (NX),
 * (NY). */
#ifndef NH_VERIFY_H
#define NH_VERIFY_H

#include "commands/request.h"
#include "search/analysis.h"

struct nh_verification {
    nh_arena *arena;
    /* while the question is read: its options, and what else `analyze` needs for a name such as Phi_1, or NULL */
    const nh_options *options;
    const nh_request *request;
    nh_system *system;
    nh_model *model;
    /* in the chart; for a field: its current alpha(Z), if it lies in the canonical distribution */
    nh_ex current;
    bool named;   /* it was asked for by a name of verify_names.c: the formula is an answer, too */
    nh_ex *form;  /* for a field: i_Z phi^a, one for each constraint; else NULL */
    bool outside; /* for a field: these do not vanish, so Z is not in the canonical distribution */
    /* for a field: the question is whether it is a symmetry of the equations of motion, [Gamma,Z] = f Gamma, and not a
     * constraint symmetry */
    bool of_equations;
    nh_ex factor; /* then: f = Gamma(Z^0); `current` has no meaning */
    /* then: known currents of the system file, and Z(Phi) of each, which is a current, too [CechMusilova2014, sec.
     * 3.3] */
    size_t made;
    nh_named *make;
    bool conserved; /* or: it is a symmetry */
    /* where a current is conserved in a part of the motions only (integrals/region.h); then `conserved` is false,
     * unless motions end with that part */
    const char *region;
    bool trivial; /* the current is constant */
    /* branch of a quadratic constraint: "z' < 0", where this was computed, and "z' > 0"; or NULL */
    const char *branch, *other_branch;
    bool on_both;  /* the current is conserved on the other branch, too */
    bool on_other; /* it is conserved on the other branch alone: proved there */
    bool has_symmetry;
    nh_symmetry symmetry;
    struct nh_theory *theory; /* the geometry, if it was requested; else NULL */
    nh_model *other;          /* then: the chart of coordinate velocities, for a chart of quasi-velocities; or NULL */
    nh_proof proof;
    bool fitted;     /* of a system with tables: no proof is tried (integrals/fitted.h) */
    double residual; /* largest relative rate at random points */
    bool has_counterexample;
    double *counterexample; /* model->width values (t, q, w, u) */
    double rate;            /* Gamma(Phi), or the violated equation, there */
    /* for a field: which expression does not vanish, as a label of document/notation.h, and the equation's number in
     * [CechMusilova2014], or 0 */
    const char *equation;
    size_t equation_number;
    const struct nh_simulation *motion; /* one motion, for a page that is being written; or NULL */
};

/* Tests a function of the system, of E and Lbar, and of the currents that the file knows.  These three take the system:
 * the caller frees it with the result, and it is freed already on failure.  NULL with a message for bad input. */
nh_verification *nh_verification_of_current(nh_system *system, nh_chart_choice chart, const char *current,
                                            const nh_options *options, nh_error *error);
/* Tests a field "Z0=..; phi=..; x=..": components along t and the coordinates; those that are not named are 0.  Or a
 * sum of functions times Gamma, and times Z(..), the field of a current: "Gamma/Lbar". */
nh_verification *nh_verification_of_field(nh_system *system, nh_chart_choice chart, const char *field,
                                          const nh_options *options, nh_error *error);

/* Is the field a symmetry of the equations of motion?  Components along velocities that are not named follow from the
 * others: Z is prolonged. */
nh_verification *nh_verification_of_motions(nh_system *system, nh_chart_choice chart, const char *field,
                                            const nh_options *options, nh_error *error);
/* The question of a request, by one of these three: --current, --field, --of.  Here Phi_1 may be a current as `analyze`
 * names it. */
nh_verification *nh_verification_create(const nh_request *request, nh_error *error);

/* The geometry written out, with the bracket of the field, if there is one. */
void nh_verification_write_out(nh_verification *verification, const nh_options *options);

#endif
