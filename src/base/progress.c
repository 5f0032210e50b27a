#include "base/progress.h"

#include <math.h>
#include <signal.h>
#include <stddef.h>

#include "base/clock.h"

static nh_progress_handler *handler;
static void *handler_context;
static volatile sig_atomic_t interrupted;
static double deadline = INFINITY; /* by the monotonic clock; set between computations, read by all of their threads */

void nh_progress_set(nh_progress_handler *new_handler, void *context)
{
    handler = new_handler;
    handler_context = context;
}

void nh_progress(const char *doing, double part)
{
    if (handler) handler(handler_context, doing, part > 1 ? 1 : part);
}

void nh_deadline_set(double seconds) { deadline = isfinite(seconds) ? nh_clock() + seconds : INFINITY; }

bool nh_late(void) { return interrupted || (isfinite(deadline) && nh_clock() > deadline); }

void nh_interrupt(void) { interrupted = 1; }
bool nh_interrupted(void) { return interrupted; }

bool nh_interrupted_callback(void *context)
{
    (void)context;
    return interrupted;
}
