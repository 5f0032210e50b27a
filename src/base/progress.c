#include "base/progress.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/clock.h"
#include "base/context_internal.h"

void nh_progress_set(nh_progress_handler *handler, void *context)
{
    nh_context *c = nh_context_here();
    c->handler = handler;
    c->handler_context = context;
}

void nh_progress(const char *doing, double part)
{
    nh_context *c = nh_context_here();
    pthread_mutex_lock(&c->saying_lock);
    snprintf(c->saying, sizeof c->saying, "%s", doing);
    pthread_mutex_unlock(&c->saying_lock);
    if (c->handler) c->handler(c->handler_context, doing, part > 1 ? 1 : part);
}

void nh_progress_last(char *out, size_t size)
{
    nh_context *c = nh_context_here();
    pthread_mutex_lock(&c->saying_lock);
    snprintf(out, size, "%s", c->saying);
    pthread_mutex_unlock(&c->saying_lock);
}

void nh_limit_set(double seconds)
{
    nh_context *c = nh_context_here();
    c->limit_seconds = seconds;
    c->limit = isfinite(seconds) ? nh_clock() + seconds : INFINITY;
    atomic_store(&c->reached, false);
}

void nh_limit_pass(void) { nh_context_here()->limit = INFINITY; }

void nh_deadline_set(double seconds)
{
    static const double part = 0.6; /* the rest is for certificates, a motion and what is written */
    nh_context *c = nh_context_here();
    double now = nh_clock();
    c->deadline = isfinite(seconds) ? fmin(now + seconds, now + part * fmax(0, c->limit - now)) : INFINITY;
}

void nh_interrupt(void) { nh_interrupt_context(nh_context_here()); }

void nh_interrupt_context(nh_context *c) { atomic_store(&c->interrupted, true); }

void nh_interrupt_clear(void)
{
    nh_context *c = nh_context_here();
    atomic_store(&c->interrupted, false);
    atomic_store(&c->reached, false);
}

bool nh_interrupted(void)
{
    nh_context *c = nh_context_here();
    if (atomic_load(&c->interrupted) || atomic_load(&c->reached)) return true;
    if (isfinite(c->limit) && nh_clock() > c->limit) atomic_store(&c->reached, true);
    return atomic_load(&c->reached);
}

bool nh_late(void)
{
    double deadline = nh_context_here()->deadline;
    return nh_interrupted() || (isfinite(deadline) && nh_clock() > deadline);
}

bool nh_limit_reached(void)
{
    nh_context *c = nh_context_here();
    return atomic_load(&c->reached) && !atomic_load(&c->interrupted);
}

nh_code nh_ended_code(void) { return atomic_load(&nh_context_here()->interrupted) ? NH_INTERRUPTED : NH_LIMIT; }

void nh_ended_words(char *out, size_t size)
{
    nh_context *c = nh_context_here();
    if (atomic_load(&c->interrupted)) snprintf(out, size, "interrupted");
    else snprintf(out, size, "the time limit of %g s was reached", c->limit_seconds);
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
    return nh_limit_reached() ? nh_error_hint(error, "raise it by --max-seconds") : false;
}

bool nh_interrupted_callback(void *context)
{
    (void)context;
    return nh_interrupted();
}
