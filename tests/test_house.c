/* The tables of docs/modules.md that `make house` writes: their form is that of today, whatever the numbers are. */
#include <criterion/criterion.h>

#include "program.h"

static char *file_of(const char *path)
{
    FILE *file = fopen(path, "r");
    cr_assert_not_null(file, "%s", path);
    char *text = read_stream(file);
    fclose(file);
    return text;
}

Test(house, the_tables_have_todays_form)
{
    FILE *form = popen("sh tests/house.sh --form", "r");
    char line[600], *page = file_of("docs/modules.md"), *begin = strstr(page, "<!-- house -->"), *end = begin ? strstr(begin, "<!-- end -->") : NULL;
    size_t rows = 0, lines = 0;
    cr_assert(form && end, "docs/modules.md has no place for the tables");
    *end = 0;
    while (fgets(line, sizeof line, form)) {
        char wanted[620];
        line[strcspn(line, "\n")] = 0;
        snprintf(wanted, sizeof wanted, *line == '|' ? "\n%s\n" : strchr(line, '/') ? "\n| `%s` | " : "\n| %s | ", line);
        cr_expect_not_null(strstr(begin, wanted), "`make house` would write %s", wanted + 1);
        lines++;
    }
    for (const char *c = begin; (c = strstr(c, "\n| ")); c++) rows++;
    cr_expect(pclose(form) == 0 && lines > 5 && rows == lines + 1, "%zu rows instead of %zu: run `make house`", rows, lines + 1); /* the numbers of the second table */
    free(page);
}
