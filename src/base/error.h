/* error: the reason of a failure, as a message for the user.
 *
 * Every fallible function takes an `nh_error *` last, returns false (or NULL) on failure and fills it once (nhsym.h);
 * the first cause is kept.  The library never prints and never exits. */
#ifndef NH_ERROR_H
#define NH_ERROR_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "nhsym.h"

/* Record a failure unless one is recorded already; returns false, so that `return nh_fail(...)` reads well.
 * `error` may be NULL. */
bool nh_fail(nh_error *error, nh_code code, const char *where, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Add what the user can do about it; ignored when a hint is there already.  Returns false. */
bool nh_error_hint(nh_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Adds the hint "did you mean `..`?" where one of the words is near to `written`, otherwise the other hint.  Returns
 * false. */
bool nh_error_hint_near(nh_error *error, const char *written, const char *const *words, size_t count,
                        const char *otherwise);
/* Adds a hint that says why `written` is not a number: a decimal comma, or a unit behind the number.  Returns false. */
bool nh_error_hint_number(nh_error *error, const char *written);

#endif
