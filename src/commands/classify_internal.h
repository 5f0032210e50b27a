/* For the files of the command. */
#ifndef NH_CLASSIFY_COMMAND_INTERNAL_H
#define NH_CLASSIFY_COMMAND_INTERNAL_H

#include "commands/classify.h"

/* The values of the other parameters, with these inserted, on the heap; returns their number. */
nh_setting *nh_classified_settings(const nh_classified *classified, size_t count, const nh_setting *at, size_t *all);
/* classify_confirm.c: what holds at one value, where the number is `bound`. */
void nh_classified_confirm(nh_classified *classified, const nh_classify_request *request, const nh_setting *at,
                           size_t bound, nh_classified_finding *out);
/* Analyses at values of all parameters, where the numbers are those of `special`, which may become lower: a finding. */
void nh_classified_analyse(nh_classified *classified, const nh_classify_request *request, const nh_setting *at,
                           nh_classify_special *special, nh_classified_finding *out);

/* classify_places.c: "1/3". */
const char *nh_classified_ratio(nh_arena *arena, int64_t top, int64_t bottom);
/* -b/a where the polynomial is a v + b, for parameter number v; in the arena. */
const char *nh_classified_graph(const nh_classified *classified, const nh_special_factor *polynomial, int v);
/* Lists the places, from the parts and from isolated points, which are analysed. */
void nh_classified_list_places(nh_classified *classified, const nh_classify_request *request);

#endif
