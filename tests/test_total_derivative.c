/* Total derivatives among the terms of a Lagrangian: all of them go, and nothing else. */
#include <criterion/criterion.h>

#include <stdio.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "integrals/total_derivative.h"
#include "mechanics.h"

#define REST "(x'^2*(1 + y^2) + y'^2)/2 + b/2*(x*y' - y*x') - cos(3*x/2)*y^2"

static void expect_left(const char *added, const char *left)
{
    char text[500];
    snprintf(text, sizeof text, "name: a\nparameters: {b: 0.7, c: 1.3}\ncoordinates: [x, y]\nlagrangian: " REST " + %s\n", added);
    mechanics m = mechanics_of_text(text, NH_CHART_AUTO);
    snprintf(text, sizeof text, REST " + %s", left);
    nh_ex rest = nh_sub(m.model->dag, nh_total_derivative_removed(m.model), formula(m.model, text));
    cr_expect_eq(nh_normal_is_zero(m.model->dag, rest, 0), NH_ZERO, "%s", added);
    mechanics_clear(&m);
}

Test(total_derivative, whole_ones_go)
{
    expect_left("0", "0");
    expect_left("c*x*cos(x*y)*y' + c*y*cos(x*y)*x'", "0");
    expect_left("x'*(y + c*t)*cos(x/2)/2 + (y' + c)*sin(x/2)", "0");
    expect_left("exp(-t)*(2*x*x' - x^2)", "0");
    expect_left("3*x' + y^2*y'", "0");
}

/* A gauge of a magnetic field is not changed, and of several terms those remain that are no derivative. */
Test(total_derivative, nothing_else_goes)
{
    expect_left("x*y^2*y'", "x*y^2*y'");
    expect_left("exp(-t)*x*x'", "exp(-t)*x*x'");
    expect_left("y*cos(x)*x' + sin(x)*y' + x^3*y'", "x^3*y'");
    expect_left("sqrt(1 + x'^2) + x*x'", "sqrt(1 + x'^2)");
    expect_left("(x' + y^2*y')^2", "(x' + y^2*y')^2");
    expect_left("(y^2 + c*t)^2*(y' + c)^2/2", "(y^2 + c*t)^2*(y' + c)^2/2"); /* c y^4 y' is a part of the square */
}
