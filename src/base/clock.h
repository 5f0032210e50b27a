/* clock: elapsed time. */
#ifndef NH_CLOCK_H
#define NH_CLOCK_H

#include <stdbool.h>

/* Seconds since some moment in the past, on a clock that never goes back. */
double nh_clock(void);

/* Seconds for which this process has used processors, all of its threads together. */
double nh_clock_of_process(void);

/* Seconds for which this thread has computed: other programs do not count. */
double nh_clock_of_thread(void);

/* A time limit: it is reached when `seconds` have passed both by the clock and in the processor time of this
 * process.  Other programs that share the processor do not bring it nearer, so that they change no answer; threads do
 * not, either.  Never reached when the seconds are not finite. */
typedef struct {
    double clock, processor; /* when both clocks reach the limit, in seconds */
} nh_clock_limit;
nh_clock_limit nh_clock_limit_in(double seconds);
bool nh_clock_limit_reached(nh_clock_limit time_limit);

#endif
