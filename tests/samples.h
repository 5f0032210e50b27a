/* samples: columns with their rates along a flow, for the tests of the null space and of the pencil. */
#ifndef NH_TESTS_SAMPLES_H
#define NH_TESTS_SAMPLES_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

static unsigned long long state = 2385;

static inline double uniform(void)
{
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(state >> 11) / 4503599627370496.0 - 1;
}

/* Columns with their rates along the flow, rows x columns. */
typedef struct {
    size_t rows, columns;
    double *a, *b;
} samples;

static inline samples make(size_t rows, size_t columns)
{
    return (samples){rows, columns, nh_alloc_array(rows * columns, sizeof(double)), nh_alloc_array(rows * columns, sizeof(double))};
}

static inline void discard(samples *s)
{
    nh_free(s->a);
    nh_free(s->b);
}

/* x^p or the Chebyshev polynomial T_p(x), with derivative. */
static inline double power(bool chebyshev, size_t p, double x, double *derivative)
{
    if (chebyshev) {
        double angle = acos(x);
        *derivative = (double)p * sin((double)p * angle) / sin(angle);
        return cos((double)p * angle);
    }
    *derivative = p ? (double)p * pow(x, (double)p - 1) : 0;
    return pow(x, (double)p);
}

/* Products f_i(x) f_j(y) f_k(z), 0 < i + j + k <= degree, at a point with the velocity v: one row. */
static inline void product_row(samples *s, size_t row, bool chebyshev, size_t degree, const double x[3], const double v[3])
{
    size_t column = 0;
    for (size_t total = 1; total <= degree; total++)
        for (size_t i = 0; i <= total; i++)
            for (size_t j = 0; i + j <= total; j++) {
                double d[3], f0 = power(chebyshev, i, x[0], d), f1 = power(chebyshev, j, x[1], d + 1),
                             f2 = power(chebyshev, total - i - j, x[2], d + 2);
                s->b[row + column * s->rows] = f0 * f1 * f2;
                s->a[row + column++ * s->rows] = d[0] * v[0] * f1 * f2 + f0 * d[1] * v[1] * f2 + f0 * f1 * d[2] * v[2];
            }
}

static inline size_t products(size_t degree)
{
    return (degree + 1) * (degree + 2) * (degree + 3) / 6 - 1;
}

static const double AXIS[3] = {0.36, -0.48, 0.8}; /* a unit vector */

/* Rotation about AXIS, x' = AXIS x x, at random points of the unit sphere (or inside the ball).  Integrals: functions of AXIS.x
 * and x.x; on the sphere x.x = 1 is an identity. */
static inline samples rotation(size_t rows, size_t degree, bool chebyshev, bool sphere)
{
    samples s = make(rows, products(degree));
    for (size_t row = 0; row < rows;) {
        double x[3] = {uniform(), uniform(), uniform()}, r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        if (r > 1 || r < 0.1)
            continue;
        for (size_t i = 0; i < 3 && sphere; i++)
            x[i] /= r;
        double v[3];
        for (size_t i = 0; i < 3; i++)
            v[i] = AXIS[(i + 1) % 3] * x[(i + 2) % 3] - AXIS[(i + 2) % 3] * x[(i + 1) % 3];
        product_row(&s, row++, chebyshev, degree, x, v);
    }
    return s;
}

#endif
