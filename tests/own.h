/* own: ten systems of our own, outside of the catalogue, as a user writes them, each beside its equations of motion by
 * Newton and Euler with reaction forces, and its integrals by hand.
 *
 * A state z has as many numbers as the constraint submanifold, so that gradients of integrals are those on it; `place`
 * gives positions and velocities in the order of `coordinates`.  e = (cos h, sin h) is a heading, n = (-sin h, cos h),
 * r = (x, y), ez the vertical; all units are SI units. */
#ifndef NH_TESTS_OWN_H
#define NH_TESTS_OWN_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

enum { OWN_SIZE = 10, OWN_COORDINATES = 5, OWN_KNOWN = 8 };

typedef struct {
    const char *name;
    double (*value)(double t, const double *z);
    bool missed; /* today: by the program */
} own_integral;

typedef struct {
    const char *name, *text, *coordinates;
    size_t size; /* of z */
    void (*rates)(double t, const double *z, double *rate);
    void (*place)(double t, const double *z, double *q, double *v);
    double generic[OWN_SIZE], ordinary[OWN_SIZE];
    own_integral known[OWN_KNOWN];
    bool reducible; /* has it a symmetry of kinetic energy, potential and constraints? */
} own_system;

#endif
