/* sweep: which part of a sweep over systems, seeds or sizes a run of the tests tries.
 *
 * `make check` tries a fixed sample, the same every time, and a smaller one under sanitizers, which make everything several times slower.
 * With NHSYM_SWEEPS=all (`make check-all`) all is tried.  Tests begin at different places, so that together they see many systems. */
#ifndef NH_TESTS_SWEEP_H
#define NH_TESTS_SWEEP_H

#include <criterion/criterion.h>

#include <dirent.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Is the program linked with sanitizers?  The code of the tests is the same with and without. */
bool sweep_sanitized(void);

enum { most_files = 500 };

static inline int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* The systems or analyses of a folder, in the order of their names, which are the caller's to free. */
static inline size_t list(const char *folder, char **name)
{
    DIR *d = opendir(folder);
    size_t n = 0;
    for (struct dirent *e; d && n < most_files && (e = readdir(d));) {
        size_t length = strlen(e->d_name);
        if (length > 5 && !strcmp(e->d_name + length - 5, ".yaml")) name[n++] = strndup(e->d_name, length - 5);
    }
    if (d) closedir(d);
    if (n) qsort(name, n, sizeof *name, by_name);
    return n;
}

static inline bool sweep_whole(void)
{
    const char *sweeps = getenv("NHSYM_SWEEPS");
    return sweeps && !strcmp(sweeps, "all");
}

/* Is number i of a sweep tried?  One in so many is, under sanitizers one in so many others.  i + k begins at another place. */
static inline bool sweep_tries(size_t i, size_t one_in, size_t one_in_sanitized)
{
    return sweep_whole() || i % (sweep_sanitized() ? one_in_sanitized : one_in) == 0;
}

/* Behind the name of a test that is one long computation, and of one whose code others run under sanitizers, with smaller systems.
 * No process is started for them; criterion_start.c enables the first where all is tried, and disables the others under sanitizers. */
extern char sweep_plain_only[];
#define WHOLE_ONLY .disabled = true
#define PLAIN_ONLY .data = sweep_plain_only

#endif
