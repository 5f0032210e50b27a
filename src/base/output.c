#include "base/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"

static bool failed(nh_error *error, const char *path, const char *doing, int reason)
{
    nh_fail(error, NH_NUMERIC, path, "could not be %s: %s", doing, strerror(reason));
    return nh_error_hint(error, reason == ENOENT ? "its folder must exist" : "the previous file is unchanged");
}

static int write_all(int file, const char *text, size_t length)
{
    while (length) {
        ssize_t n = write(file, text, length);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        text += n;
        length -= (size_t)n;
    }
    /* EINVAL: something that cannot be synchronised, such as a pipe */
    return fsync(file) && errno != EINVAL ? errno : 0;
}

/* A device or pipe (/dev/stdout) cannot be replaced by a rename: it is written directly. */
static bool write_directly(const char *path, const char *text, size_t length, nh_error *error)
{
    int file = open(path, O_WRONLY);
    if (file < 0) return failed(error, path, "opened", errno);
    int reason = write_all(file, text, length);
    close(file);
    return reason ? failed(error, path, "written", reason) : true;
}

int nh_output_remove(const char *path) { return unlink(path) && errno != ENOENT && unlink(path) ? errno : 0; }

static void forget(nh_leaving *leaving) { unlink(((nh_output_file *)leaving)->temporary); }

/* Makes a new file in the folder of `path`, with the permissions of the user's mask; returns -1 if that fails. */
static int create_beside(const char *path, char *name)
{
    static atomic_uint made;
    int file = -1;
    for (int tries = 0; tries < 100 && file < 0 && (!tries || errno == EEXIST); tries++) {
        unsigned own = 40503u * (unsigned)getpid() + 2654435761u * (unsigned)time(NULL) + atomic_fetch_add(&made, 1);
        snprintf(name, NH_OUTPUT_LONGEST, "%s.%06x", path, own & 0xffffff);
        file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    }
    return file;
}

/* The temporary file, opened; it is removed when the process ends early. */
static int open_beside(const char *path, nh_output_file *out)
{
    nh_leave_hold();
    int file = create_beside(path, out->temporary);
    out->leaving.undo = forget;
    if (file >= 0) nh_leave_add(&out->leaving);
    nh_leave_release();
    return file;
}

/* Writes the whole text to a temporary file beside `path` and to the disk. *direct: `path` is no regular file, and the
 * text was written to it directly. */
static bool write_beside(const char *path, const char *text, size_t length, nh_output_file *out, bool *direct,
                         nh_error *error)
{
    struct stat info;
    mode_t mode = 0; /* of the old file */
    *direct = false;
    if (!stat(path, &info)) {
        if (S_ISDIR(info.st_mode)) return failed(error, path, "written", EISDIR);
        *direct = !S_ISREG(info.st_mode);
        if (*direct) return write_directly(path, text, length, error);
        mode = info.st_mode & 0777;
    }
    if (strlen(path) + 9 > NH_OUTPUT_LONGEST) return failed(error, "", "written", ENAMETOOLONG);
    int file = open_beside(path, out);
    if (file < 0) return failed(error, path, "written", errno);
    int reason = write_all(file, text, length);
    if (!reason && mode && fchmod(file, mode)) reason = errno;
    if (close(file) && !reason) reason = errno;
    if (!reason) return true;
    nh_leave_hold();
    nh_leave_remove(&out->leaving);
    nh_output_remove(out->temporary);
    nh_leave_release();
    return failed(error, path, "written", reason);
}

bool nh_output_write(const char *path, const char *text, size_t length, nh_error *error)
{
    nh_output_set set = {0};
    bool good = nh_output_add(&set, path, text, length, error);
    return nh_output_end(&set, good, error);
}

bool nh_output_add(nh_output_set *set, const char *path, const char *text, size_t length, nh_error *error)
{
    bool direct;
    nh_output_file *file = nh_alloc(sizeof *file);
    if (!write_beside(path, text, length, file, &direct, error) || direct) {
        nh_free(file);
        return direct && (!error || error->code == NH_OK);
    }
    snprintf(file->path, sizeof file->path, "%s", path);
    file->next = set->first;
    set->first = file;
    return true;
}

void nh_output_drop(nh_output_set *set, const char *path)
{
    nh_output_file *file = nh_alloc(sizeof *file);
    snprintf(file->path, sizeof file->path, "%s", path);
    file->next = set->dropped;
    set->dropped = file;
}

/* ---- all files take their places, or none ---- */

static void folder_of(const char *path, char *folder)
{
    const char *slash = strrchr(path, '/');
    snprintf(folder, NH_OUTPUT_LONGEST, "%.*s", slash ? (int)(slash - path + (slash == path)) : 1, slash ? path : ".");
}

static int by_place(const void *a, const void *b)
{
    const nh_output_folder *x = a, *y = b;
    return x->device != y->device ? (x->device > y->device) - (x->device < y->device)
                                  : (x->inode > y->inode) - (x->inode < y->inode);
}

/* Opens the folders of the files, each once, in an order that is the same for all processes. */
static void open_folders(nh_output_set *set)
{
    for (const nh_output_file *f = set->first; f && set->folders < NH_OUTPUT_FOLDERS; f = f->next) {
        char name[NH_OUTPUT_LONGEST];
        struct stat info;
        folder_of(f->path, name);
        nh_output_folder own = {.file = open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
        if (own.file < 0) continue;
        bool known = fstat(own.file, &info) != 0;
        own.device = (uintmax_t)info.st_dev;
        own.inode = (uintmax_t)info.st_ino;
        for (size_t i = 0; i < set->folders && !known; i++) known = !by_place(&set->folder[i], &own);
        if (known) close(own.file);
        else set->folder[set->folders++] = own;
    }
    if (set->folders) qsort(set->folder, set->folders, sizeof *set->folder, by_place);
}

bool nh_output_lock(nh_output_set *set, nh_error *error)
{
    static const double patience = 60; /* seconds */
    static const struct timespec pause = {0, 10000000};
    double end = nh_clock() + patience;
    open_folders(set);
    for (size_t i = 0; i < set->folders;) {
        if (!flock(set->folder[i].file, LOCK_EX | LOCK_NB) || errno != EWOULDBLOCK) { /* it may have no locks */
            i++;
            continue;
        }
        if (nh_clock() > end) {
            nh_fail(error, NH_NUMERIC, set->first->path, "could not be written: another program holds its folder");
            return nh_error_hint(error, "the previous file is unchanged; is another run there stopped?");
        }
        nanosleep(&pause, NULL);
    }
    return true;
}

static void unlock(nh_output_set *set)
{
    for (size_t i = 0; i < set->folders; i++) close(set->folder[i].file);
    set->folders = 0;
}

static void name_aside(const nh_output_file *file, char *name)
{
    snprintf(name, NH_OUTPUT_LONGEST + 1, "%s~", file->temporary);
}

/* The new file takes its place, and the old one stays beside it.  Returns the reason of a failure. */
static int take_place(nh_output_file *file)
{
    char aside[NH_OUTPUT_LONGEST + 1];
    name_aside(file, aside);
    file->kept = !link(file->path, aside);
    /* a file system without links: the old file has no second name */
    if (!file->kept && errno != ENOENT) file->kept = !rename(file->path, aside);
    if (!file->kept && errno != ENOENT) return errno;
    file->placed = !rename(file->temporary, file->path);
    return file->placed ? 0 : errno;
}

/* Gives the old file its place back. */
static void take_back(nh_output_file *file)
{
    char aside[NH_OUTPUT_LONGEST + 1];
    name_aside(file, aside);
    if (file->kept && (!rename(aside, file->path) || !rename(aside, file->path))) nh_output_remove(aside);
    else if (!file->kept && file->placed) nh_output_remove(file->path);
    if (!file->placed) nh_output_remove(file->temporary);
}

/* All of them, and on the disk; *failed_at: the first that could not.  Returns the reason. */
static int place_all(nh_output_set *set, const char **failed_at)
{
    for (nh_output_file *f = set->first; f; f = f->next) {
        int reason = take_place(f);
        *failed_at = f->path;
        if (reason) return reason;
    }
    for (size_t i = 0; i < set->folders; i++)
        if (fsync(set->folder[i].file) && errno != EINVAL) return errno;
    return 0;
}

bool nh_output_end(nh_output_set *set, bool keep, nh_error *error)
{
    bool good = keep && (set->folders || nh_output_lock(set, error));
    char aside[NH_OUTPUT_LONGEST + 1];
    const char *at = NULL;
    nh_leave_hold(); /* all or none */
    int reason = good ? place_all(set, &at) : 0;
    if (reason) good = failed(error, at, "written", reason);
    for (nh_output_file *file; (file = set->first); nh_free(file)) {
        set->first = file->next;
        nh_leave_remove(&file->leaving);
        name_aside(file, aside);
        if (!good) take_back(file);
        else if (file->kept) nh_output_remove(aside);
    }
    for (nh_output_file *file; (file = set->dropped); nh_free(file)) {
        set->dropped = file->next;
        if (good && (reason = nh_output_remove(file->path))) keep = failed(error, file->path, "removed", reason);
    }
    unlock(set);
    nh_leave_release();
    return good && keep;
}

bool nh_output_possible(const char *path, nh_error *error)
{
    char folder[NH_OUTPUT_LONGEST];
    struct stat info;
    folder_of(path, folder);
    if (!stat(path, &info)) {
        if (S_ISDIR(info.st_mode)) return failed(error, path, "written", EISDIR);
        if (!S_ISREG(info.st_mode)) return !access(path, W_OK) || failed(error, path, "written", errno);
    }
    return !access(folder, W_OK | X_OK) || failed(error, path, "written", errno);
}
