/* install: the program, its libraries and its pages as a distribution has them (tests/install.sh). */
#include <criterion/criterion.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "sweep.h"

/* What a command prints, and its exit code. */
static int run(const char *command, char *out, size_t size)
{
    FILE *pipe = popen(command, "r");
    cr_assert(pipe);
    size_t n = fread(out, 1, size - 1, pipe);
    out[n] = 0;
    while (getc(pipe) != EOF) continue;
    int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

Test(install, installs_compiles_runs_and_leaves_no_trace, PLAIN_ONLY)
{
    char said[20000];
    int  code = run("sh tests/install.sh 2>&1", said, sizeof said);
    cr_expect_eq(code, 0, "%s", said);
}

/* What a packager gives comes after the project's own, which stays. */
Test(install, flags_are_added)
{
    char said[20000];
    int  code = run("MAKEFLAGS= CPPFLAGS=-DGIVEN=1 make -n -s -W src/base/text.c SANITIZE= CFLAGS=-O0 LDFLAGS=-Wl,--given build/src/base/text.o build/nhsym 2>&1 | grep -e ' -c src/base/text.c ' -e '-o build/nhsym'", said, sizeof said);
    cr_assert_eq(code, 0, "%s", said);
    size_t compiled = 0, linked = 0;
    for (char *line = strtok(said, "\n"); line; line = strtok(NULL, "\n")) {
        if (strstr(line, " -c src/base/text.c ")) {
            const char *own = strstr(line, "-std=c17"), *given = strstr(line, " -O0 "), *before = strstr(line, " -O2 ");
            cr_expect(own && given && before && before < given && strstr(line, "-Isrc") && strstr(line, "-DGIVEN=1"), "%s", line);
            compiled++;
        }
        linked += strstr(line, "-Wl,--given") && strstr(line, "-o build/nhsym");
    }
    cr_expect_eq(compiled, 1u);
    cr_expect_eq(linked, 1u);
}

/* Whoever builds the same sources in another folder gets the same bytes. */
Test(install, the_folder_of_the_build_is_not_in_it)
{
    char said[20000];
    int  code = run("here=$(pwd -P); grep -lF -e \"$here\" build/nhsym build/libnhsym.a build/libnhsym.so.1 2>&1", said, sizeof said);
    cr_expect_eq(code, 1, "%s", said); /* read, and not found */
}
