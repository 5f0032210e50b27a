/* progress: progress reports of a long computation, and its early end by a signal, or by the limit of time or memory of
 * the run. One per context (base/context.h).
 *
 * All of them look the same to the computation: nh_interrupted() is true from then on, and the computation soon returns
 * partial results; nothing that was computed afterwards is a proof or a refutation.  In a run that no limit ends,
 * counted work and not time decides how much is computed. */
#ifndef NH_PROGRESS_H
#define NH_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/context.h"
#include "base/error.h"

/* Sets the handler of this context, which is called from the thread that computes; NULL: no reports. */
void nh_progress_set(nh_progress_handler *handler, void *context);
void nh_progress(const char *doing, double part);
/* Copies what was reported last; from any thread. */
void nh_progress_last(char *out, size_t size);

/* Asks the computation to end soon with partial results; safe in a signal handler. */
void nh_interrupt(void);
/* The same for the computation of another thread. */
void nh_interrupt_context(nh_context *context);
/* Forgets an interruption before a new computation. */
void nh_interrupt_clear(void);
/* Sets the time limit of the run: `seconds` from now, of the clock and not of the processor; not finite: no limit. */
void nh_limit_set(double seconds);
/* Sets the limit of the memory of the process, in bytes; 0: no limit.  The memory is measured a hundred times a
 * second. */
void nh_limit_memory_set(double bytes);
/* How many bytes may be allocated: the limit of memory, or else the memory of the machine; infinite where the system
 * does not say. */
double nh_limit_memory(void);
/* Everything is computed: a limit that was not reached no longer counts, so that a result is the same however long it
 * takes to write it. */
void nh_limit_pass(void);
/* Was the computation ended, by a signal or a limit? */
bool nh_interrupted(void);
/* For a computation that was ended: its exit code; "interrupted" or "the time limit of 1 s was reached"; the option
 * that raises the limit, or NULL. */
nh_code nh_ended_code(void);
void nh_ended_words(char *out, size_t size);
const char *nh_ended_option(void);
/* Records an error: that the computation was ended, what it was doing (`format`), and the option that helps.  Returns
 * false. */
bool nh_fail_ended(nh_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Sets a deadline, after which no new part of a computation is begun, so that time is left for what follows: after
 * `seconds`, and earlier where the time limit is near; not finite: no deadline. */
void nh_deadline_set(double seconds);
/* Was the computation ended, or is the deadline over? */
bool nh_late(void);
/* For integrators: nh_interrupted as a callback; the context is not used. */
bool nh_interrupted_callback(void *context);

#endif
