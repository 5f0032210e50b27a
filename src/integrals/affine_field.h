/* affine_field: a current's field where it is affine in the coordinates, t and the centre of mass, but for the turns of
 * three angles, or quadratic in the coordinates.
 *
 *     Y_j(Phi) = M_ij zeta^i,   zeta^i = c_0 + c_1 t + c_s q^s + d_s t q^s + f_s C^s + e_w w(q^a, q^b)
 *                           or  zeta^i = c_0 + c_s q^s + c_rs q^r q^s
 *
 * Turns and translations of whole systems have such fields, and centres of mass C, however long M^-1 is. */
#ifndef NH_AFFINE_FIELD_H
#define NH_AFFINE_FIELD_H

#include "base/option.h"
#include "geometry/model.h"

/* The words of a turn in space, in three angles of which a is the first and b the second: with the patterns zxz and zyx
 *
 *     cos(a) d_b - sin(a) cot(b) d_a + sin(a)/sin(b) d_c,   sin(a) d_b - cos(a) tan(b) d_a - cos(a)/cos(b) d_c
 *
 * Returns how many there are: none where a and b are one coordinate, or one is no angle. */
enum { NH_AFFINE_FIELD_WORDS = 10 };
size_t nh_affine_field_words(const nh_model *model, size_t a, size_t b, nh_ex out[NH_AFFINE_FIELD_WORDS]);

/* zeta (n) with short fractions as coefficients, by its values at points, for the parameters' given values; in
 * quadratic ones times powers of parameters.  Of an energy in coordinates that move it is affine but for -tau w.  A
 * guess: the equation above and that of Noether remain to be checked.  False: there is none. */
bool nh_affine_field(const nh_model *model, nh_ex phi, const nh_options *options, nh_ex *zeta);

/* Where all masses are along a coordinate, without bodies being named.
 *
 *     p_s = K_sr v^r = dF/dt,   F = K_ss q^s + ..,   K_ss a constant
 *
 * With the coordinate s as a displacement of the whole, K_ss is the whole's mass and F/K_ss its centre's coordinate. */

typedef struct {
    size_t s;      /* the coordinate */
    nh_ex mass, F; /* K_ss */
} nh_centre_of_mass;

/* Those with an F that is no linear function of the coordinates; `out` has room for m.  None where the velocities are
 * constrained or replaced.  `max_terms`: of polynomials. */
size_t nh_centre_of_mass_find(const nh_model *model, size_t max_terms, nh_centre_of_mass *out);

#endif
