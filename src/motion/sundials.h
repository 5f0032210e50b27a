/* sundials: a context for an integrator of SUNDIALS, versions 6 and 7, that keeps messages instead of printing them. */
#ifndef NH_SUNDIALS_H
#define NH_SUNDIALS_H

#include <stdbool.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>

#include "base/error.h"

#define NH_SUNDIALS_SINCE(major, minor)                                                                                \
    (SUNDIALS_VERSION_MAJOR > (major) || (SUNDIALS_VERSION_MAJOR == (major) && SUNDIALS_VERSION_MINOR >= (minor)))

typedef struct nh_sundials {
    SUNContext context;
    char message[200]; /* the last error message, empty when there is none */
} nh_sundials;

/* s must not move until it is closed, after everything that was made in its context.  False when there is no memory. */
bool nh_sundials_open(nh_sundials *s);
void nh_sundials_close(nh_sundials *s);
/* Records that an integrator cannot be set up, and why; returns false. */
bool nh_sundials_fail(const nh_sundials *s, nh_error *error);

/* Before version 7 every integrator has a handler of its own: nh_sundials_listen(CVode, memory, s) for
   CVodeSetErrHandlerFn, true when it is set. */
#if NH_SUNDIALS_SINCE(7, 0)
#define nh_sundials_listen(package, memory, s) ((void)(memory), (void)(s), true)
#else
void nh_sundials_keep(int code, const char *module, const char *function, char *message, void *s);
#define nh_sundials_listen(package, memory, s) (package##SetErrHandlerFn(memory, nh_sundials_keep, s) == 0)
#endif

#endif
