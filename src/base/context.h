/* context: the state of one computation: counted work, time limit, progress report, and the files that it
 * has read.
 *
 * Every thread works for one context: for that of the process, unless it entered another; the threads that
 * base/parallel.h starts work for the context of the thread that started them.  So two threads with a context each do
 * not disturb one another. */
#ifndef NH_CONTEXT_H
#define NH_CONTEXT_H

#include "nhsym.h"

/* Reports progress: what is being done, and which part of its time or work is over, in [0, 1]; below 0 when unknown. */
typedef void nh_progress_handler(void *context, const char *doing, double part);

/* The context of this thread; never NULL. */
nh_context *nh_context_here(void);
/* Makes `context` the context of this thread; NULL: that of the process.  Returns the previous one (NULL: that of the
 * process). */
nh_context *nh_context_enter(nh_context *context);

#endif
