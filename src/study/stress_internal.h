/* stress_internal: one value of a map, for the maps of stress.c and those that a user names (stress_axes.c). */
#ifndef NH_STUDY_STRESS_INTERNAL_H
#define NH_STUDY_STRESS_INTERNAL_H

#include "study/chart_internal.h"
#include "study/stress.h"

typedef struct {
    nh_stress *out;
    const nh_simulate_request *request;
    double begun, budget;
    size_t values_left; /* that share what is left of the budget */
} nh_stress_work;

/* All methods on one motion, in the first formulation or in coordinate velocities; `turn` is added to one coordinate of the initial state. */
void nh_stress_try(nh_stress_work *work, const nh_simulate_request *request, double turn, size_t coordinate, bool in_coordinates, nh_stress_cell *cell);
/* out->map must have room. */
nh_stress_map *nh_stress_add_map(nh_stress_work *work, const char *name, const char *axis, size_t values);
/* The map of NAME=LOW:HIGH or two of them, instead of all others. */
bool nh_stress_axes(nh_stress_work *work, const nh_bench *plain, const char *over, nh_error *error);

#endif
