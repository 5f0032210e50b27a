/* Wall time and peak memory of whole processes.
 *
 *     bench_run RUNS -- COMMAND ARGUMENT... [-- COMMAND ARGUMENT...]
 *
 * Every round runs each command once, so that a disturbance of the machine meets them all; one round before the first is not counted.
 * For each command a line: min, median and max of the wall time in milliseconds, largest peak of resident memory in MB (1e6 bytes).
 * The output of the commands is thrown away.  A command that fails ends the program with its exit code. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { most_commands = 8, most_runs = 1000 };

typedef struct {
    char **words;
    double ms[most_runs], megabytes;
} command;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* In the child: silence, then the command. */
static void become(char **words)
{
    int null = open("/dev/null", O_WRONLY);
    if (null >= 0) dup2(null, STDOUT_FILENO);
    execvp(words[0], words);
    perror(words[0]);
    _exit(127);
}

/* Milliseconds; the exit code when it is not 0. */
static double run(command *c, int *code)
{
    struct rusage usage;
    int status = 0;
    double start = now();
    pid_t child = fork();
    if (child == 0) become(c->words);
    if (child < 0 || wait4(child, &status, 0, &usage) != child) {
        perror("bench_run");
        exit(1);
    }
    double ms = 1e3 * (now() - start), megabytes = 1.024e-3 * (double)usage.ru_maxrss;
    *code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    if (megabytes > c->megabytes) c->megabytes = megabytes;
    return ms;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Cut the words at every "--", which becomes the end of the command before it. */
static size_t commands_of(int argc, char **argv, command *list)
{
    size_t count = 0;
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--")) continue;
        argv[i] = NULL;
        if (i + 1 < argc && count < most_commands) list[count++].words = argv + i + 1;
    }
    return count;
}

int main(int argc, char **argv)
{
    static command list[most_commands];
    int runs = argc > 1 ? atoi(argv[1]) : 0, code = 0;
    size_t count = commands_of(argc, argv, list);
    if (runs < 1 || runs > most_runs || count == 0) {
        fprintf(stderr, "usage: bench_run RUNS -- COMMAND ARGUMENT... [-- COMMAND ARGUMENT...]\n");
        return 2;
    }
    for (int i = -1; i < runs; i++)
        for (size_t k = 0; k < count; k++) {
            double ms = run(&list[k], &code);
            if (code) return code;
            if (i >= 0) list[k].ms[i] = ms;
        }
    for (size_t k = 0; k < count; k++) {
        qsort(list[k].ms, (size_t)runs, sizeof *list[k].ms, ascending);
        printf("%.2f %.2f %.2f %.2f\n", list[k].ms[0], list[k].ms[runs / 2], list[k].ms[runs - 1], list[k].megabytes);
    }
    return 0;
}
