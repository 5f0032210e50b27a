/* The time limit is a safety limit: what a run says after it is marked as partial, and is never a refutation; nothing stays behind.  How late a run may end is
 * measured by tests/limits.sh, not here. */
#include "program.h"
#include "sweep.h"

#include <cjson/cJSON.h>
#include <sys/resource.h>

static bool ends(const finished *f) { return strstr(f->err, "time limit") || strstr(f->out, "time limit"); }

static place place_with_nasty(void)
{
    place p = place_with_systems();
    char from[PATH_MAX + 40], to[PATH_MAX + 40];
    snprintf(from, sizeof from, "%.4000s/tests/data/nasty", p.project);
    snprintf(to, sizeof to, "%.4000s/nasty", p.folder);
    cr_assert_eq(symlink(from, to), 0);
    return p;
}

/* A system that takes minutes: exit code 5, with a partial result or with none. */
static void limited(const place *p, const char *arguments)
{
    finished f = run_expecting(p, arguments, 5);
    cJSON *root = *f.out ? cJSON_Parse(f.out) : NULL;
    cr_expect(ends(&f), "%s: %s%s", arguments, f.out, f.err);
    cr_expect(!*f.out || root, "%s: half a result: %.300s", arguments, f.out);
    if (root) {
        const char *verdict = cJSON_GetStringValue(cJSON_GetObjectItem(root, "verdict"));
        cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(root, "partial")), "%s", arguments);
        cr_expect(!verdict || strcmp(verdict, "NONE"), "%s", arguments);
    }
    cJSON_Delete(root);
    finished_clear(&f);
}

Test(limits, every_command_has_the_brake)
{
    static const char *const lines[] = {"analyze nasty/many_functions.yaml", "reduce nasty/spherical_chain.yaml", "analyze nasty/robot_12.yaml", "benchmark liouville --budget 100", "verify nasty/quadratic_constraints.yaml --current \"q1'\"",
                                        "simulate nasty/dense_mass.yaml --initial \"q1'=1\" --until 1000"};
    place p = place_with_nasty();
    char line[300];
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        snprintf(line, sizeof line, "%s --max-seconds 0.1 --json -", lines[i]);
        limited(&p, line);
    }
    place_clear(&p);
}

/* Before a regular point of the family is known as well. */
Test(limits, a_classification_has_the_brake)
{
    static const char *const seconds[] = {"0.001", "0.05", "0.1"};
    place p = place_with_systems();
    char line[200];
    for (size_t i = 0; i < sizeof seconds / sizeof *seconds; i++) {
        snprintf(line, sizeof line, "classify sleigh --over m --max-seconds %s", seconds[i]);
        finished f = run_expecting(&p, line, 5);
        cr_expect(ends(&f), "%s: %s%s", line, f.out, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* Runs with twice the time again and again, until what is said has the words, or (NULL) a result was written: a slow machine needs longer to come to the place
 * where the limit is to fall. */
static finished run_until_said(const place *p, const char *question, double *limit, const char *words)
{
    static const double longest = 60; /* s */
    char line[PATH_MAX + 40];
    for (;; *limit *= 2) {
        snprintf(line, sizeof line, "%s --max-seconds %g", question, *limit);
        finished f = run_expecting(p, line, 5);
        cr_expect(ends(&f) && !strstr(f.err, "interrupted"), "%s: %s", line, f.err);
        if ((words ? strstr(f.err, words) != NULL : *f.out != 0) || *limit > longest) return f;
        finished_clear(&f);
    }
}

/* What ended an ensemble has its name. */
Test(limits, an_ensemble_names_its_limit)
{
    place p = place_with_nasty();
    double limit = 0.1;
    char reached[100];
    finished f = run_until_said(&p, "simulate nasty/many_coordinates.yaml --initial x1'=0.1 --until 1e4 --ensemble 200 --watch x1", &limit, " members did not reach the end; ");
    snprintf(reached, sizeof reached, "the time limit of %g s was reached", limit);
    cr_expect(strstr(f.err, reached), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

/* Wherever the limit falls: in a motion or between two. */
Test(limits, a_table_of_motions_holds_those_before_the_limit)
{
    place p = place_with_systems();
    for (int i = 0; i < 3; i++) {
        char line[PATH_MAX + 20];
        double limit = 0.2 + i / 100.;
        snprintf(line, sizeof line, "simulate sleigh --over k=1:2:100000 --until 10 --csv %d.csv -q", i);
        finished f = run_until_said(&p, line, &limit, " of 100000 motions were computed\nhint: raise it by --max-seconds");
        finished_clear(&f);
        snprintf(line, sizeof line, "%s/%d.csv", p.folder, i);
        cr_expect_eq(access(line, R_OK), 0, "%s is not there", line);
    }
    place_clear(&p);
}

/* What an ensemble would need is told before it is computed, with what there is and what to do. */
Test(limits, an_ensemble_beyond_the_memory_says_its_size)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "simulate sleigh --initial omega=2 --until 10 --ensemble 10000 --max-memory 100M", 5);
    cr_expect(strstr(f.err, "10000 motions at 101 times with 17 columns need 0.572 GB of memory, of which there are 0.0977") != NULL, "%s", f.err);
    cr_expect(strstr(f.err, "(--watch) need less; or raise --max-memory") != NULL, "%s", f.err);
    cr_expect_str_eq(f.out, "");
    finished_clear(&f);
    f = run_expecting(&p, "simulate sleigh --initial omega=2 --until 1000 --ensemble 10000000 --step 0.01", 5);
    cr_expect(strstr(f.err, "10000000 motions at 100001 times with 17 columns need 5.66e+05 GB of memory") && !strstr(f.err, "raise"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

#ifndef __SANITIZE_ADDRESS__ /* whose own memory needs an address space without limit */
/* In 2 GB of address space a motion at 9 million times has no room. */
Test(limits, an_allocation_that_fails_has_a_sentence)
{
    place p = place_with_systems();
    struct rlimit tight = {(rlim_t)2 << 30, (rlim_t)2 << 30};
    cr_assert_eq(setrlimit(RLIMIT_AS, &tight), 0);
    finished f = run_expecting(&p, "simulate sleigh --initial omega=2 --until 900 --step 1e-4", 5);
    cr_expect(strstr(f.err, "out of memory: ") && strstr(f.err, " MB more were wanted\nhint: "), "%s", f.err);
    cr_expect_str_eq(f.out, "");
    finished_clear(&f);
    place_clear(&p);
}
#endif

Test(limits, every_command_has_the_brake_on_memory)
{
    static const char *const lines[] = {"analyze crane", "verify sleigh --current v", "simulate sleigh --until 100", "benchmark sleigh", "reduce crane", "classify penning_trap --over w", "export sleigh --to c",
                                        "scan sleigh --over k=1:3:5 -o scanned", "scan sleigh --over k=1:3:5 -o shared --workers 2"};
    static const char *const sizes[] = {"5", "5X", "G", "0M", "-3G", "1e30T"};
    place p = place_with_systems();
    char line[300];
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        bool code = !strncmp(lines[i], "export", 6), scan = !strncmp(lines[i], "scan", 4);
        snprintf(line, sizeof line, "%s --max-memory 1M%s", lines[i], code ? "" : " --json -");
        finished f = run_expecting(&p, line, 5);
        cJSON *root = *f.out ? cJSON_Parse(f.out) : NULL;
        cr_expect(scan || (strstr(f.err, "the memory limit") && strstr(f.err, "hint: raise it by --max-memory")), "%s: %s%s", line, f.out, f.err);
        cr_expect(!*f.out || root, "%s: half a result: %.300s", line, f.out);
        if (root) cr_expect(cJSON_GetObjectItem(root, "unfinished") || cJSON_IsTrue(cJSON_GetObjectItem(root, "partial")), "%s: %.300s", line, f.out);
        cJSON_Delete(root);
        finished_clear(&f);
    }
    finished enough = run_expecting(&p, "verify sleigh --current m*v^2/2+m*a^2*k^2*omega^2/2 --max-memory 0.5T", 0);
    finished_clear(&enough);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        snprintf(line, sizeof line, "analyze sleigh --max-memory %s", sizes[i]);
        finished f = run_expecting(&p, line, 2);
        cr_expect(strstr(f.err, "--max-memory needs a size such as 500M or 2G, found `"), "%s: %s", line, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* Before there is a result there is the system, and what was being done. */
Test(limits, an_unfinished_run_says_what_it_knows, PLAIN_ONLY)
{
    static const struct {
        const char *command, *system, *more, *title, *doing;
        int coordinates;
    } cases[] = {{"analyze", "dense_mass", "", "Full mass matrix", "the equations of motion", 10},
                 {"reduce", "robot_12", "", "Arm of twelve revolute joints", "the symmetry group", 12},
                 {"verify", "dense_mass", "--current \"q1'\"", "Full mass matrix", "the equations of motion", 10},
                 {"simulate", "dense_mass", "--initial \"q1'=1\"", "Full mass matrix", "the equations of motion", 10},
                 {"benchmark", "dense_mass", "", "Full mass matrix", "the equations of motion", 10}};
    place p = place_with_nasty();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[300];
        char reached[100];
        double limit = 0.1;
        snprintf(line, sizeof line, "%s nasty/%s.yaml %s --json - --html page.html", cases[i].command, cases[i].system, cases[i].more);
        finished f = run_until_said(&p, line, &limit, NULL);
        snprintf(reached, sizeof reached, "the time limit of %g s was reached", limit);
        cJSON *root = cJSON_Parse(f.out), *unfinished = cJSON_GetObjectItem(root, "unfinished");
        const char *doing = cJSON_GetStringValue(cJSON_GetObjectItem(unfinished, "doing")), *verdict = cJSON_GetStringValue(cJSON_GetObjectItem(root, "verdict"));
        cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(root, "partial")) && cJSON_GetArraySize(cJSON_GetObjectItem(root, "coordinates")) == cases[i].coordinates, "%s: %s", line, f.out);
        cr_expect(doing && !strcmp(doing, cases[i].doing), "%s: %s", line, f.out);
        cr_expect(i ? !verdict : !strcmp(verdict, "UNDECIDED") && !strcmp(cJSON_GetStringValue(cJSON_GetObjectItem(root, "search")), "cut"), "%s: %s", line, f.out);
        char *page = read_here(&p, "page.html");
        cr_expect(page && strstr(page, cases[i].title) && strstr(page, reached), "%s: no page", line);
        free(page);
        unlink_here(&p, "page.html");
        cJSON_Delete(root);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* What would take minutes is refused by count, the same on every machine, before it begins. */
Test(limits, hopeless_work_is_refused)
{
    static const struct {
        const char *line, *words;
        int code;
    } cases[] = {{"reduce nasty/free_particles.yaml", "the symmetries of a kinetic energy in 24 coordinates were not computed: too many unknowns (300)\nhint: give the group by --group \"x1=1; ...\", or allow more unknowns by --option jets=300", 5},
                 {"reduce crane --set m1=1e-6 --set jz1=1e-6 --set m3=1e-6 --set m6=1e-6", "within 4000 steps\nhint: do masses or lengths differ by many orders of magnitude, or does the domain", 5},
                 {"analyze nasty/singular_mass.yaml", "its mass matrix has rank 13 of 14; no inertia in the direction q1' : q2'", 3},
                 {"reduce nasty/singular_mass.yaml", "its mass matrix has rank 13 of 14; no inertia in the direction q1' : q2'", 3},
                 {"analyze nasty/nested_sines.yaml", "with its definitions it is nested deeper than 200 levels", 3},
                 {"reduce nasty/deep_abs.yaml", "with its definitions it is nested deeper than 200 levels", 3}};
    place p = place_with_nasty();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        if (!sweep_tries(i, 1, 3)) continue;
        finished f = run_expecting(&p, cases[i].line, cases[i].code);
        cr_expect(strstr(f.err, cases[i].words), "%s: %s", cases[i].line, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* ---- a signal while the output is written ---- */

/* Standard output is a pipe that nobody empties, so that the program is writing when the signal comes. */
Test(limits, a_signal_ends_the_writing_at_once, PLAIN_ONLY)
{
    place p = place_with_systems();
    char command[900];
    write_here(&p, "page.html", "an older page");
    snprintf(command, sizeof command,
             "mkfifo pipe; exec 3<>pipe\n"
             "'%.200s' simulate sleigh --initial omega=2 --ensemble 500 --until 10 --step 0.01 --html page.html >pipe 2>err & p=$!\n"
             "(sleep 60; kill -KILL $p) >/dev/null 2>&1 & w=$!\n"
             "read -r line <&3\nkill -INT $p\nwait $p; code=$?\nkill $w\nls\nexit $code", p.program);
    finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
    cr_expect_eq(f.code, 130, "exit code %d: %s", f.code, f.err);
    cr_expect_null(strstr(f.out, "page.html."), "a temporary file stayed: %s", f.out);
    char *page = read_here(&p, "page.html"), *err = read_here(&p, "err");
    cr_expect_str_eq(page, "an older page");
    cr_expect_not_null(strstr(err, "interrupted"));
    free(page), free(err);
    finished_clear(&f);
    place_clear(&p);
}

/* A limit that comes while results are written takes nothing away: the reader of the pipe is slower than the limit, and has everything. */
Test(limits, the_limit_lets_results_be_written, PLAIN_ONLY)
{
    place p = place_with_systems();
    char command[700];
    snprintf(command, sizeof command,
             "mkfifo pipe\n'%.200s' simulate sleigh --initial omega=2 --until 10 --step 0.002 --max-seconds 2 --html page.html >pipe & p=$!\n"
             "{ read -r line; sleep 2.2; wc -l; } <pipe\nwait $p", p.program);
    finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
    char *page = read_here(&p, "page.html");
    cr_expect_eq(f.code, 0, "exit code %d: %s", f.code, f.err);
    cr_expect_eq(atoi(f.out), 5001, "%s lines", f.out);
    cr_expect(page && !strstr(page, "time limit"), "%s", page ? "the page says that the limit was reached" : "no page");
    free(page);
    finished_clear(&f);
    place_clear(&p);
}
