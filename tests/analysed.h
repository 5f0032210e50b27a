/* analysed: the analysis of a system that is given as text. */
#ifndef NH_TESTS_ANALYSED_H
#define NH_TESTS_ANALYSED_H

#include <criterion/criterion.h>

#include "commands/analyze.h"
#include "scratch.h"

/* With the default options, whatever the machine's load; the caller frees it. */
static inline nh_analysis *analysed_text(const char *text)
{
    char path[SCRATCH];
    nh_error error = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    cr_assert(scratch_text(path, text));
    nh_analysis *r = nh_analysis_create(&q, &error);
    remove(path);
    cr_assert_not_null(r, "%s\n%s", error.what, text);
    return r;
}

#endif
