/* Systems that the catalogue does not have: everything that is known of each is found, certified, and nothing more is claimed.  One per weakness that strangers'
 * systems have shown. */
#include <criterion/criterion.h>

#include <unistd.h>

#include "catalogue.h"
#include "scratch.h"

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
    {"stiff spring",
     "parameters: [{name: m, value: 1e-9}, {name: k, value: 1}]\n"
     "coordinates: [x, y]\n"
     "lagrangian: m/2*(x'^2 + y'^2) - k/2*(x^2 + y^2)\n"
     "known: {currents: [{name: turning, expr: \"x*y' - y*x'\"}, {name: phase, expr: \"x*cos(sqrt(k/m)*t) - x'*sqrt(m/k)*sin(sqrt(k/m)*t)\"}]}\n",
     4},
    /* rotations in disguise */
    {"sphere in Mercator's coordinates",
     "coordinates: [u, {name: ph, type: angle}]\n"
     "lagrangian: (u'^2 + ph'^2)/(2*cosh(u)^2)\n"
     "known: {currents: [{name: about z, expr: ph'/cosh(u)^2}, {name: about x, expr: \"(cos(ph)*u'*cosh(u) + sin(ph)*sinh(u)*ph')/cosh(u)^2\"}]}\n",
     3},
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
     3},
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
     4},
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
     1},
    {"Kepler's problem in logarithmic polar coordinates",
     "parameters: [{name: k, value: 1}]\n"
     "coordinates: [a, {name: b, type: angle}]\n"
     "lagrangian: exp(2*a)*(a'^2 + b'^2)/2 + k*exp(-a)\n"
     "known: {currents: [{name: Runge-Lenz, expr: exp(3*a)*b'*(sin(b)*a' + cos(b)*b') - k*cos(b)}]}\n",
     3},
    {"thermostat",
     "parameters: [{name: k, value: 0.8}, {name: K, value: 1}]\n"
     "coordinates: [x, y, z]\n"
     "lagrangian: (x'^2 + y'^2 + z'^2)/2 - k/2*(x^2 + y^2 + z^2)\n"
     "constraints: [\"x'^2 + y'^2 + z'^2 = 2*K\"]\n"
     "known: {currents: [{name: turning, expr: \"(x*y' - y*x')*exp(-k*(x^2 + y^2 + z^2)/(4*K))\"}]}\n",
     3},
};
enum { COUNT = sizeof UNSEEN / sizeof *UNSEEN };

Test(unseen, what_is_known_is_found_certified_and_no_more_is_claimed)
{
    for (size_t i = 0; i < COUNT; i++) {
        const unseen *u = &UNSEEN[i];
        char path[SCRATCH];
        FILE *out = scratch_open(path);
        cr_assert_not_null(out);
        fprintf(out, "name: unseen\n%s", u->text);
        fclose(out);
        nh_error error = {0};
        nh_analyze_request q = {.system_path = path, .seed_given = true};
        nh_options_default(&q.options);
        q.options.max_seconds = 1e6; /* the same on every machine */
        nh_result *r = nh_analyze(&q, &error);
        remove(path);
        cr_expect_not_null(r, "%s: %s", u->name, error.what);
        if (!r) continue;
        row o = {.rate = -INFINITY};
        compare(r, &o);
        cr_expect_eq(o.missing + o.wrong + o.untrue, 0, "%s: %s", u->name, o.names);
        cr_expect_eq(r->verdict, NH_FOUND, "%s", u->name);
        cr_expect_eq(r->independent, u->independent, "%s: %zu independent", u->name, r->independent);
        nh_result_free(r);
    }
}
