/* ranking: what a chart measured, kept from one run to later ones, so that an accuracy can be reached by the cheapest way.
 *
 * It is found again by the equations of motion themselves: names, notation and the rest of the file do not matter, parameter values do.  One that is
 * not there, cannot be read, or was made by another version is no ranking; what is chosen from one is checked all the same (accuracy.h). */
#ifndef NH_RANKING_H
#define NH_RANKING_H

#include "base/memory.h"
#include "motion/way.h"

enum { NH_RANKING_ASKED = 16 };

typedef struct {
    uint64_t key;      /* of the equations */
    double begin, end; /* of the motion that was measured */
    bool surveyed;     /* on pieces of motions, when an accuracy was wanted of them: a chart takes its place, and it never takes a chart's */
    bool plain;        /* then: only in the model's own velocities, by methods with error control */
    size_t asks;
    double asked[NH_RANKING_ASKED]; /* then: these accuracies; it says nothing of others */
    size_t count;
    nh_way *way;
} nh_ranking;

/* Of z' = (rho, a) of a model with its parameter values. */
uint64_t nh_ranking_key(const nh_model *model);

/* The ranking that was kept for these equations, into the arena; false: there is none. */
bool nh_ranking_read(uint64_t key, nh_arena *arena, nh_ranking *out);

/* Does it tell what is the cheapest for this accuracy, of all ways or of the plain ones? */
bool nh_ranking_tells(const nh_ranking *ranking, double eps, bool plain);

/* A survey of the model's equations for one accuracy (asked[0]) is kept beside what others measured for other accuracies; not in place of a
 * chart, nor a plain one in place of one that is not. */
bool nh_ranking_keep(const nh_model *model, nh_ranking *ranking, nh_error *error);

/* Only the ways in the model's own velocities with error control are left, at the beginning; how many. */
size_t nh_ranking_adaptive(nh_ranking *ranking);

/* Is there a place where rankings are kept? */
bool nh_ranking_possible(void);

/* Keep it, in place of an older one (cache.h). */
bool nh_ranking_write(const nh_ranking *ranking, const char *system, nh_error *error);

#endif
