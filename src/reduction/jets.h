/* jets: the dimension and the algebra of all local symmetries, without any ansatz.
 *
 * A field xi that leaves the metric K invariant is determined by its 1-jet (xi, B), B^i_j = d_j xi^i, at one point,
 * because L_xi Gamma = 0 gives
 *
 *     d_k d_j xi^i = -( xi^l d_l Gamma^i_jk - Gamma^l_jk B^i_l + Gamma^i_lk B^l_j + Gamma^i_jl B^l_k )
 *     [KobayashiNomizu1963, ch. VI]
 *
 * so that jets are transported along straight lines by a linear differential equation.  The m(m+1)/2 jets with (L_xi
 * K)(q0) = 0 are taken to other points; the combinations that satisfy there
 *
 *     L_xi K = 0,    xi(V) = 0,    (L_xi omega^A)(X) = 0 for X in D,    and do not depend on the path around a triangle
 *     L_xi a = 0 of L's part a v,  (L_xi omega^A)(v0) + xi(b^A) = 0 at a v0 with omega v0 + b = 0,  L_xi Q = 0 of
 *     forces at velocities that are allowed
 *
 * are the jets of all local symmetries.  Their brackets are known at q0 from the jets alone. */
#ifndef NH_JETS_H
#define NH_JETS_H

#include "reduction/algebra.h"
#include "reduction/kinetic.h"
#include "reduction/symmetry_count.h"

typedef struct {
    size_t m, dimension;                            /* of the symmetries of K, V and D together */
    size_t of_metric, of_potential, of_constraints; /* of K alone; of K and V; of K and D */
    size_t orbit;                                   /* rank of the xi at a generic point */
    /* the dimensions are those counted modulo primes, which no tolerance decides; false: they are ranks of numbers */
    bool exact;
    double *place;                 /* m: q0 */
    double *jet;                   /* (m + m^2) x dimension, at q0: xi, then B column by column */
    size_t places;                 /* ends of the rays */
    double *end;                   /* places x m */
    double *moved;                 /* places x ((m + m^2) x dimension): the same jets there */
    nh_algebra algebra;            /* C = minus the constants of the fields (left action) */
    double last_null, first_other; /* singular values on both sides of the cut; rows have size one */
    double closure;                /* largest residual of the brackets */
} nh_jets;

/* Needs kinetic->countable.  NULL with a message when no ray could be followed. */
nh_jets *nh_jets_find(const nh_kinetic *kinetic, const nh_options *options, nh_error *error);
void nh_jets_free(nh_jets *jets);

#endif
