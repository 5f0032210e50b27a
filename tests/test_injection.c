/* Every command, with an allocation, a system call or the peace of mind taken away at the n-th place: it ends with a documented code, soon, leaves nothing behind,
 * replaces all of its files or none, and what it calls done is what it would have been.  With NHSYM_SWEEPS=all more than 5000 faults. */
#include "program.h"
#include "sweep.h"

#include <dirent.h>
#include <math.h>
#include <sys/mman.h>
#include <time.h>

#include "faults.h"

/* The command, and what it says differently when it fills the folder `out` before. */
static const struct {
    const char *line, *before;
    bool timed; /* its numbers depend on the clock */
} commands[] = {
    {"verify small.yaml --current y' -o out", " --set m=3", false},
    {"simulate sleigh --initial omega=2 --until 1 --no-analysis -o out", " --set m=3", false},
    {"simulate sleigh --initial omega=2 --until 1 --no-analysis --csv out/m.csv --json out/m.json --svg out/m.svg --html out/m.html", " --set m=3", false},
    {"simulate sleigh --initial omega=2 --until 1 --no-analysis --method bdf --csv out/m.csv --json out/m.json", " --set m=3", false},
    {"simulate sleigh --initial omega=2 --until 1 --no-analysis --method rk8pd --csv out/m.csv --json out/m.json", " --set m=3", false},
    {"simulate sleigh --initial omega=2 --until 1 --no-analysis --method esdirk --csv out/m.csv --json out/m.json", " --set m=3", false},
    {"simulate sleigh --initial omega=2 --until 1 --no-analysis --method dalembert --csv out/m.csv --json out/m.json", " --set m=3", false},
    {"simulate sleigh --initial omega=2 --until 1 --no-analysis --option compile=1e-9 --csv out/m.csv --json out/m.json", " --set m=3", false},
    {"simulate sleigh --initial omega=2 --until 1 --no-analysis --ensemble 5 --csv out/m.csv --json out/m.json", " --set m=3", false},
    {"export sleigh --to c -o out", " --set m=3", false},
    {"export sleigh --to python -o out", " --set m=3", false},
    {"linearize small.yaml --at x=0 -o out", " --set k=5", false},
    {"analyze small.yaml --degree 1 -o out", " --set k=5", false},
    {"reduce small.yaml --initial x'=1 -o out", " --set k=5", false},
    {"classify small.yaml --over k --degree 2 -o out", " --set m=3", false},
    {"scan small.yaml --over k=1:2:3 --degree 1 -o out", NULL, false},
    {"scan small.yaml --over k=1:2:3 --degree 1 --workers 2 -o out", NULL, false},
    {"benchmark sleigh --budget 10ms -o out", " --set m=3", true},
};
enum { count_of_commands = sizeof commands / sizeof *commands, most_out = 80 };

typedef struct {
    place p;
    char library[PATH_MAX + 40], record[PATH_MAX + 40];
    fault *shared;
} bench;

static char *path_in(const bench *b, const char *folder, const char *name)
{
    static char path[4][2 * PATH_MAX];
    static int turn;
    turn = (turn + 1) % 4;
    snprintf(path[turn], sizeof *path, "%s/%s%s%s", b->p.folder, folder, *name ? "/" : "", name);
    return path[turn];
}

static void shell(const bench *b, const char *what)
{
    char line[3 * PATH_MAX];
    snprintf(line, sizeof line, "cd '%s' && %s", b->p.folder, what);
    cr_assert_eq(system(line), 0, "%s", line);
}

static bool bench_make(bench *b)
{
    char line[4 * PATH_MAX];
    if (sweep_sanitized()) return false; /* its allocations are not ours to refuse */
    b->p = place_with_systems();
    snprintf(b->library, sizeof b->library, "%s/preload.so", b->p.folder);
    snprintf(b->record, sizeof b->record, "%s/record", b->p.folder);
    snprintf(line, sizeof line, "${CC:-cc} -shared -fPIC -O1 -D_GNU_SOURCE tests/faults_preload.c -o '%s'", b->library);
    cr_assert_eq(system(line), 0, "%s", line);
    int file = open(b->record, O_RDWR | O_CREAT, 0600);
    cr_assert(file >= 0 && ftruncate(file, sizeof(fault)) == 0);
    b->shared = mmap(NULL, sizeof(fault), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    cr_assert_neq(b->shared, MAP_FAILED);
    close(file);
    write_here(&b->p, "small.yaml", "coordinates: [x, y]\nparameters: {m: 2, k: 3}\nlagrangian: m*(x'^2 + y'^2)/2 - k*x^2/2\n");
    folder_here(&b->p, "tmp", 0700);
    return true;
}

/* Starts the command. */
static pid_t start(const bench *b, const char *line)
{
    char copy[1000], *argument[most_words] = {(char *)b->p.program};
    snprintf(copy, sizeof copy, "%s", line);
    cut_words(copy, argument, 1);
    pid_t child = fork();
    if (child == 0) {
        int said = open(path_in(b, "said", ""), O_RDWR | O_CREAT | O_TRUNC, 0600);
        setpgid(0, 0);
        setenv("LD_PRELOAD", b->library, 1);
        setenv("NHSYM_FAULT", b->record, 1);
        setenv("TMPDIR", path_in(b, "tmp", ""), 1);
        become(&b->p, &(manner){0}, argument, said, said);
    }
    return child;
}

/* Its exit code; 1000 + the number of the signal that ended it, 2000 when it does not end within a minute. */
static int await(pid_t child)
{
    int status = 0;
    for (int i = 0; i < 30000; i++) {
        if (waitpid(child, &status, WNOHANG)) return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
        nanosleep(&(struct timespec){0, 2000000}, NULL);
    }
    kill(-child, SIGKILL);
    waitpid(child, &status, 0);
    return 2000;
}

static int strike(const bench *b, const char *line, fault what)
{
    *b->shared = what;
    return await(start(b, line));
}

/* ---- files ---- */

static size_t names_in(const bench *b, const char *folder, char **name)
{
    DIR *d = opendir(path_in(b, folder, ""));
    size_t n = 0;
    for (struct dirent *e; d && n < most_out && (e = readdir(d));)
        if (*e->d_name != '.' && strcmp(e->d_name, "units") && strcmp(e->d_name, "lock")) name[n++] = strdup(e->d_name);
    if (d) closedir(d);
    return n;
}

static char *text_of(const bench *b, const char *folder, const char *name)
{
    FILE *file = fopen(path_in(b, folder, name), "r");
    if (!file) return NULL;
    char *text = read_stream(file);
    fclose(file);
    return text;
}

static bool same(const bench *b, const char *one, const char *other, const char *name)
{
    char *x = text_of(b, one, name), *y = text_of(b, other, name);
    bool equal = x && y ? !strcmp(x, y) : !x && !y;
    free(x);
    free(y);
    return equal;
}

/* Is it, line by line, what two undisturbed runs have in common? */
static bool as_undisturbed(const bench *b, const char *name)
{
    char *text[3] = {text_of(b, "new", name), text_of(b, "newer", name), text_of(b, "out", name)}, *at[3];
    bool good = text[0] && text[1] && text[2];
    memcpy(at, text, sizeof at);
    while (good && (*at[0] || *at[1] || *at[2])) {
        size_t length[3];
        for (int i = 0; i < 3; i++) length[i] = strcspn(at[i], "\n");
        bool known = length[0] == length[1] && !memcmp(at[0], at[1], length[0]);
        good = !known || (length[0] == length[2] && !memcmp(at[0], at[2], length[0]));
        for (int i = 0; i < 3; i++) at[i] += length[i] + (at[i][length[i]] == '\n');
    }
    for (int i = 0; i < 3; i++) free(text[i]);
    return good;
}

static bool has_name(size_t n, char *const *name, const char *word)
{
    bool found = false;
    for (size_t i = 0; i < n; i++) found |= !strcmp(name[i], word);
    return found;
}

/* Nothing but what belongs there; all of the files are old ones, or none is that would have been replaced. */
static const char *wrong_files(const bench *b, size_t k, int code, const char **which)
{
    char *name[4][most_out], *of[] = {"out", "old", "new", "tmp"};
    size_t n[4], old = 0, replaced = 0;
    const char *wrong = NULL;
    static char at[300];
    for (int i = 0; i < 4; i++) n[i] = names_in(b, of[i], name[i]);
    *which = at;
    if (n[3]) wrong = "a temporary file or folder stays", snprintf(at, sizeof at, "%s", name[3][0]);
    for (size_t i = 0; i < n[0] && !wrong; i++) {
        bool figure = !strncmp(name[0][i], "figure", 6), timed = commands[k].timed && figure;
        snprintf(at, sizeof at, "%s", name[0][i]);
        if (!timed && !has_name(n[1], name[1], at) && !has_name(n[2], name[2], at)) wrong = "a file that no run writes";
        else if (code == 0 && !commands[k].timed && !as_undisturbed(b, at)) wrong = "done, but differs";
        if (figure || !strcmp(at, "manifest.json") || same(b, "old", "new", at)) continue;
        if (same(b, "out", "old", at)) old++;
        else replaced++;
        if (old && replaced) wrong = "a mixture";
    }
    if (!wrong && code == 0 && n[0] != n[2] && !commands[k].timed) wrong = "done, but files are missing";
    for (int i = 0; i < 4; i++)
        while (n[i]) free(name[i][--n[i]]);
    return wrong;
}

static void fill(const bench *b, size_t k)
{
    char line[1000];
    *b->shared = (fault){0};
    shell(b, "rm -rf out old new newer && mkdir out");
    snprintf(line, sizeof line, "%s%s", commands[k].line, commands[k].before ? commands[k].before : "");
    if (commands[k].before) cr_expect_eq(strike(b, line, (fault){0}), 0, "%s", line);
    shell(b, "cp -r out old");
    for (int i = 0; i < 2; i++) {
        shell(b, "rm -rf out && cp -r old out");
        cr_expect_eq(strike(b, commands[k].line, (fault){0}), 0, "%s", commands[k].line);
        shell(b, i ? "cp -r out newer" : "cp -r out new");
    }
}

/* A number from 1 to n: the i-th of so many, evenly or, every other, closer together at the beginning. */
static long place_of(size_t i, size_t all, long n)
{
    double part = ((double)i + 0.5) / (double)all;
    return 1 + (long)(i % 2 ? pow((double)n, part) - 1 : part * (double)(n - 1));
}

static void inject(fault_kind kind, size_t all)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, SIGXFSZ};
    bench b;
    size_t wrong_ones = 0, struck = 0, each = (all + count_of_commands - 1) / count_of_commands;
    if (!bench_make(&b)) return;
    const char *only = getenv("NHSYM_INJECT"); /* the number of one command: a portion */
    for (size_t k = 0; k < count_of_commands; k++) {
        if (only ? k != (size_t)atol(only) : !sweep_whole() && (k + (size_t)kind) % 9) continue;
        fill(&b, k);
        long n = b.shared->count[kind];
        for (size_t i = 0; i < each; i++) {
            fault f = {.kind = kind, .at = place_of(i, each, n), .times = kind == FAULT_MEMORY && i % 3 == 0 ? 1L << 40 : 1, .signal = signals[i % 7]};
            shell(&b, "rm -rf out && cp -r old out");
            int code = strike(&b, commands[k].line, f);
            const char *which = "", *wrong = code >= 2000 ? "does not end" : code >= 1000 ? "ended by a signal" : (code > 5 || code == 1) && code != 130 ? "an exit code of its own" : wrong_files(&b, k, code, &which);
            char *said = wrong ? text_of(&b, "said", "") : NULL;
            cr_expect_null(wrong, "nhsym %s, fault %d at %ld of %ld (%ld times, signal %d): code %d, %s %s\n%.300s", commands[k].line, kind, f.at, n, f.times, f.signal, code, wrong, which, said ? said : "");
            free(said);
            struck += b.shared->struck != 0;
            wrong_ones += wrong != NULL;
            if (wrong) shell(&b, "rm -rf tmp && mkdir -m 700 tmp");
        }
    }
    printf("measured: %zu faults of kind %d struck, %zu ended wrongly\n", struck, kind, wrong_ones);
    place_clear(&b.p);
}

/* ---- two runs, one folder ---- */

/* Whose files are these?  -1: nobody's. */
static int owner(const bench *b, const char *const of[2])
{
    char *name[most_out];
    size_t n = names_in(b, "out", name), hits[2] = {0}, told = 0;
    for (size_t i = 0; i < n; i++) {
        bool one = same(b, "out", of[0], name[i]), other = same(b, "out", of[1], name[i]);
        bool clock = !strcmp(name[i], "report.html") || !strcmp(name[i], "report.tex") || !strcmp(name[i], "result.json");
        if (!one && !other && clock) continue; /* how long it took stands in them */
        if (one == other && one) continue;
        told++;
        hits[0] += one;
        hits[1] += other;
    }
    while (n) free(name[--n]);
    return told && hits[0] == told ? 0 : told && hits[1] == told ? 1 : -1;
}

Test(injection, two_runs_share_a_folder)
{
    static const char *const line[] = {"export sleigh --to c -o out", "export sleigh --to c --set a=7 -o out", "linearize small.yaml --at x=0 -o out", "linearize small.yaml --at x=0 --set k=9 -o out",
                                       "simulate small.yaml --initial x=1 --until 1 -o out", "simulate small.yaml --initial x=1 --until 1 --set k=7 -o out"};
    static const char *const of[] = {"old", "new"};
    bench b;
    size_t mixed = 0, pairs = sweep_whole() ? 51 : 9;
    if (!bench_make(&b)) return;
    for (size_t k = 0; k < 3; k++) {
        for (int i = 0; i < 2; i++) {
            shell(&b, "rm -rf out && mkdir out");
            cr_assert_eq(strike(&b, line[2 * k + (size_t)i], (fault){0}), 0);
            shell(&b, i ? "rm -rf new && cp -r out new" : "rm -rf old && cp -r out old");
        }
        for (size_t i = 0; i < pairs / 3; i++) {
            shell(&b, "rm -rf out && mkdir out");
            *b.shared = (fault){.pause = 20000}; /* so that they meet */
            pid_t one = start(&b, line[2 * k + i % 2]), other = start(&b, line[2 * k + 1 - i % 2]);
            cr_expect(await(one) == 0 && await(other) == 0);
            bool mixture = owner(&b, of) < 0;
            cr_expect(!mixture, "%s and another", line[2 * k]);
            mixed += mixture;
        }
    }
    printf("measured: %zu pairs of runs, %zu mixtures\n", pairs, mixed);
    place_clear(&b.p);
}

Test(injection, allocations) { inject(FAULT_MEMORY, sweep_whole() || getenv("NHSYM_INJECT") ? 4000 : 150); }
Test(injection, calls) { inject(FAULT_CALL, sweep_whole() || getenv("NHSYM_INJECT") ? 1200 : 150); }
Test(injection, signals) { inject(FAULT_SIGNAL, sweep_whole() || getenv("NHSYM_INJECT") ? 400 : 80); }
