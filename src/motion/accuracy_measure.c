/* accuracy_measure: how far two runs of a motion are apart, and how the second is begun beside the first (accuracy.h). */
#include <math.h>

#include "motion/accuracy.h"

void nh_accuracy_disturb(size_t n, const double *from, double *to)
{
    uint64_t random = 0x9e3779b97f4a7c15u;
    for (size_t i = 0; i < n; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        to[i] = from[i] * (random >> 63 ? 1 + nh_accuracy_disturbance : 1 - nh_accuracy_disturbance);
    }
}

double nh_accuracy_difference(size_t count, size_t n, const double *a, const double *b, double least, size_t *which)
{
    double worst = 0;
    for (size_t k = 0; k < n; k++) {
        double scale = least, d = 0;
        for (size_t i = 0; i < count; i++) {
            double x = a[i * n + k], y = b[i * n + k];
            if (!isfinite(x) && !isfinite(y)) continue;
            if (!isfinite(x) || !isfinite(y)) return *which = k, INFINITY;
            scale = fmax(scale, fabs(x));
            d = fmax(d, fabs(x - y));
        }
        if (d / scale > worst) worst = d / scale, *which = k;
    }
    return worst;
}
