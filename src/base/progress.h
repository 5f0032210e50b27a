/* progress: what a long computation tells its caller, and how the caller ends it.  One per process, as memory's handler is. */
#ifndef NH_PROGRESS_H
#define NH_PROGRESS_H

#include <stdbool.h>

/* part: of the time or work that it may take, in [0, 1]; below 0: not known. */
typedef void nh_progress_handler(void *context, const char *doing, double part);

/* NULL: nobody wants to know.  Called from the thread that computes. */
void nh_progress_set(nh_progress_handler *handler, void *context);
void nh_progress(const char *doing, double part);

/* Ask the computation to end soon, with what it has; safe in a signal handler. */
void nh_interrupt(void);
bool nh_interrupted(void);
/* A time limit for what comes: `seconds` from now; none when they are not finite.  Work that cannot be divided is not started after it. */
void nh_deadline_set(double seconds);
/* Interrupted, or behind the deadline. */
bool nh_late(void);
/* For integrators: nh_interrupted as a callback; the context is not used. */
bool nh_interrupted_callback(void *context);

#endif
