/* jet_equations: the equations of motion on the constraint submanifold as power series in the coordinates.
 *
 *     q^s' = b^s + R^s_i w^i,    M_ij w^j' = A_i,    A_i polynomial in w of degree two      [docs/method.md, sec. 2]
 *
 * The coefficients in w are found by differentiation, and checked at random velocities.  Time is
 * the first coordinate where it is asked for, or occurs.  Equations with |u| and sign(u) are taken on one side of every
 * u = 0. */
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
    bool time;                /* time is the first of the coordinates */
    bool generic;             /* parameters are indeterminates */
    size_t coordinates, n, m; /* m coordinates: without time */
    const nh_ex *coordinate, *w;
    /* rho (m), M (n x n), A (n), in canonical form, with parameters at their values unless generic; the coefficients of
     * A in w (monomials x n) */
    nh_ex *rho, *M, *A, *coefficient;
    double products; /* products of series, about, that they take at a point */
    size_t fields;   /* n, and one more when b is not zero or time is a coordinate */
    size_t left;     /* cyclic coordinates that were left out, and their rates */
    const nh_ex *left_coordinate, *left_rate;
    /* the values of the coordinates at the point, then those of the parameters, which matter when these are
     * indeterminates, and of t when it is no coordinate */
    nh_residue *at;
    bool complete; /* expressions registered from now on are not part of the equations */
    nh_region side;
    const char *obstacle; /* why nothing can be counted; NULL */
} nh_jet_equations;

/* Opens the equations; obstacles that do not depend on the point are found here. */
nh_jet_equations *nh_jet_equations_create(const nh_model *model, bool time, bool generic);
/* Is the coordinate cyclic: does no equation depend on it? */
bool nh_jet_equations_is_cyclic(const nh_jet_equations *equations, nh_ex coordinate);
/* Drops the rates of these coordinates, on which no equation may depend. */
void nh_jet_equations_drop(nh_jet_equations *equations, size_t count, const nh_ex *coordinate);
/* Drops the rates of cyclic coordinates: the equations that are left are closed.  False where no coordinate is
 * cyclic. */
bool nh_jet_equations_drop_cyclic(nh_jet_equations *equations);
/* The same, but keeps their rates, whose series are written by nh_jet_equations_left: left x fields. */
void nh_jet_equations_leave(nh_jet_equations *equations, size_t count, const nh_ex *coordinate);
bool nh_jet_equations_left(nh_jet_equations *equations, const nh_jet_ring *ring, const nh_residue *coordinate,
                           nh_residue *out);
/* How often nh_jet_equations_drop_cyclic drops coordinates, which may be cyclic only after others were dropped. */
size_t nh_jet_equations_cyclic_rounds(const nh_model *model);
void nh_jet_equations_free(nh_jet_equations *equations);

/* Moves to another point, which follows from prime and seed; false: it is singular. */
void nh_jet_equations_choose(nh_jet_equations *equations, nh_prime field, uint64_t seed);

/* An evaluator with the coordinates set to these series and all velocities to zero; the caller frees it. */
nh_jet_eval *nh_jet_equations_eval(nh_jet_equations *equations, const nh_jet_ring *ring, const nh_residue *coordinate);

/* Registers an expression in t, q, w so that it can be evaluated, and returns it in the form of the equations.  False
 * with an obstacle, one of which is that it is not `polynomial` in the velocities. */
bool nh_jet_equations_take(nh_jet_equations *equations, bool polynomial, nh_ex *e);

/* Sets the velocities to numbers. */
void nh_jet_equations_velocities(nh_jet_equations *equations, nh_jet_eval *eval, const nh_jet_ring *ring,
                                 const nh_residue *w);

/* The motion from the point with these velocities: series of the coordinates (`coordinates` components, time among
 * them) and of the velocities (n) in one variable, the time from there.  False: the point is singular. */
bool nh_jet_equations_along(nh_jet_equations *equations, const nh_jet_ring *ring, const nh_residue *w,
                            nh_residue *coordinate, nh_residue *velocity);

/* Writes the fields X_1..X_n, then X_0 = d/dt + b when fields > n, `coordinates` components each, into out.  False:
 * another point is needed, or there is an obstacle. */
bool nh_jet_equations_fields(nh_jet_equations *equations, const nh_jet_ring *ring, const nh_residue *coordinate,
                             nh_residue *out);

/* Accelerations w^l' = sum over the monomials mu = 1, w^i, w^i w^j (i <= j) of out[l][mu] mu, in this order. */
size_t nh_jet_equations_monomials(size_t n);
bool nh_jet_equations_accelerations(nh_jet_equations *equations, const nh_jet_ring *ring, const nh_residue *coordinate,
                                    nh_residue *out);

#endif
