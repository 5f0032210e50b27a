/* sizes: what is found does not end with the number of coordinates. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/text.h"
#include "graph/print.h"
#include "scratch.h"
#include "sweep.h"
#include "commands/analyze.h"

/* The search alone: a motion would only take time. */
static nh_analysis *search(nh_text *text, double work)
{
    char path[SCRATCH];
    nh_error error;
    nh_error_clear(&error);
    cr_assert(scratch_text(path, nh_text_string(text)));
    nh_text_clear(text);
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6;
    q.options.steps = 10;
    if (work > 0) q.options.work = work;
    nh_analysis *r = nh_analysis_create(&q, &error);
    unlink(path);
    cr_assert_not_null(r, "%s %s", error.where, error.what);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.proved || r->list->found[k].proof.digits >= r->question->options.digits, "%zu coordinates, %s", r->question->model->m, r->list->found[k].name);
    return r;
}

static void coordinates(nh_text *text, size_t n, const char *names)
{
    nh_text_init(text);
    nh_text_add(text, "name: many\nparameters: [{name: m, value: 0.7}, {name: k, value: 1.3}]\ncoordinates: [");
    for (size_t i = 1; i <= n; i++)
        for (const char *c = names; *c; c++) nh_text_addf(text, "%s%c%zu", i > 1 || c > names ? ", " : "", *c, i);
    nh_text_add(text, "]\nlagrangian: ");
}

static bool meant(const nh_analysis *r, const char *words)
{
    bool any = false;
    for (size_t k = 0; k < r->list->count; k++) any |= strstr(r->list->found[k].meaning, words) != NULL;
    return any;
}

/* Of different frequencies: the energy and the phase of each. */
Test(sizes, oscillators, PLAIN_ONLY)
{
    static const size_t sizes[] = {4, 5, 6, 8, 12};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        if (!sweep_tries(s, 3, 16)) continue;
        nh_text text;
        coordinates(&text, sizes[s], "x");
        for (size_t i = 1; i <= sizes[s]; i++) nh_text_addf(&text, "%sm*x%zu'^2/2 - %.3f*x%zu^2/2", i > 1 ? " + " : "", i, (double)i + sqrt((double)i), i);
        nh_text_add(&text, "\n");
        nh_analysis *r = search(&text, 0);
        cr_expect_eq(r->list->independent, 2 * sizes[s], "%zu of %zu", r->list->independent, 2 * sizes[s]);
        cr_expect_eq(r->verdict, NH_FOUND);
        cr_expect_eq(r->search, NH_SEARCH_COMPLETE);
        nh_analysis_free(r);
    }
}

/* Many, and fewer in a sample. */
static size_t many(void) { return sweep_whole() ? 40 : sweep_sanitized() ? 6 : 10; }

/* In blocks of two each, and what is said about each takes no more than it has to: half of what may be computed is enough for all. */
Test(sizes, many_oscillators, PLAIN_ONLY)
{
    size_t n = many();
    nh_text text;
    coordinates(&text, n, "x");
    for (size_t i = 1; i <= n; i++) nh_text_addf(&text, "%sm*x%zu'^2/2 - %.3f*x%zu^2/2", i > 1 ? " + " : "", i, (double)i + sqrt((double)i), i);
    nh_text_add(&text, "\n");
    nh_analysis *r = search(&text, 125 * (double)n);
    cr_expect_eq(r->list->independent, 2 * n, "%zu of %zu", r->list->independent, 2 * n);
    cr_expect_eq(r->search, NH_SEARCH_COMPLETE);
    cr_expect(meant(r, "energy"));
    nh_analysis_free(r);
}

static void chain(nh_text *text, size_t n, bool closed)
{
    coordinates(text, n, "x");
    for (size_t i = 1; i <= n; i++) nh_text_addf(text, "%sm*x%zu'^2/2", i > 1 ? " + " : "", i);
    for (size_t i = 1; i < n; i++) nh_text_addf(text, " - k*(x%zu - x%zu)^2/2", i + 1, i);
    if (closed) nh_text_addf(text, " - k*(x1 - x%zu)^2/2\n", n);
    else nh_text_addf(text, " - k*x1^2/2 - k*x%zu^2/2\n", n);
}

Test(sizes, chains, WHOLE_ONLY)
{
    static const size_t sizes[] = {6, 8, 10};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        if (!sweep_tries(s, 3, 16)) continue;
        nh_text text;
        chain(&text, sizes[s], false);
        nh_analysis *r = search(&text, 0);
        cr_expect_eq(r->list->independent, 2 * sizes[s], "%zu of %zu", r->list->independent, 2 * sizes[s]);
        nh_analysis_free(r);
    }
}

/* The total momentum, the centre of mass, the energy. */
Test(sizes, ring_of_many, WHOLE_ONLY)
{
    static const char *const wanted[] = {"m*(x1' + ", "m*(t*(x1' + "};
    nh_text text;
    chain(&text, many(), true);
    nh_analysis *r = search(&text, 1500);
    cr_expect(meant(r, "energy"));
    for (size_t i = 0; i < 2; i++) {
        bool any = false;
        for (size_t k = 0; k < r->list->count; k++) {
            char *phi = nh_print_string(r->question->model->dag, r->list->found[k].phi);
            any |= strstr(phi, wanted[i]) != NULL;
            nh_free(phi);
        }
        cr_expect(any, "%s", wanted[i]);
    }
    nh_analysis_free(r);
}

/* Pendula that hold each other, with default options: nothing but the energy, everything is tried, and no part of the search takes what it cannot use: of 40
 * coordinates the series of a count would be gigabytes, products of all waves fill lists that no stage may have, and no state can be integrated alone. */
Test(sizes, ring_of_pendula, PLAIN_ONLY)
{
    size_t n = sweep_whole() ? 40 : 24;
    nh_text text;
    nh_text_init(&text);
    nh_text_add(&text, "name: ring\nparameters: [{name: g, value: 0.7}, {name: k, value: 1.3}]\ncoordinates: [");
    for (size_t i = 0; i < n; i++) nh_text_addf(&text, "%s{name: a%zu, type: angle}", i ? ", " : "", i);
    nh_text_add(&text, "]\nlagrangian: 0");
    for (size_t i = 0; i < n; i++) nh_text_addf(&text, " + a%zu'^2/2 + g*cos(a%zu) + k*cos(a%zu - a%zu)", i, i, i, (i + 1) % n);
    nh_text_add(&text, "\n");
    nh_analysis *r = search(&text, 4000);
    cr_expect_eq(r->list->independent, 1, "%zu", r->list->independent);
    cr_expect(meant(r, "energy"));
    cr_expect_eq(r->search, NH_SEARCH_EXHAUSTED, "%s", r->warnings ? r->warning[0] : "");
    nh_analysis_free(r);
}

/* Energy, momentum, angular momentum and centre of mass. */
Test(sizes, bodies_in_space, WHOLE_ONLY)
{
    static const size_t sizes[] = {5, 6, 10};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        if (!sweep_tries(s, 3, 16)) continue;
        nh_text text;
        size_t n = sizes[s];
        coordinates(&text, n, "xyz");
        for (size_t i = 1; i <= n; i++) nh_text_addf(&text, "%s%.2f*m*(x%zu'^2 + y%zu'^2 + z%zu'^2)/2", i > 1 ? " + " : "", 0.5 + 0.37 * (double)i, i, i, i);
        for (size_t i = 1; i <= n; i++)
            for (size_t j = i + 1; j <= n; j++) nh_text_addf(&text, " + k/sqrt((x%zu - x%zu)^2 + (y%zu - y%zu)^2 + (z%zu - z%zu)^2)", i, j, i, j, i, j);
        nh_text_add(&text, "\ndomain:\n");
        for (size_t i = 1; i <= n; i++) {
            double a = 2.4 * (double)i, radius = 2 * sqrt((double)i / 2), at[3] = {radius * cos(a), radius * sin(a), 0.3 * (double)(i % 5)};
            for (size_t c = 0; c < 3; c++) nh_text_addf(&text, "  %c%zu: [%.2f, %.2f]\n", "xyz"[c], i, at[c], at[c] + 0.5);
        }
        nh_analysis *r = search(&text, 0);
        cr_expect_eq(r->list->independent, 10, "%zu bodies: %zu", n, r->list->independent);
        cr_expect_eq(r->verdict, NH_FOUND);
        nh_analysis_free(r);
    }
}
