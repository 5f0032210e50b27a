#include "base/progress.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/clock.h"
#include "base/memory.h"
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

void nh_limit_memory_set(double bytes)
{
    nh_context *c = nh_context_here();
    c->most_memory = bytes;
    atomic_store(&c->next_look, 0.0);
    atomic_store(&c->filled, false);
}

double nh_limit_memory(void)
{
    double set = nh_context_here()->most_memory, machine = nh_memory_of_machine();
    return set > 0 ? set : machine > 0 ? machine : INFINITY;
}

void nh_limit_pass(void)
{
    nh_context *c = nh_context_here();
    c->limit = INFINITY;
    atomic_store(&c->next_look, (double)INFINITY);
}

void nh_deadline_set(double seconds)
{
    static const double part = 0.6; /* the rest of the time is for certificates, a motion and the output */
    nh_context *c = nh_context_here();
    double now = nh_clock();
    c->deadline = isfinite(seconds) ? now + part * fmax(0, c->limit - now) : INFINITY;
    c->time_limit = nh_clock_limit_in(seconds);
}

void nh_interrupt(void) { nh_interrupt_context(nh_context_here()); }

void nh_interrupt_context(nh_context *c) { atomic_store(&c->interrupted, true); }

void nh_interrupt_clear(void)
{
    nh_context *c = nh_context_here();
    atomic_store(&c->interrupted, false);
    atomic_store(&c->reached, false);
    atomic_store(&c->filled, false);
}

static void look_at_memory(nh_context *c)
{
    static const double pause = 0.01; /* seconds */
    double now = nh_clock();
    if (now < atomic_load(&c->next_look)) return;
    atomic_store(&c->next_look, now + pause);
    if (nh_memory_in_use() <= c->most_memory) return;
    atomic_store(&c->filled, true);
    atomic_store(&c->reached, true);
}

bool nh_interrupted(void)
{
    nh_context *c = nh_context_here();
    if (atomic_load(&c->interrupted) || atomic_load(&c->reached)) return true;
    if (c->most_memory > 0) look_at_memory(c);
    if (isfinite(c->limit) && nh_clock() > c->limit) atomic_store(&c->reached, true);
    return atomic_load(&c->reached);
}

bool nh_late(void)
{
    const nh_context *c = nh_context_here();
    return nh_interrupted() || (isfinite(c->deadline) && nh_clock() > c->deadline) ||
           nh_clock_limit_reached(c->time_limit);
}

/* Was it ended by a limit? */
static bool limit_reached(void)
{
    nh_context *c = nh_context_here();
    return atomic_load(&c->reached) && !atomic_load(&c->interrupted);
}

nh_code nh_ended_code(void) { return atomic_load(&nh_context_here()->interrupted) ? NH_INTERRUPTED : NH_LIMIT; }

void nh_ended_words(char *out, size_t size)
{
    nh_context *c = nh_context_here();
    if (atomic_load(&c->interrupted)) snprintf(out, size, "interrupted");
    else if (atomic_load(&c->filled))
        snprintf(out, size, "the memory limit of %g MB was reached", c->most_memory / NH_MEGABYTE);
    else snprintf(out, size, "the time limit of %g s was reached", c->limit_seconds);
}

const char *nh_ended_option(void)
{
    if (!limit_reached()) return NULL;
    return atomic_load(&nh_context_here()->filled) ? "--max-memory" : "--max-seconds";
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
    return nh_ended_option() ? nh_error_hint(error, "raise it by %s", nh_ended_option()) : false;
}

bool nh_interrupted_callback(void *context)
{
    (void)context;
    return nh_interrupted();
}
