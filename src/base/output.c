#include "base/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

static void forget(nh_leaving *leaving) { unlink(((nh_output_file *)leaving)->temporary); }

/* The temporary file, opened; it is removed when the process ends early. */
static int open_beside(const char *path, nh_output_file *out)
{
    nh_leave_hold();
    snprintf(out->temporary, NH_OUTPUT_LONGEST, "%s.XXXXXX", path);
    int file = mkstemp(out->temporary);
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
    mode_t mode = 0644;
    *direct = false;
    if (!stat(path, &info)) {
        if (S_ISDIR(info.st_mode)) return failed(error, path, "written", EISDIR);
        *direct = !S_ISREG(info.st_mode);
        if (*direct) return write_directly(path, text, length, error);
        mode = info.st_mode & 0777;
    }
    if (strlen(path) + 8 > NH_OUTPUT_LONGEST) return failed(error, "", "written", ENAMETOOLONG);
    int file = open_beside(path, out);
    if (file < 0) return failed(error, path, "written", errno);
    int reason = write_all(file, text, length);
    if (!reason && fchmod(file, mode)) reason = errno;
    if (close(file) && !reason) reason = errno;
    if (!reason) return true;
    nh_leave_hold();
    nh_leave_remove(&out->leaving);
    unlink(out->temporary);
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

bool nh_output_end(nh_output_set *set, bool keep, nh_error *error)
{
    nh_leave_hold(); /* all or none */
    for (nh_output_file *file; (file = set->first); nh_free(file)) {
        set->first = file->next;
        nh_leave_remove(&file->leaving);
        int reason = keep && rename(file->temporary, file->path) ? errno : 0;
        if (!keep || reason) unlink(file->temporary);
        if (reason) keep = failed(error, file->path, "written", reason);
    }
    bool good = keep;
    for (nh_output_file *file; (file = set->dropped); nh_free(file)) {
        set->dropped = file->next;
        if (keep && unlink(file->path) && errno != ENOENT) good = failed(error, file->path, "removed", errno);
    }
    nh_leave_release();
    return good;
}

bool nh_output_possible(const char *path, nh_error *error)
{
    char folder[NH_OUTPUT_LONGEST];
    struct stat info;
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path + (slash == path)) : 1, slash ? path : ".");
    if (!stat(path, &info)) {
        if (S_ISDIR(info.st_mode)) return failed(error, path, "written", EISDIR);
        if (!S_ISREG(info.st_mode)) return !access(path, W_OK) || failed(error, path, "written", errno);
    }
    return !access(folder, W_OK | X_OK) || failed(error, path, "written", errno);
}
