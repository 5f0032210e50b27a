/* Scans: special values that a file does not tell are found, recognised and confirmed; the result does not depend on workers, parts, order, kills or full disks. */
#include <criterion/criterion.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <time.h>

#include "commands/scan_internal.h"
#include "program.h"
#include "sweep.h"

static const char sine[] = "name: sine\nparameters: {k: 0.2, b: 1}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + b*y^2)/2 - x^2*y - 2/3*sin(k)*y^3\n";

static cJSON *json_here(const place *p, const char *name)
{
    char *text = read_here(p, name);
    cr_assert_not_null(text, "%s", name);
    cJSON *root = cJSON_Parse(text);
    cr_assert_not_null(root, "%s", text);
    free(text);
    return root;
}

static const char *text_of(const cJSON *at, const char *key)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItem(at, key));
    return text ? text : "";
}

static double number_of(const cJSON *at, const char *key)
{
    const cJSON *item = cJSON_GetObjectItem(at, key);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* The confirmed special value of this parameter with that exact text. */
static const cJSON *special(const cJSON *root, const char *name, const char *exact)
{
    const cJSON *s;
    cJSON_ArrayForEach(s, cJSON_GetObjectItem(root, "special"))
    {
        if (!strcmp(text_of(cJSON_GetObjectItem(s, "at"), name), exact) && cJSON_IsTrue(cJSON_GetObjectItem(s, "confirmed"))) return s;
    }
    return NULL;
}

static int confirmed(const cJSON *root)
{
    int n = 0;
    const cJSON *s;
    cJSON_ArrayForEach(s, cJSON_GetObjectItem(root, "special")) n += cJSON_IsTrue(cJSON_GetObjectItem(s, "confirmed"));
    return n;
}

static cJSON *scanned(const place *p, const char *line)
{
    char all[600];
    snprintf(all, sizeof all, "%s -o s --quiet", line);
    finished_clear(&(finished[]){run_expecting(p, all, 0)}[0]);
    return json_here(p, "s/scan.json");
}

/* ---- what is found ---- */

Test(scan, the_sleigh_jumps_at_two, PLAIN_ONLY)
{
    place p = place_with_systems();
    cJSON *root = scanned(&p, "scan sleigh --over k=1.6:2.4:5");
    const cJSON *s = special(root, "k", "2");
    cr_assert_not_null(s);
    cr_expect_eq(number_of(s, "k"), 2);
    cr_expect_gt(number_of(s, "dimension"), number_of(s, "generic"));
    cr_expect_eq(cJSON_GetArraySize(cJSON_GetObjectItem(root, "points")), 5);
    cr_expect_str_eq(text_of(cJSON_GetObjectItem(cJSON_GetArrayItem(cJSON_GetObjectItem(root, "points"), 1), "at"), "k"), "9/5");
    cJSON_Delete(root);
    place_clear(&p);
}

/* A value where the grid ends is told by its own name, not by its neighbour's. */
Test(scan, values_at_the_ends_have_their_names, WHOLE_ONLY)
{
    place p = place_with_systems();
    cJSON *root = scanned(&p, "scan sleigh --over k=1:4:7");
    cr_expect_eq(cJSON_GetArraySize(cJSON_GetObjectItem(root, "special")), 4);
    for (int k = 1; k <= 4; k++) {
        char name[2] = {(char)('0' + k), 0};
        const cJSON *s = special(root, "k", name);
        cr_assert_not_null(s, "k = %d", k);
        cr_expect_eq(number_of(s, "k"), k);
    }
    cJSON_Delete(root);
    place_clear(&p);
}

/* The coefficient of y^3 is special at 1/3 and at 2, and the parameter is hidden in it. */
Test(scan, values_between_points_are_found_recognised_and_confirmed, PLAIN_ONLY)
{
    static const struct {
        const char *coefficient, *over, *exact, *other;
        double value;
    } families[] = {
        {"2/3*sin(k)", "k=0.1:1.4:14", "pi/6", NULL, M_PI / 6},
        {"sqrt(k + 1)/3", "k=0.5:50:41", "35", NULL, 35},
        {"k^2", "k=0.3:1.7:15", "sqrt(3)/3", "sqrt(2)", 0.57735026918962573},
        {"exp(k)", "k=0.15:1.05:10", "log(2)", NULL, 0.69314718055994529},
        {"2/3*1e10*k", "k=1.3e-11:14e-11:14", "5e-11", NULL, 5e-11},
        {"2/3*1e-10*k", "k=1.3e9:14e9:14", "5e9", NULL, 5e9},
        {"(k - 1)^3 + 1/3", "k=-0.55:0.8:9", "", NULL, 0}, /* special at 1 only */
    };
    for (size_t i = 0; i < sizeof families / sizeof *families; i++) {
        if (!sweep_tries(i, 2, 6)) continue;
        place p = place_make();
        char text[400], line[100];
        snprintf(text, sizeof text, "name: f\nparameters: {k: 0.2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2*y - (%s)*y^3\n", families[i].coefficient);
        write_here(&p, "f.yaml", text);
        snprintf(line, sizeof line, "scan f.yaml --over %s", families[i].over);
        cJSON *root = scanned(&p, line);
        cr_expect_eq(confirmed(root), (families[i].exact[0] != 0) + (families[i].other != NULL), "%s", families[i].coefficient);
        const cJSON *s = special(root, "k", families[i].exact);
        if (families[i].exact[0]) cr_assert_not_null(s, "%s: %s", families[i].coefficient, cJSON_PrintUnformatted(cJSON_GetObjectItem(root, "special")));
        if (s) {
            cr_expect_float_eq(number_of(s, "k"), families[i].value, 1e-9 * families[i].value);
            cr_expect_eq(number_of(s, "generic"), 3);
            cr_expect_eq(number_of(s, "dimension"), 6);
        }
        if (families[i].other) cr_expect_not_null(special(root, "k", families[i].other));
        cJSON_Delete(root);
        place_clear(&p);
    }
}

/* Cubic forms up to rotation and scale are a plane, in which the two that are integrable are points: a line through random forms misses them. */
Test(scan, nothing_is_confirmed_where_there_is_nothing, WHOLE_ONLY)
{
    srand(5);
    for (int i = 0; i < 4; i++) {
        place p = place_make();
        char text[400];
        snprintf(text, sizeof text, "name: f\nparameters: {k: 0.2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - 0.%d*x^3 - 0.%d*x^2*y + 0.%d*x*y^2 - sinh(k)*y^3\n", 11 + rand() % 80,
                 11 + rand() % 80, 11 + rand() % 80);
        write_here(&p, "f.yaml", text);
        cJSON *root = sweep_tries((size_t)i, 2, 4) ? scanned(&p, "scan f.yaml --over k=-2.03:2.17:17") : NULL;
        if (root) cr_expect_eq(confirmed(root), 0, "%s", text);
        cJSON_Delete(root);
        place_clear(&p);
    }
}

Test(scan, over_two_parameters_each_line_is_looked_along, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    cJSON *root = scanned(&p, "scan sine.yaml --over b=1,2 --over k=0.1:0.94:8");
    cr_expect_eq(confirmed(root), 1);
    const cJSON *s = special(root, "k", "pi/6");
    cr_assert_not_null(s);
    cr_expect_eq(number_of(s, "b"), 1);
    cr_expect_str_eq(text_of(s, "along"), "k");
    cJSON_Delete(root);
    place_clear(&p);
}

/* For k <= 1 the force is zero; nothing says so but abs. */
Test(scan, a_step_is_located_by_bisection, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "ramp.yaml", "name: ramp\nparameters: {k: 2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (abs(k - 1) + k - 1)*x^2\n");
    cJSON *root = scanned(&p, "scan ramp.yaml --of reduce --over k=-1:3:6 --number group.dimension --number stages");
    const cJSON *s = special(root, "k", "1");
    cr_assert_not_null(s);
    cr_expect_str_eq(text_of(s, "kind"), "step");
    cr_expect_eq(number_of(s, "below"), 3);
    cr_expect_eq(number_of(s, "dimension"), 3);
    cr_expect_eq(number_of(s, "above"), 1);
    cJSON_Delete(root);
    place_clear(&p);
}

Test(scan, numbers_of_analyze_by_their_path, WHOLE_ONLY)
{
    place p = place_make();
    write_here(&p, "o.yaml", "name: o\nparameters: {k: 2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + k*y^4)/2\n");
    cJSON *root = scanned(&p, "scan o.yaml --of analyze --over k=0,1 --number completeness.degree --number currents.0.proved --option work=50");
    const cJSON *first = cJSON_GetArrayItem(cJSON_GetObjectItem(root, "points"), 0), *second = cJSON_GetArrayItem(cJSON_GetObjectItem(root, "points"), 1);
    cr_expect_eq(number_of(cJSON_GetObjectItem(second, "numbers"), "currents.0.proved"), 1);
    cr_expect_gt(number_of(first, "dimension"), number_of(second, "dimension"));
    cJSON_Delete(root);
    place_clear(&p);
}

/* ---- recognition ---- */

static bool guessed(double value, const char *formula)
{
    nh_arena *arena = nh_arena_create();
    nh_setting guess[NH_SCAN_MOST_GUESSES];
    bool found = false;
    size_t n = nh_scan_guess(arena, value, 1e-11 * (value != 0 ? fabs(value) : 1), guess);
    for (size_t i = 0; i < n; i++) {
        const char *text = guess[i].formula ? guess[i].formula : nh_arena_printf(arena, "%lld/%lld", (long long)guess[i].top, (long long)guess[i].bottom);
        found |= !formula || !strcmp(text, formula);
    }
    nh_arena_free(arena);
    return found;
}

Test(scan, constants_are_recognised_and_random_numbers_are_not)
{
    cr_expect(guessed(1.0 / 3, "1/3"));
    cr_expect(guessed(-16.0 / 3, "-16/3"));
    cr_expect(guessed(0, "0/1"));
    cr_expect(guessed((1 + sqrt(5)) / 2, "(1+sqrt(5))/2"));
    cr_expect(guessed((3 - sqrt(7)) / 4, "(3-sqrt(7))/4"));
    cr_expect(guessed(-2 * sqrt(3) / 5, "-2*sqrt(3)/5"));
    cr_expect(guessed(M_PI, "pi"));
    cr_expect(guessed(-3 * M_PI / 4, "-3*pi/4"));
    cr_expect(guessed(2e-9, "2e-9"));
    cr_expect(guessed(1e9 / 3, "10e8/3"));
    cr_expect(guessed(log(3), "log(3)"));
    cr_expect(guessed(log(2.0 / 7), "log(2/7)"));
    srand(3);
    int wrong = 0;
    for (int i = 0; i < 300; i++) wrong += guessed(4.0 * (rand() + 0.5 * rand() / RAND_MAX) / RAND_MAX, NULL);
    cr_expect_leq(wrong, 3);
}

/* ---- the same bytes ---- */

static const char question[] = "scan sine.yaml --over k=0.1:1.4:40 --quiet";
static const char *const documents[] = {"scan.json", "scan.csv", "report.html", "summary.txt"};

static finished scan_into(const place *p, const manner *how, const char *folder, const char *more)
{
    char line[300];
    snprintf(line, sizeof line, "%s -o %s %s", question, folder, more);
    return run_so(p, how, line);
}

static void scan_well(const place *p, const char *folder, const char *more)
{
    finished f = scan_into(p, &(manner){0}, folder, more);
    cr_assert_eq(f.code, 0, "%s %s: %d %s", folder, more, f.code, f.err);
    finished_clear(&f);
}

static void expect_same(const place *p, const char *one, const char *other)
{
    for (size_t i = 0; i < sizeof documents / sizeof *documents; i++) {
        char a[100], b[100];
        snprintf(a, sizeof a, "%s/%s", one, documents[i]);
        snprintf(b, sizeof b, "%s/%s", other, documents[i]);
        char *x = read_here(p, a), *y = read_here(p, b);
        cr_expect(x && y && !strcmp(x, y), "%s and %s differ", a, b);
        free(x);
        free(y);
    }
}

Test(scan, workers_and_parts_do_not_change_a_byte, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    scan_well(&p, "one", "");
    scan_well(&p, "two", "--workers 2");
    scan_well(&p, "four", "--workers 4");
    scan_well(&p, "parts", "--chunk 3/3");
    scan_well(&p, "parts", "--chunk 1/3 --workers 2");
    cr_expect_null(read_here(&p, "parts/scan.json"), "a part writes no result");
    scan_well(&p, "parts", "--chunk 2/3");
    scan_well(&p, "parts", "");
    expect_same(&p, "one", "two");
    expect_same(&p, "one", "four");
    expect_same(&p, "one", "parts");
    place_clear(&p);
}

/* With MPI where it is. */
Test(scan, mpi_processes_do_not_change_a_byte)
{
    place p = place_make();
    char line[3 * PATH_MAX];
    if (system("command -v mpirun >/dev/null") || (snprintf(line, sizeof line, "%s-mpi", p.program), access(line, X_OK))) {
        place_clear(&p);
        cr_skip("mpirun or nhsym-mpi is not there");
    }
    write_here(&p, "sine.yaml", sine);
    scan_well(&p, "one", "");
    for (int n = sweep_whole() ? 1 : 2; n <= 4; n *= 2) {
        char folder[24];
        snprintf(folder, sizeof folder, "mpi%d", n);
        snprintf(line, sizeof line, "cd %s && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -np %d %s-mpi %s -o %s >log 2>&1", p.folder, n, p.program,
                 question, folder);
        int code = system(line);
        char *log = read_here(&p, "log");
        cr_assert_eq(code, 0, "%s: %d\n%s", line, code, log);
        free(log);
        expect_same(&p, "one", folder);
    }
    scan_well(&p, "mpi2", ""); /* both programs continue each other */
    place_clear(&p);
}

/* ---- kills ---- */

static void wait_a_little(long milliseconds) { nanosleep(&(struct timespec){milliseconds / 1000, milliseconds % 1000 * 1000000}, NULL); }

static pid_t start(const place *p, const char *folder)
{
    char line[300], *argument[most_words] = {(char *)p->program};
    snprintf(line, sizeof line, "%s -o %s --workers 2", question, folder);
    cut_words(line, argument, 1);
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        setpgid(0, 0);
        int nothing = open("/dev/null", O_RDWR);
        become(p, &(manner){0}, argument, nothing, nothing);
    }
    setpgid(child, child);
    return child;
}

/* The first child of a process, or 0. */
static pid_t child_of(pid_t parent)
{
    char path[100];
    int child = 0;
    snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)parent, (int)parent);
    FILE *file = fopen(path, "r");
    if (file && fscanf(file, "%d", &child) != 1) child = 0;
    if (file) fclose(file);
    return (pid_t)child;
}

static size_t units_of(const place *p, const char *folder)
{
    char command[PATH_MAX + 100];
    snprintf(command, sizeof command, "ls %s/%s/units | grep -c .", p->folder, folder);
    FILE *pipe = popen(command, "r");
    int n = 0;
    cr_assert(pipe && fscanf(pipe, "%d", &n) == 1);
    pclose(pipe);
    return (size_t)n;
}

Test(scan, kills_at_any_moment_lose_nothing_and_leave_nothing, PLAIN_ONLY)
{
    int kills = sweep_whole() ? 8 : 4;
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    scan_well(&p, "whole", "");
    srand(11);
    for (int k = 0; k < kills; k++) {
        pid_t main = start(&p, "killed");
        wait_a_little(100 + rand() % 500);
        pid_t worker = child_of(main);
        if (k % 2 && worker) {
            kill(worker, SIGKILL);
            wait_a_little(rand() % 200);
        }
        kill(-main, SIGKILL);
        waitpid(main, NULL, 0);
    }
    scan_well(&p, "killed", "--workers 2");
    expect_same(&p, "whole", "killed");
    cr_expect_eq(units_of(&p, "whole"), units_of(&p, "killed"), "files that were never finished are left");
    place_clear(&p);
}

Test(scan, a_worker_that_dies_is_replaced, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    scan_well(&p, "whole", "");
    pid_t main = start(&p, "killed");
    pid_t worker = 0;
    int status = 0;
    for (int k = 0; k < 300 && !worker; k++, wait_a_little(10)) worker = child_of(main);
    cr_assert(worker, "no worker");
    kill(worker, SIGKILL);
    waitpid(main, &status, 0);
    cr_expect(WIFEXITED(status) && WEXITSTATUS(status) == 0, "%x", status);
    expect_same(&p, "whole", "killed");
    place_clear(&p);
}

Test(scan, an_interruption_keeps_what_there_is, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    scan_well(&p, "whole", "");
    pid_t main = start(&p, "s");
    int status = 0;
    for (int k = 0; k < 500 && !child_of(main); k++) wait_a_little(10);
    wait_a_little(100);
    kill(-main, SIGINT);
    waitpid(main, &status, 0);
    cr_assert(WIFEXITED(status));
    cr_expect(WEXITSTATUS(status) == 130 || WEXITSTATUS(status) == 0, "%d", WEXITSTATUS(status));
    cJSON *root = json_here(&p, "s/scan.json");
    cr_expect_eq(cJSON_IsTrue(cJSON_GetObjectItem(root, "partial")), WEXITSTATUS(status) == 130);
    cJSON_Delete(root);
    scan_well(&p, "s", "");
    expect_same(&p, "whole", "s");
    place_clear(&p);
}

/* ---- files ---- */

Test(scan, a_full_disk_loses_nothing, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    scan_well(&p, "whole", "");
    finished f = scan_into(&p, &(manner){.file_limit = 1024}, "s", "--workers 2"); /* units fit, documents do not */
    cr_expect_eq(f.code, 4, "%d %s", f.code, f.err);
    cr_expect(strstr(f.err, "could not be written: File too large") && strstr(f.err, "the same command continues"), "%s", f.err);
    finished_clear(&f);
    f = scan_into(&p, &(manner){.file_limit = 40}, "t", "--workers 2"); /* not even the manifest */
    cr_expect_eq(f.code, 4, "%d %s", f.code, f.err);
    finished_clear(&f);
    scan_well(&p, "s", "");
    scan_well(&p, "t", "");
    expect_same(&p, "whole", "s");
    expect_same(&p, "whole", "t");
    place_clear(&p);
}

Test(scan, damaged_units_are_computed_again, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    scan_well(&p, "whole", "");
    scan_well(&p, "s", "");
    char *text = read_here(&p, "s/units/points-000003.txt");
    cr_assert_not_null(text);
    text[strlen(text) - 4] = 0; /* cut off */
    write_here(&p, "s/units/points-000003.txt", text);
    free(text);
    write_here(&p, "s/units/points-000001.txt", "nhsym scan 0123456789abcdef 1\n{}\nfinished\n"); /* of another scan */
    write_here(&p, "s/units/points-000002.txt", "");
    write_here(&p, "s/units/points-000002.txt.AbCdEf", "half");
    scan_well(&p, "s", "");
    expect_same(&p, "whole", "s");
    cr_expect_null(read_here(&p, "s/units/points-000002.txt.AbCdEf"));
    place_clear(&p);
}

static void expect_refusal(const place *p, const char *line, int code, const char *words)
{
    finished f = run(p, line);
    cr_expect_eq(f.code, code, "%s: %d", line, f.code);
    cr_expect(strstr(f.err, words), "%s: %s", line, f.err);
    finished_clear(&f);
}

Test(scan, another_scan_in_the_folder_is_refused, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    scan_well(&p, "s", "");
    char *before = read_here(&p, "s/scan.json");
    expect_refusal(&p, "scan sine.yaml --over k=0.1:1.4:41 -o s", 2, "with another question");
    expect_refusal(&p, "scan sine.yaml --over k=0.1:1.4:40 --set b=2 -o s", 2, "with another question");
    expect_refusal(&p, "scan sine.yaml --over k=0.1:1.4:40 --of analyze -o s", 2, "with another question");
    expect_refusal(&p, "scan sine.yaml --over k=0.1:1.4:40 --degree 2 -o s", 2, "with another question");
    write_here(&p, "sine.yaml", "name: sine\nparameters: {k: 0.2, b: 1}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sin(k)*y^3\n");
    expect_refusal(&p, "scan sine.yaml --over k=0.1:1.4:40 -o s", 2, "of another system file");
    write_here(&p, "sine.yaml", sine);
    char *manifest = read_here(&p, "s/manifest.json"), *build = strstr(manifest, "\"program\":");
    build = strchr(build + 10, '\"');
    build[8] ^= 1;
    write_here(&p, "s/manifest.json", manifest);
    expect_refusal(&p, "scan sine.yaml --over k=0.1:1.4:40 -o s", 2, "that another program began");
    write_here(&p, "s/manifest.json", "{}");
    expect_refusal(&p, "scan sine.yaml --over k=0.1:1.4:40 -o s", 3, "no manifest");
    char *after = read_here(&p, "s/scan.json");
    cr_expect_str_eq(before, after);
    free(manifest);
    free(before);
    free(after);
    place_clear(&p);
}

Test(scan, typing_errors_are_explained, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "sine.yaml", sine);
    expect_refusal(&p, "scan sine.yaml -o s", 2, "over which values");
    expect_refusal(&p, "scan sine.yaml --over k=1:2:3", 2, "into which folder");
    expect_refusal(&p, "scan sine.yaml --over kk=1:2:3 -o s", 2, "did you mean `k`?");
    expect_refusal(&p, "scan sine.yaml --over k=1:2 -o s", 2, "neither a range nor a list");
    expect_refusal(&p, "scan sine.yaml --over k=2:1:3 -o s", 2, "not below the second");
    expect_refusal(&p, "scan sine.yaml --over k=1,x -o s", 2, "`x` is not a number");
    expect_refusal(&p, "scan sine.yaml --over k=1/0 -o s", 2, "`1/0` is not a number");
    expect_refusal(&p, "scan sine.yaml --over k=1,2 --over k=3 -o s", 2, "names `k` twice");
    expect_refusal(&p, "scan sine.yaml --over k=1,2 --of cuont -o s", 2, "did you mean `count`?");
    expect_refusal(&p, "scan sine.yaml --over k=1,2 --number dimensoin -o s", 2, "did you mean `dimension`?");
    expect_refusal(&p, "scan sine.yaml --over k=1,2 --of reduce --number seconds -o s", 2, "this is a time");
    expect_refusal(&p, "scan sine.yaml --over k=1,2 --chunk 0/3 -o s", 2, "--chunk needs I/N");
    expect_refusal(&p, "scan sine.yaml --over k=1,2 --workers 1.5 -o s", 2, "--workers needs a whole number");
    expect_refusal(&p, "scan sine.yaml --over k=1:2:99999999 --over b=1:2:9999999 -o s", 2, "too many values");
    expect_refusal(&p, "scan sine.yaml --over k=1,2 -o no/such/folder", 4, "could not be created");
    place_clear(&p);
}
