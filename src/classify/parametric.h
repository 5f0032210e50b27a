/* parametric: the equations of motion at a point, modulo a prime, as series whose coefficients are polynomials in one
 * parameter.
 *
 *     Q Gamma = sum over j of lambda^j G_j,      Q = q det M,
 *
 * where q clears what M, A and rho divide by. Q Gamma(Phi) = 0 has the solutions of Gamma(Phi) = 0 wherever Q(q0,
 * lambda) is not zero. The G_j are found by interpolation, and one more value has to agree; a common factor of all
 * coefficients that depends on lambda alone is divided out.
 *
 * Without constraints the coordinates are those of the file. With constraints they are those of an adapted frame, which
 * has to be free of lambda. Cyclic ones may be left out: then Phi has coefficients that do not depend on them, and
 * where the velocities have all directions of the others there is no need of a frame.
 *
 * Instead of the equations of motion the series may be those of a linear family (linear_family.h): Q, then its
 * coefficients times what clears them. They are in the coordinates of the file, or in those of the family.
 *
 * With two parameters, lambda and mu, there are G_ij for lambda^i mu^j. A second parameter may also be held at a
 * residue, and a third one, nu, is always. */
#ifndef NH_PARAMETRIC_H
#define NH_PARAMETRIC_H

#include "count/count_internal.h"
#include "classify/linear_family.h"
#include "classify/staircase.h"

typedef struct {
    nh_counter counter;      /* the equations, with the parameter as a symbol, and the known integrals */
    size_t parameter;        /* its index in the model, whose other parameters have been replaced, but for */
    size_t second;           /* mu; SIZE_MAX: there is none */
    bool held;               /* mu is this residue, */
    nh_residue value;        /* and the series are those of one parameter */
    size_t third;            /* nu, which is held at a residue always; SIZE_MAX: there is none */
    nh_residue third_value;
    bool shape;              /* without cyclic coordinates */
    const nh_linear_family *linear; /* or NULL */
    nh_ex *entry;            /* its coefficients and masses, canonical */
    size_t kept, *index;     /* where there is no frame: the coordinates of the series */
    nh_ex *factor;           /* q is a product of powers of these, which depend on the parameter: */
    size_t factors, *of_mass, *of_rest; /* exponents: what clears M, and what is needed beyond it */
    const char *obstacle;
} nh_parametric;

/* Is e a rational function of the symbol?  Integrals that are not cannot be followed. */
bool nh_parametric_rational(nh_dag *dag, nh_ex e, nh_ex symbol);

/* The obstacle where the equations are free of all parameters. */
extern const char *const nh_parametric_constant;

/* Borrows the model and the question, of which the parameters (lambda, mu, nu; SIZE_MAX: there is none) are
 * indeterminates. */
void nh_parametric_open(nh_parametric *family, const nh_model *model, const size_t parameter[3], bool shape,
                        const nh_linear_family *linear, const nh_count_question *question);
void nh_parametric_close(nh_parametric *family);

/* Another point, which follows from both numbers; false: a singular one. */
bool nh_parametric_choose(nh_parametric *family, nh_prime field, uint64_t seed);

typedef struct {
    nh_jet_ring *ring;
    size_t degree, second;   /* in lambda, in mu */
    size_t length;           /* of one coefficient: Q, then the fields, then the rates, as in graded_solver.h */
    size_t fields_at, rates_at;
    nh_residue *coefficient; /* (second + 1) x (degree + 1) x length */
    nh_residue *coordinate;  /* of the equations, as series */
    bool split;              /* solutions are even or odd in the velocities */
} nh_parametric_series;

/* NULL: too long, not polynomial in the parameter (an obstacle), or the point is not `regular`. */
nh_parametric_series *nh_parametric_series_create(nh_parametric *family, size_t order, bool *regular);
void nh_parametric_series_free(nh_parametric_series *series);

/* The equations at one value of the only parameter; `infinite`: the coefficient of the highest power. `values` has room
 * for `length` residues. */
void nh_parametric_at(const nh_parametric_series *series, nh_residue lambda, bool infinite, nh_residue *values);
/* Their linear system. */
nh_graded_problem nh_parametric_problem(const nh_parametric *family, const nh_parametric_series *series,
                                        const nh_residue *values, size_t degree, nh_parity parity);

/* The variable of a pencil: x = lambda - origin, or its reciprocal; c_alpha is x^(scale . alpha) times another
 * unknown. */
typedef struct {
    nh_residue origin;
    bool reciprocal, scaled;
    int scale[16];
} nh_parametric_variable;

/* The linear system for every value, `variable` for each of the parameters: the equations up to the weight order - 1
 * for the series up to the weight `order`, in a variable in which its degree is low and much of it is constant. False:
 * more than `most` unknowns, companions included. The entries are on the heap. */
bool nh_parametric_pencil(const nh_parametric *family, const nh_parametric_series *series, size_t degree,
                          nh_parity parity, size_t most, nh_sparse_pencil *out, nh_parametric_variable *variable);
/* A polynomial in that variable as one in the parameter, with the origin as a root where the variable says nothing
 * about it; in place. */
void nh_parametric_back(const nh_parametric_variable *variable, nh_prime field, nh_residue_polynomial *chi);

/* Weights of the coordinates of the series, how many they are, and the largest. */
size_t nh_parametric_kept(const nh_parametric *family);
size_t nh_parametric_step(const nh_parametric *family); /* 0: of no regular point, also after the time limit */

#endif
