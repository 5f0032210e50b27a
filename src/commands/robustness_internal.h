/* robustness_internal: one value of a map, for the maps of stress.c and those that a user names (stress_axes.c). */
#ifndef NH_STUDY_STRESS_INTERNAL_H
#define NH_STUDY_STRESS_INTERNAL_H

#include "commands/benchmark_internal.h"
#include "commands/robustness.h"

enum { NH_STRESS_METHODS = 5 }; /* of a map of motions */

typedef struct {
    nh_stress *out;
    const nh_simulate_request *request;
    double begun, budget;
    size_t values_left; /* that share what is left of the budget */
    double step;        /* methods with this fixed step instead of those with error control; 0: the latter */
} nh_stress_work;

/* All methods on one motion, in the first formulation or in coordinate velocities; `turn` is added to one coordinate of the initial state. */
void nh_stress_try(nh_stress_work *work, const nh_simulate_request *request, double turn, size_t coordinate, bool in_coordinates, nh_stress_cell *cell);
/* out->map must have room. */
nh_stress_map *nh_stress_add_map(nh_stress_work *work, const char *name, const char *axis, size_t values, size_t methods);
/* The map of NAME=LOW:HIGH or two of them; name NULL: it is called what it goes over. */
bool nh_stress_axes(nh_stress_work *work, const nh_bench *plain, const nh_simulate_request *request, const char *name, const char *over, nh_error *error);
/* A map that the system file names. */
bool nh_stress_named(nh_stress_work *work, const nh_bench *plain, const nh_named_stress *stress, nh_error *error);
/* Is the time of all maps over? */
bool nh_stress_late(const nh_stress_work *work);
/* The maps of the discrete problem: clustered and noisy samples, an ansatz at the edge of dependence, frequencies that nearly coincide. */
void nh_stress_fits(nh_stress_work *work, const nh_bench *plain);
enum { NH_STRESS_FITS = 4 };

#endif
