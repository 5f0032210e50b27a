#include "base/versions.h"

#include <cblas.h>
#include <cjson/cJSON.h>
#include <flint/flint.h>
#include <gsl/gsl_version.h>
#include <nlopt.h>
#include <stdio.h>
#include <string.h>
#include <sundials/sundials_version.h>
#include <sys/utsname.h>
#include <yaml.h>

static const char *nlopt(void)
{
    static _Thread_local char text[40];
    int major, minor, bugfix;
    nlopt_version(&major, &minor, &bugfix);
    snprintf(text, sizeof text, "%d.%d.%d", major, minor, bugfix);
    return text;
}

static const char *sundials(void)
{
    static _Thread_local char text[40];
    return SUNDIALSGetVersion(text, sizeof text) ? "unknown" : text;
}

/* "OpenBLAS 0.3.21 ..." without what follows the number. */
static const char *openblas(void)
{
    static _Thread_local char text[40];
    const char *config = openblas_get_config(), *number = config ? strpbrk(config, "0123456789") : NULL;
    if (!number) return "unknown";
    snprintf(text, sizeof text, "%.*s", (int)strcspn(number, " "), number);
    return text;
}

nh_version nh_version_of(size_t index)
{
    switch (index) {
    case 0: return (nh_version){"SUNDIALS", sundials()};
    case 1: return (nh_version){"FLINT", flint_version};
    case 2: return (nh_version){"OpenBLAS", openblas()};
    case 3: return (nh_version){"NLopt", nlopt()};
    case 4: return (nh_version){"GSL", gsl_version};
    case 5: return (nh_version){"libyaml", yaml_get_version_string()};
    case 6: return (nh_version){"cJSON", cJSON_Version()};
    default: return (nh_version){NULL, NULL};
    }
}

const char *nh_versions_machine(void)
{
    static _Thread_local char text[200];
    struct utsname u;
    if (uname(&u)) return "unknown";
    snprintf(text, sizeof text, "%.60s %.60s %.60s", u.sysname, u.release, u.machine);
    return text;
}
