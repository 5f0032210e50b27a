/* watch: progress on stderr, and signals. */
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include "base/progress.h"
#include "cli/cli.h"

enum { widest = 60 };

static bool live; /* a line that is rewritten, on a terminal */

static void on_signal(int number)
{
    (void)number;
    nh_interrupt();
}

static void show(void *context, const char *doing, double part)
{
    (void)context;
    char percent[20] = "";
    if (part >= 0) snprintf(percent, sizeof percent, "%3.0f %% of the time  ", 100 * part);
    fprintf(stderr, live ? "\r\033[K%s%.*s" : "%s%.*s\n", percent, widest, doing);
    fflush(stderr);
}

void nh_cli_watch_begin(const nh_cli *cli)
{
    struct sigaction act = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&act.sa_mask);
    sigaction(SIGINT, &act, NULL);
    sigaction(SIGTERM, &act, NULL);
    bool terminal = isatty(STDERR_FILENO);
    if (cli->progress == NH_PROGRESS_NEVER || (cli->progress == NH_PROGRESS_AUTO && (!terminal || cli->quiet))) return;
    live = terminal;
    nh_progress_set(show, NULL);
}

void nh_cli_watch_end(void)
{
    nh_progress_set(NULL, NULL);
    if (live) fputs("\r\033[K", stderr);
    live = false;
    fflush(stderr);
}
