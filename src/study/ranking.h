/* ranking: what a chart measured, kept from one run to later ones, so that an accuracy can be reached by the cheapest way.
 *
 * It is found again by the equations of motion themselves: names, notation and the rest of the file do not matter, parameter values do.  One that is
 * not there, cannot be read, or was made by another version is no ranking; what is chosen from one is checked all the same (accuracy.h). */
#ifndef NH_RANKING_H
#define NH_RANKING_H

#include "base/memory.h"
#include "motion/way.h"

typedef struct {
    uint64_t key;      /* of the equations */
    double begin, end; /* of the motion that was measured */
    size_t count;
    nh_way *way;
} nh_ranking;

/* Of z' = (rho, a) of a model with its parameter values. */
uint64_t nh_ranking_key(const nh_model *model);

/* The ranking that was kept for these equations, into the arena; false: there is none. */
bool nh_ranking_read(uint64_t key, nh_arena *arena, nh_ranking *out);

/* Only the ways in the model's own velocities with error control are left, at the beginning; how many. */
size_t nh_ranking_adaptive(nh_ranking *ranking);

/* Is there a place where rankings are kept? */
bool nh_ranking_possible(void);

/* Keep it, in place of an older one (cache.h). */
bool nh_ranking_write(const nh_ranking *ranking, const char *system, nh_error *error);

#endif
