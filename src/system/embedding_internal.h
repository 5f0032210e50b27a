/* embedding_internal: shared by embedding.c and elimination.c. */
#ifndef NH_EMBEDDING_INTERNAL_H
#define NH_EMBEDDING_INTERNAL_H

#include "system/embedding.h"

/* a u^2 + b u + c = 0 with the coefficients free of u: u = (-b + branch sqrt(radicand)) / (2 a), radicand = b^2 - 4 a
   c, linear = 2 a u + b. */
typedef struct {
    nh_ex a, b, c, radicand, linear, u;
    int branch;
} nh_quadratic;
/* that velocity is this root */
void nh_branches_quadratic(nh_chart *chart, size_t coordinate, const nh_quadratic *quadratic);
void nh_branches_note(nh_chart *chart); /* and other dependent velocities are roots, as they were written */

nh_chart *nh_embedding_new(nh_system *system, const char *name, size_t n, size_t implicit);
void nh_embedding_symbols(nh_chart *chart);      /* symbol, low, high from w and u */
double nh_embedding_score(void *chart, nh_ex e); /* nh_pivot_score over the probes */
/* The same; a divisor that vanishes where the motion starts (system->start) is the last choice. */
double nh_embedding_score_at_start(void *chart, nh_ex e);
/* Is a value of this size zero at the points, or only small in its units (the mass of an electron)?  It is evaluated
 * with so many digits that no cancellation of decimals is left. */
bool nh_embedding_vanishes(const nh_system *system, size_t width, const nh_ex *symbol, size_t points,
                           const double *point, nh_ex e);
/* The rank of a (m x n, overwritten) when its rows, and then its columns, are divided by their largest elements, so
   that units do not matter; 0 when it is not finite. */
size_t nh_embedding_rank(size_t m, size_t n, double *a);
bool nh_embedding_ranks(nh_system *system, uint64_t seed, nh_error *error); /* are the constraints independent? */
nh_chart *nh_embedding_coordinates(nh_system *system, uint64_t seed, nh_error *error);

#endif
