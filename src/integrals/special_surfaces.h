/* special_surfaces: algebraic surfaces in the space of three parameters, from their sections modulo primes.
 *
 * At nu = nu_1, nu_2, .. and modulo a prime the section is a monic polynomial in lambda and mu, whose coefficients are
 * rational functions of nu: found from their values by the extended Euclidean algorithm, where one value more than is
 * needed has to agree. Then as special_curves.h: Chinese remainder theorem, rational reconstruction, factors. */
#ifndef NH_SPECIAL_SURFACES_H
#define NH_SPECIAL_SURFACES_H

#include "integrals/special_curves.h"

/* Irreducible over Q: sum of coefficient[(k * (degree[1] + 1) + j) * (degree[0] + 1) + i] lambda^i mu^j nu^k, whole,
 * without common factor. */
typedef struct {
    size_t degree[3];
    int64_t *coefficient;    /* on the heap */
} nh_special_surface;

typedef struct {
    bool lifted;             /* the last prime agreed */
    size_t surfaces;
    nh_special_surface *surface;
} nh_special_surfaces;

/* The same modulo a prime, in one piece. */
typedef struct {
    size_t degree[3];
    nh_residue *coefficient;
} nh_residue_volume;

/* From sections of the same degrees at different nu, without factors that depend on nu alone. False: they are too
 * few. */
bool nh_residue_volume_from(nh_prime field, size_t count, const nh_residue *nu, const nh_residue_surface *section,
                            nh_residue_volume *out);

/* Of the same degrees modulo several primes. */
nh_special_surfaces nh_special_surfaces_lift(size_t primes, const nh_prime *prime, const nh_residue_volume *residue);
void nh_special_surfaces_clear(nh_special_surfaces *surfaces);
bool nh_special_surface_same(const nh_special_surface *a, const nh_special_surface *b);

/* A point (lambda, mu, nu) of it modulo the prime, which follows from the number; false: none was found. */
bool nh_special_surface_point(const nh_special_surface *surface, nh_prime field, uint64_t seed, nh_residue at[3]);

/* Modulo the prime, does the curve in the plane of this nu lie on the surfaces? It is without multiplicity. */
bool nh_special_surfaces_cover(size_t surfaces, const nh_special_surface *surface, nh_prime field, nh_residue nu,
                               const nh_residue_surface *curve);

/* The section of a surface with `with`, whose equation is linear in the variable v (0: lambda, 1: mu, 2: nu), in the
 * other two, the first one of them first; zero where it contains `with`. False: too long for 64 bits. The coefficients
 * are on the heap. */
bool nh_special_surface_section(const nh_special_surface *surface, const nh_special_surface *with, int v,
                                nh_special_curve *out);
/* Do all points of the irreducible curve `part` lie on `whole`? */
bool nh_special_curve_covers(const nh_special_curve *whole, const nh_special_curve *part);

#endif
