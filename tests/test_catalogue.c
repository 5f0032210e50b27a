/* Every system that is shipped, analysed without an analysis file: nothing known is missing, nothing false is reported. */
#include <criterion/criterion.h>

#include "catalogue.h"

/* Sanitizers slow the search down many times: time must not decide what is found. */
static const double patience = 600;

Test(catalogue, finds_what_is_known_and_nothing_false)
{
    char *name[most_files];
    size_t n = list("systems", name);
    cr_assert_geq(n, 1);
    for (size_t i = 0; i < n; i++) {
        row o = compare_file("systems", name[i], 0, patience);
        cr_expect_eq(o.missing, 0, "%s: %s", name[i], o.names);
        cr_expect_eq(o.wrong, 0, "%s: %s", name[i], o.names);
        cr_expect_leq(o.found, o.maximum, "%s reports %zu independent currents of at most %zu", name[i], o.found, o.maximum);
        free(name[i]);
    }
}
