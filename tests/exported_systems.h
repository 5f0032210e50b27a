/* exported_systems: what is exported in the tests: shipped systems, and some with names and functions that are awkward
 * in other languages. */
#ifndef NH_TESTS_EXPORTED_SYSTEMS_H
#define NH_TESTS_EXPORTED_SYSTEMS_H

#include <stddef.h>

typedef struct {
    const char *name; /* a shipped system, or the name of one of these */
    const char *text; /* NULL: shipped */
    const char *input;
} exported_system;

/* Keywords and functions of C, C++, Python and MATLAB as names; an input. */
#define KEYWORDS \
    "name: keywords\nparameters: [{name: lambda, value: 1.5}, {name: class, value: 2}, {name: double, value: 0.75}, " \
    "{name: end, value: 0.4}, {name: E, value: 3}, {name: NAN, value: 0.25}, {name: I, value: 1}]\n" \
    "coordinates: [{name: int, type: length}, {name: def, type: length}, {name: for, type: angle}, {name: x_dot, " \
    "type: length}, {name: x, type: length}]\n" \
    "lagrangian: lambda/2*(int'^2 + def'^2) + class/2*for'^2 + double*x_dot'^2/2 + I*x'^2/2 - E*int*x_dot^2 - " \
    "NAN*cos(for)*x\n" \
    "forces: [\"for = end - 0.1*for'\"]\n"

/* All functions of the language, and powers. */
#define FUNCTIONS \
    "name: functions\nparameters: [{name: a, value: 1.25}]\ncoordinates: [{name: x, type: length}, {name: y, type: " \
    "length}, {name: z, type: length}]\n" \
    "domain: {x: [0.2, 0.6], y: [0.3, 0.7], z: [0.2, 0.5]}\n" \
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - atan2(y, x + a) - abs(x - 2*y)^3 - asin(x/2)*acos(y/3) - " \
    "atan(z)*sinh(x)*cosh(y) - tanh(z) - asinh(x)*acosh(2 + y) - atanh(z/2) + exp(-x)*log(a + y) - sqrt(1 + " \
    "x^2)*tan(z/2) - (1 + x^2 + y^2)^(3/2) + (a + y)^(1/3)*x^a - (a + z)^x - 1/(1 + z)^5\n"

/* A constraint that is solved by Newton's iteration. */
#define IMPLICIT \
    "name: implicit\ncoordinates: [x, y, z]\ndomain: {x: [0.2, 0.8], y: [0.2, 0.8], z: [0.2, 0.8]}\nlagrangian: " \
    "(x'^2 + y'^2 + z'^2)/2 - x*y\nconstraints: [\"z'^5 + z' = x'*y' + sin(x)*y'\"]\n"

/* Time in the constraint and in the potential; L not quadratic. */
#define RHEONOMIC \
    "name: rheonomic\nparameters: [{name: w, value: 0.7}, {name: m, value: 1.2}]\ncoordinates: [{name: x, type: " \
    "length}, {name: y, type: length}, {name: s, type: length}]\n" \
    "lagrangian: m*(x'^2 + y'^2)/2 + exp(s'/3) + s'^4/12 - sin(w*t)*x*s\nconstraints: [\"y' = (x + t)*x' + " \
    "cos(w*t)\"]\n"

/* Momenta that do not determine all velocities without the constraint. */
#define MASSLESS \
    "name: massless\nparameters: [{name: r, value: 0.3}]\ncoordinates: [{name: x, type: length}, {name: psi, type: " \
    "angle}]\nlagrangian: x'^2/2 - x^4/4\nconstraints: [\"x' = r*psi'\"]\n"

static const exported_system EXPORTED[] = {{"sleigh", NULL, NULL},
                                           {"crane", NULL, NULL},
                                           {"snakeboard", NULL, NULL},
                                           {"kepler", NULL, NULL},
                                           {"vertical_disk", NULL, NULL},
                                           {"constant_speed", NULL, NULL},
                                           {"appell_hamel", NULL, NULL},
                                           {"rolling_disk", NULL, NULL},
                                           {"euler_top", NULL, NULL},
                                           {"heisenberg_particle", NULL, NULL},
                                           {"two_wheel_carriage", NULL, NULL},
                                           {"ball_on_turntable", NULL, NULL},
                                           {"skate_on_belt", NULL, NULL},
                                           {"bead_on_turning_wire", NULL, NULL},
                                           {"skate_with_friction", NULL, NULL},
                                           {"relativistic_particle", NULL, NULL},
                                           {"charged_particle", NULL, NULL},
                                           {"cart_on_disc", NULL, NULL},
                                           {"car_trailers_2", NULL, NULL},
                                           {"knife_edge", NULL, NULL},
                                           {"foucault_pendulum", NULL, NULL},
                                           {"omni_robot", NULL, NULL},
                                           {"perpendicular_velocities", NULL, NULL},
                                           {"roller_racer", NULL, NULL},
                                           {"toda_lattice", NULL, NULL},
                                           {"chaplygin_ball", NULL, NULL},
                                           {"keywords", KEYWORDS, "end"},
                                           {"functions", FUNCTIONS, NULL},
                                           {"implicit", IMPLICIT, NULL},
                                           {"rheonomic", RHEONOMIC, NULL},
                                           {"massless", MASSLESS, NULL}};
enum { EXPORTED_SYSTEMS = sizeof EXPORTED / sizeof *EXPORTED };

#endif
