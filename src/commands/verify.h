/* verify: tests whether a function is a first integral, or a field a constraint symmetry.
 *
 * A current is confirmed by proof or by its digits, and shown with the field it comes from; or refuted with a point at
 * which its rate is not zero.  A field Z^0, Z^s is a constraint symmetry when zeta^i from it satisfies (N0), (NX),
 * (NY). */
#ifndef NH_VERIFY_H
#define NH_VERIFY_H

#include "search/analysis.h"

struct nh_verification {
    nh_arena *arena;
    nh_system *system;
    nh_model *model;
    /* in the chart; of a field: its current alpha(Z), if it lies in the canonical distribution */
    nh_ex current;
    nh_ex *form;              /* of a field: i_Z phi^a, one for each constraint; else NULL */
    bool outside;             /* of a field: they do not vanish, Z is not in the canonical distribution */
    /* of a field: is it a symmetry of the equations of motion, [Gamma,Z] = f Gamma, and no constraint symmetry is asked
       for */
    bool of_equations;
    nh_ex factor;             /* then: f = Gamma(Z^0); `current` means nothing */
    /* then: known currents of the system file, and what Z makes of them: currents too [CechMusilova2014, sec. 3.3] */
    size_t made;
    nh_named *make;
    bool conserved;           /* or: is a symmetry */
    /* a current is conserved in a part of the motions only: where (integrals/region.h); then `conserved` is false, but
       where motions end with that part */
    const char *region;
    bool trivial;             /* the current is constant */
    /* of a quadratic constraint: "z' < 0", where this was computed, and "z' > 0"; or NULL */
    const char *branch, *other_branch;
    bool on_both;             /* a current, as it was asked for, is conserved on the other branch too */
    bool has_symmetry;
    nh_symmetry symmetry;
    struct nh_theory *theory; /* the geometry, where it was asked for; else NULL */
    nh_model *other;          /* then: the chart of coordinate velocities beside a quasi one; or NULL */
    nh_proof proof;
    double residual;          /* largest relative rate on random points */
    bool has_counterexample;
    double *counterexample;   /* model->width values (t, q, w, u) */
    double rate;              /* Gamma(Phi), or the violated equation, there */
    /* of a field: what does not vanish, as a label of document/notation.h, and the equation's number in
       [CechMusilova2014], or 0 */
    const char *equation;
    size_t equation_number;
};

/* NULL for bad input. */
nh_verification *nh_verification_of_current(nh_system *system, nh_chart_choice chart, const char *current,
                                            const nh_options *options, nh_error *error);
/* "Z0=..; phi=..; x=..": components along t and the coordinates, those not named are 0. */
nh_verification *nh_verification_of_field(nh_system *system, nh_chart_choice chart, const char *field,
                                          const nh_options *options, nh_error *error);

/* Is it a symmetry of the equations of motion?  Components along velocities that are not named follow from the others:
   Z is prolonged. */
nh_verification *nh_verification_of_motions(nh_system *system, nh_chart_choice chart, const char *field,
                                            const nh_options *options, nh_error *error);
/* The geometry written out, with the bracket of the field where there is one. */
void nh_verification_write_out(nh_verification *verification, const nh_options *options);

#endif
