/* program: run the built program as a user would, in a folder of its own, and see what it prints and returns.
 *
 * The program is $NHSYM (build/nhsym without it), seen from the top folder of the project, where the tests run. */
#ifndef NH_TESTS_PROGRAM_H
#define NH_TESTS_PROGRAM_H

#include <criterion/criterion.h>

#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct {
    char folder[PATH_MAX];  /* where the program runs: a temporary folder */
    char program[PATH_MAX];
    char project[PATH_MAX]; /* the top folder of the project */
} place;

typedef struct {
    int code;         /* exit code; 1000 + number when a signal ended it */
    char *out, *err;  /* what it printed */
} finished;

/* How it is run, besides its arguments. */
typedef struct {
    const char *const *environment; /* NAME=VALUE or NAME (to remove it), NULL at the end */
    bool terminal;    /* standard output is a terminal */
    bool powerless;   /* as a user without rights: root is not stopped by permissions */
    long file_limit;  /* bytes that a file may have; 0: any number */
} manner;

/* ---- folders and files ---- */

static inline place place_make(void)
{
    place p;
    const char *tmp = getenv("TMPDIR"), *program = getenv("NHSYM");
    snprintf(p.folder, sizeof p.folder, "%.200s/nhsym-test-XXXXXX", tmp && *tmp ? tmp : "/tmp");
    cr_assert_not_null(mkdtemp(p.folder), "no temporary folder %s", p.folder);
    cr_assert_eq(chmod(p.folder, 0755), 0);
    cr_assert_not_null(realpath(program && *program ? program : "build/nhsym", p.program), "there is no program %s; set NHSYM",
                       program && *program ? program : "build/nhsym");
    cr_assert_not_null(getcwd(p.project, sizeof p.project));
    cr_assert_eq(access("systems/sleigh.yaml", R_OK), 0, "run the tests from the top folder of the project");
    return p;
}

/* A place where the shipped systems and analyses are found by name. */
static inline place place_with_systems(void)
{
    place p = place_make();
    char link[PATH_MAX + 20], path[PATH_MAX + 20];
    const char *folders[] = {"systems", "analyses"};
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%.4000s/%s", p.project, folders[i]);
        snprintf(link, sizeof link, "%.4000s/%s", p.folder, folders[i]);
        cr_assert_eq(symlink(path, link), 0);
    }
    return p;
}

static inline int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *walk)
{
    (void)info;
    (void)kind;
    (void)walk;
    return remove(path);
}

static inline void place_clear(place *p) { nftw(p->folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS); }

static inline char *read_stream(FILE *file)
{
    size_t n = 0, size = 1 << 16;
    char *text = malloc(size);
    for (size_t k; (k = fread(text + n, 1, size - n - 1, file)) > 0;) {
        n += k;
        if (size - n < 2) text = realloc(text, size *= 2);
    }
    text[n] = 0;
    return text;
}

/* A file of the place's folder, or NULL. */
static inline char *read_here(const place *p, const char *name)
{
    char path[PATH_MAX + 300];
    snprintf(path, sizeof path, "%s/%s", p->folder, name);
    FILE *file = fopen(path, "r");
    if (!file) return NULL;
    char *text = read_stream(file);
    fclose(file);
    return text;
}

static inline void write_here(const place *p, const char *name, const char *text)
{
    char path[PATH_MAX + 300];
    snprintf(path, sizeof path, "%s/%s", p->folder, name);
    FILE *file = fopen(path, "w");
    cr_assert(file && fputs(text, file) >= 0 && fclose(file) == 0, "%s could not be written", path);
}

static inline void unlink_here(const place *p, const char *name)
{
    char path[PATH_MAX + 300];
    snprintf(path, sizeof path, "%s/%s", p->folder, name);
    unlink(path);
}

static inline void folder_here(const place *p, const char *name, mode_t mode)
{
    char path[PATH_MAX + 300];
    snprintf(path, sizeof path, "%s/%s", p->folder, name);
    mkdir(path, 0755);
    cr_assert_eq(chmod(path, mode), 0);
}

/* ---- running ---- */

static inline void set_environment(const manner *how)
{
    static const char *const ours[] = {"NHSYM_PATH", "NO_COLOR", "MAKEFLAGS", "MAKELEVEL", "MFLAGS", NULL};
    for (size_t i = 0; ours[i]; i++) unsetenv(ours[i]);
    for (size_t i = 0; how->environment && how->environment[i]; i++)
        if (strchr(how->environment[i], '=')) putenv((char *)how->environment[i]);
        else unsetenv(how->environment[i]);
}

/* In the child: become what `how` says, and the program. */
static inline void become(const place *p, const manner *how, char **argument, int out, int err)
{
    set_environment(how);
    if (how->file_limit) {
        signal(SIGXFSZ, SIG_IGN); /* writing fails instead of killing */
        setrlimit(RLIMIT_FSIZE, &(struct rlimit){(rlim_t)how->file_limit, (rlim_t)how->file_limit});
    }
    int nothing = open("/dev/null", O_RDONLY);
    if (chdir(p->folder) || dup2(nothing, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0) _exit(126);
    if (how->powerless && geteuid() == 0 && setuid(65534)) _exit(126);
    execvp(argument[0], argument);
    _exit(127);
}

/* A terminal gives its output only while it is being read. */
static inline char *read_terminal(int master)
{
    size_t n = 0, size = 1 << 20;
    char *text = malloc(size);
    for (ssize_t k; n + 1 < size && (k = read(master, text + n, size - n - 1)) > 0;) n += (size_t)k;
    text[n] = 0;
    return text;
}

static inline bool terminals_exist(void)
{
    int master = posix_openpt(O_RDWR | O_NOCTTY);
    bool usable = master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0 && ptsname(master);
    if (master >= 0) close(master);
    return usable;
}

static inline finished run_vector(const place *p, const manner *how, char **argument)
{
    finished f = {0};
    FILE *out = tmpfile(), *err = tmpfile();
    int master = how->terminal ? posix_openpt(O_RDWR | O_NOCTTY) : -1, slave = fileno(out), status = 0;
    if (how->terminal) {
        cr_assert(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0, "no pseudo-terminal");
        slave = open(ptsname(master), O_RDWR | O_NOCTTY);
    }
    fflush(NULL);
    pid_t child = fork();
    cr_assert_geq(child, 0);
    if (child == 0) become(p, how, argument, slave, fileno(err));
    if (how->terminal) {
        close(slave);
        f.out = read_terminal(master);
        close(master);
    }
    waitpid(child, &status, 0);
    f.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    rewind(out);
    rewind(err);
    if (!f.out) f.out = read_stream(out);
    f.err = read_stream(err);
    fclose(out);
    fclose(err);
    cr_assert_neq(f.code, 127, "%s cannot be run", argument[0]);
    cr_assert_null(strstr(f.err, "Sanitizer"), "%s", f.err);
    return f;
}

/* A line that was folded at 80 columns, with deeper lines after it, as one line again: the first word of each did not fit on the line before. */
static inline void unfold(char *text)
{
    size_t base = strspn(text, " "), columns = 0;
    char *to = text;
    for (const char *from = text; *from;) {
        size_t indent = strspn(from + 1, " "), word = strcspn(from + 1 + indent, " \n");
        bool folded = *from == '\n' && indent > base && columns + 1 + word > 80;
        if (folded) {
            *to++ = ' ';
            from += 1 + indent;
            columns = indent;
            continue;
        }
        if (*from == '\n') base = indent;
        columns = *from == '\n' ? 0 : columns + ((*from & 0xc0) != 0x80); /* of UTF-8 */
        *to++ = *from++;
    }
    *to = 0;
}

static inline void finished_clear(finished *f)
{
    free(f->out);
    free(f->err);
}

/* Where a user without rights can read it too, if the project lies in root's own folder: a copy of a file in the place. */
static inline void copy_here(const place *p, const char *path, const char *name)
{
    char to[PATH_MAX + 300];
    snprintf(to, sizeof to, "%s/%s", p->folder, name);
    finished f = run_vector(p, &(manner){0}, (char *[]){"cp", (char *)path, to, NULL});
    cr_assert_eq(f.code, 0, "%s", f.err);
    finished_clear(&f);
}

/* Likewise the program: the copy is run from now on. */
static inline void copy_program(place *p)
{
    copy_here(p, p->program, "nhsym");
    snprintf(p->program, sizeof p->program, "%.4000s/nhsym", p->folder);
}

enum { most_words = 32 };

/* Words separated by blanks, cut in place. */
static inline void cut_words(char *line, char **argument, size_t n)
{
    for (char *word = strtok(line, " "); word; word = strtok(NULL, " ")) {
        cr_assert_lt(n, (size_t)most_words - 1);
        argument[n++] = word;
    }
    argument[n] = NULL;
}

/* Run the program with the words of `line`. */
static inline finished run_so(const place *p, const manner *how, const char *line)
{
    char copy[4096], *argument[most_words] = {(char *)p->program};
    snprintf(copy, sizeof copy, "%s", line);
    cut_words(copy, argument, 1);
    return run_vector(p, how, argument);
}

static inline finished run(const place *p, const char *line) { return run_so(p, &(manner){0}, line); }

/* Run and check the exit code; what it printed is in the message. */
static inline finished run_expecting(const place *p, const char *line, int code)
{
    finished f = run(p, line);
    cr_expect_eq(f.code, code, "nhsym %s: exit code %d, expected %d\n%s%s", line, f.code, code, f.out, f.err);
    return f;
}

#endif
