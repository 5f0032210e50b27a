/* Documents of commands that write each part once: what the page shows, the LaTeX document of the same run shows as well, title by title and
 * number by number, and LaTeX takes what stands in it. */
#include "program.h"
#include "sweep.h"

static const char *const commands[] = {
    "verify sleigh --current m*v^2/2",
    "verify sleigh --current m*v^2/2+m*a^2*k^2*omega^2/2",
    "verify sleigh --field Z0=1 --equations",
    "verify sleigh --field x=1",
    "verify sleigh --field x=1 --of equations",
    "verify heisenberg_particle --current x'^2+y'^2",
    "simulate sleigh --until 3",
    "simulate sleigh --until 1 --accuracy 1e-6 --watch v",
    "simulate sleigh --until 1 --ensemble 3",
    "simulate free_particle --method midpoint --step 0.1 --until 1",
    "benchmark free_particle --until 1 --budget 0.1s --over x=0:1 --initial x=0",
    "classify penning_trap --over w --degree 2",
    "classify penning_trap --over w,B --degree 1",
};
enum { command_count = sizeof commands / sizeof *commands };

/* What stands between `begin` and `end`, the next one from *at on; in `out`, false after the last. */
static bool next_between(const char **at, const char *begin, char end, char *out, size_t size)
{
    const char *from = strstr(*at, begin);
    if (!from) return false;
    from += strlen(begin);
    size_t length = strcspn(from, (const char[]){end, 0});
    snprintf(out, size, "%.*s", (int)length, from);
    *at = from + length;
    return true;
}

/* The part that both forms have: without the glossary, and without how the run is repeated, which names the files of this form. */
static char *shared_part(const char *page)
{
    const char *from = strstr(page, "</nav>"), *to = strstr(page, "<section id=\"system\"");
    cr_assert(from && to && from < to);
    return strndup(from, (size_t)(to - from));
}

static void compare(const char *command, const char *page, const char *tex)
{
    char *part = shared_part(page), one[300], wanted[400];
    size_t titles = 0, numbers = 0;
    for (const char *at = part; next_between(&at, "<h2>", '<', one, sizeof one); titles++) {
        snprintf(wanted, sizeof wanted, "\\section{%s}", one);
        cr_expect(strstr(tex, wanted), "%s: no %s", command, wanted);
    }
    for (const char *at = part; next_between(&at, "<data value=\"", '"', one, sizeof one); numbers++) {
        snprintf(wanted, sizeof wanted, "\\nhnumber{%s}", one);
        cr_expect(strstr(tex, wanted), "%s: no %s", command, wanted);
    }
    cr_expect(titles > 0 && (numbers > 0 || !strncmp(command, "classify", 8)), "%s: %zu titles, %zu numbers", command, titles, numbers);
    free(part);
}

/* Braces and environments close in the order in which they were opened. */
static void expect_balanced(const char *command, const char *tex)
{
    int depth = 0, open = 0;
    for (const char *c = tex; *c; c++) {
        if (*c == '\\' && c[1] && strchr("{}\\%", c[1])) {
            c++;
            continue;
        }
        depth += (*c == '{') - (*c == '}');
        cr_assert_geq(depth, 0, "%s: %.60s", command, c);
        open += !strncmp(c, "\\begin{", 7) - !strncmp(c, "\\end{", 5);
        cr_assert_geq(open, 0, "%s: %.60s", command, c);
    }
    cr_expect(depth == 0 && open == 0, "%s: %d braces and %d environments are open", command, depth, open);
}

Test(documents, the_page_and_the_latex_document_say_the_same)
{
    for (size_t i = 0; i < command_count; i++) {
        if (!sweep_tries(i, 1, 4)) continue;
        place p = place_with_systems();
        char line[400];
        snprintf(line, sizeof line, "%s --quiet --html page.html --tex page.tex", commands[i]);
        finished done = run(&p, line);
        cr_expect(done.code <= 1, "%s: %d %s", commands[i], done.code, done.err);
        char *page = read_here(&p, "page.html"), *tex = read_here(&p, "page.tex");
        cr_assert(page && tex);
        compare(commands[i], page, tex);
        expect_balanced(commands[i], tex);
        free(page);
        free(tex);
        finished_clear(&done);
        place_clear(&p);
    }
}

/* Places in the space of the parameters are formulas, the word of an option is code; the Lagrangian has a bar where constraints were inserted. */
Test(documents, formulas_and_options_are_set_as_such, PLAIN_ONLY)
{
    static const struct {
        const char *command, *wanted[4], *not;
    } of[] = {
        {"classify penning_trap --over w --degree 2",
         {"<h3><math", "<p>With <code>--option theorem=", "<p>Lagrangian and energy</p>\n<div class=\"formula\"><math displaystyle=\"true\"><mi>L</mi>", "\\subsection*{$3\\,w^{2} - 16 = 0$ ($w =  - 2.3094011$, $2.3094011$)}"},
         "<h3>3"},
        {"classify penning_trap --over w,B --degree 1", {"\\subsection*{$w = 0$, $B = 0$ (on $w = 0$)}"}, "<h3>w"},
        {"simulate sleigh --until 0.1", {"<p>Constrained Lagrangian and energy</p>\n<div class=\"formula\"><math><mover accent=\"true\"><mrow><mi>L</mi>"}, "<mi>L</mi></math> <math><mo>=</mo></math> <math displaystyle=\"true\"><mi>E"},
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        if (!sweep_tries(i + 1, 1, 2)) continue;
        char line[400];
        snprintf(line, sizeof line, "%s --quiet --html page.html --tex page.tex", of[i].command);
        finished done = run_expecting(&p, line, 0);
        char *page = read_here(&p, "page.html"), *tex = read_here(&p, "page.tex");
        for (size_t k = 0; k < 4 && of[i].wanted[k]; k++) cr_expect(strstr(page, of[i].wanted[k]) || strstr(tex, of[i].wanted[k]), "%s: no %s", of[i].command, of[i].wanted[k]);
        cr_expect_null(strstr(page, of[i].not), "%s: %s", of[i].command, of[i].not);
        free(page);
        free(tex);
        finished_clear(&done);
    }
    place_clear(&p);
}
