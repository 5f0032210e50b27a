/* Lagrangians with velocities in denominators and logarithms: the known integrals of such equations are functions of those that the search finds. */
#include "mechanics.h"
#include "sweep.h"

#include <stdio.h>

#include "commands/analyze.h"
#include "exact/normal.h"
#include "graph/dag.h"

typedef struct {
    const char *source, *text;
    const char *equation; /* x'' by hand, in x and x'; NULL: not compared */
    size_t found;
    const char *known[2];
} member;

/* The modified Emden equation x'' + 3 x x' + x^3 = 0, also with a force linear in x of either sign; with parameters; in two dimensions; damped
 * motions; the free particle by an unusual Lagrangian. */
static const member MEMBERS[] = {
    {"[Carinena2005]", "coordinates: [x]\nlagrangian: 1/(x' + x^2)\n", "-3*x*x' - x^3", 2, {"t - x/(x' + x^2)", "t^2/2 + (1 - t*x)/(x' + x^2)"}},
    {"[Chandrasekar2005]", "coordinates: [x]\nlagrangian: 1/(x' + x^2 + 1)\n", "-3*x*x' - x^3 - x", 2,
     {"(x*sin(t) + (x' + x^2)*cos(t))/(x' + x^2 + 1)", "(x^2 + (x' + x^2)^2)/(x' + x^2 + 1)^2"}},
    {"[Chandrasekar2005]", "coordinates: [x]\nlagrangian: 1/(x' + x^2 - 1)\ndomain: {x: [0.5, 1], \"x'\": [0.8, 1.5]}\n", "-3*x*x' - x^3 + x", 2,
     {"exp(-2*t)*(x' + x^2 + x)/(x' + x^2 - x)", NULL}},
    {"[Chandrasekar2005]", "coordinates: [x]\nparameters: {k: 2, w: 1.5}\nlagrangian: 1/(x' + k*x^2/3 + 3*w^2/k)\n", "-k*x*x' - k^2*x^3/9 - w^2*x", 2,
     {"(x*w*sin(w*t) + (x' + k*x^2/3)*cos(w*t))/(x' + k*x^2/3 + 3*w^2/k)", NULL}},
    {"[Carinena2005]", "coordinates: [x, y]\nlagrangian: 1/(x' + x^2) + 1/(y' + y^2)\n", NULL, 4, {"x/(x' + x^2) - y/(y' + y^2)", "t - y/(y' + y^2)"}},
    {"[Musielak2008]", "coordinates: [x]\nlagrangian: log(x' + x)\n", "-2*x' - x", 2, {"t - x/(x' + x)", "exp(t)*(x' + x)"}},
    {"[Musielak2008]", "coordinates: [x]\nlagrangian: 1/(x' + x)\n", "-3*x'/2 - x/2", 2, {"exp(t/2)*(x' + x)", "exp(t)*(x' + x/2)"}},
    {"[HarkoLoboMak2014]", "coordinates: [x]\nlagrangian: x'^2/2\nforces: [\"x = -3*x*x' - x^3\"]\n", "-3*x*x' - x^3", 2, {"t - x/(x' + x^2)", "(2*x' + x^2)/(x' + x^2)^2"}},
    {"[HarkoLoboMak2014]", "coordinates: [x]\nlagrangian: x'^2/2\nforces: [\"x = -5*x*x' - 2*x^3\"]\n", "-5*x*x' - 2*x^3", 1, {"(x' + x^2/2)/(x' + 2*x^2)^4", NULL}},
    {"[HarkoLoboMak2014]", "coordinates: [x]\nlagrangian: x'^2/2\nforces: [\"x = -4*(x + x^3)*x' - 3*(x^2/2 + x^4/4)*(x + x^3)\"]\n", NULL, 1, {"(x' + x^2/2 + x^4/4)/(x' + 3*x^2/2 + 3*x^4/4)^3", NULL}},
    {"[Musielak2008]", "coordinates: [x]\nlagrangian: 1/x'\n", "0", 2, {"t - x/x'", "x'"}},
};

static nh_analysis *analysed(const char *text)
{
    nh_error error;
    nh_error_clear(&error);
    FILE *file = fopen("build/nonstandard_test.yaml", "w");
    cr_assert_not_null(file);
    fputs(text, file);
    fclose(file);
    nh_request q = {.system_path = "build/nonstandard_test.yaml"};
    nh_options_default(&q.options);
    q.options.max_seconds = 60;
    nh_analysis *r = nh_analysis_create(&q, &error);
    must(r != NULL, &error, text);
    return r;
}

/* The last of the functions depends on those before it. */
static void depends(const nh_analysis *r, const char *known, const char *text)
{
    nh_error error;
    nh_error_clear(&error);
    nh_dag *d = r->question->model->dag;
    nh_ex *phi = nh_alloc_array(r->list->count + 1, sizeof *phi), f = formula(r->question->model, known);
    nh_independence *kind = nh_alloc_array(r->list->count + 1, sizeof *kind);
    cr_expect_eq(nh_normal_is_zero(d, nh_model_gamma(r->question->model, f), 0), NH_ZERO, "%s is no integral of %s", known, text);
    for (size_t i = 0; i < r->list->count; i++) phi[i] = r->list->found[i].phi;
    phi[r->list->count] = f;
    nh_points *points = nh_points_create(r->question->model, 24, 1, 99, &error);
    nh_independence_test(r->question->model, points, r->list->count + 1, phi, NULL, 1e-2, 1e-6, kind, NULL);
    cr_expect_eq(kind[r->list->count], NH_DEPENDENT, "%s is no function of what was found: %s", known, text);
    nh_points_free(points);
    nh_free(kind);
    nh_free(phi);
}

Test(nonstandard, known_integrals_are_found)
{
    for (size_t i = 0; i < sizeof MEMBERS / sizeof *MEMBERS; i++) {
        const member *m = &MEMBERS[i];
        if (!sweep_tries(i, 2, 4)) continue;
        nh_analysis *r = analysed(m->text);
        cr_expect_eq(r->list->independent, m->found, "%s: %zu found", m->text, r->list->independent);
        if (m->equation) {
            nh_ex rest = nh_sub(r->question->model->dag, r->question->model->a[0], formula(r->question->model, m->equation));
            cr_expect_eq(nh_normal_is_zero(r->question->model->dag, rest, 0), NH_ZERO, "another equation than x'' = %s", m->equation);
        }
        for (size_t k = 0; k < 2 && m->known[k]; k++) depends(r, m->known[k], m->text);
        nh_analysis_free(r);
    }
}
