#include "system/sample.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_qrng.h>
#include <math.h>

#include "base/memory.h"

enum { most_sobol = 40, most_halton = 1229 }; /* dimensions that GSL has the sequences for */

struct nh_sampler {
    gsl_qrng *qrng;
    size_t dimension, sobol; /* number of dimensions taken from the sequence */
    uint64_t state;          /* state of the pseudo-random numbers for the others */
    double *low, *width, *shift;
};

double nh_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

nh_sampler *nh_sampler_create(size_t dimension, const double *low, const double *high, uint64_t seed)
{
    gsl_set_error_handler_off(); /* GSL's default handler aborts */
    nh_sampler *s = nh_alloc(sizeof *s);
    s->dimension = dimension;
    s->sobol = dimension < most_sobol ? dimension : most_sobol;
    s->low = nh_alloc_array(3 * dimension + 1, sizeof *s->low);
    s->width = s->low + dimension;
    s->shift = s->width + dimension;
    s->state = seed * 0x2545f4914f6cdd1du + dimension;
    for (size_t i = 0; i < dimension; i++) {
        s->low[i] = low[i];
        s->width[i] = high[i] - low[i];
        s->shift[i] = nh_random(&s->state);
    }
    if (dimension) s->qrng = nh_memory_got(gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)s->sobol));
    return s;
}

void nh_sampler_free(nh_sampler *sampler)
{
    if (!sampler) return;
    if (sampler->qrng) gsl_qrng_free(sampler->qrng);
    nh_free(sampler->low);
    nh_free(sampler);
}

void nh_sampler_next(nh_sampler *s, double *point)
{
    if (!s->qrng) return;
    gsl_qrng_get(s->qrng, point);
    for (size_t i = 0; i < s->dimension; i++) {
        double x = i < s->sobol ? point[i] + s->shift[i] : nh_random(&s->state);
        point[i] = s->low[i] + s->width[i] * (x - floor(x));
    }
}

double *nh_sample_halton(size_t dimension, size_t count, uint64_t seed)
{
    gsl_set_error_handler_off(); /* GSL's default handler aborts */
    size_t of_sequence = dimension < most_halton ? dimension : most_halton;
    double *node = nh_alloc_array(count * dimension + 1, sizeof *node);
    double *shift = nh_alloc_array(dimension + 1, sizeof *shift);
    uint64_t state = seed * 0x2545f4914f6cdd1du + dimension;
    for (size_t d = 0; d < dimension; d++) shift[d] = nh_random(&state);
    gsl_qrng *sequence = of_sequence ? nh_memory_got(gsl_qrng_alloc(gsl_qrng_halton, (unsigned)of_sequence)) : NULL;
    for (size_t p = 0; p < count && sequence; p++) {
        double *at = node + p * dimension;
        gsl_qrng_get(sequence, at);
        for (size_t d = 0; d < dimension; d++) {
            double x = d < of_sequence ? at[d] + shift[d] : nh_random(&state);
            at[d] = 2 * (x - floor(x)) - 1;
        }
    }
    if (sequence) gsl_qrng_free(sequence);
    nh_free(shift);
    return node;
}
