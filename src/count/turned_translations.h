/* turned_translations: cyclic coordinates on which no integral depends unless one is linear in them.
 *
 * Translations d/da_j along cyclic coordinates and a symmetry that turns them,
 *
 *     R = B_ij a_j d/da_i + xi_s d/dq_s + (E w)^l d/dw^l,   [R, Gamma] = 0,   [R, d/da_j] = - B_ij d/da_i,
 *
 * with constant xi and B, which is invertible, span a solvable Lie algebra that acts on the integrals of a degree.
 * These have a finite dimension, so that its derived algebra, the translations, is nilpotent there (Lie's theorem).  If
 * no a_j times integrals without a, plus anything without a, is an integral, then no integral depends on a
 * (docs/method.md, sec. 10): a car in the plane has none that depends on its place when none is linear in it. */
#ifndef NH_TURNED_TRANSLATIONS_H
#define NH_TURNED_TRANSLATIONS_H

#include "count/jet_equations.h"

/* The coordinates a_j of such an algebra that is tangent to the leaves of integrable constraints, written to out (room
 * for all coordinates).  Returns their number, or 0.  Moves the equations to other points. */
size_t nh_turned_translations(nh_jet_equations *equations, nh_ex *out);

#endif
