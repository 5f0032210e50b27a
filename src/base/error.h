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
/* "did you mean `..`?" where one of the words is near to what was written, else the other hint. */
bool nh_error_hint_near(nh_error *error, const char *written, const char *const *words, size_t count,
                        const char *otherwise);
/* What keeps `written` from being a number, where it is a comma for the decimal point, or a unit behind it.  Returns
   false. */
bool nh_error_hint_number(nh_error *error, const char *written);

#endif
