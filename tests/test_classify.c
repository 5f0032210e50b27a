/* Special values of a parameter: pencils with eigenvalues that are known, lifting, families of the literature (whose files hold no answers), random families with
 * and without planted values, and the command. */
#include <criterion/criterion.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "classify/classify.h"
#include "classify/special_bound.h"
#include "names.h"
#include "program.h"
#include "sweep.h"
#include "commands/classify.h"
#include "commands/verify.h"
#include "graph/dag.h"

/* ---- pencils ---- */

static void put(nh_sparse_pencil *p, size_t row, size_t column, size_t power, nh_residue value)
{
    nh_grow(&p->entry, &p->capacity, p->entries + 1, sizeof *p->entry);
    p->entry[p->entries++] = (nh_sparse_entry){(uint32_t)row, (uint32_t)column, (uint32_t)power, value};
}

enum { blocks = 5, across = 14, down = 17, most_power = 3 };

/* Left times (diagonal: lambda - value, and a row [1 | lambda] and its transpose, which have no elementary divisors) times right, all random. */
static nh_sparse_pencil hidden(nh_prime f, const nh_residue *value, size_t power, uint64_t *random)
{
    nh_residue core[down][across][most_power + 1] = {{{0}}}, left[down][down], right[across][across];
    for (size_t i = 0; i < blocks; i++) {
        core[i][i][power] = 1;
        core[i][i][0] = nh_residue_negative(f, value[i]);
    }
    for (size_t i = 0; i < 2; i++) core[blocks + i][blocks + i][0] = core[blocks + i][blocks + i + 1][1] = 1;        /* 2 x 3 */
    for (size_t j = 0; j < 2; j++) core[blocks + 2 + j][blocks + 3 + j][0] = core[blocks + 3 + j][blocks + 3 + j][1] = 1; /* 3 x 2 */
    core[blocks + 5][blocks + 5][0] = 1;
    for (size_t i = 0; i < down * down; i++) left[i / down][i % down] = nh_residue_random(f, random);
    for (size_t i = 0; i < across * across; i++) right[i / across][i % across] = nh_residue_random(f, random);
    nh_sparse_pencil p = {.rows = down, .columns = across, .degree = power};
    for (size_t i = 0; i < down; i++)
        for (size_t j = 0; j < across; j++)
            for (size_t k = 0; k <= power; k++) {
                nh_residue sum = 0;
                for (size_t a = 0; a < down; a++)
                    for (size_t b = 0; b < across; b++)
                        if (core[a][b][k]) sum = nh_residue_add(f, sum, nh_residue_mul(f, nh_residue_mul(f, left[i][a], right[b][j]), core[a][b][k]));
                put(&p, i, j, k, sum);
            }
    return p;
}

static nh_residue residue_at(nh_prime f, const nh_residue_polynomial *p, nh_residue x)
{
    nh_residue y = 0;
    for (size_t j = p->degree[0] + 1; j-- > 0;) y = nh_residue_add(f, nh_residue_mul(f, y, x), p->coefficient[j]);
    return y;
}

Test(classify, chi_vanishes_where_a_hidden_pencil_loses_rank)
{
    nh_prime f = nh_prime_at(0);
    uint64_t random = 5;
    for (size_t power = 1; power <= 2; power++)
        for (int round = 0; round < 10; round++) {
            nh_residue value[blocks], root;
            for (size_t i = 0; i < blocks; i++) value[i] = nh_residue_random(f, &random);
            value[1] = value[0]; /* a double one */
            nh_sparse_pencil p = hidden(f, value, power, &random);
            nh_residue_polynomial chi;
            double products = 1e12;
            size_t nullity;
            cr_assert(nh_staircase(&p, f, &products, &chi, &nullity));
            cr_assert_eq(chi.degree[0], blocks * power);
            size_t generic = nh_staircase_rank(&p, f, 12345);
            cr_expect_eq(nullity, across - generic);
            for (size_t i = 0; i < blocks; i++) {
                if (power == 2 && !nh_residue_root(f, value[i], 2, &root)) continue;
                if (power == 1) root = value[i];
                cr_expect_eq(residue_at(f, &chi, root), 0);
                cr_expect_lt(nh_staircase_rank(&p, f, root), generic);
            }
            for (int k = 0; k < 20; k++) {
                nh_residue x = nh_residue_random(f, &random);
                cr_expect_neq(residue_at(f, &chi, x), 0);
                cr_expect_eq(nh_staircase_rank(&p, f, x), generic);
            }
            nh_free(chi.coefficient);
            nh_free(p.entry);
        }
}

/* The work is counted: the same limit ends it at the same place on every machine. */
Test(classify, a_staircase_ends_where_its_products_are_used_up)
{
    nh_prime f = nh_prime_at(0);
    uint64_t random = 7;
    nh_residue value[blocks];
    for (size_t i = 0; i < blocks; i++) value[i] = nh_residue_random(f, &random);
    nh_sparse_pencil p = hidden(f, value, 1, &random);
    double all = 1e12, enough, short_of;
    for (int round = 0; round < 3; round++) {
        nh_residue_polynomial chi;
        double left = !round ? all : round == 1 ? enough : short_of;
        size_t nullity;
        cr_expect_eq(nh_staircase(&p, f, &left, &chi, &nullity), round < 2);
        cr_expect(round < 2 ? left >= 0 : left < 0);
        if (!round) enough = all - left, short_of = 0.9 * enough;
        nh_free(chi.coefficient);
    }
    nh_free(p.entry);
}

/* ---- lifting ---- */

Test(classify, polynomials_are_lifted_and_factored)
{
    /* (3 x - 1)(x + 7)(x^2 - 3), monic modulo each prime */
    static const int64_t whole[] = {21, -60, -16, 20, 3};
    nh_prime prime[4];
    nh_residue_polynomial residue[4];
    for (size_t i = 0; i < 4; i++) {
        prime[i] = nh_prime_at(i);
        residue[i] = (nh_residue_polynomial){.degree = {4}, .coefficient = nh_alloc_array(5, sizeof(nh_residue))};
        for (size_t j = 0; j < 5; j++) residue[i].coefficient[j] = nh_residue_mul(prime[i], nh_residue_of(prime[i], whole[j]), nh_residue_inverse(prime[i], 3));
    }
    nh_special_factors f = nh_special_lift(4, prime, residue);
    cr_assert(f.lifted);
    cr_assert_eq(f.factors, 3);
    cr_expect_eq(f.factor[0].coefficient[0], 7);
    cr_expect(f.factor[1].coefficient[1] == 3 && f.factor[1].coefficient[0] == -1);
    cr_expect(f.factor[2].degree[0] == 2 && f.factor[2].coefficient[0] == -3 && f.factor[2].coefficient[2] == 1);
    double root[2];
    cr_assert_eq(nh_special_reals(&f.factor[2], 0, (double[3]){0}, root), 2);
    cr_expect_float_eq(root[1], sqrt(3), 1e-12);
    nh_special_factors_clear(&f);
    residue[3].coefficient[2] ^= 1; /* the last prime does not agree */
    f = nh_special_lift(4, prime, residue);
    cr_expect_not(f.lifted);
    nh_special_factors_clear(&f);
    for (size_t i = 0; i < 4; i++) nh_free(residue[i].coefficient);
}

/* ---- families ---- */

/* A system whose only parameter is the last one of the list; the others get these exact values. */
static nh_system *family_of(const char *path, const char *text, size_t settings, const nh_setting *setting)
{
    nh_error error = {0};
    nh_system *s = path ? nh_system_read(path, settings, setting, &error) : nh_system_parse("family.yaml", text, settings, setting, &error);
    must(s != NULL, &error, path ? path : text);
    cr_assert_eq(s->parameters, 1);
    return s;
}

static nh_classification *classify(nh_system *s, size_t degree, bool shape)
{
    nh_error error = {0};
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    must(o != NULL, &error, "the model");
    nh_classify_question q = {.parameters = 1, .shape = shape, .degree = degree, .work = 1e10, .products = 5e10, .unknowns = 6000, .known = 1, .current = &o->E};
    nh_classification *c = nh_classify(o, &q);
    nh_model_free(o);
    return c;
}

/* "1/3@2 2@2 C0": values with the degrees from which on they are special, degenerate ones behind a C; sorted as they come. */
static void describe(const nh_classification *c, char *out, size_t size)
{
    size_t at = 0;
    out[0] = 0;
    for (size_t k = 0; k < c->specials && at < size; k++) {
        const nh_classify_special *v = &c->special[k];
        if (!v->first && !v->degenerate) continue;
        at += (size_t)snprintf(out + at, size - at, "%s%s", at ? " " : "", v->degenerate ? "C" : "");
        if (v->polynomial.degree[0] == 1 && v->polynomial.coefficient[1] == 1) at += (size_t)snprintf(out + at, size - at, "%lld", (long long)-v->polynomial.coefficient[0]);
        else if (v->polynomial.degree[0] == 1) at += (size_t)snprintf(out + at, size - at, "%lld/%lld", (long long)-v->polynomial.coefficient[0], (long long)v->polynomial.coefficient[1]);
        else
            for (size_t j = v->polynomial.degree[0] + 1; j-- > 0;) at += (size_t)snprintf(out + at, size - at, "%+lld%s", (long long)v->polynomial.coefficient[j], j ? "," : "");
        if (v->first) at += (size_t)snprintf(out + at, size - at, "@%zu", v->first);
    }
}

static void expect_values(nh_system *s, size_t degree, bool shape, const char *expected, const char *name)
{
    char found[1000];
    nh_classification *c = classify(s, degree, shape);
    cr_assert_null(c->obstacle, "%s: %s", name, c->obstacle);
    cr_assert_eq(c->rows, degree, "%s: ended by %s", name, c->end);
    for (size_t d = 0; d < degree; d++) {
        cr_expect(c->row[d].lifted, "%s, degree %zu", name, d + 1);
        cr_expect_geq(c->row[d].height, 100, "%s, degree %zu", name, d + 1);
    }
    describe(c, found, sizeof found);
    cr_expect_str_eq(found, expected, "%s", name);
    nh_classification_free(c);
    nh_system_free(s);
}

static void expect_family(const char *file, size_t settings, const nh_setting *setting, size_t degree, bool shape, const char *expected)
{
    char path[200];
    snprintf(path, sizeof path, "tests/data/classify/%s.yaml", file);
    expect_values(family_of(path, NULL, settings, setting), degree, shape, expected, file);
}

static nh_setting at(const char *name, int64_t top, int64_t bottom) { return (nh_setting){.name = name, .value = (double)top / (double)bottom, .top = top, .bottom = bottom}; }

/* [Hietarinta1987]: the three integrable Henon-Heiles systems. */
Test(classify, henon_heiles, PLAIN_ONLY)
{
    expect_family("henon_heiles", 2, (nh_setting[]){at("A", 1, 1), at("B", 1, 1)}, 4, false, "2@2 1/3@2");
    expect_family("henon_heiles", 2, (nh_setting[]){at("A", 1, 1), at("B", 16, 1)}, 4, false, "2@2 16/3@4");
    expect_family("henon_heiles", 2, (nh_setting[]){at("A", 1, 3), at("B", 16, 3)}, 4, false, "2@2 16/3@4");
    expect_family("henon_heiles", 2, (nh_setting[]){at("A", 1, 1), at("B", 5, 7)}, 4, false, "2@2");
}

Test(classify, quartic_potentials, PLAIN_ONLY)
{
    expect_family("quartic", 1, (nh_setting[]){at("mu", 1, 1)}, 4, false, "2@1 6@2 0@2");
    expect_family("quartic", 1, (nh_setting[]){at("mu", 8, 1)}, 4, false, "0@2 6@4");
    expect_family("quartic", 1, (nh_setting[]){at("mu", 16, 1)}, 4, false, "12@2 0@2");
    expect_family("quartic", 1, (nh_setting[]){at("mu", 5, 1)}, 4, false, "0@2");
}

Test(classify, holt, PLAIN_ONLY) { expect_family("holt", 0, NULL, 6, false, "3/4@3 9/2@4 12@6"); }

/* Frequencies p : q give an integral of degree p + q - 1 or p + q. */
Test(classify, oscillators) { expect_family("oscillators", 0, NULL, 4, false, "1@1 0@1 4@2 1/4@2 9@3 1/9@3 16@4 9/4@4 4/9@4 1/16@4"); }

/* [Tufillaro1986]: the ratio three; at -1 there is no inertia along the thread, at 0 the swinging mass falls freely. */
Test(classify, swinging_atwood) { expect_family("atwood", 0, NULL, 4, false, "C-1 0@1 3@2"); }

/* The sphere has a third of degree one, Kovalevskaya's top a fourth of degree four. */
Test(classify, tops, WHOLE_ONLY)
{
    expect_family("top", 0, NULL, 4, true, "C0 1@1 1/2@4");
}

/* On the level 0 of a momentum, which is a constraint that needs no force: the top of Goryachev and Chaplygin, of degree three.  [BorisovMamaev2005] */
Test(classify, levels_are_constraints, WHOLE_ONLY)
{
    expect_family("top_level", 0, NULL, 3, true, "C0 1@1 1/4@3");
}

Test(classify, constraints)
{
    expect_family("contact", 0, NULL, 2, false, "4@2");
    expect_family("knife", 0, NULL, 2, false, "1@2");
    expect_family("sleigh", 0, NULL, 1, false, "C+1,+0,+2 0@1");
}

/* The list of [AMNS2018] has complex potentials as well: with square roots of -1 and -3, which no prime that is 11 modulo 12 has. */
Test(classify, complex_values_are_counted)
{
    static const struct {
        const char *c, *values;
    } lines[] = {{"5/2", "+9,+0,+49@2"}, {"15/2", "+4,+0,+243@4 +18,+0,+2023@4"}, {"5/3", "+243,+0,+484@4"}, {"1/6", "0@2 +972,+0,+1@4"}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char text[300];
        snprintf(text, sizeof text, "name: cubic\nparameters: {d: 0.3}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^3/3 - %s*x^2*y - d*x^3\n", lines[i].c);
        expect_values(family_of(NULL, text, 0, NULL), 4, false, lines[i].values, lines[i].c);
    }
}

/* A surd in the equations: primes modulo which it does not exist say nothing. */
Test(classify, surds_choose_the_primes, PLAIN_ONLY)
{
    for (int surd = 2; surd < 8; surd++) {
        char text[300];
        snprintf(text, sizeof text, "name: surd\nparameters: {b: 0.3}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt(%d)*(x^4 + b*x^2*y^2 + y^4)\n", surd);
        expect_values(family_of(NULL, text, 0, NULL), 3, false, "2@1 6@2 0@2", text);
    }
}

/* ---- every number ---- */

/* How many degrees leave out no number, with so many primes. */
static size_t theorems(const char *file, size_t settings, const nh_setting *setting, size_t degree, size_t primes)
{
    char path[200];
    nh_error error = {0};
    snprintf(path, sizeof path, "tests/data/classify/%s.yaml", file);
    nh_system *s = family_of(path, NULL, settings, setting);
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    must(o != NULL, &error, "the model");
    nh_classify_question q = {.parameters = 1, .degree = degree, .work = 1e10, .products = 5e10, .unknowns = 6000, .theorem = primes, .known = 1, .current = &o->E};
    nh_classification *c = nh_classify(o, &q);
    size_t count = 0;
    for (size_t d = 0; d < c->rows; d++) {
        count += c->row[d].theorem;
        cr_expect(!c->row[d].theorem || c->row[d].theorem_primes <= primes);
        cr_expect(!c->row[d].theorem || (double)c->row[d].theorem_primes * 31 > c->row[d].bits, "a leading coefficient is below the product");
    }
    nh_classification_free(c);
    nh_model_free(o);
    nh_system_free(s);
    return count;
}

Test(classify, enough_primes_leave_out_no_number, PLAIN_ONLY)
{
    nh_setting one[] = {at("A", 1, 1), at("B", 1, 1)};
    cr_expect_eq(theorems("henon_heiles", 2, one, 4, 150), 4);
    cr_expect_lt(theorems("henon_heiles", 2, one, 4, 60), 4, "too few of them say less");
    cr_expect_eq(theorems("henon_heiles", 2, one, 4, 0), 0);
    cr_expect_eq(theorems("quartic", 1, (nh_setting[]){at("mu", 8, 1)}, 3, 150), 3);
    cr_expect_eq(theorems("toda", 0, NULL, 2, 150), 0, "exponentials have no whole derivatives");
}

/* chi at a point with whole coordinates, lifted: its coefficients are no longer than the bound. */
static void expect_bound(const char *potential, size_t degree, size_t order)
{
    enum { primes = 24 };
    nh_error error = {0};
    char text[400];
    int64_t q0[2] = {1, 2};
    nh_prime prime[primes];
    nh_residue_polynomial chi[primes];
    nh_special_bound bound = {0};
    snprintf(text, sizeof text, "name: f\nparameters: {eps: 0.3}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (%s)\n", potential);
    nh_system *s = family_of(NULL, text, 0, NULL);
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    must(o != NULL, &error, "the model");
    nh_count_question q = {.generic = true, .degree = degree, .work = 1e10};
    nh_parametric family;
    nh_parametric_open(&family, o, 1, (size_t[1]){0}, false, NULL, &q);
    nh_parity parity = degree % 2 ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
    for (size_t i = 0; i < primes; i++) {
        bool regular;
        double products = 1e12;
        nh_sparse_pencil pencil;
        nh_parametric_variable variable[2];
        size_t nullity;
        prime[i] = nh_prime_at(i);
        cr_assert(nh_parametric_choose(&family, prime[i], 5));
        for (size_t k = 0; k < 2; k++) family.counter.equations->at[k] = (nh_residue)q0[k];
        nh_parametric_series *x = nh_parametric_series_create(&family, order, &regular);
        cr_assert(x && nh_parametric_pencil(&family, x, degree, parity, 6000, &pencil, variable));
        cr_assert(nh_staircase(&pencil, prime[i], &products, &chi[i], &nullity));
        nh_parametric_back(&variable[0], 0, prime[i], &chi[i]);
        if (!i) cr_assert(nh_special_bound_find(&family, degree, parity, order, q0, pencil.columns - nullity, &bound));
        nh_free(pencil.entry);
        nh_parametric_series_free(x);
    }
    nh_special_factors f = nh_special_lift(primes, prime, chi);
    cr_assert(f.lifted && f.norm >= 3, "%s: degree %zu, %g", potential, chi[0].degree[0], f.norm);
    cr_expect_leq(log2(f.norm), bound.bits + (double)chi[0].degree[0], "%s", potential);
    cr_expect_leq((double)chi[0].degree[0], bound.degree, "%s", potential);
    nh_special_factors_clear(&f);
    for (size_t i = 0; i < primes; i++) nh_free(chi[i].coefficient);
    nh_parametric_close(&family);
    nh_model_free(o);
    nh_system_free(s);
}

Test(classify, special_values_are_no_longer_than_their_bound)
{
    expect_bound("(x^2 + y^2)/2 + x^2*y + eps*y^3", 2, 4);
    expect_bound("(x^2 + 3*y^2)/2 + x^3 + eps*x*y^2", 2, 4);
    expect_bound("x^4 + (eps + 5)*x^2*y^2 + 7*y^4/3", 2, 4);
}

/* ---- brute force ---- */

/* Families that are classified nowhere else, by a program that shares nothing with this one. */
Test(classify, brute_force_agrees, PLAIN_ONLY)
{
    if (system("/usr/bin/python3 -c 'import numpy' >/dev/null 2>&1")) {
        cr_log_warn("skipped: there is no Python with numpy (Debian: python3-numpy)");
        return;
    }
    cr_expect_eq(system("/usr/bin/python3 tests/brute_force.py --few >/dev/null"), 0);
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

static nh_system *random_family(const char *potential)
{
    nh_text text;
    nh_text_init(&text);
    nh_text_addf(&text, "name: random\nparameters: {eps: 0.37}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (%s)\n", potential);
    nh_system *s = family_of(NULL, nh_text_string(&text), 0, NULL);
    nh_text_clear(&text);
    return s;
}

Test(classify, nothing_is_found_where_there_is_nothing, PLAIN_ONLY)
{
    uint64_t random = 20;
    for (int round = 0; round < 10; round++) {
        nh_text text;
        nh_text_init(&text);
        put_potential(&text, &random);
        nh_text_add(&text, " + eps*");
        put_potential(&text, &random);
        expect_values(random_family(nh_text_string(&text)), 3, false, "", nh_text_string(&text));
        nh_text_clear(&text);
    }
}

/* Separable in turned coordinates where the factor vanishes: at a rational value, or at two irrational ones. */
Test(classify, planted_values_are_found, PLAIN_ONLY)
{
    uint64_t random = 33;
    for (int round = 0; round < 10; round++) {
        nh_text text;
        char expected[60];
        int a = 1 + round % 4, top = 2 * small(&random) + 1, bottom = round % 2 ? 2 : 1, square = (int[]){2, 3, 5, 6, 7}[round % 5];
        nh_text_init(&text);
        nh_text_addf(&text, "(%d*x + y)^4 + %d*(%d*x + y)^2 + (x - %d*y)^3 + %d*(x - %d*y)^2 + ", a, round + 2, a, a, 3 * round + 1, a);
        if (round < 6) nh_text_addf(&text, "(%d*eps - (%d))*", bottom, top);
        else nh_text_addf(&text, "(eps^2 - %d)*", square);
        put_potential(&text, &random);
        if (round >= 6) snprintf(expected, sizeof expected, "+1,+0,%d@2", -square);
        else snprintf(expected, sizeof expected, bottom == 1 ? "%d@2" : "%d/%d@2", top, bottom);
        expect_values(random_family(nh_text_string(&text)), 3, false, expected, nh_text_string(&text));
        nh_text_clear(&text);
    }
}

/* ---- what cannot be done ---- */

static void expect_obstacle(const char *text, const char *words)
{
    nh_system *s = family_of(NULL, text, 0, NULL);
    nh_classification *c = classify(s, 2, false);
    cr_assert_not_null(c->obstacle, "%s", text);
    cr_expect(strstr(c->obstacle, words), "%s", c->obstacle);
    nh_classification_free(c);
    nh_system_free(s);
}

Test(classify, obstacles_are_named)
{
    expect_obstacle("name: a\nparameters: {k: 0.4}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - exp(k*x)*y\n", "inside of a function");
    expect_obstacle("name: a\nparameters: {k: 0.4}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt(k + x^2)*y\n", "inside of a function");
    expect_obstacle("name: a\nparameters: {k: 0.4}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^2*y\n", "do not depend");
    expect_obstacle("name: a\nparameters: {k: 0.4}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^k*y\ndomain: {x: [0.5, 2]}\n", "");
    expect_obstacle("name: a\nparameters: {k: 0.4}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [z' = k*y*x']\n", "constraints depend");
}

/* A metric whose determinant vanishes at values that depend on the point: these are not special. */
Test(classify, metrics_may_depend_on_the_parameter, PLAIN_ONLY)
{
    static const char text[] = "name: a\nparameters: {m: 0.4}\ncoordinates: [x, y]\nlagrangian: ((1 + m*x^2)*x'^2 + y'^2 + m*x*y*x'*y')/2 - y\n";
    nh_classification *c;
    nh_system *s = family_of(NULL, text, 0, NULL);
    char found[200];
    c = classify(s, 2, false);
    describe(c, found, sizeof found);
    cr_expect_str_eq(found, "0@1");
    nh_classification_free(c);
    nh_system_free(s);
}

/* Another parameter for the same family: mu = 1/b gives reciprocal values, 0 and infinity changed. */
Test(classify, values_follow_the_parameter)
{
    nh_system *s = family_of(NULL, "name: a\nparameters: {mu: 0.4}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - x^2*y^2/mu - y^4\n", 0, NULL);
    nh_error error = {0};
    nh_model *o = nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error);
    nh_classify_question q = {.parameters = 1, .degree = 2, .work = 1e10, .products = 5e10, .unknowns = 6000, .known = 1, .current = &o->E};
    nh_classification *c = nh_classify(o, &q);
    char found[200];
    describe(c, found, sizeof found);
    cr_expect_str_eq(found, "C0 1/2@1 1/6@2");
    cr_expect(c->limit, "b = 0");
    cr_expect_eq(c->row[1].number.bound, 2);
    cr_expect_eq(c->row[1].infinite.bound, 3);
    nh_classification_free(c);
    nh_model_free(o);
    nh_system_free(s);
}

/* ---- the command ---- */

static cJSON *classified(place *p, const char *words)
{
    char line[500];
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/%.100s --quiet --json -", p->project, words);
    finished f = run(p, line);
    cr_assert_eq(f.code, 0, "%s: %s", line, f.err);
    cJSON *root = cJSON_Parse(f.out);
    cr_assert_not_null(root, "%s", line);
    finished_clear(&f);
    return root;
}

static const char *text_of(const cJSON *object, const char *key) { return cJSON_GetStringValue(cJSON_GetObjectItem(object, key)); }

Test(classify, the_command_constructs_and_proves)
{
    place p = place_make();
    cJSON *root = classified(&p, "henon_heiles.yaml --over eps --set B=16"), *values = cJSON_GetObjectItem(root, "special"), *value;
    cr_assert_eq(cJSON_GetArraySize(values), 2);
    cJSON_ArrayForEach(value, values)
    {
        cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(value, "proved")), "%s", text_of(cJSON_GetObjectItem(value, "where"), "eps"));
        cr_expect_eq(cJSON_GetArraySize(cJSON_GetObjectItem(value, "currents")), 2);
    }
    cr_expect_str_eq(text_of(cJSON_GetObjectItem(cJSON_GetArrayItem(values, 0), "where"), "eps"), "2");
    cr_expect_str_eq(text_of(cJSON_GetObjectItem(cJSON_GetArrayItem(values, 1), "where"), "eps"), "16/3");
    cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(root, "nowhere_else")));
    cr_expect_eq(cJSON_GetNumberValue(cJSON_GetObjectItem(root, "generic")), 3);
    cJSON_Delete(root);
    place_clear(&p);
}

/* Other parameters may be ratios that are no decimals, too; the parameter is not the first of those that are left. */
Test(classify, other_parameters_are_exact, PLAIN_ONLY)
{
    nh_setting settings[] = {at("A", 1, 3), at("B", 16, 3)};
    nh_error error = {0};
    nh_classify_request q = {.system_path = "tests/data/classify/henon_heiles.yaml", .settings = 2, .setting = settings, .over = {"eps"}};
    nh_options_default(&q.options);
    nh_classified *x = nh_classify_system(&q, &error);
    must(x != NULL, &error, "classification");
    char found[200];
    describe(x->classification, found, sizeof found);
    cr_expect_str_eq(found, "2@2 16/3@4");
    cr_expect_eq(x->part[1].finding.complete, 4);
    nh_classified_free(x);
    nh_setting one = at("B", 1, 1);
    q.settings = 1, q.setting = &one;
    x = nh_classify_system(&q, &error);
    must(x != NULL, &error, "classification");
    describe(x->classification, found, sizeof found);
    cr_expect_str_eq(found, "2@2 1/3@2");
    nh_classified_free(x);
}

/* The currents of the value 16/3, which is no decimal, hold: refuted for another value, confirmed at this one. */
Test(classify, exact_ratios_stand_for_parameters)
{
    nh_setting third = at("eps", 1, 3);
    nh_error error = {0};
    nh_system *s = nh_system_read("tests/data/classify/henon_heiles.yaml", 1, &third, &error);
    must(s != NULL, &error, "the system");
    cr_assert_eq(s->parameters, 2);
    cr_assert_eq(s->definitions, 1);
    cr_expect_eq(s->definition[0].value, nh_ratio(s->dag, 1, 3));
    nh_options options;
    nh_options_default(&options);
    nh_verification *v = nh_verification_of_current(s, NH_CHART_AUTO, "x'*y' + x*(x^2 + 3*y*(y + 1))/3", &options, &error);
    must(v != NULL, &error, "the current");
    cr_expect(v->conserved && v->proof.proved);
    nh_verification_free(v);
}

/* z'/w has no value at w = 0, nor sqrt(B^2 - 2*w^2) at w = B = 4: a current that the file knows is left out there, and the system is read. */
Test(classify, currents_without_a_value_there_are_left_out)
{
    static const struct { int64_t w; size_t left; } rows[] = {{1, 6}, {0, 5}, {4, 4}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        nh_setting exact[] = {at("w", rows[i].w, 1), at("B", 4, 1)};
        nh_error error = {0};
        nh_system *s = nh_system_read("systems/penning_trap.yaml", 2, exact, &error);
        must(s != NULL, &error, "the system");
        cr_expect_eq(s->currents, rows[i].left, "w = %lld: %zu", (long long)rows[i].w, s->currents);
        cr_expect_eq(error.what[0], '\0');
        cr_expect_str_eq(s->current[0].name, "energy");
        nh_system_free(s);
    }
}

/* Only a missing value is forgiven: a mistyped current is refused there, too. */
Test(classify, mistyped_currents_are_refused_at_exact_values)
{
    static const char file[] = "name: one\ncoordinates: [x]\nparameters: {m: 1, w: 1}\nlagrangian: \"m/2*x'^2\"\n"
                               "known: {currents: [{name: p, expr: \"x' %s\"}]}\n";
    static const struct { const char *rest, *what; } rows[] = {
        {"+ 1/w", NULL}, {"+ sqrt(w - 1)", NULL}, {"+ log(w)", NULL}, {"+ w^(-1/2)", NULL},
        {"+ nothing/m", "unknown name `nothing`"}, {"+ (m", "the expression ends here"}, {"+ sin(m, w)", "`sin` takes one argument"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[sizeof file + 40];
        nh_setting exact[] = {at("w", 0, 1)};
        nh_error error = {0};
        snprintf(text, sizeof text, file, rows[i].rest);
        nh_system *s = nh_system_parse("one.yaml", text, 1, exact, &error);
        if (rows[i].what) cr_expect(!s && strstr(error.what, rows[i].what), "%s: `%s`", rows[i].rest, error.what);
        else cr_expect(s && s->currents == 0 && !error.what[0], "%s: `%s`", rows[i].rest, error.what);
        nh_system_free(s);
    }
}

Test(classify, the_command_refuses)
{
    static const struct {
        const char *line, *words;
    } lines[] = {{"classify henon_heiles_sk", "over which parameter"}, {"classify henon_heiles_sk --over B", "not a parameter"}, {"classify --over A", "over which parameter"}, {"classify henon_heiles_sk --over eps,,B", "nothing stands between two commas"}, {"classify henon_heiles_sk --over a,b,c,d", "more than three"},
                 {"classify toda_lattice --over x --svg a.svg", "does not take --svg"}};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        finished f = run(&p, lines[i].line);
        cr_expect_eq(f.code, 2, "%s: %d", lines[i].line, f.code);
        cr_expect(strstr(f.err, lines[i].words), "%s: %s", lines[i].line, f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

/* A double is written with the digits that it needs. */
Test(classify, numbers_have_their_shortest_digits)
{
    place p = place_make();
    char path[PATH_MAX + 30];
    snprintf(path, sizeof path, "%s/a.yaml", p.folder);
    FILE *file = fopen(path, "w");
    cr_assert_not_null(file);
    fprintf(file, "name: a\nparameters: {M: 1.989e30, k: 0.1234567890123, b: 1}\ncoordinates: [x, y]\n"
            "lagrangian: M*(x'^2 + y'^2)/2 - M*(x^2 + b*y^2)/2 - k*x^2*y\n");
    fclose(file);
    finished f = run_expecting(&p, "classify a.yaml --over b", 2);
    cr_expect(strstr(f.err, "the value 1.989e+30 of `M` has too many digits"), "%s", f.err);
    finished_clear(&f);
    f = run_expecting(&p, "classify a.yaml --over b --set M=1e-7 --degree 1 --details", 0);
    cr_expect(strstr(f.out, "= 0.1234567890123."), "%s", f.out);
    cr_expect(strstr(f.out, "M = 1e-07") || strstr(f.out, "M = 1e-7"), "%s", f.out);
    cr_expect(!strstr(f.out, "b = "), "it is classified, and has no value:\n%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* Equations that are defined piece by piece are classified on the sides on which the domain lies. */
Test(classify, one_side_of_a_kink)
{
    place p = place_make();
    write_here(&p, "a.yaml", "name: a\nparameters: {a: 3}\ncoordinates: [x, y]\ndomain: {x: [0.5, 1], y: [-1, -0.5]}\n"
               "lagrangian: (x'^2 + y'^2)/2 - x^2*abs(y) - a*abs(y)^3 - abs(x)*x^2*0.3 + 0.3*x^3\n");
    finished f = run_expecting(&p, "classify a.yaml --over a --degree 2 --details", 0);
    cr_expect(strstr(f.out, "over a, for y < 0 and x >"), "%s", f.out);
    cr_expect(strstr(f.out, "\na = 2\n") && strstr(f.out, "\na = 1/3\n") && strstr(f.out, "\n2 values of a"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

static const char skate[] =
    "name: a\nparameters: {m: 1, I: 0.5, a: 0.3}\ncoordinates: [x, y, {name: h, type: angle}]\n"
    "lagrangian: m/2*((x' - a*h'*sin(h))^2 + (y' + a*h'*cos(h))^2) + I/2*h'^2\nconstraints: [\"y'*cos(h) = x'*sin(h)\"]\n";

/* Without its mass the skate keeps equations of motion in the limit, but has none of its own. */
Test(classify, a_value_without_inertia_is_degenerate, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "a.yaml", skate);
    finished f = run_expecting(&p, "classify a.yaml --over m --degree 1", 0);
    cr_expect(strstr(f.out, "Degenerate: m = 0 (the Lagrangian is singular"), "%s", f.out);
    cr_expect_not(strstr(f.out, "\nm = 0\n"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* Nor on a curve of two parameters; without moment of inertia it moves like a point. */
Test(classify, a_curve_without_inertia_is_degenerate, WHOLE_ONLY)
{
    place p = place_make();
    write_here(&p, "a.yaml", skate);
    finished f = run_expecting(&p, "classify a.yaml --over m,I --degree 1", 0);
    cr_expect(strstr(f.out, "Degenerate, and not examined: 100*I + 9*m = 0; m = 0."), "%s", f.out);
    cr_expect(strstr(f.out, "\nI = 0\n") && strstr(f.out, "1 curve and 0 points"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* The family depends on time and the system at the value does not: it has as many with coefficients in t, x' and
 * t x' - x among them, and fewer without. */
Test(classify, coefficients_in_time_at_a_value_without_time, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "a.yaml", "name: a\nparameters: {k: 0.6}\ncoordinates: [x, y]\n"
               "lagrangian: (x'^2 + y'^2)/2 - k/2*((x^2 - y^2)*cos(1.4*t) + 2*x*y*sin(1.4*t))\n");
    finished f = run_expecting(&p, "classify a.yaml --over k --degree 1 --details", 0);
    cr_expect(strstr(f.out, "\nk = 0\n  degree 1: 6 instead of 5."), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* The analysis at a value has the last word: its lower bounds, and its currents where the count leaves the value open. */
Test(classify, the_analysis_at_a_value_decides, WHOLE_ONLY)
{
    place p = place_make();
    write_here(&p, "a.yaml", "name: a\nparameters: {g: 1}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - g*y\nconstraints: [\"z' = y*x'\"]\n");
    finished f = run_expecting(&p, "classify a.yaml --over g --details", 0);
    cr_expect(strstr(f.out, "\ng = 0\n  degree 1: 5 instead of 2, degree 2: 15 instead of 4, degree 3: 35 instead of\n    6, degree 4: 70 instead of 9.\n"), "%s", f.out);
    cr_expect_not(strstr(f.out, "Not decided"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* What stays open names the option, and more of it decides. */
Test(classify, an_open_value_names_the_option_that_decides_it)
{
    place p = place_make();
    char line[500];
    const char *text = "classify %.300s/tests/data/classify/henon_heiles.yaml --over eps --set B=1 --degree 2 --option count_work=%s";
    snprintf(line, sizeof line, text, p.project, "5e4");
    finished f = run_expecting(&p, line, 0);
    cr_expect(strstr(f.out, "No value of eps has "), "%s", f.out);
    cr_expect(strstr(f.out, "Not decided at eps = 1/3: degree 2"), "%s", f.out);
    cr_expect(strstr(f.out, "`--option count_work=N`"), "%s", f.out);
    finished_clear(&f);
    snprintf(line, sizeof line, text, p.project, "1e6");
    f = run_expecting(&p, line, 0);
    cr_expect(strstr(f.out, "2 values of eps"), "%s", f.out);
    cr_expect_not(strstr(f.out, "Not decided"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* With sines: separable where the coupling is without the product of both cosines, and nowhere else. */
Test(classify, no_number_is_left_out_with_sines)
{
    static const char *const lagrangian[] = {
        "(x'^2 + y'^2)/2 - cos(x) - cos(y) - (a - 1/2)*cos(x)*cos(y)",
        "(x'^2 + sin(x)^2*y'^2)/2 - cos(x) - (2*a - 1)*cos(x)^2*sin(y)",
    };
    place p = place_make();
    char path[PATH_MAX + 30];
    snprintf(path, sizeof path, "%s/a.yaml", p.folder);
    for (size_t i = 0; i < sizeof lagrangian / sizeof *lagrangian; i++) {
        FILE *file = fopen(path, "w");
        cr_assert_not_null(file);
        fprintf(file, "name: a\nparameters: {a: 0.7}\ncoordinates: [x, y]\nlagrangian: %s\n", lagrangian[i]);
        fclose(file);
        finished f = run_expecting(&p, "classify a.yaml --over a --degree 2 --details", 0);
        cr_expect(strstr(f.out, "1 value of a"), "%s", f.out);
        cr_expect(strstr(f.out, "a = 1/2"), "%s", f.out);
        cr_expect(strstr(f.out, "degree 2: no other a has more than 2 (proved for all numbers"), "%s", f.out);
        finished_clear(&f);
    }
    place_clear(&p);
}
