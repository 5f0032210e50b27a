/* Cyclic coordinates that the count leaves out: which they are, and that the number of integrals stays the same. */
#include <criterion/criterion.h>
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "count/count_internal.h"
#include "count/turned_translations.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "names.h"
#include "sweep.h"

static nh_model *model_of(nh_system *s)
{
    nh_error error = {0};
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    cr_assert_not_null(o, "%s", error.what);
    return o;
}

#define HEAD(coordinates, names) "name: turned\ncoordinates: [" coordinates "]\nvelocities:\n  names: [" names "]\n  map:\n"
#define PLANAR "    - x' = u*cos(phi)\n    - y' = u*sin(phi)\n"
#define KINETIC "(x'^2 + y'^2 + phi'^2)/2"

/* A blade whose centre of mass is a before it. */
static const char SLEIGH[] = HEAD("phi, x, y", "w, u") "    - phi' = w\n" PLANAR
    "constraints: [\"y'*cos(phi) = x'*sin(phi)\"]\nlagrangian: " KINETIC " + phi'*(y'*cos(phi) - x'*sin(phi)) + phi'^2\n";
/* The same on a turned and sheared grid, and with the heading in other units. */
static const char SHEARED[] = HEAD("phi, x, y", "w, u")
    "    - phi' = w\n    - x' = u*(cos(2*phi) + sin(2*phi))\n    - y' = u*sin(2*phi)\n"
    "constraints: [\"y'*(cos(2*phi) + sin(2*phi)) = x'*sin(2*phi)\"]\nlagrangian: ((x' - y')^2 + y'^2 + phi'^2)/2 + phi'^2\n";
/* A trailer whose angle is measured from the x axis: only both angles together turn. */
static const char TRAILER[] = HEAD("phi, psi, x, y", "w, u")
    "    - phi' = w\n    - psi' = u*sin(phi - psi)\n" PLANAR
    "constraints: [\"y'*cos(phi) = x'*sin(phi)\", \"psi' = (x'*cos(phi) + y'*sin(phi))*sin(phi - psi)\"]\nlagrangian: " KINETIC " + psi'^2/2\n";
/* A wheel counts the turns: psi - phi is constant, and both have to turn. */
static const char COUNTER[] = HEAD("phi, psi, x, y", "w, u") "    - phi' = w\n    - psi' = w\n" PLANAR
    "constraints: [\"y'*cos(phi) = x'*sin(phi)\", \"psi' = phi'\"]\nlagrangian: " KINETIC " + psi'^2 + phi'*(x'*cos(phi) + y'*sin(phi))\n";
/* The wheel is on a spring: what turns the plane moves from one leaf to another. */
static const char SPRING[] = HEAD("phi, psi, x, y", "w, u") "    - phi' = w\n    - psi' = w\n" PLANAR
    "constraints: [\"y'*cos(phi) = x'*sin(phi)\", \"psi' = phi'\"]\nlagrangian: " KINETIC " + psi'^2 - psi^2/2\n";
/* Without velocities of the user's own: x', which is turned into y' = x' tan(phi), or into one of two free rates. */
static const char PLAIN[] = "name: turned\ncoordinates: [phi, x, y]\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n"
    "lagrangian: " KINETIC " + phi'*(y'*cos(phi) - x'*sin(phi)) + phi'^2\n";
static const char LINKS[] = "name: turned\ncoordinates: [x, y, phi, psi]\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n"
    "lagrangian: " KINETIC " + psi'^2/2 + ((x' - phi'*sin(phi) - psi'*sin(psi))^2 + (y' + phi'*cos(phi) + psi'*cos(psi))^2)/2\n";
/* A wheel that rolls upright, with a mass on a spring beside it. */
static const char BESIDE[] = "name: turned\ncoordinates: [x, y, phi, q]\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n"
    "lagrangian: " KINETIC " + ((x' - q'*sin(phi) - q*phi'*cos(phi))^2 + (y' + q'*cos(phi) - q*phi'*sin(phi))^2)/2 - q^2\n";
/* It is heavier northwards: nothing turns. */
static const char HEAVY[] = "name: turned\ncoordinates: [phi, x, y]\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\nlagrangian: " KINETIC " + y'^2\n";
/* A north. */
static const char COMPASS[] = HEAD("phi, x, y", "w, u") "    - phi' = w\n" PLANAR
    "constraints: [\"y'*cos(phi) = x'*sin(phi)\"]\nlagrangian: " KINETIC " + cos(phi)\n";
/* On a slope only x is cyclic, and turns into y. */
static const char SLOPE[] = HEAD("phi, x, y", "w, u") "    - phi' = w\n" PLANAR
    "constraints: [\"y'*cos(phi) = x'*sin(phi)\"]\nlagrangian: " KINETIC " - y\n";
/* A wheel that rolls upright: x - phi' sin .. are integrals that are linear in its place. */
static const char WHEEL[] = HEAD("phi, psi, x, y", "w, v") "    - phi' = w\n    - psi' = v\n    - x' = v*cos(phi)\n    - y' = v*sin(phi)\n"
    "constraints: [\"x' = psi'*cos(phi)\", \"y' = psi'*sin(phi)\"]\nlagrangian: " KINETIC " + psi'^2/2\n";
/* The hyperbolic plane: x is scaled by a translation of s, and the three momenta are functions of it. */
static const char HYPERBOLIC[] = HEAD("s, x", "v, u") "    - s' = v\n    - x' = u*exp(s)\nlagrangian: (s'^2 + x'^2*exp(-2*s))/2\n";

static size_t left_by(const char *text, bool time)
{
    nh_system *s = system_of(text);
    nh_model *o = model_of(s);
    nh_jet_equations *x = nh_jet_equations_create(o, time, false);
    nh_ex out[32];
    cr_assert_null(x->obstacle, "%s", x->obstacle);
    size_t count = nh_turned_translations(x, out);
    for (size_t i = 0; i < count; i++) {
        const char *name = nh_name_of(o->dag, out[i]);
        cr_expect(!strcmp(name, "x") || !strcmp(name, "y"), "%s: %s", text, name);
    }
    nh_jet_equations_free(x);
    nh_model_free(o);
    nh_system_free(s);
    return count;
}

Test(turned_translations, are_found)
{
    static const char *const TEXT[] = {SLEIGH, SHEARED, TRAILER, COUNTER, WHEEL, PLAIN, LINKS, BESIDE};
    for (size_t i = 0; i < sizeof TEXT / sizeof *TEXT; i++)
        for (int time = 0; time < 2; time++) cr_expect_eq(left_by(TEXT[i], time), 2, "%s", TEXT[i]);
    cr_expect_eq(left_by(HYPERBOLIC, false), 1);
}

Test(turned_translations, need_a_symmetry_that_turns_them_on_the_leaf)
{
    static const char *const TEXT[] = {SPRING, COMPASS, SLOPE, HEAVY};
    for (size_t i = 0; i < sizeof TEXT / sizeof *TEXT; i++) cr_expect_eq(left_by(TEXT[i], false), 0, "%s", TEXT[i]);
}

/* A known function of x keeps every coordinate. */
static nh_count count_of(const nh_model *o, bool time, size_t degree, bool every)
{
    nh_ex x;
    cr_assert(nh_symbol_find(o->dag, "x", &x));
    nh_count_question q = {.time = time, .degree = degree, .work = 1e10, .known = every, .current = &x};
    return nh_count_integrals(o, &q);
}

static void same_number(const char *text, bool time, size_t degree)
{
    nh_system *s = system_of(text);
    nh_model *o = model_of(s);
    nh_count with = count_of(o, time, degree, false), every = count_of(o, time, degree, true);
    cr_assert_null(with.obstacle, "%s", with.obstacle);
    cr_expect_eq(with.rows, degree, "%s: %zu of %zu degrees", text, with.rows, degree);
    cr_expect_eq(every.rows, degree, "%s: %zu of %zu degrees", text, every.rows, degree);
    for (size_t d = 0; d < degree; d++)
        cr_expect_eq(with.row[d].bound, every.row[d].bound, "%s\ndegree %zu: %zu instead of %zu", text, d + 1, with.row[d].bound, every.row[d].bound);
    nh_model_free(o);
    nh_system_free(s);
}

Test(turned_translations, do_not_change_the_number, PLAIN_ONLY)
{
    static const char *const TEXT[] = {SLEIGH, SHEARED, TRAILER, COUNTER, WHEEL, HYPERBOLIC, PLAIN, BESIDE};
    for (size_t i = 0; i < sizeof TEXT / sizeof *TEXT; i++) same_number(TEXT[i], false, 3);
    same_number(LINKS, false, 2);
    same_number(SLEIGH, true, 2);
    same_number(PLAIN, true, 2);
    same_number(WHEEL, true, 2);
}

/* The momenta of the hyperbolic plane, whose squares' sum is the energy: all polynomials in three forms. */
Test(turned_translations, integrals_linear_in_what_was_left_out_are_counted)
{
    nh_system *s = system_of(HYPERBOLIC);
    nh_model *o = model_of(s);
    nh_count c = count_of(o, false, 3, false);
    cr_expect_eq(c.without, 0); /* all coordinates were taken in the end */
    static const size_t BOUND[] = {4, 10, 20};
    for (size_t d = 0; d < 3; d++) cr_expect_eq(c.row[d].bound, BOUND[d], "degree %zu: %zu", d + 1, c.row[d].bound);
    nh_model_free(o);
    nh_system_free(s);
}

/* Shorter series: what was left out is no variable of them. */
Test(turned_translations, make_the_series_shorter)
{
    nh_system *s = system_of(TRAILER);
    nh_model *o = model_of(s);
    nh_count_question q = {.work = 1e10};
    nh_counter c;
    nh_counter_open(&c, o, &q, true);
    cr_expect_eq(c.equations->left, 2);
    cr_expect_eq(c.equations->m, 2);
    nh_counter_close(&c);
    nh_count counted = count_of(o, false, 2, false);
    cr_expect_eq(counted.without, 2);
    cr_expect(!strcmp(counted.without_name[0], "x") && !strcmp(counted.without_name[1], "y"));
    nh_model_free(o);
    nh_system_free(s);
}

/* The limit for the size of the linear system for symmetries: 24 free particles would have 600 unknowns. */
Test(turned_translations, are_not_sought_where_the_system_is_too_large)
{
    char coordinates[256] = "x0", lagrangian[512] = "x0'^2/2", text[1024];
    for (int i = 1; i < 24; i++) {
        snprintf(coordinates + strlen(coordinates), sizeof coordinates - strlen(coordinates), ", x%d", i);
        snprintf(lagrangian + strlen(lagrangian), sizeof lagrangian - strlen(lagrangian), " + x%d'^2/2", i);
    }
    snprintf(text, sizeof text, "name: free\ncoordinates: [%s]\nlagrangian: %s\n", coordinates, lagrangian);
    cr_expect_eq(left_by(text, false), 0);
}

/* Shipped systems that leave coordinates out, counted with and without them. */
Test(turned_translations, sweep_the_numbers_of_shipped_systems_stay_the_same, WHOLE_ONLY)
{
    glob_t files;
    size_t compared = 0;
    cr_assert_eq(glob("systems/*.yaml", 0, NULL, &files), 0);
    for (size_t i = 0; i < files.gl_pathc; i++) {
        nh_error error = {0};
        nh_system *s = nh_system_read(files.gl_pathv[i], 0, NULL, &error);
        cr_assert_not_null(s, "%s", error.what);
        nh_model *o = model_of(s);
        for (int time = 0; time < 2; time++) {
            nh_count_question q = {.time = time, .degree = 2, .work = 3e8};
            nh_count with = nh_count_integrals(o, &q);
            nh_ex left;
            if (with.obstacle || !with.without) continue;
            cr_assert(nh_symbol_find(o->dag, with.without_name[0], &left));
            q.known = 1;
            q.current = &left;
            nh_count every = nh_count_integrals(o, &q);
            for (size_t d = 0; d < with.rows && d < every.rows; d++, compared++) /* more orders may only lower a number */
                cr_expect(with.row[d].bound == every.row[d].bound || !with.row[d].settled || !every.row[d].settled,
                          "%s, degree %zu: %zu and %zu", files.gl_pathv[i], d + 1, with.row[d].bound, every.row[d].bound);
        }
        nh_model_free(o);
        nh_system_free(s);
    }
    cr_expect_geq(compared, 20, "%zu", compared);
    globfree(&files);
}
