/* Closed shapes, and the planes of particular motions: letters that are left out, obstacles, invariance. */
#include "absence_cases.h"

#include "sweep.h"

static bool is_left_out(const absence_case *c, const char *name)
{
    bool found = false;
    for (size_t i = 0; i < c->shape->left; i++) found |= !strcmp(nh_name_of(c->of.model->dag, c->shape->left_out[i]), name);
    return found;
}

static void expect_planes(const char *system, size_t n, const char *const *words)
{
    absence_case c = absence_case_text(system);
    cr_assert_null(c.shape->obstacle, "%s", c.shape->obstacle);
    cr_expect_eq(c.planes, n, "%zu planes, not %zu: %s", c.planes, n, system);
    for (size_t i = 0; i < n && i < c.planes; i++) cr_expect_str_eq(c.plane[i].words, words[i]);
    absence_case_clear(&c);
}

/* ---- closed shapes ---- */

Test(closed_shape, left_out)
{
    /* z feeds nothing, u feeds z only; y feeds x */
    absence_case c = absence_case_text("name: n\ncoordinates: [x, y, z, u]\nlagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2 - x^2/2 - x^2*y\n"
                                       "constraints: [\"z' = (y + u)*x'\", \"u' = x*x'\"]\ndependent: [z, u]\n");
    /* (y + u) enters the inertia of x */
    cr_expect(is_left_out(&c, "z"));
    cr_expect_eq(c.shape->left, 1);
    cr_expect_eq(c.shape->coordinates, 3);
    cr_expect_eq(c.shape->count, 5);
    absence_case_clear(&c);
    c = absence_case_text("name: f\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n");
    cr_expect_eq(c.shape->coordinates, 0);
    cr_expect_eq(c.shape->count, 2);
    cr_expect_eq(c.planes, 0);
    absence_case_clear(&c);
}

Test(closed_shape, kept_for_an_integral)
{
    /* a force along y: no rate depends on y, but the energy does */
    absence_case c = absence_case_text("name: f\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^2 - 3*y\n");
    cr_expect_eq(c.shape->coordinates, 1);
    nh_closed_shape *whole = nh_closed_shape_keeping(c.arena, c.of.model, 1, &c.of.model->E);
    cr_expect_eq(whole->coordinates, 2);
    cr_expect_eq(whole->left, 0);
    cr_expect_eq(whole->letter[1], c.of.system->coordinate[1].q);
    absence_case_clear(&c);
}

Test(closed_shape, angles)
{
    static const struct {
        const char *potential;
        bool angle;
    } of[] = {{"cos(x)", true},          {"x^2", false},       {"cos(x)*sin(2*x)^3", true}, {"x*sin(x)", false}, {"cos(x/2)", false}, {"cos(x - y)", true},
              {"1/(2 + tan(x))", true}, {"exp(cos(x))", true}, {"cos(x*y)", false},        {"exp(x)", false},   {"cos(x)^2 + sqrt(2 + sin(x + 1))", true}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        nh_text text;
        nh_text_init(&text);
        nh_text_addf(&text, "name: a\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^2 - %s\n", of[i].potential);
        absence_case c = absence_case_text(nh_text_string(&text));
        cr_expect_eq(c.shape->angle[0], of[i].angle, "%s", of[i].potential);
        absence_case_clear(&c);
        nh_text_clear(&text);
    }
}

Test(closed_shape, obstacles)
{
    static const struct {
        const char *rest, *obstacle;
    } of[] = {{"lagrangian: x'^2/2 - x^2*(2 + cos(t))\n", "the equations contain the time"},
              {"lagrangian: x'^2/2 - V(x)\nfunctions: [V(r)]\n", "the system contains a function without a formula"},
              {"lagrangian: x'^2/2 - abs(x)^3\n", "the equations have kinks"},
              {"parameters: [{name: k, value: 1, input: true}]\nlagrangian: x'^2/2 - k*x^2\n", "the equations contain an input, which may change with time"}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        nh_text text;
        nh_text_init(&text);
        nh_text_addf(&text, "name: o\ncoordinates: [x]\n%s", of[i].rest);
        absence_case c = absence_case_text(nh_text_string(&text));
        cr_assert_not_null(c.shape->obstacle, "%s", of[i].rest);
        cr_expect_str_eq(c.shape->obstacle, of[i].obstacle);
        cr_expect_eq(c.planes, 0);
        absence_case_clear(&c);
        nh_text_clear(&text);
    }
}

/* ---- planes ---- */

Test(planes, single_coordinates)
{
    expect_planes("name: hh\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2*y + 5*y^3\n", 1, (const char *[]){"x = 0"});
    expect_planes("name: a\ncoordinates: [r, th]\nlagrangian: (3*r'^2 + r^2*th'^2)/2 + r*(cos(th) - 2)\n", 2, (const char *[]){"th = 0", "th = pi"});
    expect_planes("name: q\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - y^4 - 5*x^2*y^2\n", 4,
                  (const char *[]){"y = 0", "x = 0", "y = x", "y = -x"});
    expect_planes("name: one\ncoordinates: [x]\nlagrangian: x'^2/2 - x^4\n", 1, (const char *[]){"all motions"});
}

Test(planes, three_alike)
{
    /* a ring of three: all alike; two alike and one at rest would move it */
    expect_planes("name: r\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - x^4 - y^4 - z^4 - (x - y)^3*(x + 3*y) - (y - z)^3*(y + 3*z) - (z - x)^3*(z + 3*x)\n",
                  1, (const char *[]){"y = x, z = x"});
}

Test(planes, two_angles)
{
    /* equal pendulums on springs: both together, against each other, and one half a turn behind */
    expect_planes("name: p\ncoordinates: [a, b]\nlagrangian: (a'^2 + b'^2)/2 + cos(a) + cos(b) - (sin(a) - sin(b))^2/3\n", 2, (const char *[]){"b = a", "b = -a"});
    expect_planes("name: p\ncoordinates: [a, b]\nlagrangian: (a'^2 + b'^2)/2 - cos(2*a - 2*b) - cos(a)^2 - cos(b)^2\n", 4,
                  (const char *[]){"b = a", "b = a + pi", "b = -a", "b = pi - a"});
}

Test(planes, none)
{
    expect_planes("name: d\ncoordinates: [p, q]\nlagrangian: 2*p'^2 + q'^2 + p'*q'*cos(p - q) + 9*cos(p) + 3*cos(q)\n", 0, NULL);
    absence_case c = absence_case_of(mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL));
    cr_expect_eq(c.planes, 0);
    cr_expect_eq(c.shape->coordinates, 0);
    absence_case_clear(&c);
}

Test(planes, poles_are_none)
{
    /* x y' - .. divided by x: 0/0 on x = 0, although the quotient cancels in numbers nearby; and r = 0, theta = 0 */
    expect_planes("name: k\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^2 - x^2/(x^2 + y^4)^2*x^2 - y*x^4/x^2\n", 1, (const char *[]){"x = 0"});
    expect_planes("name: k\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^2 - 1/x^2\n", 1, (const char *[]){"y = 0"});
    expect_planes("name: k\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^2 - (x^2 + x^4)^(7/2)\n", 1, (const char *[]){"y = 0"});
    expect_planes("name: s\ncoordinates: [h, {name: p, type: angle}]\nlagrangian: (h'^2 + sin(h)^2*p'^2)/2 - cos(h)^2 - sin(h)^2*cos(2*p)\n", 6,
                  (const char *[]){"p = 0", "p = pi", "p = pi/2", "p = -pi/2", "h = pi/2", "h = -pi/2"});
}

Test(planes, roots)
{
    /* r = |y| is y or -y; between two centres one distance grows, one falls */
    expect_planes("name: k\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt(x^2 + y^2) - x^2 - y\n", 2, (const char *[]){"x = 0, y > 0", "x = 0, y < 0"});
    expect_planes("name: k\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt((x - 1)^2 + y^2) + 2/sqrt((x + 1)^2 + y^2)\n", 3,
                  (const char *[]){"y = 0, x > 0", "y = 0, x < 0", "y = 0, x near 0"});
    expect_planes("name: k\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt(x^4 + y^2)*(1 + y^2) - x\n", 1, (const char *[]){"y = 0"});
}

Test(planes, values_of_parameters)
{
    const char *text = "name: v\nparameters: [{name: c, value: 0}, {name: k, value: 2}]\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - k*y^4 - x^2*y - c*x*y^2\n";
    absence_case c = absence_case_text(text);
    cr_assert_eq(c.planes, 1);
    cr_expect_str_eq(c.plane[0].words, "x = 0");
    cr_expect_not(c.plane[0].generic); /* for c = 0 only */
    absence_case_clear(&c);
    c = absence_case_text("name: v\nparameters: [{name: k, value: 2}]\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - k*y^4 - x^2*y\n");
    cr_assert_eq(c.planes, 1);
    cr_expect(c.plane[0].generic);
    absence_case_clear(&c);
}

/* ---- of every system: the change of letters, and the plane is invariant ---- */

static double from_seed(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return 0.2 + (*seed >> 8) / 16777216.0;
}

static nh_tape *tape_of(const absence_case *c, const nh_ex *in, size_t n, const nh_ex *out)
{
    const nh_model *m = c->of.model;
    return nh_tape_create(m->dag, c->shape->count, in, n, out, m->system->parameters, m->parameter, m->parameter_value);
}

static void run(nh_tape *tape, const double *in, double *out)
{
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, in, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

enum { most_letters = 16 };

/* The rates of y are those of the letters: z' = T y', by the letters a step along them. */
static void expect_change(const absence_case *c, const nh_plane *plane, const double *y)
{
    size_t n = c->shape->count;
    double z[most_letters], rate_z[most_letters], rate_y[most_letters], moved[most_letters], further[most_letters], step = 1e-3;
    run(tape_of(c, plane->y, n, plane->letter), y, z);
    run(tape_of(c, c->shape->letter, n, c->shape->rate), z, rate_z);
    run(tape_of(c, plane->y, n, plane->rate), y, rate_y);
    for (size_t i = 0; i < n; i++) moved[i] = y[i] + step * rate_y[i];
    run(tape_of(c, plane->y, n, plane->letter), moved, further); /* affine: exact */
    for (size_t i = 0; i < n; i++)
        if (isfinite(rate_z[i]) && fabs(rate_z[i]) < 1e6)
            cr_expect_float_eq((further[i] - z[i]) / step, rate_z[i], 1e-7 * (1 + fabs(rate_z[i])), "%s, %s: letter %zu", c->of.system->name, plane->words, i);
}

static void expect_invariant(const absence_case *c, const nh_plane *plane, double x, double w)
{
    size_t n = c->shape->count;
    double y[most_letters] = {x, w}, rate[most_letters], moving;
    run(tape_of(c, plane->y, n, plane->rate), y, rate);
    run(tape_of(c, plane->y, 1, &plane->moving_rate), y, &moving);
    if (!isfinite(rate[0])) return;
    cr_expect_float_eq(moving, rate[0], 1e-9 * (1 + fabs(moving)), "%s, %s", c->of.system->name, plane->words);
    for (size_t i = 2; i < n; i++) cr_expect_float_eq(rate[i], 0, 1e-8 * (1 + fabs(rate[1])), "%s, %s: %zu", c->of.system->name, plane->words, i);
}

Test(planes, of_every_system)
{
    char *name[most_files];
    size_t n = list("systems", name), seen = 0;
    for (size_t i = 0; i < n; i++) {
        char path[300];
        nh_error error = {0};
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        free(name[i]);
        if (!sweep_tries(i, 2, 8)) continue;
        nh_system *system = nh_system_read(path, 0, NULL, &error);
        nh_chart *chart = system ? nh_chart_create(system, NH_CHART_AUTO, 1, &error) : NULL;
        nh_model *model = chart ? nh_model_create(system, chart, &error) : NULL;
        if (!model) {
            nh_system_free(system);
            continue;
        }
        absence_case c = absence_case_of((mechanics){system, model});
        cr_assert_leq(c.shape->count, (size_t)most_letters);
        for (size_t p = 0; p < c.planes; p++) {
            unsigned seed = 7;
            double y[most_letters];
            for (size_t k = 0; k < c.shape->count; k++) y[k] = from_seed(&seed);
            expect_change(&c, &c.plane[p], y);
            expect_invariant(&c, &c.plane[p], 0.41, 0.73);
            expect_invariant(&c, &c.plane[p], 1.17, -0.52);
            seen++;
        }
        absence_case_clear(&c);
    }
    cr_expect_gt(seen, (size_t)(sweep_sanitized() ? 5 : 40));
}
