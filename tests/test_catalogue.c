/* Every system that is shipped, analysed without an analysis file: nothing known is missing, nothing false is reported. */
#include <criterion/criterion.h>

#include "catalogue.h"
#include "sweep.h"

#include "graph/dag.h"

/* Sanitizers slow the search down many times: time must not decide what is found. */
static const double patience = 600;

Test(catalogue, finds_what_is_known_and_nothing_false)
{
    char *name[most_files];
    size_t n = list("systems", name);
    cr_assert_geq(n, 1);
    for (size_t i = 0; i < n; free(name[i++])) {
        if (!sweep_tries(i + 1, 40, 120)) continue;
        row o = compare_file("systems", name[i], 0, patience);
        cr_expect_eq(o.missing, o.excused, "%s: %s", name[i], o.names);
        cr_expect_eq(o.untrue, 0, "%s: %s", name[i], o.names);
        cr_expect_eq(o.wrong, 0, "%s: %s", name[i], o.names);
        cr_expect_eq(o.unread, 0, "%s: %zu currents not checked by the multiplier form", name[i], o.unread);
        cr_expect_eq(o.rounded, 0, "%s: %zu currents checked with rounded numbers", name[i], o.rounded);
        cr_expect_leq(o.found, o.maximum, "%s reports %zu independent currents of at most %zu", name[i], o.found, o.maximum);
    }
}

static bool has_ansatz(const char *path)
{
    nh_error error;
    nh_error_clear(&error);
    nh_deck *deck = nh_deck_read(path, &error);
    cr_assert_not_null(deck, "%s", error.what);
    bool any = nh_deck_get(nh_deck_root(deck), "ansatz") != NULL;
    nh_deck_free(deck);
    return any;
}

/* What is out of reach is found with the ansatz of the analysis file of that name. */
Test(catalogue, analysis_files_find_everything_known, PLAIN_ONLY)
{
    char *name[most_files];
    size_t n = list("analyses", name);
    cr_assert_geq(n, 1);
    for (size_t i = 0; i < n; free(name[i++])) {
        if (!sweep_tries(i, 1, 8)) continue;
        char system[300], analysis[300];
        nh_options options;
        nh_options_default(&options);
        snprintf(system, sizeof system, "systems/%s.yaml", name[i]);
        snprintf(analysis, sizeof analysis, "analyses/%s.yaml", name[i]);
        if (!has_ansatz(analysis)) continue; /* only a motion and figures: the ansatz is the one that was tried above */
        row o = compare_with(system, analysis, &options);
        cr_expect_eq(o.missing + o.wrong + o.untrue + o.uncertain, 0, "%s: %s", name[i], o.names);
    }
}

/* The field of the energy is d/dt, however long the inverse of the mass matrix is. */
Test(catalogue, the_energy_belongs_to_time, WHOLE_ONLY)
{
    nh_error error;
    nh_error_clear(&error);
    nh_request q = {.system_path = "systems/rattleback.yaml"};
    nh_options_default(&q.options);
    q.options.max_seconds = patience;
    nh_analysis *r = nh_analysis_create(&q, &error);
    cr_assert_not_null(r, "%s", error.what);
    const nh_current *f = r->list->found;
    cr_assert(r->list->count > 0 && !strcmp(f->meaning, "minus the energy") && f->has_symmetry);
    cr_expect(nh_is_number(r->question->model->dag, f->symmetry.Z0, 1));
    for (size_t s = 0; s < r->question->model->m; s++) cr_expect(nh_is_zero(r->question->model->dag, f->symmetry.field.space[s]), "along %s", r->question->system->coordinate[s].name);
    for (size_t i = 0; i < r->question->model->n; i++) cr_expect(nh_is_zero(r->question->model->dag, f->symmetry.W[i]), "along velocity %zu", i);
    nh_analysis_free(r);
}

/* The check itself: a coordinate and one of the known false currents are caught by it. */
Test(catalogue, the_multiplier_form_catches_what_is_not_conserved, PLAIN_ONLY)
{
    nh_error error;
    nh_error_clear(&error);
    nh_request q = {.system_path = "systems/appell_hamel.yaml"};
    nh_options_default(&q.options);
    nh_analysis *r = nh_analysis_create(&q, &error);
    cr_assert_not_null(r, "%s", error.what);
    nh_points *at = nh_points_create(r->question->model, points, 1, 4711, &error);
    cr_assert_not_null(at, "%s", error.what);
    nh_current x = {.has_in_velocities = true, .in_velocities = r->question->system->coordinate[0].q}, trap = {.has_in_velocities = true};
    multiplier_motion *motion = multiplier_motion_create(r->question->model, at, bits);
    cr_expect_gt(rate_of(motion, &x).lower, -3);
    cr_assert_gt(r->question->system->not_conserved, 0);
    trap.in_velocities = r->question->system->trap[0].value;
    cr_expect_gt(rate_of(motion, &trap).lower, -3);
    cr_expect(isnan(rate_of(motion, &(nh_current){0}).upper));
    /* What is false from the 25th digit on is false. */
    nh_dag *d = r->question->model->dag;
    trap.in_velocities = nh_add(d, r->list->found[0].in_velocities, nh_mul(d, nh_pow(d, nh_int(d, 10), nh_int(d, -25)), x.in_velocities));
    cr_expect(rate_of(motion, &r->list->found[0]).upper < -80 && rate_of(motion, &trap).lower > -30, "%g and %g", rate_of(motion, &r->list->found[0]).upper, rate_of(motion, &trap).lower);
    nh_named swapped = r->question->system->trap[0];
    row o = {0};
    r->question->system->trap[0] = r->question->system->current[0];
    r->question->system->current[0] = swapped;
    check_file(r->question->system, motion, &o);
    cr_expect_eq(o.untrue, 2, "%s", o.names);
    multiplier_motion_free(motion);
    nh_points_free(at);
    nh_analysis_free(r);
}
