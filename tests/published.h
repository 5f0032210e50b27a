/* published: systems of the literature whose integrals the stages of the search miss, and the count does not. */
#ifndef NH_TESTS_PUBLISHED_H
#define NH_TESTS_PUBLISHED_H

#include <stddef.h>

typedef struct {
    const char *name, *text;
    size_t proved;          /* independent currents, all of them proved */
    size_t degree;          /* the analysis is complete to this degree at least */
} published;

#define PLANE "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - "
#define QUADRANT "domain: {x: [0.5, 2], y: [0.5, 2]}\n"
#define SPACE "coordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - "
#define OCTANT "domain: {x: [0.5, 2], y: [0.5, 2], z: [0.5, 2]}\n"
#define ANGLES "coordinates: [{name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
#define BALL "coordinates: [x, y, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
#define BODY \
    "definitions: [\"W1 = p'*sin(h)*sin(s) + h'*cos(s)\", \"W2 = p'*sin(h)*cos(s) - h'*sin(s)\", \"W3 = p'*cos(h) + s'\"," \
    " g1 = sin(h)*sin(s), g2 = sin(h)*cos(s), g3 = cos(h)]\n"
#define ROLLS "\"x' = r*(h'*sin(p) - s'*sin(h)*cos(p))\", \"y' = -r*(h'*cos(p) + s'*sin(h)*sin(p))\""
#define TURNED "domain: {h: [0.5, 1.3], p: [-0.7, 0.7], s: [-0.7, 0.7]}\n"

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
    /* the same with a profile that grows along the wave: Airy functions of u, with x u' beside x' */
    {"geodesics of a growing plane wave", "coordinates: [u, v, x]\nlagrangian: u'*v' + x'^2/2 + u*x^2*u'^2/2\n", 6, 4},
    /* A. V. Kilin, Regul. Chaotic Dyn. 6 (2001) 291: Chaplygin's ball, here of revolution; along one direction of the plane its place is an
       inverse hyperbolic sine of cos(h) */
    {"Chaplygin's ball of revolution",
     "parameters: {m: 1.3, A: 0.4, C: 0.7, r: 0.6}\n" BALL BODY "lagrangian: m*(x'^2 + y'^2)/2 + A*(W1^2 + W2^2)/2 + C*W3^2/2\nconstraints: [" ROLLS
     "]\n" TURNED, 5, 2},
    {"homogeneous ball with a rotor", "parameters: {m: 1.3, A: 0.4, K: 0.1, r: 0.5}\n"
     "coordinates: [x, y, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}, {name: u, type: angle}]\n"
     "lagrangian: m*(x'^2 + y'^2)/2 + A*(h'^2 + p'^2 + s'^2 + 2*p'*s'*cos(h))/2 + K*(p'*cos(h) + s' + u')^2/2\n"
     "constraints: [\"x' = r*(h'*sin(p) - s'*sin(h)*cos(p))\", \"y' = -r*(h'*cos(p) + s'*sin(h)*sin(p))\"]\ndomain: {h: [0.6, 2]}\n", 6, 2},
    /* S. D. Kelly and R. M. Murray, J. Robotic Systems 12 (1995) 417: wheels that turn together about vertical axes */
    {"robot of fixed orientation",
     "parameters: {m: 2, I: 0.7, J: 0.4, R: 0.5}\ncoordinates: [x, y, {name: th, type: angle}, {name: psi, type: angle}]\n"
     "lagrangian: m*(x'^2 + y'^2)/2 + I*th'^2/2 + 3*J*psi'^2/2\nconstraints: [\"x' = R*cos(th)*psi'\", \"y' = R*sin(th)*psi'\"]\n", 6, 3},
    /* J. Koiller, Arch. Rational Mech. Anal. 118 (1992) 113: a cart on two wheels, here of different radii.  The rate of turning times an exponential of what both
       wheels have rolled; and waves in h, the frequency of which has more digits than 32 bits */
    {"cart on two wheels",
     "parameters: {m: 2.3117, J: 0.91703, a: 0.4517, r: 0.25, R: 0.31}\ncoordinates: [x, y, {name: h, type: angle}, {name: p, type: angle}, {name: q, type: angle}]\n"
     "lagrangian: m*(x'^2 + y'^2)/2 + m*a*h'*(y'*cos(h) - x'*sin(h)) + J*h'^2/2\n"
     "constraints: [\"x'*sin(h) = y'*cos(h)\", \"x'*cos(h) + y'*sin(h) - h' = r*p'\", \"x'*cos(h) + y'*sin(h) + h' = R*q'\"]\ndomain: {h: [-1.2, 1.2]}\n", 5, 2},
    /* B. Carter, Commun. Math. Phys. 10 (1968) 280: geodesics around a black hole that turns; of two thousand words with its denominators 361 are independent */
    {"Kerr", "parameters: {M: 0.3, a: 0.2}\ncoordinates: [T, r, {name: h, type: angle}, {name: p, type: angle}]\n"
     "definitions: [\"S = r^2 + a^2*cos(h)^2\", \"D = r^2 - 2*M*r + a^2\"]\n"
     "lagrangian: -D/S*(T' - a*sin(h)^2*p')^2/2 + S/D*r'^2/2 + S*h'^2/2 + sin(h)^2/S*((r^2 + a^2)*p' - a*T')^2/2\ndomain: {r: [2, 4], h: [0.5, 2.5]}\n", 4, 3},
    /* J. Tannery, Bull. Sci. Math. 16 (1892) 190; G. Valent, C. Duval and V. Shevchishin, J. Geom. Phys. 87 (2015) 461: all geodesics are closed, by integrals of
       degree three with cos(2 p) and sin(2 p), which are seen at order 10 */
    {"Tannery's surface", "coordinates: [{name: h, type: angle}, {name: p, type: angle}]\n"
     "lagrangian: ((1 + cos(h)/2)^2*h'^2 + sin(h)^2*p'^2)/2\ndomain: {h: [0.5, 2.5]}\n", 3, 6},
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
    /* M. A. Olshanetsky and A. M. Perelomov, Phys. Rep. 71 (1981) 313; S. Wojciechowski, Phys. Lett. A 95 (1983) 279: as many integrals as there can be */
    {"Calogero, B3", "parameters: {g: 0.3, h: 0.2}\ncoordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g*(1/(x - y)^2 + 1/(x - z)^2 + 1/(y - z)^2 + 1/(x + y)^2 + 1/(x + z)^2 + 1/(y + z)^2) - h*(1/x^2 + 1/y^2 + 1/z^2)\n"
     "domain: {x: [0.5, 0.9], y: [1.2, 1.7], z: [2, 2.5]}\n", 6, 4},
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
    /* B. Sutherland, Phys. Rev. A 4 (1971) 2019: three bodies; the proof of the cubic integral takes polynomials of more than 20000 terms */
    {"Sutherland, three bodies",
     "parameters: {g: 0.4}\n" SPACE "g/sin(x - y)^2 - g/sin(y - z)^2 - g/sin(z - x)^2\ndomain: {x: [0.1, 0.4], y: [0.8, 1.2], z: [1.8, 2.3]}\n", 4, 4},
    /* V. V. Kozlov, Adv. Mech. 8 (1985) 85: Chaplygin's ball in a field that is quadratic in the vertical of the body, with coefficients like its moments of inertia */
    {"Kozlov, Chaplygin's ball in a quadratic field",
     "parameters: {A: 1.1, B: 1.7, C: 2.3, m: 1.3, r: 0.6, u: 0.5}\n" BALL BODY
     "lagrangian: A*W1^2/2 + B*W2^2/2 + C*W3^2/2 + m*(x'^2 + y'^2)/2 - u*(A*g1^2 + B*g2^2 + C*g3^2)\nconstraints: [" ROLLS "]\n" TURNED, 3, 2},
    /* the same without the field and with two rotors: A. P. Markeev, Mech. Solids 21 (1986) 62 */
    {"Markeev's ball",
     "parameters: {A: 1.1, B: 1.7, C: 2.3, m: 1.3, r: 0.6, k: 0.5, l: 0.2}\n" BALL BODY
     "lagrangian: A*W1^2/2 + B*W2^2/2 + C*W3^2/2 + m*(x'^2 + y'^2)/2 + k*W1 + l*W3\nconstraints: [" ROLLS "]\n" TURNED, 4, 2},
    /* K. M. Ehlers and J. Koiller, as above, with three moments of inertia */
    {"rubber ball with three moments of inertia",
     "parameters: {A: 1.1, B: 1.7, C: 2.3, m: 1.3, r: 0.6}\n" BALL BODY
     "lagrangian: A*W1^2/2 + B*W2^2/2 + C*W3^2/2 + m*(x'^2 + y'^2)/2\nconstraints: [" ROLLS ", \"p' + s'*cos(h) = 0\"]\n" TURNED, 3, 2},
    /* E. I. Kharlamova-Zabelina, Vestn. Mosk. Univ. 12 (1957) no. 6, 25; V. V. Kozlov, as above */
    {"Suslov's problem with gravity",
     "parameters: {A: 1.1, B: 1.7, C: 2.3, u: 0.6, v: 0.4}\n" ANGLES BODY "lagrangian: A*W1^2/2 + B*W2^2/2 + C*W3^2/2 - u*g1 - v*g2\nconstraints: [\"W3 = 0\"]\n" TURNED, 3, 4},
    {"Suslov's problem in a quadratic field",
     "parameters: {A: 1.1, B: 1.7, C: 2.3, u: 0.6, v: 0.4}\n" ANGLES BODY "lagrangian: A*W1^2/2 + B*W2^2/2 + C*W3^2/2 - u*g1^2 - v*g2^2\nconstraints: [\"W3 = 0\"]\n" TURNED, 2, 4},
    /* ratio of the frequencies 4: of degree four with coefficients of degree five in the vertical */
    {"Suslov's problem in a quadratic field, 4:1",
     ANGLES BODY "lagrangian: W1^2/2 + W2^2 - g1^2 - 8*g2^2\nconstraints: [\"W3 = 0\"]\n" TURNED, 3, 4},
    /* L. E. Veselova, in: Geometry, Differential Equations and Mechanics, Moscow 1986, 64 */
    {"Veselova's system in a quadratic field",
     "parameters: {A: 1.1, B: 1.7, C: 2.3, u: 0.6}\n" ANGLES BODY
     "lagrangian: A*W1^2/2 + B*W2^2/2 + C*W3^2/2 - u*(A*g1^2 + B*g2^2 + C*g3^2)\nconstraints: [\"p' + s'*cos(h) = 0\"]\n" TURNED, 2, 4},
    /* A. G. Reyman and M. A. Semenov-Tian-Shansky, Lett. Math. Phys. 14 (1987) 55 */
    {"Kovalevskaya's top in two fields",
     "parameters: {J: 0.7, a: 0.9, b: 0.5}\n" ANGLES BODY
     "lagrangian: J*(W1^2 + W2^2) + J/2*W3^2 + a*(cos(p)*cos(s) - sin(p)*cos(h)*sin(s)) + b*(-sin(p)*sin(s) + cos(p)*cos(h)*cos(s))\n" TURNED, 3, 4},
    /* N. W. Evans, Phys. Rev. A 41 (1990) 5666: superintegrable potentials in space */
    {"Evans, I", "parameters: {k: 0.7, a: 0.3, b: 0.4, c: 0.5}\n" SPACE "k*(x^2 + y^2 + z^2)/2 - a/x^2 - b/y^2 - c/z^2\n" OCTANT, 6, 4},
    {"Evans, II", "parameters: {k: 0.7, a: 0.3, b: 0.4}\n" SPACE "0 + k/sqrt(x^2 + y^2 + z^2) - a/x^2 - b/y^2\n" OCTANT, 5, 4},
    {"Evans, III", "parameters: {a: 0.3, b: 0.4, c: 0.5}\n" SPACE "a*x/(y^2*sqrt(x^2 + y^2)) - b/y^2 - c/z^2\n" OCTANT, 6, 4},
    {"Evans, IV", "parameters: {a: 0.3, b: 0.4, c: 0.5}\n" SPACE "a*x/(y^2*sqrt(x^2 + y^2)) - b/y^2 - c*z\n" OCTANT, 6, 4},
    {"Evans, V", "parameters: {k: 0.7, a: 0.3, b: 0.4}\n" SPACE "k*(x^2 + y^2 + 4*z^2) - a/x^2 - b/y^2\n" OCTANT, 6, 4},
    {"Evans, four integrals", "parameters: {k: 0.7, a: 0.3, b: 0.4, c: 0.5}\n" SPACE "k*(x^2 + y^2 + z^2)^2 - a/x^2 - b/y^2 - c/z^2\n" OCTANT, 4, 4},
    /* S. Gravel, J. Math. Phys. 45 (2004) 1003: integrals of degree three */
    {"Gravel, two roots", "parameters: {a: 0.7, b: 0.4}\n" PLANE "a*sqrt(x) - b*sqrt(y)\n" QUADRANT, 4, 6},
    {"Gravel, line and root", "parameters: {a: 0.7, b: 0.4}\n" PLANE "a*x - b*sqrt(y)\n" QUADRANT, 4, 6},
    /* N. W. Evans and P. E. Verrier, J. Math. Phys. 49 (2008) 092902: degrees 4 and 6 */
    {"caged oscillator, 1:2", "parameters: {w: 0.8, a: 0.3, b: 0.4}\n" PLANE "w^2*(x^2 + 4*y^2)/2 - a/x^2 - b/y^2\n" QUADRANT, 4, 6},
    {"caged oscillator, 1:3", "parameters: {w: 0.8, a: 0.3, b: 0.4}\n" PLANE "w^2*(x^2 + 9*y^2)/2 - a/x^2 - b/y^2\n" QUADRANT, 4, 6},
    /* R. Garnier, Rend. Circ. Mat. Palermo 43 (1919) 155 */
    {"Garnier", "parameters: {a: 0.7, b: 1.3, c: 2.1}\n" SPACE "(x^2 + y^2 + z^2)^2 - a*x^2 - b*y^2 - c*z^2\n", 3, 4},
    /* B. Dorizzi, B. Grammaticos, J. Hietarinta, A. Ramani and F. Schwarz, Phys. Lett. A 116 (1986) 432: in space */
    {"quartic in space, 1:6:8", SPACE "(x^2 + y^2)^2 - 6*z^2*(x^2 + y^2) - 8*z^4\n", 3, 4},
    {"cubic in space, 16/3", SPACE "(x^2 + y^2)*z - 16*z^3/3\n", 3, 4},
    {"KdV5's Henon-Heiles system with c/x^2", "parameters: {A: 0.7, B: 1.2, c: 0.3}\n" PLANE "(A*x^2 + B*y^2)/2 - x^2*y - 2*y^3 - c/x^2\n" QUADRANT, 2, 6},
    /* S. Baker, V. Z. Enolskii and A. P. Fordy, Phys. Lett. A 201 (1995) 167 */
    {"quartic, 1:6:8, with a linear term", "parameters: {a: 0.4, c: 0.3}\n" PLANE "x^4 - 6*x^2*y^2 - 8*y^4 - a*(x^2 + 4*y^2) - c*y\n" QUADRANT, 2, 6},
    /* O. I. Bogoyavlensky, as above */
    {"Toda, A4, twisted", PLANE "exp(x - y) - exp(y) - exp(-2*x)\n", 2, 6},
    {"Toda, C2, periodic", PLANE "exp(x - y) - exp(2*y) - exp(-2*x)\n", 2, 6},
    /* E. G. Kalnins, J. M. Kress, W. Miller and P. Winternitz, J. Math. Phys. 44 (2003) 5811; E. G. Kalnins, W. Miller and G. S. Pogosyan, J. Math. Phys. 37 (1996) 6439 */
    {"Darboux's space I", "parameters: {a: 0.4, b: 0.7, c: 0.3}\ncoordinates: [u, v]\n"
     "lagrangian: 2*u*(u'^2 + v'^2) - a*(4*u^2 + v^2)/(4*u) - b/u - c/(u*v^2)\ndomain: {u: [0.5, 2], v: [0.5, 2]}\n", 3, 6},
    /* E. G. Kalnins, J. M. Kress, W. Miller and P. Winternitz, J. Math. Phys. 44 (2003) 5811: words with (x^2 + 1)^-n and x^-k are sums of fewer of them */
    {"Darboux's space II", "parameters: {a: 0.4, b: 0.3}\ncoordinates: [x, y]\n"
     "lagrangian: (x^2 + 1)/x^2*(x'^2 + y'^2)/2 - x^2/(x^2 + 1)*(a*(x^2/4 + y^2) + b*y)\n" QUADRANT, 3, 6},
    /* the same: exp(2 y) in integrals, which the equations do not contain */
    {"Darboux's space IV", "parameters: {b: 0.3}\ncoordinates: [x, y]\n"
     "lagrangian: (2*cos(2*x) + b)/sin(2*x)^2*(x'^2 + y'^2)/2\ndomain: {x: [0.2, 0.6]}\n", 3, 6},
    /* the plane in coordinates log r and angle: exp(x) cos(y), where the equations have exp(2 x) */
    {"plane, conformal coordinates", "coordinates: [x, y]\nlagrangian: exp(2*x)*(x'^2 + y'^2)/2\n", 3, 6},
    /* a particle on Martinet's distribution, and on one with a sine: incomplete beta functions, elliptic integrals */
    {"Martinet", "parameters: {m: 1.3, M: 0.6}\ncoordinates: [x, y, z]\nlagrangian: m*(x'^2 + y'^2)/2 + M*z'^2/2\nconstraints: [\"z' = y^2*x'\"]\n", 5, 4},
    {"particle on planes that turn", "parameters: {a: 0.7}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = sin(a*y)*x'\"]\n", 5, 4},
    /* E. T. Whittaker, Analytical Dynamics (1937), sec. 53: two centres in elliptic coordinates */
    {"two centres, elliptic coordinates", "parameters: {a: 0.3, b: 0.4}\ncoordinates: [u, v]\n"
     "lagrangian: (cosh(u)^2 - cos(v)^2)*(u'^2 + v'^2)/2 + (a*cosh(u) + b*cos(v))/(cosh(u)^2 - cos(v)^2)\ndomain: {u: [0.5, 2], v: [0.5, 2]}\n", 2, 6},
    /* on leaves of a constraint that can be integrated, whose constant stands in the coefficients: E. Rosochatius, Archiv der Mathematik und Physik 63 (1879) 411,
     * and C. Neumann, J. reine angew. Math. 56 (1859) 46; P. W. Higgs, J. Phys. A 12 (1979) 309 */
    {"Rosochatius, Cartesian", "parameters: {a: 0.7, b: 1.3, c: 2.1, e: 0.3, f: 0.4, g: 0.5}\ncoordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (a*x^2 + b*y^2 + c*z^2)/2 - e/x^2 - f/y^2 - g/z^2\n"
     "constraints: [\"x*x' + y*y' + z*z' = 0\"]\n" OCTANT, 3, 4},
    {"Neumann, Cartesian", "parameters: {a: 0.7, b: 1.3, c: 2.1}\ncoordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (a*x^2 + b*y^2 + c*z^2)/2\nconstraints: [\"x*x' + y*y' + z*z' = 0\"]\n" OCTANT, 3, 4},
    /* J. Moser, in: Dynamical Systems, Progress in Math. 8 (1980) 233: Uhlenbeck's integrals, which contain what the constraint keeps constant; and Jacobi's */
    {"Neumann, four coordinates", "parameters: {a: 1, b: 1.7, c: 2.6, e: 4}\ncoordinates: [x, y, z, u]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2 - (a*x^2 + b*y^2 + c*z^2 + e*u^2)/2\nconstraints: [\"x^2 + y^2 + z^2 + u^2 = 1\"]\n", 4, 4},
    {"geodesics of an ellipsoid, four coordinates", "parameters: {a: 1, b: 1.7, c: 2.6, e: 4}\ncoordinates: [x, y, z, u]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2\nconstraints: [\"x^2/a + y^2/b + z^2/c + u^2/e = 1\"]\n", 4, 4},
    /* S. Chandrasekhar, The Mathematical Theory of Black Holes (1983), sec. 40 */
    {"geodesics of Reissner and Nordstroem's metric", "parameters: {M: 0.2, q: 0.1}\ncoordinates: [T, r, {name: h, type: angle}, {name: p, type: angle}]\n"
     "lagrangian: (-(1 - 2*M/r + q^2/r^2)*T'^2 + r'^2/(1 - 2*M/r + q^2/r^2) + r^2*(h'^2 + sin(h)^2*p'^2))/2\ndomain: {r: [2, 3], h: [0.5, 2.5]}\n", 5, 2},
    {"Kepler on the sphere, Cartesian", "parameters: {k: 0.7}\ncoordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 + k*z/sqrt(x^2 + y^2)\nconstraints: [\"x*x' + y*y' + z*z' = 0\"]\n" OCTANT, 4, 4},
    /* H. V. McIntosh and A. Cisneros, J. Math. Phys. 11 (1970) 896 */
    {"MICZ-Kepler", "parameters: {k: 0.7, m: 0.4}\ncoordinates: [x, y, z]\ndefinitions: [\"r = sqrt(x^2 + y^2 + z^2)\"]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 + m*z*(x*y' - y*x')/(r*(x^2 + y^2)) + k/r - m^2/(2*r^2)\n" OCTANT, 5, 4},
    /* J. F. Carinena, M. F. Ranada, M. Santander and M. Senthilvelan, Nonlinearity 17 (2004) 1941 */
    {"oscillator with a mass that depends on the position", "parameters: {l: 0.3, a: 0.8}\ncoordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2 + l*(x*y' - y*x')^2)/(2*(1 + l*(x^2 + y^2))) - a^2*(x^2 + y^2)/(2*(1 + l*(x^2 + y^2)))\n", 3, 6},
    /* N. E. Zhukovsky, J. Russ. Phys.-Chem. Soc. 17 (1885) 81; V. Volterra, Acta Math. 22 (1899) 201 */
    {"gyrostat of Zhukovsky and Volterra", "parameters: {A: 1, B: 1.5, C: 2.2, l: 0.3, k: 0.2}\n" ANGLES BODY
     "lagrangian: (A*W1^2 + B*W2^2 + C*W3^2)/2 + l*W1 + k*W3\n" TURNED, 4, 4},
    /* P. W. Higgs and H. I. Leemon, J. Phys. A 12 (1979) 309 and 489: Kepler's problem in gnomonic coordinates */
    {"Kepler on the sphere, gnomonic", "parameters: {w: 0.7, K: 0.4}\ncoordinates: [x, y]\n"
     "lagrangian: ((1 + K*y^2)*x'^2 - 2*K*x*y*x'*y' + (1 + K*x^2)*y'^2)/(2*(1 + K*(x^2 + y^2))^2) + w/sqrt(x^2 + y^2)\n" QUADRANT, 3, 6},
    {"three inverse squares on the sphere", "parameters: {a: 0.4, b: 0.7, c: 0.3}\ncoordinates: [{name: th, type: angle}, {name: ph, type: angle}]\n"
     "lagrangian: (th'^2 + sin(th)^2*ph'^2)/2 - a/(sin(th)*cos(ph))^2 - b/(sin(th)*sin(ph))^2 - c/cos(th)^2\ndomain: {th: [0.4, 1.2], ph: [0.4, 1.2]}\n", 3, 6},
    /* A. Marchesiello and L. Snobl, J. Phys. A 50 (2017) 245202: a helical magnetic field */
    {"helical undulator", "parameters: {a: 0.6, k: 1.3}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 + a*(cos(k*z)*x' + sin(k*z)*y')\n", 4, 4},
    /* P. J. Redmond, Phys. Rev. 133 (1964) B1352; Y. Alhassid, E. A. Hinds and D. Meschede, Phys. Rev. Lett. 59 (1987) 1545 */
    {"Stark", "parameters: {k: 0.7, f: 0.3}\n" SPACE "0 + k/sqrt(x^2 + y^2 + z^2) - f*z\n" OCTANT, 3, 4},
    {"van der Waals, ratio 2", "parameters: {k: 0.7, c: 0.3}\n" SPACE "0 + k/sqrt(x^2 + y^2 + z^2) - c*(x^2 + y^2 + 4*z^2)\n" OCTANT, 3, 4},
    /* B. Carter, Phys. Rev. 174 (1968) 1559; B. Kruglikov and V. S. Matveev, Phys. Rev. D 85 (2012) 124057: none like Carter's */
    {"geodesics of Kerr's metric",
     "parameters: {M: 1, a: 0.6}\ncoordinates: [T, {name: r, type: length}, {name: th, type: angle}, {name: ph, type: angle}]\n"
     "definitions: [\"S = r^2 + a^2*cos(th)^2\", \"D = r^2 - 2*M*r + a^2\"]\n"
     "lagrangian: (-(1 - 2*M*r/S)*T'^2 - 4*M*a*r*sin(th)^2/S*T'*ph' + S/D*r'^2 + S*th'^2 + (r^2 + a^2 + 2*M*a^2*r*sin(th)^2/S)*sin(th)^2*ph'^2)/2\n"
     "domain: {r: [3, 6], th: [0.4, 1.2]}\n", 4, 3},
    {"geodesics of Zipoy and Voorhees' metric",
     "coordinates: [T, {name: x, type: length}, {name: y, type: length}, {name: ph, type: angle}]\n"
     "lagrangian: (-((x - 1)/(x + 1))^2*T'^2 + ((x + 1)/(x - 1))^2*((x^2 - 1)^4/(x^2 - y^2)^3*(x'^2/(x^2 - 1) + y'^2/(1 - y^2)) + (x^2 - 1)*(1 - y^2)*ph'^2))/2\n"
     "domain: {x: [2, 4], y: [-0.7, 0.7]}\n", 3, 3},
    /* S. A. Chaplygin, Mat. Sb. 28 (1911) 303: the centre of mass off the blade; frequencies in the angle that are roots */
    {"Chaplygin's sleigh", "parameters: {m: 1.3, J: 0.4, a: 0.5}\ncoordinates: [x, y, {name: f, type: angle}]\n"
     "lagrangian: m/2*((x' - a*f'*sin(f))^2 + (y' + a*f'*cos(f))^2) + J/2*f'^2\nconstraints: [\"x'*sin(f) = y'*cos(f)\"]\n", 3, 4},
    /* A. Cordani, L. Gy. Feher and P. A. Horvathy, Phys. Lett. B 201 (1988) 481: the motion of two monopoles, with a vector of Runge and Lenz's kind */
    {"Taub-NUT", "parameters: {m: 0.7, q: 0.4}\ncoordinates: [x, y, z]\ndefinitions: [\"r = sqrt(x^2 + y^2 + z^2)\"]\n"
     "lagrangian: (1 + m/r)*(x'^2 + y'^2 + z'^2)/2 + q*z/r*(x*y' - y*x')/(x^2 + y^2) - q^2*(1 + m/r)/(2*m^2)\ndomain: {x: [0.5, 1.5], y: [0.5, 1.5], z: [0.3, 1]}\n", 5, 4},
    /* O. I. Bogoyavlensky, as above */
    {"Toda, B3",
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - exp(x - y) - exp(y - z) - exp(z)\n", 2, 4},
    {"Toda, C3",
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - exp(x - y) - exp(y - z) - exp(2*z)\n", 2, 4},
    {"Toda, D3",
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - exp(x - y) - exp(y - z) - exp(y + z)\n", 3, 4},
    /* V. I. Inozemtsev, Commun. Math. Phys. 121 (1989) 629: two boundaries */
    {"Toda with two boundaries",
     "parameters: {a: 0.3, b: 0.4, c: 0.5, d: 0.2}\n"
     "coordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2)/2 - exp(x - y) - a*exp(y) - b*exp(2*y) - c*exp(-x) - d*exp(-2*x)\n", 2, 6},
    /* F. Tremblay, A. V. Turbiner and P. Winternitz, as above */
    {"Tremblay, Turbiner and Winternitz, k = 4",
     "parameters: {w: 0.8, a: 0.3, b: 0.5}\n"
     "coordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2 - w^2*r^2)/2 - (a/cos(4*th)^2 + b/sin(4*th)^2)/r^2\n"
     "domain: {r: [0.5, 2], th: [0.1, 0.3]}\n", 3, 6},
    {"Tremblay, Turbiner and Winternitz, k = 2, with a spring", "parameters: {m: 1.3, k: 2.1, a: 0.4, b: 0.7}\n"
     "coordinates: [{name: r, type: length}, {name: f, type: angle}]\n"
     "lagrangian: m*(r'^2 + r^2*f'^2)/2 - k*r^2/2 - (a/cos(2*f)^2 + b/sin(2*f)^2)/r^2\ndomain: {r: [0.5, 2], f: [0.2, 0.6]}\n", 4, 6},
    {"Tremblay, Turbiner and Winternitz, k = 1/2",
     "parameters: {w: 0.8, a: 0.3, b: 0.5}\n"
     "coordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2 - w^2*r^2)/2 - (a/cos(th/2)^2 + b/sin(th/2)^2)/r^2\n"
     "domain: {r: [0.5, 2], th: [0.4, 2.4]}\n", 4, 6},
    /* V. Perlick, Class. Quantum Grav. 9 (1992) 1009: Kepler's problem on a surface of constant curvature; two roots, each a power of r times the other */
    {"Perlick, first family",
     "parameters: {a: 0.4, k: 0.9}\ncoordinates: [r, {name: f, type: angle}]\n"
     "lagrangian: (r'^2/(1 + a*r^2) + r^2*f'^2)/2 - k*sqrt(1/r^2 + a)\ndomain: {r: [0.5, 2]}\n", 3, 6},
    /* H. Hartmann, Theor. Chim. Acta 24 (1972) 201; C. Quesne, J. Phys. A 21 (1988) 3093 */
    {"Hartmann",
     "parameters: {k: 0.7, a: 0.3, b: 0.2}\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - 0 + k/sqrt(x^2+y^2+z^2) - a/(x^2+y^2) - b*z/((x^2+y^2)*sqrt(x^2+y^2+z^2))\n"
     "domain: {x: [0.5, 2], y: [0.5, 2], z: [0.5, 2]}\n", 4, 4},
    {"oscillator in a ring",
     "parameters: {w: 0.7, a: 0.3, b: 0.2}\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - w^2*(x^2+y^2+z^2)/2 - a/(x^2+y^2) - b/z^2\n"
     "domain: {x: [0.5, 2], y: [0.5, 2], z: [0.5, 2]}\n", 5, 4},
    /* H. Bateman, Phys. Rev. 38 (1931) 815: a damped oscillator and its mirror image */
    {"Bateman",
     "parameters: {g: 0.3, k: 1.1}\n"
     "coordinates: [x, y]\n"
     "lagrangian: x'*y' + g/2*(x*y' - y*x') - k*x*y\n", 4, 6},
    /* F. J. Herranz, A. Ballesteros, M. Santander and T. Sanz-Gil, CRM Proc. 37 (2004) 75; E. G. Kalnins, W. Miller and G. S. Pogosyan, as above */
    {"oscillator on the sphere",
     "coordinates: [{name: r, type: angle}, {name: f, type: angle}]\n"
     "parameters: {w: 0.8}\n"
     "lagrangian: (r'^2 + sin(r)^2*f'^2)/2 - w^2*tan(r)^2/2\n"
     "domain: {r: [0.4, 1.2], f: [-1, 1]}\n", 3, 6},
    {"Smorodinsky and Winternitz on the sphere",
     "coordinates: [{name: r, type: angle}, {name: f, type: angle}]\n"
     "parameters: {w: 0.8, a: 0.3, b: 0.4}\n"
     "lagrangian: (r'^2 + sin(r)^2*f'^2)/2 - w^2*tan(r)^2/2 - (a/cos(f)^2 + b/sin(f)^2)/sin(r)^2\n"
     "domain: {r: [0.4, 1.2], f: [0.4, 1.1]}\n", 3, 6},
    {"Kepler on the hyperbolic plane",
     "coordinates: [r, {name: f, type: angle}]\n"
     "parameters: {k: 0.8}\n"
     "lagrangian: (r'^2 + sinh(r)^2*f'^2)/2 + k*cosh(r)/sinh(r)\n"
     "domain: {r: [0.4, 1.2], f: [-1, 1]}\n", 3, 6},
    {"Kepler on the sphere with two poles",
     "coordinates: [{name: r, type: angle}, {name: f, type: angle}]\n"
     "parameters: {k: 0.8, a: 0.3, b: 0.4}\n"
     "lagrangian: (r'^2 + sin(r)^2*f'^2)/2 + k*cos(r)/sin(r) - (a + b*cos(f))/(sin(f)^2*sin(r)^2)\n"
     "domain: {r: [0.4, 1.2], f: [0.4, 1.1]}\n", 3, 6},
    /* C. G. J. Jacobi, Gesammelte Werke IV (1886) 531: three bodies on a line, with forces like the inverse cube of the distance */
    {"Jacobi, three bodies",
     "parameters: {g: 0.4, h: 0.3, k: 0.9}\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g/(x-y)^2 - h/(y-z)^2 - k/(z-x)^2\n"
     "domain: {x: [0.2, 0.6], y: [1.5, 2], z: [4, 5]}\n", 5, 4},
    /* F. Calogero, J. Math. Phys. 12 (1971) 419; M. A. Olshanetsky and A. M. Perelomov, as above */
    {"Calogero, three bodies in a trap",
     "parameters: {w: 0.8, g: 0.4}\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - w^2*(x^2+y^2+z^2)/2 - g/(x-y)^2 - g/(y-z)^2 - g/(z-x)^2\n"
     "domain: {x: [0.2, 0.6], y: [1.5, 2], z: [4, 5]}\n", 6, 4},
    {"Sutherland, hyperbolic",
     "parameters: {g: 0.4}\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g/sinh(x - y)^2 - g/sinh(y - z)^2 - g/sinh(z - x)^2\n"
     "domain: {x: [0.1, 0.4], y: [0.8, 1.2], z: [1.8, 2.3]}\n", 4, 4},
    {"Sutherland, BC2",
     "parameters: {a: 0.4, b: 0.3, c: 0.5}\n"
     "coordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2)/2 - a/sin(x-y)^2 - a/sin(x+y)^2 - b/sin(x)^2 - b/sin(y)^2 - c/cos(x)^2 - c/cos(y)^2\n"
     "domain: {x: [0.2, 0.4], y: [0.8, 1.1]}\n", 2, 6},
    /* J. Hietarinta, Phys. Rep. 147 (1987) 87 */
    {"quartic, 1:6:1",
     "parameters: {a: 0.4, b: 0.7}\n"
     "coordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2)/2 - x^4 - 6*x^2*y^2 - y^4 - a*(x^2 + y^2) - b*x*y\n", 2, 6},
    /* Y. N. Fedorov, Vestn. Mosk. Univ. 44 (1989) no. 6, 38; N. E. Zhukovsky, as above */
    {"Veselova's gyrostat",
     "parameters: {A: 1.1, B: 1.7, C: 2.3, l: 0.4}\n"
     "coordinates: [{name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
     "definitions: [\"W1 = p'*sin(h)*sin(s) + h'*cos(s)\", \"W2 = p'*sin(h)*cos(s) - h'*sin(s)\", \"W3 = p'*cos(h) + s'\", g1 = sin(h)*sin(s), g2 = sin(h)*cos(s), g3 = cos(h)]\n"
     "lagrangian: (A*W1^2 + B*W2^2 + C*W3^2)/2 + l*W3\n"
     "constraints: [\"p' + s'*cos(h) = 0\"]\n"
     "domain: {h: [0.5, 1.3], p: [-0.7, 0.7], s: [-0.7, 0.7]}\n", 3, 4},
    {"Lagrange's gyrostat in a field that is not uniform",
     "parameters: {A: 1.1, C: 2.3, k: 0.4, u: 0.3, l: 0.2}\n"
     "coordinates: [{name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
     "definitions: [\"W1 = p'*sin(h)*sin(s) + h'*cos(s)\", \"W2 = p'*sin(h)*cos(s) - h'*sin(s)\", \"W3 = p'*cos(h) + s'\", g1 = sin(h)*sin(s), g2 = sin(h)*cos(s), g3 = cos(h)]\n"
     "lagrangian: A*(W1^2 + W2^2)/2 + C*W3^2/2 - k*g3 - u*g3^2 + l*W3\n"
     "domain: {h: [0.5, 1.3], p: [-0.7, 0.7], s: [-0.7, 0.7]}\n", 3, 4},
    /* A. Bravo-Doddoli and L. C. Garcia-Naranjo, Regul. Chaotic Dyn. 20 (2015) 497: a linear integral by an elliptic integral of the third kind */
    {"sleigh with a trailer on a skate",
     "parameters: {m: 1, I: 0.3, M: 0.9, J: 0.2, a: 0.4, b: 0.5}\n"
     "bodies:\n  - {name: one, mass: m, inertia: I}\n  - {name: two, mass: M, inertia: J, center: [-b, 0, 0]}\n"
     "joints:\n  - {type: planar, child: one, axis: z, coordinates: [x, y, h]}\n  - {type: revolute, parent: one, child: two, at: [-a, 0, 0], axis: z, coordinates: [q]}\n"
     "wheels:\n  - {type: knife-edge, body: one, axis: y}\n  - {type: knife-edge, body: two, at: [-b, 0, 0], axis: y}\n", 2, 3},
    /* M. Banados, C. Teitelboim and J. Zanelli, Phys. Rev. Lett. 69 (1992) 1849: six Killing fields with exponentials in both cyclic coordinates, and a root that
       cancels from the inertia's determinant; the sphere by its distance from an axis: a root with the sign that is real there */
    {"geodesics around a black hole in three dimensions", "parameters: {M: 0.8}\ncoordinates: [T, {name: r, type: length}, f]\n"
     "lagrangian: ((r^2 - M)*T'^2 - r'^2/(r^2 - M) - r^2*f'^2)/2\ndomain: {r: [1.5, 2.5]}\n", 5, 4},
    {"sphere by the distance from an axis", "parameters: {R: 1.3}\ncoordinates: [{name: r, type: length}, {name: f, type: angle}]\n"
     "lagrangian: (r'^2/(1 - r^2/R^2) + r^2*f'^2)/2\ndomain: {r: [0.3, 1]}\n", 3, 6},
    /* R. A. Fisher's metric on the probabilities of three events, a sphere in roots of the coordinates; two oscillators whose frequencies are roots of roots of numbers */
    {"probabilities of three events", "coordinates: [x, y]\nlagrangian: (x'^2/x + y'^2/y + (x' + y')^2/(1 - x - y))/8\ndomain: {x: [0.2, 0.4], y: [0.2, 0.4]}\n", 3, 6},
    {"coupled oscillators with numbers", "coordinates: [x, y]\nlagrangian: (x'^2 + x'*y' + 2*y'^2)/2 - (x^2 - x*y + 3*y^2)/2\n", 4, 6},
    /* R. de Ritis et al., Phys. Rev. D 42 (1990) 1091, with a constant potential: two oscillators upside down, by roots of the scale factor and
       exponentials of the field; a pendulum that falls, whose time is an elliptic integral times an integral that is a function of the others */
    {"scale factor and a scalar field", "parameters: {L: 0.3}\ncoordinates: [a, q]\nlagrangian: -3*a*a'^2 + a^3*q'^2/2 - L*a^3\ndomain: {a: [0.6, 1.4]}\n", 4, 6},
    {"pendulum on a falling support", "parameters: {m: 1, M: 3, l: 0.5, g: 1, I: 0.1}\ncoordinates: [y, {name: u, type: angle}]\n"
     "lagrangian: (m + M)*y'^2/2 + (I + m*l^2)*u'^2/2 + m*l*cos(u)*u'*y' - (m + M)*g*y - m*g*l*sin(u)\n", 4, 6},
    /* F. Fasso and N. Sansonetto, J. Nonlinear Sci. 26 (2016) 519: bodies on planes that turn */
    {"vertical disk on a turntable", "parameters: {m: 1, I: 0.3, J: 0.5, R: 0.4, W: 0.7}\ncoordinates: [x, y, {name: th, type: angle}, {name: ph, type: angle}]\n"
     "lagrangian: m/2*(x'^2 + y'^2) + J/2*th'^2 + I/2*ph'^2\nconstraints: [\"x' = R*cos(th)*ph' - W*y\", \"y' = R*sin(th)*ph' + W*x\"]\n", 5, 4},
    /* M. A. Olshanetsky and A. M. Perelomov, as above, written with hyperbolic functions; a sum of two pendulums, upside down, seen from x + y and x - y */
    {"Toda, A2, periodic, with a cosh", PLANE "exp(x) - 2*exp(-x/2)*cosh(sqrt(3)*y/2)\n", 2, 6},
    {"product of two cosh", PLANE "cosh(x)*cosh(y)\n", 2, 6},
    /* a linear integral by an exponential, an integrating factor */
    {"spin by a cosine of the place", "coordinates: [{name: h, type: angle}, {name: f, type: angle}, {name: s, type: angle}]\n"
     "lagrangian: (h'^2 + sin(h)^2*f'^2 + s'^2)/2\nconstraints: [\"s' = cos(h)*f'\"]\ndomain: {h: [0.5, 2.5]}\n", 2, 4},
    /* J. M. Osborne and D. V. Zenkov, Proc. 44th IEEE Conf. Decision and Control (2005) 1114: the speed along the blade follows by an arctangent of the mass's place */
    {"sleigh with a mass on a spring across it", "parameters: {m: 1, I: 0.5, M: 0.4, k: 2}\ncoordinates: [x, y, {name: th, type: angle}, s]\n"
     "lagrangian: m/2*(x'^2 + y'^2) + I/2*th'^2 + M/2*((x' - s'*sin(th) - s*cos(th)*th')^2 + (y' + s'*cos(th) - s*sin(th)*th')^2) - k/2*s^2\n"
     "constraints: [\"y'*cos(th) = x'*sin(th)\"]\n", 3, 3},
    /* J. Neimark and N. Fufaev, Dynamics of Nonholonomic Systems (1972), ch. III: a homogeneous ball on a sphere keeps its spin about the normal */
    {"ball on a sphere", "parameters: {m: 1, k: 0.4, r: 0.3, R: 1, g: 1}\n"
     "coordinates: [{name: th, type: angle}, {name: ph, type: angle}, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
     "definitions: [\"wx = h'*cos(p) + s'*sin(h)*sin(p)\", \"wy = h'*sin(p) - s'*sin(h)*cos(p)\", \"wz = p' + s'*cos(h)\"]\n"
     "lagrangian: m/2*(R+r)^2*(th'^2 + sin(th)^2*ph'^2) + k*m*r^2/2*(wx^2 + wy^2 + wz^2) - m*g*(R+r)*cos(th)\n"
     "constraints: [\"(R+r)*th' = r*(-wx*sin(ph) + wy*cos(ph))\", \"(R+r)*sin(th)*ph' = r*(-(wx*cos(ph) + wy*sin(ph))*cos(th) + wz*sin(th))\"]\n"
     "domain: {h: [0.5, 2.5], th: [0.4, 1.2]}\n", 3, 2},
    /* the places that a motion on a distribution of step 2 in four dimensions reaches: three of six are series, as integrals of 1/sqrt(1 + x^2 + x^4) */
    {"distribution with a quartic below the root", "coordinates: [x, y, z, w]\nlagrangian: (x'^2 + y'^2 + z'^2 + w'^2)/2\nconstraints: [\"z' = x*y'\", \"w' = x^2*y'\"]\n", 3, 3},
    /* controls: C. Stoermer 1907; G. W. Hill 1878; V. Szebehely 1967; M. C. Gutzwiller, J. Math. Phys. 14 (1973) 139; G. K. Savvidy, Phys. Lett. B 130 (1983) 303 */
    {"Stoermer", "coordinates: [{name: r, type: length}, {name: th, type: angle}, {name: ph, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2 + r^2*sin(th)^2*ph'^2)/2 + sin(th)^2/r*ph'\ndomain: {r: [0.5, 2], th: [0.4, 1.2]}\n", 2, 4},
    {"Hill", "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + x*y' - y*x' + 3*x^2/2 + 1/sqrt(x^2 + y^2)\n" QUADRANT, 1, 6},
    {"restricted three bodies", "parameters: {u: 0.2}\ncoordinates: [x, y]\n"
     "lagrangian: ((x' - y)^2 + (y' + x)^2)/2 + (1 - u)/sqrt((x + u)^2 + y^2) + u/sqrt((x - 1 + u)^2 + y^2)\ndomain: {x: [0.2, 0.5], y: [0.5, 1]}\n", 1, 6},
    {"anisotropic Kepler", "parameters: {u: 1.5}\n" PLANE "0 + 1/sqrt(x^2 + u*y^2)\n" QUADRANT, 1, 6},
    {"Yang and Mills", SPACE "(x^2*y^2 + y^2*z^2 + z^2*x^2)/2\n", 1, 4},
    /* O. I. Bogoyavlensky, as above: chains of one root more */
    {"Toda, A2, periodic", "parameters: {a: 0.7}\n" SPACE "a*exp(x - y) - a*exp(y - z) - a*exp(z - x)\n", 4, 4},
    {"Toda, B2, periodic", "parameters: {a: 0.7, b: 0.4, c: 0.9}\n" PLANE "a*exp(x - y) - b*exp(y) - c*exp(-x - y)\n", 2, 6},
    /* F. Tremblay, A. V. Turbiner and P. Winternitz, as above */
    {"Tremblay, Turbiner and Winternitz, k = 1",
     "parameters: {w: 0.8, a: 0.3, b: 0.5}\ncoordinates: [r, {name: th, type: angle}]\n"
     "lagrangian: (r'^2 + r^2*th'^2 - w^2*r^2)/2 - (a/cos(th)^2 + b/sin(th)^2)/r^2\ndomain: {r: [0.5, 2], th: [0.4, 1.1]}\n", 4, 6},
    /* A. V. Borisov and I. S. Mamaev, Regul. Chaotic Dyn. 13 (2008) 443: a ball that does not spin, its centre of mass at the distance l from its own */
    {"rubber ball with displaced centre",
     "parameters: {m: 1.3, A: 0.5, C: 0.7, r: 0.8, l: 0.3, g: 0.9}\n" BALL BODY
     "lagrangian: A*(W1^2 + W2^2)/2 + C*W3^2/2 + m*((x' + l*(h'*cos(h)*sin(p) + p'*sin(h)*cos(p)))^2 + (y' - l*(h'*cos(h)*cos(p) - p'*sin(h)*sin(p)))^2 + "
     "l^2*h'^2*sin(h)^2)/2 - m*g*l*cos(h)\nconstraints: [" ROLLS ", \"p' + s'*cos(h) = 0\"]\n" TURNED, 2, 2},
};
enum { PUBLISHED_COUNT = sizeof PUBLISHED / sizeof *PUBLISHED };

#endif
