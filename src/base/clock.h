/* clock: how long things take. */
#ifndef NH_CLOCK_H
#define NH_CLOCK_H

/* Seconds since some moment in the past, on a clock that never goes back. */
double nh_clock(void);

#endif
