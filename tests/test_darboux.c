/* darboux: the table of allowed eigenvalues against its formulas; homogeneous potentials with known answers, of which the integrable ones must
 * stay open. */
#include <criterion/criterion.h>

#include <string.h>

#include "absence/darboux.h"
#include "mechanics.h"

/* ---- the table ---- */

static const struct {
    long k, a, a_den, b, b_den, m, n;
} rows[] = {
    {3, -1, 24, 1, 6, 1, 3},    {3, -1, 24, 3, 32, 1, 4},   {3, -1, 24, 3, 50, 1, 5},   {3, -1, 24, 3, 50, 2, 5},
    {-3, 25, 24, -1, 6, 1, 3},  {-3, 25, 24, -3, 32, 1, 4}, {-3, 25, 24, -3, 50, 1, 5}, {-3, 25, 24, -3, 50, 2, 5},
    {4, -1, 8, 2, 9, 1, 3},     {-4, 9, 8, -2, 9, 1, 3},    {5, -9, 40, 5, 18, 1, 3},   {5, -9, 40, 1, 10, 2, 5},
    {-5, 49, 40, -5, 18, 1, 3}, {-5, 49, 40, -1, 10, 2, 5},
};
enum { all_rows = sizeof rows / sizeof *rows, most_j = 30, most_values = 61 * 16 };

/* All allowed values with |j| <= 30. */
static size_t table_of(long k, fmpq *out)
{
    size_t n = 0;
    for (long j = -most_j; j <= most_j; j++) {
        fmpq_init(out + n);
        fmpq_set_si(out + n++, 2 * j + k * j * (j - 1), 2);
        fmpq_init(out + n);
        fmpq_set_si(out + n, k, 1);
        fmpq_inv(out + n, out + n); /* ((k - 1)/k + j (j + 1) k)/2 = (1 + j (j + 1) k - 1/k)/2 */
        fmpq_neg(out + n, out + n);
        fmpq_add_si(out + n, out + n, 1 + j * (j + 1) * k);
        fmpq_div_2exp(out + n, out + n, 1);
        n++;
        for (size_t i = 0; i < all_rows; i++) {
            if (rows[i].k != k) continue;
            long u = rows[i].m + rows[i].n * j;
            fmpq_t a;
            fmpq_init(a);
            fmpq_set_si(a, rows[i].a, (ulong)rows[i].a_den);
            fmpq_init(out + n);
            fmpq_set_si(out + n, rows[i].b * u * u, (ulong)rows[i].b_den);
            fmpq_add(out + n, out + n, a);
            fmpq_clear(a);
            n++;
        }
    }
    return n;
}

Test(darboux, table)
{
    static const long degree[] = {1, -1, 3, -3, 4, -4, 5, -5, 6, 7, -7}, bottom[] = {1, 2, 3, 4, 8, 24};
    fmpq *value = nh_alloc_array(most_values, sizeof *value);
    size_t tried = 0, allowed = 0;
    fmpq_t lambda;
    fmpq_init(lambda);
    for (size_t d = 0; d < sizeof degree / sizeof *degree; d++) {
        long k = degree[d];
        size_t n = table_of(k, value);
        for (size_t i = 0; i < n; i++) {
            cr_expect(nh_darboux_allowed(k, value + i), "k = %ld: a value of the table", k);
            /* Beside it: not, unless that is in the table, too. */
            fmpq_set_si(lambda, 1, 97);
            fmpq_add(lambda, lambda, value + i);
            cr_expect(!nh_darboux_allowed(k, lambda), "k = %ld: no value has the denominator 97", k);
        }
        for (size_t b = 0; b < sizeof bottom / sizeof *bottom; b++)
            for (long a = -3 * bottom[b]; a <= 3 * bottom[b]; a++, tried++) {
                bool listed = false;
                fmpq_set_si(lambda, a, (ulong)bottom[b]);
                for (size_t i = 0; i < n && !listed; i++) listed = fmpq_equal(lambda, value + i);
                allowed += listed;
                cr_expect_eq(nh_darboux_allowed(k, lambda), listed, "k = %ld, lambda = %ld/%ld", k, a, bottom[b]);
            }
        for (size_t i = 0; i < n; i++) fmpq_clear(value + i);
    }
    cr_expect(tried > 2000 && allowed > 150, "%zu of %zu", allowed, tried);
    fmpq_set_si(lambda, 5, 7);
    for (long k = -2; k <= 2; k += 2) cr_expect(nh_darboux_allowed(k, lambda), "k = %ld: the theorem says nothing", k);
    fmpq_clear(lambda);
    nh_free(value);
}

/* ---- potentials ---- */

static const char head[] = "name: potential\ncoordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\n",
                  third[] = "  - {name: z, type: length}\n";

/* Of L = kinetic energy - V; the rest of the file after it. */
static nh_darboux *darboux_of(nh_arena *arena, bool space, const char *kinetic, const char *V, const char *rest)
{
    char *text = nh_arena_printf(arena, "%s%slagrangian: %s - (%s)\n%s", head, space ? third : "", kinetic, V, rest);
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    nh_closed_shape shape = {.model = x.model};
    nh_darboux *out = nh_darboux_of(arena, &shape);
    mechanics_clear(&x);
    return out;
}

typedef struct {
    const char *V;
    long degree;
    size_t points;
    const char *point, *eigenvalue; /* NULL: open */
} potential;

static void expect(const potential *p, const nh_darboux *out)
{
    cr_expect(out->applies, "%s: %s", p->V, out->obstacle);
    cr_expect_eq(out->degree, p->degree, "%s: degree %ld", p->V, out->degree);
    cr_expect_eq(out->points, p->points, "%s: %zu lines", p->V, out->points);
    cr_expect_eq(out->undecided, 0U, "%s: %zu undecided", p->V, out->undecided);
    cr_expect_eq(out->refuted, p->point != NULL, "%s: %s with %s", p->V, out->refutation.point,
                 out->refutation.eigenvalue);
    cr_expect_eq(out->refuted, out->obstacle == NULL, "%s: %s", p->V, out->obstacle);
    if (!p->point || !out->refuted) return;
    cr_expect(!strcmp(out->refutation.point, p->point), "%s: %s", p->V, out->refutation.point);
    cr_expect(!strcmp(out->refutation.eigenvalue, p->eigenvalue), "%s: %s", p->V, out->refutation.eigenvalue);
}

/* Integrable cubic potentials have y^3 with 2, 1/3 and 16/3, quartic ones 1:6:1, 1:6:8 and 1:12:16. */
Test(darboux, two_coordinates)
{
    static const potential list[] = {
        {"x^2*y - y^3/3", 3, 3, "c = (1, s), 3*s^2 - 1 = 0", "-2"},
        {"x^2*y + 2*y^3", 3, 3, NULL, NULL},
        {"x^2*y + y^3/3", 3, 3, NULL, NULL},
        {"x^2*y + 16/3*y^3", 3, 3, NULL, NULL},
        {"x^2*y + y^3", 3, 3, "c = (0, 1)", "2/3"},
        {"x^2*y + 2/3*y^3", 3, 1, NULL, NULL},
        {"x^4 + 6*x^2*y^2 + y^4", 4, 4, NULL, NULL},
        {"x^4 + 6*x^2*y^2 + 8*y^4", 4, 4, NULL, NULL},
        {"x^4 + 12*x^2*y^2 + 16*y^4", 4, 4, NULL, NULL},
        {"x^4 + 3*x^2*y^2 + 2*y^4", 4, 4, "c = (1, 0)", "3/2"},
        {"x^4 + x^2*y^2 + y^4", 4, 4, "c = (1, 0)", "1/2"},
        {"x^4 + y^4 + 17", 4, 4, NULL, NULL},  /* a constant does no harm */
        {"x^2*y^2", 4, 2, "c = (1, 1)", "-1"}, /* on the axes the slope vanishes */
        {"(x^2 + y^2)^2", 4, 4, NULL, NULL},   /* every direction is a line: only simple ones are tried */
        {"x^3 + 3*x^2*y + y^3 + x*y^2", 3, 3, "c = (1, s), s^3 + 3*s^2 + s - 3 = 0", "14/57*s^2 - 2/19*s + 2/57"},
        {"-1/sqrt(x^2 + y^2)", -1, 4, NULL, NULL},
        {"-sqrt(x^2 + y^2)^3", 3, 4, NULL, NULL},
        {"1/x + 1/y", -1, 1, NULL, NULL},
        {"x^3*sqrt(x^2 + y^2) + 5*y^4", 4, 2, "c = (1, 0)", "1/4"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_arena *arena = nh_arena_create();
        nh_darboux *out = darboux_of(arena, false, "(x'^2 + y'^2)/2", list[i].V, "");
        expect(&list[i], out);
        cr_expect_eq(out->roots, strstr(list[i].V, "sqrt") != NULL, "%s", list[i].V);
        cr_expect(out->generic && out->coordinates == 2, "%s", list[i].V);
        nh_arena_free(arena);
    }
}

/* Other coordinates for the same system, x = 2 X and y = 3 Y or x = X + Y: the same lines and answers.  With masses 2 and 3 in place of these,
 * others. */
Test(darboux, masses)
{
    static const struct {
        const char *X, *Y, *kinetic;
    } list[] = {
        {"x", "y", "(x'^2 + y'^2)/2"},
        {"(2*x)", "(3*y)", "2*x'^2 + 9/2*y'^2"},
        {"(x + y)", "y", "((x' + y')^2 + y'^2)/2"},
        {"(x - 3*y)", "(2*x + y)", "((x' - 3*y')^2 + (2*x' + y')^2)/2"},
    };
    static const struct {
        const char *form;
        size_t points;
        bool refuted;
    } potentials[] = {
        {"X^2*Y - Y^3/3", 3, true},           {"X^2*Y + 2*Y^3", 3, false},
        {"X^2*Y + 16/3*Y^3", 3, false},       {"X^2*Y + Y^3", 3, true},
        {"X^2*Y + 2/3*Y^3", 1, false},        {"X^4 + 6*X^2*Y^2 + 8*Y^4", 4, false},
        {"X^4 + 3*X^2*Y^2 + 2*Y^4", 4, true}, {"X^2*Y^2", 2, true},
    };
    for (size_t i = 0; i < sizeof potentials / sizeof *potentials; i++)
        for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
            nh_arena *arena = nh_arena_create();
            nh_text V;
            nh_text_init(&V);
            for (const char *c = potentials[i].form; *c; c++)
                if (*c == 'X' || *c == 'Y') nh_text_add(&V, *c == 'X' ? list[k].X : list[k].Y);
                else nh_text_addf(&V, "%c", *c);
            nh_darboux *out = darboux_of(arena, false, list[k].kinetic, nh_text_string(&V), "");
            cr_expect(out->applies && out->refuted == potentials[i].refuted, "%s: %s, %s", nh_text_string(&V),
                      out->refutation.point, out->refutation.eigenvalue);
            cr_expect_eq(out->points, potentials[i].points, "%s: %zu lines", nh_text_string(&V), out->points);
            nh_text_clear(&V);
            nh_arena_free(arena);
        }
    nh_arena *arena = nh_arena_create();
    /* V_x/2 = s, V_y/3 = 1/3 + 2 s^2: the lines 1/3 + 2 s^2 = s^2, mu = s, trace 5 s, so that 5 - 2 = 3 is the other eigenvalue. */
    nh_darboux *out = darboux_of(arena, false, "(2*x'^2 + 3*y'^2)/2", "x^2*y + 2*y^3", "");
    const potential weighted = {"x^2*y + 2*y^3 with masses 2 and 3", 3, 3, "c = (1, s), 3*s^2 + 1 = 0", "3"};
    expect(&weighted, out);
    nh_arena_free(arena);
}

/* Three coordinates: eigenvalues that are not rational; separable and central potentials stay open; lines in space. */
Test(darboux, three_coordinates)
{
    static const potential list[] = {
        {"x^3 + y^3 + z^3", 3, 7, NULL, NULL},
        {"(x^2 + y^2 + z^2)^2", 4, 13, NULL, NULL},
        {"-1/sqrt(x^2 + y^2 + z^2)", -1, 13, NULL, NULL},
        {"z*(x^2 + 3*x*y + 4*y^2) - z^3/3", 3, 1, "c = (0, 0, 1)", "3*sqrt(2) - 5"},
        {"z*(x^2 + y^2) - z^3/3", 3, 1, "c = (0, 0, 1)", "-2"},
        {"x^2*y^2*z^2", 6, 4, "c = (1, 1, 1)", "-1"},
        {"x*y*z", 3, 4, "c = (1, 1, 1)", "-1"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_arena *arena = nh_arena_create();
        expect(&list[i], darboux_of(arena, true, "(x'^2 + y'^2 + z'^2)/2", list[i].V, ""));
        nh_arena_free(arena);
    }
}

/* Along the last of four coordinates: V'' there is -2 beside 2 (1, 1, 0; 1, 2, 1; 0, 1, 4), mu = -1. */
Test(darboux, four_coordinates)
{
    nh_arena *arena = nh_arena_create();
    mechanics x = mechanics_of_text(
        "name: four\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}, {name: "
        "s, type: length}]\n"
        "lagrangian: (x'^2 + y'^2 + z'^2 + s'^2)/2 - s*(x^2 + 2*x*y + 2*y^2 + 2*y*z + 4*z^2) + s^3/3\n",
        NH_CHART_AUTO);
    nh_closed_shape shape = {.model = x.model};
    nh_darboux *out = nh_darboux_of(arena, &shape);
    const potential cubic = {"four coordinates", 3, 1, "c = (0, 0, 0, 1)",
                             "lambda, lambda^3 + 14*lambda^2 + 48*lambda + 24 = 0"};
    expect(&cubic, out);
    mechanics_clear(&x);
    nh_arena_free(arena);
}

/* Parameters at their values: decimals are ratios.  What the theorem does not speak of. */
Test(darboux, where_it_applies)
{
    static const struct {
        const char *kinetic, *V, *rest;
        bool applies;
    } list[] = {
        {"(x'^2 + y'^2)/2", "x^4 + k*x^2*y^2 + y^4", "parameters: [{name: k, value: 0.3}]\n", true},
        {"(x'^2 + y'^2)/2", "x^2 + 2*y^2", "", false},
        {"(x'^2 + y'^2)/2", "1/(x^2 + 2*y^2)", "", false},
        {"(x'^2 + y'^2)/2", "x^2 + x^2*y", "", false},
        {"(x'^2 + y'^2)/2", "x*sqrt(x)", "", false},
        {"(x'^2 + y'^2)/2", "x/y", "", false},
        {"(x'^2 + y'^2)/2", "0", "", false},
        {"(x'^2 + y'^2)/2", "x^3*cos(y/x)", "", false},
        {"(x'^2 + y'^2)/2", "x^3 + t*y^3", "", false},
        {"(x'^2 + y'^2)/2 + x*y'", "x^3 + y^3", "", false},
        {"(x'^2 + (1 + x^2)*y'^2)/2", "x^3 + y^3", "", false},
        {"(x'^2 + sqrt(2)*y'^2)/2", "x^3 + y^3", "", false},
        {"(x'^2 + y'^2)/2", "x^3 + y^3", "forces:\n  - x = -x'\n", false},
        {"(x'^2 + y'^2)/2", "x^3 + y^3", "constraints: [\"x' = y'*x\"]\n", false},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_arena *arena = nh_arena_create();
        nh_darboux *out = darboux_of(arena, false, list[i].kinetic, list[i].V, list[i].rest);
        cr_expect_eq(out->applies, list[i].applies, "%s - %s: %s", list[i].kinetic, list[i].V, out->obstacle);
        cr_expect(out->applies || (out->obstacle && !out->refuted && !out->points), "%s", list[i].V);
        if (i == 0) {
            cr_expect(out->refuted && out->generic);
            cr_expect_str_eq(out->refutation.eigenvalue, "3/20");
        }
        nh_arena_free(arena);
    }
}

/* Three bodies at the corners of an equilateral triangle (Lagrange), for almost all masses: the eigenvalues are -1/2 +- 3/2 sqrt(1 - 3 sigma),
 * sigma = (a b + b c + c a)/(a + b + c)^2.  Equal masses stand on a line as well, the middle one at rest (Euler), in six ways. */
Test(darboux, three_bodies)
{
    static const char *const masses[] = {"a", "b", "c"};
    static const struct {
        double mass[3];
        size_t points;
        const char *eigenvalue;
    } list[] = {
        {{1.3, 0.8, 1.9}, 1, "3*sqrt(91)/80 - 1/2"}, /* sigma = 503/1600 */
        {{1, 1, 1}, 7, "-1/2"},
        {{1, 2, 3}, 1, "sqrt(3)/4 - 1/2"},
    };
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        nh_setting setting[3];
        for (size_t i = 0; i < 3; i++) setting[i] = (nh_setting){.name = masses[i], .value = list[k].mass[i]};
        mechanics x = mechanics_of_file("systems/three_bodies.yaml", NH_CHART_AUTO, 3, setting);
        nh_closed_shape shape = {.model = x.model};
        nh_arena *arena = nh_arena_create();
        nh_darboux *out = nh_darboux_of(arena, &shape);
        cr_assert(out->applies && out->refuted, "%s", out->obstacle);
        cr_expect(out->degree == -1 && out->roots && out->generic && out->coordinates == 6 && !out->undecided);
        cr_expect_eq(out->points, list[k].points, "%zu lines", out->points);
        cr_expect_str_eq(out->refutation.point, "c, an equilateral triangle about the centre of mass");
        cr_expect_str_eq(out->refutation.eigenvalue, list[k].eigenvalue);
        nh_arena_free(arena);
        mechanics_clear(&x);
    }
}

/* The same in space, with springs of degree 4, which are no three bodies where the masses along the axes differ: then the triangle is none, and what
 * is left are lines. */
Test(darboux, three_bodies_in_space)
{
    static const struct {
        const char *m;
        bool triangle;
    } list[] = {{"2", true}, {"3", false}};
    for (size_t k = 0; k < 2; k++) {
        nh_arena *arena = nh_arena_create();
        nh_text text;
        nh_text_init(&text);
        nh_text_add(&text, "name: bodies\ncoordinates:\n");
        for (int i = 0; i < 9; i++) nh_text_addf(&text, "  - {name: %c%d, type: length}\n", "xyz"[i % 3], 1 + i / 3);
        nh_text_addf(
            &text,
            "lagrangian: (x1'^2 + y1'^2 + z1'^2)/2 + (2*x2'^2 + %s*y2'^2 + 2*z2'^2)/2 + (x3'^2 + y3'^2 + z3'^2)*5/2",
            list[k].m);
        for (int i = 1; i <= 3; i++)
            nh_text_addf(&text, " + 3*%d/sqrt((x%d - x%d)^2 + (y%d - y%d)^2 + (z%d - z%d)^2)",
                         i == 1   ? 2
                         : i == 2 ? 10
                                  : 5,
                         i, i % 3 + 1, i, i % 3 + 1, i, i % 3 + 1);
        mechanics x = mechanics_of_text(nh_text_string(&text), NH_CHART_AUTO);
        nh_closed_shape shape = {.model = x.model};
        nh_darboux *out = nh_darboux_of(arena, &shape);
        cr_expect_eq(out->refuted, list[k].triangle, "%s", out->obstacle);
        cr_expect_eq(out->points, list[k].triangle, "%zu lines", out->points);
        if (out->refuted) cr_expect_str_eq(out->refutation.eigenvalue, "3*sqrt(13)/16 - 1/2"); /* sigma = 17/64 */
        mechanics_clear(&x);
        nh_text_clear(&text);
        nh_arena_free(arena);
    }
}

/* On (1, 1) the eigenvalue beside 2 is (4 + sqrt(2))/(2 + sqrt(2)) = 3 - sqrt(2), not its conjugate. */
Test(darboux, roots_on_a_line)
{
    nh_arena *arena = nh_arena_create();
    nh_darboux *out = darboux_of(arena, false, "(x'^2 + y'^2)/2", "x^3 + y^3 + sqrt(x^2 + y^2)^3/2", "");
    cr_expect(out->refuted && out->points >= 3 && !out->undecided, "%s", out->obstacle);
    cr_expect_str_eq(out->refutation.point, "c = (1, 1)");
    cr_expect_str_eq(out->refutation.eigenvalue, "lambda, lambda^2 - 6*lambda + 7 = 0");
    nh_arena_free(arena);
}

/* For which values of the parameters, beside those given?  A line that is one for all values; a degree that is. */
Test(darboux, parameters)
{
    static const struct {
        bool space;
        const char *kinetic, *V;
        bool generic;
    } list[] = {
        {false, "(x'^2 + y'^2)/2", "k*(x^4 + x^2*y^2) + y^4/k", true},
        {false, "(k*x'^2 + y'^2)/2", "x^4 + x^2*y^2 + y^4 + k*7", true},
        {false, "(x'^2 + y'^2)/2", "x^3 + x^2*y + k*y^3", true},
        {false, "(x'^2 + y'^2)/2", "x^4 + x^2*y^2 + y^4 + (k - 3)*x", false}, /* 0 at the given value */
        {false, "(x'^2 + y'^2)/2", "x^4 + x^2*y^2 + y^4 + (k - 3)*x^3*sqrt(x^2 + y^2)",
         false}, /* homogeneous, but no polynomial */
        {false, "(x'^2 + y'^2)/2", "x^4 + x^2*y^2 + y^(k + 1)", false},
        {false, "(x'^2 + (k - 2 + (k - 3)*x^2)*y'^2)/2", "x^4 + x^2*y^2 + y^4", false},
        {false, "(x'^2 + y'^2)/2 + (k - 3)*x*y'", "x^4 + x^2*y^2 + y^4", false},
        {true, "(x'^2 + y'^2 + z'^2)/2", "z*(x^2 + k*y^2) - z^3/3", true},    /* along z for all k */
        {true, "(x'^2 + y'^2 + k/3*z'^2)/2", "(x + y + z)^3 + x*y*z", false}, /* along (1, 1, 1) for 3 alone */
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_arena *arena = nh_arena_create();
        nh_darboux *out =
            darboux_of(arena, list[i].space, list[i].kinetic, list[i].V, "parameters: [{name: k, value: 3}]\n");
        cr_expect(out->applies && out->refuted, "%s: %s", list[i].V, out->obstacle);
        cr_expect_eq(out->generic, list[i].generic, "%s at %s", list[i].V, out->refutation.point);
        nh_arena_free(arena);
    }
}

/* Integrable by construction, in turned coordinates (a x - b y, b x + a y)/c: separable ones of each degree, and the known families.  None is refuted;
 * of those with a term too much, each is. */
Test(darboux, turned)
{
    static const long turn[][3] = {{1, 0, 1}, {3, 4, 5}, {5, -12, 13}, {20, 21, 29}};
    static const struct {
        const char *form;
        bool refuted;
    } list[] = {
        {"7*X^3 - 2*Y^3", false},
        {"3*X^4 + 5*Y^4", false},
        {"X^5 + 11*Y^5", false},
        {"X^6 - 4*Y^6", false},
        {"2*X^7 + Y^7", false},
        {"2/X + 3/Y", false},
        {"2/X^3 - 3/Y^3", false},
        {"X^2*Y + 2*Y^3", false},
        {"X^2*Y + Y^3/3", false},
        {"X^2*Y + 16/3*Y^3", false},
        {"X^4 + 6*X^2*Y^2 + Y^4", false},
        {"X^4 + 6*X^2*Y^2 + 8*Y^4", false},
        {"X^4 + 12*X^2*Y^2 + 16*Y^4", false},
        {"(X^2 + Y^2)^3", false},
        {"3*X^4 + 5*Y^4 + X^2*Y^2", true},
        {"X^5 + 11*Y^5 + X^3*Y^2", true},
        {"X^6 - 4*Y^6 + X^2*Y^4", true},
        {"X^2*Y + 3*Y^3", true},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        for (size_t k = 0; k < sizeof turn / sizeof *turn; k++) {
            nh_arena *arena = nh_arena_create();
            nh_text V;
            nh_text_init(&V);
            for (const char *c = list[i].form; *c; c++)
                if (*c == 'X') nh_text_addf(&V, "((%ld*x - (%ld)*y)/%ld)", turn[k][0], turn[k][1], turn[k][2]);
                else if (*c == 'Y') nh_text_addf(&V, "((%ld*x + %ld*y)/%ld)", turn[k][1], turn[k][0], turn[k][2]);
                else nh_text_addf(&V, "%c", *c);
            nh_darboux *out = darboux_of(arena, false, "(x'^2 + y'^2)/2", nh_text_string(&V), "");
            cr_expect(out->applies && out->refuted == list[i].refuted, "%s, turn %zu: %s %s", list[i].form, k,
                      out->refutation.point, out->refutation.eigenvalue);
            nh_text_clear(&V);
            nh_arena_free(arena);
        }
}

/* The table, which was typed, and Kovacic's algorithm say the same of Gauss's equation. */
Test(darboux, both_ways)
{
    static const long degree[] = {1, -1, 3, -3, 4, -4, 5, -5, 6, 7, -7};
    enum { largest = 9, bottoms = 5 };
    static const ulong bottom[bottoms] = {1, 2, 3, 8, 24};
    nh_arena *arena = nh_arena_create();
    fmpq_t lambda;
    fmpq_init(lambda);
    size_t refuted = 0, allowed = 0;
    for (size_t i = 0; i < sizeof degree / sizeof *degree; i++)
        for (size_t b = 0; b < bottoms; b++)
            for (long top = -largest; top <= largest; top++) {
                fmpq_set_si(lambda, top, bottom[b]);
                bool in_table = nh_darboux_allowed(degree[i], lambda);
                bool excluded = nh_darboux_excluded(arena, degree[i], lambda);
                cr_expect_eq(excluded, !in_table, "degree %ld, %ld/%lu", degree[i], top, bottom[b]);
                refuted += excluded;
                allowed += in_table;
            }
    cr_expect_gt(refuted, 500);
    cr_expect_gt(allowed, 50);
    fmpq_clear(lambda);
    nh_arena_free(arena);
}
