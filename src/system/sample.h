/* sample: low-discrepancy points in a box (Sobol), shifted by a seed.
 *
 * GSL has 40 dimensions of the sequence; further ones are pseudo-random.  Halton's sequence has any number of
 * dimensions, but the i-th point is i/p in those of a prime p above i: linear relations between coordinates that hold
 * at all points, and nowhere else. The shift (modulo 1, Cranley and Patterson) makes independent sets from one
 * sequence: fit, held-out, independence. Reference: [Sobol1967], [Spanier1995], [CranleyPatterson1976], GSL's
 * quasi-random sequences. */
#ifndef NH_SAMPLE_H
#define NH_SAMPLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct nh_sampler nh_sampler;

nh_sampler *nh_sampler_create(size_t dimension, const double *low, const double *high, uint64_t seed);
void nh_sampler_free(nh_sampler *sampler);
void nh_sampler_next(nh_sampler *sampler, double *point); /* dimension values, low <= value <= high */

/* `count` points of Halton's sequence in [-1, 1]^dimension, shifted by the seed, one after another; the caller frees
 * them. */
double *nh_sample_halton(size_t dimension, size_t count, uint64_t seed);

/* A pseudo-random number in [0, 1) from a seed that is advanced (splitmix64). */
double nh_random(uint64_t *state);

#endif
