#include "base/progress.h"

#include <signal.h>
#include <stddef.h>

static nh_progress_handler *handler;
static void *handler_context;
static volatile sig_atomic_t interrupted;

void nh_progress_set(nh_progress_handler *new_handler, void *context)
{
    handler = new_handler;
    handler_context = context;
}

void nh_progress(const char *doing, double part)
{
    if (handler) handler(handler_context, doing, part > 1 ? 1 : part);
}

void nh_interrupt(void) { interrupted = 1; }
bool nh_interrupted(void) { return interrupted; }

bool nh_interrupted_callback(void *context)
{
    (void)context;
    return interrupted;
}
