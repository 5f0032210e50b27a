/* embedding: rho satisfies the constraints, its derivatives are those of the solution, and what cannot be embedded is told. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/print.h"
#include "names.h"
#include "system/sample.h"

#define SPACE "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
#define SPACE4 "coordinates: [x, y, z, s]\nlagrangian: (x'^2 + y'^2 + z'^2 + s'^2)/2\n"
#define SPEED "parameters: [{name: k, value: 1.385}]\n" SPACE

typedef struct {
    nh_system *system;
    nh_chart *chart;
} embedded;

static embedded embed(const char *text, nh_chart_choice choice)
{
    nh_error error = {0};
    embedded e = {system_of(text), NULL};
    e.chart = nh_chart_create(e.system, choice, 1, &error);
    must(e.chart != NULL, &error, text);
    return e;
}

static void embed_clear(embedded *e)
{
    nh_chart_free(e->chart);
    nh_system_free(e->system);
}

static nh_tape *tape_of(const nh_chart *c, size_t n, const nh_ex *e)
{
    const nh_ex *symbols;
    const double *values;
    nh_system_bindings(c->system, &symbols, &values);
    return nh_tape_create(c->system->dag, c->width, c->symbol, n, e, c->system->parameters, symbols, values);
}

static void evaluate(const nh_chart *c, size_t n, const nh_ex *e, const double *z, double *out)
{
    nh_tape *tape = tape_of(c, n, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

enum { most_width = 16, points_wanted = 20 };

/* Points of the chart's box, completed; at least half of the draws must be usable. */
static size_t draw(const nh_chart *c, double z[points_wanted][most_width])
{
    size_t n = 0;
    cr_assert_leq(c->width, (size_t)most_width);
    nh_sampler *sampler = nh_sampler_create(c->width, c->low, c->high, 7);
    for (int i = 0; i < 2 * points_wanted && n < points_wanted; i++) {
        nh_sampler_next(sampler, z[n]);
        n += nh_chart_complete(c, z[n]);
    }
    nh_sampler_free(sampler);
    cr_assert_eq(n, (size_t)points_wanted, "only %zu points could be completed", n);
    return n;
}

/* The constraints hold at (t, q, rho(z)), computed without the chart's own composition. */
static void check_constraints(const nh_chart *c, double z[points_wanted][most_width], size_t n)
{
    const nh_system *s = c->system;
    const char *names[most_width] = {"t"};
    double state[most_width], v[most_width];
    size_t m = s->coordinates;
    for (size_t i = 0; i < m; i++) {
        names[1 + i] = s->coordinate[i].name;
        names[1 + m + i] = nh_name_of(s->dag, s->coordinate[i].v);
    }
    for (size_t p = 0; p < n; p++) {
        evaluate(c, m, c->rho, z[p], v);
        memcpy(state, z[p], (1 + m) * sizeof *state);
        memcpy(state + 1 + m, v, m * sizeof *v);
        for (size_t a = 0; a < s->constraints; a++) {
            double lhs = value_of(s, s->constraint[a].lhs, 1 + 2 * m, names, state), rhs = value_of(s, s->constraint[a].rhs, 1 + 2 * m, names, state);
            cr_expect(fabs(lhs - rhs) < 1e-12 * (1 + fabs(lhs)), "%s is off by %.3g at point %zu", s->constraint[a].text, lhs - rhs, p);
        }
    }
}

/* Text, the number of its implicit velocities, and the dependent coordinates that are expected. */
static void check_chart(const char *text, size_t implicit, const char *dependent)
{
    double z[points_wanted][most_width];
    char names[100] = "";
    embedded e = embed(text, NH_CHART_COORDINATES);
    cr_expect_eq(e.chart->implicit, implicit, "%s: %zu implicit velocities", text, e.chart->implicit);
    cr_expect_eq(e.chart->n, e.system->coordinates - e.system->constraints);
    cr_expect_eq(e.chart->width, 1 + e.system->coordinates + e.chart->n + implicit);
    for (size_t a = 0; a < e.system->constraints; a++) {
        strcat(names, a ? " " : "");
        strcat(names, e.system->coordinate[e.chart->dependent[a]].name);
    }
    cr_expect_str_eq(names, dependent, "%s eliminates %s", text, names);
    check_constraints(e.chart, z, draw(e.chart, z));
    for (size_t i = 0; i < e.chart->n; i++) /* independent velocities are their own */
        for (size_t s = 0; s < e.system->coordinates; s++)
            if (e.system->coordinate[s].v == e.chart->w[i]) cr_expect_eq(e.chart->rho[s], e.chart->w[i]);
    embed_clear(&e);
}

/* ---- rho satisfies the constraints ---- */

Test(embedding, without_constraints_every_velocity_is_free)
{
    embedded e = embed("coordinates: [x, phi]\nlagrangian: x'^2 + phi'^2\n", NH_CHART_AUTO);
    cr_expect_eq(e.chart->n, 2u);
    cr_expect_eq(e.chart->rho[1], e.system->coordinate[1].v);
    cr_expect_str_eq(e.chart->name, "coordinate velocities (x', phi')");
    cr_expect(e.chart->newton == NULL);
    embed_clear(&e);
}

/* The same submanifold, whatever units the constraints are written in. */
Test(embedding, constraints_of_any_size)
{
    static const char *const sizes[][2] = {{"1", "1"}, {"1e-15", "1e-15"}, {"1e15", "1e-12"}, {"1e-40", "1"}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char text[300];
        snprintf(text, sizeof text, SPACE4 "constraints: [\"%s*(x' - y*z') = 0\", \"%s*(s' - x*y') = 0\"]\n", sizes[i][0], sizes[i][1]);
        embedded e = embed(text, NH_CHART_COORDINATES);
        nh_dag *d = e.system->dag;
        const nh_coordinate *c = e.system->coordinate;
        cr_expect_eq(e.chart->n, 2u);
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, e.chart->rho[0], nh_mul(d, c[1].q, c[2].v)), 0), NH_ZERO, "%s", text);
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, e.chart->rho[3], nh_mul(d, c[0].q, c[1].v)), 0), NH_ZERO, "%s", text);
        embed_clear(&e);
    }
}

Test(embedding, linear_explicit)
{
    check_chart(SPACE "constraints: [\"y' = x*z' - t*x'\"]\n", 0, "y");
}

Test(embedding, linear_implicit_and_coupled)
{
    check_chart(SPACE4 "constraints:\n  - (2 + cos(x))*z' + y*s' = x'\n  - x*z' - (3 + y^2)*s' = t*y'\n", 0, "z s");
}

Test(embedding, affine_and_rheonomic)
{
    check_chart(SPACE "constraints: [\"z' - y*x' = 0.7*x - sin(t)\"]\ndependent: [z]\n", 0, "z");
}

Test(embedding, position_constraints_are_differentiated)
{
    check_chart(SPACE "constraints: [\"x^2 + y^2 + (z - 3)^2 = 4 + t\"]\ndomain: {z: [0.5, 1.5]}\n", 0, "z");
}

Test(embedding, quadratic_is_solved_by_its_root)
{
    check_chart(SPEED "constraints: [\"z'^2 = k^2*(x'^2 + y'^2)\"]\ndependent: [z]\n", 0, "z");
}

Test(embedding, nonlinear_stays_implicit)
{
    check_chart(SPACE "constraints: [\"z'^3 + 2*z' = x'^2 + y*y'\"]\ndependent: [z]\n", 1, "z");
}

Test(embedding, two_nonlinear_constraints)
{
    check_chart(SPACE4 "constraints:\n  - z'^3 + 2*z' + 0.3*sin(s') = x'^2\n  - s'^3 + 3*s' = y*y' + 0.2*z'^2\ndependent: [z, s]\n", 2, "z s");
}

/* Several constraints of which some are linear: those go first; a quadratic one that is left is a root, whatever else there is. */
Test(embedding, linear_constraints_go_first)
{
    check_chart(SPACE4 "constraints:\n  - s' = y*x'\n  - z'^2 = 0.3*x'^2 + y'^2\ndependent: [z, s]\n", 0, "z s");
    check_chart(SPACE4 "constraints:\n  - z'^2 = 0.3*x'^2 + y'^2 + 0.1*(s' - z')^2\n  - 2*s' = y*x' + z'\ndependent: [z, s]\n", 0, "s z");
    check_chart(SPACE4 "constraints:\n  - z' = s'^2 + x*x'\n  - s' = y*y' + x'^3\ndependent: [z, s]\n", 0, "s z");
    check_chart(SPACE4 "constraints:\n  - s' = y*x' + z'\n  - z'^3 + 2*z' = x'^2 + y*y'\ndependent: [s, z]\n", 1, "z s");
}

/* ---- branches ---- */

static int branch_of(const char *domain, double *root)
{
    char text[500];
    double z[most_width] = {0, 0.1, 0.2, 0.3, 0.6, -0.8}, v[3];
    snprintf(text, sizeof text, SPEED "constraints: [\"z'^2 = k^2*(x'^2 + y'^2)\"]\ndependent: [z]\n%s", domain);
    embedded e = embed(text, NH_CHART_COORDINATES);
    int branch = e.chart->branch;
    evaluate(e.chart, 3, e.chart->rho, z, v);
    *root = v[2];
    embed_clear(&e);
    return branch;
}

Test(embedding, the_domain_chooses_the_branch)
{
    double up, down;
    int above = branch_of("domain: {z': [0.1, 3]}\n", &up), below = branch_of("domain: {z': [-3, -0.1]}\n", &down);
    cr_expect_eq(above, -below);
    cr_expect(fabs(up - 1.385) < 1e-15, "%.17g", up); /* x'^2 + y'^2 = 1 */
    cr_expect(fabs(down + 1.385) < 1e-15, "%.17g", down);
}

/* Each branch has its name; what is shown has the velocity where the chart has its root, also where the user wrote it so. */
Test(embedding, a_root_is_shown_as_the_velocity)
{
    static const struct { const char *constraint, *domain, *name, *other, *shown; } list[] = {
        {"z'^2 = k^2*(x'^2 + y'^2)", "domain: {z': [0.1, 3]}\n", "z' > 0", "z' < 0", "z'"},
        {"z'^2 = k^2*(x'^2 + y'^2)", "domain: {z': [-3, -0.1]}\n", "z' < 0", "z' > 0", "z'"},
        {"-k*z'^2 = -k*(x'^2 + y'^2)", "domain: {z': [0.1, 3]}\n", "z' > 0", "z' < 0", "z'"},
        {"(z' - x')^2 = k*(x'^2 + y'^2)", "domain: {z': [1, 3], x': [-0.2, 0.2]}\n", "z' - x' > 0", "z' - x' < 0", "z'"},
        {"z' = k*sqrt(x'^2 + y'^2) + 2*x'", "", NULL, NULL, "z'"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        char text[500];
        snprintf(text, sizeof text, SPEED "constraints: [\"%s\"]\ndependent: [z]\n%s", list[i].constraint, list[i].domain);
        embedded e = embed(text, NH_CHART_COORDINATES);
        nh_dag *d = e.system->dag;
        char *shown = nh_print_string(d, nh_chart_shown(e.chart, e.chart->rho[2])), *here = NULL, *there = NULL;
        cr_expect_str_eq(shown, list[i].shown, "%s: %s", list[i].constraint, shown);
        cr_expect_eq(e.chart->branch != 0, list[i].name != NULL);
        if (list[i].name) {
            here = nh_chart_branch_name(e.chart, e.chart->branch);
            there = nh_chart_branch_name(e.chart, -e.chart->branch);
            cr_expect(!strcmp(here, list[i].name) && !strcmp(there, list[i].other), "%s: %s, %s", list[i].constraint, here, there);
        }
        nh_ex back = nh_chart_composed(e.chart, nh_chart_shown(e.chart, e.chart->rho[2]), e.chart);
        cr_expect_eq(nh_normal_is_zero(d, nh_sub(d, back, e.chart->rho[2]), 0), NH_ZERO);
        nh_free(here);
        nh_free(there);
        nh_free(shown);
        embed_clear(&e);
    }
}

/* ---- derivatives of implicit velocities ---- */

/* The dependent velocity's value with the j-th entry of z moved by h. */
static double moved(const nh_chart *c, nh_ex e, const double *z, size_t j, double h)
{
    double to[most_width], out;
    memcpy(to, z, c->width * sizeof *to);
    to[j] += h;
    cr_assert(nh_chart_complete(c, to));
    evaluate(c, 1, &e, to, &out);
    return out;
}

/* de/dz_j by the rules against the difference quotient of the constraints solved anew. */
static void check_derivatives(const nh_chart *c, nh_ex e, const double *z)
{
    const double h = 1e-4;
    for (size_t j = 0; j < c->width - c->implicit; j++) {
        nh_ex d = nh_diff(c->system->dag, e, c->symbol[j]);
        double exact, four = 8 * (moved(c, e, z, j, h) - moved(c, e, z, j, -h)) - (moved(c, e, z, j, 2 * h) - moved(c, e, z, j, -2 * h));
        evaluate(c, 1, &d, z, &exact);
        cr_expect(fabs(exact - four / (12 * h)) < 1e-9 * (1 + fabs(exact)), "d/d%s is %.12g, solved anew %.12g", nh_name_of(c->system->dag, c->symbol[j]),
                  exact, four / (12 * h));
    }
}

static void check_rules(const char *text)
{
    double z[points_wanted][most_width];
    embedded e = embed(text, NH_CHART_COORDINATES);
    const nh_chart *c = e.chart;
    cr_assert_gt(c->implicit, (size_t)0);
    size_t n = draw(c, z);
    for (size_t p = 0; p < n; p += 4)
        for (size_t a = 0; a < c->implicit; a++) {
            check_derivatives(c, c->u[a], z[p]);
            check_derivatives(c, nh_diff(e.system->dag, c->u[a], c->symbol[1]), z[p]); /* the second ones too */
        }
    embed_clear(&e);
}

Test(embedding, derivative_rules_of_one_implicit_velocity)
{
    check_rules(SPACE "constraints: [\"z'^3 + (2 + x^2)*z' = x'^2 + y*y'*cos(t)\"]\ndependent: [z]\n");
}

Test(embedding, derivative_rules_of_two_implicit_velocities)
{
    check_rules(SPACE4 "constraints:\n  - z'^3 + 2*z' + 0.3*sin(s') = x*x'^2\n  - s'^3 + 3*s' = y*y' + 0.2*z'^2 - t\ndependent: [z, s]\n");
}

/* The explicit root of a quadratic constraint has the derivatives of the implicit function: f_z + f_u u_z = 0. */
Test(embedding, derivatives_of_the_quadratic_root)
{
    double z[points_wanted][most_width];
    embedded e = embed(SPEED "constraints: [\"z'^2 + x*z' = 3 + k^2*(x'^2 + y'^2)\"]\ndependent: [z]\n", NH_CHART_COORDINATES);
    nh_dag *d = e.system->dag;
    cr_expect_neq(e.chart->branch, 0);
    size_t n = draw(e.chart, z);
    nh_ex f = nh_chart_compose(e.chart, nh_chart_constraint(e.chart, 0));
    for (size_t j = 0; j < e.chart->width; j++) {
        nh_ex rate = nh_diff(d, f, e.chart->symbol[j]);
        for (size_t p = 0; p < n; p++) {
            double value;
            evaluate(e.chart, 1, &rate, z[p], &value);
            cr_expect(fabs(value) < 1e-13, "df/d%s = %.3g", nh_name_of(d, e.chart->symbol[j]), value);
        }
    }
    embed_clear(&e);
}

/* Where there is no solution, completing says so. */
Test(embedding, completion_fails_where_there_is_no_solution)
{
    embedded e = embed(SPACE "constraints: [\"z'^4 + z'^2 = x'\"]\ndependent: [z]\ndomain: {x': [0.5, 1], z': [0.4, 1]}\n", NH_CHART_COORDINATES);
    double good[] = {0, 0, 0, 0, 0.75, 0.2, 1.4}, bad[] = {0, 0, 0, 0, -0.75, 0.2, 1.4};
    cr_assert_eq(e.chart->implicit, 1u);
    cr_expect(nh_chart_complete(e.chart, good));
    cr_expect(fabs(good[6] - sqrt(0.5)) < 1e-15, "u^4 + u^2 = 3/4 at u^2 = 1/2, found u = %.17g", good[6]);
    cr_expect_not(nh_chart_complete(e.chart, bad));
    embed_clear(&e);
}

/* ---- the choice of dependent velocities ---- */

Test(embedding, named_dependent_velocities_are_eliminated)
{
    check_chart(SPACE "constraints: [\"z' = (2 + y)*x'\"]\n", 0, "z");
    check_chart(SPACE "constraints: [\"z' = (2 + y)*x'\"]\ndependent: [x]\n", 0, "x");
}

/* x' alone determines nothing where its factor vanishes, y' has the largest factor everywhere. */
Test(embedding, unnamed_dependent_velocities_are_the_safe_ones)
{
    check_chart(SPACE "constraints: [\"x*x' + (4 + x^2)*y' + sin(z)*z' = 0\"]\n", 0, "y");
}

Test(embedding, equally_good_velocities_leave_the_first_ones_free)
{
    check_chart(SPACE "constraints: [\"x' + y' + z' = 0\"]\n", 0, "z");
}

/* x' and y' have larger factors, which vanish somewhere. */
Test(embedding, velocities_that_are_determined_everywhere_come_first)
{
    check_chart(SPACE "constraints: [\"z - 3*x^2 - 5*y^3 = 1\"]\ndomain: {x: [1, 2], y: [1, 2]}\n", 0, "z");
    check_chart(SPACE4 "constraints: [\"z' = 7*x*x'\", \"s' = 9*y*y' + x*z'\"]\ndomain: {x: [1, 2], y: [1, 2]}\n", 0, "z s");
}

/* y' = tan(x) z' has a factor 1 for y', too, and a pole: nothing is determined there. */
Test(embedding, a_constraint_with_a_pole_has_no_chart_without)
{
    static const struct { const char *text; bool regular; } row[] = {{"z' = 7*x*x'", true}, {"y' = tan(x)*z'", false}, {"z' = y'/(x - 3)", false}, {"sin(x)*y' = cos(x)*z'", false}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        char text[1000];
        snprintf(text, sizeof text, SPACE "constraints: [\"%s\"]\n", row[i].text);
        embedded e = embed(text, NH_CHART_COORDINATES);
        cr_expect_eq(e.chart->regular, row[i].regular, "%s", row[i].text);
        embed_clear(&e);
    }
}

/* y' is named, and nowhere on the domain determined by x': another chart takes over.  Where it breaks down at points only, it stays. */
Test(embedding, a_named_chart_that_breaks_down_everywhere_is_replaced)
{
    static const char by_x[] = "constraints: [\"x'*sin(z) - y'*cos(z) = 0\"]\ndependent: [y]\n";
    for (int near = 0; near <= 1; near++) {
        char text[1000];
        snprintf(text, sizeof text, SPACE "%sdomain: {z: %s}\n", by_x, near ? "[1.565, 1.575]" : "[1.0, 2.0]");
        embedded e = embed(text, NH_CHART_COORDINATES);
        cr_expect_eq(e.chart->replaced, near);
        cr_expect_eq(e.chart->dependent[0], (size_t)(near ? 0 : 1));
        embed_clear(&e);
    }
}

Test(embedding, the_pivot_measures_the_choice)
{
    embedded good = embed(SPACE "constraints: [\"x*x' + (4 + x^2)*y' = 0\"]\n", NH_CHART_COORDINATES);
    embedded poor = embed(SPACE "constraints: [\"x*x' + (4 + x^2)*y' = 0\"]\ndependent: [x]\n", NH_CHART_COORDINATES);
    cr_expect_gt(good.chart->pivot, 0.9);
    cr_expect_lt(poor.chart->pivot, 0.1);
    embed_clear(&good);
    embed_clear(&poor);
}

/* ---- quasi-velocities ---- */

static const char RHEONOMIC_CHART[] =
    SPACE "constraints: [\"z' = y*x' + 0.8*t\"]\n"
          "velocities: {names: [u, s], map: [\"x' = (2 + x)*u + y*s + t\", \"y' = s - x*u\", \"z' = y*((2 + x)*u + y*s + t) + 0.8*t\"]}\n"
          "domain: {u: [-3, -2], t: [5, 6]}\n";

Test(embedding, the_map_is_rho)
{
    double z[points_wanted][most_width];
    embedded e = embed(RHEONOMIC_CHART, NH_CHART_AUTO);
    cr_expect(e.chart->quasi);
    cr_expect_str_eq(e.chart->name, "quasi-velocities (u, s)");
    check_constraints(e.chart, z, draw(e.chart, z));
    embed_clear(&e);
}

/* w(t, q, rho(t, q, w)) = w. */
Test(embedding, inverse_of_a_quasi_chart)
{
    double z[points_wanted][most_width], back[2];
    embedded e = embed(RHEONOMIC_CHART, NH_CHART_QUASI);
    nh_ex w[2];
    cr_assert(nh_chart_inverse(e.chart, w));
    for (size_t i = 0; i < 2; i++) {
        for (size_t j = 0; j < 2; j++) cr_expect_not(nh_depends(e.system->dag, w[i], e.system->quasi_velocity[j]), "velocities only");
        w[i] = nh_chart_compose(e.chart, w[i]);
    }
    size_t n = draw(e.chart, z);
    for (size_t p = 0; p < n; p++) {
        evaluate(e.chart, 2, w, z[p], back);
        for (size_t i = 0; i < 2; i++) cr_expect(fabs(back[i] - z[p][4 + i]) < 1e-12, "w%zu comes back as %.17g, not %.17g", i, back[i], z[p][4 + i]);
    }
    embed_clear(&e);
}

Test(embedding, inverse_of_a_coordinate_chart_and_of_a_nonlinear_map)
{
    nh_ex w[2];
    embedded own = embed(RHEONOMIC_CHART, NH_CHART_COORDINATES);
    cr_assert(nh_chart_inverse(own.chart, w));
    for (size_t i = 0; i < 2; i++) cr_expect_eq(w[i], own.chart->w[i]);
    embedded bent = embed("coordinates: [x]\nlagrangian: x'^2\nvelocities: {names: [u], map: [\"x' = sinh(u)\"]}\n", NH_CHART_AUTO);
    cr_expect_not(nh_chart_inverse(bent.chart, w), "sinh is not inverted by linear algebra");
    embed_clear(&own);
    embed_clear(&bent);
}

Test(embedding, a_chart_that_is_not_there)
{
    nh_error error = {0};
    char text[1000];
    nh_system *s = system_of("name: plain\n" SPACE);
    cr_assert_null(nh_chart_create(s, NH_CHART_QUASI, 1, &error));
    nh_error_format(&error, text, sizeof text);
    cr_expect_str_eq(text, "plain defines no quasi-velocities\nhint: add `velocities:` to the system file");
    cr_expect_eq(error.code, NH_USAGE);
    nh_system_free(s);
}

/* ---- independent or not: decided without rounding ---- */

/* The message that refuses a system, or "" for a chart; to be freed. */
static char *refusal(const char *text)
{
    nh_error error = {0};
    char *out = calloc(1, 2000);
    nh_system *s = system_of(text);
    nh_chart *chart = nh_chart_create(s, NH_CHART_AUTO, 1, &error);
    if (!chart) nh_error_format(&error, out, 2000);
    nh_chart_free(chart);
    nh_system_free(s);
    return out;
}

static const struct {
    const char *rest, *zero; /* %s: a small number, or 0 */
} twins[] = {
    {"constraints: [\"z' = x'\", \"z' = (1 + %s)*x'\"]\n", "rank 1"},
    {"constraints: [\"z' + sin(x)*s' = x'\", \"2*z' + (2 + %s)*sin(x)*s' = 2*x'\"]\n", "rank 1"},
    {"parameters: {e: %s}\nconstraints: [\"z' = y*x'\", \"z' = y*x' + e*s'\"]\n", "rank 1"},
    {"parameters: {e: %s}\nconstraints: [\"z' = x' + s'\", \"x' = s' - e*y'\", \"z' = 2*s'\"]\n", "rank 2"},
    {"constraints: [\"z' + s' = x'\", \"z' + (1 + %s)*s' = y*x'\"]\ndependent: [z, s]\n", "do not determine"},
    {"constraints: [\"z' = x'\", \"z' = x' + %s*y' + 1e-12\"]\n", "no common solution"},
    {"constraints: [\"z' = sqrt(2)*x'\", \"sqrt(3)*z' = (sqrt(6) + %s)*x'\"]\n", "rank 1"},
};

/* What depends on the others is refused, and what nearly does is not: a difference of 1e-15 is one. */
Test(embedding, constraints_depend_or_they_do_not)
{
    static const char *const small[] = {"1e-3", "1e-9", "1e-12", "1e-13", "1e-15", "-1e-14"};
    for (size_t i = 0; i < sizeof twins / sizeof *twins; i++)
        for (size_t j = 0; j <= sizeof small / sizeof *small; j++) {
            bool zero = j == sizeof small / sizeof *small;
            char text[500], rest[300];
            snprintf(rest, sizeof rest, twins[i].rest, zero ? "0" : small[j]);
            snprintf(text, sizeof text, SPACE4 "%s", rest);
            char *said = refusal(text);
            if (zero) cr_expect(strstr(said, twins[i].zero), "%s%s", text, said);
            else cr_expect_str_eq(said, "", "%s%s", text, said);
            free(said);
        }
}

/* Of quasi-velocities that double precision cannot tell apart nothing false is said. */
Test(embedding, quasi_velocities_depend_or_hardly_differ)
{
    static const struct {
        const char *slope, *said;
    } given[] = {{"1 + 1e-6", ""}, {"1 + 1e-13", "hardly differ"}, {"1", "dimension 2 with 3"}};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        char text[500];
        snprintf(text, sizeof text,
                 SPACE "velocities: {names: [u, w, r], map: [\"x' = u + w\", \"y' = u + (%s)*w\", \"z' = r\"]}\n",
                 given[i].slope);
        char *said = refusal(text);
        if (*given[i].said) cr_expect(strstr(said, given[i].said), "%s%s", text, said);
        else cr_expect_str_eq(said, "", "%s%s", text, said);
        free(said);
    }
}

/* ---- the sampling box ---- */

Test(embedding, the_box_is_the_domain_or_a_default_by_type)
{
    embedded e = embed("coordinates: [{name: phi, type: angle}, {name: x, type: length}]\nlagrangian: phi'^2 + x'^2\n"
                       "domain: {x: [2, 2.5], phi': [-0.25, 0.75]}\n", NH_CHART_AUTO);
    const double low[] = {0, -acos(-1), 2, -0.25, -1.5}, high[] = {1, acos(-1), 2.5, 0.75, 1.5};
    for (size_t i = 0; i < 5; i++) {
        cr_expect_eq(e.chart->low[i], low[i], "low of %s", nh_name_of(e.system->dag, e.chart->symbol[i]));
        cr_expect_eq(e.chart->high[i], high[i], "high of %s", nh_name_of(e.system->dag, e.chart->symbol[i]));
    }
    embed_clear(&e);
}

Test(embedding, probes_lie_in_the_box_and_on_the_constraints)
{
    embedded e = embed(SPACE "constraints: [\"z'^3 + 2*z' = x'^2 + y*y'\"]\ndependent: [z]\ndomain: {y: [3, 4]}\n", NH_CHART_COORDINATES);
    const nh_chart *c = e.chart;
    cr_assert_gt(c->probes, (size_t)10);
    for (size_t p = 0; p < c->probes; p++) {
        const double *z = c->probe + p * c->width;
        double f;
        evaluate(c, 1, c->residual, z, &f);
        cr_expect(fabs(f) < 1e-9, "probe %zu is off by %g", p, f);
        cr_expect(z[2] >= 3 && z[2] <= 4, "y = %g", z[2]);
    }
    embed_clear(&e);
}
