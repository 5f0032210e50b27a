#include "motion/sundials.h"

#include <stdio.h>
#include <string.h>
#include <sundials/sundials_types.h>
#if NH_SUNDIALS_SINCE(7, 0)
#include <sundials/sundials_logger.h>
#endif

_Static_assert(sizeof(sunrealtype) == sizeof(double), "SUNDIALS must be built for double precision");

static void keep(nh_sundials *s, int code, const char *message)
{
    if (code < 0) snprintf(s->message, sizeof s->message, "%s", message);
}

#if NH_SUNDIALS_SINCE(7, 0)

static void hear(int line, const char *function, const char *file, const char *message, SUNErrCode code, void *user,
                 SUNContext context)
{
    (void)line, (void)function, (void)file, (void)context;
    keep(user, code, message);
}

bool nh_sundials_open(nh_sundials *s)
{
    *s = (nh_sundials){0};
    SUNLogger logger = NULL; /* it would print warnings */
    return SUNContext_Create(SUN_COMM_NULL, &s->context) == 0 && SUNContext_ClearErrHandlers(s->context) == 0 &&
           SUNContext_PushErrHandler(s->context, hear, s) == 0 && SUNContext_GetLogger(s->context, &logger) == 0 &&
           SUNLogger_SetWarningFilename(logger, "/dev/null") == 0;
}

#else

void nh_sundials_keep(int code, const char *module, const char *function, char *message, void *s)
{
    (void)module, (void)function;
    keep(s, code, message);
}

bool nh_sundials_open(nh_sundials *s)
{
    *s = (nh_sundials){0};
    return SUNContext_Create(NULL, &s->context) == 0;
}

#endif

bool nh_sundials_fail(const nh_sundials *s, nh_error *error)
{
    const char *why = s->message[0] ? s->message : "out of memory";
    nh_code code = strstr(why, "memory request failed") || why != s->message ? NH_LIMIT : NH_NUMERIC;
    return nh_fail(error, code, "", "the integrator cannot be set up: %s", why);
}

void nh_sundials_close(nh_sundials *s) { SUNContext_Free(&s->context); }
