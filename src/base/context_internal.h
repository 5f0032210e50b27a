/* context_internal: what budget, progress, files and parallel keep in a context. */
#ifndef NH_CONTEXT_INTERNAL_H
#define NH_CONTEXT_INTERNAL_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/clock.h"
#include "base/context.h"

enum { nh_context_longest_saying = 80 };

typedef struct nh_known_file {
    struct nh_known_file *next;
    char *path, *text;
    size_t length;
} nh_known_file;

void nh_known_files_free(nh_known_file *first);

struct nh_context {
    /* base/budget.c */
    atomic_uint_fast64_t used; /* whole units: a sum of integers does not depend on the order in which threads add */
    double most;               /* units; written between computations, read by all of their threads */
    /* base/progress.c */
    nh_progress_handler *handler;
    void *handler_context;
    pthread_mutex_t saying_lock;
    char saying[nh_context_longest_saying];
    atomic_bool interrupted, reached;
    /* seconds of the monotonic clock; written between computations, read by all of their threads */
    double limit, limit_seconds, deadline;
    nh_clock_limit time_limit;
    double most_memory;       /* bytes, 0: no limit; written and read likewise */
    _Atomic double next_look; /* when the memory is measured next, on the same clock */
    atomic_bool filled;       /* the limit of memory ended the computation */
    /* base/files.c */
    pthread_mutex_t files_lock;
    bool files_kept;
    nh_known_file *file;
    /* base/parallel.c */
    atomic_size_t left_alone; /* jobs */
};

#endif
