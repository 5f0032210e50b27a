/* normal_quotient: quotients of polynomials in kernels, modulo what the kernels satisfy.
 *
 *     q = num / den,   num, den in Z[k1, ..., kn],   k_g^m = value  (sin^2 = 1 - cos^2, r^m = radicand)
 *
 * Every operation reduces by the relations and cancels the gcd.  Quotients belong to their field and are freed with
 * it.  When a polynomial or the work done exceeds the limits the field records it and results mean nothing: check at
 * the end.  Only the sources behind this header use FLINT. */
#ifndef NH_NORMAL_QUOTIENT_H
#define NH_NORMAL_QUOTIENT_H

#include "base/memory.h"
#include "graph/expr.h"

typedef struct nh_quotient_field nh_quotient_field;
typedef struct nh_quotient nh_quotient;
typedef enum { NH_FIELD_FINE, NH_FIELD_TOO_LARGE, NH_FIELD_UNDEFINED } nh_quotient_field_state;

/* A field with so many generators and without relations, whose polynomials have at most max_terms terms. */
nh_quotient_field *nh_quotient_field_create(size_t generators, size_t max_terms);
void nh_quotient_field_free(nh_quotient_field *field);
nh_quotient_field_state nh_quotient_field_state_of(const nh_quotient_field *field);
void nh_quotient_field_break(nh_quotient_field *field, nh_quotient_field_state why);

/* Declares generator^order = value: a quotient in generators without relation or with an earlier one, and in lower
 * powers of the generator itself. */
void nh_quotient_field_relate(nh_quotient_field *field, size_t generator, unsigned order, const nh_quotient *value);
/* The value of a relation may need later relations: all relations are applied twice. */
void nh_quotient_field_repeat(nh_quotient_field *field);
/* s^2 = 1 - c^2 or, hyperbolic, s^2 = c^2 - 1.  Flipping eliminates even powers of c instead of s. */
void nh_quotient_field_relate_pair(nh_quotient_field *field, size_t s, size_t c, bool hyperbolic);
size_t nh_quotient_field_pairs(const nh_quotient_field *field);
void nh_quotient_field_flip_pair(nh_quotient_field *field, size_t pair);

const nh_quotient *nh_quotient_number(nh_quotient_field *field, nh_num value); /* also a double exactly */
const nh_quotient *nh_quotient_power_of(nh_quotient_field *field, size_t generator, int64_t power);
const nh_quotient *nh_quotient_add(nh_quotient_field *field, const nh_quotient *a, const nh_quotient *b);
const nh_quotient *nh_quotient_mul(nh_quotient_field *field, const nh_quotient *a, const nh_quotient *b);
const nh_quotient *nh_quotient_inv(nh_quotient_field *field, const nh_quotient *a);
const nh_quotient *nh_quotient_pow(nh_quotient_field *field, const nh_quotient *a, int64_t n);
const nh_quotient *nh_quotient_scale(nh_quotient_field *field, const nh_quotient *a, nh_num c);
/* A square root of a as a quotient of polynomials, without regard to relations; NULL: there is none. */
const nh_quotient *nh_quotient_root(nh_quotient_field *field, const nh_quotient *a);
/* reduced by the present relations */
const nh_quotient *nh_quotient_again(nh_quotient_field *field, const nh_quotient *a);
/* The same with a denominator free of sines and square roots, unless that is long. */
const nh_quotient *nh_quotient_rationalise(nh_quotient_field *field, const nh_quotient *a);
/* a = whole + rest, whole without denominator (but a number), rest = remainder/denominator. */
void nh_quotient_divide(nh_quotient_field *field, const nh_quotient *a, const nh_quotient **whole,
                        const nh_quotient **rest);
bool nh_quotient_is_zero(const nh_quotient_field *field, const nh_quotient *a);
bool nh_quotient_equal(const nh_quotient_field *field, const nh_quotient *a, const nh_quotient *b);
bool nh_quotient_has(const nh_quotient_field *field, const nh_quotient *a, size_t generator);
size_t nh_quotient_terms(const nh_quotient *a);

/* One factor as a list of terms: coefficient[i] * prod_g k_g^exponent[i*generators + g]. */
typedef struct {
    size_t terms;
    nh_num *coefficient;
    int64_t *exponent;
    int64_t power;
} nh_factor;

/* q = constant * prod_g k_g^exponent[g] * prod_j factor[j]^power */
typedef struct {
    size_t generators, factors;
    nh_num constant;
    int64_t *exponent;
    nh_factor *factor;
} nh_pieces;

/* Splits q into content, monomial and the rest; with `factored`, numerator and denominator are factored as well when
 * that is cheap.  False when a coefficient does not fit into 64 bits. */
bool nh_pieces_make(nh_quotient_field *field, nh_arena *arena, const nh_quotient *q, bool factored, nh_pieces *out);

#endif
