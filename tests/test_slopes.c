/* slopes: two velocities by themselves have a current where Bernoulli's equation holds along their quotient. */
#include <criterion/criterion.h>

#include <stdio.h>

#include "analysed.h"
#include "integrals/prove.h"
#include "problem/analysis_file.h"

/* The hodograph of a projectile with the drag k |v| v (J. Bernoulli 1719): w = 1/x'^2 and p = y'/x' have dw/dp = -(2 k/(m g)) sqrt(1 + p^2) where x' > 0. */
Test(slopes, a_projectile_with_drag_has_its_hodograph)
{
    static const char *const places[] = {"", "domain: {x': [-2, -0.5]}\n"};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        char text[600];
        nh_error error = {0};
        nh_ex e, phi;
        snprintf(text, sizeof text,
                 "name: projectile\nparameters: {m: 1.4, k: 0.3, g: 9.8}\ncoordinates: [x, y]\nlagrangian: m*(x'^2 + y'^2)/2 - m*g*y\n"
                 "forces: [\"x = -k*x'*sqrt(x'^2 + y'^2)\", \"y = -k*y'*sqrt(x'^2 + y'^2)\"]\n%s",
                 places[i]);
        nh_analysis *r = analysed_text(text);
        cr_assert_eq(r->list->count + r->list->pieces, 1, "%zu", i);
        const nh_current *f = r->list->count ? r->list->found : r->list->piece;
        cr_expect(f->proof.proved && f->proof.all_parameters, "%s", f->name);
        cr_assert(nh_system_expression_text(r->question->system, "test", "m*g/x'^2 + k*(y'*sqrt(x'^2 + y'^2)/x'^2 + sign(x')*log((sqrt(x'^2 + y'^2) + y'*sign(x'))/abs(x')))", 0, NULL, &e, &error) &&
                      nh_analysis_file_to_chart(r->question->model, e, &phi, &error),
                  "%s", error.what);
        cr_expect_geq(nh_prove_digits(r->question->model, phi, &r->question->options), r->question->options.digits);
        nh_analysis_free(r);
    }
}
