/* reduction: what `nhsym reduce` found, as text and as JSON (docs/formats.md). */
#ifndef NH_REPORT_REDUCTION_H
#define NH_REPORT_REDUCTION_H

#include "base/text.h"
#include "report/run.h"
#include "study/reduce.h"

void nh_reduction_text(const nh_reduction *reduction, bool verbose, nh_text *out);
/* The document as a heap string (nh_free); `run` may be NULL. */
char *nh_reduction_json(const nh_reduction *reduction, const nh_run *run);
/* The reduced equations of every stage: one C function each, and one block of equations each for LaTeX. */
void nh_reduction_c(const nh_reduction *reduction, nh_text *out);
void nh_reduction_latex(const nh_reduction *reduction, nh_text *out);

/* The reduced equations of a stage: M_ij, x', p', zeta as pairs of a name and an expression; n pairs in the kinetic's arena.  Expressions are
 * simplified where that is quick. */
typedef struct {
    const char *name;
    nh_ex value;
} nh_reduction_equation;
size_t nh_reduction_equations(const nh_reduction *reduction, const nh_reduction_stage *stage, nh_reduction_equation **out);

#endif
