/* pdf: a picture as PDF, by the program rsvg-convert of librsvg.
 *
 * The program, and not the library itself, because every short command would have to load the library's two dozen
 * dependencies. */
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/cli.h"

extern char **environ;

#define INSTALL "install it (Debian: apt-get install librsvg2-bin), or write the picture by --svg"
static const char converter[] = "rsvg-convert";

/* Its exit status; -1, with errno, when it could not be started. */
static int convert(FILE *svg, FILE *pdf)
{
    char *const argument[] = {(char *)converter, "--format=pdf", NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t none;
    pid_t child;
    int status = 0;
    setenv("SOURCE_DATE_EPOCH", "0", 0); /* no date of today in the file */
    sigemptyset(&none);                  /* this thread may block signals that another one handles */
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, fileno(svg), 0);
    posix_spawn_file_actions_adddup2(&files, fileno(pdf), 1);
    int reason = posix_spawnp(&child, converter, &files, &attributes, argument, environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (reason) return errno = reason, -1;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

static bool read_all(FILE *file, nh_text *out)
{
    char piece[4096];
    rewind(file);
    for (size_t n; (n = fread(piece, 1, sizeof piece, file)) > 0;) nh_text_add_n(out, piece, n);
    return !ferror(file) && out->length > 0;
}

bool nh_cli_pdf_possible(nh_error *error)
{
    const char *path = getenv("PATH");
    char file[PATH_MAX];
    for (const char *at = path ? path : ""; *at; at += *at == ':') {
        int length = (int)strcspn(at, ":");
        snprintf(file, sizeof file, "%.*s/%s", length, length ? at : ".", converter);
        if (!access(file, X_OK)) return true;
        at += length;
    }
    nh_fail(error, NH_NUMERIC, "--pdf", "there is no program %s, which makes a PDF of a picture", converter);
    return nh_error_hint(error, INSTALL);
}

bool nh_cli_pdf(const nh_text *svg, nh_text *out, nh_error *error)
{
    FILE *in = tmpfile(), *made = tmpfile();
    bool files = in && made && fwrite(nh_text_string(svg), 1, svg->length, in) == svg->length && !fflush(in) &&
                 lseek(fileno(in), 0, SEEK_SET) == 0;
    int status = files ? convert(in, made) : -1;
    const char *why = status < 0 ? strerror(errno) : NULL;
    bool good = status == 0 && read_all(made, out);
    if (in) fclose(in);
    if (made) fclose(made);
    if (good) return true;
    if (!files) return nh_fail(error, NH_NUMERIC, "--pdf", "no temporary file could be written: %s", why);
    if (why) nh_fail(error, NH_NUMERIC, "--pdf", "the program %s cannot be run: %s", converter, why);
    else nh_fail(error, NH_NUMERIC, "--pdf", "the program %s failed with status %d", converter, status);
    return nh_error_hint(error, INSTALL);
}
