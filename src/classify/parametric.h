/* parametric: the equations of motion at a point, modulo a prime, as series whose coefficients are polynomials in one
 * parameter.
 *
 *     Q Gamma = sum over j of lambda^j G_j,      Q = q det M,
 *
 * where q clears what M, A and rho divide by.  Q Gamma(Phi) = 0 has the same solutions as Gamma(Phi) = 0 wherever Q(q0,
 * lambda) is not zero.  The G_j are found by interpolation, and checked at one more value; a common factor of all
 * coefficients that depends on lambda alone is divided out.
 *
 * Without constraints the coordinates are those of the file.  With constraints they are those of an adapted frame,
 * which must not depend on lambda.  Cyclic ones may be left out: then Phi has coefficients that do not depend on them,
 * and where the velocities have all directions of the others there is no need of a frame.
 *
 * Instead of the equations of motion the series may be those of a linear family (linear_family.h): Q, then its
 * coefficients times the common denominator Q.  They are in the coordinates of the file, or in those of the family.
 *
 * With two parameters, lambda and mu, there are G_ij for lambda^i mu^j.  The second one may also be held at a residue,
 * and a third one, nu, always is. */
#ifndef NH_PARAMETRIC_H
#define NH_PARAMETRIC_H

#include "count/count_internal.h"
#include "classify/linear_family.h"
#include "classify/staircase.h"

typedef struct {
    nh_counter counter; /* the equations, with the parameter as a symbol, and the known integrals */
    /* indices of lambda, mu, nu in the model, whose other parameters are replaced by numbers, and their residues */
    size_t parameters, parameter[NH_MOST_PARAMETERS];
    nh_residue value[NH_MOST_PARAMETERS];
    bool held;                          /* mu keeps its residue, as nu always does: the series are those of lambda */
    bool shape;                         /* coefficients do not depend on cyclic coordinates, which are left out */
    const nh_linear_family *linear;     /* NULL: the equations of motion */
    nh_ex *entry;                       /* coefficients of `linear`, and masses, in canonical form */
    size_t kept, *index;                /* where there is no frame: the coordinates of the series */
    nh_ex *factor;                      /* q is a product of powers of these, which depend on the parameter; */
    size_t factors, *of_mass, *of_rest; /* their exponents: in the denominator of M, and needed beyond it */
    const char *obstacle;
} nh_parametric;

/* Is e a rational function of the symbol?  Integrals that are not cannot be followed. */
bool nh_parametric_rational(nh_dag *dag, nh_ex e, nh_ex symbol);

/* The obstacle of equations that do not depend on any parameter. */
extern const char *const nh_parametric_constant;

/* Borrows the model and the question, in which these parameters are indeterminates. */
void nh_parametric_open(nh_parametric *family, const nh_model *model, size_t parameters, const size_t *parameter,
                        bool shape, const nh_linear_family *linear, const nh_count_question *question);
void nh_parametric_close(nh_parametric *family);

/* Moves to another point, which follows from prime and seed; false: it is singular. */
bool nh_parametric_choose(nh_parametric *family, nh_prime field, uint64_t seed);

/* Is Q, and with it det M or what the equations are divided by, zero at the parameters' residues and every point?
 * There are no equations of motion, although they may have a limit (where a mass cancels, say).  Decided at three
 * points; the point of the family moves. */
bool nh_parametric_singular(nh_parametric *family, nh_prime field);

typedef struct {
    nh_jet_ring *ring;
    size_t degree, second; /* degrees in lambda and in mu */
    /* residues of one coefficient: Q, then the fields, then the rates, as in graded_solver.h */
    size_t length;
    size_t fields_at, rates_at;
    nh_residue *coefficient; /* (second + 1) x (degree + 1) x length */
    nh_residue *coordinate;  /* coordinates of the equations, as series */
    bool split;              /* solutions are even or odd in the velocities */
} nh_parametric_series;

/* The caller frees the series.  NULL: they are too long, or not polynomial in the parameter (an obstacle), or the point
 * is not `regular`. */
nh_parametric_series *nh_parametric_series_create(nh_parametric *family, size_t order, bool *regular);
void nh_parametric_series_free(nh_parametric_series *series);

/* Writes the equations at one value of the only parameter into `values` (`length` residues); `infinite`: their limit,
 * the coefficient of the highest power. */
void nh_parametric_at(const nh_parametric_series *series, nh_residue lambda, bool infinite, nh_residue *values);
/* The linear system of these values. */
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
/* Rewrites, in place, a polynomial in lambda (v = 0) and mu (v = 1), of which this is the v-th variable, as one in the
 * v-th parameter; where the variable cannot tell, the origin is added as a root. */
void nh_parametric_back(const nh_parametric_variable *variable, int v, nh_prime field,
                        nh_residue_polynomial *polynomial);

/* The same for one level of a linear family, in lambda and mu themselves. */
bool nh_parametric_linear_pencil(const nh_parametric *family, const nh_parametric_series *series, size_t level,
                                 size_t most, nh_sparse_pencil *out);
/* P of a linear family where its coefficients are `values` (nh_parametric_at); false: it would take more work than
 * `most`. */
bool nh_parametric_linear_dimension(const nh_parametric *family, const nh_parametric_series *series,
                                    const nh_residue *values, size_t level, double most, size_t *out);

/* The number of coordinates of the series, and the largest of their weights. */
size_t nh_parametric_kept(const nh_parametric *family);
/* 0: no regular point was found, or the time limit was reached */
size_t nh_parametric_step(const nh_parametric *family);

#endif
