/* For the files of the command. */
#ifndef NH_CLASSIFY_COMMAND_INTERNAL_H
#define NH_CLASSIFY_COMMAND_INTERNAL_H

#include "commands/classify.h"

/* The family without a classification, and its currents that hold for every value, which are on the heap. */
nh_classified *nh_classified_open(const nh_classify_request *request, nh_error *error);
nh_ex *nh_classified_known(nh_classified *classified);
nh_classify_question nh_classified_question(nh_classified *classified, const nh_classify_request *request,
                                            const nh_ex *known);

/* The index of a parameter; false with an error. */
bool nh_classified_parameter(const nh_system *system, const char *name, size_t *out, nh_error *error);

/* -b/a where the curve or surface is a v + b, for the parameter v (0: the first that the family varies); in the arena.
 * NULL: it is not of this form. */
const char *nh_classified_graph(const nh_classified *family, const nh_special_surface *surface, int v);

/* The values of the other parameters with these between them, on the heap; how many they are. */
nh_setting *nh_classified_settings(const nh_classified *classified, size_t count, const nh_setting *at, size_t *all);
/* classify_confirm.c: what holds at one value, where the number is `bound`. */
void nh_classified_confirm(nh_classified *classified, const nh_classify_request *request, const nh_setting *at,
                           size_t bound, nh_classified_value *out);

/* With these values beside those of the other parameters. */
nh_analysis *nh_classified_analyse(const nh_classified *classified, const nh_classify_request *request, size_t count,
                                   const nh_setting *at, nh_error *error);
/* The value that a system that was read gives to a name: a ratio, in the arena, and about; NULL: none. */
const char *nh_classified_value_of(nh_arena *arena, const nh_system *system, const char *name, double *about);
/* The degree up to which its currents account for the number of integrals; 0: none. */
size_t nh_classified_complete(const nh_analysis *analysis);
/* The same for what was proved for every value, where the equations of a family are free of its parameters. */
size_t nh_classified_complete_everywhere(const nh_classified *family);

#endif
