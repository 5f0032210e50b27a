/* progress: progress reports of a long computation, and its early end by a signal, or by the limit of time or memory of
 * the run. One per context (base/context.h).
 *
 * The computation sees all ends in the same way: nh_interrupted() is true from then on, and the computation returns
 * soon, with partial results: nothing that was computed afterwards is a proof or a refutation.  Counted work decides
 * how much is computed in a run that no limit ends, not time. */
#ifndef NH_PROGRESS_H
#define NH_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/context.h"
#include "base/error.h"

/* NULL: no reports.  Called from the thread that computes. */
void nh_progress_set(nh_progress_handler *handler, void *context);
void nh_progress(const char *doing, double part);
/* What was said last, from any thread. */
void nh_progress_last(char *out, size_t size);

/* Ask the computation to end soon, with what it has; safe in a signal handler. */
void nh_interrupt(void);
/* The same for the computation of another thread. */
void nh_interrupt_context(nh_context *context);
/* What comes from here on was not interrupted. */
void nh_interrupt_clear(void);
/* The time limit of the run: `seconds` from now, by the clock (not of the processor); none when they are not
   finite. */
void nh_limit_set(double seconds);
/* The same for the memory of the process, in bytes; none when 0.  It is looked at now and then: a hundred times a
   second. */
void nh_limit_memory_set(double bytes);
/* What may be allocated, in bytes: that limit, else the memory of the machine; infinite where the system does not say.
 */
double nh_limit_memory(void);
/* All is computed: a limit that was not reached is reached no more, so that a result is the same however long it takes
   to write it. */
void nh_limit_pass(void);
/* Ended, by any of them. */
bool nh_interrupted(void);
/* Ended by a limit. */
bool nh_limit_reached(void);
/* Of an ended computation: its exit code, "interrupted" or "the time limit of 1 s was reached", and the option that
   raises the limit, or NULL. */
nh_code nh_ended_code(void);
void nh_ended_words(char *out, size_t size);
const char *nh_ended_option(void);
/* Records that it was ended, while doing that, with the cure; returns false. */
bool nh_fail_ended(nh_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A moment after which no new part is begun, so that time is left for what follows: after so many seconds, and
 * earlier where the limit is near; none when they are not finite. */
void nh_deadline_set(double seconds);
/* Ended, or behind that moment. */
bool nh_late(void);
/* For integrators: nh_interrupted as a callback; the context is not used. */
bool nh_interrupted_callback(void *context);

#endif
