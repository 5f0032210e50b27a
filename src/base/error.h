/* error: why something failed, in words for the person who asked.
 *
 * Every fallible function takes an `nh_error *` last, returns false (or NULL) on failure and fills it once;
 * the first cause is kept.  The library never prints and never exits. */
#ifndef NH_ERROR_H
#define NH_ERROR_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

/* The values are the exit codes of the command line. */
typedef enum {
    NH_OK = 0,
    NH_REFUTED = 1,  /* the question was answered "no" */
    NH_USAGE = 2,    /* the command line is wrong */
    NH_INPUT = 3,    /* a file is wrong */
    NH_NUMERIC = 4,  /* a computation failed, for a reason that is told */
    NH_LIMIT = 5,    /* time, memory or iterations ran out */
    NH_INTERRUPTED = 130
} nh_code;

typedef struct {
    nh_code code;
    char where[256];    /* "file:line:column", or empty */
    char what[768];     /* what is wrong and what was expected */
    char hint[512];     /* what to do next, or empty */
    char excerpt[1024]; /* the source line and a caret below it, or empty */
} nh_error;

/* Make `error` say that nothing has failed. */
void nh_error_clear(nh_error *error);

/* Record a failure unless one is recorded already; returns false, so that `return nh_fail(...)` reads well.
 * `error` may be NULL. */
bool nh_fail(nh_error *error, nh_code code, const char *where, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Add what the user can do about it; ignored when a hint is there already.  Returns false. */
bool nh_error_hint(nh_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The whole message, several lines without a final newline, into `out` (always terminated). */
void nh_error_format(const nh_error *error, char *out, size_t size);

#endif
