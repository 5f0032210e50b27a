/* parallel: independent jobs on a few threads.
 *
 * The assignment of jobs to threads varies between runs; each job writes only to its own memory, so the result does not
 * depend on it. */
#ifndef NH_PARALLEL_H
#define NH_PARALLEL_H

#include <stdbool.h>
#include <stddef.h>

/* job(i, context) for i = 0 .. jobs-1.  With one thread, or when none can be started, the caller does them in order. */
void nh_parallel(size_t jobs, size_t threads, void (*job)(size_t index, void *context), void *context);

/* A number that belongs to this thread and this call of nh_parallel, inside of one of its jobs, also where the caller
 * does the job himself; elsewhere 0.  A graph of expressions keeps the number of the place where it was made.  To make
 * an expression in it elsewhere ends the process in a sanitized build, whatever the number of threads: other threads
 * may read the graph. */
unsigned long nh_parallel_worker(void);
/* Is this a sanitized build? */
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
enum { NH_CHECKED = 1 };
#else
enum { NH_CHECKED = 0 };
#endif

/* The number of threads for an option of this value: the value itself, or, for 0, one for each processor that the
 * process may use. */
size_t nh_threads(double wanted);

/* Runs job(context) beside the caller, who waits for its end and releases it by nh_aside_end (which accepts NULL).
 * When no thread can be started the job is done at once, and NULL is returned. */
typedef struct nh_aside nh_aside;
nh_aside *nh_aside_begin(void (*job)(void *context), void *context);
void nh_aside_end(nh_aside *aside);

/* A long call into a library that cannot be asked to stop: job(context) on a thread of its own, while the caller looks
 * out for an interruption (base/progress.h). False when one comes: then the job goes on without the caller until it
 * ends, or the process does; context must own all that it needs and is released after it.  True: the job is done, and
 * context is still the caller's. */
bool nh_interruptible(void (*job)(void *context), void (*release)(void *context), void *context);

/* How many abandoned jobs still run.  While there are any the process must not end by exit(), because OpenBLAS then
 * waits for its own threads for ever; _exit() is safe. */
size_t nh_jobs_left(void);

#endif
