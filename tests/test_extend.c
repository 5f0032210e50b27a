/* The steps of docs/extending.md, taken in a copy of the sources: `make check` compiles what they change, `make check-all` builds and runs the
 * program. */
#include <criterion/criterion.h>

#include "sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const steps[] = {"command", "family", "form", "function", "integrator", "joint"};
enum { step_count = sizeof steps / sizeof *steps };

Test(extend, the_steps_of_the_docs_work, PLAIN_ONLY)
{
    for (size_t i = 0; i < step_count; i++) {
        char command[200], line[400], wrong[4000] = "";
        snprintf(command, sizeof command, "sh tests/extend.sh %s %s 2>&1", steps[i], sweep_whole() ? "" : "quick");
        FILE *out = popen(command, "r");
        cr_assert_not_null(out);
        while (fgets(line, sizeof line, out)) strncat(wrong, line, sizeof wrong - strlen(wrong) - 1);
        int code = pclose(out);
        cr_expect(code == 0 && !*wrong, "%s: exit %d\n%s", steps[i], code, wrong);
    }
}

/* The page names every file of steps. */
Test(extend, the_docs_name_the_steps)
{
    char line[4000];
    size_t named = 0;
    FILE *page = fopen("docs/extending.md", "r");
    cr_assert_not_null(page);
    while (fgets(line, sizeof line, page))
        for (size_t i = 0; i < step_count; i++) {
            char path[100];
            snprintf(path, sizeof path, "(../tests/extend/%s.txt)", steps[i]);
            named += strstr(line, path) != NULL;
        }
    fclose(page);
    cr_expect_eq(named, (size_t)step_count);
}
