#include "base/progress.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/clock.h"

enum { longest_saying = 80 };

static nh_progress_handler *handler;
static void *handler_context;
static pthread_mutex_t saying_lock = PTHREAD_MUTEX_INITIALIZER;
static char saying[longest_saying];
static volatile sig_atomic_t interrupted, reached;
static double limit = INFINITY, limit_seconds = INFINITY, deadline = INFINITY; /* by the monotonic clock; set between computations, read by all of their threads */

void nh_progress_set(nh_progress_handler *new_handler, void *context)
{
    handler = new_handler;
    handler_context = context;
}

void nh_progress(const char *doing, double part)
{
    pthread_mutex_lock(&saying_lock);
    snprintf(saying, sizeof saying, "%s", doing);
    pthread_mutex_unlock(&saying_lock);
    if (handler) handler(handler_context, doing, part > 1 ? 1 : part);
}

void nh_progress_last(char *out, size_t size)
{
    pthread_mutex_lock(&saying_lock);
    snprintf(out, size, "%s", saying);
    pthread_mutex_unlock(&saying_lock);
}

void nh_limit_set(double seconds)
{
    limit_seconds = seconds;
    limit = isfinite(seconds) ? nh_clock() + seconds : INFINITY;
    reached = 0;
}

void nh_deadline_set(double seconds)
{
    static const double part = 0.6; /* the rest is for certificates, a motion and what is written */
    double now = nh_clock();
    deadline = isfinite(seconds) ? fmin(now + seconds, now + part * fmax(0, limit - now)) : INFINITY;
}

void nh_interrupt(void) { interrupted = 1; }

bool nh_interrupted(void)
{
    if (interrupted || reached) return true;
    if (isfinite(limit) && nh_clock() > limit) reached = 1;
    return reached;
}

bool nh_late(void) { return nh_interrupted() || (isfinite(deadline) && nh_clock() > deadline); }

bool nh_limit_reached(void) { return reached && !interrupted; }

nh_code nh_ended_code(void) { return interrupted ? NH_INTERRUPTED : NH_LIMIT; }

void nh_ended_words(char *out, size_t size)
{
    if (interrupted) snprintf(out, size, "interrupted");
    else snprintf(out, size, "the time limit of %g s was reached", limit_seconds);
}

bool nh_fail_ended(nh_error *error, const char *format, ...)
{
    char words[80], doing[400];
    va_list list;
    va_start(list, format);
    vsnprintf(doing, sizeof doing, format, list);
    va_end(list);
    nh_ended_words(words, sizeof words);
    nh_fail(error, nh_ended_code(), "", "%s %s", words, doing);
    return nh_limit_reached() ? nh_error_hint(error, "--max-seconds raises it") : false;
}

bool nh_interrupted_callback(void *context)
{
    (void)context;
    return nh_interrupted();
}
