/* How the program behaves at a terminal: help, new files, folders, progress, interruption.  (What it prints: test_cli.c.) */
#include <cjson/cJSON.h>
#include <time.h>

#include "program.h"
#include "sweep.h"

Test(cli_manners, help_fits_a_screen, PLAIN_ONLY)
{
    place p = place_make();
    finished all = run_expecting(&p, "help", 0);
    int lines = 0;
    for (const char *c = all.out; *c; c = strchr(c, '\n') + 1, lines++) cr_expect_leq(strcspn(c, "\n"), 80u, "%.100s", c);
    cr_expect_leq(lines, 24);
    int commands = 0;
    for (const char *c = all.out; (c = strstr(c, "\n  nhsym ")) && commands < 13; c++, commands++) {
        char name[40], line[60];
        cr_assert_eq(sscanf(c + 9, "%39s", name), 1);
        snprintf(line, sizeof line, "help %s", name);
        finished one = run_expecting(&p, line, 0), same;
        snprintf(line, sizeof line, "%s --help", name);
        if (strcmp(name, "help")) {
            same = run_expecting(&p, line, 0);
            cr_expect_str_eq(one.out, same.out, "%s", name);
            finished_clear(&same);
        }
        cr_expect_not_null(strstr(one.out, "Example\n  nhsym "), "%s", one.out);
        /* what an option does for this command, in one line of a wide terminal, and for no other command */
        static const char *const others[] = {"analyze:", "verify:", "simulate:", "benchmark:", "scan:", "export:"};
        for (size_t k = 0; k < sizeof others / sizeof *others; k++)
            cr_expect_null(strstr(one.out, others[k]), "help %s: %s", name, others[k]);
        for (const char *c2 = one.out; *c2; c2 = strchr(c2, '\n') + 1)
            cr_expect_leq(strcspn(c2, "\n"), 140u, "help %s: %.150s", name, c2);
        finished_clear(&one);
    }
    cr_expect_eq(commands, 13);
    finished_clear(&all);
    finished wrong = run_expecting(&p, "help analyse", 2);
    cr_expect_not_null(strstr(wrong.err, "did you mean `nhsym help analyze`?"));
    finished_clear(&wrong);
    place_clear(&p);
}

/* Every option that a help screen names is taken by the command line, and completed. */
Test(cli_manners, completions_know_every_option, PLAIN_ONLY)
{
    place p = place_make();
    static const char *const commands[] = {"analyze", "verify", "simulate", "benchmark", "reduce"}, *const shells[] = {"bash", "zsh", "fish", "man"};
    for (size_t s = 0; s < 4; s++) {
        char line[60];
        snprintf(line, sizeof line, "help %s", shells[s]);
        finished f = run_expecting(&p, line, 0);
        for (size_t i = 0; i < 5; i++) {
            snprintf(line, sizeof line, "help %s", commands[i]);
            finished help = run_expecting(&p, line, 0);
            size_t options = 0;
            for (const char *c = help.out; (c = strstr(c, "--")); options++) {
                char name[60], escaped[130] = "";
                size_t n = strcspn(c, " \n"), k = 0;
                snprintf(name, sizeof name, "%.*s", (int)(n - (s == 2 ? 2 : 0)), c + (s == 2 ? 2 : 0)); /* fish leaves the dashes out */
                for (const char *from = name; *from; from++) {
                    if (s == 3 && *from == '-') escaped[k++] = '\\';
                    escaped[k++] = *from;
                }
                escaped[k] = 0;
                cr_expect_not_null(strstr(f.out, escaped), "%s: %s", shells[s], escaped);
                c += n;
            }
            cr_expect_gt(options, 4u);
            finished_clear(&help);
        }
        if (s == 0) {
            write_here(&p, "complete.sh", f.out);
            char *argument[] = {"sh", "-c", "if command -v bash >/dev/null; then bash -n complete.sh; fi", NULL};
            finished syntax = run_vector(&p, &(manner){0}, argument);
            cr_expect_eq(syntax.code, 0, "%s", syntax.err);
            finished_clear(&syntax);
        }
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(cli_manners, new_writes_a_system_that_works_and_never_over_another, PLAIN_ONLY)
{
    place p = place_make();
    finished f = run_expecting(&p, "new skate", 0);
    cr_expect_not_null(strstr(f.out, "nhsym analyze skate.yaml"));
    finished_clear(&f);
    f = run_expecting(&p, "simulate skate.yaml --until 1 --step 1", 0); /* docs/tutorial.md analyses it */
    cr_expect_not_null(strstr(f.out, "phi"), "%s", f.out);
    finished_clear(&f);
    write_here(&p, "mine.yaml", "my own work\n");
    f = run_expecting(&p, "new mine", 3);
    cr_expect_not_null(strstr(f.err, "mine.yaml"));
    finished_clear(&f);
    char *text = read_here(&p, "mine.yaml");
    cr_expect_str_eq(text, "my own work\n");
    free(text);
    f = run_expecting(&p, "new ../escape", 2);
    finished_clear(&f);
    f = run_expecting(&p, "new", 2);
    finished_clear(&f);
    place_clear(&p);
}

Test(cli_manners, a_folder_takes_all_outputs, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "analyze -v sleigh -o out --no-color", 0);
    char *summary = read_here(&p, "out/summary.txt"), *page = read_here(&p, "out/report.html"), *json = read_here(&p, "out/result.json"), *tex = read_here(&p, "out/report.tex"),
         *figure = read_here(&p, "out/figure1.svg");
    cr_assert(summary && page && json && tex && figure);
    cr_expect_str_eq(summary, f.out);
    cr_expect(!strncmp(figure, "<svg xmlns=", 11) && strstr(page, figure), "a figure of the page");
    cJSON *root = cJSON_Parse(json);
    cr_expect_not_null(root);
    cr_expect_str_eq(cJSON_GetStringValue(cJSON_GetObjectItem(cJSON_GetObjectItem(root, "run"), "command")), "nhsym analyze -v sleigh -o out --no-color");
    cJSON_Delete(root);
    int depth = 0, begin = 0, end = 0; /* LaTeX: groups and environments are closed */
    for (const char *c = tex; *c; c++) {
        if (*c == '\\' && c[1]) {
            begin += !strncmp(c, "\\begin{", 7);
            end += !strncmp(c, "\\end{", 5);
            c++;
            continue;
        }
        depth += (*c == '{') - (*c == '}');
        cr_assert_geq(depth, 0);
    }
    cr_expect(depth == 0 && begin == end && begin > 10, "%d open groups, %d environments, %d closed", depth, begin, end);
    cr_expect_not_null(strstr(tex, "\\dot{y}"));
    free(summary), free(page), free(json), free(tex), free(figure);
    finished_clear(&f);
    f = run_expecting(&p, "analyze -v sleigh -o nowhere/out", 4);
    finished_clear(&f);
    place_clear(&p);
}

/* Every command whose result has a document; a motion is a table there, the others have a summary, with
 * all details. */
Test(cli_manners, every_result_has_a_folder)
{
    static const struct {
        const char *arguments, *words;
        int code;
    } of[] = {{"verify sleigh --current m*v", "summary.txt", 1},
              {"reduce sleigh", "summary.txt", 0},
              {"simulate sleigh --until 1", "motion.csv", 0},
              {"simulate sleigh --ensemble 3 --until 1", "motion.csv", 0},
              {"benchmark sleigh --budget 10ms", "summary.txt", 0}};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        char line[200], name[40];
        snprintf(line, sizeof line, "%s -o out%zu", of[i].arguments, i);
        finished f = run_expecting(&p, line, of[i].code);
        const char *const files[] = {of[i].words, "result.json", "report.html", "report.tex"};
        for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
            snprintf(name, sizeof name, "out%zu/%s", i, files[k]);
            char *text = read_here(&p, name);
            cr_expect(text && *text, "%s: %s", line, name);
            free(text);
        }
        finished_clear(&f);
    }
    finished f = run_expecting(&p, "simulate sleigh --over k=1:2:3 -o table", 2);
    cr_expect(strstr(f.err, "--over, and --output as well"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

Test(cli_manners, progress_goes_to_standard_error_when_asked, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "analyze free_particle --progress always --json -", 0), silent = run_expecting(&p, "analyze free_particle --json -", 0);
    cr_expect(strstr(f.err, " s left: ") || strstr(f.err, " min left: "), "%s", f.err);
    cr_expect_str_empty(silent.err, "no terminal: no progress");
    cJSON *root = cJSON_Parse(f.out);
    cr_expect_not_null(root);
    cJSON_Delete(root);
    finished_clear(&f);
    finished_clear(&silent);
    f = run_expecting(&p, "analyze free_particle --progress sometimes", 2);
    finished_clear(&f);
    place_clear(&p);
}

/* The signal comes once the search says what it is doing; what was found is written and marked. */
static void interrupt(int number)
{
    place p = place_with_systems();
    char command[600];
    snprintf(command, sizeof command,
             "'%.200s' analyze crane --no-analysis --max-seconds 600 --progress always --json i.json >out 2>err & p=$!\n"
             "until grep -q '%%' err || ! kill -0 $p; do sleep 0.02; done\nkill -%d $p\nwait $p", p.program, number);
    char *argument[] = {"sh", "-c", command, NULL};
    finished f = run_vector(&p, &(manner){0}, argument);
    cr_expect_eq(f.code, 130, "exit code %d: %s", f.code, f.err);
    char *json = read_here(&p, "i.json");
    cJSON *root = json ? cJSON_Parse(json) : NULL;
    cr_assert_not_null(root);
    cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(root, "partial")));
    bool told = false, bare = false;
    for (const cJSON *w = cJSON_GetObjectItem(root, "warnings")->child; w; w = w->next) {
        told |= strstr(w->valuestring, "interrupted") != NULL;
        bare |= strstr(w->valuestring, "without the symmetries") != NULL;
    }
    cr_expect(told);
    const cJSON *first = cJSON_GetArrayItem(cJSON_GetObjectItem(root, "currents"), 0);
    cr_expect_eq(bare, first && cJSON_IsNull(cJSON_GetObjectItem(first, "symmetry")));
    cJSON_Delete(root);
    free(json);
    finished_clear(&f);
    place_clear(&p);
}

/* ^C once the program says that it has begun (`sign` on standard error): exit code 130, and what there is. */
static char *interrupted_output(const char *line, const char *sign)
{
    place p = place_with_systems();
    char command[900];
    snprintf(command, sizeof command,
             "'%.200s' %.400s --progress always >out 2>err & p=$!\n"
             "until grep -q '%.40s' err || ! kill -0 $p; do sleep 0.02; done\nkill -INT $p\nwait $p", p.program, line, sign);
    char *argument[] = {"sh", "-c", command, NULL};
    finished f = run_vector(&p, &(manner){0}, argument);
    cr_expect_eq(f.code, 130, "%s: exit code %d: %s", line, f.code, f.err);
    finished_clear(&f);
    char *out = read_here(&p, "out"), *err = read_here(&p, "err");
    cr_expect(strstr(err, "interrupted") || strstr(out, "interrupted"), "%s: %s", line, err);
    free(err);
    place_clear(&p);
    return out;
}

Test(cli_manners, an_interrupted_motion_is_printed_as_far_as_it_came)
{
    char *out = interrupted_output("simulate double_pendulum --initial p=1 --until 1e6 --step 1 --option steps=1e9", "a motion");
    size_t rows = 0;
    for (const char *c = out; (c = strchr(c, '\n')); c++) rows++;
    cr_expect_gt(rows, 2u, "%s", out);
    cr_expect_null(strstr(out, "nan"));
    free(out);
}

/* While the method is still being chosen: the motion that came farthest is there, and it is said that its error is not known. */
Test(cli_manners, an_interrupted_search_for_accuracy_keeps_a_motion)
{
    static const char *const delays[] = {"0.1", "0.6"};
    for (size_t i = 0; i < 2; i++) {
        place p = place_with_systems();
        char command[PATH_MAX + 500];
        snprintf(command, sizeof command,
                 "'%s' simulate double_pendulum --initial p=1 --until 1e6 --step 1 --accuracy 1e-9 --option steps=1e9 --progress always >out 2>err & p=$!\n"
                 "until grep -q 'a motion' err || ! kill -0 $p; do sleep 0.02; done\nsleep %s\nkill -INT $p\nwait $p", p.program, delays[i]);
        finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", command, NULL});
        char *out = read_here(&p, "out"), *err = read_here(&p, "err");
        size_t rows = 0;
        for (const char *c = out; (c = strchr(c, '\n')); c++) rows++;
        cr_expect_eq(f.code, 130, "exit code %d: %s", f.code, err);
        cr_expect_gt(rows, 4u, "%zu rows", rows);
        cr_expect(strstr(err, "interrupted before the accuracy 1.0e-09 was reached") && strstr(err, "with unknown error"), "%s", err);
        free(out), free(err);
        finished_clear(&f);
        place_clear(&p);
    }
}

Test(cli_manners, an_interrupted_comparison_says_what_was_measured, PLAIN_ONLY)
{
    char *out = interrupted_output("benchmark sleigh --budget 300s", "CVODE");
    cr_expect_not_null(strstr(out, "Chaplygin sleigh"), "%s", out);
    free(out);
}

Test(cli_manners, an_interrupted_reduction_keeps_the_group)
{
    char *out = interrupted_output("reduce crane --json -", "reduced equations");
    cJSON *root = cJSON_Parse(out);
    cr_assert_not_null(root, "%s", out);
    cr_expect_not_null(strstr(out, "interrupted: the results are partial"));
    cJSON_Delete(root);
    free(out);
}

Test(cli_manners, sigterm_ends_with_what_there_is) { interrupt(SIGTERM); }
Test(cli_manners, sigint_ends_with_what_there_is, PLAIN_ONLY)
{
    interrupt(SIGINT);
}

/* A motion too: what was computed is printed, and a compiler that still runs is ended with all that it left. */
Test(cli_manners, an_interrupted_motion_leaves_nothing_behind)
{
    place p = place_with_systems();
    char command[900];
    snprintf(command, sizeof command,
             "mkdir tmp && printf '#!/bin/sh\\nsleep 100 & echo $! >child; wait\\n' >slow && chmod +x slow\n"
             "NHSYM_CC=$PWD/slow TMPDIR=$PWD/tmp '%.200s' simulate contact_oscillator --initial \"x=1, y'=0.5\" --until 1e6 --step 50 --option steps=1e9 --option compile=1e-9 >out 2>err & p=$!\n"
             "for i in $(seq 500); do [ -s child ] && break; sleep 0.02; done\nsleep 0.3\nkill -INT $p\nwait $p || code=$?\n"
             "[ -z \"$(ls tmp)\" ] || exit 90\n[ \"$(wc -l <out)\" -gt 2 ] || exit 91\ngrep -q interrupted err || exit 92\n"
             "ended() { ! kill -0 $(cat child) 2>/dev/null || [ \"$(sed -n 's/^State:[^A-Z]*\\(.\\).*/\\1/p' /proc/$(cat child)/status 2>/dev/null)\" = Z ]; }\n"
             "for i in $(seq 500); do ended && break; sleep 0.02; done\nended || exit 93\nexit $code", p.program); /* on a busy machine a process that was killed ends when it has its turn */
    char *argument[] = {"sh", "-c", command, NULL};
    finished f = run_vector(&p, &(manner){0}, argument);
    cr_expect_eq(f.code, 130, "exit code %d: %s", f.code, f.err);
    finished_clear(&f);
    place_clear(&p);
}

/* The tables of many motions take long to be written: this is said, and a second
   signal ends the run without them and without a part of a file; a signal that comes several times at once, as `timeout` sends it, is one. */
Test(cli_manners, an_interrupted_ensemble_says_that_it_is_written)
{
    static const char *const delays[] = {"0.5", "2", "8"};
    place p = place_with_systems();
    int code = 93;
    for (size_t i = 0; i < sizeof delays / sizeof *delays && code == 93; i++) { /* 93: the tables were written before the second signal came */
        char command[800];
        snprintf(command, sizeof command,
                 "rm -f err; '%.200s' simulate sleigh --ensemble 20000 --until 2000 --step 20 --quiet --progress always --json e.json >out 2>err & p=$!\n"
                 "until [ -s err ] || ! kill -0 $p; do sleep 0.02; done\nsleep %s\nfor i in 1 2 3; do kill -INT $p; sleep 0.01; done\n"
                 "until grep -q 'writing the results so far' err || ! kill -0 $p; do sleep 0.02; done\nkill -INT $p || exit 93\n"
                 "for i in $(seq 100); do kill -0 $p || break; sleep 0.02; done\n! kill -0 $p || { kill -9 $p; exit 94; }\n"
                 "[ -z \"$(ls *.json .e* 2>/dev/null)\" ] || exit 95\ngrep -q 'were not written completely' err || exit 96\nwait $p", p.program, delays[i]);
        char *argument[] = {"sh", "-c", command, NULL};
        finished f = run_vector(&p, &(manner){0}, argument);
        code = f.code;
        cr_expect(code == 130 || code == 93, "exit code %d: %s", f.code, f.err);
        finished_clear(&f);
        unlink_here(&p, "e.json");
    }
    cr_expect_eq(code, 130, "exit code %d", code);
    place_clear(&p);
}

/* ---- plots in the terminal ---- */

/* Bars (U+2581 to U+2588) from `text` to the end of the line: their heights 1 to 8. */
static size_t read_bars(const char *text, int *height, size_t most)
{
    size_t n = 0;
    for (const char *c = text; *c && *c != '\n' && n < most; c++)
        if (!strncmp(c, "\xe2\x96", 2)) height[n++] = (unsigned char)c[2] - 0x80;
    return n;
}

Test(cli_manners, the_spectrum_is_drawn, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "analyze -v sleigh", 0);
    int height[200];
    const char *line = strstr(f.out, "fit of currents: "), *bars = line ? line : "";
    cr_assert_eq(read_bars(bars, height, 200), 17u, "one bar for every independent column: %.200s", bars);
    for (size_t i = 0; i < 17; i++) cr_expect(i < 4 ? height[i] <= 2 : height[i] >= 7, "bar %zu is %d high", i, height[i]);
    finished_clear(&f);
    f = run_expecting(&p, "analyze -v sleigh --quiet", 0);
    cr_expect_str_empty(f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* A shipped system to begin with: by its own name, or by another one and --like; the copy is analysed as the original is. */
Test(cli_manners, new_copies_a_shipped_system, PLAIN_ONLY)
{
    static const struct { const char *line, *file, *like; } list[] = {
        {"new pendulum", "pendulum", "pendulum"},
        {"new mine --like whipple_bicycle", "mine", "whipple_bicycle"},
        {"new --like sleigh -o other.yaml", "other", "sleigh"},
        {"new train --like car_trailers_3", "train", "car_trailers_3"}, /* includes another file */
    };
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        char line[300];
        finished f = run_expecting(&p, list[i].line, 0);
        cr_expect(strstr(f.out, list[i].like), "%s", f.out);
        finished_clear(&f);
        snprintf(line, sizeof line, "export %s.yaml --to json --of equations", list[i].file);
        finished copy = run_expecting(&p, line, 0);
        snprintf(line, sizeof line, "export %s --to json --of equations", list[i].like);
        finished own = run_expecting(&p, line, 0);
        char *a = strstr(copy.out, "\"coordinates\""), *b = strstr(own.out, "\"coordinates\"");
        cr_assert(a && b && strstr(a, "\"command\"") && strstr(b, "\"command\""), "%s", list[i].line);
        *strstr(a, "\"command\"") = *strstr(b, "\"command\"") = 0; /* how the run is repeated */
        cr_expect_str_eq(a, b, "%s", list[i].line);
        finished_clear(&copy);
        finished_clear(&own);
    }
    finished f = run_expecting(&p, "new bicycle", 0);
    cr_expect(strstr(f.out, "by --like: whipple_bicycle"), "%s", f.out);
    finished_clear(&f);
    f = run_expecting(&p, "new one --like nosuch", 3);
    cr_expect_null(read_here(&p, "one.yaml"));
    finished_clear(&f);
    place_clear(&p);
}

Test(cli_manners, list_finds_words, PLAIN_ONLY)
{
    static const char *const list[][2] = {{"list pendulum", "\npendulum "}, {"list Landau", "(source: Landau and Lifshitz"}, {"list CHAPLYGIN", "sleigh "},
                                          {"list affine", "cart_on_disc "}, {"list chaotic", "double_pendulum "}};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        finished f = run_expecting(&p, list[i][0], 0);
        cr_expect(strstr(f.out, list[i][1]) && !strstr(f.out, "oscillator_1_2"), "%s", f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* ---- slips of the hand ---- */

Test(cli_manners, a_slip_of_the_hand_is_named, PLAIN_ONLY)
{
    static const struct { const char *line, *err; } list[] = {
        {"analyze sleigh -o", "nhsym: `-o` needs a value\nhint: write -o DIR; `nhsym help analyze` describes the option\n"},
        {"analyze sleigh --html --quiet", "nhsym: `--html` needs a value\nhint: write --html FILE; `nhsym help analyze` describes the option\n"},
        {"analyze sleigh -quiet", "nhsym: there is no option `-quiet`\nhint: did you mean `--quiet`?\n"},
        {"analyze sleigh -html=page.html", "nhsym: there is no option `-html`\nhint: did you mean `--html`?\n"},
        {"analyze sleigh \xe2\x80\x94html page.html", "nhsym: there is no option `\xe2\x80\x94html`\nhint: did you mean `--html`?\n"},
        {"--frob", "nhsym: there is no option `--frob`\nhint: `nhsym help` lists them\n"},
        {"sleigh", "nhsym: there is no command `sleigh`\nhint: the command stands first, as in `nhsym analyze sleigh`\n"},
        {"list pendlum", "nhsym: no system has `pendlum` in its name, title, source, remarks or kind of constraints\nhint: did you mean `nhsym list pendulum`?\n"},
        {"explain canonnical distributoin", "nhsym: there is no topic `canonnical distributoin`\nhint: did you mean `distribution`?\n"},
        {"simulate sleigh --svg a.pdf", "nhsym: --svg does not write files of this kind: `a.pdf`\nhint: did you mean --pdf a.pdf?\n"},
        {"analyze sleigh --html a.json", "nhsym: --html does not write files of this kind: `a.json`\nhint: did you mean --json a.json?\n"},
        {"simulate sleigh --svg a.PNG", "nhsym: --svg does not write files of this kind: `a.PNG`\nhint: pictures are .svg or .pdf\n"},
        {"analyze sleigh --set k:3", "nhsym: --set needs NAME=VALUE, found `k:3`\nhint: --set \"k=3\"\n"},
        {"export sleigh --to C++", "nhsym: --to: there is no language `C++`\nhint: did you mean `c`?\n"},
        {"simulate sleigh --png a.png", "nhsym: there is no option `--png`\nhint: did you mean `--svg`?\n"},
        {"analyze sleigh --png a.png", "nhsym: there is no option `--png`\nhint: did you mean `--output`?\n"},
        {"export sleigh --language pyton", "nhsym: there is no option `--language`\nhint: did you mean `--to`?\n"},
        {"simulate sleigh --format svg", "nhsym: there is no option `--format`\nhint: did you mean `--svg`?\n"},
        {"export sleigh --to tex", "nhsym: --to: there is no language `tex`\nhint: did you mean `latex`?\n"},
        {"simulate sleigh --method ida", "nhsym: there is no method `ida`\nhint: the nearest one here is `bdf`: backward differentiation, for stiff equations; `nhsym explain methods` lists them\n"},
        {"simulate sleigh --method cvdoe", "nhsym: there is no method `cvdoe`\nhint: did you mean `bdf`? `nhsym explain methods` lists them\n"},
        {"simulate sleigh --velocities quas", "nhsym: there are no velocities `quas`\nhint: did you mean `quasi`?\n"},
        {"verify sleigh --field x=1 --of equation", "nhsym: --of does not know `equation`\nhint: did you mean `equations`?\n"},
        {"analyze sleigh --progress alway", "nhsym: --progress does not know `alway`\nhint: did you mean `always`?\n"},
        {"new mine.yaml", "nhsym: `mine.yaml` is not a name: a name is a letter, then letters, digits and _\nhint: `nhsym new mine` writes mine.yaml\n"},
        {"version 3", "nhsym: `nhsym version` takes no name, found `3`\nhint: `nhsym version`, or --version\n"},
        {"reduce sleigh --to cvs", "nhsym: --to: there is no language `cvs`\nhint: did you mean `csv`?\n"},
        {"reduce sleigh --to pyton", "nhsym: --to: there is no language `pyton`\nhint: did you mean `python`?\n"},
        {"reduce sleigh --to word", "nhsym: --to: there is no language `word`\nhint: --to takes c, python, sympy, matlab, latex or json, and csv for the motions\n"},
        {"simulate sleigh --set friction=2", "nhsym: `friction` is not a parameter of sleigh\nhint: its parameters are m, a, k\n"},
        {"scan sleigh --over friction=1:2:3 -o scan", "nhsym: `friction` is not a parameter of sleigh\nhint: its parameters are m, a, k\n"},
        {"classify sleigh --over friction", "nhsym: `friction` is not a parameter of sleigh\nhint: its parameters are m, a, k\n"},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        finished f = run_expecting(&p, list[i].line, 2);
        cr_expect_str_eq(f.out, "");
        cr_expect_str_eq(f.err, list[i].err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* An error in what is given, with this hint. */
static void check_hint(const place *p, const char *line, int code, const char *hint)
{
    finished f = run_expecting(p, line, code);
    cr_expect(strstr(f.err, hint), "nhsym %s: `%s` is not in\n%s", line, hint, f.err);
    finished_clear(&f);
}

Test(cli_manners, a_file_of_another_name_is_found)
{
    place p = place_make();
    check_hint(&p, "analyze sleigh.yaml", 3, "\nhint: nhsym has a file of this name: write `sleigh`\n");
    write_here(&p, "bike.yaml", "name: bike\ncoordinates: [x]\nlagrangian: x'^2\n");
    write_here(&p, "bike.txt", "name: bike\n");
    check_hint(&p, "analyze bkie.yaml", 3, "\nhint: did you mean `bike.yaml`?\n");
    check_hint(&p, "analyze ./bike.yml", 3, "\nhint: did you mean `./bike.yaml`?\n");
    check_hint(&p, "analyze bike.yml", 3, "\nhint: did you mean `bike.yaml`?\n");
    check_hint(&p, "analyze bike.yam", 3, "\nhint: did you mean the file `bike.yaml`?\n");
    check_hint(&p, "analyze bike.txt", 3, "\nhint: there is a file of this name here: write ./bike.txt\n");
    place_clear(&p);
}

Test(cli_manners, initial_values_as_newcomers_write_them)
{
    place p = place_make();
    check_hint(&p, "simulate sleigh --initial phi=1,5", 2, "\nhint: use a decimal point: phi=1.5\n");
    check_hint(&p, "simulate sleigh --initial phi=1,dotx=2", 2, "\nhint: the velocity of `x` is written x'\n");
    check_hint(&p, "simulate sleigh --initial phi=1=2", 2, "\nhint: commas separate the values: phi=0, omega=2\n");
    check_hint(&p, "simulate sleigh --initial phi=0,omga=2", 2, "nhsym: --initial:7: `omga` is not a coordinate or velocity of sleigh\n  phi=0,omga=2\n        ^\nhint: did you mean `omega`?\n");
    check_hint(&p, "simulate sleigh --initial phi", 2, "nhsym: --initial:1: `phi` has no value\n  phi\n  ^\nhint: write NAME=VALUE, with commas between: x=0, y=1\n");
    check_hint(&p, "simulate sleigh --initial =3", 2, "nhsym: --initial:1: a name is missing before `=`\n");
    check_hint(&p, "simulate sleigh --initial phi=0,phi=1", 2, "nhsym: --initial:7: `phi` is given twice\n");
    check_hint(&p, "reduce vertical_disk --initial psii=1", 2, "nhsym: --initial:1: `psii` is not");
    check_hint(&p, "simulate sleigh --over omgea=1:2:3", 2, "nhsym: --over: `omgea` is not a coordinate, velocity or parameter of sleigh\nhint: did you mean `omega`?\n");
    place_clear(&p);
}

/* Velocities as other programs and books write them, where a name stands and where an expression does. */
Test(cli_manners, velocities_as_others_write_them, PLAIN_ONLY)
{
    static const char *const words[][2] = {{"v2", "x2"},   {"vx2", "x2"},    {"v_x2", "x2"},     {"xdot2", "x2"},
                                           {"dx2", "x2"},  {"dotx2", "x2"},  {"dx2_dt", "x2"},   {"vy", "y"},     {"yd", "y"}};
    place p = place_make();
    write_here(&p, "two.yaml", "name: two\ncoordinates: [x1, x2, y]\nlagrangian: (x1'^2 + x2'^2 + y'^2)/2\n");
    write_here(&p, "v.yaml", "name: v\nparameters: {v1: 1}\ncoordinates: [x1, x2, y]\nlagrangian: (x1'^2 + x2'^2 + v1*y'^2)/2\n");
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char line[100], hint[100];
        snprintf(hint, sizeof hint, "\nhint: the velocity of `%s` is written %s'\n", words[i][1], words[i][1]);
        snprintf(line, sizeof line, "simulate two.yaml --initial %s=1", words[i][0]);
        check_hint(&p, line, 2, hint);
        snprintf(line, sizeof line, "verify two.yaml --current 2*%s", words[i][0]);
        check_hint(&p, line, 2, hint);
    }
    check_hint(&p, "simulate two.yaml --over v2=1:2:3", 2, "\nhint: the velocity of `x2` is written x2'\n");
    check_hint(&p, "simulate two.yaml --initial x3=1", 2, "\nhint: did you mean `x1`?\n");
    check_hint(&p, "simulate two.yaml --initial speed=1", 2, "\nhint: it has t, x1, x1', x2, x2', y, y'\n");
    check_hint(&p, "verify v.yaml --current 2*v2", 2, "\nhint: did you mean `v1`?\n");
    place_clear(&p);
}

/* Commas for the decimal point, and units behind numbers. */
Test(cli_manners, numbers_as_others_write_them)
{
    place p = place_make();
    write_here(&p, "comma.yaml", "name: c\nparameters:\n  m: 0,5\ncoordinates: [x]\nlagrangian: m*x'^2/2\n");
    check_hint(&p, "simulate sleigh --until 1,5", 2, "\nhint: use a decimal point: 1.5\n");
    check_hint(&p, "simulate sleigh --until 5s", 2, "\nhint: numbers stand here without units: 5\n");
    check_hint(&p, "simulate sleigh --set m=2.5kg", 2, "\nhint: numbers stand here without units: 2.5\n");
    check_hint(&p, "simulate sleigh --set m=0,5", 2, "\nhint: use a decimal point: --set m=0.5\n");
    check_hint(&p, "simulate comma.yaml", 3, "\nhint: use a decimal point: 0.5\n");
    place_clear(&p);
}

/* A table is what `simulate` and `reduce --to` are called for: --quiet leaves the remarks out, and the table where a file holds the result. */
Test(cli_manners, quiet_keeps_a_table_that_nothing_else_holds)
{
    static const struct { const char *loud, *quiet; } list[] = {
        {"simulate sleigh --no-analysis --until 1 --step 1", "simulate sleigh --no-analysis --until 1 --step 1 --quiet"},
        {"simulate sleigh --initial omega=2 --until 1 --step 1 --over k=2,3", "simulate sleigh -q --initial omega=2 --until 1 --step 1 --over k=2,3"},
        {"reduce vertical_disk --to csv", "reduce vertical_disk --to csv --quiet"},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        finished loud = run_expecting(&p, list[i].loud, 0), quiet = run_expecting(&p, list[i].quiet, 0);
        cr_expect(quiet.out[0]);
        cr_expect_str_eq(quiet.out, loud.out);
        cr_expect_str_empty(quiet.err);
        if (i == 0) cr_expect(strstr(loud.err, "no initial state is given"), "%s", loud.err);
        finished_clear(&loud);
        finished_clear(&quiet);
    }
    finished f = run_expecting(&p, "simulate sleigh --until 1 --step 1 --quiet --html motion.html", 0);
    cr_expect_str_empty(f.out);
    cr_expect_str_empty(f.err);
    finished_clear(&f);
    place_clear(&p);
}

/* A definition of the analysis file stands once, in the part of the first current that needs it: a before b1 before c of the lattice, R of the sleigh. */
Test(cli_manners, definitions_stand_where_they_are_needed)
{
    place p = place_make();
    finished f = run_expecting(&p, "analyze -v sleigh", 0);
    const char *current = strstr(f.out, "\n  Phi3 = "), *definition = current ? strstr(current, "\n  R = ") : NULL;
    const char *next = current ? strstr(current, "Certified") : NULL;
    cr_assert(current && definition && next, "%s", f.out);
    cr_expect_lt(definition, next);
    cr_expect_null(strstr(definition + 1, "\n  R = "));
    cr_expect_eq(definition, strstr(f.out, "\n  R = "));
    finished_clear(&f);
    f = run_expecting(&p, "analyze -v toda_lattice", 0);
    for (const char *const *name = (const char *const[]){"\n  a = ", "\n  b1 = ", "\n  c = ", NULL}; *name; name++) {
        const char *once = strstr(f.out, *name);
        cr_expect(once && !strstr(once + 1, *name), "%s", *name);
    }
    finished_clear(&f);
    place_clear(&p);
}

/* Coordinates as a map, or as a list of pairs, are those of the list; a unit in the place of a type is explained; a map completes an included list. */
Test(cli_manners, coordinates_as_a_map)
{
    place p = place_make();
    write_here(&p, "map.yaml", "name: m\ncoordinates: {x: length, phi: {type: angle, doc: heading}}\nlagrangian: (x'^2 + phi'^2)/2\n");
    write_here(&p, "more.yaml", "include: map.yaml\nname: more\ncoordinates: {z: length}\nlagrangian: (x'^2 + phi'^2 + z'^2)/2\n");
    write_here(&p, "pairs.yaml", "name: m\nparameters: [a: 2, b: 3]\ncoordinates: [x: length, phi: {type: angle}, y]\n"
                                 "lagrangian: (a*x'^2 + b*phi'^2 + y'^2)/2\n");
    write_here(&p, "unit.yaml", "name: m\ncoordinates: {x: m}\nlagrangian: x'^2/2\n");
    finished f = run_expecting(&p, "simulate map.yaml --initial x'=1,phi=2 --until 1 --step 1", 0);
    cr_expect(strstr(f.out, "t,x,phi,x_dot,phi_dot,E\n0,0,2,1,0,0.5\n"), "%s", f.out);
    finished_clear(&f);
    f = run_expecting(&p, "show --of coordinates more.yaml", 0);
    cr_expect_str_eq(f.out, "x\nphi\nz\n");
    finished_clear(&f);
    f = run_expecting(&p, "simulate pairs.yaml --initial x'=1,phi'=2 --until 1 --step 1", 0);
    cr_expect(strstr(f.out, "t,x,phi,y,x_dot,phi_dot,y_dot,E\n0,0,0,0,1,2,0,7\n"), "%s", f.out);
    finished_clear(&f);
    check_hint(&p, "analyze unit.yaml", 3, "\nhint: a unit stands beside it: {type: length, unit: m}\n");
    place_clear(&p);
}

/* What must never happen is made to: no angle is 0 to the last bit. */
Test(cli_manners, a_search_that_disagrees_with_the_count_is_an_error)
{
    place p = place_make();
    write_here(&p, "a.yaml", "name: a\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2\n");
    write_here(&p, "b.yaml", "name: b\nsystem: a.yaml\nansatz:\n  - {basis: polynomial, in: [x, y, x', y'], degree: 2}\n");
    finished f = run(&p, "analyze -v a.yaml --analysis b.yaml");
    cr_expect_eq(f.code, 0, "%s", f.err);
    finished_clear(&f);
    f = run(&p, "analyze -v a.yaml --analysis b.yaml --option agreement=1e-30");
    cr_expect(f.code == 4 && strstr(f.err, "the sampled problem and the count disagree") && strstr(f.out, "FOUND"), "%d %s", f.code, f.err);
    finished_clear(&f);
    f = run(&p, "analyze -v b.yaml");
    cr_expect(f.code == 3 && strstr(f.err, "--analysis"), "%d %s", f.code, f.err);
    finished_clear(&f);
    place_clear(&p);
}
