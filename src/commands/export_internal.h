/* export_internal: shared by export.c (the question), export_equations.c and export_reduced.c (its parts). */
#ifndef NH_EXPORT_INTERNAL_H
#define NH_EXPORT_INTERNAL_H

#include "commands/export.h"

/* Adds a function at the end of the list, with symbols of this system; it is valid until the next one is added.  `doc`
 * is copied. */
nh_export_function *nh_export_add(nh_export *x, nh_export_part part, const nh_system *system, const char *name,
                                  const char *doc);
/* Adds an argument or a result with copies of symbols or values; entries are labelled by the names of their symbols,
 * unless there are labels. */
void nh_export_argument(nh_export *x, nh_export_function *f, const char *name, const char *doc, size_t n,
                        const nh_ex *symbol);
void nh_export_result(nh_export *x, nh_export_function *f, const char *name, const char *doc, size_t rows,
                      size_t columns, const nh_ex *value, const char *const *label);
/* Adds the solution of matrix unknown = right. */
void nh_export_linear(nh_export *x, nh_export_function *f, size_t n, const nh_ex *matrix, const nh_ex *right,
                      const nh_ex *unknown);
/* Adds the solution of right(unknown) = 0, with the Jacobian `matrix`, from the values in the argument. */
void nh_export_newton(nh_export *x, nh_export_function *f, size_t n, const nh_ex *matrix, const nh_ex *right,
                      const nh_ex *unknown, size_t guess);
void nh_export_note(nh_export *x, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* New symbols that print as base1, base2, ... */
nh_ex *nh_export_symbols(nh_export *x, nh_dag *dag, const char *base, size_t n);

/* ---- the parts ---- */

void nh_export_equations(nh_export *x, const nh_model *model);
void nh_export_momenta(nh_export *x, const nh_model *model);
void nh_export_submanifold(nh_export *x, const nh_model *model);
void nh_export_currents(nh_export *x, const nh_analysis *analysis);
void nh_export_stages(nh_export *x, const nh_reduction *reduction);

#endif
