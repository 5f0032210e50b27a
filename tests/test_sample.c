/* sample: points in their box, evenly, the same for the same seed. */
#include <criterion/criterion.h>

#include <math.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "system/sample.h"

enum { most_dimension = 121 };

/* Mean and mean square of (x - low)/(high - low) over `count` points, the worst dimension's distance from 1/2 and 1/3. */
static void evenness(size_t dimension, size_t count, uint64_t seed, double *mean_off, double *square_off)
{
    double low[most_dimension] = {0}, high[most_dimension] = {0}, x[most_dimension], sum[most_dimension] = {0}, square[most_dimension] = {0};
    for (size_t i = 0; i < dimension; i++) {
        low[i] = -1.385 * (double)(i + 1);
        high[i] = low[i] + 0.7 + (double)i;
    }
    nh_sampler *s = nh_sampler_create(dimension, low, high, seed);
    for (size_t p = 0; p < count; p++) {
        nh_sampler_next(s, x);
        for (size_t i = 0; i < dimension; i++) {
            double u = (x[i] - low[i]) / (high[i] - low[i]);
            cr_assert(x[i] >= low[i] && x[i] <= high[i], "dimension %zu: %g outside [%g, %g]", i, x[i], low[i], high[i]);
            sum[i] += u;
            square[i] += u * u;
        }
    }
    nh_sampler_free(s);
    *mean_off = *square_off = 0;
    for (size_t i = 0; i < dimension; i++) {
        *mean_off = fmax(*mean_off, fabs(sum[i] / (double)count - 0.5));
        *square_off = fmax(*square_off, fabs(square[i] / (double)count - 1.0 / 3));
    }
}

Test(sample, points_fill_their_box_evenly)
{
    double mean, square;
    evenness(5, 1024, 3, &mean, &square);
    cr_expect_lt(mean, 2e-3, "pseudo-random points would be off by 1e-2; found %g", mean);
    cr_expect_lt(square, 3e-3, "%g", square);
}

Test(sample, many_dimensions)
{
    double mean, square;
    evenness(40, 2048, 1, &mean, &square);
    cr_expect_lt(mean, 5e-3, "40 dimensions: %g", mean);
    evenness(60, 8192, 1, &mean, &square);
    cr_expect_lt(mean, 3e-2, "60 dimensions: %g", mean);
    cr_expect_lt(square, 3e-2, "60 dimensions: %g", square);
}

/* The smallest part of a dimension that no linear combination of the others with a constant gives at all points: what they do give is a relation that a fit takes for one of the system. */
static double least_of_its_own(size_t dimension, size_t count)
{
    double low[most_dimension], high[most_dimension], *a = nh_alloc_array((dimension + 1) * count, sizeof *a), *s = nh_alloc_array(dimension + 1, sizeof *s);
    for (size_t i = 0; i < dimension; i++) low[i] = -sqrt(3), high[i] = sqrt(3);
    nh_sampler *sampler = nh_sampler_create(dimension, low, high, 1);
    for (size_t p = 0; p < count; p++) {
        double x[most_dimension];
        nh_sampler_next(sampler, x);
        a[p] = 1;
        for (size_t i = 0; i < dimension; i++) a[p + (i + 1) * count] = x[i];
    }
    cr_assert(nh_svd(count, dimension + 1, a, s, NULL, NULL));
    double least = s[dimension] / sqrt((double)count);
    nh_sampler_free(sampler);
    nh_free(a);
    nh_free(s);
    return least;
}

Test(sample, no_dimension_follows_from_the_others)
{
    static const size_t dimensions[] = {5, 20, 40, 41, 81, 121};
    for (size_t i = 0; i < sizeof dimensions / sizeof *dimensions; i++) {
        double least = least_of_its_own(dimensions[i], 5 * dimensions[i]);
        cr_expect_gt(least, 0.05, "%zu dimensions: %g; independent coordinates would have about 0.5", dimensions[i], least);
    }
}

Test(sample, the_seed_decides)
{
    const double low[] = {0, -1}, high[] = {1, 4};
    double a[2], b[2], c[2];
    nh_sampler *first = nh_sampler_create(2, low, high, 12), *same = nh_sampler_create(2, low, high, 12), *other = nh_sampler_create(2, low, high, 13);
    for (int i = 0; i < 100; i++) {
        nh_sampler_next(first, a);
        nh_sampler_next(same, b);
        nh_sampler_next(other, c);
        cr_expect(a[0] == b[0] && a[1] == b[1]);
        cr_expect(a[0] != c[0] && a[1] != c[1]);
    }
    nh_sampler_free(first);
    nh_sampler_free(same);
    nh_sampler_free(other);
}

Test(sample, no_dimension_is_a_dimension)
{
    double untouched = 2.385;
    nh_sampler *s = nh_sampler_create(0, NULL, NULL, 1);
    nh_sampler_next(s, &untouched);
    cr_expect_eq(untouched, 2.385);
    nh_sampler_free(s);
    nh_sampler_free(NULL);
}

/* splitmix64 of the seed 0: the published first values are E220A8397B1DCDAF, 6E789E6AA1B965F4. */
Test(sample, random_is_splitmix)
{
    uint64_t state = 0;
    cr_expect_eq(nh_random(&state), (double)(0xE220A8397B1DCDAFu >> 11) * 0x1p-53);
    cr_expect_eq(nh_random(&state), (double)(0x6E789E6AA1B965F4u >> 11) * 0x1p-53);
}
