/* antiderivative_internal: the candidates of an antiderivative, as the files that propose them share them. */
#ifndef NH_ANTIDERIVATIVE_INTERNAL_H
#define NH_ANTIDERIVATIVE_INTERNAL_H

#include "exact/antiderivative.h"
#include "exact/form.h"

enum { NH_ANTIDERIVATIVE_CANDIDATES = 140, NH_ANTIDERIVATIVE_KERNELS = 12, NH_ANTIDERIVATIVE_FACTORS = 24 };

/* A kernel that depends on x, and the exponents that it may have in the numerator of F. */
typedef struct {
    size_t index; /* index among the kernels of f, or absent */
    nh_ex e;
    nh_kernel_kind kind;
    int64_t low, high;
} nh_antiderivative_letter;

/* A factor of a denominator. */
typedef struct {
    nh_ex e;
    int64_t power;          /* its exponent in the denominator of F */
    const nh_factor *terms; /* NULL: the factor is a kernel, or the radicand of a root */
} nh_antiderivative_divisor;

typedef struct {
    const nh_integration *in;
    nh_dag *d;
    nh_form form;
    nh_pieces pieces;
    size_t letters, divisors, count;
    nh_antiderivative_letter letter[NH_ANTIDERIVATIVE_KERNELS];
    nh_antiderivative_divisor divisor[NH_ANTIDERIVATIVE_FACTORS];
    nh_ex candidate[NH_ANTIDERIVATIVE_CANDIDATES];
    int64_t degree; /* largest degree of the numerator of F */
    bool full;      /* a list was full */
} nh_antiderivative_builder;

/* Adds a candidate that depends on x and is not there. */
void nh_antiderivative_put(nh_antiderivative_builder *builder, nh_ex g);
/* log |p| */
void nh_antiderivative_put_logarithm(nh_antiderivative_builder *builder, nh_ex p);
/* atanh f where |f| < 1, atanh 1/f where |f| > 1: the two have one derivative. */
void nh_antiderivative_put_area(nh_antiderivative_builder *builder, nh_ex f);
/* The candidates of the square roots of quadratic polynomials, and of products of two roots. */
void nh_antiderivative_put_roots(nh_antiderivative_builder *builder);

/* The elliptic integrals of roots of a + c sin(u)^2, and what is elementary in integrals with such a root and poles. */
void nh_antiderivative_put_elliptic(nh_antiderivative_builder *builder);
/* int f dx, f a constant over the root of k_0 + k_2 x^2 + k_4 x^4; `halves`: of such a form in tan(u/2) or
 * tanh(u/2). */
bool nh_antiderivative_elliptic_quartic(const nh_antiderivative_builder *builder, nh_ex f, bool halves, nh_ex *F);

/* The sign of e; 0: it changes, or is not known. */
int nh_antiderivative_sign(const nh_antiderivative_builder *builder, nh_ex e);
/* The sign that decides between a real logarithm and an arctangent, where both are candidates for the two signs of
 * e. */
int nh_antiderivative_mostly(const nh_antiderivative_builder *builder, nh_ex e);
/* sqrt |D|.  Square factors are taken out of the root, whatever their signs: a candidate may have either sign. */
nh_ex nh_antiderivative_root(const nh_antiderivative_builder *builder, nh_ex D);

#endif
