#include "base/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool failed(nh_error *error, const char *path, const char *doing, int reason)
{
    nh_fail(error, NH_NUMERIC, path, "could not be %s: %s", doing, strerror(reason));
    return nh_error_hint(error, "what was there before is unchanged");
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
    return fsync(file) && errno != EINVAL ? errno : 0; /* EINVAL: something that cannot be synchronised, such as a pipe */
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

bool nh_output_write(const char *path, const char *text, size_t length, nh_error *error)
{
    char temporary[4200];
    struct stat info;
    mode_t mode = 0644;
    if (!stat(path, &info)) {
        if (!S_ISREG(info.st_mode)) return S_ISDIR(info.st_mode) ? failed(error, path, "written", EISDIR) : write_directly(path, text, length, error);
        mode = info.st_mode & 0777;
    }
    if (strlen(path) > 4096) return failed(error, "", "written", ENAMETOOLONG);
    snprintf(temporary, sizeof temporary, "%s.XXXXXX", path);
    int file = mkstemp(temporary);
    if (file < 0) return failed(error, path, "written", errno);
    int reason = write_all(file, text, length);
    if (!reason && fchmod(file, mode)) reason = errno;
    if (close(file) && !reason) reason = errno;
    if (!reason && rename(temporary, path)) reason = errno;
    if (!reason) return true;
    unlink(temporary);
    return failed(error, path, "written", reason);
}
