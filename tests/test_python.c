/* python: the tests of the Python package (src/python/tests), by pytest. */
#include <criterion/criterion.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "sweep.h"

/* All files in one process, which imports NumPy and SymPy once. */
Test(python, package)
{
    enum { least = 240 }; /* so many tests must pass, so that none is lost silently */
    char line[1000], said[20000] = "";
    int  passed = 0;
    if (sweep_sanitized()) {
        cr_log_warn("skipped: Python loads the library of the plain build");
        cr_skip_test("the plain build's");
    }
    FILE *pipe = popen("sh tests/python.sh -m pytest -q -p no:cacheprovider src/python/tests 2>&1", "r");
    cr_assert(pipe);
    while (fgets(line, sizeof line, pipe)) {
        if (strlen(said) + strlen(line) < sizeof said) strcat(said, line);
        char *word = strstr(line, " passed");
        while (word && word > line && word[-1] >= '0' && word[-1] <= '9') word--;
        if (word) passed = atoi(word);
    }
    int status = pclose(pipe);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77) {
        cr_log_warn("skipped: %s", said);
        cr_skip_test("no Python");
    }
    cr_expect(WIFEXITED(status) && WEXITSTATUS(status) == 0, "%s", said);
    cr_expect_geq(passed, least, "%s", said);
}
