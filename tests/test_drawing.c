/* What is drawn of a system: something for every one that is shipped, at the right places. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "catalogue.h"
#include "evaluate/tape.h"
#include "document/perspective.h"
#include "commands/simulate.h"
#include "problem/drawing.h"
#include "sweep.h"
#include "thumbnail.h"

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

/* The axes of a body in space, from those that are given: k = 0, 1; the third is their product. */
static void axes_of(const nh_system *s, const nh_shape *shape, const double *q, double axis[3][3])
{
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < 3; i++) axis[k][i] = at(s, shape, nh_shape_numbers(shape->kind) - 6 + 3 * k + i, q);
    for (size_t i = 0; i < 3; i++) {
        size_t j = (i + 1) % 3, k = (i + 2) % 3;
        axis[2][i] = axis[0][j] * axis[1][k] - axis[0][k] * axis[1][j];
    }
}

static void expect_vector(const double *got, double x, double y, double z, const char *what)
{
    const double want[] = {x, y, z};
    for (size_t i = 0; i < 3; i++) cr_expect_float_eq(got[i], want[i], 1e-12, "%s: component %zu is %g, not %g", what, i, got[i], want[i]);
}

/* A block of even density is drawn with its edges, a flat plate flat, a wheel about its axle, whatever that is; a point as a ball without size. */
Test(drawing, bodies_in_space)
{
    const double a = 2, b = 3, c = 0.5, m = 1.7, h = 0.5, p = 0.7;
    char text[1200];
    snprintf(text, sizeof text,
             "bodies:\n  - {name: block, mass: %.17g, inertia: [%.17g, %.17g, %.17g], center: [0.1, 0, 0]}\n  - {name: wheel, mass: 1, inertia: [1, 1, 1]}\n"
             "  - {name: plate, mass: 2, inertia: [0, 0, 3]}\n  - {name: stone, mass: 1}\n"
             "joints:\n  - {type: planar, child: block, coordinates: [x, y, h]}\n  - {type: revolute, parent: block, child: wheel, at: [0, 0.5, 0.25], axis: [0, 0.6, 0.8], coordinates: [p]}\n"
             "  - {type: revolute, parent: block, child: plate, at: [-1, 0, 0], axis: z, coordinates: [s]}\n  - {type: revolute, parent: plate, child: stone, at: [-1, 0, 0], axis: x, coordinates: [u]}\n"
             "wheels:\n  - {type: rolling, body: wheel, axle: [0, 0.6, 0.8], radius: 0.25}\n",
             m, m * (b * b + c * c) / 12, m * (a * a + c * c) / 12, m * (a * a + b * b) / 12);
    nh_system *s = parse(text);
    nh_arena *arena = nh_arena_create();
    const double q[] = {2, 3, h, p, 1.1, 0.3}, edge[] = {a, b, c}, flat[] = {3, 3, 0};
    const nh_shape *shape, *solid[4];
    size_t count, solids = 0;
    double axis[3][3], place[3];
    cr_assert_not_null(nh_drawing_choose(arena, s, &count, &shape));
    for (size_t i = 0; i < count; i++)
        if (nh_shape_in_space(shape[i].kind) && shape[i].kind != NH_SHAPE_ROD && solids < 4) solid[solids++] = &shape[i];
    cr_assert_eq(solids, 4u);
    cr_expect(solid[0]->kind == NH_SHAPE_BOX && solid[1]->kind == NH_SHAPE_CYLINDER && solid[2]->kind == NH_SHAPE_BOX && solid[3]->kind == NH_SHAPE_BALL);
    for (size_t i = 0; i < 3; i++) cr_expect_float_eq(at(s, solid[0], 3 + i, q), edge[i], 1e-12);
    for (size_t i = 0; i < 3; i++) cr_expect_float_eq(at(s, solid[2], 3 + i, q), flat[i], 1e-12);
    for (size_t i = 0; i < 3; i++) place[i] = at(s, solid[0], i, q);
    expect_vector(place, 2 + 0.1 * cos(h), 3 + 0.1 * sin(h), 0, "the block's centre");
    axes_of(s, solid[0], q, axis);
    expect_vector(axis[0], cos(h), sin(h), 0, "its first axis");
    expect_vector(axis[2], 0, 0, 1, "its third axis");
    axes_of(s, solid[1], q, axis);
    expect_vector(axis[2], -0.6 * sin(h), 0.6 * cos(h), 0.8, "the axle");
    /* It turns about the axle by p: the first axis lies across, at the angle p from where it is for p = 0. */
    const double rest[] = {2, 3, h, 0, 1.1, 0.3};
    double before[3][3];
    axes_of(s, solid[1], rest, before);
    for (size_t i = 0; i < 3; i++) cr_expect_float_eq(axis[0][i], cos(p) * before[0][i] + sin(p) * before[1][i], 1e-12);
    cr_expect_float_eq(at(s, solid[1], 3, q), 0.25, 1e-12);
    cr_expect_float_eq(at(s, solid[3], 3, q), 0, 1e-12);
    nh_arena_free(arena);
    nh_system_free(s);
}

/* A legend tells wheels apart that the file does not name. */
Test(drawing, wheels_without_names)
{
    nh_system *s = parse("parameters: [{name: r, value: 0.3}]\nbodies: [{name: cart, mass: 1, inertia: 0.1}, {name: w, mass: 1, inertia: [0.1, 0.2, 0.1]}]\n"
                         "joints: [{type: planar, child: cart, coordinates: [x, y, h]}, {type: revolute, parent: cart, child: w, axis: y, coordinates: [p]}]\n"
                         "wheels: [{type: knife-edge, body: cart, axis: y}, {type: rolling, body: w, axle: y, radius: r}, {type: knife-edge, body: cart, axis: y, name: keel}, {type: knife-edge, body: cart, axis: y}]\n");
    static const char *const names[] = {"blade 1 of cart", "wheel of w", "keel", "blade 2 of cart"};
    cr_assert_eq(s->chain->wheels, 4u);
    for (size_t i = 0; i < 4; i++) cr_expect_str_eq(s->chain->wheel[i].name, names[i]);
    nh_system_free(s);
}

/* Turns about a body's own axes one after another: Euler's angles z, x, z. */
Test(drawing, turns_of_a_file)
{
    nh_system *s = parse("coordinates: [{name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\nlagrangian: p'^2 + h'^2 + s'^2\n"
                         "draw:\n  - {box: [1, p, 3, 0.1, 0.2, h], turn: [z: p, x: h, z: s], name: brick}\n  - rod: [0, 0, 0, 1, p, 3]\n");
    const double p = 0.4, h = 1.1, t = -0.7, q[] = {p, h, t};
    double axis[3][3];
    cr_assert_eq(s->shapes, 2u);
    axes_of(s, &s->shape[0], q, axis);
    expect_vector(axis[0], cos(p) * cos(t) - sin(p) * cos(h) * sin(t), sin(p) * cos(t) + cos(p) * cos(h) * sin(t), sin(h) * sin(t), "first axis");
    expect_vector(axis[1], -cos(p) * sin(t) - sin(p) * cos(h) * cos(t), -sin(p) * sin(t) + cos(p) * cos(h) * cos(t), sin(h) * cos(t), "second axis");
    expect_vector(axis[2], sin(p) * sin(h), -cos(p) * sin(h), cos(h), "third axis");
    cr_expect_float_eq(at(s, &s->shape[0], 5, q), h, 1e-15);
    cr_expect_str_eq(s->shape[0].name, "brick");
    cr_expect_float_eq(at(s, &s->shape[1], 4, q), p, 1e-15);
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

/* What the kinetic energy says of coordinates whose file says nothing: the last point or ball that is drawn, at q = (0.5, 2, 3, ..). */
Test(drawing, coordinates_without_types)
{
    static const struct {
        const char *text, *words;
        double x, y, z;
    } cases[] = {
#define SPRING "coordinates: r, a\nlagrangian: r'^2/2 + r^2*a'^2/2 "
        {SPRING "+ 1/r\n", "(r, a) in polar coordinates", -0.208073418, 0.454648713, 0},
        {SPRING "+ 9*r*cos(a)\n", "(r, a) in polar coordinates", 0.454648713, 0.208073418, 0},
        {SPRING "- 9*r*cos(a)\n", "(r, a) in polar coordinates", 0.454648713, -0.208073418, 0},
        {SPRING "- 9*r*sin(a)\n", "(r, a) in polar coordinates", -0.208073418, 0.454648713, 0},
        {"coordinates: r, a, z\nlagrangian: r'^2/2 + r^2*a'^2/2 + z'^2\n", "(r, a) in polar coordinates", -0.208073418, 0.454648713, 0},
        {"coordinates: r, a, b\nlagrangian: r'^2/2 + r^2*(a'^2 + sin(a)^2*b'^2)/2 + 1/r\n", "(r, a, b) in polar coordinates", -0.450098815, 0.064160030, -0.208073418},
        {"coordinates: R, r, a, b\nlagrangian: R'^2 + R^2*b'^2 + 3*r'^2 + 3*r^2*a'^2 + cos(a-b)\n", "(R, b), (r, a) in polar coordinates", -1.979984993, 0.282240016, 0},
        {"coordinates: u, v\nlagrangian: (u^2 + v^2)*(u'^2 + v'^2)\n", "u to the right and v up", 0.5, 2, 0},
        {"coordinates: a\nlagrangian: a'^2 + cos(a)\n", "the angle as a hand", 0, 0, 0},
        {"coordinates: a, b\nparameters: m=2, l=3\nlagrangian: m*l^2*a'^2 + 8*b'^2 + m*l*4*a'*b'*cos(a-b) + cos(a) + cos(b)\n", "pendulums one at the end of the other; the last has length 1", 0.75 * sin(.5) * 2 + sin(2), -0.75 * cos(.5) * 2 - cos(2), 0},
        {"coordinates: x, a\nparameters: m=2, l=3\nlagrangian: x'^2 + m*l^2*a'^2/2 - m*l*x'*a'*cos(a) + 9*m*l*cos(a)\n", "x along a line, with pendulums", 0.5 - 3 * sin(2), 3 * cos(2), 0},
        {"coordinates: x, a\nlagrangian: x'^2 + a'^2 + x*a'\n", "x to the right and a up", 0.5, 2, 0},
        {"coordinates: {x: number, a: angle}\nlagrangian: x'^2 + a'^2 + x*a'\n", "x along a line, each angle as a hand there", 0.5, 0, 0},
    };
    const double q[] = {0.5, 2, 3, 4};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        nh_system *s = parse(cases[i].text);
        nh_arena *arena = nh_arena_create();
        const nh_shape *shape, *last = NULL;
        size_t count;
        const char *words = nh_drawing_choose(arena, s, &count, &shape);
        cr_expect_str_eq(words, cases[i].words, "case %zu: %s", i, words);
        for (size_t k = 0; k < count; k++)
            if (shape[k].kind == NH_SHAPE_POINT || shape[k].kind == NH_SHAPE_BALL || (shape[k].kind == NH_SHAPE_SEGMENT && count == 1)) last = &shape[k];
        cr_assert_not_null(last, "case %zu", i);
        cr_expect_float_eq(at(s, last, 0, q), cases[i].x, 1e-8, "case %zu: x = %.9g", i, at(s, last, 0, q));
        cr_expect_float_eq(at(s, last, 1, q), cases[i].y, 1e-8, "case %zu: y = %.9g", i, at(s, last, 1, q));
        if (last->kind == NH_SHAPE_BALL) cr_expect_float_eq(at(s, last, 2, q), cases[i].z, 1e-8, "case %zu: z = %.9g", i, at(s, last, 2, q));
        nh_arena_free(arena);
        nh_system_free(s);
    }
}

static nh_simulation *moving(const char *path, const char *initial, double step, nh_time_series **out)
{
    nh_error error;
    nh_error_clear(&error);
    nh_request q = {.system_path = path, .initial = initial, .draw = true, .step = step};
    nh_options_default(&q.options);
    nh_simulation *s = nh_simulation_create(&q, &error);
    cr_assert_not_null(s, "%s", error.what);
    *out = nh_time_series_of_simulation(s);
    cr_assert_not_null(*out);
    return s;
}

static size_t times_in(const char *text, const char *word)
{
    size_t n = 0;
    for (; (text = strstr(text, word)); text++) n++;
    return n;
}

/* The picture of the catalogue: finite, small, with its title escaped. */
Test(drawing, a_portrait, PLAIN_ONLY)
{
    nh_time_series *c;
    nh_simulation *s = moving("systems/snakeboard.yaml", NULL, 0, &c);
    nh_text text;
    nh_text_init(&text);
    cr_expect(thumbnail(c, "a < b", &text));
    const char *svg = nh_text_string(&text);
    cr_expect_not_null(strstr(svg, "<title>a &lt; b</title>"));
    cr_expect_null(strstr(svg, "nan"));
    cr_expect_null(strstr(svg, "inf"));
    cr_expect_lt(text.length, 12000u);
    cr_expect_eq(times_in(svg, "<line "), 4u, "two rods and two wheels, not %zu", times_in(svg, "<line "));
    nh_text_clear(&text);
    nh_time_series_free(c);
    nh_simulation_free(s);
}

/* Where nothing but segments is drawn, they leave paths: those of their middles. */
Test(drawing, a_portrait_of_segments)
{
    nh_time_series *c;
    nh_simulation *s = moving("systems/skate_on_belt.yaml", "th'=1, x'=2, y'=0", 0, &c);
    nh_text text;
    nh_text_init(&text);
    cr_expect(thumbnail(c, "skate", &text));
    const char *path = strstr(nh_text_string(&text), " d=\"M");
    cr_assert_not_null(path);
    cr_expect_gt(strcspn(path + 5, "\""), 60u, "no path: %.80s", path);
    nh_text_clear(&text);
    nh_time_series_free(c);
    nh_simulation_free(s);
}

/* Three faces of a box at most are seen, the others are outlines; all of it stays in the picture, and the far pieces come first. */
static void expect_box(const nh_view *v, size_t i)
{
    nh_picture p = {0};
    size_t front = 0, behind = 0;
    nh_view_draw(v, i, &p);
    for (size_t k = 0; k < p.count; k++) {
        const nh_piece *e = &p.piece[k];
        if (k) cr_expect(e[-1].depth <= e->depth);
        if (!e->closed) continue;
        cr_expect_eq(e->points, 4u);
        front += e->fill >= 0;
        behind += e->fill < 0 && e->stroke_opacity < 0.5;
        for (size_t n = e->first; n < e->first + e->points; n++)
            cr_expect(p.point[2 * n] >= 0 && p.point[2 * n] <= v->wide && p.point[2 * n + 1] >= 0 && p.point[2 * n + 1] <= v->high, "(%g, %g) is outside", p.point[2 * n], p.point[2 * n + 1]);
    }
    cr_expect(front >= 1 && front <= 3 && front + behind == 6, "%zu faces are seen, %zu are hidden", front, behind);
    nh_picture_clear(&p);
}

/* What is nearer is larger; up is up; the target is where the view says. */
static void expect_eye(const nh_view *v)
{
    double near[3], high[3], at[4], other[4];
    nh_view_see(v, 0, v->middle, at);
    cr_expect(fabs(at[0] - v->x) < 1e-9 && fabs(at[1] - v->y) < 1e-9 && fabs(at[3] - v->scale) < 1e-9);
    for (size_t j = 0; j < 3; j++) near[j] = v->middle[j] + v->towards[j], high[j] = v->middle[j] + (j == (size_t)v->up);
    nh_view_see(v, 0, near, other);
    cr_expect(other[3] > at[3] && fabs(other[2] - 1) < 1e-12 && fabs(other[0] - at[0]) < 1e-9 && fabs(other[1] - at[1]) < 1e-9);
    nh_view_see(v, 0, high, other);
    cr_expect(other[1] < at[1] && fabs(other[0] - at[0]) < 1e-9);
}

Test(drawing, a_box_in_perspective)
{
    char folder[] = "/tmp/nhsym-drawing-XXXXXX", path[80];
    cr_assert_not_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/box.yaml", folder);
    FILE *file = fopen(path, "w");
    fputs("name: box\nbodies: [{name: box, mass: 2, inertia: [0.3, 0.5, 0.7]}]\njoints: [{type: free, child: box, coordinates: [x, y, z, a, b, c]}]\ngravity: [0, 0, -1]\n", file);
    fclose(file);
    nh_time_series *c;
    nh_simulation *s = moving(path, "a=0.3, b=1, a'=1, b'=0.4, c'=2, x'=1", 0, &c);
    nh_view *v = nh_view_create(c, c->count, 640, 420);
    cr_assert_not_null(v);
    expect_eye(v);
    for (size_t i = 0; i < c->count; i += 9) expect_box(v, i);
    nh_view_free(v);
    nh_time_series_free(c);
    nh_simulation_free(s);
    unlink(path);
    rmdir(folder);
}

/* A thumbnail has the ball, its great circles before and behind, the squares of the ground and the path. */
Test(drawing, a_portrait_in_space)
{
    nh_time_series *c;
    nh_simulation *s = moving("systems/rolling_ball.yaml", NULL, 0, &c);
    nh_text text;
    nh_text_init(&text);
    cr_expect(thumbnail(c, "ball", &text));
    const char *svg = nh_text_string(&text);
    cr_expect_null(strstr(svg, "nan"));
    cr_expect_null(strstr(svg, "inf"));
    cr_expect_lt(text.length, 12000u);
    cr_expect_eq(times_in(svg, "fill-opacity"), 1u, "one body, not %zu", times_in(svg, "fill-opacity"));
    cr_expect_geq(times_in(svg, "stroke-opacity=\"0.22\""), 1u, "no hidden great circles");
    cr_expect_geq(times_in(svg, "stroke-opacity=\"0.25\""), 1u, "no ground");
    nh_text_clear(&text);
    nh_time_series_free(c);
    nh_simulation_free(s);
}
