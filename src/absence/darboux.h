/* darboux: homogeneous potentials and the eigenvalues of their second derivatives on straight lines. */
#ifndef NH_DARBOUX_H
#define NH_DARBOUX_H

#include <flint/fmpq.h>

#include "absence/closed_shape.h"

typedef struct {
    const char *point;      /* "c = (1, 0)": V'(c) = c, up to a factor */
    const char *eigenvalue; /* of V''(c), exact; the first that is not in the table */
} nh_darboux_refutation;

typedef struct {
    bool applies;             /* a homogeneous potential and a constant, diagonal inertia, no constraints */
    const char *obstacle;     /* why it does not, or why nothing follows; or NULL */
    long degree;              /* k */
    size_t points, undecided; /* lines found; with eigenvalues that were not decided */
    bool refuted;
    bool roots;   /* the potential contains roots: meromorphic in positions, velocities and these */
    bool generic; /* for all values of the parameters but countably many hypersurfaces */
    nh_darboux_refutation refutation;
} nh_darboux;

/* Is the rational lambda one that the theorem of Morales-Ruiz and Ramis allows for degree k? */
bool nh_darboux_allowed(long k, const fmpq_t lambda);

nh_darboux *nh_darboux_of(nh_arena *arena, const nh_closed_shape *shape);

#endif
