/* cli: what the commands print and return, in folders and environments like those of users.  (JSON: test_cli_json.c.) */
#include "program.h"
#include "sweep.h"

static const char FREE[] = "name: free\n"
                           "title: A particle without forces\n"
                           "parameters: [{name: m, value: 2.385}]\n"
                           "coordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                           "lagrangian: m/2*(x'^2 + y'^2)\n";

/* NHSYM_PATH of the project, as an environment. */
static const char *const *project_path(const place *p)
{
    static char entry[PATH_MAX + 20];
    static const char *const list[] = {entry, NULL};
    snprintf(entry, sizeof entry, "NHSYM_PATH=%s", p->project);
    return list;
}

static finished run_with_path(const place *p, const char *line) { return run_so(p, &(manner){.environment = project_path(p)}, line); }

/* The program with `line` prints `out` and `err` exactly and returns `code`; NULL: anything. */
static void check(const place *p, const char *line, int code, const char *out, const char *err)
{
    finished f = run_with_path(p, line);
    cr_expect_eq(f.code, code, "nhsym %s: exit code %d, expected %d\n%s%s", line, f.code, code, f.out, f.err);
    if (out) cr_expect_str_eq(f.out, out, "nhsym %s printed\n%s", line, f.out);
    if (err) cr_expect_str_eq(f.err, err, "nhsym %s complained\n%s", line, f.err);
    finished_clear(&f);
}

static void check_contains(const char *text, const char *part) { cr_expect_not_null(strstr(text, part), "`%s` is not in\n%s", part, text); }

/* ---- usage ---- */

Test(cli, wrong_usage_is_told_with_a_suggestion)
{
    static const struct { const char *line, *err; } list[] = {
        {"analyz sleigh", "nhsym: there is no command `analyz`\nhint: did you mean `nhsym analyze`?\n"},
        {"frobnicate", "nhsym: there is no command `frobnicate`\nhint: `nhsym help` lists the commands\n"},
        {"analyze", "nhsym: `nhsym analyze` needs a system or an analysis file\nhint: nhsym analyze sleigh, or nhsym analyze mine.yaml\n"},
        {"analyze sleigh tops", "nhsym: `nhsym analyze` takes one system, but a second one is given: `tops`\nhint: nhsym analyze sleigh\n"},
        {"export sleigh c", "nhsym: `nhsym export` takes one system, but a second one is given: `c`\nhint: nhsym export sleigh --to c -o code\n"},
        {"verify sleigh m*v", "nhsym: `nhsym verify` takes one system, but a second one is given: `m*v`\nhint: nhsym verify sleigh --current \"m*v\"\n"},
        {"analyze sleigh --json=", "nhsym: --json needs the name of a file\n"},
        {"verify sleigh --current v --json a --html a", "nhsym: --html and --json would write one file, a\nhint: give each a file of its own\n"},
        {"analyze sleigh --seedd 3", "nhsym: there is no option `--seedd`\nhint: did you mean `--seed`?\n"},
        {"analyze sleigh --frob", "nhsym: there is no option `--frob`\nhint: `nhsym help analyze` lists them\n"},
        {"simulate sleigh --sweep k=1:2:3", "nhsym: there is no option `--sweep`\nhint: did you mean `--over`?\n"},
        {"reduce sleigh --sweep k=1:2:3", "nhsym: there is no option `--sweep`\nhint: `--over` belongs to: simulate benchmark classify scan linearize\n"},
        {"analyze sleigh -z", "nhsym: there is no option `-z`\nhint: `nhsym help analyze` lists them\n"},
        {"analyze sleigh --seed", "nhsym: `--seed` needs a value\nhint: write --seed N; `nhsym help analyze` describes the option\n"},
        {"analyze sleigh --set k", "nhsym: --set needs NAME=VALUE, found `k`\n"},
        {"analyze sleigh --set =3", "nhsym: --set needs NAME=VALUE, found `=3`\n"},
        {"analyze sleigh --set k=1/0", "nhsym: --set k needs a number, found `1/0`\n"},
        {"analyze sleigh --set k=two", "nhsym: --set k needs a number, found `two`\n"},
        {"analyze sleigh --set k=", "nhsym: --set k needs a number, found ``\n"},
        {"analyze sleigh --set k=nan", "nhsym: --set k needs a number, found `nan`\n"},
        {"analyze sleigh --set k=1e-999", "nhsym: --set k needs a number, found `1e-999`\n"},
        {"analyze sleigh --set k=0x10", "nhsym: --set k needs a number, found `0x10`\n"},
        {"analyze sleigh --set k=inf", "nhsym: --set k needs a number, found `inf`\n"},
        {"analyze sleigh --set kk=3", "nhsym: `kk` is not a parameter of sleigh\nhint: did you mean `k`?\n"},
        {"analyze sleigh --seed 1.5", "nhsym: the option `seed` needs a whole number, found `1.5`\n"},
        {"analyze sleigh --seed -3", "nhsym: the option `seed` must lie between 0 and 1e+15, found `-3`\n"},
        {"analyze sleigh --seed many", "nhsym: the option `seed` needs a number, found `many`\n"},
        {"analyze sleigh --option sed=3", "nhsym: there is no option `sed`\nhint: did you mean `seed`?\n"},
        {"analyze sleigh --option seed", "nhsym: --option needs NAME=VALUE, found `seed`\n"},
        {"analyze sleigh --velocities quasy", "nhsym: there are no velocities `quasy`\nhint: did you mean `quasi`?\n"},
        {"show", "nhsym: `nhsym show` needs the name of a system\nhint: nhsym show sleigh\n"},
        {"analyze sleigh --htm page.html", "nhsym: there is no option `--htm`\nhint: write the full name: `--html`\n"},
        {"analyze sleigh --qui", "nhsym: there is no option `--qui`\nhint: write the full name: `--quiet`\n"},
        {"analyze sleigh --html=page.html --detail", "nhsym: there is no option `--detail`\nhint: write the full name: `--details`\n"},
        {"analyze sleigh --budget 2s", "nhsym: `nhsym analyze` does not take --budget\nhint: `nhsym help analyze` lists its options; this one belongs to: benchmark (nhsym benchmark sleigh --budget ..)\n"},
        {"reduce sleigh --analysis sleigh", "nhsym: `nhsym reduce` does not take --analysis\nhint: `nhsym help reduce` lists its options; this one belongs to: analyze simulate benchmark (nhsym analyze sleigh --analysis ..)\n"},
        {"--html page.html list", "nhsym: `nhsym list` does not take --html\nhint: `nhsym help list` lists its options; this one belongs to: analyze verify simulate benchmark reduce classify scan linearize show\n"},
        {"analyze sleigh --csv a.csv", "nhsym: `nhsym analyze` does not take --csv\nhint: `nhsym help analyze` lists its options; this one belongs to: benchmark simulate reduce scan linearize (nhsym benchmark sleigh --csv ..)\n"},
        {"simulate sleigh --method rk8pd,adams", "nhsym: --method takes one integrator, found 2\nhint: `nhsym benchmark` compares several\n"},
        {"benchmark sleigh --over a=1:2 --method rk8pd", "nhsym: --method, and --over as well\nhint: maps compare five methods, which are always the same\n"},
        {"simulate sleigh -o a.csv", "nhsym: -o takes a folder, but `a.csv` is the name of a file\nhint: a file is written by --csv a.csv\n"},
        {"analyze pendulum --initial theta=1", "nhsym: `nhsym analyze` does not take --initial\nhint: `nhsym help analyze` lists its options; this one belongs to: simulate benchmark reduce export (nhsym simulate pendulum --initial ..)\n"},
        {"list -o folder", "nhsym: `nhsym list` does not take --output\nhint: `nhsym help list` lists its options; this one belongs to: analyze verify simulate reduce classify benchmark scan linearize export show new\n"},
        {"analyze sleigh --fragment", "nhsym: --fragment needs --tex\nhint: for example: --tex body.tex --fragment\n"},
        {"explain frobnicate", "nhsym: there is no topic `frobnicate`\nhint: `nhsym explain` lists the topics\n"},
        {"explain gapp", "nhsym: there is no topic `gapp`\nhint: did you mean `gap`?\n"},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) check(&p, list[i].line, 2, "", list[i].err);
    place_clear(&p);
}

/* The line by the old names prints what the line by the names of today prints. */
static void check_old(const place *p, const char *old, const char *now)
{
    finished was = run_with_path(p, old), is = run_with_path(p, now);
    cr_expect_eq(was.code, is.code, "nhsym %s: %d, nhsym %s: %d", old, was.code, now, is.code);
    cr_expect(is.out[0] || is.err[0], "nhsym %s says nothing", now);
    cr_expect_str_eq(was.out, is.out);
    cr_expect_str_eq(was.err, is.err);
    finished_clear(&was);
    finished_clear(&is);
}

Test(cli, old_names_are_still_understood, PLAIN_ONLY)
{
    static const struct { const char *old, *now; } list[] = {
        {"help chart", "help benchmark"},
        {"chart --help", "benchmark --help"},
        {"chart", "benchmark"},
        {"chart sleigh --svg no/such/place.svg", "benchmark sleigh --svg no/such/place.svg"},
        {"chart sleigh --stress --budget 2 s", "benchmark sleigh --robustness --budget 2 s"},
        {"reduce sleigh --stress", "reduce sleigh --robustness"},
        {"analyze sleigh --chart quasy", "analyze sleigh --velocities quasy"},
        {"verify sleigh --current x' --chart=coordinates", "verify sleigh --current x' --velocities=coordinates"},
        {"benchmark sleigh --option stress_error=2", "benchmark sleigh --option robustness_error=2"},
        {"benchmark sleigh --option chart_wrong=1e9", "benchmark sleigh --option benchmark_error=1e9"},
        {"benchmark sleigh --option chart_steps=0.5", "benchmark sleigh --option benchmark_steps=0.5"},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) check_old(&p, list[i].old, list[i].now);
    check(&p, "charrt sleigh", 2, "", "nhsym: there is no command `charrt`\nhint: did you mean `nhsym benchmark`?\n");
    check(&p, "help charrt", 2, "", "nhsym: there is no command `charrt`\nhint: did you mean `nhsym help benchmark`?\n");
    check(&p, "benchmark sleigh --stres", 2, "", "nhsym: there is no option `--stres`\nhint: write the full name: `--robustness`\n");
    check(&p, "benchmark sleigh --charts auto", 2, "", "nhsym: there is no option `--charts`\nhint: did you mean `--velocities`?\n");
    place_clear(&p);
}

Test(cli, old_names_are_shown_nowhere)
{
    static const char *const lines[] = {"help", "help man", "help bash", "help zsh", "help fish", "help analyze", "help simulate", "help benchmark", "explain options"};
    static const char *const words[] = {"--chart", "nhsym chart", "-a chart", " chart) ", "(chart", "--stress", "stress_", "chart_", "-l chart", "-l stress", "\\-chart"};
    place p = place_make();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        finished f = run_with_path(&p, lines[i]);
        cr_expect_eq(f.code, 0);
        for (size_t j = 0; j < sizeof words / sizeof *words; j++) cr_expect_null(strstr(f.out, words[j]), "nhsym %s prints `%s`:\n%s", lines[i], words[j], f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(cli, unknown_systems_and_files)
{
    place p = place_make();
    check(&p, "analyze sleig", 3, "", "nhsym: there is no system `sleig` in ./systems, in NHSYM_PATH or among the installed ones\nhint: did you mean `sleigh`?\n");
    check(&p, "show sleig", 3, "", "nhsym: there is no system `sleig` in ./systems, in NHSYM_PATH or among the installed ones\nhint: did you mean `sleigh`?\n");
    check(&p, "analyze xyzzyx", 3, "",
          "nhsym: there is no system `xyzzyx` in ./systems, in NHSYM_PATH or among the installed ones\nhint: give the path of a file, or a name that `nhsym list` shows\n");
    check(&p, "analyze no/such.yaml", 3, "", "nhsym: no/such.yaml: there is no such file\nhint: `nhsym list` lists the available systems; `nhsym new skate` writes an example\n");
    check(&p, "analyze mine.yaml", 3, "", "nhsym: mine.yaml: there is no such file\nhint: `nhsym list` lists the available systems; `nhsym new skate` writes an example\n");
    check(&p, "analyze sleigh --analysis sleig", 3, "",
          "nhsym: there is no analysis `sleig` in ./analyses, in NHSYM_PATH or among the installed ones\nhint: did you mean `sleigh`?\n");
    place_clear(&p);
}

Test(cli, a_bad_file_is_shown_where_it_is_bad)
{
    place p = place_make();
    write_here(&p, "mine.yaml", "name: mine\ncoordinates: [x]\nlagrangian: m*x'^2\n");
    check(&p, "analyze mine.yaml", 3, "",
          "nhsym: mine.yaml:3:13: unknown name `m`\n  lagrangian: m*x'^2\n              ^\nhint: declare it, for instance `parameters: {m: 1}`\n");
    check(&p, "analyze mine.yaml --json -", 3, "", NULL); /* standard output stays clean */
    place_clear(&p);
}

/* ---- exit codes ---- */

Test(cli, no_current_is_a_success)
{
    place p = place_make();
    write_here(&p, "mine.yaml", "name: mine\ncoordinates: [x, y]\nlagrangian: x'^2 + y'^2\nforces:\n  - x = -0.3*x' + y^2*x\n  - y = -0.4*y' - x^3\n");
    write_here(&p, "ask.yaml", "ansatz:\n  - {basis: polynomial, in: [x', y', x, y], degree: 2}\n");
    finished f = run_expecting(&p, "analyze -v mine.yaml --analysis ./ask.yaml", 0);
    check_contains(f.out, "NONE");
    finished_clear(&f);
    place_clear(&p);
}

Test(cli, a_numerical_failure_is_explained)
{
    place p = place_make();
    write_here(&p, "mine.yaml", "name: mine\ncoordinates: [x]\nlagrangian: x'^2 - sqrt(x - 5)\n");
    finished f = run_expecting(&p, "analyze mine.yaml", 4);
    check_contains(f.err, "sample points were usable");
    check_contains(f.err, "domain:");
    finished_clear(&f);
    place_clear(&p);
}

Test(cli, a_limit_is_told)
{
    place p = place_make();
    finished f = run_with_path(&p, "analyze sleigh --columns 3");
    cr_expect_eq(f.code, 5);
    cr_expect_str_eq(f.err, "nhsym: the ansatz has more than 3 columns\nhint: lower a degree or the harmonics, or raise the limit with --columns\n");
    finished_clear(&f);
    place_clear(&p);
}

/* As on a full disk. */
Test(cli, output_that_cannot_be_written_is_told)
{
    place p = place_make();
    FILE *full = fopen("/dev/full", "w");
    cr_assert_not_null(full, "this machine has no /dev/full");
    fclose(full);
    char line[PATH_MAX + 50], *argument[] = {"sh", "-c", line, NULL};
    snprintf(line, sizeof line, "'%s' help >/dev/full", p.program);
    finished f = run_vector(&p, &(manner){0}, argument);
    cr_expect_eq(f.code, 4);
    cr_expect_str_eq(f.err, "nhsym: standard output could not be written\n");
    finished_clear(&f);
    place_clear(&p);
}

/* ---- the small commands ---- */

Test(cli, version_and_help)
{
    static const char *const asking[] = {"help", "--help", "-h", "", "analyze --help"};
    place p = place_make();
    finished version = run_expecting(&p, "version", 0), option = run_expecting(&p, "--version", 0);
    cr_expect_eq(strncmp(version.out, "nhsym ", 6), 0, "%s", version.out);
    cr_expect_str_eq(version.out, option.out);
    for (size_t i = 0; i < sizeof asking / sizeof *asking; i++) {
        finished f = run_expecting(&p, asking[i], 0);
        check_contains(f.out, "nhsym analyze SYSTEM|FILE");
        check_contains(f.out, "--set NAME=VALUE");
        cr_expect_str_eq(f.err, "");
        finished_clear(&f);
    }
    finished_clear(&version);
    finished_clear(&option);
    place_clear(&p);
}

Test(cli, explain_knows_its_own_topics, PLAIN_ONLY)
{
    place p = place_make();
    finished all = run_expecting(&p, "explain", 0);
    char line[200], word[100];
    int topics = 0;
    for (const char *at = all.out; sscanf(at, "%99s", word) == 1; at = strchr(at, '\n') + 1, topics++) {
        snprintf(line, sizeof line, "explain %s", word);
        finished f = run_expecting(&p, line, 0);
        cr_expect_gt(strlen(f.out), (size_t)30, "%s: %s", word, f.out);
        finished_clear(&f);
    }
    cr_expect_gt(topics, 10);
    finished options = run_expecting(&p, "explain options", 0);
    check_contains(options.out, "seed                 1 ");
    finished_clear(&options);
    finished_clear(&all);
    place_clear(&p);
}

Test(cli, words_and_symbols_of_the_answers_are_explained)
{
    static const char *const words[] = {"Gamma", "trivial", "bracket", "reaction", "chart", "ansatz", "momentum", "zeta", "mu", "pencil", "first integral"};
    place p = place_make();
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char line[100];
        snprintf(line, sizeof line, "explain %s", words[i]);
        finished f = run_expecting(&p, line, 0);
        cr_expect_gt(strlen(f.out), 20, "%s", words[i]);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* Words as reports have them, which are no topics: those that say or contain them. */
Test(cli, words_in_definitions_are_found)
{
    static const char *const cases[][2] = {{"growth vector", "growth: The growth vector"}, {"canonical distribution", "distribution: The canonical distribution"},
                                           {"case 1", "case: How Z relates"}, {"search exhausted", "exhausted: "}};
    place p = place_make();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[100];
        snprintf(line, sizeof line, "explain %s", cases[i][0]);
        finished f = run_expecting(&p, line, 0);
        cr_expect(strstr(f.out, cases[i][1]), "%s: %s", cases[i][0], f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* What docs/glossary.md says of each word is what `nhsym explain` says, word by word and in the same order. */
Test(cli, the_glossary_says_what_explain_says)
{
    place p = place_make();
    finished all = run_expecting(&p, "explain", 0);
    FILE *page = fopen("docs/glossary.md", "r");
    char line[1000], *at = all.out;
    bool words = false;
    int rows = 0;
    cr_assert_not_null(page);
    while (fgets(line, sizeof line, page)) {
        if (line[0] != '|') words = false;
        char *meaning = strstr(line, " | "), word[100], said[1000];
        if (words && line[1] == ' ') {
            snprintf(word, sizeof word, "%.*s", (int)(meaning - line - 2), line + 2);
            size_t n = 0;
            for (const char *c = at + strlen(word) + strspn(at + strlen(word), " "); *c && *c != '\n'; c++)
                if (c[0] == '|') said[n++] = '\\', said[n++] = '|';
                else if (c[0] != ' ' || c[1] != ' ') said[n++] = *c;
            said[n] = 0;
            cr_expect_eq(strncmp(at, word, strlen(word)), 0, "explain says %.60s where the page says %s", at, word);
            cr_expect_eq(strncmp(meaning + 3, said, n), 0, "%s: the page says %s, explain %s", word, meaning + 3, said);
            cr_expect_str_eq(meaning + 3 + n, " |\n", "%s", word);
            at = strchr(at, '\n') + 1;
            rows++;
        }
        words = words || !strcmp(line, "| word | meaning |\n");
    }
    fclose(page);
    cr_expect_eq(strncmp(at, "options ", 8), 0, "the page ends before %s", at);
    cr_expect_gt(rows, 60);
    finished_clear(&all);
    finished stages = run_expecting(&p, "explain stage", 0), of = run_expecting(&p, "explain stage of a search", 0);
    check_contains(stages.out, "stage of a reduction: ");
    check_contains(stages.out, of.out);
    finished_clear(&stages);
    finished_clear(&of);
    place_clear(&p);
}

Test(cli, list_and_show)
{
    place p = place_make();
    folder_here(&p, "systems", 0755);
    write_here(&p, "systems/free.yaml", FREE);
    write_here(&p, "systems/broken.yaml", "name: broken\n");
    write_here(&p, "systems/note.txt", "not a system\n");
    finished list = run_with_path(&p, "list"), show = run_expecting(&p, "show free", 0);
    cr_expect_eq(list.code, 0);
    check_contains(list.out, "free                     A particle without forces\n");
    check_contains(list.out, "sleigh                   Chaplygin sleigh\n");
    check_contains(list.out, "broken ");
    cr_expect_null(strstr(list.out, "note"));
    cr_expect_str_eq(show.out, FREE, "a file is shown byte by byte");
    finished_clear(&list);
    finished_clear(&show);
    place_clear(&p);
}

/* ---- where systems are found ---- */

Test(cli, a_system_of_ones_own_in_an_empty_folder, PLAIN_ONLY)
{
    static const char *const lines[] = {"analyze -v mine.yaml", "analyze -v ./mine.yaml", "analyze -v sub/mine.yaml", "analyze -v free"};
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    folder_here(&p, "sub", 0755);
    write_here(&p, "sub/mine.yaml", FREE);
    folder_here(&p, "systems", 0755);
    write_here(&p, "systems/free.yaml", FREE);
    for (size_t i = 0; i < 4; i++) {
        finished f = run_expecting(&p, lines[i], 0);
        check_contains(f.out, "FOUND: 4 independent currents of at most 4");
        check_contains(f.out, "momentum of x");
        cr_expect_str_eq(f.err, "");
        finished_clear(&f);
    }
    place_clear(&p);
}

/* The folder first, then NHSYM_PATH in its order. */
Test(cli, nhsym_path_is_searched_in_order)
{
    static const char *const both[] = {"NHSYM_PATH=first:second", NULL}, *const turned[] = {"NHSYM_PATH=second:::first", NULL}, *const none[] = {"NHSYM_PATH=", NULL};
    place p = place_make();
    folder_here(&p, "first", 0755);
    folder_here(&p, "first/systems", 0755);
    folder_here(&p, "second", 0755);
    write_here(&p, "first/systems/which.yaml", "# first\n");
    write_here(&p, "second/which.yaml", "# second\n");
    finished a = run_so(&p, &(manner){.environment = both}, "show which"), b = run_so(&p, &(manner){.environment = turned}, "show which");
    finished c = run_so(&p, &(manner){.environment = none}, "show which");
    cr_expect_str_eq(a.out, "# first\n");
    cr_expect_str_eq(b.out, "# second\n");
    cr_expect_eq(c.code, 3);
    folder_here(&p, "systems", 0755);
    write_here(&p, "systems/which.yaml", "# here\n");
    finished d = run_so(&p, &(manner){.environment = both}, "show which");
    cr_expect_str_eq(d.out, "# here\n");
    finished_clear(&a);
    finished_clear(&b);
    finished_clear(&c);
    finished_clear(&d);
    place_clear(&p);
}

/* A folder of NHSYM_PATH without subfolders: files of one name, or of both kinds, do not stand in each other's way. */
Test(cli, a_folder_may_hold_systems_and_analyses, PLAIN_ONLY)
{
    static const char *const path[] = {"NHSYM_PATH=mixed:bare", NULL};
    place p = place_make();
    folder_here(&p, "mixed", 0755);
    folder_here(&p, "bare", 0755);
    write_here(&p, "mixed/weight.yaml", "name: weight\ncoordinates: [x]\nlagrangian: x'^2/2 - 9.81*x\n");
    write_here(&p, "mixed/spring.yaml", "name: of the spring\nsystem: spring\nansatz: [{basis: polynomial, in: [x, x'], degree: 2}]\n");
    write_here(&p, "bare/spring.yaml", "name: spring\ntitle: A spring\ncoordinates: [x]\nlagrangian: x'^2/2 - x^2/2\n");
    finished a = run_so(&p, &(manner){.environment = path}, "analyze -v weight"), b = run_so(&p, &(manner){.environment = path}, "analyze -v spring");
    finished c = run_so(&p, &(manner){.environment = path}, "simulate weight --initial x=1 --until 1"), d = run_so(&p, &(manner){.environment = path}, "list");
    cr_expect_eq(a.code, 0);
    check_contains(a.out, "minus the energy");
    cr_expect_eq(b.code, 0);
    check_contains(b.out, "A spring");
    check_contains(b.out, "as given in the analysis file");
    cr_expect_eq(c.code, 0);
    check_contains(d.out, "A spring");
    cr_expect(!strstr(d.out, "unknown key"), "%s", d.out);
    finished_clear(&a);
    finished_clear(&b);
    finished_clear(&c);
    finished_clear(&d);
    place_clear(&p);
}

/* `make install` into a folder; the program is then run there from elsewhere, without any setting. */
Test(cli, the_installed_program_works_from_anywhere, PLAIN_ONLY)
{
    place p = place_make();
    char build[PATH_MAX + 8], destination[2 * PATH_MAX], *slash;
    size_t inside = strlen(p.project); /* as make itself names the folder: it writes this name into the files that tell what depends on what */
    bool relative = !strncmp(p.program, p.project, inside) && p.program[inside] == '/';
    snprintf(build, sizeof build, "BUILD=%s", relative ? p.program + inside + 1 : p.program);
    if ((slash = strrchr(build, '/'))) *slash = 0;
    snprintf(destination, sizeof destination, "DESTDIR=%s/root", p.folder);
    char *argument[] = {"make", "-s", "-C", p.project, "-o", "all", "install", build, destination, "PREFIX=/opt/nh", NULL};
    finished made = run_vector(&p, &(manner){0}, argument);
    cr_assert_eq(made.code, 0, "make install: %s%s", made.out, made.err);
    snprintf(p.program, sizeof p.program, "%.1000s/root/opt/nh/bin/nhsym", p.folder);
    finished list = run_expecting(&p, "list", 0), f = run_expecting(&p, "analyze -v sleigh --set k=3", 0);
    check_contains(list.out, "sleigh ");
    check_contains(f.out, "nu = 1/k");
    check_contains(f.out, "as given in the analysis file");
    finished_clear(&made);
    finished_clear(&list);
    finished_clear(&f);
    place_clear(&p);
}

/* ---- what a run prints ---- */

Test(cli, settings_reach_the_result, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    finished f = run_expecting(&p, "analyze -v mine.yaml --set m=0.125", 0), last = run_expecting(&p, "analyze -v --set m=3 mine.yaml --set m=7.5", 0);
    check_contains(f.out, "A particle without forces   m = 0.125\n");
    check_contains(last.out, "A particle without forces   m = 7.5\n");
    finished_clear(&f);
    finished_clear(&last);
    place_clear(&p);
}

/* An analysis file has an end time of its own, which an option outranks, however the option is written. */
Test(cli, option_outranks_the_analysis_as_the_option_of_that_name_does)
{
    place p = place_with_systems();
    finished named = run_expecting(&p, "simulate sleigh --initial omega=2 --step 1 --tolerance 1e-6 --until 3", 0),
             listed = run_expecting(&p, "simulate sleigh --initial omega=2 --step 1 --option tolerance=1e-6 --option until=3", 0);
    cr_expect_str_eq(listed.out, named.out);
    check_contains(named.out, "\n3,");
    finished_clear(&named);
    finished_clear(&listed);
    place_clear(&p);
}

Test(cli, quiet_prints_nothing)
{
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    finished f = run_expecting(&p, "analyze mine.yaml --quiet", 0), q = run_expecting(&p, "analyze -q mine.yaml", 0);
    cr_expect_str_eq(f.out, "");
    cr_expect_str_eq(f.err, "");
    cr_expect_str_eq(q.out, "");
    finished_clear(&f);
    finished_clear(&q);
    place_clear(&p);
}

static bool coloured(const finished *f) { return strchr(f->out, '\x1b') != NULL; }

Test(cli, colours_only_on_a_terminal_that_wants_them, PLAIN_ONLY)
{
    static const char *const without[] = {"NO_COLOR=1", "TERM=xterm", NULL}, *const with[] = {"TERM=xterm", NULL};
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    finished pipe = run_so(&p, &(manner){.environment = with}, "analyze -v mine.yaml");
    check_contains(pipe.out, "FOUND");
    cr_expect_not(coloured(&pipe));
    finished_clear(&pipe);
    if (!terminals_exist()) { /* a bare chroot without /dev/pts: only the half without a terminal can be tried */
        cr_log_info("there are no pseudo-terminals here: colours on a terminal were not tried");
        place_clear(&p);
        return;
    }
    finished terminal = run_so(&p, &(manner){.terminal = true, .environment = with}, "analyze -v mine.yaml");
    finished no_color = run_so(&p, &(manner){.terminal = true, .environment = without}, "analyze -v mine.yaml");
    finished option = run_so(&p, &(manner){.terminal = true, .environment = with}, "analyze -v mine.yaml --no-color");
    cr_expect(coloured(&terminal), "%s", terminal.out);
    cr_expect_not(coloured(&no_color));
    cr_expect_not(coloured(&option));
    check_contains(no_color.out, "FOUND");
    finished_clear(&terminal);
    finished_clear(&no_color);
    finished_clear(&option);
    place_clear(&p);
}

/* The last line of a summary tells the time it took. */
static void cut_last_line(char *text)
{
    size_t n = strlen(text);
    cr_assert(n > 1 && text[n - 1] == '\n');
    text[n - 1] = 0;
    char *last = strrchr(text, '\n');
    cr_assert(last && strstr(last, " ms"), "%s", text);
    *last = 0;
}

Test(cli, the_same_question_gets_the_same_answer, PLAIN_ONLY)
{
    place p = place_make();
    finished a = run_with_path(&p, "analyze -v sleigh --seed 5"), b = run_with_path(&p, "analyze -v sleigh --seed 5"), c = run_with_path(&p, "analyze -v sleigh --seed 6");
    cut_last_line(a.out);
    cut_last_line(b.out);
    cut_last_line(c.out);
    cr_expect_str_eq(a.out, b.out);
    cr_expect_str_neq(a.out, c.out, "the seed chooses the samples");
    finished_clear(&a);
    finished_clear(&b);
    finished_clear(&c);
    place_clear(&p);
}

Test(cli, an_analysis_file_chooses_system_and_ansatz)
{
    place p = place_make();
    write_here(&p, "mine.yaml", FREE);
    write_here(&p, "ask.yaml", "system: ./mine.yaml\nsearch: no\nset: {m: 4.5}\nansatz:\n  - terms: [\"x'\", \"x'*y\", x]\n");
    finished f = run_expecting(&p, "analyze -v --analysis ./ask.yaml", 0), g = run_expecting(&p, "analyze -v mine.yaml --analysis ./ask.yaml --set m=6.5", 0);
    check_contains(f.out, "A particle without forces   m = 4.5\n");
    check_contains(f.out, "FOUND: 1 independent current");
    check_contains(g.out, "A particle without forces   m = 6.5\n"); /* the command line has the last word */
    finished_clear(&f);
    finished_clear(&g);
    place_clear(&p);
}
