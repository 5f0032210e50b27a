/* For the files of the command. */
#ifndef NH_CLASSIFY_COMMAND_INTERNAL_H
#define NH_CLASSIFY_COMMAND_INTERNAL_H

#include "commands/classify.h"

/* The family without a classification, and those of its currents that hold for every value, on the heap. */
nh_classified *nh_classified_open(const nh_classify_request *request, nh_error *error);
nh_ex *nh_classified_known(nh_classified *classified);
nh_classify_question nh_classified_question(nh_classified *classified, const nh_classify_request *request,
                                            const nh_ex *known);

/* The index of a parameter; false with an error. */
bool nh_classified_parameter(const nh_system *system, const char *name, size_t *out, nh_error *error);

/* -b/a where the curve or surface is a v + b, for parameter number v (0: the first that the family varies); in the
 * arena.  NULL: it has no such form. */
const char *nh_classified_graph(const nh_classified *family, const nh_special_surface *surface, int v);

/* The values of the other parameters, with these inserted, on the heap; returns their number. */
nh_setting *nh_classified_settings(const nh_classified *classified, size_t count, const nh_setting *at, size_t *all);
/* classify_confirm.c: what holds at one value, where the number is `bound`. */
void nh_classified_confirm(nh_classified *classified, const nh_classify_request *request, const nh_setting *at,
                           size_t bound, nh_classified_value *out);

/* The analysis with these values beside those of the other parameters. */
nh_analysis *nh_classified_analyse(const nh_classified *classified, const nh_classify_request *request, size_t count,
                                   const nh_setting *at, nh_error *error);
/* The value of a name in a system that was read: a ratio, in the arena, and the double; NULL: none. */
const char *nh_classified_value_of(nh_arena *arena, const nh_system *system, const char *name, double *about);
/* The degree up to which the currents of an analysis account for the number of integrals; 0: none. */
size_t nh_classified_complete(const nh_classified *family, const nh_analysis *analysis);
/* Takes the analysis' own bounds into the numbers of degrees 1 .. rows where they are lower; the degree up to which the
 * products of its currents are as many. */
size_t nh_classified_exact(const nh_classified *x, const nh_analysis *r, size_t rows, nh_classify_number *number);
/* The same for the currents that are proved for every value, where the equations of a family do not depend on its
 * parameters. */
size_t nh_classified_complete_everywhere(const nh_classified *family);

#endif
