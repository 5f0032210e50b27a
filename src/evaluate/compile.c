#include "evaluate/compile.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/leave.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/recovery.h"

enum { longest_path = 512 };
static const double most_seconds = 60;

struct nh_compilation {
    nh_leaving leaving; /* first member; used while there is a folder */
    /* folder: empty when it is removed */
    char folder[longest_path], source[longest_path + 16], object[longest_path + 16], message[longest_path + 16];
    const char *program;
    pid_t child;  /* process number; 0: no compiler runs */
    void *handle; /* of the loaded code */
    double begun;
    char words[320];
};

/* ---- the folder ---- */

/* Without memory, which may have ended: opendir allocates. */
static bool empty_once(const nh_compilation *c)
{
    _Alignas(struct dirent64) char list[2048];
    int folder = open(c->folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    /* an interrupted compiler leaves files of its own there */
    for (ssize_t n; folder >= 0 && (n = getdents64(folder, list, sizeof list)) > 0;)
        for (ssize_t at = 0; at < n; at += ((struct dirent64 *)(list + at))->d_reclen) {
            const char *name = ((struct dirent64 *)(list + at))->d_name;
            if (strcmp(name, ".") && strcmp(name, "..")) unlinkat(folder, name, 0);
        }
    if (folder >= 0) close(folder);
    return !rmdir(c->folder) || errno == ENOENT;
}

static void empty_folder(const nh_compilation *c)
{
    for (int tries = 0; tries < 3 && !empty_once(c); tries++) continue; /* an error of the disk may pass */
}

static void remove_folder(nh_compilation *c)
{
    if (!*c->folder) return;
    nh_leave_hold();
    nh_leave_remove(&c->leaving);
    empty_folder(c);
    *c->folder = 0;
    nh_leave_release();
}

/* The process ends early: ends the compiler and removes its folder. */
static void forget(nh_leaving *leaving)
{
    nh_compilation *c = (nh_compilation *)leaving;
    if (c->child) kill(-c->child, SIGKILL);
    empty_folder(c);
}

/* Can nobody else rename the folder's files?  The folder above is not writable to others, or it is sticky. */
static bool trustworthy(const char *path)
{
    struct stat info;
    return !stat(path, &info) && S_ISDIR(info.st_mode) &&
           (!(info.st_mode & (S_IWGRP | S_IWOTH)) || (info.st_mode & S_ISVTX)) &&
           (info.st_uid == 0 || info.st_uid == geteuid());
}

static bool still_ours(const char *path)
{
    struct stat info;
    return !lstat(path, &info) && S_ISDIR(info.st_mode) && info.st_uid == geteuid() && (info.st_mode & 0777) == 0700;
}

static bool make_folder(nh_compilation *c)
{
    const char *above = getenv("TMPDIR");
    if (!above || *above != '/') above = "/tmp";
    int length = snprintf(c->folder, sizeof c->folder, "%s/nhsym-XXXXXX", above);
    if (length >= (int)sizeof c->folder || !trustworthy(above)) {
        snprintf(c->words, sizeof c->words, "not compiled: %.200s is no folder that only its owner can rename files in",
                 above);
        *c->folder = 0;
        return false;
    }
    nh_leave_hold();
    bool made = mkdtemp(c->folder) != NULL;
    c->leaving.undo = forget;
    if (made) nh_leave_add(&c->leaving);
    nh_leave_release();
    if (!made) {
        snprintf(c->words, sizeof c->words, "not compiled: no folder can be made in %.200s: %s", above,
                 strerror(errno));
        *c->folder = 0;
        return false;
    }
    snprintf(c->source, sizeof c->source, "%s/code.c", c->folder);
    snprintf(c->object, sizeof c->object, "%s/code.so", c->folder);
    snprintf(c->message, sizeof c->message, "%s/message", c->folder);
    return true;
}

static bool write_source(nh_compilation *c, const char *text)
{
    size_t length = strlen(text);
    int file = open(c->source, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    bool good = file >= 0;
    while (good && length) {
        ssize_t n = write(file, text, length);
        if (n < 0 && errno == EINTR) continue;
        good = n > 0;
        if (good) text += n, length -= (size_t)n;
    }
    if (!good) snprintf(c->words, sizeof c->words, "not compiled: %.200s: %s", c->source, strerror(errno));
    if (file >= 0) close(file);
    return good;
}

/* ---- the compiler ---- */

/* The environment, with the compiler's own temporary files in our folder; the caller frees it and its first entry. */
static char **surroundings(const nh_compilation *c)
{
    size_t n = 0, kept = 1;
    while (environ && environ[n]) n++;
    char **out = nh_alloc_array(n + 2, sizeof *out);
    out[0] = nh_alloc(strlen(c->folder) + 8);
    sprintf(out[0], "TMPDIR=%s", c->folder);
    for (size_t i = 0; i < n; i++)
        if (strncmp(environ[i], "TMPDIR=", 7)) out[kept++] = environ[i];
    return out;
}

/* No option may change a value: no contraction to fused operations, no -ffast-math. */
static bool start(nh_compilation *c)
{
    char *const argument[] = {
        (char *)c->program, "-std=c17",           "-O2", "-w",      "-fPIC",   "-shared", "-ffp-contract=off",
        "-fno-math-errno",  "-fno-trapping-math", "-o",  c->object, c->source, "-lm",     NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    /* a process group of its own, so that the compiler's children are ended with it */
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    sigset_t none;
    sigemptyset(&none); /* this thread may block signals that another one handles */
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, 2, c->message, O_WRONLY | O_CREAT, 0600);
    char **around = surroundings(c);
    nh_leave_hold();
    int reason = posix_spawnp(&c->child, c->program, &files, &attributes, argument, around);
    if (reason) c->child = 0;
    nh_leave_release();
    nh_free(around[0]);
    nh_free(around);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (!reason) return true;
    snprintf(c->words, sizeof c->words, "not compiled: %.100s: %s", c->program, strerror(reason));
    return false;
}

typedef struct {
    nh_undo undo; /* first */
    nh_compilation *c;
} beginning;

static void give_up(nh_undo *undo) { remove_folder(((beginning *)undo)->c); }

nh_compilation *nh_compile(const char *text)
{
    nh_compilation *c = nh_alloc(sizeof *c);
    beginning b = {.undo.undo = give_up, .c = c};
    const char *wish = getenv("NHSYM_CC");
    c->program = wish ? wish : "cc";
    c->begun = nh_clock();
    snprintf(c->words, sizeof c->words, "still being compiled by %.100s", c->program);
    if (!*c->program) snprintf(c->words, sizeof c->words, "not compiled: NHSYM_CC names no compiler");
    nh_undo_add(&b.undo);
    bool good = *c->program && make_folder(c) && write_source(c, text) && start(c);
    nh_undo_remove(&b.undo);
    if (!good) remove_folder(c);
    return c;
}

static void load(nh_compilation *c)
{
    char *reason = NULL;
    if (still_ours(c->folder)) c->handle = dlopen(c->object, RTLD_NOW | RTLD_LOCAL);
    if (!c->handle) reason = dlerror();
    if (c->handle)
        snprintf(c->words, sizeof c->words, "compiled by %.100s in %.2f s", c->program, nh_clock() - c->begun);
    else
        snprintf(c->words, sizeof c->words, "not compiled: the code cannot be loaded: %.200s",
                 reason ? reason : "its folder no longer belongs to this user");
}

static void explain(nh_compilation *c, int status)
{
    char line[160] = "";
    FILE *file = fopen(c->message, "r");
    if (file && fgets(line, sizeof line, file)) line[strcspn(line, "\n")] = 0;
    if (file) fclose(file);
    if (WIFSIGNALED(status))
        snprintf(c->words, sizeof c->words, "not compiled: %.100s was ended by signal %d", c->program,
                 WTERMSIG(status));
    else
        snprintf(c->words, sizeof c->words, "not compiled: %.100s failed with status %d%s%s", c->program,
                 WEXITSTATUS(status), *line ? ": " : "", line);
}

/* Has the compiler ended?  Then its code is loaded and the folder removed. */
static bool ended(nh_compilation *c)
{
    int status = 0;
    nh_leave_hold();
    pid_t who = waitpid(c->child, &status, WNOHANG);
    bool runs = who == 0 || (who < 0 && errno == EINTR);
    if (!runs) c->child = 0;
    nh_leave_release();
    if (runs) return false; /* who < 0: another part of the program has waited for it, and its status is lost */
    if (status == 0) load(c);
    else explain(c, status);
    remove_folder(c);
    return true;
}

void *nh_compile_result(nh_compilation *c, const char *function, bool wait, bool *busy)
{
    static const struct timespec pause = {0, 1000000};
    while (c->child && !ended(c) && wait && nh_clock() - c->begun < most_seconds && !nh_interrupted())
        nanosleep(&pause, NULL);
    *busy = c->child != 0;
    return c->handle ? dlsym(c->handle, function) : NULL;
}

const char *nh_compile_words(const nh_compilation *c) { return c->words; }

void nh_compile_free(nh_compilation *c)
{
    if (!c) return;
    if (c->child) {
        kill(-c->child, SIGKILL);
        while (waitpid(c->child, NULL, 0) < 0 && errno == EINTR) continue;
        c->child = 0;
    }
    remove_folder(c);
    if (c->handle) dlclose(c->handle);
    nh_free(c);
}
