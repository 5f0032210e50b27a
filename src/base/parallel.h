/* parallel: independent jobs on a few threads.
 *
 * Which thread does a job is a matter of chance; a job must write to places of its own, so that the result does not depend on it. */
#ifndef NH_PARALLEL_H
#define NH_PARALLEL_H

#include <stddef.h>

/* job(i, context) for i = 0 .. jobs-1.  With one thread, or when none can be started, the caller does them in order. */
void nh_parallel(size_t jobs, size_t threads, void (*job)(size_t index, void *context), void *context);

#endif
