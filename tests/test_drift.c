/* What a drift along the test motion says: the motion's own error explains one that falls with the tolerance, whatever it is, and no other. */
#include <criterion/criterion.h>

#include "mechanics.h"
#include "motion/validation.h"

enum { CURRENTS = 3 };

/* The energy, and what is conserved but for about 1e-5 of its size. */
static nh_validation *validated(const mechanics *x, const char *const *current, const double *q, const double *v, double until)
{
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    options.drift = 0.1; /* tolerances: the motion errs by more than this */
    nh_ex e[CURRENTS];
    for (size_t k = 0; k < CURRENTS; k++) e[k] = formula(x->model, current[k]);
    nh_state initial = {.q = (double *)q, .v = (double *)v};
    nh_validation_request request = {.model = x->model, .currents = CURRENTS, .current = e, .initial = &initial, .until = until, .outputs = 101, .options = &options};
    nh_validation *r = nh_validate(&request, &error);
    must(r != NULL, &error, "the check");
    return r;
}

Test(drift, the_error_of_the_motion_is_told_apart)
{
    static const char *const current[CURRENTS] = {"(x'^2 + y'^2)/2 - 1/sqrt(x^2 + y^2)", "(x'^2 + y'^2)/2 - 1/sqrt(x^2 + y^2) + 1e-4*x", "(x'^2 + y'^2)/2 - 1.00001/sqrt(x^2 + y^2)"};
    static const double q[] = {1, 0}, v[] = {0, 0.3};
    mechanics x = mechanics_of_text("name: kepler\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n", NH_CHART_AUTO);
    nh_validation *r = validated(&x, current, q, v, 60);
    cr_expect(!r->current[0].small && r->current[0].explained, "the energy drifts by %.1e, %.1e, %.1e", r->current[0].drift[0], r->current[0].drift[1], r->current[0].drift[2]);
    for (size_t k = 1; k < CURRENTS; k++)
        cr_expect(!r->current[k].explained, "%s drifts by %.1e, %.1e, %.1e", current[k], r->current[k].drift[0], r->current[k].drift[1], r->current[k].drift[2]);
    nh_validation_free(r);
    mechanics_clear(&x);
}
