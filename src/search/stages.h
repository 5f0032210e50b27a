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

typedef enum {
    NH_STAGE_WORDS,
    NH_STAGE_DRIVE,
    NH_STAGE_WORDS_POSITIONS,
    NH_STAGE_MOMENTA,
    NH_STAGE_DEGREE_2,
    NH_STAGE_WEIGHTS,
    NH_STAGE_WEIGHT_4,
    NH_STAGE_SEPARATION,
    NH_STAGE_TIME,
    NH_STAGE_HALF_ANGLES,
    NH_STAGE_RATIONAL
} nh_stage_name;

/* Stage `index`, an nh_stage_name, for this dictionary, in the arena; false when there are no more.  A stage may
 * have no families. */
bool nh_stage_at(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary, size_t index, nh_stage *out);

/* What the search for unknown rates starts from.  The first three are tried one after another for every variable, FRAME
 * and PRODUCTS for cyclic ones; the others where the search asks for them. */
typedef enum {
    NH_PENCIL_VELOCITIES,
    NH_PENCIL_HARMONICS, /* velocities times first harmonics of the angles */
    NH_PENCIL_LINEAR,    /* everything of degree one, with harmonics */
    NH_PENCIL_TIME,      /* the same with 1 and functions of time */
    NH_PENCIL_GROWING,   /* the same with t times velocities and positions */
    NH_PENCIL_ENERGY,    /* the energy and the system's functions: masses and springs that change with time */
    NH_PENCIL_FRAME, /* the frame of the kinetic energy and its squares times lengths and first harmonics: vectors and
                        tensors in polar coordinates */
    NH_PENCIL_PRODUCTS,  /* velocities times 1 and positions: angular momenta, plane waves */
    NH_PENCIL_SQUARES,   /* squares of velocities and functions: energies that friction takes */
    NH_PENCIL_QUADRATIC, /* squares of velocities and lengths, and functions: what breathes in an oscillator with other
                            forces */
    NH_PENCIL_RATIONAL,  /* quotients by denominators that are affine in the velocities */
    NH_PENCIL_CUBIC /* cubes of them, and functions times lengths: Runge-Lenz vectors seen from a frame that turns */
} nh_pencil_base;

nh_family nh_stage_pencil_base(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary,
                               nh_pencil_base base);

/* Velocities and forms with first harmonics of this angle alone: with many angles those of all would be too many. */
nh_family nh_stage_pencil_around(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary, nh_ex angle);

#endif
