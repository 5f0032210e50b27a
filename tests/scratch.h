/* scratch: files of a test's own, in the folder for temporary ones, and C code that is compiled and run. */
#ifndef NH_TESTS_SCRATCH_H
#define NH_TESTS_SCRATCH_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SCRATCH = 256 };

static inline void scratch_name(char path[SCRATCH])
{
    const char *folder = getenv("TMPDIR");
    snprintf(path, SCRATCH, "%.200s/nhsym-test-XXXXXX", folder && *folder ? folder : "/tmp");
}

/* A new file, to be written, closed and removed; its path.  NULL when there can be none. */
static inline FILE *scratch_open(char path[SCRATCH])
{
    scratch_name(path);
    int file = mkstemp(path);
    return file < 0 ? NULL : fdopen(file, "w");
}

/* One with this text. */
static inline bool scratch_text(char path[SCRATCH], const char *text)
{
    FILE *out = scratch_open(path);
    return out && (fputs(text, out) >= 0) & (fclose(out) == 0);
}

/* Compile a program without a warning and run it; the numbers that it prints, one to a line.  Their number, or -1 when it fails. */
static inline long scratch_run_c_with(const char *libraries, const char *code, double *out, size_t most)
{
    char folder[SCRATCH], name[SCRATCH + 20], command[SCRATCH + 200], line[100];
    long n = 0;
    scratch_name(folder);
    if (!mkdtemp(folder)) return -1;
    snprintf(name, sizeof name, "%s/code.c", folder);
    FILE *file = fopen(name, "w");
    if (!file || (fputs(code, file) < 0) | (fclose(file) != 0)) return -1;
    snprintf(command, sizeof command, "cd %s && ${CC:-cc} -std=c99 -Wall -Wextra -Werror code.c -o code %s -lm && ./code", folder, libraries);
    FILE *pipe = popen(command, "r");
    while (pipe && (size_t)n < most && fgets(line, sizeof line, pipe)) out[n++] = strtod(line, NULL);
    if (!pipe || pclose(pipe) != 0) n = -1;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command) == 0 ? n : -1;
}

static inline long scratch_run_c(const char *code, double *out, size_t most) { return scratch_run_c_with("", code, out, most); }

#endif
