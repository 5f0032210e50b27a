/* frames: the velocities along and across headings are chosen by the program, where a file has coordinate velocities only. */
#include <criterion/criterion.h>

#include <stdio.h>

#include "analysed.h"
#include "integrals/prove.h"
#include "problem/analysis_file.h"
#include "sweep.h"

/* By its centre of mass the equations of the sleigh are long in x' and phi'; along the blade they are v' = a w^2, w' = -m a v w/(I + m a^2), whose motion
 * takes the time (I + m a^2) atanh(sqrt(m) v/r)/(sqrt(m) a r), r^2 = m v^2 + (I + m a^2) w^2. */
Test(frames, a_sleigh_by_its_centre_of_mass, PLAIN_ONLY)
{
    static const char *const constraint[] = {"-x'*sin(phi) + y'*cos(phi) = a*phi'", "x'*sin(phi) - y'*cos(phi) + a*phi' = 0"};
    for (size_t i = 0; i < sizeof constraint / sizeof *constraint; i++) {
        if (!sweep_tries(i, 2, 2)) continue;
        char text[600];
        nh_error error = {0};
        nh_ex e, phi;
        snprintf(text, sizeof text,
                 "name: sleigh\nparameters: {m: 1.5, I: 0.4, a: 0.3}\ncoordinates: [x, y, {name: phi, type: angle}]\nlagrangian: m*(x'^2 + y'^2)/2 + I*phi'^2/2\nconstraints: [\"%s\"]\n",
                 constraint[i]);
        nh_analysis *r = analysed_text(text);
        cr_assert_geq(r->list->independent, 3);
        bool timed = false;
        for (size_t k = 0; k < r->list->count; k++) {
            cr_expect(r->list->found[k].proof.proved && r->list->found[k].proof.all_parameters, "%s", r->list->found[k].name);
            timed |= nh_depends(r->question->model->dag, r->list->found[k].phi, r->question->system->t);
        }
        cr_expect(timed);
        const char *known = "t*sqrt(m*(x'*cos(phi) + y'*sin(phi))^2 + (I + m*a^2)*phi'^2) - (I + m*a^2)/(sqrt(m)*a)*atanh(sqrt(m)*(x'*cos(phi) + y'*sin(phi))"
                            "/sqrt(m*(x'*cos(phi) + y'*sin(phi))^2 + (I + m*a^2)*phi'^2))";
        cr_assert(nh_system_expression_text(r->question->system, "test", known, 0, NULL, &e, &error) && nh_analysis_file_to_chart(r->question->model, e, &phi, &error), "%s", error.what);
        cr_expect_geq(nh_prove_digits(r->question->model, phi, &r->question->options), r->question->options.digits);
        nh_analysis_free(r);
    }
}
