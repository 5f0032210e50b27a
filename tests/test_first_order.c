/* Lagrangians that are linear in the velocities are refused, with constraints to write instead that have the same motions. */
#include "mechanics.h"

#include <stdio.h>

#include "exact/normal.h"
#include "geometry/distribution.h"
#include "graph/dag.h"

typedef struct {
    const char *parameters, *coordinates, *lagrangian;
    const char *velocity[4]; /* by hand; NULL: not compared */
    const char *constant[4];
    size_t integrals; /* functions of time and positions that stay constant: all of them */
} member;

/* A canonical pair; a guiding centre in an uneven field; two vortices [Kirchhoff1876, lecture 20]; an action with time; a force. */
static const member MEMBERS[] = {
    {"", "[q, p]", "p*q' - p^2/2 - q^4/4", {"p", "-q^3"}, {"p^2/2 + q^4/4"}, 2},
    {"parameters: {B: 2}\n", "[x, y]", "(B*x + x^3)*y' - (x^2 + y^4)/2", {"-2*y^3/(B + 3*x^2)", "x/(B + 3*x^2)"}, {"x^2 + y^4"}, 2},
    {"parameters: {G1: 1, G2: 2}\n",
     "[x1, y1, x2, y2]",
     "G1/2*(x1*y1' - y1*x1') + G2/2*(x2*y2' - y2*x2') + G1*G2/2*log((x1 - x2)^2 + (y1 - y2)^2)",
     {"G2*(y1 - y2)/((x1 - x2)^2 + (y1 - y2)^2)", "-G2*(x1 - x2)/((x1 - x2)^2 + (y1 - y2)^2)"},
     {"G1*x1 + G2*x2", "G1*y1 + G2*y2", "G1*(x1^2 + y1^2) + G2*(x2^2 + y2^2)", "(x1 - x2)^2 + (y1 - y2)^2"},
     4},
    {"", "[q, p]", "exp(t)*p*q' - exp(t)*(p^2 + q^2)/2", {"p", "-q - p"}, {NULL}, 2},
};

/* The text of a system from the hint of the refusal. */
static void rewritten(const member *m, char *out, size_t size)
{
    char text[1200];
    nh_error error = {0};
    snprintf(text, sizeof text, "name: first\n%scoordinates: %s\nlagrangian: %s\n", m->parameters, m->coordinates, m->lagrangian);
    nh_system *system = nh_system_parse("test.yaml", text, 0, NULL, &error);
    must(system != NULL, &error, text);
    nh_model *model = nh_model_create(system, nh_chart_create(system, NH_CHART_COORDINATES, 1, &error), &error);
    cr_assert_null(model, "%s", text);
    cr_assert(strstr(error.what, "equations of motion are of first order"), "%s", error.what);
    const char *constraints = strstr(error.hint, "constraints: [");
    cr_assert_not_null(constraints, "%s", error.hint);
    snprintf(out, size, "name: instead\n%scoordinates: %.*s, s]\nlagrangian: s'^2/2\n%s\n", m->parameters, (int)strlen(m->coordinates) - 1, m->coordinates, constraints);
    nh_system_free(system);
}

Test(first_order, the_hint_is_the_same_system)
{
    for (size_t i = 0; i < sizeof MEMBERS / sizeof *MEMBERS; i++) {
        const member *m = &MEMBERS[i];
        char text[2000];
        rewritten(m, text, sizeof text);
        mechanics x = mechanics_of_text(text, NH_CHART_COORDINATES);
        nh_dag *d = x.model->dag;
        for (size_t s = 0; s < 4 && m->velocity[s]; s++) {
            nh_ex rest = nh_sub(d, x.model->rho[s], formula(x.model, m->velocity[s]));
            cr_expect_eq(nh_normal_is_zero(d, rest, 0), NH_ZERO, "velocity %zu of\n%s", s, text);
        }
        for (size_t k = 0; k < 4 && m->constant[k]; k++)
            cr_expect_eq(nh_normal_is_zero(d, nh_model_gamma(x.model, formula(x.model, m->constant[k])), 0), NH_ZERO, "%s changes in\n%s", m->constant[k], text);
        nh_distribution v = nh_distribution_of(x.model);
        cr_expect_eq(v.hidden, m->integrals, "%zu hidden in\n%s", v.hidden, text);
        mechanics_clear(&x);
    }
}

Test(first_order, what_determines_no_velocities_is_refused)
{
    static const char *const texts[] = {"coordinates: [x, y]\nlagrangian: x' + y\n", "coordinates: [x, y, z]\nlagrangian: x*y' - z^2\n", "coordinates: [x]\nlagrangian: x*x'\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        nh_error error = {0};
        nh_system *system = nh_system_parse("test.yaml", texts[i], 0, NULL, &error);
        must(system != NULL, &error, texts[i]);
        cr_assert_null(nh_model_create(system, nh_chart_create(system, NH_CHART_COORDINATES, 1, &error), &error));
        cr_expect(strstr(error.what, "its equations do not determine them"), "%s", error.what);
        nh_system_free(system);
    }
}
