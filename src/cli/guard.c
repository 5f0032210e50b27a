/* guard: signals and the limits of time and memory.
 *
 * One thread waits for all of them.  A pipe that nobody reads any more and a file that may not grow are errors of the
 * write, for which their signals wait.
 *
 *     the first signal, a limit           the computation ends by base/progress.h, and what it has is written
 *     the same signal within `same_press` nothing: `timeout` sends it to the process and to its group
 *     a second signal; one that comes     the process ends at once
 *       while a result is written
 *     the computation has not come back   the process ends at once
 *       after `grace` or `more` memory
 *     a limit while a result is written   nothing, but for `patience` times the grace
 *
 * At once means: without temporary files, folders and children (base/leave.h), so that every file is whole or as it
 * was.  Where a result takes longer to write than `patience_of_user` after the first signal, as tables of many motions
 * do, a line says what a second one does. */
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/leave.h"
#include "base/progress.h"
#include "cli/cli.h"

static atomic_bool writing, standing;
static pthread_t guard;
static double limit, end; /* seconds of the monotonic clock */
static double most;       /* bytes; 0: no limit */
static bool stopped;      /* ended by a signal */

static void end_at_once(int code, const char *reached, const char *option)
{
    char doing[80] = "", seconds[40] = "";
    nh_leave_now();
    nh_progress_last(doing, sizeof doing);
    if (!strcmp(reached, "time")) snprintf(seconds, sizeof seconds, " of %g s", limit);
    if (code == NH_INTERRUPTED)
        dprintf(STDERR_FILENO, "nhsym: interrupted%s\n",
                atomic_load(&writing) ? ": the results were not written completely, and files remain as they were"
                                      : "");
    else
        dprintf(STDERR_FILENO, "nhsym: %s%sthe %s limit%s was reached%s\nhint: raise it by %s\n", doing,
                *doing ? ": " : "", reached, seconds,
                atomic_load(&writing) ? ", and the results could not be written in time"
                                      : " before any result could be written",
                option);
    _exit(code);
}

static const int taken_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, SIGXFSZ};
enum { signal_count = sizeof taken_signals / sizeof *taken_signals };

/* All of them but those that whoever started the program ignores, as nohup does (a shell ignores SIGINT for a command
 * in the background; we take it all the same). */
static sigset_t signals(void)
{
    static sigset_t set;
    static bool known;
    for (size_t i = 0; i < signal_count && !known; i++) {
        struct sigaction before;
        if (i == 0) sigemptyset(&set);
        bool heard = i < 2 || (!sigaction(taken_signals[i], NULL, &before) && before.sa_handler != SIG_IGN);
        if (heard) sigaddset(&set, taken_signals[i]);
    }
    known = true;
    return set;
}

/* Waits for the next signal; 0: it is time to look at the clocks. */
static int next_signal(const sigset_t *set)
{
    static const double shortest = 0.01;
    const double longest = most > 0 ? 0.02 : 3600;
    double left = stopped ? shortest : fmin(fmax(end - nh_clock(), shortest), longest), whole = floor(left);
    struct timespec pause = {(time_t)whole, (long)(1e9 * (left - whole))};
    int number = sigtimedwait(set, NULL, &pause);
    return number > 0 ? number : 0;
}

/* How long a computation may take to come back, in processor time, so that a busy machine does not take a result away.
 * The partial result is then written, which may take `patience` times as long by the clock, as may a wait for something
 * other than the processor. */
static bool past_grace(void)
{
    static const double part = 0.12, more = 0.12, patience = 10;
    static double used; /* when the limit was reached */
    double grace = part * limit + more, now = nh_clock();
    if (now < end) return false;
    if (used == 0) used = nh_clock_of_process();
    return nh_clock_of_process() - used > (atomic_load(&writing) ? patience : 1) * grace ||
           now - end > patience * grace;
}

/* An interrupted computation has come back, and its result is written.  Where writing takes long a line says so,
 * once. */
static void tell_of_writing(void)
{
    static const double patience_of_user = 0.3;
    static double begun; /* when it came back */
    static bool told;
    if (told || !stopped || !atomic_load(&writing)) return;
    if (begun == 0) begun = nh_clock();
    if (nh_clock() - begun < patience_of_user) return;
    told = true;
    dprintf(STDERR_FILENO, "nhsym: interrupted; writing the results so far: interrupt again to end without them\n");
}

/* How much memory beyond the limit a computation may use to come back and to write its result. */
static bool past_memory(void)
{
    static const double part = 0.25, more = 64 * NH_MEGABYTE;
    return most > 0 && nh_memory_in_use() > (1 + part) * most + more;
}

/* The first ends the computation, the second the process. */
static void take_signal(int number)
{
    static const double same_press = 0.3;
    static int first; /* the thread took a signal */
    static double taken;
    if (number == first && (nh_clock() - taken < same_press || number == SIGXCPU)) return; /* it comes every second */
    if (nh_interrupted() || atomic_load(&writing)) end_at_once(NH_INTERRUPTED, "", "");
    nh_interrupt();
    stopped = true;
    first = number;
    taken = nh_clock();
}

static void *stand(void *unused)
{
    sigset_t set = signals();
    while (true) {
        int number = next_signal(&set);
        if (number) {
            take_signal(number);
        } else if (past_grace()) {
            end_at_once(NH_LIMIT, "time", "--max-seconds");
        } else if (past_memory()) {
            end_at_once(NH_LIMIT, "memory", "--max-memory");
        } else {
            tell_of_writing();
        }
    }
    return unused;
}

/* A thread that a library began before main receives the signals that our threads block: they are passed on to the
 * guard.  Where the guard could not be started the first one ends the computation, and the second the process. */
static void on_signal(int number)
{
    if (atomic_load(&standing)) {
        pthread_kill(guard, number);
        return;
    }
    nh_interrupt();
    signal(number, SIG_DFL);
}

void nh_cli_guard_begin(double seconds, double bytes)
{
    struct sigaction act = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    sigset_t set = signals();
    sigemptyset(&act.sa_mask);
    for (size_t i = 0; i < signal_count; i++)
        if (sigismember(&set, taken_signals[i])) sigaction(taken_signals[i], &act, NULL);
    nh_limit_set(seconds);
    nh_limit_memory_set(bytes);
    limit = seconds;
    most = bytes;
    end = nh_clock() + seconds;
    pthread_sigmask(SIG_BLOCK, &set, NULL);
    bool stands = pthread_create(&guard, NULL, stand, NULL) == 0;
    atomic_store(&standing, stands);
    if (!stands) pthread_sigmask(SIG_UNBLOCK, &set, NULL);
    else pthread_detach(guard);
}

void nh_cli_guard_worker(void) { nh_cli_guard_begin(INFINITY, most); }

void nh_cli_guard_writing(void)
{
    nh_limit_pass();
    atomic_store(&writing, true);
}
