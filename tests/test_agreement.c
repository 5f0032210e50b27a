/* The sampled problem against the counted space: null vectors of polynomial ansaetze are products of the currents, and what is none is caught. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include "commands/analyze.h"
#include "scratch.h"
#include "search/search.h"
#include "sweep.h"

typedef struct {
    const char *name, *system, *ansatz;
    size_t degree;
} task;

static const task TASK[] = {
    {"isotropic oscillator", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2\n", "  - {basis: polynomial, in: [x, y, x', y'], degree: 4}\n", 4},
    {"Henon and Heiles, integrable", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2*y - y^3/3\n", "  - {basis: polynomial, in: [x, y, x', y'], degree: 4}\n", 4},
    {"Kepler's problem", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n",
     "  - product:\n      - {basis: polynomial, in: [x, y, x', y'], degree: 3}\n      - terms: [1, 1/sqrt(x^2 + y^2)]\n", 3},
    {"nonholonomic, only the energy", "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - x^3/3 - x*y^2 - z^2\nconstraints: [\"z' = y*x'\"]\n",
     "  - product:\n      - {basis: polynomial, in: [x', y'], degree: 2}\n      - {basis: polynomial, in: [x, y, z], degree: 3}\n", 2},
    {"charge in a magnetic field", "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 + (x*y' - y*x')/2\n", "  - {basis: polynomial, in: [x, y, z, x', y', z'], degree: 2}\n", 2},
    {"free fall, with time", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y\n", "  - {basis: polynomial, in: [t, x, y, x', y'], degree: 3}\n", 3},
};
enum { tasks = sizeof TASK / sizeof *TASK };

static nh_analysis *analysed(const task *q)
{
    char system[SCRATCH], analysis[SCRATCH], text[2000];
    nh_error error = {0};
    snprintf(text, sizeof text, "name: sampled\n%s", q->system);
    cr_assert(scratch_text(system, text));
    snprintf(text, sizeof text, "name: sampled\nsystem: %s\nansatz:\n%s", system, q->ansatz);
    cr_assert(scratch_text(analysis, text));
    nh_request request = {.system_path = system, .analysis_path = analysis, .documents = true};
    nh_options_default(&request.options);
    request.options.max_seconds = 1e6;
    nh_analysis *r = nh_analysis_create(&request, &error);
    cr_assert_not_null(r, "%s: %s", q->name, error.what);
    remove(system);
    remove(analysis);
    return r;
}

Test(agreement, null_vectors_are_in_the_counted_space, PLAIN_ONLY)
{
    for (size_t i = 0; i < tasks; i++) {
        nh_analysis *r = analysed(&TASK[i]);
        const nh_counted_space *c = &r->counted_space;
        cr_expect(c->compared && c->agrees, "%s: compared %d, angle %.1e", TASK[i].name, c->compared, c->angle);
        cr_expect_leq(c->degree, TASK[i].degree, "%s: degree %zu", TASK[i].name, c->degree);
        cr_expect_lt(c->angle, 1e-9, "%s: angle %.1e", TASK[i].name, c->angle);
        cr_expect(r->current.dimension > 0 && c->products > 1, "%s", TASK[i].name);
        nh_analysis_free(r);
    }
}

/* A vector that is no null vector is at an angle, and the warning says so. */
Test(agreement, what_is_not_conserved_is_caught)
{
    nh_analysis *r = analysed(&TASK[0]);
    size_t warnings = r->warnings;
    cr_assert(r->sampled && r->sampled->columns > 2);
    for (size_t j = 0; j < r->sampled->columns; j++) r->sampled->vector[j] = j % 3 == 1;
    nh_agreement_find(r);
    cr_expect(r->counted_space.compared && !r->counted_space.agrees && r->counted_space.angle > 1e-3, "%.1e", r->counted_space.angle);
    cr_assert_eq(r->warnings, warnings + 1);
    cr_expect_not_null(strstr(r->warning[warnings], "disagree"));
    nh_analysis_free(r);
}

/* The ansatz has functions of the velocities that are no polynomials: nothing is compared. */
Test(agreement, rational_functions_of_the_velocities_are_not_compared)
{
    task q = TASK[0];
    q.ansatz = "  - {basis: polynomial, in: [x, y, x', y'], degree: 2}\n  - terms: [x'/y', x/y']\n";
    nh_analysis *r = analysed(&q);
    cr_expect(!r->counted_space.compared);
    nh_analysis_free(r);
}
