/* A little generic term is added to a system's Lagrangian: what was conserved and no longer is must not be reported, what still is must be found. */
#include <criterion/criterion.h>

#include "perturbed.h"

#include "graph/dag.h"

static const char *const systems[] = {"appell_hamel", "contact_oscillator", "free_particle", "henon_heiles_kk", "isotropic_oscillator", "kepler", "knife_edge", "lagrange_top",
                                      "neumann", "nonholonomic_particle", "relativistic_particle", "sleigh", "spherical_pendulum", "suslov_principal", "two_wheel_carriage"};

Test(perturbed, what_nearly_is_conserved_is_told_apart, PLAIN_ONLY)
{
    nh_options options;
    size_t tried = 0, broken = 0, survived = 0;
    nh_options_default(&options);
    options.max_seconds = 1e6; /* the size of the stages bounds the search, not time: the same on every machine */
    options.stage_columns = 40;
    options.until = 0.5;
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++)
        for (size_t k = 0; k < PERTURBATIONS; k++) {
            if (!sweep_tries(PERTURBATIONS * i + k, 36, 240)) continue;
            tried++;
            perturbed p = perturbed_copy("systems", systems[i], k, 20261121 + i, &options);
            cr_expect_eq(p.o.wrong, 0, "%s + 1e%d: %s", systems[i], perturbation[k], p.o.names);
            cr_expect_eq(p.o.missing, 0, "%s + 1e%d: %s", systems[i], perturbation[k], p.o.names);
            cr_expect_eq(p.o.unread, 0, "%s + 1e%d", systems[i], perturbation[k]);
            cr_expect_geq(p.o.found, p.survive, "%s + 1e%d", systems[i], perturbation[k]);
            cr_expect_leq(p.o.found, p.survive + 2, "%s + 1e%d: %zu found, %zu survive; the changed energy is one more", systems[i], perturbation[k], p.o.found, p.survive);
            broken += p.original - p.survive;
            survived += p.survive;
        }
    cr_expect_gt(PERTURBATIONS * broken, tried, "the term changed nothing");
    cr_expect(survived > 0 || tried < 10);
}

/* The term itself: with it the known currents are no longer conserved, by as much as it is large. */
Test(perturbed, the_term_breaks_what_it_should)
{
    nh_error error = {0};
    nh_system *y = nh_system_read("systems/isotropic_oscillator.yaml", 0, NULL, &error);
    cr_assert_not_null(y, "%s", error.what);
    nh_ex term = generic_term(y, -9, 3);
    for (size_t s = 0; s < y->coordinates; s++) cr_expect(nh_depends(y->dag, term, y->coordinate[s].q));
    y->lagrangian = nh_add(y->dag, y->lagrangian, term);
    nh_model *o = nh_model_create(y, nh_chart_create(y, NH_CHART_AUTO, 1, &error), &error);
    cr_assert_not_null(o, "%s", error.what);
    nh_points *at = nh_points_create(o, points, 1, 5, &error);
    multiplier_motion *motion = multiplier_motion_create(o, at, bits);
    for (size_t k = 0; k < y->currents; k++) {
        multiplier_rate rate = multiplier_rate_of(motion, y->current[k].value);
        cr_expect(rate.lower > -12 && rate.upper < -7, "%s changes at 1e%.1f", y->current[k].name, rate.upper);
    }
    multiplier_motion_free(motion);
    nh_points_free(at);
    nh_model_free(o);
    nh_system_free(y);
}
