/* darboux: homogeneous potentials and the eigenvalues of their second derivatives on straight lines.
 *
 *     L = q'^T M q'/2 - V(q),   V of whole degree k, k not 0, 2, -2,   M constant
 *     V'(c) = mu M c, mu not 0:   q = c phi(t) is a motion
 *     an eigenvalue of M^-1 V''(c)/mu outside of the table of Morales-Ruiz and Ramis, so too one that is not rational:
 *     not integrable by commuting integrals that are meromorphic near these motions;
 *     two degrees of freedom: no integral but functions of the energy
 *
 * c may be complex.  [docs/method.md, "No other integral"] */
#ifndef NH_DARBOUX_H
#define NH_DARBOUX_H

#include <flint/fmpq.h>

#include "absence/closed_shape.h"

typedef struct {
    const char *point; /* "c = (1, 0)", "c = (1, s), s^2 - 2 = 0", "c, an equilateral triangle ..": V'(c) = M c, up to
                               a factor */
    const char *eigenvalue; /* "5/7", "3*sqrt(2) - 5", "lambda, lambda^3 + lambda + 1 = 0", "2*s + 1" in the s of the
                               point; of V''(c), exact; the first that is not in the table */
} nh_darboux_refutation;

typedef struct {
    bool applies;             /* a homogeneous potential and a constant inertia, no constraints */
    const char *obstacle;     /* why it does not, or why nothing follows; NULL: refuted */
    long degree;              /* k; 0: not known */
    size_t coordinates;       /* degrees of freedom */
    size_t points, undecided; /* lines found; with eigenvalues that were not decided */
    bool refuted;
    bool roots;   /* the potential contains roots: meromorphic in positions, velocities and these */
    bool generic; /* for all values of the parameters but countably many hypersurfaces; else at their given values */
    nh_darboux_refutation refutation;
} nh_darboux;

/* Is the rational lambda one that the theorem of Morales-Ruiz and Ramis (2001) allows for degree k?  For k = 0, 2,
 * -2 it says nothing: every one is. */
bool nh_darboux_allowed(long k, const fmpq_t lambda);

/* Is it not, and does Kovacic's algorithm prove the same of its Gauss equation? */
bool nh_darboux_excluded(nh_arena *arena, long k, const fmpq_t lambda);

/* All coordinates of the system count, also those that the shape leaves out.  The lines: with two coordinates and a
 * polynomial all, complex ones too; else those whose coordinates are 0, 1 and -1, and the equilateral triangle of three
 * bodies.  In the arena. */
nh_darboux *nh_darboux_of(nh_arena *arena, const nh_closed_shape *shape);

#endif
