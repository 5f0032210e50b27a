/* dictionary: the functions that occur in a system.
 *
 * They are collected from the expressions of L, of the forces, of the constraints and of the embedding, parameters left
 * symbolic:
 *
 *     velocities   the chart's and the dependent ones
 *     forms        sums that are linear and homogeneous in the velocities (angular velocities, rolling forms, momenta)
 *     atoms        non-polynomial functions of position and their inverses (1/r, exp(a - b), sqrt(1 + y^2), sin 2phi);
 *                  integrals of 1/(b + c q) and
 *                  1/(b + c q^2) in forces and constraints
 *     potential    the additive terms of L without velocities, and for angles their first derivatives
 *     frame        M = L D L^T: the forms (L^T w)_i, with the root of D_i's position factor where it is rational (p, q,
 *                  r of a top)
 *     places       sums of positions and t that are not linear in them, as they are written: X = x + a z^2, x - a cos t
 *     energy       as one column, in whatever form it has
 *
 * [docs/method.md, sec. 4] */
#ifndef NH_DICTIONARY_H
#define NH_DICTIONARY_H

#include "geometry/model.h"

typedef struct {
    size_t velocities, forms, atoms, potentials, momenta;
    nh_ex *velocity, *form, *atom, *potential, *momentum; /* functions on the submanifold, in the chart */
    size_t positions, places;
    nh_ex *position; /* the coordinates */
    nh_ex *place;
    size_t frames;
    /* forms in which the kinetic energy is a sum of squares, each with a factor that depends on position; none when the
     * velocities themselves are such forms */
    nh_ex *frame;
    size_t waves;
    nh_ex *wave; /* angles that occur in sines and cosines of the system, or are declared so */
    size_t lengths;
    /* coordinates on which the equations of motion depend otherwise than through sines and cosines */
    nh_ex *length;
    size_t shapes;
    nh_ex *shape; /* coordinates on which the equations of motion depend at all */
} nh_dictionary;

/* Belongs to the model's arena. */
nh_dictionary nh_dictionary_of(nh_model *model);

#endif
