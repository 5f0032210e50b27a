#include "base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <time.h>

#include "base/context_internal.h"
#include "base/foreign_memory.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/recovery.h"

enum { most_threads = 64 };

/* ---- without memory ----
 *
 * A thread that works for another thread's run (base/recovery.h) has a run of its own.  When that is given up, the
 * other thread gives up its run, too, as soon as no thread works for it any more. */

typedef struct {
    bool recovers;        /* the thread that asked for the work is within a run */
    atomic_size_t wanted; /* bytes wanted by a run that was given up; 0: none was */
} rescue;

static rescue rescue_here(void) { return (rescue){.recovers = nh_recovery_here()}; }

/* False: the run was given up. */
static bool do_rescued(rescue *r, void (*job)(void *), void *data)
{
    if (!r->recovers) return job(data), true;
    if (nh_recovery_run(job, data)) return true;
    size_t wanted = nh_recovery_wanted();
    atomic_store(&r->wanted, wanted ? wanted : 1);
    return false;
}

static void end_rescue(rescue *r)
{
    size_t wanted = atomic_load(&r->wanted);
    if (wanted) nh_memory_ended(wanted);
}

/* ---- a queue of jobs ---- */

static atomic_ulong workers;
static _Thread_local unsigned long worker;

unsigned long nh_parallel_worker(void) { return worker; }

typedef struct {
    size_t jobs;
    atomic_size_t next;
    void (*job)(size_t, void *);
    void *context;
    nh_context *here;
    rescue rescue;
} queue;

static void do_jobs(void *argument)
{
    queue *q = argument;
    for (size_t i; (i = atomic_fetch_add(&q->next, 1)) < q->jobs;) q->job(i, q->context);
}

static void work(queue *q)
{
    unsigned long before = worker;
    nh_context_enter(q->here);
    worker = atomic_fetch_add(&workers, 1) + 1;
    if (!do_rescued(&q->rescue, do_jobs, q)) atomic_store(&q->next, q->jobs);
    worker = before;
}

static void end_thread(void)
{
    if (!nh_recovery_lost()) nh_foreign_memory_end();
}

static void *help(void *argument)
{
    work(argument);
    end_thread();
    return NULL;
}

void nh_parallel(size_t jobs, size_t threads, void (*job)(size_t index, void *context), void *context)
{
    queue q = {.jobs = jobs, .job = job, .context = context, .here = nh_context_here(), .rescue = rescue_here()};
    pthread_t helper[most_threads];
    size_t wanted = threads < jobs ? threads : jobs, started = 0;
    if (wanted > most_threads) wanted = most_threads;
    for (size_t i = 1; i < wanted; i++)
        if (pthread_create(&helper[started], NULL, help, &q) == 0) started++;
    work(&q);
    for (size_t i = 0; i < started; i++) pthread_join(helper[i], NULL);
    end_rescue(&q.rescue);
}

size_t nh_threads(double wanted)
{
    cpu_set_t mine;
    if (wanted >= 1) return (size_t)wanted;
    return sched_getaffinity(0, sizeof mine, &mine) ? 1 : (size_t)CPU_COUNT(&mine);
}

/* ---- a job in a thread of its own, while the caller goes on ---- */

struct nh_aside {
    nh_undo undo; /* first */
    pthread_t thread;
    bool started;
    void (*job)(void *);
    void *context;
    nh_context *here;
    rescue rescue;
};

static void *do_aside(void *argument)
{
    nh_aside *a = argument;
    nh_context_enter(a->here);
    do_rescued(&a->rescue, a->job, a->context);
    end_thread();
    return NULL;
}

static void await(nh_undo *undo) { pthread_join(((nh_aside *)undo)->thread, NULL); }

nh_aside *nh_aside_begin(void (*job)(void *), void *context)
{
    nh_aside *a = nh_alloc(sizeof *a);
    *a = (nh_aside){
        .undo.undo = await, .job = job, .context = context, .here = nh_context_here(), .rescue = rescue_here()};
    a->started = pthread_create(&a->thread, NULL, do_aside, a) == 0;
    if (a->started) nh_undo_add(&a->undo);
    else job(context);
    return a;
}

void nh_aside_end(nh_aside *a)
{
    if (!a) return;
    if (a->started) pthread_join(a->thread, NULL);
    nh_undo_remove(&a->undo);
    rescue r = a->rescue;
    nh_free(a);
    end_rescue(&r);
}

/* ---- one job that may be left alone ---- */

typedef struct {
    void (*job)(void *), (*release)(void *);
    void *context;
    pthread_mutex_t lock;
    pthread_cond_t ended;
    bool done, left;
    nh_context *here;
    unsigned long worker; /* the caller, who waits */
    rescue rescue;
} errand;

size_t nh_jobs_left(void) { return atomic_load(&nh_context_here()->left_alone); }

static void errand_free(errand *e)
{
    pthread_mutex_destroy(&e->lock);
    pthread_cond_destroy(&e->ended);
    nh_free(e);
}

static void *go(void *argument)
{
    errand *e = argument;
    nh_context_enter(e->here);
    worker = e->worker;
    bool whole = do_rescued(&e->rescue, e->job, e->context);
    pthread_mutex_lock(&e->lock);
    e->done = true;
    bool left = e->left;
    pthread_cond_signal(&e->ended);
    pthread_mutex_unlock(&e->lock);
    if (!left) return end_thread(), NULL;
    if (whole) e->release(e->context);
    errand_free(e);
    end_thread();
    atomic_fetch_sub(&nh_context_here()->left_alone, 1);
    return NULL;
}

static void look_every(struct timespec *until)
{
    enum { nanoseconds = 20000000, second = 1000000000 };
    clock_gettime(CLOCK_REALTIME, until);
    until->tv_nsec += nanoseconds;
    if (until->tv_nsec < second) return;
    until->tv_nsec -= second;
    until->tv_sec++;
}

bool nh_interruptible(void (*job)(void *), void (*release)(void *), void *context)
{
    errand *e = nh_alloc(sizeof *e);
    *e = (errand){.job = job,
                  .release = release,
                  .context = context,
                  .here = nh_context_here(),
                  .worker = worker,
                  .rescue = rescue_here(),
                  .lock = PTHREAD_MUTEX_INITIALIZER,
                  .ended = PTHREAD_COND_INITIALIZER};
    pthread_t thread;
    if (pthread_create(&thread, NULL, go, e)) { /* then it cannot be left alone */
        errand_free(e);
        job(context);
        return true;
    }
    pthread_mutex_lock(&e->lock);
    while (!e->done && !nh_interrupted()) {
        struct timespec until;
        look_every(&until);
        pthread_cond_timedwait(&e->ended, &e->lock, &until);
    }
    bool done = e->done;
    e->left = !done;
    if (e->left) atomic_fetch_add(&e->here->left_alone, 1);
    pthread_mutex_unlock(&e->lock);
    if (!done) return pthread_detach(thread), false;
    pthread_join(thread, NULL);
    rescue r = e->rescue;
    errand_free(e);
    end_rescue(&r);
    return true;
}
