/* Integrals constructed from their power series: the terms, what is known already, and what has no closed form. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/diff.h"
#include "count/closed_words.h"
#include "count/construct.h"
#include "count/construct_rates.h"
#include "graph/dag.h"
#include "graph/print.h"
#include "names.h"
#include "search/naming.h"

#define PLANE "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - "

static nh_model *model_of(nh_system *s)
{
    nh_error error = {0};
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    cr_assert_not_null(o, "%s", error.what);
    return o;
}

static nh_construction *constructed(nh_model *o, size_t degree, double price, size_t known, const nh_ex *current)
{
    nh_construct_question q = {.degree = degree, .price = price, .most_words = 600, .work = 2e9, .known = known, .current = current};
    return nh_construct(o, &q);
}

static bool has_term(const nh_constructed *c, nh_ex e)
{
    for (size_t j = 0; j < c->terms; j++)
        if (c->term[j] == e) return true;
    return false;
}

/* Post and Winternitz: p1^2 p2 + 2/3 p2^3 + a (3 x^(1/3) p1 + 2 y x^(-2/3) p2); their integral of degree three has four terms, and they are these. */
Test(construct, terms_are_those_of_the_published_integral)
{
    static const char *const TERM[] = {"x'^2*y'", "y'^3", "x^(1/3)*x'", "y*x^(-2/3)*y'"};
    nh_system *s = system_of("name: pw\n" PLANE "7/10*y*x^(-2/3)\n");
    nh_model *o = model_of(s);
    nh_construction *c = constructed(o, 3, 2, 1, &o->E), *again = constructed(o, 3, 2, 1, &o->E);
    cr_assert_eq(c->count, 1);
    cr_assert_eq(c->item[0].terms, 4);
    for (size_t i = 0; i < 4; i++) cr_expect(has_term(&c->item[0], nh_model_compose(o, expression_of(s, TERM[i]))), "%s", TERM[i]);
    cr_assert_eq(again->count, 1);
    cr_expect_eq(memcmp(again->item[0].term, c->item[0].term, 4 * sizeof *c->item[0].term), 0, "the same answer twice");
    nh_construction_free(again);
    nh_construction_free(c);
    nh_model_free(o);
    nh_system_free(s);
}

/* Products and functions of known integrals are recognised, and are not new. */
Test(construct, what_is_known_is_not_new)
{
    nh_system *s = system_of("name: isotropic\n" PLANE "(x^2 + y^2)/2\n");
    nh_model *o = model_of(s);
    nh_ex known[3] = {o->E, nh_model_compose(o, expression_of(s, "x*y' - y*x'")), nh_model_compose(o, expression_of(s, "x'*y' + x*y"))};
    nh_construction *c = constructed(o, 2, 4, 1, known), *all = constructed(o, 2, 4, 3, known);
    cr_expect_eq(c->recognised, c->dimension);
    cr_expect_gt(c->count, 0);
    cr_expect_eq(all->recognised, all->dimension);
    cr_expect_eq(all->count, 0);
    nh_construction_free(all);
    nh_construction_free(c);
    nh_model_free(o);
    nh_system_free(s);
}

/* A rolling disk has two integrals linear in the velocities whose coefficients are Legendre functions of its inclination: they are counted, and however
 * many words there are they are not recognised. */
Test(construct, functions_without_closed_form_are_not_recognised)
{
    nh_error error = {0};
    nh_system *s = nh_system_read("systems/rolling_disk.yaml", 0, NULL, &error);
    cr_assert_not_null(s, "%s", error.what);
    nh_model *o = model_of(s);
    nh_construction *c = constructed(o, 1, 3, 1, &o->E);
    cr_expect_not(c->limited);
    cr_expect_eq(c->dimension, 3);
    cr_expect_eq(c->recognised, 1);
    cr_expect_eq(c->count, 0);
    nh_construction_free(c);
    nh_model_free(o);
    nh_system_free(s);
}

/* Beside a sphere no linear integral depends on the place along a line; in a plane the moment depends on both places. */
Test(construct, coordinates_of_no_integral_are_idle)
{
    static const struct {
        const char *text;
        size_t degree, idle;
    } ROW[] = {
        {"coordinates: [x, {name: h, type: angle}, {name: p, type: angle}]\nlagrangian: (x'^2 + h'^2 + sin(h)^2*p'^2)/2\n", 1, 1},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n", 1, 0},
        {"coordinates: [{name: r, type: length}, {name: f, type: angle}]\nlagrangian: (r'^2 + r^2*f'^2)/2 - r^3\n", 2, 1},
    };
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        char text[300];
        snprintf(text, sizeof text, "name: row\n%s", ROW[i].text);
        nh_system *s = system_of(text);
        nh_model *o = model_of(s);
        nh_construct_rates r = nh_construct_rates_of(o, ROW[i].degree, false, 0, NULL, 2e9);
        cr_expect_eq(r.idle, ROW[i].idle, "%s: %zu", ROW[i].text, r.idle);
        nh_model_free(o);
        nh_system_free(s);
    }
}

/* Of r^2, r r' and r'^2 in a potential k r^2/2 + a/r^2; the same where it repels; and of a rate without parameters. */
Test(construct, rates_are_written_by_parameters)
{
    static const struct {
        const char *text, *argument;
        bool wave;
        size_t rates;
    } ROW[] = {
        {"parameters: {m: 1.3, k: 2.1, a: 0.4}\ncoordinates: [{name: r, type: length}]\nlagrangian: m*r'^2/2 - k*r^2/2 - a/r^2\n", "2*t*sqrt(k/m)", true, 1},
        {"parameters: {m: 1.3, k: 2.1, a: 0.4}\ncoordinates: [{name: r, type: length}]\nlagrangian: m*r'^2/2 + k*r^2/2 - a/r^2\n", "2*t*sqrt(k/m)", false, 2},
        {"parameters: {w: 1.37, a: 0.4}\ncoordinates: [{name: r, type: length}]\nlagrangian: r'^2/2 - w^2*r^2 - a/r^2\n", "2*sqrt(2)*t*w", true, 1},
        {"parameters: {a: 0.4}\ncoordinates: [{name: r, type: length}]\nlagrangian: r'^2/2 - 3*r^2/8 - a/r^2\n", "sqrt(3)*t", true, 1},
    };
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        char text[300];
        snprintf(text, sizeof text, "name: row\n%s", ROW[i].text);
        nh_system *s = system_of(text);
        nh_model *o = model_of(s);
        nh_ex atom[NH_NAMING_ATOMS];
        nh_construct_rates r = nh_construct_rates_of(o, 2, true, nh_naming_atoms(o, atom), atom, 2e9);
        cr_assert_eq(r.count, ROW[i].rates, "%s: %zu", ROW[i].text, r.count);
        char *argument = nh_print_string(o->dag, nh_construct_rate_argument(o->dag, &r.item[0]));
        const char *sign = argument[0] == '-' ? argument + 1 : argument;
        cr_expect_str_eq(sign, ROW[i].argument, "%s", ROW[i].text);
        for (size_t k = 0; k < r.count; k++) cr_expect_eq(r.item[k].wave, ROW[i].wave, "%s", ROW[i].text);
        nh_free(argument);
        nh_model_free(o);
        nh_system_free(s);
    }
}

/* ---- antiderivatives of roots ---- */

/* Does one of the functions have this derivative by q, up to a constant factor, at all points of a grid? */
static bool one_derives(nh_system *s, nh_model *o, size_t count, const nh_ex *e, const char *q, const char *derivative)
{
    bool found = false;
    for (size_t k = 0; k < count && !found; k++) {
        nh_ex ratio = nh_div(o->dag, nh_diff(o->dag, e[k], expression_of(s, q)), nh_model_compose(o, expression_of(s, derivative)));
        nh_tape *tape = nh_model_tape(o, 1, &ratio);
        nh_tape_work *work = nh_tape_work_create(tape);
        double first = 0, value;
        found = true;
        for (size_t p = 0; p < 20 && found; p++) {
            nh_tape_eval(tape, work, o->chart->probe + p * o->chart->width, &value);
            if (p == 0) first = value;
            found = value != 0 && fabs(value / first - 1) < 1e-9;
        }
        nh_tape_work_free(work);
        nh_tape_free(tape);
    }
    return found;
}

Test(construct, roots_have_their_antiderivatives)
{
    static const struct {
        const char *text, *q, *derivative;
        bool time;
    } ROW[] = {
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = y*x'\"]\n", "y", "1/sqrt(1 + y^2)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = cos(y)*x'\"]\n", "y", "sin(y)/sqrt(1 + cos(y)^2)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = cos(y)*x'\"]\n", "y", "cos(y)/sqrt(1 + cos(y)^2)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = 3*sin(2*y)*x'\"]\n", "y", "cos(2*y)/sqrt(1 + 9*sin(2*y)^2)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = y^2*x'\"]\n", "y", "1/sqrt(1 + y^4)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = y^2*x'\"]\n", "y", "y^2/sqrt(1 + y^4)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = 3*y^3*x'\"]\n", "y", "y^3/sqrt(1 + 9*y^6)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = x'/y^2\"]\n", "y", "1/sqrt(1 + y^-4)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = x'/y^2\"]\n", "y", "y^-2/sqrt(1 + y^-4)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = 3*sin(2*y)*x'\"]\n", "y", "1/sqrt(1 + 9*sin(2*y)^2)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = 3*sin(2*y)*x'\"]\n", "y", "sqrt(1 + 9*sin(2*y)^2)", false},
        {"coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + (3 - sin(y)^2 + cos(y))*z'^2)/2\nconstraints: [\"x' = sin(y)*z'\"]\n", "y", "1/sqrt(3 + cos(y))", false},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [\"(x - t)*y' = y*x'\"]\n", "x", "1/sqrt((x - t)^2 + y^2)", true},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [\"(x - t)*y' = y*x'\"]\n", "x", "1/(x - t)", true},
    };
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        enum { most = 12 };
        char text[400];
        nh_ex e[most];
        snprintf(text, sizeof text, "name: s\ndomain: {y: [0.5, 1.2], x: [2, 3]}\n%s", ROW[i].text);
        nh_system *s = system_of(text);
        nh_model *o = model_of(s);
        size_t count = nh_closed_primitives(o, ROW[i].time, most, e);
        cr_expect(one_derives(s, o, count, e, ROW[i].q, ROW[i].derivative), "%s: %s of %zu", ROW[i].text, ROW[i].derivative, count);
        cr_expect(nh_closed_primitives(o, ROW[i].time, 1, e) == (count ? 1 : 0));
        nh_model_free(o);
        nh_system_free(s);
    }
}
