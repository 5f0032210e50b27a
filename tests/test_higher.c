/* Logarithms of higher variational equations: what is excluded, and what must stay open; the order by other primes and by jets that are
 * continued in floating numbers, the multipliers by integration over periods. */

#include "absence_cases.h"

#include "absence/higher_internal.h"
#include "document/absence_words.h"

#include "absence.h"
#include "sweep.h"

#include <complex.h>

/* ---- Henon and Heiles's potentials ---- */

/* V = (x^2 + B y^2)/2 + x^2 y + eps y^3, along x = 0.  order: of the logarithm; n: -1 where the exponents are not whole. */
typedef struct {
    const char *name, *B, *eps;
    double b, e;
    int n, order;
    nh_higher_connected connected;
} family;

static const family FAMILY[] = {
    {"(2, 1/3)", "2", "1/3", 2, 1 / 3., 3, 3, NH_HIGHER_MULTIPLIER},
    {"(1/4, 1/3)", "1/4", "1/3", 0.25, 1 / 3., 3, 3, NH_HIGHER_MULTIPLIER},
    {"(1, 2/3)", "1", "2/3", 1, 2 / 3., 2, 3, NH_HIGHER_SOLUTION},
    {"(4, 2/3)", "4", "2/3", 4, 2 / 3., 2, 3, NH_HIGHER_MULTIPLIER},
    {"(1, 1/5)", "1", "1/5", 1, 0.2, 4, 3, NH_HIGHER_MULTIPLIER},
    {"(5, 2/15)", "5", "2/15", 5, 2 / 15., 5, 3, NH_HIGHER_MULTIPLIER},
    {"KdV (1, 2)", "1", "2", 1, 2, 1, 0, NH_HIGHER_UNKNOWN},
    {"KdV (7/3, 2)", "7/3", "2", 7 / 3., 2, 1, 0, NH_HIGHER_UNKNOWN},
    {"Sawada-Kotera (1, 1/3)", "1", "1/3", 1, 1 / 3., 3, 0, NH_HIGHER_UNKNOWN},
    {"Kaup-Kupershmidt (16, 16/3)", "16", "16/3", 16, 16 / 3., -1, 0, NH_HIGHER_UNKNOWN},
    {"classical (1, -1/3)", "1", "-1/3", 1, -1 / 3., -1, 0, NH_HIGHER_UNKNOWN},
};
enum { FAMILIES = sizeof FAMILY / sizeof *FAMILY };

#define PLANE(V) "name: p\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (" V ")\n"

static absence_case case_of(const family *f)
{
    char text[400];
    snprintf(text, sizeof text, PLANE("(x^2 + (%s)*y^2)/2 + x^2*y + (%s)*y^3"), f->B, f->eps);
    return absence_case_text(text);
}

static void judge(const family *f, const nh_higher *h)
{
    cr_expect_eq(h->applies, f->n >= 0, "%s: %s", f->name, h->obstacle);
    cr_expect_eq(h->refuted, f->order > 0, "%s: %s", f->name, h->obstacle);
    cr_expect_eq(h->order, (unsigned)f->order, "%s: order %u", f->name, h->order);
    cr_expect_eq(h->connected, f->connected, "%s", f->name);
    cr_expect_eq(h->prime != 0, f->order > 0);
    if (f->n >= 0) cr_expect_eq(h->exponent, f->n, "%s", f->name);
    cr_expect_eq(h->obstacle == NULL, h->refuted, "%s", f->name);
    if (f->connected == NH_HIGHER_MULTIPLIER) cr_expect_gt(strtod(h->multiplier, NULL), 1.1, "%s: %s", f->name, h->multiplier);
}

Test(higher, what_is_excluded_and_what_stays_open)
{
    for (size_t i = 0; i < FAMILIES; i++) {
        absence_case c = case_of(&FAMILY[i]);
        nh_normal_equation *e = equation_of(&c, "x = 0");
        nh_higher *h = nh_higher_of(c.arena, c.shape, e, true);
        judge(&FAMILY[i], h);
        if (!strcmp(FAMILY[i].name, "(1, 2/3)")) cr_expect_str_eq(h->solution, "y");
        nh_normal_equation_clear(e);
        absence_case_clear(&c);
    }
}

/* ---- the scope ---- */

static void refuses(const char *text, const char *plane, const char *words)
{
    absence_case c = absence_case_text(text);
    nh_normal_equation *e = equation_of(&c, plane);
    nh_higher *h = nh_higher_of(c.arena, c.shape, e, true);
    cr_expect(!h->applies && !h->refuted, "%s", text);
    cr_expect_not_null(strstr(h->obstacle, words), "%s: %s", text, h->obstacle);
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

Test(higher, scope)
{
    refuses(PLANE("x^4 + 6*x^2*y^2 + y^4"), "x = 0", "genus 1 with one point");                             /* two points at infinity */
    refuses(PLANE("(x^2 + y^2)/2 + x^2*y^2 + y^3/3"), "x = 0", "irregular");                                /* x'' = -(1 + 2 y^2) x */
    refuses(PLANE("(x^2 + y^2)/2 + x^2*y/2 + 1/5*y^3"), "x = 0", "not whole");                              /* 5/2: n (n + 1) is 10/3 */
    refuses(PLANE("(x^2 + y^2)/2 + x^2*y"), "x = 0", "genus 1");                                            /* y is a sine */
    refuses("name: z\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - ((x^2 + 2*y^2)/2 + x^2*y + y^3/3)\n"
            "constraints: [\"z' = x*y'\"]\n", "x = 0", "constraints");
    refuses("name: d\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - ((x^2 + 2*y^2)/2 + x^2*y + y^3/3)\nforces: {x: -x^3}\n", "x = 0",
            "forces");
    refuses("name: m\ncoordinates: [x, y]\nlagrangian: ((1 + x^2)*x'^2 + y'^2)/2 - ((x^2 + 2*y^2)/2 + x^2*y + y^3/3)\n", "x = 0",
            "inertia");
    refuses("name: s\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - ((x^2 + 2*y^2 + z^2)/2 + (x^2 + z^2)*y + y^3/3)\n",
            "x = 0, z = 0", "two coupled");
}

/* (B, eps) in other letters: planes q = p and p = 0 with an inertia that couples their letters; and planes of potentials that separate. */
Test(higher, linear_changes)
{
#define TURNED(B, EPS) "name: l\ncoordinates: [p, q]\nlagrangian: ((p' - q')^2 + (p' + q')^2)/2 - " \
    "(((p - q)^2 + (" B ")*(p + q)^2)/2 + (p - q)^2*(p + q) + (" EPS ")*(p + q)^3)\n"
#define SHEARED(B, EPS) "name: l\ncoordinates: [p, q]\nlagrangian: (p'^2 + (q' + p')^2)/2 - " \
    "((p^2 + (" B ")*(q + p)^2)/2 + p^2*(q + p) + (" EPS ")*(q + p)^3)\n"
    static const struct {
        const char *text, *plane;
        unsigned order;
    } row[] = {{TURNED("2", "1/3"), "q = p", 3},
               {SHEARED("2", "1/3"), "p = 0", 3},
               {SHEARED("1", "1/5"), "p = 0", 3},
               {TURNED("1", "2"), "q = p", 0},
               {SHEARED("7/3", "2"), "p = 0", 0},
               {SHEARED("1", "1/3"), "p = 0", 0},
               {PLANE("(x^2 + y^2)/2 + x^2*y + y^3/3"), "y = x", 0},
               {PLANE("(x^2 + y^2)/2 + x^2*y + y^3/3"), "y = -x", 0},
               {PLANE("x^2 + x^3 + y^3"), "y = 0", 0}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        absence_case c = absence_case_text(row[i].text);
        nh_normal_equation *e = equation_of(&c, row[i].plane);
        nh_higher *h = nh_higher_of(c.arena, c.shape, e, true);
        cr_expect(h->applies, "%s: %s", row[i].text, h->obstacle);
        cr_expect_eq(h->refuted, row[i].order > 0, "%s: %s", row[i].text, h->obstacle);
        cr_expect_eq(h->order, row[i].order, "%s: order %u", row[i].text, h->order);
        nh_normal_equation_clear(e);
        absence_case_clear(&c);
    }
}

/* Integrable potentials (see A. P. Fordy 1991, and two oscillators that separate) with x = a p, y = c p + d q + s: all planes, three
 * levels. */
static void stays_open(const char *potential, int a, int c, int d, int s, size_t *tried)
{
    char text[1000], x[32], y[64], V[600] = "";
    snprintf(x, sizeof x, "(%d*p)", a);
    snprintf(y, sizeof y, "(%d*p + %d*q + %d)", c, d, s);
    for (const char *at = potential; *at; at++) {
        char letter[2] = {*at, 0};
        strcat(V, *at == 'x' ? x : *at == 'y' ? y : letter);
    }
    snprintf(text, sizeof text, "name: i\ncoordinates: [p, q]\nlagrangian: ((%d*p')^2 + (%d*p' + %d*q')^2)/2 - (%s)\n", a, c, d, V);
    absence_case k = absence_case_text(text);
    nh_ex energy = k.of.model->E;
    bool generic = true;
    nh_known_integrals known = {1, &energy, &generic, 0};
    for (size_t i = 0; i < k.planes; i++)
        for (size_t n = 0; n < 3; n++) {
            nh_normal_equation *e = nh_normal_equation_of(k.arena, k.shape, &k.plane[i], &known, n);
            if (e->obstacle) continue;
            nh_higher *h = nh_higher_of(k.arena, k.shape, e, true);
            *tried += h->applies;
            cr_expect(!h->refuted && !h->order, "%s, %s", text, k.plane[i].words);
            nh_normal_equation_clear(e);
        }
    absence_case_clear(&k);
}

Test(higher, integrable_potentials_stay_open)
{
    static const char *const potential[] = {"(x^2 + y^2)/2 + x^2*y + 2*y^3", "(7*x^2 - 3*y^2)/2 + x^2*y + 2*y^3", "x^2*y + 2*y^3 - y/3",
                                            "(x^2 + y^2)/2 + x^2*y + y^3/3", "x^2*y + y^3/3 + 2*y",           "(3*x^2 + 3*y^2)/2 - 2*x^2*y - 2/3*y^3",
                                            "(x^2 + 16*y^2)/2 + x^2*y + 16/3*y^3", "x^2 + x^3 + y^3 + 2*y^2",  "x^4 + 3*x^2 + y^3 - y",
                                            "x^2/2 + y^3 + y^2"};
    size_t tried = 0, at = 0;
    for (size_t i = 0; i < sizeof potential / sizeof *potential; i++)
        for (int a = 1; a <= 2; a++)
            for (int c = -1; c <= 2; c++)
                for (int d = 1; d <= 2; d++)
                    if (sweep_tries(at++, 5, 9)) stays_open(potential[i], a, c, d, a - d, &tried);
    cr_expect_gt(tried, 40, "%zu", tried);
}

/* The exponent is the same for all B, and not for all eps; an exact solution exists at single values. */
Test(higher, parameters)
{
    static const struct {
        const char *text;
        bool generic;
    } row[] = {{"parameters: {B: 2}\nlagrangian: (x'^2 + y'^2)/2 - ((x^2 + B*y^2)/2 + x^2*y + y^3/3)\n", true},
               {"parameters: {eps: 1/3}\nlagrangian: (x'^2 + y'^2)/2 - ((x^2 + 2*y^2)/2 + x^2*y + eps*y^3)\n", false},
               {"parameters: {B: 1}\nlagrangian: (x'^2 + y'^2)/2 - ((x^2 + B*y^2)/2 + x^2*y + 2/3*y^3)\n", false},
               {"parameters: {a: 0}\nlagrangian: (x'^2 + y'^2)/2 - ((x^2 + 2*y^2)/2 + x^2*y + y^3/3 + a*y^4)\n", false},
               {"parameters: {k: 1}\nlagrangian: (x'^2 + y'^2)/2 - ((x^2 + 2*y^2)/2 + k*(x^2*y + y^3/3))\n", true}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        char text[400];
        snprintf(text, sizeof text, "name: g\ncoordinates: [x, y]\n%s", row[i].text);
        absence_case c = absence_case_text(text);
        nh_normal_equation *e = equation_of(&c, "x = 0");
        nh_higher *h = nh_higher_of(c.arena, c.shape, e, true);
        cr_expect(h->refuted, "%s: %s", row[i].text, h->obstacle);
        cr_expect_eq(h->generic, row[i].generic, "%s", row[i].text);
        nh_normal_equation_clear(e);
        absence_case_clear(&c);
    }
}

/* n = 20 takes 128 bits, and is not tried where little may be spent. */
Test(higher, what_costs_little)
{
    absence_case c = absence_case_text(PLANE("x^2/2 + y^2 + x^2*y + 2/210*y^3"));
    nh_normal_equation *e = equation_of(&c, "x = 0");
    nh_higher *h = nh_higher_of(c.arena, c.shape, e, true);
    cr_expect(h->refuted && h->exponent == 20 && h->bits == 128, "%s", h->obstacle);
    h = nh_higher_of(c.arena, c.shape, e, false);
    cr_expect(h->applies && !h->refuted && !h->order);
    cr_expect_not_null(strstr(h->obstacle, "--absence"));
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

/* ---- the whole answer ---- */

Test(higher, answer)
{
    nh_error error = {0};
    for (int everything = 0; everything < 2; everything++) {
        nh_analysis *r = absence_of_text(PLANE("(x^2 + 2*y^2)/2 + x^2*y + y^3/3"), &error);
        cr_assert(r, "%s", error.what);
        nh_absence_find(r, everything);
        const nh_absence *a = r->absence;
        const char *words = nh_absence_words_sentence(r);
        cr_expect_eq(a->verdict, NH_ABSENCE_NONE_ELSE, "%s", a->obstacle);
        cr_expect_eq(a->at_most, 1);
        cr_expect(!a->rational && !a->contradiction && !a->obstacle);
        cr_expect_not_null(strstr(words, "the variational equation of order 3 along them has a logarithm"), "%s", words);
        cr_expect_not_null(strstr(words, "meromorphic near the complex motions x = 0 of energy 1/7 is a function of those found"), "%s", words);
        nh_analysis_free(r);
    }
}

/* A logarithm at order 3, and a group of first order that is {1, -1}; it is integrable. */
Test(higher, a_square_root_proves_nothing)
{
    nh_error error = {0};
    nh_analysis *r = absence_of_text("name: c\ncoordinates: [u, x, y]\nlagrangian: u'^2/2 + 2*u^3 - 4*u\n"
                                     "constraints: [\"x' = x*u'/(2*(u - 1))\", \"y' = x^3\"]\ndependent: [x, y]\n"
                                     "domain: {u: [1.5, 2.5], x: [0.5, 1]}\n", &error);
    cr_assert(r, "%s", error.what);
    cr_expect_eq(r->absence->verdict, NH_ABSENCE_SETTLED);
    cr_expect_null(r->absence->contradiction);
    for (size_t i = 0; i < r->absence->attempts; i++) cr_expect_null(r->absence->attempt[i].higher);
    nh_analysis_free(r);
}

/* ---- other primes ---- */

static void put(nh_higher_polynomial *p, unsigned char u, unsigned char z, const char *factor, const char *value)
{
    fmpq *at = p->coefficient + p->count;
    fmpq_t other;
    fmpq_init(at);
    fmpq_init(other);
    fmpq_set_str(at, value, 10);
    fmpq_set_str(other, factor, 10);
    fmpq_mul(at, at, other);
    fmpq_clear(other);
    p->u[p->count] = u;
    p->z[p->count++] = z;
}

static void room(nh_higher_polynomial *p)
{
    enum { terms = 8 };
    p->coefficient = nh_alloc_array(terms, sizeof *p->coefficient);
    p->u = nh_alloc_array(terms, 1);
    p->z = nh_alloc_array(terms, 1);
}

/* At the level 1/7, written down by hand. */
static nh_higher_system system_of(const family *f)
{
    nh_higher_system s, only;
    nh_higher_system_init(&s);
    nh_higher_system_init(&only);
    for (int d = 0; d < NH_HIGHER_DIRECTIONS; d++) room(&s.rate[d]);
    put(&s.rate[NH_HIGHER_ALONG], 1, 0, "-1", f->B);
    put(&s.rate[NH_HIGHER_ALONG], 2, 0, "-3", f->eps);
    put(&s.rate[NH_HIGHER_ALONG], 0, 2, "-1", "1");
    put(&s.rate[NH_HIGHER_ACROSS], 0, 1, "-1", "1");
    put(&s.rate[NH_HIGHER_ACROSS], 1, 1, "-2", "1");
    room(&only.rate[0]);
    put(&only.rate[0], 0, 0, "2", "1/7");
    put(&only.rate[0], 2, 0, "-1", f->B);
    put(&only.rate[0], 3, 0, "-2", f->eps);
    const char *why = nh_higher_system_complete(&s, &only.rate[0]);
    cr_expect_eq(why == NULL, f->n >= 0, "%s: %s", f->name, why);
    nh_higher_system_clear(&only);
    return s;
}

Test(higher, other_primes)
{
    static const ulong prime[] = {1073741827, 2147483647, 1000003, 4611686018427387847u};
    for (size_t i = 0; i < FAMILIES; i++) {
        if (FAMILY[i].n < 0) continue;
        nh_higher_system s = system_of(&FAMILY[i]);
        for (size_t k = 0; k < sizeof prime / sizeof *prime; k++) {
            nh_higher_logarithm found;
            cr_assert(nh_higher_logarithm_find(&s, prime[k], NH_HIGHER_ORDERS, &found));
            cr_expect_eq(found.order, (unsigned)FAMILY[i].order, "%s modulo %lu: order %u", FAMILY[i].name, prime[k], found.order);
            if (found.order) cr_expect(found.across && found.power == -FAMILY[i].n, "%s: t^%ld", FAMILY[i].name, found.power);
        }
        nh_higher_system_clear(&s);
    }
    nh_higher_system s = system_of(&FAMILY[0]);
    nh_higher_logarithm found;
    cr_expect(!nh_higher_logarithm_find(&s, 13, NH_HIGHER_ORDERS, &found), "too small");
    nh_higher_system_clear(&s);
    family other = FAMILY[0];
    other.B = "2/1000003";
    s = system_of(&other);
    cr_expect(!nh_higher_logarithm_find(&s, 1000003, NH_HIGHER_ORDERS, &found), "a denominator");
    cr_expect(nh_higher_logarithm_find(&s, 1000033, NH_HIGHER_ORDERS, &found) && found.order == 3);
    nh_higher_system_clear(&s);
}

/* ---- floating numbers: jets along periods ---- */

enum { JETS = 4, STEPS = 3000 };

/* u_0 .. u_3, u_0' .., z_0 .., z_0' .. */
typedef struct {
    double complex at[4][JETS];
} jet;

static jet rate_of(const family *f, const jet *s)
{
    jet r;
    for (int k = 0; k < JETS; k++) {
        double complex uu = 0, zz = 0, uz = 0;
        for (int i = 0; i <= k; i++) {
            uu += s->at[0][i] * s->at[0][k - i];
            zz += s->at[2][i] * s->at[2][k - i];
            uz += s->at[0][i] * s->at[2][k - i];
        }
        r.at[0][k] = s->at[1][k];
        r.at[1][k] = -f->b * s->at[0][k] - 3 * f->e * uu - zz;
        r.at[2][k] = s->at[3][k];
        r.at[3][k] = -s->at[2][k] - 2 * uz;
    }
    return r;
}

static jet moved(const jet *s, const jet *r, double complex h)
{
    jet out;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < JETS; k++) out.at[i][k] = s->at[i][k] + h * r->at[i][k];
    return out;
}

/* Runge and Kutta's method along a straight line of complex times. */
static void follow(const family *f, jet *s, double complex time)
{
    double complex h = time / STEPS;
    for (int n = 0; n < STEPS; n++) {
        jet a = rate_of(f, s), x = moved(s, &a, h / 2), b = rate_of(f, &x);
        x = moved(s, &b, h / 2);
        jet c = rate_of(f, &x);
        x = moved(s, &c, h);
        jet d = rate_of(f, &x);
        *s = moved(s, &a, h / 6);
        *s = moved(s, &b, h / 3);
        *s = moved(s, &c, h / 3);
        *s = moved(s, &d, h / 6);
    }
}

/* Zeros of sigma = 2/7 - B u^2 - 2 eps u^3, by the method of Durand and Kerner, by their real parts: none lies between e_1 and another. */
static void zeros(const family *f, double complex *e)
{
    for (int i = 0; i < 3; i++) e[i] = cpow(0.4 + 0.9 * I, i);
    for (int n = 0; n < 200; n++)
        for (int i = 0; i < 3; i++) {
            double complex u = e[i], p = u * u * u + f->b / (2 * f->e) * u * u - 1 / (7 * f->e);
            for (int k = 0; k < 3; k++)
                if (k != i) p /= u - e[k];
            e[i] -= p;
        }
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < i; k++)
            if (creal(e[k]) > creal(e[i])) {
                double complex u = e[i];
                e[i] = e[k];
                e[k] = u;
            }
}

/* Twice the integral of du/u' from e_i to e_j along a straight line. */
static double complex period(const family *f, const double complex *e, int i, int j)
{
    double complex sum = 0, before = 0, middle = (e[i] + e[j]) / 2, half = (e[j] - e[i]) / 2, other = e[3 - i - j];
    for (int n = 0; n < STEPS; n++) { /* the middles of steps: exact for periodic functions */
        double angle = acos(-1) * ((n + 0.5) / STEPS - 0.5);
        double complex root = csqrt(2 * f->e * (middle + half * sin(angle) - other));
        if (n && cabs(root + before) < cabs(root - before)) root = -root;
        before = root;
        sum += 1 / root;
    }
    return 2 * sum * acos(-1) / STEPS;
}

/* The trace of the normal equation's matrix over a period from e_1. */
static double complex trace_over(const family *f, double complex start, double complex time)
{
    double complex trace = 0;
    for (int column = 0; column < 2; column++) {
        jet s = {{{start}}};
        s.at[2 + column][1] = 1;
        follow(f, &s, time);
        cr_expect_lt(cabs(s.at[0][0] - start), 1e-6, "%s: no period", f->name);
        trace += s.at[2 + column][1];
    }
    return trace;
}

static double log_modulus(double complex trace)
{
    return fabs(log(cabs((trace + csqrt(trace * trace - 4)) / 2)));
}

/* The library's path is a + b periods, with small a and b. */
Test(higher, multipliers_by_integration)
{
    enum { most = 3 };
    for (size_t i = 0; i < FAMILIES; i++) {
        const family *f = &FAMILY[i];
        if (f->connected != NH_HIGHER_MULTIPLIER) continue;
        nh_higher_system s = system_of(f);
        acb_t trace;
        arb_t size;
        acb_init(trace);
        arb_init(size);
        cr_assert(nh_higher_multiplier(&s, 128, trace, size), "%s", f->name);
        double found = log(arf_get_d(arb_midref(size), ARF_RND_NEAR)), nearest = 1;
        double complex e[3];
        zeros(f, e);
        double first = log_modulus(trace_over(f, e[1], period(f, e, 1, 0))), second = log_modulus(trace_over(f, e[1], period(f, e, 1, 2)));
        for (int a = -most; a <= most; a++)
            for (int b = -most; b <= most; b++) nearest = fmin(nearest, fabs(fabs(a * first + b * second) - found));
        cr_expect_gt(found, 0.1, "%s", f->name);
        cr_expect_lt(nearest, 1e-6, "%s: |mu| = exp(%.9f), not from exp(%.9f), exp(%.9f)", f->name, found, first, second);
        acb_clear(trace);
        arb_clear(size);
        nh_higher_system_clear(&s);
    }
}

/* How far the k-jet is from where it began, after the commutator of two periods, which is the loop around the pole. */
static void commutator(const family *f, double *distance)
{
    double complex e[3];
    zeros(f, e);
    double complex one = period(f, e, 1, 0), two = period(f, e, 1, 2);
    jet begin = {{{e[1], 0.3 + 0.2 * I, 0.1, -0.2}, {0, -0.4, 0.3 * I, 0.1}, {0, 0.7 - 0.1 * I, 0.2, 0.3 * I}, {0, 0.5, -0.6 * I, 0.2}}};
    jet s = begin;
    follow(f, &s, one);
    follow(f, &s, two);
    follow(f, &s, -one);
    follow(f, &s, -two);
    for (int k = 0; k < JETS; k++) {
        distance[k] = 0;
        for (int i = 0; i < 4; i++) distance[k] += cabs(s.at[i][k] - begin.at[i][k]);
    }
}

Test(higher, commutators_by_integration)
{
    for (size_t i = 0; i < FAMILIES; i++) {
        double distance[JETS];
        if (FAMILY[i].n < 0) continue;
        commutator(&FAMILY[i], distance);
        for (int k = 0; k < 3; k++) cr_expect_lt(distance[k], 1e-4, "%s: order %d, %g", FAMILY[i].name, k, distance[k]);
        if (FAMILY[i].order) cr_expect_gt(distance[3], 1e-2, "%s: order 3, %g", FAMILY[i].name, distance[3]);
        else cr_expect_lt(distance[3], 1e-4, "%s: order 3, %g", FAMILY[i].name, distance[3]);
    }
}
