/* special_surfaces: algebraic surfaces in the space of three parameters: from their sections modulo primes, and what
 * lies on them.
 *
 * At nu = nu_1, nu_2, .. and modulo a prime the section is a monic polynomial in lambda and mu, whose coefficients are
 * rational functions of nu: found from their values by the extended Euclidean algorithm, which one more value has to
 * confirm.  The rest is done as in special_curves.h. */
#ifndef NH_SPECIAL_SURFACES_H
#define NH_SPECIAL_SURFACES_H

#include "classify/special_curves.h"

/* The surfaces from sections of the same degrees at different nu; factors that depend on nu alone are left out.  False:
 * there are too few sections. */
bool nh_residue_surface_from(nh_prime field, size_t count, const nh_residue *nu, const nh_residue_surface *section,
                             nh_residue_surface *out);

/* A point (lambda, mu, nu) of the surface modulo the prime, chosen by the number; false: none was found. */
bool nh_special_surface_point(const nh_special_surface *surface, nh_prime field, uint64_t seed, nh_residue at[3]);

/* Modulo the prime: does the squarefree curve in the plane of this nu lie on the surfaces? */
bool nh_special_surfaces_cover(size_t surfaces, const nh_special_surface *surface, nh_prime field, nh_residue nu,
                               const nh_residue_surface *curve);

/* The intersection of a surface with the surface `with`, whose equation is linear in the variable v (0: lambda, 1: mu,
 * 2: nu), as a curve in the other two variables in their order; zero where the surface contains `with`.  False: a
 * coefficient is too long for 64 bits.  The coefficients are on the heap. */
bool nh_special_surface_section(const nh_special_surface *surface, const nh_special_surface *with, int v,
                                nh_special_curve *out);
/* Do all points of the irreducible curve `part` lie on `whole`? */
bool nh_special_curve_covers(const nh_special_curve *whole, const nh_special_curve *part);

#endif
