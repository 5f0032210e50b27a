/* Growth vectors and hidden holonomic constraints: the classical distributions, the same ones in other coordinates and by other constraints, where
 * the growth drops, and which currents the constraints alone conserve. */
#include "mechanics.h"
#include "random_expression.h"
#include "sweep.h"

#include <stdio.h>

#include "exact/generic_value.h"
#include "geometry/distribution.h"
#include "graph/diff.h"
#include "commands/analyze.h"
#include "graph/dag.h"
#include "graph/node.h"

enum { most_coordinates = 6 };

typedef struct {
    const char *name;
    size_t m, k;
    const char *constraint[4]; /* in X1..Xm and their velocities V1..Vm */
    size_t length, growth[NH_MOST_GROWTH], hidden;
    nh_growth_space space;
} flat;

/* Heisenberg; Cartan (2,3,5) [Cartan1910]; Engel; Goursat = chained forms, which cars with trailers have [MurraySastry1993]; the rank 3 distribution of a
 * contact form in five dimensions; integrable ones with an integrating factor (theta = dX3 - (X3 + X1)(dX1 + dX2) - dX1 has d theta ^ theta = 0);
 * partly integrable ones.  Affine: on time and positions. */
static const flat FLAT[] = {
    {"Heisenberg", 3, 1, {"V3 = X2*V1 - X1*V2"}, 2, {2, 3}, 0, NH_ON_POSITIONS},
    {"Engel", 4, 2, {"V3 = X2*V1", "V4 = X3*V1"}, 3, {2, 3, 4}, 0, NH_ON_POSITIONS},
    {"Goursat", 5, 3, {"V3 = X2*V1", "V4 = X3*V1", "V5 = X4*V1"}, 4, {2, 3, 4, 5}, 0, NH_ON_POSITIONS},
    {"Cartan", 5, 3, {"V3 = X1*V2", "V4 = X1^2*V2/2", "V5 = X1*X2*V2"}, 3, {2, 3, 5}, 0, NH_ON_POSITIONS},
    {"contact", 5, 1, {"V5 = X1*V2 + X3*V4"}, 2, {4, 5}, 0, NH_ON_POSITIONS},
    {"free step", 6, 3, {"V4 = X2*V1", "V5 = X3*V1", "V6 = X3*V2"}, 2, {3, 6}, 0, NH_ON_POSITIONS},
    {"integrable", 3, 1, {"V3 = (X3 + X1)*(V1 + V2) - V1"}, 1, {2}, 1, NH_ON_POSITIONS},
    {"integrable twice", 4, 2, {"V3 = X1*V2 + X2*V1", "V4 = X4*X3*V3"}, 1, {2}, 2, NH_ON_POSITIONS},
    {"half of it", 4, 2, {"V3 = X2*V1", "V4 = X4*(X1*V2 + X2*V1)"}, 2, {2, 3}, 1, NH_ON_POSITIONS},
    {"a third of it", 5, 3, {"V3 = X2*V1", "V4 = X3*V1", "V5 = V3 + X1*V1"}, 3, {2, 3, 4}, 1, NH_ON_POSITIONS},
    {"affine", 3, 1, {"V3 = X2*V1 + X1"}, 2, {3, 4}, 0, NH_ON_EVENTS},
    {"affine drift that steers", 3, 2, {"V2 = X1", "V3 = X2"}, 3, {2, 3, 4}, 0, NH_ON_EVENTS},
    {"affine, integrable", 3, 1, {"V3 = X3*(1 + V1)"}, 1, {3}, 1, NH_ON_EVENTS},
    {"affine, half", 4, 2, {"V3 = X2*V1 + X1", "V4 = X1*V1 + 2"}, 2, {3, 4}, 1, NH_ON_EVENTS},
    {"with time", 3, 1, {"V3 = t*X2*V1"}, 2, {3, 4}, 0, NH_ON_EVENTS},
    {"with time, integrable", 3, 1, {"V3 = t*V1 + X1 + exp(t)*V2 + exp(t)*X2"}, 1, {3}, 1, NH_ON_EVENTS},
};

/* X_i = x_i + products of x_j, x_k with j < i; its velocity by hand; both as definitions of the system. */
static void change(nh_text *to, source *random, size_t i, bool plain)
{
    nh_text_addf(to, "  - X%zu = x%zu", i, i);
    nh_text rate;
    nh_text_init(&rate);
    if (i > 1 && !plain) {
        int j = 1 + random_below(random, (int)i - 1), k = 1 + random_below(random, (int)i - 1), c = 1 + random_below(random, 5);
        nh_text_addf(to, " + %d/7*x%d*x%d", c, j, k);
        nh_text_addf(&rate, " + %d/7*(x%d'*x%d + x%d*x%d')", c, j, k, j, k);
    }
    nh_text_addf(to, "\n  - V%zu = x%zu'%s\n", i, i, nh_text_string(&rate));
    nh_text_clear(&rate);
}

/* The distribution in other coordinates, which come in another order, and by combinations of the constraints. */
static void system_text(nh_text *to, const flat *f, source *random, bool plain)
{
    size_t offset = plain ? 0 : (size_t)random_below(random, (int)f->m);
    nh_text_add(to, "name: flat\ncoordinates: [");
    for (size_t i = 0; i < f->m; i++) nh_text_addf(to, "%sx%zu", i ? ", " : "", 1 + (i + offset) % f->m);
    nh_text_add(to, "]\nlagrangian: ");
    for (size_t i = 1; i <= f->m; i++) nh_text_addf(to, "%sx%zu'^2/2", i > 1 ? " + " : "", i);
    nh_text_add(to, "\ndefinitions:\n");
    for (size_t i = 1; i <= f->m; i++) change(to, random, i, plain);
    nh_text_add(to, "domain: {t: [0.2, 1]");
    for (size_t i = 1; i <= f->m; i++) nh_text_addf(to, ", x%zu: [0.3, 1.1]", i);
    nh_text_add(to, "}\nconstraints:\n");
    for (size_t a = 0; a < f->k; a++) {
        const char *equals = strchr(f->constraint[a], '=');
        int n = (int)(equals - f->constraint[a]);
        nh_text_addf(to, "  - %.*s - (%s)", n, f->constraint[a], equals + 1);
        if (a && !plain) {
            const char *before = strchr(f->constraint[a - 1], '=');
            nh_text_addf(to, " + (1 + X1)*(%.*s - (%s))", (int)(before - f->constraint[a - 1]), f->constraint[a - 1], before + 1);
        }
        nh_text_add(to, " = 0\n");
    }
}

static void check_flat(const flat *f, const char *text)
{
    mechanics x = mechanics_of_text(text, NH_CHART_COORDINATES);
    nh_distribution d = nh_distribution_of(x.model);
    cr_assert_eq(d.growth.space, f->space, "%s: growth on space %d\n%s", f->name, d.growth.space, text);
    cr_assert_eq(d.growth.length, f->length, "%s: growth vector of length %zu\n%s", f->name, d.growth.length, text);
    for (size_t i = 0; i < f->length; i++) cr_assert_eq(d.growth.rank[i], f->growth[i], "%s: growth_%zu is %zu\n%s", f->name, i, d.growth.rank[i], text);
    cr_assert_eq(d.hidden, f->hidden, "%s: %zu hidden\n%s", f->name, d.hidden, text);
    cr_assert(d.growth.proved, "%s is not proved\n%s", f->name, text);
    cr_assert_eq(d.holonomic, f->hidden == f->k, "%s\n%s", f->name, text);
    const char *kind = nh_constraint_integrability(x.model, &d);
    cr_assert_str_eq(kind, f->hidden == f->k ? "integrable" : f->hidden ? "partly integrable" : "nonholonomic");
    mechanics_clear(&x);
}

static void flat_ones(bool plain, uint64_t seed)
{
    source random = source_create(seed);
    for (size_t i = 0; i < sizeof FLAT / sizeof *FLAT; i++) {
        nh_text text;
        nh_text_init(&text);
        system_text(&text, &FLAT[i], &random, plain);
        check_flat(&FLAT[i], nh_text_string(&text));
        nh_text_clear(&text);
    }
    nh_dag_free(random.dag);
}

Test(distribution, the_classical_growth_vectors) { flat_ones(true, 1); }

Test(distribution, growth_does_not_depend_on_coordinates_and_on_how_constraints_are_written, PLAIN_ONLY)
{
    for (uint64_t seed = 1; seed <= 2; seed++)
        if (sweep_tries(seed, 2, 1)) flat_ones(false, seed);
}

/* ---- singular places ---- */

typedef struct {
    const char *constraint, *where; /* where NULL: it does not drop */
    size_t length, growth[NH_MOST_GROWTH];
} place;

/* Martinet's surface y = 0; a degree higher; a fold that the origin alone shows; none. */
static const place PLACES[] = {
    {"z' = y^2*x'", "y", 3, {2, 2, 3}},
    {"z' = y^3*x'", "y", 4, {2, 2, 2, 3}},
    {"z' = (x^2 + y^2)*(x*y' - y*x')", "origin", 4, {2, 2, 2, 3}},
    {"z' = y*x'", NULL, 0, {0}},
    {"z' = (y + 2)^2*x'", NULL, 0, {0}},
};

Test(distribution, where_growth_drops)
{
    for (size_t i = 0; i < sizeof PLACES / sizeof *PLACES; i++) {
        nh_text text;
        nh_text_init(&text);
        nh_text_addf(&text, "name: place\ncoordinates: [x, y, z]\nlagrangian: x'^2 + y'^2 + z'^2\nconstraints: [\"%s\"]\n", PLACES[i].constraint);
        mechanics x = mechanics_of_text(nh_text_string(&text), NH_CHART_COORDINATES);
        nh_distribution d = nh_distribution_of(x.model);
        const nh_growth *g = &d.growth;
        cr_expect(g->length == 2 && g->rank[0] == 2 && g->rank[1] == 3, "%s", PLACES[i].constraint);
        cr_assert_eq(g->drops, PLACES[i].where != NULL, "%s: drops %d", PLACES[i].constraint, g->drops);
        if (g->drops) {
            cr_expect_str_eq(g->where ? nh_name_of(x.system->dag, g->where) : "origin", PLACES[i].where);
            cr_expect_eq(g->length_there, PLACES[i].length, "%s: %zu ranks there", PLACES[i].constraint, g->length_there);
            for (size_t j = 0; j < PLACES[i].length; j++) cr_expect_eq(g->rank_there[j], PLACES[i].growth[j], "%s: rank %zu", PLACES[i].constraint, g->rank_there[j]);
        }
        mechanics_clear(&x);
        nh_text_clear(&text);
    }
}

/* ---- a chart that bends, a chart that moves ---- */

static const char POLAR[] =
    "name: polar\ncoordinates: [x, y, z]\nlagrangian: x'^2 + y'^2 + z'^2\nconstraints: [\"z' = y*x' - x*y'%s\"]\n"
    "velocities:\n  names: [u, b]\n  map:\n    - x' = u*cos(b)%s\n    - y' = u*sin(b)\n    - z' = y*u*cos(b) - x*u*sin(b)%s%s\n"
    "domain: {u: [0.4, 1.5], b: [0.1, 1.3]}\n";

Test(distribution, a_chart_has_no_part_in_it)
{
    static const struct {
        const char *drift, *moving, *along, *plus;
        nh_constraint_type type;
        size_t rank[2];
    } cases[] = {{"", "", "", "", NH_LINEAR, {2, 3}}, {" + 1", "", "", " + 1", NH_AFFINE, {3, 4}}, {"", " + t*u", " + y*t*u", "", NH_LINEAR, {2, 3}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[900];
        snprintf(text, sizeof text, POLAR, cases[i].drift, cases[i].moving, cases[i].along, cases[i].plus);
        mechanics x = mechanics_of_text(text, NH_CHART_QUASI);
        nh_distribution d = nh_distribution_of(x.model);
        cr_expect_eq(d.type, cases[i].type, "case %zu is %s", i, nh_constraint_type_name(d.type));
        cr_expect(!d.rheonomic && d.growth.length == 2, "case %zu: length %zu", i, d.growth.length);
        for (size_t j = 0; j < 2; j++) cr_expect_eq(d.growth.rank[j], cases[i].rank[j], "case %zu: rank %zu", i, d.growth.rank[j]);
        mechanics_clear(&x);
    }
}

/* ---- the functions ---- */

static nh_analysis *analysed(const char *text, nh_error *error)
{
    FILE *file = fopen("build/hidden_test.yaml", "w");
    cr_assert_not_null(file);
    fputs(text, file);
    fclose(file);
    nh_request q = {.system_path = "build/hidden_test.yaml"};
    nh_options_default(&q.options);
    q.options.max_seconds = 60;
    return nh_analysis_create(&q, error);
}

#define THREE "coordinates: [x, y, z]\nlagrangian: x'^2/2 + y'^2 + z'^2/2 - x*y\ndomain: {x: [0.2, 1.3], y: [0.2, 1.1], z: [0.3, 1.2]}\n"

static const struct {
    const char *text, *function; /* what must be a function of those found; NULL: none of them */
    size_t hidden, found;
    bool local;
} FUNCTIONS[] = {
    {THREE "constraints: [\"x*x' + y*y' + z*z' = 0\"]\n", "x^2 + y^2 + z^2", 1, 1, false},
    {THREE "constraints: [\"x^2 + y^2 + z^2 = 1\"]\n", NULL, 0, 0, false},
    {THREE "constraints: [\"z' = x'*y + x*y' + 1\"]\n", "z - x*y - t", 1, 1, false},
    {THREE "constraints: [\"z' = y*x'\"]\n", NULL, 0, 0, false},
    {THREE "constraints: [\"z' = z*x'\"]\n", "z*exp(-x)", 1, 1, false},
    {THREE "constraints: [\"z' = cos(x)*x' + t*y' + y\"]\n", "z - t*y - sin(x)", 1, 1, false},
    {THREE "constraints: [\"z' = (z + x)*(x' + y') - x'\"]\n", "(z + x)*exp(-x - y)", 1, 1, false},
    {"coordinates: [{name: p, type: angle}, {name: q, type: angle}, z]\nlagrangian: p'^2 + q'^2 + z'^2/2\nconstraints: [\"p' = 3*q' + 2*z*z'\"]\n", "p - 3*q - z^2", 1, 1, true},
    {THREE "constraints: [\"x'^2 + y'^2 = 4\", \"z' = x'*y + x*y'\"]\n", "z - x*y", 1, 1, false},
    {"coordinates: [x, y, z, u]\nlagrangian: x'^2 + y'^2 + z'^2 + u'^2\nconstraints: [\"z' = y*x'\", \"u' = x'*y + y'*x + z' - y*x'\"]\n", "u - x*y", 1, 1, false},
};

Test(distribution, the_functions_that_constraints_conserve)
{
    for (size_t i = 0; i < sizeof FUNCTIONS / sizeof *FUNCTIONS; i++) {
        if (!sweep_tries(i, 4, 16)) continue;
        nh_error error;
        nh_error_clear(&error);
        nh_analysis *r = analysed(FUNCTIONS[i].text, &error);
        must(r != NULL, &error, FUNCTIONS[i].text);
        cr_expect_eq(r->question->constraint.hidden, FUNCTIONS[i].hidden, "%s: %zu hidden", FUNCTIONS[i].text, r->question->constraint.hidden);
        cr_assert_eq(r->integrals, FUNCTIONS[i].found, "%s: %zu functions", FUNCTIONS[i].text, r->integrals);
        for (size_t j = 0; j < r->integrals; j++) {
            const nh_current *f = &r->list->found[r->integral[j]];
            nh_ex pair[2] = {formula(r->question->model, FUNCTIONS[i].function), f->phi};
            nh_independence kind[2];
            nh_points *points = nh_points_create(r->question->model, 24, 1, 99, &error);
            nh_independence_test(r->question->model, points, 2, pair, NULL, 1e-2, 1e-6, kind, NULL);
            cr_expect_eq(kind[1], NH_DEPENDENT, "%s is not a function of %s", f->name, FUNCTIONS[i].function);
            cr_expect_eq(f->local, FUNCTIONS[i].local);
            cr_expect_str_eq(f->meaning, "integral of the constraints");
            nh_points_free(points);
        }
        nh_analysis_free(r);
    }
}

/* ---- the same for every seed ---- */

static void describe(const nh_distribution *d, nh_text *out)
{
    const nh_growth *g = &d->growth;
    nh_text_addf(out, "%s, %zu hidden, growth", nh_constraint_type_name(d->type), d->hidden);
    for (size_t i = 0; i < g->length; i++) nh_text_addf(out, " %zu", g->rank[i]);
    nh_text_addf(out, " of %zu, %s%s", g->dimension, g->proved ? "proved" : "not proved", g->cut ? ", cut" : "");
    for (size_t i = 0; i < g->length_there; i++) nh_text_addf(out, "%s%zu", i ? " " : "; there ", g->rank_there[i]);
}

static char *distribution_of(const char *path, nh_chart_choice choice, uint64_t seed)
{
    nh_error error = {0};
    nh_text text;
    nh_text_init(&text);
    nh_system *system = nh_system_read(path, 0, NULL, &error);
    must(system != NULL, &error, path);
    nh_chart *chart = nh_chart_create(system, choice, seed, &error);
    nh_model *model = chart ? nh_model_create(system, chart, &error) : NULL;
    must(model != NULL, &error, path);
    nh_distribution d = nh_distribution_of(model);
    describe(&d, &text);
    nh_model_free(model);
    nh_system_free(system);
    char *copy = strdup(nh_text_string(&text));
    nh_text_clear(&text);
    return copy;
}

static void same_for_seeds(const char *path, uint64_t seeds)
{
    char *first = distribution_of(path, NH_CHART_COORDINATES, 1);
    for (uint64_t seed = 2; seed <= seeds; seed++) {
        char *other = distribution_of(path, NH_CHART_COORDINATES, seed);
        cr_expect_str_eq(other, first, "%s, seed %zu: %s; seed 1: %s", path, (size_t)seed, other, first);
        free(other);
    }
    free(first);
}

Test(distribution, growth_is_the_same_for_every_seed)
{
    char *name[most_files];
    size_t count = list("systems", name);
    for (size_t i = 0; i < count; i++) {
        char path[300];
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        if (sweep_tries(i + 1, 20, 40)) same_for_seeds(path, sweep_whole() ? 10 : 3);
        free(name[i]);
    }
}

/* The coefficients of this bicycle's brackets differ by many orders of magnitude from seed to seed. */
Test(distribution, the_heights_of_a_bicycle_are_hidden_constraints, PLAIN_ONLY)
{
    const char *path = "tests/data/bicycle_floating.yaml";
    for (uint64_t seed = 1; seed <= 10; seed++) {
        if (!sweep_tries(seed - 1, 5, 10)) continue;
        char *found = distribution_of(path, NH_CHART_COORDINATES, seed);
        cr_expect_str_eq(found, "linear, 2 hidden, growth 3 5 7 of 9, proved", "seed %zu: %s", (size_t)seed, found);
        free(found);
    }
}

/* The program knows the heights because it made the constraints: their rates are the constraints. */
Test(distribution, a_wheel_knows_its_height)
{
    mechanics x = mechanics_of_file("tests/data/bicycle_floating.yaml", NH_CHART_COORDINATES, 0, NULL);
    const nh_system *y = x.system;
    nh_ex v[20];
    size_t heights = 0, width = y->coordinates;
    for (size_t s = 0; s < width; s++) v[s] = y->coordinate[s].v;
    for (size_t a = 0; a < y->constraints; a++) {
        const nh_constraint *c = &y->constraint[a];
        if (!c->level) continue;
        nh_ex rate = nh_sub(y->dag, c->rhs, c->lhs);
        for (size_t s = 0; s < width; s++) rate = nh_add(y->dag, rate, nh_mul(y->dag, nh_diff(y->dag, c->level, y->coordinate[s].q), v[s]));
        nh_ex q[40];
        for (size_t s = 0; s < width; s++) q[s] = y->coordinate[s].q, q[width + s] = v[s];
        cr_expect(!nh_generic_nonzero(y->dag, 1, &rate, 2 * width, q), "constraint %zu", a);
        cr_expect(nh_generic_nonzero(y->dag, 1, &c->level, 2 * width, q));
        heights++;
    }
    cr_expect_eq(heights, 2);
    mechanics_clear(&x);
}

/* Parameters and decimals are exact: a small bracket is a bracket. */
Test(distribution, small_brackets_count)
{
    static const struct {
        const char *constraint;
        size_t length, rank[3];
    } cases[] = {{"z' = x*y' + (1 + 1e-12)*y*x'", 2, {2, 3}},
                 {"z' = x*y' + (1 + 1e-40)*y*x'", 2, {2, 3}},
                 {"z' = x*y' + (1 + 0)*y*x'", 1, {2}},
                 {"z' = x*y' + y*x' + 1e-20*sin(x)*cos(pi/7)*y'", 2, {2, 3}},
                 {"z' = x*y' + y*x' + 1e-20*(cos(pi/5) - 1/4 - sqrt(5)/4)*x*y'", 1, {2}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text, "name: small\ncoordinates: [x, y, z]\nlagrangian: x'^2 + y'^2 + z'^2\nconstraints: [\"%s\"]\n", cases[i].constraint);
        mechanics x = mechanics_of_text(text, NH_CHART_COORDINATES);
        nh_distribution d = nh_distribution_of(x.model);
        cr_expect(d.growth.length == cases[i].length && !d.growth.by_numbers, "%s", cases[i].constraint);
        for (size_t j = 0; j < cases[i].length; j++) cr_expect_eq(d.growth.rank[j], cases[i].rank[j], "%s: %zu", cases[i].constraint, d.growth.rank[j]);
        mechanics_clear(&x);
    }
}

/* Inertia 1e-15 times as large as another is inertia; without any the message stays. */
Test(distribution, small_inertia_counts)
{
    mechanics x = mechanics_of_text("name: light\ncoordinates: [x, y]\nlagrangian: (x' + y')^2/2 + 1e-15*y'^2/2 - x^2/2\n", NH_CHART_COORDINATES);
    mechanics_clear(&x);
    nh_error error = {0};
    nh_system *system = nh_system_parse("test.yaml", "name: none\ncoordinates: [x, y]\nlagrangian: (x' + y')^2/2 - x^2/2\n", 0, NULL, &error);
    nh_model *model = nh_model_create(system, nh_chart_create(system, NH_CHART_COORDINATES, 1, &error), &error);
    cr_expect_null(model);
    char message[2600];
    nh_error_format(&error, message, sizeof message);
    cr_expect(strstr(message, "rank 1 of 2"), "%s", message);
    nh_system_free(system);
}
