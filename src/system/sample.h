/* sample: low-discrepancy points in a box (Sobol; reverse Halton above 40 dimensions), shifted by a seed.
 *
 * The shift (modulo 1, Cranley and Patterson) makes independent sets from one sequence: fit, held-out, independence.
 * Reference: [Sobol1967], [CranleyPatterson1976], GSL's quasi-random sequences. */
#ifndef NH_SAMPLE_H
#define NH_SAMPLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct nh_sampler nh_sampler;

nh_sampler *nh_sampler_create(size_t dimension, const double *low, const double *high, uint64_t seed);
void nh_sampler_free(nh_sampler *sampler);
void nh_sampler_next(nh_sampler *sampler, double *point); /* dimension values, low <= value <= high */

/* A pseudo-random number in [0, 1) from a seed that is advanced (splitmix64). */
double nh_random(uint64_t *state);

#endif
