/* domain: see domain.h. */
#include "system/domain.h"

#include <math.h>

static void default_range(const nh_system *s, nh_ex symbol, double *low, double *high)
{
    *low = -1.5; /* velocities */
    *high = 1.5;
    if (symbol == s->t) {
        *low = 0;
        *high = 1;
    }
    for (size_t i = 0; i < s->coordinates; i++) {
        if (s->coordinate[i].q != symbol) continue;
        double half = s->coordinate[i].type == NH_ANGLE ? 3.14159265358979323846 : 1;
        *low = -half;
        *high = half;
    }
    for (size_t i = 0; i < s->reaches; i++) {
        if (s->reach[i].symbol != symbol) continue;
        *low = fmin(*low, s->reach[i].low);
        *high = fmax(*high, s->reach[i].high);
    }
}

void nh_domain_range(const nh_system *s, nh_ex symbol, double *low, double *high)
{
    default_range(s, symbol, low, high);
    for (size_t i = 0; i < s->intervals; i++) {
        if (s->interval[i].symbol != symbol) continue;
        *low = s->interval[i].low;
        *high = s->interval[i].high;
    }
}
