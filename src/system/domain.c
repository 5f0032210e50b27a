/* domain: see domain.h. */
#include "system/domain.h"

#include <math.h>

static void default_range(const nh_system *system, nh_ex symbol, double *low, double *high)
{
    *low = -1.5; /* velocities */
    *high = 1.5;
    if (symbol == system->t) {
        *low = 0;
        *high = 1;
    }
    for (size_t i = 0; i < system->coordinates; i++) {
        if (system->coordinate[i].q != symbol) continue;
        double half = system->coordinate[i].type == NH_ANGLE ? 3.14159265358979323846 : 1;
        *low = -half;
        *high = half;
    }
    bool first = true;
    for (size_t i = 0; i < system->reaches; i++) {
        if (system->reach[i].symbol != symbol) continue;
        *low = first ? system->reach[i].low : fmin(*low, system->reach[i].low);
        *high = first ? system->reach[i].high : fmax(*high, system->reach[i].high);
        first = false;
    }
}

void nh_domain_range(const nh_system *system, nh_ex symbol, double *low, double *high)
{
    default_range(system, symbol, low, high);
    for (size_t i = 0; i < system->intervals; i++) {
        if (system->interval[i].symbol != symbol) continue;
        *low = system->interval[i].low;
        *high = system->interval[i].high;
    }
}
