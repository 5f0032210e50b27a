/* reduced: systems with symmetry groups, for the tests of reduction. */
#ifndef NH_TESTS_REDUCED_H
#define NH_TESTS_REDUCED_H

#include "mechanics.h"
#include "base/linalg.h"
#include "reduction/jets.h"

/* A crane on a four-wheel car [ChhabraEmami2014, sec. 6], kinetic energy with the corrections that a derivation from the bodies gives. */
static const char CRANE[] =
    "name: crane\n"
    "parameters:\n"
    "  - {name: l, value: 2.6}\n  - {name: l0, value: 1.1}\n  - {name: l1, value: 0.7}\n  - {name: b, value: 0.35}\n  - {name: c, value: 0.8}\n"
    "  - {name: m1, value: 9.5}\n  - {name: m2, value: 0.6}\n  - {name: m3, value: 2.2}\n  - {name: m4, value: 0.45}\n  - {name: m6, value: 1.4}\n"
    "  - {name: jz1, value: 4.1}\n  - {name: jx2, value: 0.12}\n  - {name: jz3, value: 0.31}\n  - {name: jx4, value: 0.05}\n"
    "  - {name: jy4, value: 0.08}\n  - {name: jx6, value: 0.09}\n  - {name: jy6, value: 0.85}\n"
    "coordinates:\n"
    "  - {name: x, type: length}\n  - {name: y, type: length}\n  - {name: theta, type: angle}\n  - {name: psi1, type: angle}\n"
    "  - {name: phi1, type: angle}\n  - {name: psi2, type: angle}\n  - {name: psi3, type: angle}\n  - {name: phi2, type: angle}\n"
    "definitions:\n"
    "  - mt = m1 + m2 + m3 + 2*m4 + m6\n"
    "  - s = l*m2 + 2*l*m4 + l0*m1 + l1*m3 + l1*m6\n"
    "  - k2 = 2*m4*c^2 + jx2 + 2*jx4\n"
    "  - k3 = jz3 + jx6*sin(phi2)^2 + jy6*cos(phi2)^2\n"
    "  - jt = jz1 + l^2*m2 + 2*l^2*m4 + l0^2*m1 + l1^2*m3 + l1^2*m6 + k2 + k3\n"
    "lagrangian: >-\n"
    "  mt/2*(x'^2 + y'^2) + s*theta'*(-sin(theta)*x' + cos(theta)*y') + jt/2*theta'^2 + k2*theta'*psi1' + k3*theta'*phi1'\n"
    "  + k2/2*psi1'^2 + k3/2*phi1'^2 + jy4/2*(psi2'^2 + psi3'^2) + jy6/2*phi2'^2\n"
    "constraints:\n"
    "  - -sin(theta)*x' + cos(theta)*y' = 0\n"
    "  - -sin(theta + psi1)*x' + cos(theta + psi1)*y' + l*cos(psi1)*theta' = 0\n"
    "  - cos(theta + psi1)*x' + sin(theta + psi1)*y' + (l*sin(psi1) - c)*theta' - c*psi1' - b*psi2' = 0\n"
    "  - cos(theta + psi1)*x' + sin(theta + psi1)*y' + (l*sin(psi1) + c)*theta' + c*psi1' - b*psi3' = 0\n"
    "dependent: [x, y, theta, psi3]\n"
    "domain: {psi1: [-0.8, 0.8]}\n";

/* Snakeboard: a board with two counter-rotating axles and a rotor. */
static const char SNAKEBOARD[] =
    "name: snakeboard\n"
    "parameters: [{name: m, value: 2.1}, {name: r, value: 0.7}, {name: J, value: 0.9}, {name: J0, value: 0.23}, {name: J1, value: 0.11}]\n"
    "coordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\n  - {name: theta, type: angle}\n  - {name: psi, type: angle}\n  - {name: phi, type: angle}\n"
    "lagrangian: m/2*(x'^2 + y'^2) + (J + J0)/2*theta'^2 + J0/2*psi'^2 + J0*theta'*psi' + J1*phi'^2\n"
    "constraints:\n"
    "  - -sin(theta + phi)*x' + cos(theta + phi)*y' - r*cos(phi)*theta' = 0\n"
    "  - -sin(theta - phi)*x' + cos(theta - phi)*y' + r*cos(phi)*theta' = 0\n"
    "domain: {phi: [0.2, 1.2]}\n";

/* Two-wheel cart, wheels as angles; in coordinates that are twisted, too. */
#define CART_HEAD "parameters: [{name: m, value: 1.7}, {name: J, value: 0.8}, {name: K, value: 0.3}, {name: r, value: 0.4}, {name: c, value: 0.6}, {name: e, value: 0.25}]\n" \
    "coordinates:\n  - {name: x, type: length}\n  - {name: y, type: length}\n  - {name: theta, type: angle}\n"
#define CART_REST \
    "lagrangian: m/2*(x'^2 + y'^2) + m*e*theta'*(-sin(theta)*x' + cos(theta)*y') + J/2*theta'^2 + K/2*(p1^2 + p2^2)\n" \
    "constraints:\n" \
    "  - -sin(theta)*x' + cos(theta)*y' = 0\n" \
    "  - cos(theta)*x' + sin(theta)*y' + c*theta' - r*p1 = 0\n" \
    "  - cos(theta)*x' + sin(theta)*y' - c*theta' - r*p2 = 0\n"
static const char CART[] = "name: cart\n" CART_HEAD "  - {name: psi1, type: angle}\n  - {name: psi2, type: angle}\n"
    "definitions: [\"p1 = psi1'\", \"p2 = psi2'\"]\n" CART_REST;
static const char TWISTED_CART[] = "name: twisted\n" CART_HEAD "  - a\n  - b\n"
    "definitions:\n"
    "  - p1 = a' - 3/10*theta' - (x'*cos(y) - x*sin(y)*y')/5\n"
    "  - p2 = b' + (theta'*y + theta*y')/2\n" CART_REST;

/* A cart that carries a free rigid body with a mass sliding in it; the body is coupled to the wheel. */
static const char CART_AND_BODY[] = "name: body\n" CART_HEAD
    "  - {name: psi1, type: angle}\n  - {name: psi2, type: angle}\n  - {name: u, type: length}\n"
    "  - {name: p, type: angle}\n  - {name: h, type: angle}\n  - {name: s, type: angle}\n"
    "definitions:\n"
    "  - w1 = h'*cos(s) + p'*sin(h)*sin(s)\n"
    "  - w2 = -h'*sin(s) + p'*sin(h)*cos(s)\n"
    "  - w3 = p'*cos(h) + s'\n"
    "lagrangian: >-\n"
    "  m/2*(x'^2 + y'^2) + m*e*theta'*(-sin(theta)*x' + cos(theta)*y') + J/2*theta'^2 + K/2*(psi1'^2 + psi2'^2)\n"
    "  + (1.1 + u^2/4)/2*w1^2 + 0.85*w2^2 + (1.15 + u/5)*w3^2 + 0.3*u'*w1 + 0.2*psi1'*w2 + 0.15*u*psi2'*w3 + 0.6*u'^2 - 0.4*u^2 - 0.3*cos(psi1)*u\n"
    "constraints:\n"
    "  - -sin(theta)*x' + cos(theta)*y' = 0\n"
    "  - cos(theta)*x' + sin(theta)*y' + c*theta' - r*psi1' = 0\n"
    "  - cos(theta)*x' + sin(theta)*y' - c*theta' - r*psi2' = 0\n"
    "domain: {h: [0.7, 1.9]}\n";

/* A Chaplygin system with the group SO(3): a left-invariant constraint on the body angular velocity, an inertia that depends on the shape. */
static const char ROTATIONS[] =
    "name: so3\n"
    "parameters: [{name: m, value: 1.2}]\n"
    "coordinates:\n"
    "  - {name: u, type: length}\n"
    "  - {name: w, type: length}\n"
    "  - {name: p, type: angle}\n"
    "  - {name: h, type: angle}\n"
    "  - {name: s, type: angle}\n"
    "definitions:\n"
    "  - w1 = h'*cos(s) + p'*sin(h)*sin(s)\n"
    "  - w2 = -h'*sin(s) + p'*sin(h)*cos(s)\n"
    "  - w3 = p'*cos(h) + s'\n"
    "lagrangian: >-\n"
    "  m/2*(u'^2 + w'^2) + (1.1 + u^2/4)/2*w1^2 + 0.85*w2^2 + (1.15 + w/5)*w3^2 + 0.3*u'*w1 + 0.2*w'*w2 - 0.4*u^2 - 0.3*cos(w)\n"
    "constraints:\n"
    "  - w1 = (0.3 + 0.2*w)*u' + 0.1*u*w'\n"
    "  - w2 = 0.4*u' - 0.3*sin(u)*w'\n"
    "  - w3 = 0.2*u*w*u' + (0.5 + 0.1*u^2)*w'\n"
    "domain: {h: [0.7, 1.9]}\n";

typedef struct {
    nh_system *system;
    nh_model *model; /* bare */
    nh_kinetic *kinetic;
} reducible;

static inline reducible reducible_make(nh_system *system, uint64_t seed, nh_error *error)
{
    must(system != NULL, error, "the system");
    nh_linalg_threads(1);
    reducible x = {.system = system, .model = nh_model_bare(system, nh_chart_create(system, NH_CHART_AUTO, 1, error))};
    must(x.model != NULL, error, system->name);
    x.kinetic = nh_kinetic_create(x.model, seed, error);
    must(x.kinetic != NULL, error, system->name);
    return x;
}

static inline void reducible_clear(reducible *x)
{
    nh_kinetic_free(x->kinetic);
    nh_model_free(x->model);
    nh_system_free(x->system);
}

#endif
