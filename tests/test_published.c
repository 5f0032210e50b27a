/* Integrals that the stages of the search miss and the count does not: published systems, analysed without an analysis file. */
#include <criterion/criterion.h>

#include "catalogue.h"
#include "scratch.h"

/* ---- published systems ---- */

typedef struct {
    const char *name, *text;
    size_t proved;          /* independent currents, all of them proved */
    size_t degree;          /* the analysis is complete to this degree at least */
} published;

#define PLANE "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - "
#define QUADRANT "domain: {x: [0.5, 2], y: [0.5, 2]}\n"

static const published PUBLISHED[] = {
    /* A. P. Fordy, Physica D 52 (1991) 204 */
    {"Kaup and Kupershmidt's Henon-Heiles system with b/x^2",
     "parameters: {b: 0.3}\n" PLANE "(x^2 + 16*y^2)/2 - x^2*y - 16*y^3/3 - b/x^2\n" QUADRANT, 2, 6},
    /* S. Post and P. Winternitz, J. Phys. A 44 (2011) 162001: integrals of degrees 3 and 4, and no coordinates that separate */
    {"Post and Winternitz", "parameters: {a: 0.7}\n" PLANE "a*y*x^(-2/3)\n" QUADRANT, 3, 6},
    /* potentials with complex coefficients, x = i s X: A. Ramani, B. Dorizzi and B. Grammaticos, Phys. Rev. Lett. 49 (1982) 1539; the second is of [AMNS2018] */
    {"cubic with sqrt(3) i", "coordinates: [x, y]\nlagrangian: (-3*x'^2 + y'^2)/2 - (y^3/3 - 45/2*x^2*y + 81/2*x^3)\n", 2, 4},
    {"cubic with sqrt(14) i", "coordinates: [x, y]\nlagrangian: (-14*x'^2 + y'^2)/2 - (y^3/3 - 105*x^2*y + 1666/3*x^3)\n", 2, 4},
    /* M. Blau and M. O'Loughlin, Nucl. Phys. B 654 (2003) 135: exponentials of a cyclic coordinate */
    {"geodesics of a plane wave", "coordinates: [u, v, x, y]\nlagrangian: (x'^2 + y'^2)/2 + u'*v' + (x^2 - y^2)*u'^2/2\n", 8, 3},
    /* S. D. Kelly and R. M. Murray, J. Robotic Systems 12 (1995) 417: wheels that turn together about vertical axes */
    {"robot of fixed orientation",
     "parameters: {m: 2, I: 0.7, J: 0.4, R: 0.5}\ncoordinates: [x, y, {name: th, type: angle}, {name: psi, type: angle}]\n"
     "lagrangian: m*(x'^2 + y'^2)/2 + I*th'^2/2 + 3*J*psi'^2/2\nconstraints: [\"x' = R*cos(th)*psi'\", \"y' = R*sin(th)*psi'\"]\n", 6, 3},
    /* C. R. Holt, J. Math. Phys. 23 (1982) 1037; J. Hietarinta, Phys. Rep. 147 (1987) 87: degrees 3, 4 and 6 */
    {"Holt, 3/4", "parameters: {d: 0.3}\n" PLANE "3/4*x^(4/3) - (y^2 + d)*x^(-2/3)\n" QUADRANT, 2, 6},
    {"Holt, 9/2", PLANE "9/2*x^(4/3) - y^2*x^(-2/3)\n" QUADRANT, 2, 6},
    {"Holt, 12", PLANE "12*x^(4/3) - y^2*x^(-2/3)\n" QUADRANT, 2, 6},
    /* A. Ramani, B. Dorizzi and B. Grammaticos, Phys. Rev. Lett. 49 (1982) 1539, with the terms of Hietarinta's list */
    {"quartic, 1:6:8", "parameters: {a: 0.4, b: 0.7}\n" PLANE "x^4 - 6*x^2*y^2 - 8*y^4 - a*(x^2 + 4*y^2) - b/x^2\n" QUADRANT, 2, 6},
    {"quartic, 1:12:16",
     "parameters: {a: 0.4, b: 0.7, c: 0.2}\n" PLANE "x^4 - 12*x^2*y^2 - 16*y^4 - a*(x^2 + 4*y^2) - b/x^2 - c/y^2\n" QUADRANT, 2, 6},
    /* O. I. Bogoyavlensky, Commun. Math. Phys. 51 (1976) 201: the coordinates are the simple roots */
    {"Toda, G2", "coordinates: [x, y]\nlagrangian: x'^2 + x'*y' + y'^2/3 - exp(x) - exp(y)\n", 2, 6},
    {"Toda, G2, periodic", "coordinates: [x, y]\nlagrangian: x'^2 + x'*y' + y'^2/3 - exp(x) - exp(y) - exp(-2*x - y)\n", 2, 6},
    {"Toda, B2", PLANE "exp(x - y) - exp(y)\n", 2, 6},
    {"Toda, A2", "coordinates: [x, y]\nlagrangian: 2*(x'^2 + y'^2 + x'*y')/3 - exp(x) - exp(y)\n", 2, 6},
    /* J. Drach, C. R. Acad. Sci. 200 (1935) 22 */
    {"Drach",
     "parameters: {a: 0.4, b: 0.7, c: 0.9}\ncoordinates: [x, y]\n"
     "lagrangian: x'*y' - a/(x*y) - b*x^(1/2)*y^(-5/2) - c*x^(-1/2)*y^(-3/2)\n" QUADRANT, 3, 6},
    /* F. Calogero, J. Math. Phys. 10 (1969) 2191; M. A. Olshanetsky and A. M. Perelomov, Phys. Rep. 71 (1981) 313 */
    {"Calogero, B2",
     "parameters: {g: 0.4, h: 0.7}\n" PLANE "g/(x - y)^2 - g/(x + y)^2 - h/x^2 - h/y^2\ndomain: {x: [0.2, 1], y: [1.5, 2.5]}\n", 4, 6},
    /* F. Tremblay, A. V. Turbiner and P. Winternitz, J. Phys. A 42 (2009) 242001 */
    {"Tremblay, Turbiner and Winternitz, k = 2",
     "parameters: {w: 0.8, a: 0.3, b: 0.5}\ncoordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2 - w^2*r^2)/2 - (a/cos(2*th)^2 + b/sin(2*th)^2)/r^2\n"
     "domain: {r: [0.5, 2], th: [0.2, 0.6]}\n", 3, 6},
    /* the same, k = 3: the integral has degree 6 and 61 terms */
    {"Tremblay, Turbiner and Winternitz, k = 3",
     "parameters: {w: 0.8, a: 0.3, b: 0.5}\ncoordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2 - w^2*r^2)/2 - (a/cos(3*th)^2 + b/sin(3*th)^2)/r^2\n"
     "domain: {r: [0.5, 2], th: [0.15, 0.4]}\n", 4, 6},
    /* J. Wolfes, J. Math. Phys. 15 (1974) 1420, in polar coordinates of the relative motion: Calogero's G2 */
    {"Wolfes",
     "parameters: {a: 0.3, b: 0.5}\ncoordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2)/2 - (a/cos(3*th)^2 + b/sin(3*th)^2)/r^2\n"
     "domain: {r: [0.5, 2], th: [0.15, 0.4]}\n", 4, 6},
    /* S. Post and P. Winternitz, J. Phys. A 43 (2010) 222001: Coulomb's problem deformed; k = 2 and 3 have integrals of degrees 4 and 6 */
    {"Post and Winternitz, Coulomb, k = 2",
     "parameters: {q: 0.8, a: 0.3, b: 0.5}\ncoordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2)/2 + q/r - (a/cos(th)^2 + b/sin(th)^2)/r^2\n"
     "domain: {r: [0.5, 2], th: [0.4, 1.1]}\n", 3, 6},
    {"Post and Winternitz, Coulomb, k = 3",
     "parameters: {q: 0.8, a: 0.3, b: 0.5}\ncoordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2)/2 + q/r - (a/cos(3*th/2)^2 + b/sin(3*th/2)^2)/r^2\n"
     "domain: {r: [0.5, 2], th: [0.3, 0.8]}\n", 3, 6},
    /* P. E. Verrier and N. W. Evans, J. Math. Phys. 49 (2008) 022902: degree 4 */
    {"Verrier and Evans",
     "parameters: {k: 0.7, a: 0.3, b: 0.4, c: 0.5}\ncoordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 + k/sqrt(x^2 + y^2 + z^2) - a/x^2 - b/y^2 - c/z^2\n"
     "domain: {x: [0.5, 2], y: [0.5, 2], z: [0.5, 2]}\n", 5, 4},
    /* I. Fris, V. Mandrosov, Ya. A. Smorodinsky, M. Uhlir and P. Winternitz, Phys. Lett. 16 (1965) 354: the fourth of their potentials, in polar coordinates */
    {"Smorodinsky and Winternitz, IV",
     "parameters: {a: 0.7, b: 0.3, c: 0.4}\ncoordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2)/2 - a/r - (b*cos(th/2) + c*sin(th/2))/sqrt(r)\ndomain: {r: [0.5, 2], th: [0.3, 1.5]}\n", 3, 6},
    /* A. Ballesteros, A. Enciso, F. J. Herranz, O. Ragnisco and D. Riglioni, Phys. Lett. A 375 (2011) 1431: an oscillator on Darboux's space III */
    {"oscillator on Darboux's space III",
     "parameters: {l: 0.3, w: 0.8}\ncoordinates: [x, y]\nlagrangian: (1 + l*(x^2 + y^2))*(x'^2 + y'^2)/2 - w^2*(x^2 + y^2)/(1 + l*(x^2 + y^2))/2\n"
     "domain: {x: [0.5, 1.5], y: [0.5, 1.5]}\n", 3, 6},
    /* J. Wolfes, J. Math. Phys. 15 (1974) 1420: three bodies on a line with forces among pairs and among all three, in their own coordinates */
    {"Wolfes, three bodies",
     "parameters: {a: 0.4, b: 0.7}\ncoordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - a/(x - y)^2 - a/(y - z)^2 - a/(z - x)^2 - b/(x + y - 2*z)^2 - b/(y + z - 2*x)^2 - b/(z + x - 2*y)^2\n"
     "domain: {x: [0.2, 0.6], y: [1.5, 2], z: [4, 5]}\n", 5, 4},
    /* K. M. Ehlers and J. Koiller, Regul. Chaotic Dyn. 12 (2007) 127: a homogeneous ball that neither slips nor spins */
    {"rubber ball",
     "parameters: {m: 1.1, I: 0.5, R: 0.8}\ncoordinates: [x, y, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
     "lagrangian: m*(x'^2 + y'^2)/2 + I/2*(h'^2 + p'^2 + s'^2 + 2*p'*s'*cos(h))\n"
     "constraints: [\"x' = R*(h'*sin(p) - s'*sin(h)*cos(p))\", \"y' = -R*(h'*cos(p) + s'*sin(h)*sin(p))\", \"p' + s'*cos(h) = 0\"]\ndomain: {h: [0.4, 2.6]}\n", 6, 2},
    /* a penny rolls down a slope: y and th drift, and the angle stands outside of sines and cosines */
    {"vertical disk on a slope",
     "parameters: {m: 1, I: 0.4, J: 0.2, R: 0.6, g: 0.9}\ncoordinates: [x, y, {name: th, type: angle}, {name: ph, type: angle}]\n"
     "lagrangian: m/2*(x'^2 + y'^2) + I/2*th'^2 + J/2*ph'^2 - m*g*x\nconstraints: [\"x' = R*th'*cos(ph)\", \"y' = R*th'*sin(ph)\"]\n", 6, 2},
    /* Neimark and Fufaev 1972; A. M. Bloch, Nonholonomic Mechanics and Control, 2015, section 1.6.  A series in f that is a function of a closed form was once taken for
     * the fifth integral. */
    {"skate on a slope",
     "parameters: {m: 1.3, J: 0.4, g: 0.9}\ncoordinates: [x, y, {name: f, type: angle}]\n"
     "lagrangian: m*(x'^2 + y'^2)/2 + J*f'^2/2 - m*g*x\nconstraints: [\"x'*sin(f) = y'*cos(f)\"]\n", 5, 4},
};
enum { PUBLISHED_COUNT = sizeof PUBLISHED / sizeof *PUBLISHED };

static nh_analysis *analysed(const char *text, double construct_work)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert_not_null(out);
    fprintf(out, "name: published\n%s", text);
    fclose(out);
    nh_error error = {0};
    nh_analyze_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    if (construct_work >= 0) q.options.construct = construct_work;
    nh_analysis *r = nh_analysis_create(&q, &error);
    remove(path);
    cr_assert_not_null(r, "%s", error.what);
    return r;
}

static size_t independent_and_proved(const nh_analysis *r)
{
    size_t n = 0;
    for (size_t k = 0; k < r->count; k++) n += r->found[k].independence == NH_INDEPENDENT && r->found[k].proof.proved;
    return n;
}

/* Every current is constant along the motion with multipliers as well, which shares no code with the search. */
Test(published, published_systems_are_complete_and_proved)
{
    for (size_t i = 0; i < PUBLISHED_COUNT; i++) {
        if (!sweep_tries(i, 8, 48)) continue;
        const published *u = &PUBLISHED[i];
        nh_analysis *r = analysed(u->text, -1);
        const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
        row o = {.rate = -INFINITY};
        compare(r, &o);
        cr_expect_eq(o.wrong, 0, "%s: %s", u->name, o.names);
        cr_expect_geq(independent_and_proved(r), u->proved, "%s: %zu proved", u->name, independent_and_proved(r));
        cr_expect(c->counted && c->degree >= u->degree && !c->missing_at, "%s: complete to degree %zu", u->name, c->degree);
        nh_analysis_free(r);
    }
}

/* Coefficients over all parameters, not for the values of the file only. */
Test(published, what_is_constructed_is_proved_for_all_parameters)
{
    nh_analysis *r = analysed(PUBLISHED[1].text, -1);
    for (size_t k = 0; k < r->count; k++) cr_expect(!r->found[k].proof.proved || r->found[k].proof.all_parameters, "Phi%zu", k + 1);
    nh_analysis_free(r);
}

Test(published, without_work_nothing_is_constructed_and_that_is_said)
{
    nh_analysis *r = analysed(PUBLISHED[0].text, 0);
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_expect_eq(r->independent, 1);
    cr_expect_eq(c->missing_at, 4);
    cr_expect_eq(c->missing, 1);
    nh_analysis_free(r);
}

/* ---- integrals that are functions of others, and relations ---- */

static bool has_relation(const nh_analysis *r, const char *left, const char *right)
{
    for (size_t k = 0; k < r->relations; k++)
        if (!strcmp(r->relation[k].left, left) && !strcmp(r->relation[k].right, right)) return true;
    return false;
}

/* Two components of Runge and Lenz's vector depend on the third, on energy and momentum: A L = 0 and A^2 = k^2 - 2 E L^2 / m, with Phi1 = -E. */
Test(published, integrals_that_depend_on_others_and_their_relations)
{
    nh_analysis *r = analysed("parameters: {m: 1.3, k: 0.8}\ncoordinates: [x, y, z]\nlagrangian: m*(x'^2 + y'^2 + z'^2)/2 + k/sqrt(x^2 + y^2 + z^2)\n", -1);
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_assert_eq(r->independent, 5);
    cr_assert_eq(r->furthers, 2);
    for (size_t k = 0; k < r->furthers; k++) cr_expect(r->further[k].degree == 2 && r->further[k].current.proof.all_parameters);
    cr_expect(c->linear && c->generic && c->degree == 4);
    cr_expect_eq(c->count.row[3].bound, 80, "%zu", c->count.row[3].bound);
    cr_assert_eq(r->relations, 2);
    cr_expect(has_relation(r, "Phi4*Phi7", "Phi2*Phi5 - Phi3*Phi6"));
    cr_expect(has_relation(r, "Phi7^2", "k^2 - Phi5^2 - Phi6^2 - 2*Phi1*Phi2^2/m - 2*Phi1*Phi3^2/m - 2*Phi1*Phi4^2/m"));
    nh_analysis_free(r);
}

/* With time in two currents of Smorodinsky and Winternitz's oscillator the integrals without it, of degrees two and three, are functions of them; the square of the cubic one
 * is a polynomial in the others. */
Test(published, a_cubic_integral_whose_square_is_a_polynomial)
{
    nh_analysis *r = analysed("parameters: {w: 0.8, a: 0.3, b: 0.5}\n" PLANE "w^2*(x^2 + y^2)/2 - a/x^2 - b/y^2\n" QUADRANT, -1);
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_assert_eq(r->furthers, 3);
    cr_expect_eq(r->further[2].degree, 3);
    cr_expect(c->linear && c->degree == 6);
    cr_expect_eq(r->relations, 1);
    cr_expect_str_eq(r->relation[0].left, "Phi7^2");
    nh_analysis_free(r);
}

/* A control: nothing but the energy, and nothing is added. */
Test(published, generic_systems_have_no_further_integrals)
{
    nh_analysis *r = analysed(PLANE "x^4 - x*y^3 - x^2*y\n", -1);
    cr_expect_eq(r->count, 1);
    cr_expect_eq(r->furthers, 0);
    cr_expect_eq(r->relations, 0);
    cr_expect(r->completeness[NH_COMPLETE_IN_COORDINATES].linear);
    nh_analysis_free(r);
}
