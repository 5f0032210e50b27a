/* reduce_internal: shared by reduce.c (the question) and reduce_stages.c (the stages and their motions). */
#ifndef NH_REDUCE_INTERNAL_H
#define NH_REDUCE_INTERNAL_H

#include "study/reduce.h"

/* Add a warning to the result. */
void nh_reduction_warn(nh_reduction *reduction, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Choose the stages, carry them out and compare their motions with the full one. */
bool nh_reduction_stages(nh_reduction *reduction, nh_error *error);

#endif
