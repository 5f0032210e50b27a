/* ansatz: families of functions on the constraint submanifold, in two bases of the same span.
 *
 *     working columns   products of factors (Chebyshev polynomials over the sampled range, full-circle Fourier), well
 *                       conditioned
 *     terms             monomials, sin(k phi), ... : what is printed
 *
 * coefficient of terms = to_term * coefficient of columns.  A column is a product of factors, so that its value and its
 * derivative along Gamma come from the factors' by Leibniz' rule, three operations a point; only factors are
 * differentiated.
 *
 * Families: those of the table, explicit terms, products.   [docs/formats.md] */
#ifndef NH_ANSATZ_H
#define NH_ANSATZ_H

#include "integrals/points.h"

/* The named families: kind; name; keys in analysis files; is it in one variable?; number of columns of a family f.  For
 * each of them ansatz.c has a function build_NAME. */
#define NH_FAMILY_TABLE(X)                                                                                             \
    X(NH_POLYNOMIAL, polynomial, "basis, in, degree", false, monomials(f->in_count, f->degree))                        \
    X(NH_FOURIER, fourier, "basis, in, harmonics, frequency, constant", false,                                         \
      2 * f->in_count * f->degree + f->constant)                                                                       \
    X(NH_CHEBYSHEV, chebyshev, "basis, in, degree", true, f->degree + 1)

#define X(kind, name, keys, single, columns) kind,
typedef enum { NH_FAMILY_TABLE(X) NH_TERMS, NH_FAMILY_PRODUCT } nh_family_kind;
#undef X

typedef struct nh_family nh_family;
struct nh_family {
    nh_family_kind kind;
    size_t in_count;
    const nh_ex *in; /* functions of the submanifold */
    size_t degree;   /* polynomial: total degree; chebyshev; fourier: harmonics */
    nh_ex frequency; /* fourier: a number, an expression of parameters, or an unknown */
    bool constant;   /* fourier: 1 is in the basis */
    size_t terms;
    const nh_ex *term;
    size_t parts;
    const nh_family *part; /* product */
};

typedef struct {
    size_t count;
    const size_t *factor; /* indices into nh_ansatz.factor, with repetition */
} nh_column;

typedef struct {
    nh_arena *arena;
    nh_dag *dag;
    size_t factors, columns, terms;
    nh_ex *factor;
    nh_column *column;
    nh_ex *term;
    double *to_term; /* terms x columns, column-major */
} nh_ansatz;

/* `points` give the ranges over which Chebyshev polynomials are scaled.  NULL when the ansatz is larger than `most`
   columns. */
nh_ansatz *nh_ansatz_create(const nh_model *model, const nh_points *points, size_t families, const nh_family *family,
                            size_t most, nh_error *error);
void nh_ansatz_free(nh_ansatz *ansatz);
/* The number of columns of the families, shared ones counted several times: at least as many as the ansatz has. */
double nh_ansatz_size(size_t families, const nh_family *family);

/* A column as an expression. */
nh_ex nh_ansatz_column(const nh_ansatz *ansatz, size_t column);

#endif
