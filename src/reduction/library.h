/* library: functions for the components of infinitesimal generators.
 *
 * Component i is sought among the products, over the coordinates that it depends on, of
 *
 *     level 1    1;  sin q, cos q for angles and where the system has such functions of q, else q
 *     level 2    also 1/sin q, cot q, 1/cos q, tan q (generators of rotations in Euler's angles), else q^2
 *     level 3    sin q, cos q, q, q^2, q sin q, q cos q together
 *     level 4    as level 2, every coordinate taken for an angle
 *     level 5    sin q, cos q, sin 2q, cos 2q, q, q^2, and the system's other functions of q alone, their derivatives,
 *                and those divided by the functions (cosh, sinh, tanh)
 *     level 6    as level 5, without powers beside functions, and g g' for g'/g; also all of these divided by K_ii, or
 *                by det K: of translations in elliptic or parabolic coordinates the covectors K xi have simple
 *                components, not the fields
 *                Of an indefinite metric, at both levels, exp(q) and exp(-q) for boosts
 *     level 7    monomials to degree five, of more than three coordinates to degree three: what polynomial changes of
 *                coordinates make of rotations
 *
 * On which coordinates it depends is known from the jets; without these, any, and at most two at a time.  With the jets
 * products of two come before those of three: a smaller library is conditioned better. */
#ifndef NH_LIBRARY_H
#define NH_LIBRARY_H

#include "reduction/jets.h"

enum { NH_LIBRARY_LEVELS = 7 };

typedef struct {
    size_t count, capacity;
    nh_ex *function;   /* b_k */
    size_t *component; /* the field is b_k d/dq^component */
    double *complexity;
    const nh_ex **whole; /* NULL, or per column: NULL, or the m components of a field that is not of this form */
} nh_library;

/* Products of at most `together` functions; `jets` may be NULL. */
void nh_library_init(nh_library *library, const nh_kinetic *kinetic, const nh_jets *jets, int level, size_t together,
                     size_t most);
/* The same functions, of at most `together` coordinates at a time, for each of `components` coefficients (of sections,
   see momenta.h). */
void nh_library_for(nh_library *library, const nh_kinetic *kinetic, size_t components, int level, size_t together,
                    size_t most);
/* Other fields (m components each, kept by the caller) as columns before the others. */
void nh_library_put_before(nh_library *library, const nh_kinetic *kinetic, size_t count, const nh_ex *component);
/* Component i of a column's field. */
nh_ex nh_library_component(const nh_library *library, nh_dag *dag, size_t column, size_t i);
/* Some columns of another one. */
void nh_library_pick(nh_library *out, const nh_library *library, size_t n, const size_t *index);
/* Its columns from the simplest to the most complex, among equals in their order; the caller frees the list. */
size_t *nh_library_order(const nh_library *library);
void nh_library_clear(nh_library *library);

#endif
