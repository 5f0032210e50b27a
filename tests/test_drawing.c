/* What is drawn of a system: something for every one that is shipped, at the right places. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>

#include "catalogue.h"
#include "evaluate/tape.h"
#include "document/thumbnail.h"
#include "commands/analyze.h"
#include "problem/drawing.h"

static nh_system *parse(const char *text)
{
    nh_error error;
    nh_error_clear(&error);
    nh_system *s = nh_system_parse("test", text, 0, NULL, &error);
    cr_assert_not_null(s, "%s: %s", error.where, error.what);
    return s;
}

/* Number j of a shape at coordinates q. */
static double at(const nh_system *s, const nh_shape *shape, size_t j, const double *q)
{
    const nh_ex *symbols;
    const double *values;
    nh_ex in[20];
    double out;
    for (size_t i = 0; i < s->coordinates; i++) in[i] = s->coordinate[i].q;
    nh_system_bindings(s, &symbols, &values);
    nh_tape *tape = nh_tape_create(s->dag, s->coordinates, in, 1, &shape->value[j], s->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, q, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

static const nh_shape *first(const nh_shape *shape, size_t count, nh_shape_kind kind)
{
    for (size_t i = 0; i < count; i++)
        if (shape[i].kind == kind) return &shape[i];
    cr_assert_fail("there is no %s", nh_shape_name(kind));
    return NULL;
}

Test(drawing, every_shipped_system_has_one)
{
    char *name[most_files];
    size_t n = list("systems", name);
    cr_assert_gt(n, 60u);
    for (size_t i = 0; i < n; i++) {
        char path[500];
        nh_error error;
        nh_error_clear(&error);
        snprintf(path, sizeof path, "systems/%.200s.yaml", name[i]);
        nh_system *s = nh_system_read(path, 0, NULL, &error);
        cr_assert_not_null(s, "%s", error.what);
        nh_arena *arena = nh_arena_create();
        size_t count = s->shapes;
        const nh_shape *shape = s->shape;
        const char *words = s->shapes ? "its own" : nh_drawing_choose(arena, s, &count, &shape);
        cr_expect(words && count > 0, "%s: nothing is drawn", name[i]);
        nh_arena_free(arena);
        nh_system_free(s);
        free(name[i]);
    }
}

/* A cart at (2, 3) that heads to 0.5: its wheel stands beside it and heads where it does; the rod behind it ends at its mass. */
Test(drawing, bodies_stand_where_they_are)
{
    nh_system *s = parse("bodies:\n  - {name: cart, mass: 1, inertia: [0, 0, 1]}\n  - {name: wheel, mass: 1, inertia: [1, 1, 1]}\n  - {name: rod, mass: 1, center: [2, 0, 0], inertia: [0, 0, 1]}\n"
                         "joints:\n  - {type: planar, child: cart, coordinates: [x, y, h]}\n  - {type: revolute, parent: cart, child: wheel, at: [0, 0.5, 0], axis: y, coordinates: [p]}\n"
                         "  - {type: revolute, parent: cart, child: rod, at: [-1, 0, 0], axis: z, coordinates: [s]}\n"
                         "wheels:\n  - {type: rolling, body: wheel, axle: y, radius: 0.25}\n");
    nh_arena *arena = nh_arena_create();
    const double q[] = {2, 3, 0.5, 0.7, 1.1}, c = cos(0.5), z = sin(0.5);
    const nh_shape *shape;
    size_t count;
    const char *words = nh_drawing_choose(arena, s, &count, &shape);
    cr_assert_not_null(words);
    cr_expect(!strncmp(words, "view along z", 12), "%s", words);
    const nh_shape *base = first(shape, count, NH_SHAPE_ARROW), *wheel = first(shape, count, NH_SHAPE_WHEEL), *end = first(shape, count, NH_SHAPE_POINT);
    cr_expect_float_eq(at(s, base, 0, q), 2, 1e-12);
    cr_expect_float_eq(at(s, base, 2, q), 0.5, 1e-12);
    cr_expect_float_eq(at(s, wheel, 0, q), 2 - 0.5 * z, 1e-12);
    cr_expect_float_eq(at(s, wheel, 1, q), 3 + 0.5 * c, 1e-12);
    cr_expect_float_eq(at(s, wheel, 2, q), 0.5, 1e-12);
    cr_expect_float_eq(at(s, wheel, 3, q), 0.25, 1e-12);
    cr_expect_float_eq(at(s, end, 0, q), 2 - c + 2 * cos(1.6), 1e-12);
    cr_expect_float_eq(at(s, end, 1, q), 3 - z + 2 * sin(1.6), 1e-12);
    nh_arena_free(arena);
    nh_system_free(s);
}

Test(drawing, coordinates_without_bodies)
{
    static const struct {
        const char *text;
        size_t count;
        nh_shape_kind kind;
        double x, y; /* of the first shape of that kind at q = (0.5, 2, 3, 4, 5, 6) */
    } cases[] = {
        {"coordinates: [{name: r, type: length}]\nlagrangian: r'^2\n", 1, NH_SHAPE_POINT, 0.5, 0},
        {"coordinates: [{name: f, type: angle}, {name: r, type: length}]\nlagrangian: r'^2 + r^2*f'^2\n", 2, NH_SHAPE_POINT, 1.7551651237807455, 0.958851077208406},
        {"coordinates: [{name: f, type: angle}, {name: x, type: length}, {name: y, type: length}]\nlagrangian: x'^2 + y'^2 + f'^2\n", 1, NH_SHAPE_ARROW, 2, 3},
        {"coordinates: [{name: x1, type: length}, {name: y1, type: length}, {name: x2, type: length}, {name: y2, type: length}]\nlagrangian: x1'^2 + x2'^2 + y1'^2 + y2'^2\n", 2, NH_SHAPE_POINT, 0.5, 2},
        {"coordinates: [{name: a, type: angle}, {name: b, type: angle}]\nlagrangian: a'^2 + b'^2\n", 2, NH_SHAPE_SEGMENT, 0, 0},
    };
    const double q[] = {0.5, 2, 3, 4, 5, 6};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_system *s = parse(cases[i].text);
        nh_arena *arena = nh_arena_create();
        const nh_shape *shape;
        size_t count;
        cr_expect_not_null(nh_drawing_choose(arena, s, &count, &shape));
        cr_expect_eq(count, cases[i].count, "case %zu: %zu shapes", i, count);
        const nh_shape *one = first(shape, count, cases[i].kind);
        cr_expect_float_eq(at(s, one, 0, q), cases[i].x, 1e-12, "case %zu", i);
        cr_expect_float_eq(at(s, one, 1, q), cases[i].y, 1e-12, "case %zu", i);
        nh_arena_free(arena);
        nh_system_free(s);
    }
}

/* The picture of the catalogue: finite, small, with its title escaped. */
Test(drawing, a_portrait)
{
    nh_error error;
    nh_error_clear(&error);
    nh_analyze_request q = {.system_path = "systems/snakeboard.yaml"};
    nh_options_default(&q.options);
    q.options.max_seconds = 0.05;
    nh_analysis *r = nh_analysis_create(&q, &error);
    cr_assert_not_null(r, "%s", error.what);
    nh_time_series *c = nh_time_series_of_analysis(r);
    cr_assert_not_null(c);
    nh_text text;
    nh_text_init(&text);
    cr_expect(nh_thumbnail(c, "a < b", &text));
    const char *svg = nh_text_string(&text);
    cr_expect_not_null(strstr(svg, "<title>a &lt; b</title>"));
    cr_expect_null(strstr(svg, "nan"));
    cr_expect_null(strstr(svg, "inf"));
    cr_expect_lt(text.length, 12000u);
    size_t lines = 0;
    for (const char *l = svg; (l = strstr(l, "<line ")); l++) lines++;
    cr_expect_eq(lines, 4u, "two rods and two wheels, not %zu", lines);
    nh_text_clear(&text);
    nh_time_series_free(c);
    nh_analysis_free(r);
}
