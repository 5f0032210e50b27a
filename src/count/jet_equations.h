/* jet_equations: the equations of motion on the constraint submanifold as power series in the coordinates.
 *
 *     q^s' = b^s + R^s_i w^i,    M_ij w^j' = A_i,    A_i polynomial in w of degree two      [docs/method.md, sec. 2]
 *
 * The coefficients in w are found from values at w = 0, +-e_i, e_i + e_j, and one more value, at random velocities, has
 * to agree.  Time is the first coordinate where it is asked for, or occurs.  Where |u| and sign(u) stand in the
 * equations they hold on one side of every u = 0. */
#ifndef NH_JET_EQUATIONS_H
#define NH_JET_EQUATIONS_H

#include "geometry/model.h"
#include "exact/jet_eval.h"
#include "integrals/region.h"

typedef struct {
    const nh_model *model;
    nh_dag *dag;
    nh_arena *arena;
    nh_jet_point *point;
    bool time;               /* it is the first of the coordinates */
    bool generic;            /* parameters are indeterminates */
    size_t coordinates, n, m; /* m: without time */
    const nh_ex *coordinate, *w;
    nh_ex *rho, *M, *A;      /* m, n x n, n: canonical, with parameters at their values unless generic */
    double products;         /* of series, about, that they take at a point */
    size_t fields;           /* n, and one more when b is not zero or time is a coordinate */
    /* the point, and after the coordinates the parameters, which matter when they are indeterminates, and t when it is
       no coordinate */
    nh_residue *at;
    bool complete;           /* what is taken from now on is none of the equations */
    nh_region side;
    const char *obstacle;    /* why nothing can be counted; NULL */
} nh_jet_equations;

/* Obstacles are found here as far as they do not depend on the point. */
nh_jet_equations *nh_jet_equations_create(const nh_model *model, bool time, bool generic);
/* From now on those of the shape alone, which are closed: cyclic coordinates are none of theirs.  Are there any? */
bool nh_jet_equations_is_cyclic(const nh_jet_equations *equations, nh_ex coordinate);
bool nh_jet_equations_drop_cyclic(nh_jet_equations *equations);
bool nh_jet_equations_have_cyclic(const nh_model *model);
void nh_jet_equations_free(nh_jet_equations *equations);

/* Another point, which follows from prime and seed. */
void nh_jet_equations_choose(nh_jet_equations *equations, nh_prime field, uint64_t seed);

/* An evaluator with the coordinates at these series, and all velocities zero. */
nh_jet_eval *nh_jet_equations_eval(nh_jet_equations *equations, const nh_jet_ring *ring, const nh_residue *coordinate);

/* An expression in t, q, w as the equations have theirs: registered, so that it can be evaluated.  False with an
 * obstacle, which is also that it is not `polynomial` in the velocities. */
bool nh_jet_equations_take(nh_jet_equations *equations, bool polynomial, nh_ex *e);

/* May there be relations between kernels that the point does not keep?  False proves that there are none: the atoms of
 * either kind, as series at several points together, with roots of numbers of any sign, are linearly independent modulo
 * the prime, hence over Q: sqrt(2) f is no rational multiple of f.  True also when no such points were found. */
bool nh_jet_equations_related(nh_jet_equations *equations, nh_prime field);

/* Set the velocities to numbers. */
void nh_jet_equations_velocities(nh_jet_equations *equations, nh_jet_eval *eval, const nh_jet_ring *ring,
                                 const nh_residue *w);

/* The fields X_1..X_n, then X_0 = d/dt + b when fields > n, `coordinates` components each, into out.  False: another
   point, or an obstacle. */
bool nh_jet_equations_fields(nh_jet_equations *equations, const nh_jet_ring *ring, const nh_residue *coordinate,
                             nh_residue *out);

/* Accelerations w^l' = sum over the monomials mu = 1, w^i, w^i w^j (i <= j) of out[l][mu] mu, in this order. */
size_t nh_jet_equations_monomials(size_t n);
bool nh_jet_equations_accelerations(nh_jet_equations *equations, const nh_jet_ring *ring, const nh_residue *coordinate,
                                    nh_residue *out);

#endif
