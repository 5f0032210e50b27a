/* progress_line: progress on stderr. */
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/progress.h"
#include "cli/cli.h"

enum { widest = 60 };

static bool live;          /* one line that is rewritten, on a terminal */
static double begun, told; /* seconds */
static char last[widest + 1];

/* "42 %, 7 s left: ": the rest at the rate so far. */
static void put_part(double part)
{
    double left = part > 0 ? (nh_clock() - begun) * (1 - part) / part : -1;
    fprintf(stderr, "%3.0f %%", 100 * part);
    if (left >= 600) fprintf(stderr, ", %.0f min left", left / 60);
    else if (left >= 0) fprintf(stderr, ", %.0f s left", ceil(left));
    fputs(": ", stderr);
}

/* Prints a line for every step, and now and then how far it is: ten times a second on a terminal. */
static void show(void *context, const char *doing, double part)
{
    (void)context;
    double moment = nh_clock(), pause = live ? 0.1 : 5;
    bool same = !strncmp(doing, last, widest);
    if (same && moment - told < pause) return;
    told = moment;
    snprintf(last, sizeof last, "%s", doing);
    if (live) fputs("\r\033[K", stderr);
    if (part >= 0) put_part(part);
    fprintf(stderr, live ? "%s" : "%s\n", last);
    fflush(stderr);
}

void nh_cli_progress_begin(const nh_cli *cli)
{
    const nh_options *o = &cli->ask.options;
    static const double part = 0.75; /* of the memory: before the machine is of no use to others */
    nh_cli_guard_begin(cli->ask.limited ? o->max_seconds : INFINITY,
                       o->max_memory > 0 ? o->max_memory * NH_MEGABYTE : part * nh_memory_of_machine());
    bool terminal = isatty(STDERR_FILENO);
    if (cli->progress == NH_PROGRESS_NEVER || (cli->progress == NH_PROGRESS_AUTO && (!terminal || cli->quiet))) return;
    live = terminal;
    begun = nh_clock();
    nh_progress_set(show, NULL);
}

void nh_cli_progress_end(void)
{
    nh_cli_guard_writing();
    nh_progress_set(NULL, NULL);
    if (live) fputs("\r\033[K", stderr);
    live = false;
    fflush(stderr);
}
