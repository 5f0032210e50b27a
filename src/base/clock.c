#include "base/clock.h"

#include <math.h>
#include <time.h>

static double read_clock(clockid_t which)
{
    struct timespec t;
    clock_gettime(which, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double nh_clock(void) { return read_clock(CLOCK_MONOTONIC); }
double nh_clock_of_process(void) { return read_clock(CLOCK_PROCESS_CPUTIME_ID); }
double nh_clock_of_thread(void) { return read_clock(CLOCK_THREAD_CPUTIME_ID); }

nh_clock_limit nh_clock_limit_in(double seconds)
{
    if (!isfinite(seconds)) return (nh_clock_limit){INFINITY, INFINITY};
    return (nh_clock_limit){nh_clock() + seconds, nh_clock_of_process() + seconds};
}

bool nh_clock_limit_reached(nh_clock_limit time_limit)
{
    return isfinite(time_limit.clock) && nh_clock() > time_limit.clock && nh_clock_of_process() > time_limit.processor;
}
