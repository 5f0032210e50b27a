/* symmetry_rays: the jets of isometries along rays, as series modulo a prime (symmetry_count.h). */
#ifndef NH_SYMMETRY_RAYS_H
#define NH_SYMMETRY_RAYS_H

#include "exact/jet_eval.h"
#include "reduction/kinetic.h"

/* Series to the order NH_RAY_ORDER in s; to NH_RAY_SIDE with the factor u; u^2 = 0. */
enum { NH_RAY_ORDER = 13, NH_RAY_HEAVY = 7, NH_RAY_SIDE = NH_RAY_ORDER - NH_RAY_HEAVY };

/* Where the expressions of each sort stand. */
typedef struct {
    size_t K, dK, ddK, dV, omega, domega, b, db, a, da, velocity_free, Q, dQ, total;
} nh_count_layout;

/* Rows in echelon form. */
typedef struct {
    size_t rank;
    nh_residue *row;
} nh_echelon;

enum { NH_COUNT_KINDS = 3, NH_COUNT_SETS = 1 << NH_COUNT_KINDS };

typedef struct {
    const nh_kinetic *k;
    size_t m, f, n, h, columns, jet; /* n = m - f; jet = m + m^2 */
    nh_count_layout at;
    nh_ex *e;
    nh_jet_point *point;
    nh_prime field;
    const nh_jet_ring *ring;
    uint64_t random;
    nh_residue *q0, *X, *Y;                     /* m */
    nh_residue *value;                          /* series of all expressions */
    nh_residue *gamma, *G[2], *dG[2], *inverse; /* series: m^3; along X and Y, m^2 and m^3; m^2 */
    nh_residue *frame, *rest;                   /* D: n x m series; m series, v0 of affine constraints */
    /* by powers of s, then of u: coefficient (power, u) of Gamma, G, dG, and of each column's jet and B Z */
    nh_residue *cGamma, *cG, *cdG, *cGy, *cdGy, *y, *t;
    nh_echelon rows[NH_COUNT_SETS]; /* by sets of kinds of conditions */
    size_t before[NH_COUNT_SETS];
} nh_count_rays;

static inline size_t nh_ray_packed(size_t i, size_t j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }
/* Series number i of a block; the index of s^power u^u. */
static inline nh_residue *nh_ray_series(const nh_count_rays *c, nh_residue *block, size_t i)
{
    return block + i * c->ring->size;
}
static inline size_t nh_ray_index(const nh_count_rays *c, size_t power, size_t u)
{
    uint8_t exponent[2] = {(uint8_t)power, (uint8_t)u};
    return nh_jet_ring_find(c->ring, exponent);
}

/* Along a new random ray from q0: the values of all expressions, D, and the jets of all columns (in y).  False where a
 * point is not regular. */
bool nh_symmetry_rays_follow(nh_count_rays *rays);
/* B Z for the direction Z = X + u Y (way 0) or Y (way 1): the coefficient of s^power u^u of jet y. */
void nh_symmetry_rays_moved(const nh_count_rays *rays, const nh_residue *y, size_t power, size_t u, int way,
                            nh_residue *out);
/* That of the rate of B along the ray (way 0) or along Y at u = 0 (way 1); t: those of B Z so far. */
void nh_symmetry_rays_rate(const nh_count_rays *rays, size_t column, size_t power, size_t u, int way,
                           const nh_residue *t, nh_residue *out);
/* The memory of all that is computed; the ring must be set. */
void nh_symmetry_rays_allocate(nh_count_rays *rays);
void nh_symmetry_rays_release(nh_count_rays *rays);

#endif
