/* robustness_internal: one value of a map, for the maps of robustness.c and those that a user names
   (robustness_axes.c). */
#ifndef NH_ROBUSTNESS_INTERNAL_H
#define NH_ROBUSTNESS_INTERNAL_H

#include "commands/benchmark_internal.h"
#include "commands/robustness.h"

enum { NH_ROBUSTNESS_METHODS = 5 }; /* for a map of motions */

typedef struct {
    nh_robustness *out;
    const nh_request *request;
    double begun, budget;
    size_t values_left; /* number of values that share the rest of the budget */
    double step;        /* methods with this fixed step; 0: those with error control */
} nh_robustness_work;

/* Runs all methods on one motion, in the first formulation or in coordinate velocities; `turn` is added to one
 * coordinate of the initial state. */
void nh_robustness_try(nh_robustness_work *work, const nh_request *request, double turn, size_t coordinate,
                       bool in_coordinates, nh_robustness_cell *cell);
/* Adds a map; out->map must have room. */
nh_robustness_map *nh_robustness_add_map(nh_robustness_work *work, const char *name, const char *axis, size_t values,
                                         size_t methods);
/* The map of one or two entries NAME=LOW:HIGH; without a name (NULL) it is named after its axes. */
bool nh_robustness_axes(nh_robustness_work *work, const nh_benchmark_work *plain, const nh_request *request,
                        const char *name, const char *over, nh_error *error);
/* A map that the system file names. */
bool nh_robustness_named(nh_robustness_work *work, const nh_benchmark_work *plain, const nh_named_map *map,
                         nh_error *error);
/* Is the time of all maps over? */
extern const char *const nh_robustness_no_time; /* the note of what is not run */
bool nh_robustness_late(const nh_robustness_work *work);
/* The maps of the discrete problem: clustered and noisy samples, an ansatz at the edge of dependence, frequencies that
   nearly coincide. */
void nh_robustness_fits(nh_robustness_work *work, const nh_benchmark_work *plain);
enum { NH_ROBUSTNESS_FITS = 4 };

#endif
