/* budget: work is counted, the same whoever does it, and what a search says about its end is so. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>
#include <time.h>

#include "base/budget.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "commands/analyze.h"

#include "sweep.h"

static void add(size_t index, void *context)
{
    (void)context;
    nh_work_add(NH_WORK_VALUE, (double)(1000 * (index + 1)));
}

Test(budget, is_the_same_for_every_number_of_threads)
{
    double used[3];
    for (size_t threads = 1; threads <= 3; threads++) {
        nh_budget_begin(1);
        nh_parallel(60, threads, add, NULL);
        used[threads - 1] = nh_budget_used();
    }
    nh_budget_begin(INFINITY);
    cr_expect_gt(used[0], 0);
    cr_expect(used[0] == used[1] && used[1] == used[2]);
}

Test(budget, ends)
{
    nh_budget_begin(1);
    double fits = 1 / nh_work_millions(NH_WORK_NODE, 1);
    cr_expect(!nh_budget_spent() && nh_budget_allows(NH_WORK_NODE, fits / 2) && !nh_budget_allows(NH_WORK_NODE, 2 * fits));
    nh_work_add(NH_WORK_NODE, fits / 2);
    cr_expect(!nh_budget_spent() && fabs(nh_budget_part() - 0.5) < 0.01);
    nh_work_add(NH_WORK_NODE, fits);
    cr_expect(nh_budget_spent());
    nh_budget_begin(INFINITY);
    nh_work_add(NH_WORK_NODE, 1e12);
    cr_expect(!nh_budget_spent() && nh_budget_part() == 0);
    nh_budget_begin(INFINITY);
}

/* A process that waits, as one does on a busy machine, is not late: only one that has computed for so long. */
Test(budget, the_brake_counts_the_processor)
{
    static const struct timespec pause = {0, 150000000};
    double before = nh_clock_of_process();
    nh_deadline_set(0.05);
    nanosleep(&pause, NULL);
    bool late = nh_late();
    cr_expect(!late || nh_clock_of_process() > before + 0.05); /* a busy machine may count its own work as the test's */
    for (double begin = nh_clock_of_process(); nh_clock_of_process() < begin + 0.06;) continue;
    cr_expect(nh_late());
    nh_deadline_set(INFINITY);
    cr_expect_not(nh_late());
}

static nh_analysis *search(const char *system, double work, double seconds, double threads, double stage_columns)
{
    nh_error error;
    nh_error_clear(&error);
    nh_request q = {.system_path = system};
    nh_options_default(&q.options);
    q.options.work = work;
    q.options.max_seconds = seconds;
    q.options.threads = threads;
    q.options.stage_columns = stage_columns;
    nh_analysis *r = nh_analysis_create(&q, &error);
    cr_assert_not_null(r, "%s: %s", system, error.what);
    return r;
}

/* All that was tried and found. */
static bool same(const nh_analysis *a, const nh_analysis *b)
{
    bool equal = a->stages == b->stages && a->list->count == b->list->count && a->search == b->search && a->verdict == b->verdict && a->partial == b->partial;
    for (size_t i = 0; i < a->stages && equal; i++) {
        const nh_stage_record *s = &a->stage[i], *t = &b->stage[i];
        equal = !strcmp(s->name, t->name) && s->columns == t->columns && s->dimension == t->dimension && s->found == t->found && s->skipped == t->skipped && s->limit.value == t->limit.value;
    }
    return equal;
}

Test(budget, ends_a_search_at_the_same_place_with_any_threads, PLAIN_ONLY)
{
    size_t i = 0;
    for (double work = 5; work < 1000; work *= 4) {
        if (!sweep_tries(i++, 4, 4)) continue;
        nh_analysis *a = search("systems/car_with_trailer.yaml", work, 1e6, 1, 330), *b = search("systems/car_with_trailer.yaml", work, 1e6, 3, 330);
        cr_expect(same(a, b), "%g", work);
        cr_expect(a->partial && a->search == NH_SEARCH_CUT && a->verdict != NH_NONE, "%g", work);
        nh_analysis_free(a);
        nh_analysis_free(b);
    }
}

Test(budget, finds_nothing_is_not_none, PLAIN_ONLY)
{
    nh_analysis *late = search("systems/crane.yaml", 1e4, 0.01, 1, 330), *poor = search("systems/crane.yaml", 1, 1e6, 1, 330);
    for (int i = 0; i < 2; i++) {
        const nh_analysis *r = i ? poor : late;
        cr_expect_eq(r->search, NH_SEARCH_CUT);
        cr_expect_neq(r->verdict, NH_NONE);
        cr_expect(r->partial);
        cr_expect_gt(r->warnings, 0);
    }
    nh_analysis_free(late);
    nh_analysis_free(poor);
}

/* The option that a stage names brings it in. */
Test(budget, names_what_brings_a_stage_in)
{
    double needed = 0;
    const char *name = NULL;
    nh_analysis *r = search("systems/double_pendulum.yaml", 1e4, 1e6, 1, 12), *wider = NULL;
    for (size_t i = 0; i < r->stages && !name; i++)
        if (r->stage[i].skipped && !strcmp(r->stage[i].limit.option, "stage_columns")) name = r->stage[i].name, needed = r->stage[i].limit.value;
    cr_assert_not_null(name);
    cr_expect_eq(r->search, NH_SEARCH_EXHAUSTED);
    cr_expect(!r->partial);
    cr_expect_gt(needed, 12);
    wider = search("systems/double_pendulum.yaml", 1e4, 1e6, 1, needed);
    for (size_t i = 0; i < wider->stages; i++) cr_expect(strcmp(wider->stage[i].name, name) || !wider->stage[i].skipped);
    nh_analysis_free(r);
    nh_analysis_free(wider);
}

Test(budget, complete_is_not_exhausted, PLAIN_ONLY)
{
    nh_analysis *all = search("systems/free_particle.yaml", 1e4, 1e6, 1, 330);
    cr_expect_eq(all->search, all->list->independent == all->question->local_maximum ? NH_SEARCH_COMPLETE : NH_SEARCH_EXHAUSTED);
    cr_expect_eq(all->list->independent, all->question->local_maximum);
    nh_analysis_free(all);
}
