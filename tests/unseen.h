/* unseen: systems that the catalogue does not have, one per weakness that strangers' systems have shown. */
#ifndef NH_TESTS_UNSEEN_H
#define NH_TESTS_UNSEEN_H

#include <stddef.h>

typedef struct {
    const char *name, *text;
    size_t independent; /* how many there are to be found, and no more */
} unseen;

static const unseen UNSEEN[] = {
    /* (R - r)/|R - r| is constant wherever it is smooth, and was taken for an integral */
    {"torus given by an equation",
     "parameters: [{name: R, value: 2}, {name: a, value: 0.7}, {name: g, value: 1}]\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g*z\n"
     "constraints: ['(sqrt(x^2 + y^2) - R)^2 + z^2 = a^2']\n"
     "domain: {x: [0.5, 2], y: [0.5, 2]}\n"
     "known: {currents: [{name: turning, expr: \"x*y' - y*x'\"}, {name: energy, expr: \"x'^2 + y'^2 + z'^2 + 2*g*z\"}]}\n",
     3},
    /* frequencies (B +- sqrt(B^2 - 2 w^2))/2, which no product of parameters is */
    {"Penning trap",
     "parameters: [{name: w, value: 1.5}, {name: B, value: 4}]\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 + B/2*(x*y' - y*x') - w^2/2*(z^2 - (x^2 + y^2)/2)\n"
     "known: {currents: [{name: axial, expr: \"z*cos(w*t) - z'/w*sin(w*t)\"}, {name: turning, expr: \"x*y' - y*x' + B/2*(x^2 + y^2)\"}]}\n",
     6},
    {"chain of four rotors",
     "parameters: [{name: J, value: 0.3}, {name: k, value: 2}]\n"
     "coordinates: [a, b, c, d]\n"
     "lagrangian: J/2*(a'^2 + b'^2 + c'^2 + d'^2) - k/2*((a - b)^2 + (b - c)^2 + (c - d)^2)\n"
     "known: {currents: [{name: momentum, expr: \"a' + b' + c' + d'\"}, {name: mode, expr: \"J*(a' - b' - c' + d')^2 + 2*k*(a - b - c + d)^2\"}]}\n",
     8},
    /* th' is conserved by itself, and was left in the other currents with a number for which there is no reason */
    {"skate on a moving belt",
     "parameters: [{name: m, value: 1}, {name: J, value: 0.5}, {name: V, value: 0.7}]\n"
     "coordinates: [x, y, {name: th, type: angle}]\n"
     "lagrangian: m/2*(x'^2 + y'^2) + J/2*th'^2\n"
     "constraints: [\"(x' - V)*sin(th) = y'*cos(th)\"]\n"
     "known: {currents: [{name: turning, expr: th'}, {name: moving energy, expr: \"m/2*(x'^2 + y'^2) + J/2*th'^2 - m*V*x'\"}]}\n",
     5},
    /* small masses, fast motions: an electron and a proton in SI units */
    {"hydrogen in SI units",
     "parameters: [{name: m, value: 9.1e-31}, {name: k, value: 8.99e9}, {name: e, value: 1.6e-19}]\n"
     "coordinates: [x, y]\n"
     "lagrangian: m/2*(x'^2 + y'^2) + k*e^2/sqrt(x^2 + y^2)\n"
     "domain: {x: [0.5e-10, 1.5e-10], y: [-1e-10, 1e-10]}\n"
     "known: {currents: [{name: energy, expr: \"m/2*(x'^2 + y'^2) - k*e^2/sqrt(x^2 + y^2)\"}, {name: turning, expr: \"x*y' - y*x'\"}]}\n",
     3},
    /* at rest there is no force: the rate is that of the gyroscopic one */
    {"electron in a magnetic field in SI units",
     "parameters: [{name: m, value: 9.1e-31}, {name: q, value: 1.6e-19}, {name: B, value: 0.5}]\n"
     "coordinates: [x, y]\n"
     "lagrangian: m/2*(x'^2 + y'^2) + q*B*(x*y' - y*x')/2\n"
     "known: {currents: [{name: centre, expr: \"m*x' - q*B*y\"}, {name: energy, expr: \"m/2*(x'^2 + y'^2)\"}]}\n",
     4},
    {"stiff spring",
     "parameters: [{name: m, value: 1e-9}, {name: k, value: 1}]\n"
     "coordinates: [x, y]\n"
     "lagrangian: m/2*(x'^2 + y'^2) - k/2*(x^2 + y^2)\n"
     "known: {currents: [{name: turning, expr: \"x*y' - y*x'\"}, {name: phase, expr: \"x*cos(sqrt(k/m)*t) - x'*sqrt(m/k)*sin(sqrt(k/m)*t)\"}]}\n",
     4},
    /* combinations with a number for a frequency cancel to 10 digits: they were counted */
    {"Smorodinsky and Winternitz with couplings far apart",
     "parameters: [{name: k, value: 1}, {name: a, value: 1e-6}, {name: b, value: 1e6}]\n"
     "coordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2)/2 - k/2*(x^2 + y^2) - a/x^2 - b/y^2\n"
     "domain: {x: [0.5, 1.5], y: [0.5, 1.5]}\n"
     "known: {currents: [{name: one, expr: \"y'^2/2 + k/2*y^2 + b/y^2\"}, {name: breath, expr: \"(y'^2/2 + b/y^2 - k/2*y^2)*cos(2*sqrt(k)*t) + sqrt(k)*y*y'*sin(2*sqrt(k)*t)\"}]}\n",
     4},
    /* driven by forces that are no part of the Lagrangian */
    {"cart with a pendulum and a motor",
     "parameters: {M: 2, m: 0.5, l: 0.7, g: 9.81, F: 0.4, w: 2}\n"
     "coordinates: [x, {name: a, type: angle}]\n"
     "lagrangian: (M + m)*x'^2/2 + m*l*x'*a'*cos(a) + m*l^2*a'^2/2 + m*g*l*cos(a)\n"
     "forces: [x = F*cos(w*t)]\n"
     "known: {currents: [{name: momentum, expr: \"(M + m)*x' + m*l*a'*cos(a) - F*sin(w*t)/w\"},"
     " {name: centre of mass, expr: \"(M + m)*(x - t*x') + m*l*(sin(a) - t*a'*cos(a)) + F*(t*sin(w*t)/w + cos(w*t)/w^2)\"}]}\n",
     2},
    /* powers of t that nothing needs are nearly dependent on the functions that something does */
    {"pull that decays and pull that grows",
     "parameters: {M: 2, F: 0.4, w: 2, g: 9.81}\n"
     "coordinates: [x, y]\n"
     "lagrangian: M*(x'^2 + y'^2)/2 - M*g*y\n"
     "forces: [x = F*exp(-w*t), y = F*t^3]\n"
     "known: {currents: [{name: along x, expr: \"M*x' + F*exp(-w*t)/w\"}, {name: along y, expr: \"M*(y - t*y') - M*g*t^2/2 + F*t^5/5\"}]}\n",
     4},
    {"two driving frequencies",
     "parameters: {m: 1, A: 0.3, B: 0.5, w: 2, u: 3.3}\n"
     "coordinates: [x, y]\n"
     "lagrangian: m*(x'^2 + y'^2)/2 + A*x*cos(w*t) + B*y*sin(u*t)\n"
     "known: {currents: [{name: along x, expr: \"m*x' - A*sin(w*t)/w\"}, {name: along y, expr: \"m*y' + B*cos(u*t)/u\"}]}\n",
     4},
    /* a mass that changes: log(m0 - b t); many smooth functions on a short interval hid it, and left coefficients of 1e-134 */
    {"mass that is burnt",
     "parameters: {m0: 3, b: 0.4, g: 9.81}\n"
     "coordinates: [x, y]\n"
     "lagrangian: (m0 - b*t)*(x'^2 + y'^2)/2 - (m0 - b*t)*g*y\n"
     "known: {currents: [{name: along x, expr: \"(m0 - b*t)*x'\"}, {name: start of x, expr: \"b*x + (m0 - b*t)*x'*log(m0 - b*t)\"},"
     " {name: along y, expr: \"(m0 - b*t)*y' + g*(m0*t - b*t^2/2)\"}]}\n",
     4},
    {"pull that fades like 1/t",
     "parameters: {M: 2, F: 0.4}\n"
     "coordinates: [x]\n"
     "lagrangian: M*x'^2/2\n"
     "forces: [x = F/(1 + t)]\n"
     "known: {currents: [{name: momentum, expr: \"M*x' - F*log(1 + t)\"}]}\n",
     2},
    /* rotations in disguise */
    {"sphere in Mercator's coordinates",
     "coordinates: [u, {name: ph, type: angle}]\n"
     "lagrangian: (u'^2 + ph'^2)/(2*cosh(u)^2)\n"
     "known: {currents: [{name: about z, expr: ph'/cosh(u)^2}, {name: about x, expr: \"(cos(ph)*u'*cosh(u) + sin(ph)*sinh(u)*ph')/cosh(u)^2\"}]}\n",
     4},
    {"stereographic sphere",
     "coordinates: [x, y]\n"
     "lagrangian: 2*(x'^2 + y'^2)/(1 + x^2 + y^2)^2\n"
     "known: {currents: [{name: turning, expr: \"(x*y' - y*x')/(1 + x^2 + y^2)^2\"}, {name: tilting, expr: \"((1 + x^2 - y^2)*x' + 2*x*y*y')/(1 + x^2 + y^2)^2\"}]}\n",
     3},
    {"Kepler on the sphere",
     "parameters: [{name: k, value: 0.9}]\n"
     "coordinates: [{name: th, type: angle}, {name: ph, type: angle}]\n"
     "lagrangian: (th'^2 + sin(th)^2*ph'^2)/2 + k*cos(th)/sin(th)\n"
     "domain: {th: [0.5, 1.4]}\n"
     "known: {currents: [{name: Runge-Lenz, expr: \"sin(th)^2*ph'*(cos(ph)*sin(th)*cos(th)*ph' + sin(ph)*th') - k*cos(ph)\"}]}\n",
     3},
    {"plane in elliptic coordinates",
     "parameters: [{name: c, value: 1}]\n"
     "coordinates: [u, v]\n"
     "lagrangian: c^2*(cosh(u)^2 - cos(v)^2)*(u'^2 + v'^2)/2\n"
     "domain: {u: [0.5, 1.5], v: [0.5, 1.5]}\n"
     "known: {currents: [{name: px, expr: \"sinh(u)*cos(v)*u' - cosh(u)*sin(v)*v'\"}, {name: py, expr: \"cosh(u)*sin(v)*u' + sinh(u)*cos(v)*v'\"}]}\n",
     4},
    /* integrals of degree two to four */
    {"swinging Atwood machine",
     "parameters: [{name: m, value: 1}, {name: g, value: 1.7}]\n"
     "coordinates: [{name: r, type: length}, {name: th, type: angle}]\n"
     "lagrangian: m/2*(4*r'^2 + r^2*th'^2) - m*g*r*(3 - cos(th))\n"
     "domain: {r: [0.5, 1.5]}\n"
     "known: {currents: [{name: Tufillaro, expr: \"r^2*th'*(2*r'*cos(th/2) - r*th'*sin(th/2)) + 2*g*r^2*sin(th/2)*cos(th/2)^2\"}]}\n",
     2},
    {"quartic oscillator 1:6:8",
     "coordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2)/2 - (x^4 + 6*x^2*y^2 + 8*y^4)\n"
     "known: {currents: [{name: quartic, expr: \"x'^4 + 4*(x^4 + 6*x^2*y^2)*x'^2 - 16*x^3*y*x'*y' + 4*x^4*y'^2 + 4*x^8 + 16*x^6*y^2 + 16*x^4*y^4\"}]}\n",
     2},
    {"Fokas and Lagerstrom",
     "coordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2)/2 - (x^2 - y^2)^(-2/3)\n"
     "domain: {x: [1.5, 2.5], y: [-0.5, 0.5]}\n"
     "known: {currents: [{name: cubic, expr: \"(x*y' - y*x')*(x'^2 - y'^2) - 4*(x'*y + y'*x)*(x^2 - y^2)^(-2/3)\"}]}\n",
     2},
    {"disc rolling on a slope",
     "parameters: [{name: m, value: 1}, {name: I, value: 0.4}, {name: J, value: 0.2}, {name: R, value: 0.6}, {name: f, value: 1.9}]\n"
     "coordinates: [x, y, {name: th, type: angle}, {name: ph, type: angle}]\n"
     "lagrangian: m/2*(x'^2 + y'^2) + I/2*th'^2 + J/2*ph'^2 + m*f*x\n"
     "constraints: [\"x' = R*th'*cos(ph)\", \"y' = R*th'*sin(ph)\"]\n"
     "known: {currents: [{name: product, expr: \"(m*R^2 + I)*th'*ph' - m*f*R*sin(ph)\"}]}\n",
     6},
    /* explicit time */
    {"driven oscillator",
     "parameters: [{name: w, value: 1.4}, {name: f, value: 0.5}, {name: W, value: 2.3}]\n"
     "coordinates: [x]\n"
     "lagrangian: x'^2/2 - w^2/2*x^2 + f*cos(W*t)*x\n"
     "known: {currents: [{name: phase, expr: \"(x - f/(w^2 - W^2)*cos(W*t))*cos(w*t) - (x' + f*W/(w^2 - W^2)*sin(W*t))/w*sin(w*t)\"}]}\n",
     2},
    {"crossed fields",
     "parameters: [{name: B, value: 0.9}, {name: F, value: 0.5}]\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 + B*x*y' + F*y\n"
     "known: {currents: [{name: phase, expr: \"(x' - F/B)*cos(B*t) - y'*sin(B*t)\"}]}\n",
     6},
    {"Emden and Fowler",
     "coordinates: [x]\n"
     "lagrangian: x'^2/2 - t^-5*x^3/3\n"
     "domain: {t: [0.5, 1.5]}\n"
     "known: {currents: [{name: dilation, expr: \"t^2*x'^2 - 2*t*x*x' + x^2 + 2/3*t^-3*x^3\"}]}\n",
     1},
    {"force that grows like t^2",
     "coordinates: [x]\n"
     "lagrangian: x'^2/2 - x*t^2\n"
     "known: {currents: [{name: momentum, expr: x' + t^3/3}, {name: start, expr: x - t*x' - t^4/4}]}\n",
     2},
    {"growing mass",
     "coordinates: [x]\n"
     "lagrangian: t^2*(x'^2 - x^2)/2\n"
     "domain: {t: [0.5, 1.5]}\n"
     "known: {currents: [{name: phase, expr: (t*x' + x)*cos(t) + t*x*sin(t)}]}\n",
     2},
    {"falling with friction quadratic in the velocity",
     "parameters: [{name: k, value: 0.5}, {name: g, value: 2}]\n"
     "coordinates: [x]\n"
     "lagrangian: x'^2/2 + g*x\n"
     "forces: [\"x = -k*x'^2\"]\n"
     "known: {currents: [{name: energy of a kind, expr: (x'^2 - g/k)*exp(2*k*x)}]}\n",
     2},
    {"Kepler's problem in logarithmic polar coordinates",
     "parameters: [{name: k, value: 1}]\n"
     "coordinates: [a, {name: b, type: angle}]\n"
     "lagrangian: exp(2*a)*(a'^2 + b'^2)/2 + k*exp(-a)\n"
     "known: {currents: [{name: Runge-Lenz, expr: exp(3*a)*b'*(sin(b)*a' + cos(b)*b') - k*cos(b)}]}\n",
     4},
    {"thermostat",
     "parameters: [{name: k, value: 0.8}, {name: K, value: 1}]\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - k/2*(x^2 + y^2 + z^2)\n"
     "constraints: [\"x'^2 + y'^2 + z'^2 = 2*K\"]\n"
     "known: {currents: [{name: turning, expr: \"(x*y' - y*x')*exp(-k*(x^2 + y^2 + z^2)/(4*K))\"}]}\n",
     3},
    {"an oscillator with an inverse square breathes",
     "parameters: [{name: k, value: 0.8}, {name: w, value: 1.1}]\n"
     "coordinates: [{name: x, type: length}]\n"
     "lagrangian: x'^2/2 - k/x^2 - w^2/2*x^2\n"
     "domain: {x: [0.5, 1.5]}\n"
     "known: {currents: [{name: E, expr: \"x'^2/2 + k/x^2 + w^2/2*x^2\"}, {name: breath, expr: \"(x'^2/2 + k/x^2 - w^2/2*x^2)*cos(2*w*t) + w*x*x'*sin(2*w*t)\"}]}\n",
     2},
    /* what turns and what decays: rates in t of squares and cubes */
    {"Kepler's problem in a turning frame",
     "parameters: [{name: k, value: 1}, {name: W, value: 0.6}]\n"
     "coordinates: [x, y]\n"
     "lagrangian: ((x' - W*y)^2 + (y' + W*x)^2)/2 + k/sqrt(x^2 + y^2)\n"
     "domain: {x: [0.5, 1.5]}\n"
     "known: {currents: [{name: turn, expr: \"x*(y' + W*x) - y*(x' - W*y)\"}, {name: energy, expr: \"((x' - W*y)^2 + (y' + W*x)^2)/2 - k/sqrt(x^2 + y^2)\"}, {name: ecc, expr: \"((x*(y' + W*x) - y*(x' - W*y))*(y' + W*x) - k*x/sqrt(x^2+y^2))*cos(W*t) - (-(x*(y' + W*x) - y*(x' - W*y))*(x' - W*y) - k*y/sqrt(x^2+y^2))*sin(W*t)\"}]}\n",
     3},
    {"Kepler's problem with linear drag",
     "parameters: [{name: k, value: 1}, {name: c, value: 0.3}]\n"
     "coordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2)/2 + k/sqrt(x^2 + y^2)\n"
     "forces: [\"x = -c*x'\", \"y = -c*y'\"]\n"
     "domain: {x: [0.5, 1.5]}\n"
     "known: {currents: [{name: turn, expr: \"(x*y' - y*x')*exp(c*t)\"}]}\n",
     1},
    /* the covectors of translations are simple there, their fields are not */
    {"oscillator in elliptic coordinates",
     "parameters: [{name: w, value: 1.2}]\n"
     "coordinates: [mu, nu]\n"
     "lagrangian: (cosh(mu)^2 - cos(nu)^2)*(mu'^2 + nu'^2)/2 - w^2/2*(cosh(mu)^2*cos(nu)^2 + sinh(mu)^2*sin(nu)^2)\n"
     "domain: {mu: [0.5, 1.5], nu: [0.5, 1.5]}\n"
     "known: {currents: [{name: phase, expr: \"cosh(mu)*cos(nu)*cos(w*t) - (sinh(mu)*cos(nu)*mu' - cosh(mu)*sin(nu)*nu')/w*sin(w*t)\"}, {name: ang, expr: \"sin(nu)*cos(nu)*mu' + sinh(mu)*cosh(mu)*nu'\"}]}\n",
     4},
    {"parabolic cylinder coordinates",
     "coordinates: [{name: u, type: length}, {name: v, type: length}, {name: z, type: length}]\n"
     "lagrangian: ((u^2 + v^2)*(u'^2 + v'^2) + z'^2)/2 - z^2/2\n"
     "domain: {u: [0.5, 1.5], v: [0.3, 1.2]}\n"
     "known: {currents: [{name: px, expr: \"u*u' - v*v'\"}, {name: py, expr: \"u*v' + v*u'\"}, {name: pz, expr: \"z*cos(t) - z'*sin(t)\"}]}\n",
     6},
    /* separates; among all squares of momenta what does is nearly dependent */
    {"two centres in spheroidal coordinates",
     "parameters: [{name: k1, value: 1}, {name: k2, value: 0.6}]\n"
     "coordinates: [{name: xi, type: length}, {name: eta, type: length}, {name: ph, type: angle}]\n"
     "lagrangian: ((xi^2 - eta^2)*(xi'^2/(xi^2 - 1) + eta'^2/(1 - eta^2)) + (xi^2 - 1)*(1 - eta^2)*ph'^2)/2 + (k1*(xi - eta) + k2*(xi + eta))/(xi^2 - eta^2)\n"
     "domain: {xi: [1.2, 2.5], eta: [-0.8, 0.8]}\n"
     "known: {currents: [{name: sep, expr: \"(1 - eta^2)*((xi^2-eta^2)*eta'/(1 - eta^2))^2 + ((xi^2 - 1)*(1 - eta^2)*ph')^2/(1 - eta^2) + 2*(k1 - k2)*eta + 2*eta^2*(((xi^2 - eta^2)*(xi'^2/(xi^2 - 1) + eta'^2/(1 - eta^2)) + (xi^2 - 1)*(1 - eta^2)*ph'^2)/2 - k1/(xi + eta) - k2/(xi - eta))\"}]}\n",
     3},
    {"Kepler's problem of a monopole",
     "parameters: [{name: g, value: 0.7}, {name: k, value: 1.1}]\n"
     "coordinates: [x, y, z]\n"
     "definitions: [\"R = sqrt(x^2 + y^2 + z^2)\"]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 + g*z/R*(x*y' - y*x')/(x^2 + y^2) + k/R - g^2/(2*R^2)\n"
     "domain: {x: [0.5, 1.5], y: [0.3, 1.2]}\n"
     "known: {currents: [{name: Jz, expr: \"x*y' - y*x' + g*z/R\"}, {name: Jx, expr: \"y*z' - z*y' + g*x/R\"}, {name: energy, expr: \"x'^2 + y'^2 + z'^2 - 2*k/R + g^2/R^2\"}, {name: Az, expr: \"x'*(z*x' - x*z' + g*y/R) - y'*(y*z' - z*y' + g*x/R) - k*z/R\"}]}\n",
     5},
    /* a rotor adds to the momenta of the isometries, and the component of gravity along it to what has weight two */
    {"gyrostat of Zhukovskii and Volterra",
     "parameters: [{name: A, value: 1}, {name: B, value: 1.6}, {name: C, value: 2.1}, {name: k1, value: 0.3}, {name: k3, value: 0.8}]\n"
     "coordinates: [{name: psi, type: angle}, {name: th, type: angle}, {name: ph, type: angle}]\n"
     "definitions:\n"
     "  - p = psi'*sin(th)*sin(ph) + th'*cos(ph)\n"
     "  - q = psi'*sin(th)*cos(ph) - th'*sin(ph)\n"
     "  - r = psi'*cos(th) + ph'\n"
     "lagrangian: (A*p^2 + B*q^2 + C*r^2)/2 + k1*p + k3*r\n"
     "domain: {th: [0.4, 2.7]}\n"
     "known: {currents: [{name: energy, expr: \"A*p^2 + B*q^2 + C*r^2\"}, {name: total, expr: \"(A*p + k1)^2 + B^2*q^2 + (C*r + k3)^2\"}, {name: vertical, expr: \"(A*p + k1)*sin(th)*sin(ph) + B*q*sin(th)*cos(ph) + (C*r + k3)*cos(th)\"}, {name: x, expr: \"(A*p + k1)*(cos(ph)*cos(psi) - sin(ph)*cos(th)*sin(psi)) + B*q*(-sin(ph)*cos(psi) - cos(ph)*cos(th)*sin(psi)) + (C*r + k3)*sin(th)*sin(psi)\"}]}\n",
     4},
    {"Kovalevskaya's gyrostat",
     "parameters: [{name: c, value: 1}, {name: kap, value: 0.5}]\n"
     "coordinates: [{name: psi, type: angle}, {name: th, type: angle}, {name: ph, type: angle}]\n"
     "definitions:\n"
     "  - p = psi'*sin(th)*sin(ph) + th'*cos(ph)\n"
     "  - q = psi'*sin(th)*cos(ph) - th'*sin(ph)\n"
     "  - r = psi'*cos(th) + ph'\n"
     "lagrangian: p^2 + q^2 + r^2/2 + kap*r - c*sin(th)*sin(ph)\n"
     "domain: {th: [0.4, 2.7]}\n"
     "known: {currents: [{name: energy, expr: \"p^2 + q^2 + r^2/2 + c*sin(th)*sin(ph)\"}]}\n",
     3},
    {"friction that falls with the distance",
     "coordinates: [x]\n"
     "lagrangian: x'^2/2\n"
     "forces: [\"x = -x'/(1 + x^2)\"]\n"
     "known: {currents: [{name: v, expr: \"x' + atan(x)\"}]}\n",
     1},
    {"a hidden constraint with an arc tangent and a logarithm",
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2\n"
     "constraints: [\"y' = x'/(1 + x^2) + z'/(z + 3)\"]\n"
     "known: {currents: [{name: hidden, expr: y - atan(x) - log(z + 3)}]}\n",
     2},
    /* turns with an irrational multiple of an angle that is not cyclic, beside three others */
    {"ball on a lying cylinder",
     "parameters: [{name: k, value: 0.4}, {name: a, value: 0.2}, {name: R, value: 1}, {name: g, value: 9.8}]\n"
     "coordinates: [{name: ph, type: angle}, {name: z, type: length}, {name: al, type: angle}, {name: be, type: angle}, {name: ga, type: angle}]\n"
     "definitions:\n"
     "  - w1 = be'*cos(al) + ga'*sin(be)*sin(al)\n"
     "  - w2 = be'*sin(al) - ga'*sin(be)*cos(al)\n"
     "  - w3 = al' + ga'*cos(be)\n"
     "lagrangian: ((R + a)^2*ph'^2 + z'^2)/2 + k*a^2/2*(w1^2 + w2^2 + w3^2) - g*(R + a)*sin(ph)\n"
     "constraints: [\"(R + a)*ph' = a*w3\", \"z' = a*(w1*sin(ph) - w2*cos(ph))\"]\n"
     "domain: {be: [0.4, 2.7]}\n"
     "known: {currents: [{name: square, expr: \"k*(w1*cos(ph) + w2*sin(ph))^2 + (k + 1)*z'^2/a^2\"}]}\n",
     3},
    /* the centre of mass of a chain of bodies: a product of harmonics of three angles */
    {"a free-flying arm",
     "bodies:\n"
     "  - {name: base, mass: 10, inertia: 1.2}\n"
     "  - {name: link1, mass: 2, inertia: 0.2, center: [0.5, 0, 0]}\n"
     "  - {name: link2, mass: 1, inertia: 0.1, center: [0.4, 0, 0]}\n"
     "joints:\n"
     "  - {type: planar, child: base, axis: z, coordinates: [x, y, th]}\n"
     "  - {type: revolute, parent: base, child: link1, at: [0.3, 0, 0], axis: z, coordinates: [q1]}\n"
     "  - {type: revolute, parent: link1, child: link2, at: [1, 0, 0], axis: z, coordinates: [q2]}\n"
     "known: {currents: [{name: centre, expr: \"10*x + 2*(x + 0.3*cos(th) + 0.5*cos(th + q1)) + x + 0.3*cos(th) + cos(th + q1) + 0.4*cos(th + q1 + q2) - t*(10*x' + 2*(x' - 0.3*sin(th)*th' - 0.5*sin(th + q1)*(th' + q1')) + x' - 0.3*sin(th)*th' - sin(th + q1)*(th' + q1') - 0.4*sin(th + q1 + q2)*(th' + q1' + q2'))\"}]}\n",
     6},
    /* the constraints' determinant is small on much of the domain: doubles lose all digits of the energy's rate */
    {"three-wheeled scooter",
     "parameters: [{name: M, value: 2}, {name: J, value: 0.7}, {name: J1, value: 0.1}, {name: l, value: 0.5}, {name: c, value: 0.3}]\n"
     "coordinates: [x, y, {name: th, type: angle}, {name: a, type: angle}, {name: b, type: angle}]\n"
     "lagrangian: M/2*(x'^2 + y'^2) + J/2*th'^2 + J1/2*((th' + a')^2 + (th' + b')^2)\n"
     "constraints: [\"(x' + c*th'*sin(th))*sin(th + a) = (y' - c*th'*cos(th))*cos(th + a) + l*(th' + a')\", \"(x' - c*th'*sin(th))*sin(th + b) = (y' + c*th'*cos(th))*cos(th + b) + l*(th' + b')\"]\n"
     "known: {currents: [{name: energy, expr: \"M/2*(x'^2 + y'^2) + J/2*th'^2 + J1/2*((th' + a')^2 + (th' + b')^2)\"}]}\n",
     1},
    /* the momenta had numbers instead of masses as coefficients, and held for the masses of the file only */
    {"three bodies",
     "parameters: {G: 1, m1: 1.3, m2: 1.6, m3: 1.9}\n"
     "coordinates: [x1, y1, z1, x2, y2, z2, x3, y3, z3]\n"
     "lagrangian: m1/2*(x1'^2 + y1'^2 + z1'^2) + m2/2*(x2'^2 + y2'^2 + z2'^2) + m3/2*(x3'^2 + y3'^2 + z3'^2)"
     " + G*m1*m2/sqrt((x1 - x2)^2 + (y1 - y2)^2 + (z1 - z2)^2) + G*m1*m3/sqrt((x1 - x3)^2 + (y1 - y3)^2 + (z1 - z3)^2)"
     " + G*m2*m3/sqrt((x2 - x3)^2 + (y2 - y3)^2 + (z2 - z3)^2)\n"
     "known: {currents: [{name: centre, expr: \"m1*x1 + m2*x2 + m3*x3 - t*(m1*x1' + m2*x2' + m3*x3')\"}]}\n",
     10},
    /* velocities in denominators, and kinks: each is found by a row of the search of its own */
    {"modified Emden equation",
     "coordinates: [x]\n"
     "lagrangian: 1/(x' + x^2)\n"
     "domain: {x: [0.5, 1.5]}\n"
     "known: {currents: [{name: time, expr: \"t - x/(x' + x^2)\"}]}\n",
     2},
    /* cos t has no parameter, and was taken for a wave of a coordinate; two waves together are nearly dependent for t in [0, 1] */
    {"oscillators, one of them driven by cos t",
     "coordinates: [x, y]\n"
     "lagrangian: (x'^2 + y'^2)/2 - (2*x^2 + 3*y^2)/2 + x*cos(t)\n"
     "known: {currents: [{name: driven, expr: \"(x - cos(t))*cos(sqrt(2)*t) - (x' + sin(t))/sqrt(2)*sin(sqrt(2)*t)\"}]}\n",
     4},
    {"lengths that are logarithms",
     "coordinates: [{name: x, type: length}, {name: y, type: length}]\n"
     "lagrangian: (x'^2/x^2 + y'^2/y^2)/2\n"
     "domain: {x: [0.5, 1.5], y: [0.5, 1.5]}\n"
     "known: {currents: [{name: rotation, expr: \"log(x)*y'/y - log(y)*x'/x\"}]}\n",
     4},
    /* sin(2 pi/3) is a number */
    /* x' sin(x) is a total derivative: the momentum of x is not constant, its part with x' is */
    {"a momentum beside a total derivative",
     "coordinates: [{name: q, type: angle}, x, {name: p, type: angle}, y]\n"
     "lagrangian: 0.82*cos(q) - 0.46*sin(p) + 1.47*sin(y) + 0.69*cos(0.43*t)*cos(2*p) + 0.39*q'^2 + x'^2*(0.59*sin(y)^2 + 0.42)/2 + 0.81*p'^2 + 0.445*y'^2 + 1.98*x'*sin(x)\n"
     "constraints: [\"y' = 0.97*sin(0.54*t) + 1.05*p'*(t + 1)*sin(p)\"]\n", 2},
    /* integrable: 1/x, which the equations do not contain, goes linearly with p */
    {"an integrable constraint with x^2",
     "coordinates: [{name: p, type: angle}, x]\nlagrangian: 0.94*x'^2 - 2.82*x + 0.69*x'*cos(0.51*t - p) + 3.26*x*x' + 0.58*(10*p' - 5.1)^2\n"
     "constraints: [\"x' = 7*x^2*(51 - 100*p')/625\"]\n", 2},
    {"three wheels at angles of 120 degrees",
     "parameters: [{name: L, value: 0.2}, {name: r, value: 0.05}]\n"
     "coordinates: [x, y, {name: th, type: angle}, {name: p1, type: angle}, {name: p2, type: angle}, {name: p3, type: angle}]\n"
     "lagrangian: 2*(x'^2 + y'^2) + 0.1*th'^2 + 0.001*(p1'^2 + p2'^2 + p3'^2)\n"
     "constraints:\n"
     "  - -x'*sin(th) + y'*cos(th) + L*th' = r*p1'\n"
     "  - -x'*sin(th + 2*pi/3) + y'*cos(th + 2*pi/3) + L*th' = r*p2'\n"
     "  - -x'*sin(th + 4*pi/3) + y'*cos(th + 4*pi/3) + L*th' = r*p3'\n"
     "known: {currents: [{name: sum, expr: \"r*(p1 + p2 + p3) - 3*L*th\"}]}\n",
     9},
    /* the momenta of L have terms of d(s sin(z/2))/dt, which no equation has */
    {"turn below a total derivative",
     "coordinates: [y, z, s]\n"
     "lagrangian: (y'^2 + z'^2)*(1 + (y^2 + z^2)^4)/2 + s'^2/2 + (y^2 + z^2)^2*(1 - sin(3*s/2) - cos(2*t)) - s - z'*s*cos(z/2)/2 - s'*sin(z/2)\n"
     "constraints: [\"s' = (2 + y^4)*(z*z' + y*y')\"]\n"
     "known: {currents: [{name: turning, expr: \"(1 + (y^2 + z^2)^4)*(y*z' - z*y')\"}]}\n",
     1},
    /* a turn of y and x + a z^2 - 2 z leaves the metric alone, while the potential depends on t */
    {"turn in coordinates that hide it, with a force in time",
     "parameters: [{name: a, value: 0.3}, {name: w, value: 1.3}]\n"
     "coordinates: [x, y, z]\n"
     "definitions: [\"f = x' + 2*a*z*z' - 2*z'\", \"s = x + a*z^2 - 2*z\"]\n"
     "lagrangian: ((f^2 + y'^2)*(1 + (s^2 + y^2)^2) + (z' - 3*(y*f - s*y'))^2*(1 + z^2))/2 - cos(w*t)*z^2 - z^4\n"
     "known: {currents: [{name: turning, expr: \"(1 + (s^2 + y^2)^2)*(s*y' - y*f) + 3*(s^2 + y^2)*(1 + z^2)*(z' - 3*(y*f - s*y'))\"}]}\n",
     1},
    /* c y' times the mass is a part of a square: taken away from it as a total derivative, it left longer momenta */
    {"turn about a point that moves",
     "parameters: [{name: c, value: 0.33}]\n"
     "coordinates: [x, y, {name: phi, type: angle}]\n"
     "lagrangian: (x'^2 + (y' + c)^2)*(2 + (x^2 + (y + c*t)^2)^2)/2 + phi'^2/4 + 2*cos(2*phi)\n"
     "constraints: [\"phi - (x^2 + (y + c*t)^2)^2 = 1/5\"]\n"
     "known: {currents: [{name: turning, expr: \"(x*(y' + c) - (y + c*t)*x')*(2 + (x^2 + (y + c*t)^2)^2)\"}]}\n",
     3},
    /* phi is cyclic beside z = y + 13/10 sin(phi); L has fourth powers of velocities, its inertia depends on time */
    {"turn that an angle and time hide",
     "coordinates: [{name: phi, type: angle}, x, y]\n"
     "definitions: [\"f = y' + 13/10*phi'*cos(phi)\", \"z = y + 13/10*sin(phi)\"]\n"
     "lagrangian: phi'^2*(2 + sin(2*t - x)^2)/2 + (x' - 2)^2/2 + f^2/2 + f^4/8 - z^2*(2*t - x) + t*z\n"
     "known: {currents: [{name: turning, expr: \"phi'*(2 + sin(2*t - x)^2)\"}]}\n",
     1},
    /* the energy of a frame whose rates have first harmonics of an angle */
    {"turn of a frame, with its energy and an integrable constraint",
     "parameters: [{name: c1, value: 0.56}, {name: c2, value: 0.41}]\n"
     "coordinates: [y, {name: phi, type: angle}, {name: theta, type: angle}]\n"
     "definitions: [\"f = theta' + c2 + phi'*c1*cos(phi)\", \"a = 18*t/25 - phi\", \"g = 100*phi' + 157*f*sin(a) - 72\"]\n"
     "lagrangian: 141*cos(2*a)*cos(theta + c1*sin(phi) + t*c2)/100 + 97*y'^2/100 + (14*y^4 + 17)*g^2/500000 + 17*f^2/25\n"
     "constraints: [\"f = 41*(25*phi' - 18)*sin(a)/2500\"]\n"
     "known: {currents: [{name: level, expr: \"theta + c1*sin(phi) + c2*t - 41/100*cos(a)\"},\n"
     "  {name: moving energy, expr: \"97*y'^2/100 - 141*cos(2*a)*cos(theta + c1*sin(phi) + t*c2)/100 - (14*y^4 + 17)*g^2/500000 - 17*f^2/25"
     " + f*(34*(f)/25 + 157*(14*y^4 + 17)*g*sin(a)/250000) + (phi' - 18/25)*(14*y^4 + 17)*g/2500\"}]}\n",
     2},
    /* the constraint is a total derivative below exp(a x), of functions that the system does not show */
    {"turn of nothing, with an integrable constraint",
     "parameters: [{name: a, value: 0.6}, {name: b, value: 0.3}]\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - x^4 - y^4/3 - x*y*z\n"
     "constraints: [\"exp(a*x)*z' = exp(a*x)*(3*b*cos(t)*sin(y)^2 + 3*b*sin(t)*sin(2*y)*y' + x'/(1 + x^2))\"]\n"
     "known: {currents: [{name: level, expr: \"z - 3*b*sin(y)^2*sin(t) - atan(x)\"}]}\n",
     1},
    /* the centre moves in a way that is not linear in t; Y is written with a square of another coordinate */
    {"turn about a centre on a circle",
     "parameters: [{name: a, value: 0.7}, {name: w, value: 1.3}]\n"
     "coordinates: [x, y]\n"
     "definitions: [\"X = x - a*cos(w*t)\", \"Y = y - t^3/3\"]\n"
     "lagrangian: (X'^2 + Y'^2)*(1 + (X^2 + Y^2)^2)/2 - (X^2 + Y^2)^3*t\n"
     "known: {currents: [{name: turning, expr: \"(1 + (X^2 + Y^2)^2)*(X*Y' - Y*X')\"}]}\n",
     1},
    {"turn about a centre that decays, with a constraint",
     "parameters: [{name: a, value: 0.7}]\n"
     "coordinates: [x, y, {name: h, type: angle}]\n"
     "definitions: [\"X = x - exp(-t/5)\", \"Y = y - a*sin(h)^2\"]\n"
     "lagrangian: (X'^2 + Y'^2)*(1 + (X^2 + Y^2)^2)/2 + h'^2/2*(2 + cos(h)) - (X^2 + Y^2)^2*t + cos(h)\n"
     "constraints: [\"h' = (X*X' + Y*Y')*sin(t)\"]\n"
     "known: {currents: [{name: turning, expr: \"(1 + (X^2 + Y^2)^2)*(X*Y' - Y*X')\"}]}\n",
     1},
    {"turn in curved coordinates, with a constraint, below a magnetic term and a total derivative",
     "parameters: {c: 0.7}\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: ((x' - 2*y*y')^2 + y'^2 + z'^2)/2 + c*sin(z)*((x - y^2)*y' - y*(x' - 2*y*y')) + (x' - 2*y*y')*sin(y)"
     " + y'*(x - y^2)*cos(y) - ((x - y^2)^2 + y^2)^2/4 - z*cos(1.3*t)\n"
     "constraints: [\"z' = ((x - y^2)*(x' - 2*y*y') + y*y')*(1 + sin(z)/2)\"]\n"
     "known: {currents: [{name: turning, expr: \"x*y' - y*x' + y^2*y' + c*((x - y^2)^2 + y^2)*sin(z)\"}]}\n",
     1},
};

enum { UNSEEN_COUNT = sizeof UNSEEN / sizeof *UNSEEN };

#endif
