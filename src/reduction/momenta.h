/* momenta: momenta of the group that are conserved under the constraints [Bloch1996].
 *
 * For a section f^a(q) e_a of V that lies in D, and J_a = e_a^s K_sr v^r, along every motion
 *
 *     d/dt (f^a J_a) = (f^a)' J_a                                                                [Bloch1996, eq. 4.2.3]
 *
 * so that a horizontal symmetry (f constant) conserves its momentum, and a section with
 *
 *     sym_ij X_i(f^a) K(X_j, e_a) = 0,   X a basis of D
 *
 * does too: a horizontal gauge momentum [FassoGiacobbeSansonetto2008].  f is sought in a library of functions.
 *
 * With a in L = 1/2 v K v + a v - V, J_a = e_a . (K v + a), and forces add f^a e_a . Q; then only constant f are
 * sought.  Where the constraints are affine, omega(v) + b = 0, and c^a e_a satisfies them itself, E - c^a J_a is
 * conserved, the moving energy [FassoSansonetto2016]. */
#ifndef NH_MOMENTA_H
#define NH_MOMENTA_H

#include "integrals/prove.h"
#include "reduction/action.h"

typedef struct {
    bool horizontal; /* f is constant, and f^a e_a lies in D */
    /* f is not constant; neither: f is constant, and the reaction does no work along f^a e_a though that is not in D */
    bool gauge;
    bool of_lagrangian; /* f^a e_a lies in D and leaves L invariant, but not D */
    bool moving;        /* not a momentum: the moving energy, f = c */
    nh_ex *f;           /* d */
    nh_ex *field;       /* m: f^a e_a */
    nh_ex value;        /* f^a J_a (or E - f^a J_a) as a function of (q, v) */
    double residual;    /* of the two conditions, relative */
    nh_proof proof;
    bool local; /* the field or the value is many-valued on an angle */
} nh_momentum;

typedef struct {
    size_t count;
    bool untried;          /* the constraints are not solved for velocities: no momenta were sought */
    nh_momentum *momentum; /* in the kinetic's arena */
} nh_momenta;

/* A momentum is proved only if its generators are: each proof becomes that of both.  Returns how many momenta are not
 * proved. */
size_t nh_momenta_unproved(nh_momenta *momenta, const nh_action *action);
/* For momenta that are not proved the rate itself decides, by a model with accelerations: refuted ones are left out.
 * Numbers that are small in a generator (lengths of a nanometre in a system of metres) may decide about the rate. */
void nh_momenta_confirm(nh_momenta *momenta, const nh_model *model, const nh_options *options);

/* Finds which of them are local. */
void nh_momenta_mark(nh_momenta *momenta, const nh_kinetic *kinetic);

/* Constants c (d) with omega(c^a e_a) = 0 (with `offset`: + b = 0) and c^a e_a . Q = 0, known in doubles, as
   expressions of the parameters. */
nh_proof nh_momenta_horizontal(const nh_action *action, const double *c, bool offset, const nh_options *options,
                               nh_ex *out);

/* All conserved momenta whose sections f are in the library, with their proofs, in the arena of the kinetic data.
 * False with an error where the null space cannot be computed. */
bool nh_momenta_find(nh_momenta *out, const nh_action *action, const nh_options *options, nh_error *error);

#endif
