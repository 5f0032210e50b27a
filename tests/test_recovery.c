/* recovery: the functions of nhsym.h return when memory ends, wherever that is, and work afterwards as before. */
#include <criterion/criterion.h>

#include <math.h>
#include <nhsym.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/recovery.h"
#include "sweep.h"

#ifdef __SANITIZE_ADDRESS__ /* what a computation had allocated when its memory ended is lost */
NH_API const char *__lsan_default_options(void);
const char *__lsan_default_options(void) { return "detect_leaks=0"; }
#endif

static const char skate[] = "name: skate\nparameters: [{name: b, value: 3}]\ncoordinates: [{name: phi, type: angle}, x, y]\n"
                            "lagrangian: x'^2 + y'^2 + phi'^2/4 + 2*b*x\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n";

static const char spring[] = "name: spring\nparameters: [{name: k, value: 2}]\ncoordinates: [x]\nlagrangian: x'^2/2 - k*x^2/2\n";

/* ---- the whole of a computation, with the n-th allocation missing ---- */

typedef char *command(nh_problem *problem, nh_error *error);

static char *analyze(nh_problem *p, nh_error *error)
{
    nh_analysis *a = nh_analyze(p, error);
    char *page = a ? nh_analysis_document(a, NH_FORMAT_HTML, error) : NULL; /* it tells the time that it took */
    char *formula = page ? nh_current_formula(a, 0, NH_SYNTAX_MATHML) : NULL;
    if (page && !formula) error->code = NH_LIMIT;
    nh_string_free(page);
    nh_analysis_free(a);
    return formula;
}

static char *simulate(nh_problem *p, nh_error *error)
{
    nh_simulation *s = nh_simulate(p, error);
    char *csv = s ? nh_simulation_document(s, NH_FORMAT_CSV, error) : NULL;
    nh_simulation_free(s);
    return csv;
}

static char *reduce(nh_problem *p, nh_error *error)
{
    nh_reduction *r = nh_reduce(p, error);
    char *text = r ? nh_reduction_document(r, NH_FORMAT_LATEX, error) : NULL;
    nh_reduction_free(r);
    return text;
}

static char *classify(nh_problem *p, nh_error *error)
{
    nh_classified *c = nh_classify_over(p, "k", false, error);
    char *text = c ? nh_classified_document(c, NH_FORMAT_TEXT, error) : NULL;
    nh_classified_free(c);
    return text;
}

static char *export(nh_problem *p, nh_error *error)
{
    nh_export *x = nh_export_functions(p, "c", "equations, submanifold", NULL, "s", error);
    char *name = NULL, *text = x ? nh_export_code(x, 0, &name, error) : NULL;
    nh_string_free(name);
    nh_export_free(x);
    return text;
}

static char *once(command *what, nh_context *context, nh_error *error)
{
    static const nh_question of_skate = {.system_text = skate, .initial = "phi=0.3, phi'=1, x'=1, y'=0.4", .until = 1, .project = true},
                             of_spring = {.system_text = spring};
    nh_problem *p = nh_problem_open(context, what == analyze || what == classify ? &of_spring : &of_skate, error);
    char *text = p ? what(p, error) : NULL;
    nh_problem_free(p);
    return text;
}

static size_t allocations(command *what, nh_context *context)
{
    nh_error error = {0};
    static const size_t many = SIZE_MAX - 1;
    nh_memory_fail_after(many);
    nh_string_free(once(what, context, &error));
    return many - nh_memory_fail_after(SIZE_MAX);
}

/* The places are spread evenly, but for the first ones, at which the file is read. */
static void lose(command *what, size_t trials)
{
    nh_context *context = nh_context_create();
    nh_error error = {0};
    char *expected = once(what, context, &error);
    cr_assert_not_null(expected, "%s", error.what);
    size_t total = allocations(what, context), refused = 0;
    trials = sweep_sanitized() ? (trials + 2) / 3 : trials;
    for (size_t i = 0; i < trials; i++) {
        nh_memory_fail_after(i % 2 ? i * total / trials : i * i);
        nh_error_clear(&error);
        char *text = once(what, context, &error);
        nh_memory_fail_after(SIZE_MAX);
        if (text) cr_assert_str_eq(text, expected); /* it was not reached */
        else {
            cr_assert_eq(error.code, NH_LIMIT, "%s", error.what);
            cr_assert(!*error.what || strstr(error.what, "out of memory"), "%s", error.what);
            refused++;
        }
        nh_string_free(text);
    }
    cr_expect_gt(2 * refused, trials, "%zu of %zu", refused, trials);
    char *again = once(what, context, &error);
    cr_assert_not_null(again, "%s", error.what);
    cr_expect_str_eq(again, expected);
    nh_string_free(again);
    nh_string_free(expected);
    nh_context_free(context);
}

Test(recovery, an_analysis_may_lose_any_allocation) { lose(analyze, 24); }
Test(recovery, a_simulation_may_lose_any_allocation) { lose(simulate, 60); }
Test(recovery, a_reduction_may_lose_any_allocation) { lose(reduce, 24); }
Test(recovery, an_export_may_lose_any_allocation) { lose(export, 24); }
Test(recovery, a_classification_may_lose_any_allocation) { lose(classify, 16); }

#ifndef __SANITIZE_ADDRESS__ /* whose own memory needs an address space without limit */
static size_t address_space(void)
{
    FILE *file = fopen("/proc/self/statm", "r");
    size_t pages = 0;
    cr_assert(file && fscanf(file, "%zu", &pages) == 1);
    fclose(file);
    return pages * 4096;
}

/* A table of a million rows needs some 100 MB. */
static char *simulate_finely(nh_context *context, nh_error *error)
{
    static const nh_question fine = {.system_text = spring, .initial = "x=1", .until = 1, .step = 1e-6};
    nh_problem *p = nh_problem_open(context, &fine, error);
    char *text = p ? simulate(p, error) : NULL;
    nh_problem_free(p);
    return text;
}

/* Too little for the buffer of OpenBLAS, which nothing has asked for yet in this process: it would wait for ever. */
Test(recovery, room_for_the_first_decomposition_may_be_missing)
{
    nh_context *context = nh_context_create();
    nh_error error = {0};
    struct rlimit before, tight;
    getrlimit(RLIMIT_AS, &before);
    tight = before;
    tight.rlim_cur = address_space() + ((size_t)1 << 26);
    cr_assert_eq(setrlimit(RLIMIT_AS, &tight), 0);
    char *text = once(analyze, context, &error);
    cr_assert_eq(setrlimit(RLIMIT_AS, &before), 0);
    cr_assert_null(text);
    cr_assert_eq(error.code, NH_LIMIT, "%s", error.what);
    cr_assert_not_null(strstr(error.what, "out of memory"), "%s", error.what);
    nh_error_clear(&error);
    text = once(analyze, context, &error);
    cr_assert_not_null(text, "%s", error.what);
    nh_string_free(text);
    nh_context_free(context);
}

/* Afterwards there is room again. */
Test(recovery, an_address_space_may_end)
{
    nh_context *context = nh_context_create();
    nh_error error = {0};
    struct rlimit before, tight;
    char *expected = once(simulate, context, &error);
    cr_assert_not_null(expected, "%s", error.what);
    getrlimit(RLIMIT_AS, &before);
    for (size_t more = 1 << 14; more < 1 << 26; more *= 4) {
        tight = before;
        tight.rlim_cur = address_space() + more;
        cr_assert_eq(setrlimit(RLIMIT_AS, &tight), 0);
        char *text = simulate_finely(context, &error);
        cr_assert_eq(setrlimit(RLIMIT_AS, &before), 0);
        cr_assert_null(text);
        cr_assert_eq(error.code, NH_LIMIT, "%s", error.what);
        cr_assert_not_null(strstr(error.what, "out of memory"), "%s", error.what);
    }
    char *again = once(simulate, context, &error);
    cr_assert_not_null(again, "%s", error.what);
    cr_expect_str_eq(again, expected);
    nh_string_free(again);
    nh_string_free(expected);
    nh_context_free(context);
}
#endif

/* ---- threads and locks ---- */

enum { jobs = 40, bad = 17 };

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static size_t ended;

static void work(size_t index, void *unused)
{
    nh_held held;
    nh_hold(&held, &lock);
    ended++;
    if (index == bad) nh_memory_ended(1234);
    nh_release(&held);
    (void)unused;
}

static void work_alone(void *unused) { work(bad, unused); }
static void release(void *unused) { (void)unused; }

static void in_parallel(void *unused) { nh_parallel(jobs, 4, work, unused); }
static void aside(void *unused) { nh_aside_end(nh_aside_begin(work_alone, unused)); }
static void interruptible(void *unused) { nh_interruptible(work_alone, release, unused); }

static void two_deep(void *unused)
{
    nh_held held;
    nh_hold(&held, &lock);
    nh_release(&held);
    cr_expect_not(nh_recovery_run(in_parallel, unused));
    in_parallel(unused);
}

/* What a thread of ours cannot do ends the caller's run, after all of them have ended; no lock stays held. */
Test(recovery, threads_hand_it_on)
{
    void (*const way[])(void *) = {work_alone, in_parallel, aside, interruptible, two_deep};
    for (size_t i = 0; i < sizeof way / sizeof *way; i++) {
        cr_expect_not(nh_recovery_run(way[i], NULL), "%zu", i);
        cr_expect_eq(nh_recovery_wanted(), 1234u);
        cr_expect_not(nh_recovery_here());
        cr_expect_eq(nh_parallel_worker(), 0u);
        cr_assert_eq(pthread_mutex_trylock(&lock), 0, "%zu", i);
        pthread_mutex_unlock(&lock);
        cr_expect_gt(ended, 0u);
        ended = 0;
    }
    cr_expect(nh_recovery_lost());
}

static void undo_nothing(nh_undo *undo) { undo->number = 0; }

static void end_after_removals(void *undo)
{
    nh_undo *u = undo;
    for (size_t i = 0; i < 4; i++) {
        u[i].undo = undo_nothing;
        nh_undo_add(&u[i]);
    }
    nh_undo_remove(&u[1]);
    nh_undo_remove(&u[3]);
    nh_memory_ended(1);
}

/* In any order, and only what began within the run. */
Test(recovery, what_was_removed_is_not_undone)
{
    nh_undo u[4], outside = {.undo = undo_nothing};
    nh_undo_add(&outside);
    cr_expect_not(nh_recovery_run(end_after_removals, u));
    cr_expect_eq(u[0].number, 0u);
    cr_expect_neq(u[1].number, 0u);
    cr_expect_eq(u[2].number, 0u);
    cr_expect_neq(u[3].number, 0u);
    cr_expect_neq(outside.number, 0u);
    nh_undo_remove(&outside);
}
