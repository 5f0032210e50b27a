/* absence_cases: systems as text, their closed shapes, planes and normal equations, for the tests of src/absence. */
#ifndef NH_TESTS_ABSENCE_CASES_H
#define NH_TESTS_ABSENCE_CASES_H

#include "mechanics.h"

#include "absence/curve_value.h"
#include "absence/normal_equation.h"
#include "graph/dag.h"
#include "graph/node.h"

typedef struct {
    mechanics of;
    nh_arena *arena;
    nh_closed_shape *shape;
    nh_plane *plane;
    size_t planes;
} absence_case;

static inline absence_case absence_case_of(mechanics of)
{
    absence_case c = {.of = of, .arena = nh_arena_create()};
    c.shape = nh_closed_shape_of(c.arena, of.model);
    c.planes = nh_planes_find(c.arena, c.shape, &c.plane);
    return c;
}

static inline absence_case absence_case_text(const char *text)
{
    return absence_case_of(mechanics_of_text(text, NH_CHART_AUTO));
}

static inline void absence_case_clear(absence_case *c)
{
    nh_arena_free(c->arena);
    mechanics_clear(&c->of);
}

static inline const nh_plane *plane_named(const absence_case *c, const char *words)
{
    for (size_t i = 0; i < c->planes; i++)
        if (!strcmp(c->plane[i].words, words)) return &c->plane[i];
    for (size_t i = 0; i < c->planes; i++) cr_log_error("there is: %s", c->plane[i].words);
    cr_assert(false, "no plane %s", words);
    return NULL;
}

/* The equation with the energy and further integrals, which are given as texts. */
static inline nh_normal_equation *equation_with(const absence_case *c, const char *plane, size_t n, const char *const *further)
{
    enum { most = 8 };
    nh_ex integral[most] = {c->of.model->E};
    bool generic[most] = {true, true, true, true, true, true, true, true};
    cr_assert_lt(n, (size_t)most);
    for (size_t i = 0; i < n; i++) integral[1 + i] = formula(c->of.model, further[i]);
    nh_known_integrals known = {1 + n, integral, generic, 0};
    return nh_normal_equation_of(c->arena, c->shape, plane_named(c, plane), &known, 0);
}

static inline nh_normal_equation *equation_of(const absence_case *c, const char *plane)
{
    nh_normal_equation *e = equation_with(c, plane, 0, NULL);
    cr_assert_null(e->obstacle, "%s", e->obstacle);
    return e;
}

/* A rational function of x, written as in a system file. */
static inline void rational_of_text(const char *text, fmpq_poly_t num, fmpq_poly_t den)
{
    mechanics m = mechanics_of_text("name: x\ncoordinates: [x]\nlagrangian: x'^2/2\n", NH_CHART_AUTO);
    nh_ex e = formula(m.model, text);
    nh_curve_field field;
    nh_curve_element value;
    nh_curve_state state;
    nh_curve_field_init(&field);
    nh_curve_field_element_init(&value);
    nh_curve_place place = {.dag = m.model->dag, .field = &field, .coordinate = m.system->coordinate[0].q};
    nh_curve_value(&place, 1, &e, &value, &state, NULL);
    cr_assert_eq(state, NH_CURVE_FINE, "%s", text);
    fmpq_poly_set_fmpz_poly(num, value.even);
    fmpq_poly_set_fmpz_poly(den, value.den);
    nh_curve_field_element_clear(&value);
    nh_curve_field_clear(&field);
    mechanics_clear(&m);
}

#endif
