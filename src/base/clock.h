/* clock: elapsed time. */
#ifndef NH_CLOCK_H
#define NH_CLOCK_H

/* Seconds since some moment in the past, on a clock that never goes back. */
double nh_clock(void);

/* Seconds for which this process has used processors, all of its threads together. */
double nh_clock_of_process(void);

/* Seconds for which this thread has computed: other programs do not count. */
double nh_clock_of_thread(void);

#endif
