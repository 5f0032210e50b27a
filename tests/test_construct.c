/* Integrals constructed from their power series: the terms, what is known already, and what has no closed form. */
#include <criterion/criterion.h>
#include <string.h>

#include "integrals/construct.h"
#include "names.h"

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
