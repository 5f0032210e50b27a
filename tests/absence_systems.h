/* absence_systems: systems of which the literature knows, or a theorem of this program says, how many integrals there are.
 *
 * The texts are system files.  `exist`: independent integrals of the shape (without the coordinates that are left out, and
 * without t) that are known to exist; a statement that there are fewer is false.  Where the values come from stands above
 * each group; "see" names who found the system or proved the absence. */
#ifndef NH_TESTS_ABSENCE_SYSTEMS_H
#define NH_TESTS_ABSENCE_SYSTEMS_H

#include <stddef.h>

/* EXCLUDED: none but those that exist.  OPEN_ROW: no theorem of the program applies; there may be a reason in the words of
 * the row.  IRREGULAR: none but those that exist, rational; or open. */
typedef enum { EXCLUDED, OPEN_ROW, IRREGULAR } absence_expected;

/* By which engine at least: Kovacic's algorithm modulo a prime, balls, straight lines of a homogeneous potential, logarithms of
 * higher order. */
enum { BY_KOVACIC = 1, BY_BALLS = 2, BY_LINES = 4, BY_LOGARITHM = 8 };

typedef struct {
    const char *name, *text;
    absence_expected expected;
    unsigned by;
    size_t exist;
} absence_system;

#define IN_PLANE(V) "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (" V ")\n"
#define IN_QUADRANT(V) IN_PLANE(V) "domain: {x: [0.5, 2], y: [0.5, 2]}\n"
#define IN_SPACE(V) "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (" V ")\n"
#define CONSTRAINED(V, FORM) IN_SPACE(V) "constraints: [\"" FORM "\"]\n"

#define HENON_HEILES(B, EPS) IN_PLANE("(x^2 + (" B ")*y^2)/2 + x^2*y + (" EPS ")*y^3")
#define LIOUVILLE(F, G, U, V) \
    "coordinates: [x, y]\nlagrangian: (" F " + " G ")*(x'^2 + y'^2)/2 - (" U " + " V ")/(" F " + " G ")\n"
#define WITH_R(V) "definitions: [\"r = sqrt(x^2 + y^2)\"]\n" IN_QUADRANT(V)
#define WITH_TWO(V) "definitions: [\"r1 = sqrt(x^2 + (y - 1)^2)\", \"r2 = sqrt(x^2 + (y + 1)^2)\", \"r = sqrt(x^2 + y^2)\"]\n" IN_QUADRANT(V)
#define ATWOOD(MU) \
    "coordinates: [{name: r, type: length}, {name: h, type: angle}]\n" \
    "lagrangian: (1 + " MU ")*r'^2/2 + r^2*h'^2/2 + r*(cos(h) - " MU ")\ndomain: {r: [0.5, 2]}\n"

#define EULER_ANGLES "coordinates: [{name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
#define HEAVY_TOP(A, B, C, RX, RY) \
    EULER_ANGLES \
    "definitions: [\"W1 = p'*sin(h)*sin(s) + h'*cos(s)\", \"W2 = p'*sin(h)*cos(s) - h'*sin(s)\", \"W3 = p'*cos(h) + s'\"]\n" \
    "lagrangian: ((" A ")*W1^2 + (" B ")*W2^2 + (" C ")*W3^2)/2 - (" RX ")*sin(h)*sin(s) - (" RY ")*sin(h)*cos(s)\n" \
    "domain: {h: [0.5, 2.5]}\n"
#define SUSLOV(I1, I2, V) \
    EULER_ANGLES \
    "definitions: [\"w1 = h'*cos(s) + p'*sin(h)*sin(s)\", \"w2 = p'*sin(h)*cos(s) - h'*sin(s)\"]\n" \
    "lagrangian: ((" I1 ")*w1^2 + (" I2 ")*w2^2)/2 - (" V ")\nconstraints: [p'*cos(h) + s' = 0]\ndomain: {h: [0.6, 1.4]}\n"
#define CONTACT(B, C) CONSTRAINED("((" B ")*x^2 + (" C ")*y^2)/2", "z' = y*x'")
#define NONHOLONOMIC_HENON_HEILES(B, EPS, K) CONSTRAINED("(x^2 + (" B ")*y^2)/2 + x^2*y + (" EPS ")*y^3", "z' = (" K ")*y*x'")

static const absence_system ABSENCE[] = {
    /* Henon-Heiles over (B, eps): see S. L. Ziglin 1983, H. Ito 1985, J. J. Morales-Ruiz and J.-P. Ramis 2001; KdV, Sawada-Kotera,
       Kaup-Kupershmidt: see A. P. Fordy 1991.  Where eps = 4/(n (n + 1)) the first order is solvable;
       the logarithm at order 3 is seen by this program. */
    {"Henon-Heiles (1, -1/3), classical", HENON_HEILES("1", "-1/3"), EXCLUDED, BY_KOVACIC | BY_BALLS, 1},
    {"Henon-Heiles (1, 1)", HENON_HEILES("1", "1"), EXCLUDED, BY_KOVACIC | BY_BALLS, 1},
    {"Henon-Heiles (1, 16/3)", HENON_HEILES("1", "16/3"), EXCLUDED, BY_KOVACIC | BY_BALLS, 1},
    {"Henon-Heiles (1, 2), KdV", HENON_HEILES("1", "2"), OPEN_ROW, 0, 2},
    {"Henon-Heiles (7/3, 2), KdV", HENON_HEILES("7/3", "2"), OPEN_ROW, 0, 2},
    {"Henon-Heiles (1, 1/3), Sawada-Kotera", HENON_HEILES("1", "1/3"), OPEN_ROW, 0, 2},
    {"Henon-Heiles (16, 16/3), Kaup-Kupershmidt", HENON_HEILES("16", "16/3"), OPEN_ROW, 0, 2},
    {"Henon-Heiles (2, 1/3)", HENON_HEILES("2", "1/3"), EXCLUDED, BY_LOGARITHM, 1},
    {"Henon-Heiles (1/4, 1/3)", HENON_HEILES("1/4", "1/3"), EXCLUDED, BY_LOGARITHM, 1},
    {"Henon-Heiles (1, 2/3)", HENON_HEILES("1", "2/3"), EXCLUDED, BY_LOGARITHM, 1},
    {"Henon-Heiles (4, 2/3)", HENON_HEILES("4", "2/3"), EXCLUDED, BY_LOGARITHM, 1},
    {"Henon-Heiles (1, 1/5)", HENON_HEILES("1", "1/5"), EXCLUDED, BY_LOGARITHM, 1},
    {"Henon-Heiles (5, 2/15)", HENON_HEILES("5", "2/15"), EXCLUDED, BY_LOGARITHM, 1},
    {"Henon-Heiles (1, 0)", HENON_HEILES("1", "0"), IRREGULAR, 0, 1},
    /* Quartics, without and with quadratic terms: see J. Hietarinta 1987, R. Garnier 1919; x^4 + y^4 + x^2 y^2 with them: see H. Yoshida 1987 */
    {"quartic 1:6:1", IN_PLANE("x^4 + 6*x^2*y^2 + y^4"), OPEN_ROW, 0, 2},
    {"quartic 1:5:1", IN_PLANE("x^4 + 5*x^2*y^2 + y^4"), EXCLUDED, BY_KOVACIC, 1},
    {"quartic of two oscillators", IN_PLANE("(x^2 + y^2)/2 + (x^4 + y^4)/4 + x^2*y^2"), EXCLUDED, BY_KOVACIC, 1},
    {"quartic 1:12:16 with x^2 + 4 y^2", IN_PLANE("x^4 + 12*x^2*y^2 + 16*y^4 + x^2 + 4*y^2"), OPEN_ROW, 0, 2},
    {"quartic 1:6:8 with x^2 + 4 y^2", IN_PLANE("x^4 + 6*x^2*y^2 + 8*y^4 + x^2 + 4*y^2"), OPEN_ROW, 0, 2},
    {"quartic 1:6:1 with x^2 + y^2", IN_PLANE("x^4 + 6*x^2*y^2 + y^4 + x^2 + y^2"), OPEN_ROW, 0, 2},
    {"Garnier's quartic with x^2 + 3 y^2", IN_PLANE("(x^2 + y^2)^2 + x^2 + 3*y^2"), OPEN_ROW, 0, 2},
    {"a sextic", IN_PLANE("(x^2 + y^2)^3 + x^6 + 2*(x^2 + y^2)"), EXCLUDED, BY_KOVACIC, 1},
    /* With a root as a letter; they separate in polar, parabolic or elliptic coordinates, as L. D. Landau and E. M. Lifshitz show */
    {"Kepler", WITH_R("-1/r"), OPEN_ROW, 0, 2},
    {"Kepler in a uniform field", WITH_R("-1/r + y/5"), OPEN_ROW, 0, 2},
    {"Kepler with x^2 + 4 y^2", WITH_R("-1/r + x^2 + 4*y^2"), OPEN_ROW, 0, 2},
    {"Kepler with r^2", WITH_R("-1/r + r^2"), OPEN_ROW, 0, 2},
    {"r + r^3", WITH_R("r + r^3"), OPEN_ROW, 0, 2},
    {"1/r + r", WITH_R("1/r + r"), OPEN_ROW, 0, 2},
    {"two centres", WITH_TWO("-1/r1 - 2/r2"), OPEN_ROW, 0, 2},
    {"two centres with r^2", WITH_TWO("-1/r1 - 2/r2 + r^2"), OPEN_ROW, 0, 2},
    {"Liouville's metric", LIOUVILLE("(1 + x^2)", "y^2", "x^2", "2*y^4"), OPEN_ROW, 0, 2},
    {"Liouville's metric, another", LIOUVILLE("(2 + x^4)", "y^2", "x^2", "y^2"), OPEN_ROW, 0, 2},
    /* See A. J. Maciejewski, M. Przybylska and J.-A. Weil 2004 */
    {"spring pendulum", "definitions: [\"r = sqrt(x^2 + y^2)\"]\n" IN_PLANE("3/2*(r - 1)^2 + 2*y") "domain: {x: [-0.5, 0.5], y: [-2, -0.5]}\n",
     EXCLUDED, BY_KOVACIC | BY_BALLS, 1},
    {"spring pendulum in polar coordinates", "coordinates: [{name: r, type: length}, {name: h, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*h'^2)/2 - 3/2*(r - 1)^2 + 2*r*cos(h)\ndomain: {r: [0.5, 2]}\n", EXCLUDED, BY_KOVACIC, 1},
    /* See J. Casasayas, A. Nunes and N. Tufillaro 1990; mu = 3: N. Tufillaro 1986; the triangular ratios 3/2, 5/4, ..: see
       R. Martinez and C. Simo 2009, at higher order */
    {"Atwood 2", ATWOOD("2"), EXCLUDED, BY_KOVACIC | BY_BALLS, 1},
    {"Atwood 8/3", ATWOOD("8/3"), EXCLUDED, BY_KOVACIC, 1},
    {"Atwood 5", ATWOOD("5"), EXCLUDED, BY_KOVACIC, 1},
    {"Atwood 1/2", ATWOOD("1/2"), EXCLUDED, BY_KOVACIC, 1},
    {"Atwood 3", ATWOOD("3"), OPEN_ROW, 0, 2},
    {"Atwood 3/2", ATWOOD("3/2"), OPEN_ROW, 0, 1},
    {"Atwood 5/4", ATWOOD("5/4"), OPEN_ROW, 0, 1},
    {"Atwood 1", ATWOOD("1"), IRREGULAR, 0, 1},
    /* See S. L. Ziglin 1983, A. J. Maciejewski and M. Przybylska 2005; Goryachev's and Chaplygin's integral exists where p_p = 0 only */
    {"top (3, 2, 2), Lagrange", HEAVY_TOP("3", "2", "2", "1", "0"), OPEN_ROW, 0, 3},
    {"top (3, 1, 1), Lagrange", HEAVY_TOP("3", "1", "1", "1", "0"), OPEN_ROW, 0, 3},
    {"top (1, 1, 1), Lagrange", HEAVY_TOP("1", "1", "1", "1", "0"), OPEN_ROW, 0, 3},
    {"top (2, 2, 1), Kovalevskaya", HEAVY_TOP("2", "2", "1", "1", "0"), OPEN_ROW, 0, 3},
    {"top (4, 4, 1), Goryachev and Chaplygin", HEAVY_TOP("4", "4", "1", "1", "0"), OPEN_ROW, 0, 2},
    {"top (3, 3, 1)", HEAVY_TOP("3", "3", "1", "1", "0"), EXCLUDED, BY_KOVACIC | BY_BALLS, 2},
    {"top (5, 5, 2)", HEAVY_TOP("5", "5", "2", "1", "0"), EXCLUDED, BY_KOVACIC, 2},
    {"top (8, 8, 1)", HEAVY_TOP("8", "8", "1", "1", "0"), EXCLUDED, BY_KOVACIC, 2},
    {"top (3, 2, 1)", HEAVY_TOP("3", "2", "1", "1", "0"), EXCLUDED, BY_KOVACIC, 2},
    {"top (4, 3, 2) off an axis", HEAVY_TOP("4", "3", "2", "1", "1"), EXCLUDED, BY_KOVACIC, 2},
    {"top (4, 3/2, 2)", HEAVY_TOP("4", "3/2", "2", "1", "0"), EXCLUDED, BY_KOVACIC, 2},
    /* Kozlov's potential: see V. V. Kozlov 1985, A. J. Maciejewski and M. Przybylska 2004 */
    {"Suslov 1:1", SUSLOV("1", "1", "cos(h)"), OPEN_ROW, 0, 2},
    {"Suslov 2:1", SUSLOV("2", "1", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    {"Suslov 1:2", SUSLOV("1", "2", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    {"Suslov 3:2", SUSLOV("3", "2", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    {"Suslov 8:3", SUSLOV("8", "3", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    {"Suslov 3:1", SUSLOV("3", "1", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    {"Suslov 6:1", SUSLOV("6", "1", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    {"Suslov 10:1", SUSLOV("10", "1", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    {"Suslov 1:3", SUSLOV("1", "3", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    {"Suslov 1:6", SUSLOV("1", "6", "cos(h)"), EXCLUDED, BY_KOVACIC, 1},
    /* Potentials of Henon and Heiles, KdV, Sawada-Kotera and Kaup-Kupershmidt with z' = k y x': in no paper that we know; checked by
       tests/numerical_monodromy.py.  k = 0: three letters more, KdV's two integrals, z' */
    {"nonholonomic Henon-Heiles, k = 1", NONHOLONOMIC_HENON_HEILES("1", "-1/3", "1"), EXCLUDED, BY_KOVACIC, 1},
    {"nonholonomic KdV, k = 1", NONHOLONOMIC_HENON_HEILES("1", "2", "1"), EXCLUDED, BY_KOVACIC, 1},
    {"nonholonomic Sawada-Kotera, k = 1", NONHOLONOMIC_HENON_HEILES("1", "1/3", "1"), EXCLUDED, BY_KOVACIC, 1},
    {"nonholonomic Kaup-Kupershmidt, k = 1", NONHOLONOMIC_HENON_HEILES("16", "16/3", "1"), EXCLUDED, BY_KOVACIC, 1},
    {"nonholonomic Henon-Heiles, k = 1/2", NONHOLONOMIC_HENON_HEILES("1", "-1/3", "1/2"), EXCLUDED, BY_KOVACIC, 1},
    {"nonholonomic KdV, k = 1/2", NONHOLONOMIC_HENON_HEILES("1", "2", "1/2"), EXCLUDED, BY_KOVACIC, 1},
    {"nonholonomic Sawada-Kotera, k = 1/2", NONHOLONOMIC_HENON_HEILES("1", "1/3", "1/2"), EXCLUDED, BY_KOVACIC, 1},
    {"nonholonomic Kaup-Kupershmidt, k = 1/2", NONHOLONOMIC_HENON_HEILES("16", "16/3", "1/2"), EXCLUDED, BY_KOVACIC, 1},
    {"KdV, k = 0", NONHOLONOMIC_HENON_HEILES("1", "2", "0"), OPEN_ROW, 0, 2},
    /* Other constraints and potentials: in no paper that we know, likewise */
    {"Henon-Heiles with z' = y^2 x'", CONSTRAINED("(x^2 + y^2)/2 + x^2*y - y^3/3", "z' = y^2*x'"), EXCLUDED, BY_KOVACIC, 1},
    {"KdV with z' = y^2 x'", CONSTRAINED("(x^2 + y^2)/2 + x^2*y + 2*y^3", "z' = y^2*x'"), EXCLUDED, BY_KOVACIC, 1},
    {"Sawada-Kotera with z' = y^2 x'", CONSTRAINED("(x^2 + y^2)/2 + x^2*y + y^3/3", "z' = y^2*x'"), EXCLUDED, BY_KOVACIC, 1},
    {"Kaup-Kupershmidt with z' = y^2 x'", CONSTRAINED("(x^2 + 16*y^2)/2 + x^2*y + 16/3*y^3", "z' = y^2*x'"), EXCLUDED, BY_KOVACIC, 1},
    {"quartic 1:6:1 with z' = y x'", CONSTRAINED("x^4 + 6*x^2*y^2 + y^4", "z' = y*x'"), EXCLUDED, BY_KOVACIC, 1},
    {"quartic 1:6:8 with z' = y x'", CONSTRAINED("x^4 + 6*x^2*y^2 + 8*y^4", "z' = y*x'"), EXCLUDED, BY_KOVACIC, 1},
    {"quartic 1:12:16 with z' = y x'", CONSTRAINED("x^4 + 12*x^2*y^2 + 16*y^4", "z' = y*x'"), EXCLUDED, BY_KOVACIC, 1},
    {"quartic (x^2 + y^2)^2 with z' = y x'", CONSTRAINED("(x^2 + y^2)^2", "z' = y*x'"), EXCLUDED, BY_KOVACIC, 1},
    /* The motions x = 0 and what is near them do not feel this constraint */
    {"KdV with z' = x y'", CONSTRAINED("(x^2 + y^2)/2 + x^2*y + 2*y^3", "z' = x*y'"), OPEN_ROW, 0, 1},
    /* y swings by itself, and x obeys a linear equation along it: the first order is solvable */
    {"contact (1, 4)", CONTACT("1", "4"), OPEN_ROW, 0, 2},
    {"contact (7/10, 2/5)", CONTACT("7/10", "2/5"), OPEN_ROW, 0, 2},
    {"contact (1, 1)", CONTACT("1", "1"), OPEN_ROW, 0, 2},
    {"contact (1, 9)", CONTACT("1", "9"), OPEN_ROW, 0, 2},
    {"contact (4, 1)", CONTACT("4", "1"), OPEN_ROW, 0, 2},
    {"contact (2, 1)", CONTACT("2", "1"), OPEN_ROW, 0, 2},
    {"contact (1, 2)", CONTACT("1", "2"), OPEN_ROW, 0, 2},
    {"contact (1, 3)", CONTACT("1", "3"), OPEN_ROW, 0, 2},
    {"contact (9, 4)", CONTACT("9", "4"), OPEN_ROW, 0, 2},
    {"contact (1, 16)", CONTACT("1", "16"), OPEN_ROW, 0, 2},
    {"contact (0, 1)", CONTACT("0", "1"), OPEN_ROW, 0, 2},
    {"contact (1/3, 4/3)", CONTACT("1/3", "4/3"), OPEN_ROW, 0, 2},
    {"contact (-2, -8)", CONTACT("-2", "-8"), OPEN_ROW, 0, 2},
    {"contact (3, 4)", CONTACT("3", "4"), OPEN_ROW, 0, 2},
    {"contact (2, 9)", CONTACT("2", "9"), OPEN_ROW, 0, 2},
    {"contact (6, 1)", CONTACT("6", "1"), OPEN_ROW, 0, 2},
    {"contact (1, 6)", CONTACT("1", "6"), OPEN_ROW, 0, 2},
    /* Normal blocks of dimension 4; with the symmetry, two equal blocks: H and x y' - y x' are all */
    {"three degrees of freedom", IN_SPACE("(x^2 + 2*y^2 + z^2)/2 + (x^2 + 2*y^2 + 3*x*y)*z - z^3/3"), EXCLUDED, BY_BALLS, 1},
    {"three degrees of freedom, another", IN_SPACE("(x^2 + 3*y^2 + z^2)/2 + (x^2/2 + y^2 + 2/5*x*y)*z - z^3/3"), EXCLUDED, BY_BALLS, 1},
    {"three degrees of freedom with a symmetry", IN_SPACE("(x^2 + y^2 + z^2)/2 + (x^2 + y^2)*z - z^3/3"), EXCLUDED, 0, 2},
    /* Homogeneous: see J. J. Morales-Ruiz and J.-P. Ramis 2001; the integrable ones: see J. Hietarinta 1987 */
    {"cubic 1:-1/3", IN_PLANE("x^2*y - y^3/3"), EXCLUDED, BY_LINES, 1},
    {"cubic 1:2", IN_PLANE("x^2*y + 2*y^3"), OPEN_ROW, 0, 2},
    {"cubic 1:1/3", IN_PLANE("x^2*y + y^3/3"), OPEN_ROW, 0, 2},
    {"cubic 1:16/3", IN_PLANE("x^2*y + 16/3*y^3"), OPEN_ROW, 0, 2},
    {"cubic 1:1", IN_PLANE("x^2*y + y^3"), EXCLUDED, BY_LINES, 1},
    {"cubic 1:2/3", IN_PLANE("x^2*y + 2/3*y^3"), EXCLUDED, BY_LOGARITHM, 1},
    {"quartic 1:6:1, homogeneous", IN_PLANE("x^4 + 6*x^2*y^2 + y^4"), OPEN_ROW, 0, 2},
    {"quartic 1:6:8", IN_PLANE("x^4 + 6*x^2*y^2 + 8*y^4"), OPEN_ROW, 0, 2},
    {"quartic 1:12:16", IN_PLANE("x^4 + 12*x^2*y^2 + 16*y^4"), OPEN_ROW, 0, 2},
    {"quartic 1:3:2", IN_PLANE("x^4 + 3*x^2*y^2 + 2*y^4"), EXCLUDED, BY_LINES, 1},
    {"quartic 1:1:1", IN_PLANE("x^4 + x^2*y^2 + y^4"), EXCLUDED, BY_LINES, 1},
    /* Nothing can be said: no plane, and no line */
    {"double pendulum", "coordinates: [{name: p, type: angle}, {name: q, type: angle}]\n"
     "lagrangian: 21/20*49/100*p'^2 + 2/5*81/100*q'^2 + 4/5*63/100*p'*q'*cos(p - q) + 147/10*cos(p) + 36/5*cos(q)\n", OPEN_ROW, 0, 1},
};

enum { ABSENCE_COUNT = sizeof ABSENCE / sizeof *ABSENCE };

#endif
