/* stages: linear problems of the search, by the families of functions that their ansatz is made of. */
#ifndef NH_STAGES_H
#define NH_STAGES_H

#include "integrals/ansatz.h"
#include "integrals/dictionary.h"

typedef struct {
    const char *name;
    size_t families;
    const nh_family *family;
} nh_stage;

/* Stage `index` for this dictionary, in the arena; false when there are no more.  A stage may have no families. */
bool nh_stage_at(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary, size_t index, nh_stage *out);

/* The same of the stages of few columns, for systems of many coordinates. */
bool nh_stage_of_many(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary, size_t index,
                      nh_stage *out);

/* What the search for unknown rates starts from: 0 the velocities, 1 with first harmonics of the angles, 2 everything
 * of degree one; for cyclic coordinates also, with first harmonics, 3 the frame of the kinetic energy times lengths and
 * t, 4 its squares times lengths (vectors and tensors in polar coordinates), 5 velocities and their products with
 * positions (angular momenta, plane waves); and, when asked for by themselves, 6 as 2 with 1 and functions of time,
 * 7 squares of velocities and functions (energies that friction takes), 8 as 6 with t times velocities and positions, 9
 * squares of velocities and lengths, and functions (what breathes in an oscillator with other forces), 10 cubes of
 * them, and functions times lengths (Runge-Lenz vectors seen from a frame that turns). */
enum {
    NH_PENCIL_BASES = 5,
    NH_PENCIL_PLAIN = 3,
    NH_PENCIL_PRODUCTS = 5,
    NH_PENCIL_TIME = 6,
    NH_PENCIL_SQUARES = 7,
    NH_PENCIL_GROWING = 8,
    NH_PENCIL_QUADRATIC = 9,
    NH_PENCIL_CUBIC = 10
};
nh_family nh_stage_pencil_base(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary, size_t base);

/* Velocities and forms with first harmonics of this angle alone: where there are many angles the others' are too
   many. */
nh_family nh_stage_pencil_around(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary, nh_ex angle);

#endif
