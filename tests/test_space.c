/* Special values of three parameters: surfaces from their sections, families of the literature (whose files hold no
 * answers), planted surfaces, curves and points, and the command. */
#include <criterion/criterion.h>
#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "classify/special_values.h"
#include "program.h"
#include "sweep.h"

/* ---- surfaces ---- */

/* (lambda (nu^2 + 3) - mu nu + 1)(2 mu + nu) at one nu, monic in lambda mu; `low`: without the first factor's lambda. */
static nh_residue_polynomial section_at(nh_prime f, nh_residue nu)
{
    nh_residue_polynomial s = {.degree = {1, 2}, .coefficient = nh_alloc_array(6, sizeof(nh_residue))};
    nh_residue a = nh_residue_add(f, nh_residue_mul(f, nu, nu), 3), first[2][2] = {{1, a}, {nh_residue_negative(f, nu), 0}}, second[2] = {nu, 2};
    nh_residue scale = nh_residue_inverse(f, nh_residue_mul(f, 2, a));
    for (size_t j = 0; j < 2; j++)
        for (size_t k = 0; k < 2; k++)
            for (size_t i = 0; i < 2; i++)
                nh_residue_add_multiple(f, 1, &s.coefficient[2 * (j + k) + i], &first[j][i], nh_residue_mul(f, second[k], scale));
    return s;
}

Test(space, surfaces_come_from_sections)
{
    enum { primes = 4, sections = 8 };
    nh_prime prime[primes];
    nh_residue_polynomial volume[primes];
    for (size_t i = 0; i < primes; i++) {
        uint64_t nu[sections];
        nh_residue_polynomial section[sections];
        prime[i] = nh_prime_at(i);
        for (size_t k = 0; k < sections; k++) section[k] = section_at(prime[i], (nh_residue)(nu[k] = 100 + 7 * k));
        nh_residue_polynomial none;
        cr_expect_not(nh_residue_polynomial_from(prime[i], 2, 4, nu, section, &none)); /* of degree 3 over degree 2 */
        cr_assert(nh_residue_polynomial_from(prime[i], 2, sections, nu, section, &volume[i]));
        for (size_t k = 0; k < sections; k++) nh_free(section[k].coefficient);
    }
    nh_special_factors s = nh_special_lift(primes, prime, volume);
    cr_assert(s.lifted);
    cr_assert_eq(s.factors, 2);
    const nh_special_factor *plane = &s.factor[0], *curved = &s.factor[1];
    cr_assert(plane->degree[0] == 0 && plane->degree[1] == 1 && plane->degree[2] == 1);
    cr_assert(curved->degree[0] == 1 && curved->degree[1] == 1 && curved->degree[2] == 2);
    cr_expect(plane->coefficient[1] == 2 && plane->coefficient[2] == 1);

    nh_residue at[3];
    cr_assert(nh_special_point(plane, prime[0], 5, at));
    cr_expect_eq(nh_residue_add(prime[0], nh_residue_mul(prime[0], 2, at[1]), at[2]), 0);

    nh_residue_polynomial part = section_at(prime[0], 55);
    cr_expect(nh_special_cover(2, s.factor, prime[0], 2, 55, &part));
    cr_expect_not(nh_special_cover(1, s.factor, prime[0], 2, 55, &part));
    cr_expect_not(nh_special_cover(2, s.factor, prime[0], 2, 56, &part));
    nh_free(part.coefficient);

    /* on nu = -2 mu the curved one is lambda (4 mu^2 + 3) + 2 mu^2 + 1 = 0 */
    nh_special_place on = {.count = 2, .gives = {2}, .equation = {*plane, {.degree = {1, 2}, .coefficient = (int64_t[]){1, 3, 0, 0, 2, 4}}}};
    cr_expect(nh_special_contains(curved, &on) && nh_special_contains(plane, &on));
    on.equation[1].coefficient = (int64_t[]){1, 3, 0, 0, 2, 5};
    cr_expect(!nh_special_contains(curved, &on) && nh_special_contains(plane, &on));
    /* and at mu = i, where 4 mu^2 + 3 = -1 and 2 mu^2 + 1 = -1, lambda = -1: an irrational point of both */
    nh_special_place point = {.count = 3, .gives = {2, 0}, .equation = {*plane, {.degree = {1}, .coefficient = (int64_t[]){1, 1}}, {.degree = {0, 2}, .coefficient = (int64_t[]){1, 0, 1}}}};
    cr_expect(nh_special_contains(curved, &point) && nh_special_contains(plane, &point));
    point.equation[1].coefficient = (int64_t[]){-1, 1};
    cr_expect_not(nh_special_contains(curved, &point));
    nh_special_factors_clear(&s);
    for (size_t i = 0; i < primes; i++) nh_free(volume[i].coefficient);
}

/* ---- families ---- */

static const cJSON *key(const cJSON *object, const char *name) { return cJSON_GetObjectItem(object, name); }

/* "eps - 2 = 0 @2:6" and "A=1 B=2 eps=3 @2:6", each on a line: where, from which degree, how many. */
static void describe(const cJSON *root, char *out, size_t size)
{
    const cJSON *item;
    size_t n = 0;
    *out = 0;
    cJSON_ArrayForEach(item, key(root, "special"))
    {
        const cJSON *where = key(item, "where"), *value;
        if (cJSON_IsString(where)) n += (size_t)snprintf(out + n, size - n, "%s ", cJSON_GetStringValue(where));
        else
            cJSON_ArrayForEach(value, where)
                n += (size_t)snprintf(out + n, size - n, "%s=%s ", value->string, cJSON_GetStringValue(value));
        n += (size_t)snprintf(out + n, size - n, "@%g:%g%s\n", cJSON_GetNumberValue(key(item, "from_degree")),
                              cJSON_GetNumberValue(key(item, "dimension")), cJSON_IsTrue(key(item, "proved")) ? "" : " open");
    }
}

static void expect_special(const place *p, const char *arguments, const char *expected)
{
    char line[800], found[3000];
    snprintf(line, sizeof line, "classify %.600s --quiet --json -", arguments);
    finished f = run_expecting(p, line, 0);
    cJSON *root = cJSON_Parse(f.out);
    cr_assert_not_null(root, "%s", f.out);
    describe(root, found, sizeof found);
    cr_expect_str_eq(found, expected, "%s", arguments);
    cr_expect(cJSON_IsNull(key(root, "ended_by")));
    cJSON_Delete(root);
    finished_clear(&f);
}

/* [Hietarinta1987] with every ratio of frequencies. */
Test(space, henon_heiles)
{
    place p = place_make();
    char line[500];
    snprintf(line, sizeof line, "%.300s/tests/data/classify/henon_heiles.yaml --over A,B,eps --degree 2 --option planes=1", p.project);
    expect_special(&p, line, "eps - 2 = 0 @2:3\nB = A, 3*eps - 1 = 0 @2:3\n");
    place_clear(&p);
}

static void write_system(const place *p, const char *parameters, const char *potential)
{
    char path[PATH_MAX + 30];
    snprintf(path, sizeof path, "%s/a.yaml", p->folder);
    FILE *file = fopen(path, "w");
    cr_assert_not_null(file);
    fprintf(file, "name: a\nparameters: {%s}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (%s)\n", parameters, potential);
    fclose(file);
}

/* Potentials that are separable where the couplings vanish: on a surface, on two curves (one in a plane of the first parameter),
 * at a point; and what no separable potential is a part of. */
Test(space, planted_surfaces_curves_and_points)
{
    static const struct {
        const char *potential, *planes, *special;
    } rows[] = {
        {"x^4 + y^3 + (u*w - v^2 + 2)*(x^2*y + x*y^3)", "1", "w*u - v^2 + 2 = 0 @2:3\n"},
        {"x^4 + y^3 + (w - u*v)*(x^2*y + x*y^3) + (v - 3*u)*(x*y^2 + 2*x^3*y)", "1", "v = 3*u, w - 3*u^2 = 0 @2:3\n"},
        {"x^4 + y^3 + (2*u - 1)*(x^2*y + x*y^3) + (v - w^2)*(x*y^2 + 2*x^3*y)", "2", "u = 1/2, w^2 - v = 0 @2:3\n"},
        {"x^4 + y^3 + (u + 2)*(x^2*y + x*y^3) + (v - 7)*(x*y^2 + 2*x^3*y) + (5*w + 1)*x^2*y^2", "2", "u=-2 v=7 w=-1/5 @2:3\n"},
        {"x^4 + y^3 + x^2*y + u*x*y^3 + v*(x*y^2 + 2*x^3*y) + w*x^2*y^2", "2", ""},
    };
    place p = place_make();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char line[80];
        if (!sweep_tries(i, 1, 4)) continue;
        snprintf(line, sizeof line, "a.yaml --over u,v,w --degree 2 --option planes=%s", rows[i].planes);
        write_system(&p, "u: 0.41, v: 0.37, w: 0.29", rows[i].potential);
        expect_special(&p, line, rows[i].special);
    }
    place_clear(&p);
}

/* With v = w = 0 oscillators, of the frequencies 1 and sqrt(u): found on the surface, whatever planes are looked at. */
Test(space, what_lies_on_a_surface_is_found_once, PLAIN_ONLY)
{
    place p = place_make();
    write_system(&p, "u: 0.41, v: 0.37, w: 0.29", "x^2 + u*y^2 + v*y^4 + w*x^2*y");
    expect_special(&p, "a.yaml --over u,v,w --degree 2 --option planes=1",
                   "w = 0 @2:3\nu=1 v=0 w=0 @1:6\nu=0 v=0 w=0 @1:4\nu=4 v=0 w=0 @2:4\nu=1/4 v=0 w=0 @2:4\n");
    place_clear(&p);
}

/* The point b = i, c = -1, d = -i/3 lies on the surface and on the wall c = b^2, of which it has other equations. */
Test(space, an_irrational_point_of_two_surfaces_is_told_once, PLAIN_ONLY)
{
    place p = place_make();
    char line[500];
    snprintf(line, sizeof line, "%.300s/tests/data/classify/cubic_three.yaml --over b,c,d --degree 2 --option planes=2", p.project);
    expect_special(&p, line, "3*d*b - c^2 + c - b^2 = 0 @2:3\nd = (c^2 - c + b^2)/(3*b), c - b^2 = 0 @1:4\n"
                             "b=b^2 + 1 = 0 (no real value) c=c = b^2 d=d = (c^2 - c + b^2)/(3*b) @2:5 open\n");
    place_clear(&p);
}

/* ---- the command ---- */

Test(space, the_command_says_what_is_not_excluded)
{
    place p = place_make();
    char line[500];
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/henon_heiles.yaml --over A,B,eps --degree 2 --option planes=1 --details --html a.html --tex a.tex", p.project);
    finished f = run_expecting(&p, line, 0);
    cr_expect(strstr(f.out, "1 surface, 1 curve and 0 points"), "%s", f.out);
    cr_expect(strstr(f.out, "All proved for every A and B; for almost all the list is complete up to degree\n    2."), "%s", f.out);
    cr_expect(strstr(f.out, "in 3 planes of constant A, no other pair of rational numbers B, eps"), "%s", f.out);
    cr_expect(strstr(f.out, "for other\n    values of A"), "%s", f.out);
    finished_clear(&f);
    f = run_expecting(&p, "classify a.yaml --over a,b,c,d", 2);
    cr_expect(strstr(f.err, "names more than three parameters"), "%s", f.err);
    finished_clear(&f);
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/henon_heiles.yaml --over A,B,A", p.project);
    f = run_expecting(&p, line, 2);
    cr_expect(strstr(f.err, "names `A` twice"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}
