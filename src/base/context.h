/* context: the state of one computation: counted work, time limit, progress report, and the files that it
 * has read.
 *
 * Every thread works for one context: for that of the process, unless it entered another; the threads that
 * base/parallel.h starts work for the context of the thread that started them.  So two threads with a context each do
 * not disturb one another. */
#ifndef NH_CONTEXT_H
#define NH_CONTEXT_H

#include "nhsym.h"

/* part: of the time or work that it may take, in [0, 1]; below 0: not known. */
typedef void nh_progress_handler(void *context, const char *doing, double part);

/* The one that this thread works for. */
nh_context *nh_context_here(void);
/* From now on this thread works for that one; NULL: for that of the process.  Returns the one before. */
nh_context *nh_context_enter(nh_context *context);

#endif
