/* reduction: the result of `nhsym reduce` as a document, as JSON and as equations for LaTeX (docs/formats.md). */
#ifndef NH_REPORT_REDUCTION_H
#define NH_REPORT_REDUCTION_H

#include "base/text.h"
#include "document/pen.h"
#include "document/provenance.h"
#include "commands/reduce.h"

/* `run` may be NULL for a text. */
void nh_reduction_write(const nh_reduction *reduction, const nh_run *run, nh_pen_style style, nh_text *out);
/* The document as a heap string (nh_free); `run` may be NULL. */
char *nh_reduction_json(const nh_reduction *reduction, const nh_run *run);
/* The full motion and those of the stages over common times as comma-separated values; fields beyond the end of a
 * motion are empty. */
void nh_reduction_csv(const nh_reduction *reduction, nh_text *out);
/* The reduced equations of every stage as LaTeX: a block of equations each, for another document. */
void nh_reduction_latex(const nh_reduction *reduction, nh_text *out);

/* The stage as it is printed, where shape coordinates that its group moves have names of their own. */
const nh_reduction_stage *nh_reduction_named(const nh_reduction_stage *stage);
/* The reduced equations of a stage: M_ij, x', p', zeta as pairs of a name and an expression; n pairs in the kinetic's
 * arena.  Expressions are simplified where that is quick. */
typedef struct {
    const char *name;
    nh_ex value;
} nh_reduction_equation;
size_t nh_reduction_equations(const nh_reduction *reduction, const nh_reduction_stage *stage,
                              nh_reduction_equation **out);

/* The variables that are shown: without zeta_1 = zeta1, a velocity of the group that is an independent velocity itself;
 * and the meaning of the letters. */
size_t nh_reduction_shown(const nh_reduction *reduction, const nh_reduction_stage *stage, const char ***label,
                          nh_ex **value);
const char *nh_reduction_letters(const nh_reduction *reduction, const nh_reduction_stage *stage);

/* The stage that is printed k-th: the division by the whole group first where its shape is a point. */
size_t nh_reduction_order(const nh_reduction *reduction, size_t k);
/* "Stage 3, in one step instead of stages 1 and 2": the first two build on each other, the division by the whole group
 * is an alternative. */
const char *nh_reduction_stage_title(const nh_reduction *reduction, size_t stage);
/* "Chaplygin reduction by": the kind of the stage, before the name of its group.  The whole group at once:
 * Euler-Poincare where the shape space is a point, otherwise Lagrange-Poincare; with d'Alembert where there are
 * constraints [CendraDiaz2018]. */
const char *nh_reduction_stage_kind(const nh_reduction_stage *stage);
/* " for k = 2": the parameter values for which the stage's group is one of symmetries; "" where there is no
 * condition. */
const char *nh_reduction_stage_holds(const nh_reduction *reduction, const nh_reduction_stage *stage);
bool nh_reduction_instead(const nh_reduction *reduction, size_t stage);
/* Is it a second stage without a first one, for a system without constraints? */
bool nh_reduction_on_levels(const nh_reduction_stage *stage);
/* Why the symmetries were not counted. */
const char *nh_reduction_not_counted(const nh_kinetic *kinetic);
/* "; globally: SO(2)^3 of dimension 3" where not all symmetries are known to be global, otherwise "". */
const char *nh_reduction_globally(const nh_reduction *reduction, const nh_group *group);
/* Why the energy of a stage's motion was not followed; NULL where it was. */
const char *nh_reduction_no_energy(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* "energy", or "moving energy" for affine constraints. */
const char *nh_reduction_energy(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* The stage whose momenta satisfy a linear equation in the shape, so that as many currents are conserved, perhaps
 * without closed form; or SIZE_MAX. */
size_t nh_reduction_linear_stage(const nh_reduction *reduction);
/* "J", or "E - J"; other letters where the system uses these. */
const char *nh_reduction_momentum_name(const nh_reduction *reduction, const nh_momentum *momentum);
/* "gauge momentum of", before the field. */
const char *nh_reduction_momentum_kind(const nh_momentum *momentum);

/* "joint of wheel", for a joint of the chain. */
const char *nh_reduction_joint_name(const nh_reduction *reduction, size_t joint);

#endif
