/* python: the tests of the Python package (src/python/tests), by pytest. */
#include <criterion/criterion.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include "sweep.h"

/* One file of them; `least`: as many tests must pass at least, so that none is lost silently. */
static void run(const char *file, int least)
{
    char command[300], line[1000], said[20000] = "";
    int  passed = 0;
    if (SWEEP_SANITIZED) cr_log_warn("skipped: Python loads the library of the plain build");
    sweep_plain_only();
    snprintf(command, sizeof command, "sh tests/python.sh -m pytest -q -p no:cacheprovider src/python/tests/%s 2>&1", file);
    FILE *pipe = popen(command, "r");
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
    cr_expect(WIFEXITED(status) && WEXITSTATUS(status) == 0, "%s:\n%s", file, said);
    cr_expect_geq(passed, least, "%s:\n%s", file, said);
}

Test(python, signatures) { run("test_header.py", 3); }
Test(python, formulas) { run("test_formula.py", 8); }
Test(python, systems) { run("test_system.py", 8); }
Test(python, results) { run("test_results.py", 8); }
Test(python, calls) { run("test_calls.py", 5); }
Test(python, package) { run("test_package.py", 2); }
Test(python, notebook) { run("test_notebook.py", 3); }
