/* No crash: whatever a file holds, a command ends with one of the documented codes and says why. */
#include "program.h"
#include "sweep.h"

#include <math.h>

#include "base/escape.h"
#include "base/memory.h"

/* Ends with a documented code, and with words where it is not 0. */
static void ends_well(const place *p, const char *line)
{
    finished f = run(p, line);
    cr_expect((f.code >= 0 && f.code <= 5) || f.code == 130, "nhsym %s: code %d\n%s", line, f.code, f.err);
    cr_expect(f.code <= 1 || *f.err || *f.out, "nhsym %s: code %d without a word", line, f.code);
    finished_clear(&f);
}

static void write_system(const place *p, const char *coordinates, const char *parameters, const char *lagrangian)
{
    size_t room = strlen(lagrangian) + strlen(parameters) + strlen(coordinates) + 200;
    char *text = malloc(room);
    snprintf(text, room, "coordinates: [%s]\nparameters: {%s}\nlagrangian: \"%s\"\n", coordinates, parameters, lagrangian);
    write_here(p, "system.yaml", text);
    free(text);
}

/* Where each term of an equation may vanish, or be a number: bodies that fall, slide and swing. */
Test(faults, what_falls_is_classified)
{
    static const char *const kinetic[] = {"m/2*x'^2", "(x'^2 + y'^2)/2", "m*x'^2/2 + y'^2/2", "x'*y'", "x'^2/(2*m) + y'^2", "m*(x'^2 + y'^2)/2"},
                      *const potential[] = {"0", "y", "m*y", "m*9.8*x", "k*x^2/2 + y", "k*(x^2 + y^2)", "m*x", "1/k", "k", "-x'*t"},
                      *const over[] = {"m", "k", "m,k"};
    place p = place_make();
    char lagrangian[200], line[100];
    for (size_t i = 0; i < 180; i++) {
        if (!sweep_tries(i, 7, 13)) continue;
        snprintf(lagrangian, sizeof lagrangian, "%s - (%s)", kinetic[i % 6], potential[i / 6 % 10]);
        write_system(&p, "x, y", "m: 2, k: 3", lagrangian);
        snprintf(line, sizeof line, "classify system.yaml --over %s --max-seconds 20", over[i / 60]);
        ends_well(&p, line);
    }
    write_system(&p, "x", "m: 2, g: 9.8", "m/2*x'^2 - m*g*x");
    finished f = run_expecting(&p, "classify system.yaml --over m --details", 0);
    cr_expect(strstr(f.out, "degree 1: no m has more than 1 (proved for all numbers, real or complex)"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* ---- as many as a file likes ---- */

/* Each with one number: a term of the Lagrangian. */
static const char *const terms[] = {" - sin(%1$zu*x)/%1$zu", " - sqrt(%zu + x^2)", " - abs(x - %zu)", " - log(%zu + y^2)/100", " + k/(%zu + x^2 + k^2)",
                                    " - sqrt((x - %zu)^2 + y^2)", " - sign(y - %zu)*y", " - exp(-%1$zu*x)/%1$zu", " + x'*atan(%zu*y)", " - bessel_j(%zu, x)",
                                    " - cos(%1$zu*x + k)*y/%1$zu", " - x^%1$zu*k^%1$zu", " - asinh(y/%zu)*x'", " - tan(x/%zu)", " + abs(x')*y/%zu"};
enum { kinds = sizeof terms / sizeof *terms };

static void write_many(const place *p, size_t kind, size_t n)
{
    char *text = malloc(n * 80 + 100), *at = text + sprintf(text, "x'^2/2 + y'^2/2");
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    for (size_t i = 1; i <= n; i++) at += sprintf(at, terms[kind], i);
#pragma GCC diagnostic pop
    write_system(p, "x, y", "k: 3", text);
    free(text);
}

/* One more than any list of the program has had room for (8, 16, .., 256), in every command. */
Test(faults, any_number_of_functions)
{
    static const size_t size[] = {9, 17, 25, 33, 65, 129, 201, 257, 401, 1001};
    static const char *const lines[] = {"analyze system.yaml", "classify system.yaml --over k", "simulate system.yaml --initial x'=1 --until 1", "export system.yaml --to c",
                                        "reduce system.yaml --initial x'=1", "verify system.yaml --current x'", "linearize system.yaml --at x=0", "benchmark system.yaml --budget 50ms"};
    enum { sizes = sizeof size / sizeof *size, commands = sizeof lines / sizeof *lines };
    place p = place_make();
    char line[200];
    for (size_t i = 0; i < kinds * sizes * commands; i++) {
        if (!sweep_tries(i, 53, 97)) continue;
        write_many(&p, i % kinds, size[i / kinds % sizes]);
        snprintf(line, sizeof line, "%s --max-seconds 0.5", lines[i / kinds / sizes]);
        ends_well(&p, line);
    }
    write_many(&p, 0, 299); /* these crashed */
    ends_well(&p, "export system.yaml --to c --max-seconds 2");
    ends_well(&p, "analyze system.yaml --max-seconds 2");
    place_clear(&p);
}

/* More coordinates, parameters or constraints. */
Test(faults, any_number_of_names)
{
    static const size_t size[] = {2, 7, 9, 13, 17, 21, 25, 33, 41, 65, 101};
    static const char *const lines[] = {"analyze system.yaml", "classify system.yaml --over p1", "simulate system.yaml --initial x1'=1 --until 1", "export system.yaml --to c",
                                        "reduce system.yaml --initial x1'=1", "verify system.yaml --current x1'", "linearize system.yaml --at x1=0", "benchmark system.yaml --budget 50ms"};
    enum { sizes = sizeof size / sizeof *size, commands = sizeof lines / sizeof *lines, ways = 3 };
    place p = place_make();
    char line[200];
    for (size_t i = 0; i < ways * sizes * commands; i++) {
        if (!sweep_tries(i, 31, 61)) continue;
        size_t n = size[i / ways % sizes], way = i % ways, names = way == 1 ? 2 : n;
        char *text = malloc(n * 400 + 400), *at = text + sprintf(text, "coordinates: [x1");
        for (size_t k = 2; k <= names; k++) at += sprintf(at, ", x%zu", k);
        at += sprintf(at, "]\nparameters: {p1: 1");
        for (size_t k = 2; k <= (way == 1 ? n : 1); k++) at += sprintf(at, ", p%zu: %zu", k, k);
        at += sprintf(at, "}\nlagrangian: \"0");
        for (size_t k = 1; k <= names; k++) at += sprintf(at, " + x%zu'^2/2 - p1*x%zu^2*%zu", k, k, k);
        for (size_t k = 2; k <= n && way == 1; k++) at += sprintf(at, " - p%zu*x1^%zu", k, k);
        at += sprintf(at, "\"\n%s", way == 2 ? "constraints:\n" : "");
        for (size_t k = 1; k < n && way == 2; k++) at += sprintf(at, "  - \"x%zu' = x%zu*x%zu'\"\n", k, k + 1, n);
        write_here(&p, "system.yaml", text);
        free(text);
        snprintf(line, sizeof line, "%s --max-seconds 0.5", lines[i / ways / sizes]);
        ends_well(&p, line);
    }
    place_clear(&p);
}

/* ---- ended from outside ---- */

static pid_t begin(const place *p, const char *line)
{
    char copy[1000], *argument[most_words] = {(char *)p->program}, said[PATH_MAX + 20];
    snprintf(copy, sizeof copy, "%s", line);
    cut_words(copy, argument, 1);
    snprintf(said, sizeof said, "%.4000s/said", p->folder);
    pid_t child = fork();
    if (child == 0) {
        int file = open(said, O_RDWR | O_CREAT | O_TRUNC, 0600);
        become(p, &(manner){0}, argument, file, file);
    }
    return child;
}

static int end_of(pid_t child)
{
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

/* All of them as SIGINT: the table so far is written. */
Test(faults, every_signal_keeps_what_there_is)
{
    static const int signals[] = {SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, SIGXFSZ, SIGINT, SIGTERM};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        if (!sweep_tries(i, 1, 3)) continue;
        char *said = NULL;
        int code = 0;
        for (useconds_t wait = 700000; wait < 100000000; wait *= 2) { /* until the signal falls into the motion */
            free(said);
            pid_t child = begin(&p, "simulate double_pendulum --initial p=1 --until 1e5 --step 10 --option steps=1e9 --csv motion.csv -q --no-analysis");
            usleep(wait);
            kill(child, signals[i]);
            code = end_of(child);
            said = read_here(&p, "said");
            if (!said || !strstr(said, "before there was a result")) break;
        }
        char *table = read_here(&p, "motion.csv");
        cr_expect_eq(code, 130, "%s: %d, %s", strsignal(signals[i]), code, said);
        cr_expect(table && strchr(table, '\n'), "%s: %s", strsignal(signals[i]), said);
        free(table);
        free(said);
        unlink_here(&p, "motion.csv");
    }
    place_clear(&p);
}

/* nohup. */
Test(faults, what_is_ignored_stays_ignored)
{
    place p = place_with_systems();
    signal(SIGHUP, SIG_IGN);
    pid_t child = begin(&p, "benchmark sleigh --budget 1s -q --json b.json");
    signal(SIGHUP, SIG_DFL);
    usleep(500000);
    kill(child, SIGHUP);
    cr_expect_eq(end_of(child), 0);
    place_clear(&p);
}

/* `| head`: no word about it. */
Test(faults, a_reader_may_leave)
{
    place p = place_with_systems();
    char line[PATH_MAX + 200];
    snprintf(line, sizeof line, "'%s' simulate sleigh --initial omega=2 --until 100 --step 1e-3 --no-analysis 2>said | head -n 1", p.program);
    finished f = run_vector(&p, &(manner){0}, (char *[]){"sh", "-c", line, NULL});
    char *said = read_here(&p, "said");
    cr_expect(said && !strstr(said, "could not be written"), "%s", said);
    cr_expect(strstr(f.out, "omega"), "%s", f.out);
    free(said);
    finished_clear(&f);
    place_clear(&p);
}

Test(faults, a_limit_before_the_folder_is_a_limit)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "export crane --to c -o NEW --max-seconds 0.001", 5);
    cr_expect(strstr(f.err, "time limit"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

Test(faults, the_mask_is_obeyed)
{
    place p = place_with_systems();
    char path[PATH_MAX + 20];
    struct stat info;
    mode_t before = umask(027);
    finished f = run_expecting(&p, "export sleigh --to c -o code", 0), g = run_expecting(&p, "show sleigh --of parameters", 0);
    umask(before);
    snprintf(path, sizeof path, "%.4000s/code/sleigh.c", p.folder);
    cr_expect(!stat(path, &info) && (info.st_mode & 0777) == 0640, "%o", info.st_mode);
    chmod(path, 0604); /* and what the user gave a file */
    finished_clear(&f);
    f = run_expecting(&p, "export sleigh --to c -o code", 0);
    cr_expect(!stat(path, &info) && (info.st_mode & 0777) == 0604, "%o", info.st_mode);
    finished_clear(&f);
    finished_clear(&g);
    place_clear(&p);
}

/* ---- memory of a control group ---- */

Test(faults, a_control_group_limits_the_memory)
{
    place p = place_make();
    char list[PATH_MAX + 20], root[PATH_MAX + 20];
    snprintf(list, sizeof list, "%.4000s/list", p.folder);
    snprintf(root, sizeof root, "%.4000s/root", p.folder);
    folder_here(&p, "root", 0755);
    folder_here(&p, "root/slice", 0755);
    folder_here(&p, "root/slice/job", 0755);
    folder_here(&p, "root/memory", 0755);
    folder_here(&p, "root/memory/old", 0755);
    write_here(&p, "list", "0::/slice/job\n");
    cr_expect(isinf(nh_memory_of_group(list, root)));
    write_here(&p, "root/slice/job/memory.max", "max\n");
    cr_expect(isinf(nh_memory_of_group(list, root)));
    write_here(&p, "root/slice/memory.max", "1000000\n");
    cr_expect_eq(nh_memory_of_group(list, root), 1e6);
    write_here(&p, "root/memory.max", "500000\n");
    cr_expect_eq(nh_memory_of_group(list, root), 5e5);
    write_here(&p, "list", "9:name=systemd:/x\n5:cpu,memory:/old\n");
    write_here(&p, "root/memory/old/memory.limit_in_bytes", "300000\n");
    cr_expect_eq(nh_memory_of_group(list, root), 3e5);
    write_here(&p, "list", "nonsense");
    cr_expect(isinf(nh_memory_of_group(list, root)));
    place_clear(&p);
}

/* ---- what a scan finds in its folder ---- */

Test(faults, a_scan_trusts_nothing_in_its_folder)
{
    static const char scan[] = "scan system.yaml --over k=1:2:3 --degree 1 -o s -q";
    static const char *const names[] = {"lock", "manifest.json", "units/points-000001.txt", "units/points-000002.part"};
    place p = place_make();
    char path[PATH_MAX + 60];
    write_system(&p, "x, y", "k: 3", "x'^2/2 + y'^2/2 - k*x^2/2");
    finished_clear(&(finished[]){run_expecting(&p, scan, 0)}[0]);
    char *whole = read_here(&p, "s/scan.json"), *unit = read_here(&p, "s/units/points-000001.txt");
    cr_assert(whole && unit);
    char *digit = strpbrk(strchr(unit, '\n'), "0123456789"); /* one digit is another */
    *digit = *digit == '1' ? '2' : '1';
    write_here(&p, "s/units/points-000001.txt", unit);
    finished_clear(&(finished[]){run_expecting(&p, scan, 0)}[0]);
    char *again = read_here(&p, "s/units/points-000001.txt");
    cr_expect_str_neq(again, unit, "a damaged unit is not computed again");
    for (size_t i = 0; i < 12; i++) {
        const char *name = names[i % 4];
        char *kept = NULL;
        snprintf(path, sizeof path, "%.4000s/s/%s", p.folder, name);
        FILE *file = fopen(path, "r");
        if (file) kept = read_stream(file), fclose(file);
        unlink(path);
        if (i < 4) mkfifo(path, 0600);
        else cr_assert_eq(symlink(i < 8 ? "/dev/zero" : "../elsewhere", path), 0);
        finished f = run_expecting(&p, scan, 3);
        cr_expect(strstr(f.err, "this is no file that nhsym wrote here") && strstr(f.err, name), "%s: %s", name, f.err);
        finished_clear(&f);
        unlink(path);
        if (kept && (file = fopen(path, "w"))) fputs(kept, file), fclose(file);
        free(kept);
    }
    cr_expect_null(read_here(&p, "elsewhere"));
    static const char *const sizes[] = {"1e20", "-1", "0", "1.5", "NaN", "1e400", "\"3\"", "9007199254740993"};
    for (size_t i = 0; i < 8; i++) {
        char *text = read_here(&p, "s/manifest.json"), *at = strstr(text, "\"points_per_unit\":"), changed[2000];
        snprintf(changed, sizeof changed, "%.*s\"points_per_unit\": %s%s", (int)(at - text), text, sizes[i], strchr(at, ','));
        write_here(&p, "s/manifest.json", changed);
        finished f = run_expecting(&p, scan, 3);
        cr_expect(strstr(f.err, "this is no manifest of a scan"), "%s: %s", sizes[i], f.err);
        finished_clear(&f);
        write_here(&p, "s/manifest.json", text);
        free(text);
    }
    finished_clear(&(finished[]){run_expecting(&p, scan, 0)}[0]);
    free(again);
    free(unit);
    free(whole);
    place_clear(&p);
}

/* ---- what is said ---- */

/* A path may be any bytes; JSON and pages are UTF-8. */
Test(faults, documents_are_utf8)
{
    static const char *const lines[] = {"simulate \xff\xc3.yaml --initial x'=1 --until 1 -q --no-analysis", "linearize \xff\xc3.yaml --at x=0 -q", "verify \xff\xc3.yaml --current y' -q"};
    place p = place_make();
    write_here(&p, "\xff\xc3.yaml", "coordinates: [x, y]\nparameters: {k: 3}\nlagrangian: x'^2/2 + y'^2/2 - k*x^2/2\n");
    for (size_t i = 0; i < 3; i++) {
        char line[200];
        snprintf(line, sizeof line, "%s --json a.json --html a.html --tex a.tex", lines[i]);
        finished_clear(&(finished[]){run_expecting(&p, line, 0)}[0]);
        for (int k = 0; k < 2; k++) {
            char *text = read_here(&p, k ? "a.html" : "a.json");
            cr_assert_not_null(text);
            uint32_t code;
            size_t left = strlen(text), length = 1;
            const char *at = text;
            for (; left && length; at += length, left -= length) length = nh_utf8_decode(at, left < 4 ? left : 4, &code);
            cr_expect_eq(left, 0, "%s: %.60s", lines[i], at - 60);
            cr_expect(k || strstr(text, "\xef\xbf\xbd"), "%s", lines[i]);
            free(text);
        }
    }
    place_clear(&p);
}

/* A file of somebody else may name any file. */
Test(faults, secrets_stay_secret)
{
    static const char *const secret[] = {"root:*:20228:0:99999:7:::\n", "SECRET = 1\n", "- SECRET\n", "lagrangian: SECRET + 1 +\n", "name: [SECRET\n", "SECRET\tx\n", "\"SECRET\" : {a: b}\n", "parameters: {SECRET: [1]}\n"};
    place p = place_make();
    write_here(&p, "open.yaml", "include: shadow\ncoordinates: [x]\n");
    for (size_t i = 0; i < sizeof secret / sizeof *secret; i++) {
        write_here(&p, "shadow", secret[i]);
        finished f = run_expecting(&p, "analyze open.yaml", 3);
        cr_expect(!strstr(f.err, "SECRET") && !strstr(f.err, "20228") && strstr(f.err, "this included file is no part of a system"), "%s", f.err);
        finished_clear(&f);
    }
    write_here(&p, "open.yaml", "include: shadow.yaml\ncoordinates: [x]\n");
    write_here(&p, "shadow.yaml", "lagrangian: wrong +\n");
    finished f = run_expecting(&p, "analyze open.yaml", 3);
    cr_expect(strstr(f.err, "wrong +"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

/* When the limit of time ends the check of an accuracy, the result says so. */
Test(faults, an_accuracy_that_was_not_checked_is_partial)
{
    place p = place_with_systems();
    static const char *const seconds[] = {"0.2", "0.4", "0.8"};
    for (size_t i = 0; i < 3; i++) {
        char line[300];
        snprintf(line, sizeof line, "simulate double_pendulum --initial p=1 --accuracy 1e-9 --until 5000 --json j.json -q --no-analysis --max-seconds %s", seconds[i]);
        finished f = run_expecting(&p, line, 5);
        char *text = read_here(&p, "j.json");
        cr_expect(!text || strstr(text, "\"partial\":\ttrue") || strstr(text, "unfinished"), "%s: %.600s", seconds[i], text);
        free(text);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* ---- systems from a grammar ---- */

typedef struct {
    uint64_t state;
    size_t coordinates, parameters;
    char text[6000], *at;
} grammar;

static size_t pick(grammar *g, size_t n)
{
    g->state = g->state * 6364136223846793005u + 1442695040888963407u;
    return (size_t)(g->state >> 33) % n;
}

static void put(grammar *g, const char *text)
{
    size_t room = (size_t)(g->text + sizeof g->text - g->at);
    if (strlen(text) + 1 < room) g->at += sprintf(g->at, "%s", text);
}

static void put_expression(grammar *g, int depth, bool velocities)
{
    static const char *const call[] = {"sin", "cos", "exp", "sqrt", "abs", "log", "atan", "tan", "cosh", "sign", "tanh", "asin", "acosh"},
                             *const number[] = {"0", "1", "2", "-1", "1/2", "3", "1e-8", "0.1", "pi", "1e6", "7/3"}, *const between[] = {" + ", " - ", "*", "/"};
    char word[20];
    size_t kind = depth <= 0 ? pick(g, 3) : pick(g, 8);
    if (kind == 0) snprintf(word, sizeof word, "q%zu%s", 1 + pick(g, g->coordinates), velocities && pick(g, 2) ? "'" : "");
    else if (kind == 1) snprintf(word, sizeof word, "%s", number[pick(g, sizeof number / sizeof *number)]);
    else if (g->parameters) snprintf(word, sizeof word, "p%zu", 1 + pick(g, g->parameters));
    else snprintf(word, sizeof word, "t");
    if (kind < 3) {
        put(g, word);
        return;
    }
    put(g, kind == 3 ? call[pick(g, sizeof call / sizeof *call)] : "");
    put(g, "(");
    put_expression(g, depth - 1, velocities);
    if (kind == 4) put(g, (const char *[]){")^2", ")^3", ")^(1/2)", ")^(-1)", ")^4", ")^0", ")^(-2)", ")^(1/3)"}[pick(g, 8)]);
    else put(g, ")");
    if (kind < 5) return;
    put(g, between[pick(g, 4)]);
    put_expression(g, depth - 1, velocities);
}

/* A kinetic energy, which may be singular, a potential, and at times constraints and forces. */
static const char *write_grown(grammar *g, size_t seed)
{
    char word[100];
    *g = (grammar){.state = 77 + seed * 7919, .at = g->text};
    g->coordinates = 1 + pick(g, 3);
    g->parameters = pick(g, 3);
    put(g, "coordinates: [q1");
    for (size_t k = 2; k <= g->coordinates; k++) snprintf(word, sizeof word, ", q%zu", k), put(g, word);
    put(g, "]\nparameters: {");
    for (size_t k = 1; k <= g->parameters; k++) snprintf(word, sizeof word, "%sp%zu: %zu", k > 1 ? ", " : "", k, 1 + pick(g, 3)), put(g, word);
    put(g, "}\nlagrangian: \"");
    for (size_t k = 1; k <= g->coordinates; k++) {
        size_t way = pick(g, 4);
        put(g, k > 1 ? " + " : "");
        if (way == 1) put(g, "("), put_expression(g, 1, false), put(g, ")*");
        if (way == 2 && g->parameters) put(g, "p1*");
        snprintf(word, sizeof word, "q%zu'^2/2", k);
        if (way != 3 || pick(g, 3)) put(g, word);
        else put(g, "0");
    }
    put(g, " - (");
    put_expression(g, 3, pick(g, 4) == 0);
    put(g, ")\"\n");
    if (g->coordinates > 1 && pick(g, 4) == 0) {
        put(g, "constraints: [\"q1' = (");
        put_expression(g, 1, false);
        put(g, ")*q2'\"]\n");
    }
    if (pick(g, 6) == 0) put(g, "forces: {q1: \""), put_expression(g, 1, true), put(g, "\"}\n");
    return g->text;
}

/* 3000 of them with NHSYM_SWEEPS=all, each by one command. */
Test(faults, what_a_grammar_grows)
{
    static const char *const lines[] = {"classify g.yaml --over p1", "analyze g.yaml -o out", "simulate g.yaml --initial \"q1=0.5, q1'=0.3\" --until 2 --json j.json", "reduce g.yaml -o out", "classify g.yaml --over p1,p2",
                                        "export g.yaml --to c", "linearize g.yaml --at q1=0", "verify g.yaml --current q1'", "scan g.yaml --over p1=1:2:3 -o scanned", "classify g.yaml --over p1 --json c.json"};
    place p = place_make();
    grammar g;
    const char *first = getenv("NHSYM_FIRST"), *most = getenv("NHSYM_MOST");
    size_t from = first ? (size_t)atol(first) : 0, to = most ? from + (size_t)atol(most) : sweep_whole() ? 3000 : from + 40, done = 0, computed = 0;
    for (size_t i = from; i < to; i++) {
        char line[200];
        if (!most && !sweep_tries(i, 2, 5)) continue;
        write_here(&p, "g.yaml", write_grown(&g, i));
        snprintf(line, sizeof line, "%s --max-seconds 1", lines[i % 10]);
        for (char *quote; (quote = strchr(line, '"'));) memmove(quote, quote + 1, strlen(quote));
        for (char *comma; (comma = strstr(line, ", "));) memmove(comma + 1, comma + 2, strlen(comma + 1));
        finished f = run(&p, line);
        bool good = (f.code >= 0 && f.code <= 5) || f.code == 130;
        cr_expect(good && !strstr(f.err, "runtime error"), "seed %zu, nhsym %s: code %d\n%.1500s\n%s", i, line, f.code, f.err, g.text);
        finished_clear(&f);
        if (i % 10 == 8) finished_clear(&(finished[]){run_vector(&p, &(manner){0}, (char *[]){"rm", "-rf", "scanned", NULL})}[0]);
        done++;
        computed += f.code == 0 || f.code == 1 || f.code == 5;
    }
    printf("measured: %zu systems from the grammar, %zu of them computed\n", done, computed);
    cr_expect(3 * computed >= done, "%zu of %zu", computed, done);
    place_clear(&p);
}
