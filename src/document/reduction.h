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
/* The full motion and those of the stages over common times: what a motion does not reach is empty. */
void nh_reduction_csv(const nh_reduction *reduction, nh_text *out);
/* The reduced equations of every stage: a block of equations each, to be read into another document. */
void nh_reduction_latex(const nh_reduction *reduction, nh_text *out);

/* The reduced equations of a stage: M_ij, x', p', zeta as pairs of a name and an expression; n pairs in the kinetic's
 * arena.  Expressions are simplified where that is quick. */
typedef struct {
    const char *name;
    nh_ex value;
} nh_reduction_equation;
size_t nh_reduction_equations(const nh_reduction *reduction, const nh_reduction_stage *stage,
                              nh_reduction_equation **out);

/* Those that are shown: without zeta_1 = zeta1, a velocity of the group that serves as one of the equations; and what
   the letters in them mean. */
size_t nh_reduction_shown(const nh_reduction *reduction, const nh_reduction_stage *stage, const char ***label,
                          nh_ex **value);
const char *nh_reduction_letters(const nh_reduction *reduction, const nh_reduction_stage *stage);

/* "Stage 3, in one step instead of stages 1 and 2": the first and the second one build on each other, what divides the
   whole group is an alternative. */
const char *nh_reduction_stage_title(const nh_reduction *reduction, size_t stage);
/* "Chaplygin reduction by": what the stage is, before the name of its group.  The whole group at once: Euler-Poincare
 * where the shape space is a point, else Lagrange-Poincare; with d'Alembert where there are constraints
 * [CendraDiaz2018]. */
const char *nh_reduction_stage_kind(const nh_reduction_stage *stage);
/* " for k = 2": what the stage's group needs to be one of symmetries; "" where that is nothing. */
const char *nh_reduction_stage_holds(const nh_reduction *reduction, const nh_reduction_stage *stage);
bool nh_reduction_instead(const nh_reduction *reduction, size_t stage);
/* A second stage without a first one: of a system without constraints. */
bool nh_reduction_on_levels(const nh_reduction_stage *stage);
/* "; globally: SO(2)^3 of dimension 3" where not all symmetries are known to be so, else "". */
const char *nh_reduction_globally(const nh_reduction *reduction, const nh_group *group);
/* Why the energy of a stage's motion was not followed; NULL where it was. */
const char *nh_reduction_no_energy(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* "energy", or the moving energy of affine constraints. */
const char *nh_reduction_energy(const nh_reduction *reduction, const nh_reduction_stage *stage);
/* The stage whose momenta obey a linear equation in the shape, so that as many currents are conserved though none may
   have a closed form; or SIZE_MAX. */
size_t nh_reduction_linear_stage(const nh_reduction *reduction);
/* "J", or "E - J"; other letters where the system has these for something else. */
const char *nh_reduction_momentum_name(const nh_reduction *reduction, const nh_momentum *momentum);
/* "gauge momentum of", before the field. */
const char *nh_reduction_momentum_kind(const nh_momentum *momentum);

/* "joint of wheel", of a joint of the chain. */
const char *nh_reduction_joint_name(const nh_reduction *reduction, size_t joint);

#endif
