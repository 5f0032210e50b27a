/* context: see context.h. */
#include <math.h>

#include "base/context_internal.h"
#include "base/foreign_memory.h"
#include "base/memory.h"
#include "base/recovery.h"

static nh_context of_process = {
    .most = INFINITY,
    .saying_lock = PTHREAD_MUTEX_INITIALIZER,
    .limit = INFINITY,
    .limit_seconds = INFINITY,
    .deadline = INFINITY,
    .time_limit = {INFINITY, INFINITY},
    .files_lock = PTHREAD_MUTEX_INITIALIZER,
};

static _Thread_local nh_context *entered; /* NULL: the context of the process */

static void create(void *out)
{
    nh_context *c = nh_alloc(sizeof *c);
    c->most = c->limit = c->limit_seconds = c->deadline = INFINITY;
    c->time_limit = (nh_clock_limit){INFINITY, INFINITY};
    pthread_mutex_init(&c->saying_lock, NULL);
    pthread_mutex_init(&c->files_lock, NULL);
    *(nh_context **)out = c;
}

nh_context *nh_context_create(void)
{
    nh_context *c = NULL;
    nh_foreign_memory_begin();
    return nh_recovery_run(create, &c) ? c : NULL;
}

void nh_context_free(nh_context *c)
{
    if (!c || atomic_load(&c->left_alone)) return;
    nh_known_files_free(c->file);
    pthread_mutex_destroy(&c->saying_lock);
    pthread_mutex_destroy(&c->files_lock);
    nh_free(c);
}

void nh_known_files_free(nh_known_file *first)
{
    while (first) {
        nh_known_file *f = first;
        first = f->next;
        nh_free(f->path);
        nh_free(f->text);
        nh_free(f);
    }
}

nh_context *nh_context_here(void) { return entered ? entered : &of_process; }

nh_context *nh_context_enter(nh_context *context)
{
    nh_context *before = nh_context_here();
    entered = context == &of_process ? NULL : context;
    return before;
}
