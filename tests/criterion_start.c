/* Linked to every test. */
#include <criterion/hooks.h>
#include "sweep.h"

char sweep_plain_only[] = "not under sanitizers";

#ifdef __SANITIZE_ADDRESS__
bool sweep_sanitized(void) { return true; }
#else
bool sweep_sanitized(void) { return false; }
#endif

/* `make check-all` runs what is disabled otherwise. */
ReportHook(PRE_ALL)(struct criterion_test_set *all)
{
    FOREACH_SET(struct criterion_suite_set *suite, all->suites)
    {
        FOREACH_SET(struct criterion_test *test, suite->tests)
        {
            if (sweep_whole()) test->data->disabled = false;
            else if (test->data->data == sweep_plain_only && sweep_sanitized()) test->data->disabled = true;
        }
    }
}

/* Criterion starts libgit2, with which it can show two texts side by side, in each process, and
 * libgit2 then reads all certificates of the system: half of the time that a process takes to start, a test being one.
 * The tests compare texts by assertions that need none of it, so that nothing is started. */
#define SEEN_BY_CRITERION __attribute__((visibility("default")))
SEEN_BY_CRITERION int git_libgit2_init(void);
SEEN_BY_CRITERION int git_libgit2_shutdown(void);

int git_libgit2_init(void) { return 1; /* how often it was started */ }
int git_libgit2_shutdown(void) { return 0; }
