/* Special values of two parameters: common zeros that are known, lifting, families of the literature (whose files hold
 * no answers), random families with and without planted curves and points, and the command. */
#include <criterion/criterion.h>
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/classify.h"
#include "names.h"
#include "program.h"
#include "sweep.h"

/* ---- common zeros ---- */

/* coefficient[j][i] of lambda^i mu^j, up to degree two in each. */
static nh_residue_polynomial surface(nh_prime f, int64_t c[3][3])
{
    nh_residue_polynomial s = {.degree = {2, 2}, .coefficient = nh_alloc_array(9, sizeof(nh_residue))};
    for (size_t k = 0; k < 9; k++) s.coefficient[k] = nh_residue_of(f, c[k / 3][k % 3]);
    return s;
}

static nh_residue at(nh_prime f, const nh_residue_polynomial *s, nh_residue lambda, nh_residue mu)
{
    nh_residue sum = 0;
    for (size_t j = s->degree[1] + 1; j-- > 0;) {
        nh_residue row = 0;
        for (size_t i = s->degree[0] + 1; i-- > 0;)
            row = nh_residue_add(f, nh_residue_mul(f, row, lambda), s->coefficient[j * (s->degree[0] + 1) + i]);
        sum = nh_residue_add(f, nh_residue_mul(f, sum, mu), row);
    }
    return sum;
}

/* (lambda - mu^2) times three polynomials that are zero together at (3, 5) alone. */
Test(plane, common_zeros_are_a_curve_and_a_point)
{
    nh_prime f = nh_prime_at(2);
    int64_t curve[3][3] = {{0, 1, 0}, {0, 0, 0}, {-1, 0, 0}}, one[3][3] = {{1, 0, 0}}, parts[3][3][3] = {
        {{-8, 1, 0}, {1, 0, 0}},                 /* lambda + mu - 8 */
        {{-15, 0, 0}, {0, 1, 0}},                /* lambda mu - 15 */
        {{-16, 0, -1}, {0, 0, 0}, {1, 0, 0}}};   /* mu^2 - lambda^2 - 16 */
    nh_residue_polynomial p[3], Q[1] = {surface(f, one)}, c = surface(f, curve);
    for (size_t k = 0; k < 3; k++) {
        nh_residue_polynomial part = surface(f, parts[k]);
        p[k] = nh_residue_polynomial_times(f, &c, &part);
        nh_free(part.coefficient);
    }
    nh_common_zeros found;
    cr_assert(nh_common_zeros_find(f, 3, p, 1, Q, &found));
    cr_assert(found.part[NH_ZEROS_SPECIAL].degree[0] == 1 && found.part[NH_ZEROS_SPECIAL].degree[1] == 2);
    cr_expect_eq(at(f, &found.part[NH_ZEROS_SPECIAL], 49, 7), 0);
    cr_expect_neq(at(f, &found.part[NH_ZEROS_SPECIAL], 49, 8), 0);
    cr_expect(found.part[NH_ZEROS_DEGENERATE].degree[0] == 0 && found.part[NH_ZEROS_DEGENERATE].degree[1] == 0);
    cr_assert_eq(found.part[NH_ZEROS_ACROSS].degree[1], 1);
    cr_expect_eq(found.part[NH_ZEROS_ACROSS].coefficient[0], nh_residue_of(f, -5));
    nh_common_zeros_clear(&found);
    for (size_t k = 0; k < 3; k++) nh_free(p[k].coefficient);
    nh_free(Q[0].coefficient);
    nh_free(c.coefficient);
}

/* (2 lambda - 3 mu)(lambda^2 - 5 mu^2 + 1) */
Test(plane, curves_are_lifted_and_factored)
{
    static const int64_t whole[4][4] = {{0, 2, 0, 2}, {-3, 0, -3, 0}, {0, -10, 0, 0}, {15, 0, 0, 0}};
    nh_prime prime[4];
    nh_residue_polynomial residue[4];
    for (size_t i = 0; i < 4; i++) {
        prime[i] = nh_prime_at(i);
        residue[i] = (nh_residue_polynomial){.degree = {3, 3}, .coefficient = nh_alloc_array(16, sizeof(nh_residue))};
        for (size_t k = 0; k < 16; k++)
            residue[i].coefficient[k] = nh_residue_mul(prime[i], nh_residue_of(prime[i], whole[k / 4][k % 4]),
                                                       nh_residue_inverse(prime[i], 2));
    }
    nh_special_factors c = nh_special_lift(4, prime, residue);
    cr_assert(c.lifted);
    cr_assert_eq(c.factors, 2);
    cr_assert(c.factor[0].degree[0] == 1 && c.factor[0].degree[1] == 1);
    cr_expect(c.factor[0].coefficient[1] == 2 && c.factor[0].coefficient[2] == -3);
    nh_special_factor half = {.degree = {1}, .coefficient = (int64_t[]){-3, 2}}, other = {.degree = {1},
        .coefficient = (int64_t[]){-3, 1}}, root = {.degree = {2}, .coefficient = (int64_t[]){-4, 0, 1}};
    nh_special_factor one = {.degree = {0, 1}, .coefficient = (int64_t[]){-1, 1}}; /* mu = 1 */
    nh_special_place on = {.count = 2, .gives = {1}, .equation = {one, half}};
    cr_expect(nh_special_contains(&c.factor[0], &on));
    on.equation[1] = other;
    cr_expect_not(nh_special_contains(&c.factor[0], &on));
    on.equation[1] = root;
    cr_expect(nh_special_contains(&c.factor[1], &on), "4 - 5 + 1");
    for (uint64_t seed = 1; seed < 20; seed++) {
        nh_residue point[NH_MOST_PARAMETERS];
        if (!nh_special_point(&c.factor[1], prime[0], seed, point)) continue;
        nh_residue five = nh_residue_mul(prime[0], 5, nh_residue_mul(prime[0], point[1], point[1]));
        cr_expect_eq(nh_residue_add(prime[0], nh_residue_mul(prime[0], point[0], point[0]), 1), five);
    }
    nh_special_factors_clear(&c);
    residue[3].coefficient[5] ^= 1; /* the last prime does not agree */
    c = nh_special_lift(4, prime, residue);
    cr_expect_not(c.lifted);
    nh_special_factors_clear(&c);
    for (size_t i = 0; i < 4; i++) nh_free(residue[i].coefficient);
}

/* ---- determinants ---- */

/* diag(lambda - mu, lambda mu - 6, 1) between random matrices of more rows and columns: zero on both curves only. */
Test(plane, determinants_vanish_where_rank_is_lost)
{
    enum { rows = 5, columns = 4, core = 3 };
    nh_prime f = nh_prime_at(1);
    uint64_t random = 9;
    nh_residue left[rows][core], right[core][columns], entry[4 * rows * columns] = {0};
    int64_t diagonal[4][core] = {{0, -6, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}; /* 1, lambda, mu, lambda mu */
    for (size_t k = 0; k < rows * core; k++) left[k / core][k % core] = nh_residue_random(f, &random);
    for (size_t k = 0; k < core * columns; k++) right[k / columns][k % columns] = nh_residue_random(f, &random);
    for (size_t z = 0; z < 4 * rows * columns; z++)
        for (size_t a = 0; a < core; a++) {
            size_t power = z / (rows * columns), i = z / columns % rows, j = z % columns;
            nh_residue both = nh_residue_mul(f, left[i][a], right[a][j]);
            entry[z] = nh_residue_add(f, entry[z], nh_residue_mul(f, both, nh_residue_of(f, diagonal[power][a])));
        }
    nh_staircase_matrices m = {.degree = 1, .second = 1, .rows = rows, .columns = columns, .entry = entry};
    nh_residue_polynomial d;
    cr_assert_eq(nh_staircase_generic_rank(&m, f), core);
    cr_assert(nh_staircase_determinant(&m, f, core, 5, &d));
    cr_expect_eq(at(f, &d, 11, 11), 0);
    cr_expect_eq(at(f, &d, 3, 2), 0);
    for (nh_residue k = 0; k < 20; k++) cr_expect_neq(at(f, &d, 3 + k, 30 + 2 * k), 0);
    nh_free(d.coefficient);
}

/* ---- families ---- */

static nh_classification *plane_of(nh_system *s, size_t degree)
{
    nh_error error = {0};
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    must(o != NULL, &error, "the model");
    nh_classify_question q = {.parameters = 2, .parameter = {1, 0}, .degree = degree, .work = 1e10, .products = 5e10,
                              .unknowns = 6000, .plane = 100, .known = 1, .current = &o->E};
    nh_classification *p = nh_classify(o, &q);
    nh_model_free(o);
    return p;
}

/* "(1,0,-2)@2 1/3|1@2": curves by their coefficients and points lambda|mu, with the degrees from which on there are
 * more. */
static void describe(const nh_classification *p, char *out, size_t size)
{
    size_t n = 0;
    out[0] = 0;
    for (size_t k = 0; k < p->specials && n < size; k++) {
        const nh_special_factor *c = &p->special[k].polynomial;
        if (!p->special[k].first && !p->special[k].degenerate) continue;
        n += (size_t)snprintf(out + n, size - n, "%s%s", n ? " " : "", p->special[k].degenerate ? "C" : "");
        for (size_t i = (c->degree[0] + 1) * (c->degree[1] + 1); i-- > 0 && n < size;)
            n += (size_t)snprintf(out + n, size - n, "%lld%s", (long long)c->coefficient[i], i ? "," : "");
        if (p->special[k].first) n += (size_t)snprintf(out + n, size - n, "@%zu", p->special[k].first);
    }
    for (size_t k = 0; k < p->points && n < size; k++) {
        const nh_classify_wall *line = &p->wall[p->point[k].wall];
        const nh_classify_special *v = &line->within->special[p->point[k].value];
        int64_t top[2], bottom[2];
        cr_assert(nh_special_rational(&v->polynomial, &top[0], &bottom[0]));
        cr_assert(nh_special_rational(&line->polynomial, &top[1], &bottom[1]));
        n += (size_t)snprintf(out + n, size - n, "%s%lld/%lld|%lld/%lld@%zu", n ? " " : "", (long long)top[0],
                              (long long)bottom[0], (long long)top[1], (long long)bottom[1], v->first);
    }
}

static void expect_plane(nh_system *s, size_t degree, const char *expected, const char *name)
{
    char found[2000];
    nh_classification *p = plane_of(s, degree);
    cr_assert_null(p->obstacle, "%s: %s", name, p->obstacle);
    cr_assert_eq(p->rows, degree, "%s: ended by %s", name, p->end);
    for (size_t d = 0; d < degree; d++) {
        cr_expect(p->row[d].lifted, "%s, degree %zu", name, d + 1);
        cr_expect_geq(p->row[d].height, 100, "%s, degree %zu", name, d + 1);
        cr_expect_eq(p->row[d].number.bound, p->row[d].known, "%s, degree %zu", name, d + 1);
    }
    describe(p, found, sizeof found);
    cr_expect_str_eq(found, expected, "%s", name);
    nh_classification_free(p);
    nh_system_free(s);
}

static nh_system *parsed(const char *text)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("plane.yaml", text, 0, NULL, &error);
    must(s != NULL, &error, text);
    return s;
}

static nh_system *family(const char *file, size_t settings, const nh_setting *setting)
{
    char path[200];
    nh_error error = {0};
    snprintf(path, sizeof path, "tests/data/classify/%s.yaml", file);
    nh_system *s = nh_system_read(path, settings, setting, &error);
    must(s != NULL, &error, path);
    cr_assert_eq(s->parameters, 2);
    return s;
}

/* [Hietarinta1987]: eps = 2 for every B, and (B, eps) = (1, 1/3), (16, 16/3). */
Test(plane, henon_heiles, PLAIN_ONLY)
{
    nh_setting one = {.name = "A", .value = 1, .top = 1, .bottom = 1}, three = {.name = "A", .value = 3, .top = 3,
        .bottom = 1};
    expect_plane(family("henon_heiles", 1, &one), 4, "1,-2@2 1/3|1/1@2 16/3|16/1@4", "A = 1");
    expect_plane(family("henon_heiles", 1, &three), 4, "1,-2@2 1/3|3/1@2 16/3|48/1@4", "A = 3");
}

/* x^4 + b x^2 y^2 + mu y^4, with x and y exchanged: every row of [Hietarinta1987] that is homogeneous of degree four
 * and even. */
Test(plane, quartic_potentials, PLAIN_ONLY)
{
    expect_plane(parsed("name: q\nparameters: {mu: 0.7, b: 0.4}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - b*x^2*y^2 - mu*y^4\n"),
                 4, "1,0@2 2/1|1/1@1 6/1|1/1@2 0/1|0/1@1 12/1|16/1@2 3/4|1/16@2 6/1|8/1@4 3/4|1/8@4", "quartic");
}

/* A mass as parameter, with the determinant of the metric: for m = 1 separable in elliptic coordinates, of which the
 * point k = 1 on this curve is not isolated. */
Test(plane, metrics_may_depend_on_the_parameters)
{
    expect_plane(parsed("name: q\nparameters: {m: 0.7, k: 0.4}\ncoordinates: [x, y]\nlagrangian: (x'^2 + m*y'^2)/2 - (x^2 + k*y^2)/2 - (x^2 + y^2)^2\n"),
                 2, "C1,0 1,-1@2", "masses");
}

/* ---- random families ---- */

static int small(uint64_t *random) { return (int)(nh_residue_random(nh_prime_at(0), random) % 19) - 9; }

/* A dense potential of degrees 2 to 4, in brackets. */
static void put_potential(nh_text *out, uint64_t *random)
{
    nh_text_add(out, "(");
    for (int degree = 2; degree <= 4; degree++)
        for (int i = 0; i <= degree; i++) nh_text_addf(out, " + (%d)*x^%d*y^%d", small(random), i, degree - i);
    nh_text_add(out, ")");
}

typedef enum { NOTHING, CURVE, POINT } planted;

/* With a curve a lambda + b mu + c or a point V is separable in turned coordinates there. */
static void random_family(planted what, uint64_t *random, char *expected, size_t size)
{
    nh_text text;
    int turn = 1 + (small(random) + 9) % 4, a = 1 + (small(random) + 9) % 3, b = 1 + (small(random) + 9) % 5,
        c = 1 + (small(random) + 9) % 5, d = 2 * small(random) + 1;
    nh_text_init(&text);
    nh_text_add(&text, "name: random\nparameters: {mu: 0.41, la: 0.37}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (");
    if (what == NOTHING) put_potential(&text, random);
    else
        nh_text_addf(&text, "(%d*x + y)^4 + (%d)*(%d*x + y)^2 + (x - %d*y)^3 + (%d)*(x - %d*y)^2", turn, small(random),
                     turn, turn, small(random), turn);
    if (what == CURVE) nh_text_addf(&text, " + (%d*la + %d*mu^2 - %d)*", a, b, c);
    else nh_text_addf(&text, what == POINT ? " + (%d*la - (%d))*" : " + la*", 2, d);
    put_potential(&text, random);
    if (what != CURVE) {
        nh_text_addf(&text, what == POINT ? " + (mu + %d)*" : " + mu*", b);
        put_potential(&text, random);
    }
    nh_text_add(&text, ")\n");
    int shared = a == b && b == c ? a : a == 2 && b % 2 == 0 && c % 2 == 0 ? 2 : a == 3 && b == 3 && c == 3 ? 3 : 1;
    if (what == CURVE) snprintf(expected, size, "0,%d,0,0,%d,%d@2", b / shared, a / shared, -c / shared);
    if (what == POINT) snprintf(expected, size, "%d/2|%d/1@2", d, -b);
    expect_plane(parsed(nh_text_string(&text)), 3, what == NOTHING ? "" : expected, nh_text_string(&text));
    nh_text_clear(&text);
}

Test(plane, nothing_is_found_where_there_is_nothing, WHOLE_ONLY)
{
    uint64_t random = 81;
    char none[100];
    for (int round = 0; round < 6; round++) random_family(NOTHING, &random, none, sizeof none);
}

Test(plane, planted_curves_are_found, PLAIN_ONLY)
{
    uint64_t random = 82;
    char expected[100];
    for (int round = 0; round < 6; round++) random_family(CURVE, &random, expected, sizeof expected);
}

Test(plane, planted_points_are_found, PLAIN_ONLY)
{
    uint64_t random = 83;
    char expected[100];
    for (int round = 0; round < 6; round++) random_family(POINT, &random, expected, sizeof expected);
}

/* Points with an irrational coordinate are not examined, and this is said. */
Test(plane, irrational_points_stay_open)
{
    static const char text[] = "name: a\nparameters: {mu: 0.4, la: 0.3}\ncoordinates: [x, y]\n"
        "lagrangian: (x'^2 + y'^2)/2 - x^4 - y^3 - (la - 1)*x*y^2 - (mu^2 - 2)*(x^2*y + 3*x*y^3)\n";
    nh_system *s = parsed(text);
    nh_classification *p = plane_of(s, 2);
    cr_assert_eq(p->rows, 2);
    bool found = false;
    for (size_t k = 0; k < p->walls; k++) {
        const nh_special_factor *f = &p->wall[k].polynomial;
        found |= f->degree[1] == 2 && f->coefficient[2] == 1 && f->coefficient[1] == 0 && f->coefficient[0] == -2
            && !p->wall[k].within;
    }
    cr_expect(found);
    nh_classification_free(p);
    nh_system_free(s);
}

Test(plane, limits_are_named)
{
    nh_system *s = parsed("name: a\nparameters: {mu: 0.4, la: 0.3}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - la*x^2*y - mu*y^3 - x^2\n");
    nh_error error = {0};
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    must(o != NULL, &error, "the model");
    nh_classify_question q = {.parameters = 2, .parameter = {1, 0}, .degree = 4, .work = 1e10, .products = 5e10, .unknowns = 6000,
                              .plane = 4, .known = 1, .current = &o->E};
    nh_classification *p = nh_classify(o, &q);
    cr_expect_str_eq(p->end, "plane");
    cr_expect_lt(p->rows, 4);
    nh_classification_free(p);
    q.plane = 100, q.unknowns = 30;
    p = nh_classify(o, &q);
    cr_expect_str_eq(p->end, "unknowns");
    nh_classification_free(p);
    nh_model_free(o);
    nh_system_free(s);
    s = parsed("name: a\nparameters: {mu: 0.4, la: 0.3}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - la*x^2*y - exp(mu*x)\n");
    p = plane_of(s, 2);
    cr_assert_not_null(p->obstacle);
    cr_expect(strstr(p->obstacle, "inside of a function"), "%s", p->obstacle);
    nh_classification_free(p);
    nh_system_free(s);
}

/* ---- the command ---- */

static const cJSON *key(const cJSON *object, const char *name) { return cJSON_GetObjectItem(object, name); }

Test(plane, the_command_constructs_and_proves, PLAIN_ONLY)
{
    place p = place_make();
    char line[500];
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/henon_heiles.yaml --over B,eps --quiet --json -", p.project);
    finished f = run_expecting(&p, line, 0);
    cJSON *root = cJSON_Parse(f.out);
    cr_assert_not_null(root);
    const cJSON *special = key(root, "special"), *item, *point = cJSON_GetArrayItem(special, 2);
    cr_assert_eq(cJSON_GetArraySize(special), 3);
    cJSON_ArrayForEach(item, special)
    {
        cr_expect(cJSON_IsTrue(key(item, "proved")));
        cr_expect_eq(cJSON_GetArraySize(key(item, "currents")), 2);
    }
    cr_expect_str_eq(cJSON_GetStringValue(key(cJSON_GetArrayItem(special, 0), "where")), "eps - 2 = 0");
    cr_expect_str_eq(cJSON_GetStringValue(key(key(point, "where"), "B")), "16");
    cr_expect_str_eq(cJSON_GetStringValue(key(key(point, "where"), "eps")), "16/3");
    cr_expect_eq(cJSON_GetNumberValue(key(point, "dimension")), 4);
    cr_expect_eq(cJSON_GetNumberValue(key(root, "generic")), 3);
    cr_expect(cJSON_IsTrue(key(root, "nowhere_else")));
    cJSON_Delete(root);
    finished_clear(&f);
    place_clear(&p);
}

static void write_system(const place *p, const char *parameters, const char *lagrangian)
{
    char path[PATH_MAX + 30];
    snprintf(path, sizeof path, "%s/a.yaml", p->folder);
    FILE *file = fopen(path, "w");
    cr_assert_not_null(file);
    fprintf(file, "name: a\nparameters: {%s}\ncoordinates: [x, y]\nlagrangian: %s\n", parameters, lagrangian);
    fclose(file);
}

/* Where a curve of equal masses meets that without potential there is no more than without potential. */
Test(plane, a_point_has_more_than_every_curve_through_it, PLAIN_ONLY)
{
    place p = place_make();
    write_system(&p, "m: 1.5, k: 0.7", "(x'^2 + m*y'^2)/2 - k/(x^2 + y^2)^(1/2)");
    finished f = run_expecting(&p, "classify a.yaml --over m,k --degree 2", 0);
    cr_expect(strstr(f.out, "2 curves and 0 points"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* The curve la = 1 + 1/mu, and a point on it where the other coupling ends as well; a curve m = 1 with k free. */
Test(plane, points_on_curves_are_found, PLAIN_ONLY)
{
    place p = place_make();
    write_system(&p, "mu: 0.4, la: 0.3", "(x'^2 + y'^2)/2 - x^4 - (mu - 3)*y^3 - (mu*la - 1 - mu)*(x^2*y + x*y^3)");
    finished f = run_expecting(&p, "classify a.yaml --over mu,la --degree 2 --details", 0);
    cr_expect(strstr(f.out, "mu*la - mu - 1 = 0") || strstr(f.out, "la*mu - mu - 1 = 0"), "%s", f.out);
    cr_expect(strstr(f.out, "All proved for every mu; for almost all the list is complete up to degree 2."), "%s", f.out);
    cr_expect(strstr(f.out, "mu = 3, la = 4/3\n"), "%s", f.out);
    finished_clear(&f);
    write_system(&p, "m: 0.4, k: 0.3", "(x'^2 + m*y'^2)/2 - (x^2 + k*y^2)/2 - (x^2 + y^2)^2");
    f = run_expecting(&p, "classify a.yaml --over m,k --degree 2 --details", 0);
    cr_expect(strstr(f.out, "All proved for every k; for almost all the list is complete up to degree 2."), "%s", f.out);
    cr_expect(strstr(f.out, "m = 1, k = 1   (on m - 1 = 0)"), "%s", f.out);
    cr_expect(strstr(f.out, "Degenerate, and not examined: m = 0"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* Only what was looked at is excluded. */
Test(plane, lines_that_were_not_examined_are_named)
{
    place p = place_make();
    write_system(&p, "mu: 0.4, la: 0.3", "(x'^2 + y'^2)/2 - x^4 - y^3 - (mu - 1)*x*y^2 - mu*la*(x^2*y + x*y^3)");
    finished f = run_expecting(&p, "classify a.yaml --over mu,la --degree 2", 0);
    cr_expect(strstr(f.out, "mu = 1, la = 0"), "%s", f.out);
    cr_expect_not(strstr(f.out, "Not examined"), "%s", f.out);
    finished_clear(&f);
    write_system(&p, "mu: 0.4, la: 0.3", "(x'^2 + y'^2)/2 - x^4 - y^3 - (la - 1)*x*y^2 - (mu^2 - 2)*(x^2*y + 3*x*y^3)");
    f = run_expecting(&p, "classify a.yaml --over mu,la --degree 2", 0);
    cr_expect(strstr(f.out, "Not examined, or not up to the highest degree: points with mu^2 - 2 = 0"), "%s", f.out);
    finished_clear(&f);
    f = run_expecting(&p, "classify a.yaml --over mu,la --degree 2 --quiet --json -", 0);
    cJSON *root = cJSON_Parse(f.out);
    cr_expect(cJSON_IsFalse(key(root, "nowhere_else")));
    cr_expect_eq(cJSON_GetArraySize(key(root, "undecided")), 1);
    cJSON_Delete(root);
    finished_clear(&f);
    place_clear(&p);
}

static char *file_of(const place *p, const char *name)
{
    char path[PATH_MAX + 60];
    snprintf(path, sizeof path, "%s/out/%s", p->folder, name);
    FILE *f = fopen(path, "r");
    cr_assert_not_null(f, "%s", path);
    char *text = calloc(1, 2000000);
    cr_assert_lt(fread(text, 1, 1999999, f), 1999999);
    fclose(f);
    return text;
}

/* Page, LaTeX and picture of a curve that is no graph, a line and a point; and of one parameter. */
Test(plane, documents_show_the_plane)
{
    place p = place_make();
    write_system(&p, "mu: 0.4, la: 0.3", "(x'^2 + y'^2)/2 - x^4 - (mu - 1)*y^3 - mu*y^2 - (la^2 + mu^2 - 4)*(x^2*y + x*y^3)");
    finished f = run_expecting(&p, "classify a.yaml --over mu,la --degree 2 --quiet -o out", 0);
    static const struct {
        const char *name, *words;
    } parts[] = {{"figure1.svg", "<path"}, {"report.html", "with the constant 1: la^2 + mu^2 - 4 = 0: 3; elsewhere 2."}, {"report.html", "Counted modulo primes. No currents: "},
                 {"report.html", "no other pair of rational numbers"}, {"report.html", "id=\"picture\""},
                 {"report.tex", "\\subsection*{$\\mathrm{la}^{2} + \\mu ^{2} - 4 = 0$}"},
                 {"report.tex", "\\addplot"}, {"report.tex", "\\end{document}"},
                 {"result.json", "\"nowhere_else\""}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        char *text = file_of(&p, parts[i].name);
        cr_expect(strstr(text, parts[i].words), "%s lacks %s", parts[i].name, parts[i].words);
        cr_expect_not(strstr(text, "nan\"") || strstr(text, ">nan<"), "%s", parts[i].name);
        free(text);
    }
    finished_clear(&f);
    f = run_expecting(&p, "classify a.yaml --over mu --set la=2 --degree 2 --quiet --html out/line.html --tex out/line.tex", 0);
    char *text = file_of(&p, "line.html");
    cr_expect(strstr(text, "<h2>Special values</h2>") && strstr(text, "<h3><math"), "a value");
    free(text);
    text = file_of(&p, "line.tex");
    cr_expect(strstr(text, "\\section{Special values}") && strstr(text, "\\subsection*{$\\mu  = 0$}"));
    free(text);
    finished_clear(&f);
    place_clear(&p);
}
