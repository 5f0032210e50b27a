/* embedding_internal: shared by embedding.c and elimination.c. */
#ifndef NH_EMBEDDING_INTERNAL_H
#define NH_EMBEDDING_INTERNAL_H

#include "system/embedding.h"

void nh_embedding_range(const nh_system *system, nh_ex symbol, double *low, double *high);
nh_chart *nh_embedding_new(nh_system *system, const char *name, size_t n, size_t implicit);
void nh_embedding_symbols(nh_chart *chart);          /* symbol, low, high from w and u */
double nh_embedding_score(void *chart, nh_ex e);     /* nh_pivot_score over the probes */
bool nh_embedding_ranks(nh_system *system, uint64_t seed, nh_error *error); /* are the constraints independent? */
nh_chart *nh_embedding_coordinates(nh_system *system, uint64_t seed, nh_error *error);

#endif
