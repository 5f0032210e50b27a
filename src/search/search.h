/* search: the parts of an analysis, which commands/analyze.c calls one after another. */
#ifndef NH_SEARCH_H
#define NH_SEARCH_H

#include "integrals/ansatz.h"
#include "integrals/nullspace.h"
#include "search/analysis.h"
#include "search/currents.h"

/* An ansatz that grows in stages, for systems without an analysis file.
 *
 * Each stage is a list of families made of the system's own dictionary; its null space is searched for currents that do
 * not depend on those found before.  The search ends when as many independent currents are known as can exist locally,
 * when the stages are used up, or when the budget is. */

/* Fill result->found, result->stage, result->current (the spectrum of the last stage that found something, else of the
   largest). */
bool nh_staged_search_run(nh_analysis *result, nh_error *error);

/* The name of row i of the search, of which result->left_out leaves out some; NULL from the last one on. */
const char *nh_staged_search_row(size_t i);

/* Null vectors of the sampled problem compared with the counted space of integrals.
 *
 * The null vectors of an ansatz that is polynomial in the velocities belong to the space of all integrals of its
 * degree.  Where the count is complete this space is spanned by products of the proved currents: every null vector must
 * be a combination of these products, at points that neither was computed with. */

/* Keeps the null vectors of a sampled problem, a fit of fields or of currents, until the count is known. */
void nh_agreement_keep(nh_analysis *result, size_t families, const nh_family *family, const nh_ansatz *ansatz,
                       const nh_nullspace *nullspace, bool fields);

/* Sets result->counted_space; a disagreement is a warning as well.  Does nothing where the count is not complete to the
 * ansatz's degree. */
void nh_agreement_find(nh_analysis *result);

/* Fields fitted with the ansatz of an analysis file: for themselves, or to be compared with the currents. */

/* Fits (Z^0, zeta) in the span of the fields of the ansatz' currents, each component for itself.  `currents`: an ansatz
 * of their currents; returned are the null vectors in it, written in independent ones of its columns.  The caller frees
 * both.  NULL: too large an ansatz, or no solution. */
nh_nullspace *nh_routes_fields(nh_analysis *result, const nh_ansatz *ansatz, const nh_points *points,
                               nh_ansatz **currents, nh_error *error);

/* The same, and compares the spaces of currents found:
 * result->symmetry, routes_agree, routes_angle (the sine of the largest angle between them over the sample points). */
void nh_routes_compare(nh_analysis *result, const nh_ansatz *ansatz, const nh_points *points,
                       const nh_nullspace *current);

/* Do the printed formulas hold on the other branch of a quadratic constraint?
 *
 * The chart is computed on one branch.  Formulas with the dependent velocity in the place of the root (nh_chart_shown)
 * are put into the chart of the other branch, with a model of its own, and proved again there. */

/* The model on the other branch of o's chart; NULL where it has none, or cannot be made. */
nh_model *nh_branch_other(const nh_model *o, const nh_options *options);

/* Is phi, of the other branch's model, conserved there as surely as it is here? */
bool nh_branch_conserves(const nh_model *other, nh_ex phi, const nh_proof *here, const nh_options *options);

/* The branches' names, and for equations and currents whether they hold on both. */
void nh_branch_compare(nh_analysis *result);

/* The constraint symmetry of every current that was found, and of every piece. */

/* Fills in `has_symmetry` and `symmetry`, on several threads; the result does not depend on their number.  A symmetry
 * that cannot be computed is a warning. */
void nh_symmetries_find(nh_analysis *result);

/* The default ansatz, samples and motion. */

/* A generic initial state on the constraint submanifold. */
bool nh_defaults_initial(nh_analysis *result, nh_state *state, nh_error *error);

#endif
