#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>

enum { most_threads = 64 };

typedef struct {
    size_t jobs;
    atomic_size_t next;
    void (*job)(size_t, void *);
    void *context;
} queue;

static void *work(void *argument)
{
    queue *q = argument;
    for (size_t i; (i = atomic_fetch_add(&q->next, 1)) < q->jobs;) q->job(i, q->context);
    return NULL;
}

void nh_parallel(size_t jobs, size_t threads, void (*job)(size_t index, void *context), void *context)
{
    queue q = {.jobs = jobs, .job = job, .context = context};
    pthread_t helper[most_threads];
    size_t wanted = threads < jobs ? threads : jobs, started = 0;
    if (wanted > most_threads) wanted = most_threads;
    for (size_t i = 1; i < wanted; i++)
        if (pthread_create(&helper[started], NULL, work, &q) == 0) started++;
    work(&q);
    for (size_t i = 0; i < started; i++) pthread_join(helper[i], NULL);
}
