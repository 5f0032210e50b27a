/* integral_levels: on the level of a linear integral the equations of motion can have constant coefficients that they do not have elsewhere. */
#include <criterion/criterion.h>

#include <stdio.h>
#include <string.h>

#include "analysed.h"
#include "sweep.h"

/* With `swing` as a known current: all integrals, proved for all parameters, and one of them a multiple of it. */
static void expect_swing(const char *constraint, const char *swing, const char *velocities)
{
    char text[1000];
    snprintf(text, sizeof text,
             "name: blade\nparameters: {m: 0.4, J: 0.02, k: 1.1, W: 0.6}\ncoordinates: [x, y, {name: th, type: angle}]\n"
             "definitions: [\"X = x*cos(th) + y*sin(th)\", \"Y = y*cos(th) - x*sin(th)\", \"v = x'*cos(th) + y'*sin(th)\"]\n"
             "lagrangian: m*(x'^2 + y'^2)/2 + J*th'^2/2 - k*(x^2 + y^2)/2\nconstraints: [\"%s\"]\n"
             "known: {currents: [{name: swing, expr: \"%s\"}]}\n%s",
             constraint, swing, velocities);
    nh_analysis *r = analysed_text(text);
    size_t swings = 0;
    cr_expect_eq(r->list->independent, 5, "%s: %zu", constraint, r->list->independent);
    for (size_t k = 0; k < r->list->count; k++) {
        cr_expect(r->list->found[k].proof.all_parameters, "%s", r->list->found[k].name);
        swings += r->list->found[k].known && strstr(r->list->found[k].known, "[swing]");
    }
    cr_expect_geq(swings, 1, "%s", constraint);
    nh_analysis_free(r);
}

/* A blade on a central spring: along it, and across it, are X' = v + th' Y, Y' = -th' X, m v' = -k X, with the constant th'; so X'' = -(k/m + th'^2) X. */
Test(integral_levels, a_blade_on_a_spring_swings_at_a_rate_of_its_own)
{
    expect_swing("x'*sin(th) = y'*cos(th)", "(v + th'*Y)*sin(t*sqrt(k + m*th'^2)/sqrt(m)) - sqrt(k + m*th'^2)/sqrt(m)*X*cos(t*sqrt(k + m*th'^2)/sqrt(m))", "");
}

/* J w was divided by all that seemed a constant, and h' seemed one beside w. */
Test(integral_levels, in_quasi_velocities_of_the_file_as_well)
{
    expect_swing("x'*sin(th) = y'*cos(th)", "(v + th'*Y)*sin(t*sqrt(k + m*th'^2)/sqrt(m)) - sqrt(k + m*th'^2)/sqrt(m)*X*cos(t*sqrt(k + m*th'^2)/sqrt(m))",
                 "velocities: {names: [s, w], map: [\"x' = s*cos(th)\", \"y' = s*sin(th)\", th' = w]}\n");
}

/* On a table that turns at the rate W: Y' = -(th' + W) X, m v' = -k X - m W X th', and so on. */
Test(integral_levels, a_blade_on_a_turning_table_too, WHOLE_ONLY)
{
    expect_swing("x'*sin(th) - y'*cos(th) = W*(x*cos(th) + y*sin(th))",
                 "(v + th'*Y)*sin(t*sqrt(k + m*th'*(2*W + th'))/sqrt(m)) - sqrt(k + m*th'*(2*W + th'))/sqrt(m)*X*cos(t*sqrt(k + m*th'*(2*W + th'))/sqrt(m))", "");
}
