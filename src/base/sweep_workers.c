/* sweep_workers: the units of a sweep shared by processes of one machine.
 *
 * A worker is a copy of this process.  It takes the next unit from memory that all share, until there are no more.
 * When one dies, another takes its place, and the unit that it was computing is repeated in the next round.  Workers
 * end when the process that started them has ended. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/progress.h"
#include "base/sweep_internal.h"

enum { most_workers = 256 };

typedef struct {
    atomic_size_t next, items_done;
    atomic_bool failed; /* the first failure is written below */
    nh_error error;
} shared;

typedef struct {
    const nh_sweep *sweep;
    size_t units, items, running;
    const size_t *unit;
    shared *common;
    pid_t worker[most_workers];
} pool;

static pid_t parent;

static bool orphan(void) { return getppid() != parent; }

/* ---- a worker ---- */

_Noreturn static void work(const pool *p)
{
    nh_error error;
    nh_error_clear(&error);
    nh_progress_set(NULL, NULL);
    if (p->sweep->begin_worker) p->sweep->begin_worker();
    shared *c = p->common;
    for (size_t i; !nh_interrupted() && !orphan() && !atomic_load(&c->failed) &&
                   (i = atomic_fetch_add(&c->next, 1)) < p->units;) {
        if (nh_sweep_do_unit(p->sweep, p->unit[i], &c->items_done, orphan, &error)) continue;
        if (atomic_exchange(&c->failed, true)) break;
        c->error = error;
        break;
    }
    _exit(0);
}

/* ---- the others ---- */

static bool start(pool *p)
{
    pid_t pid = fork();
    if (pid == 0) work(p);
    if (pid > 0) p->worker[p->running++] = pid;
    return pid > 0;
}

/* Removes a worker that has ended from the list; returns whether it ended before its work was done. */
static bool died(pool *p, size_t k, int status, nh_sweep_state *state)
{
    p->worker[k] = p->worker[--p->running];
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return false;
    state->deaths++;
    if (WIFSIGNALED(status))
        snprintf(state->death, sizeof state->death, "a worker was ended by signal %d (%s)", WTERMSIG(status),
                 strsignal(WTERMSIG(status)));
    else snprintf(state->death, sizeof state->death, "a worker ended with code %d", WEXITSTATUS(status));
    return true;
}

static void tell(const pool *p, int number)
{
    for (size_t k = 0; k < p->running; k++) kill(p->worker[k], number);
}

static void pause_shortly(void)
{
    static const struct timespec moment = {0, 20000000};
    nanosleep(&moment, NULL);
}

/* Waits until all workers have ended. */
static void attend(pool *p, nh_sweep_state *state)
{
    size_t spare = 2 * p->running; /* workers that may be replaced in this round */
    for (bool told = false; p->running;) {
        if (nh_interrupted() && !told) {
            tell(p, SIGTERM);
            told = true;
        }
        for (size_t k = 0; k < p->running;) {
            int status;
            if (waitpid(p->worker[k], &status, WNOHANG) == 0) {
                k++;
                continue;
            }
            bool more = died(p, k, status, state) && !told && spare && atomic_load(&p->common->next) < p->units;
            if (more) spare -= start(p);
        }
        nh_sweep_say(p->sweep, atomic_load(&p->common->items_done), p->items);
        pause_shortly();
    }
}

bool nh_sweep_do_in_workers(const nh_sweep *s, size_t units, const size_t *unit, nh_sweep_state *state, nh_error *error)
{
    shared *common = mmap(NULL, sizeof *common, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    pool p = {.sweep = s, .units = units, .unit = unit, .common = common};
    size_t wanted = s->workers < units ? s->workers : units;
    if (wanted > most_workers) wanted = most_workers;
    if (common == MAP_FAILED)
        return nh_fail(error, NH_LIMIT, "", "there is no memory for the workers: %s", strerror(errno));
    parent = getpid();
    for (size_t i = 0; i < units; i++)
        p.items += s->items - unit[i] * s->per_unit < s->per_unit ? s->items - unit[i] * s->per_unit : s->per_unit;
    fflush(NULL);
    for (size_t k = 0; k < wanted && start(&p);) k++;
    bool begun = p.running > 0;
    if (begun) attend(&p, state);
    bool good = begun && !atomic_load(&common->failed);
    if (!begun) nh_fail(error, NH_LIMIT, "", "no worker process could be started: %s", strerror(errno));
    else if (!good && error) *error = common->error;
    munmap(common, sizeof *common);
    return good;
}
