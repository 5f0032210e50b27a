/* parse: the expression language of system files (docs/formats.md).
 *
 *     expression = term { (+|-) term }        term  = unary { (*|/) unary | power }
 *     unary      = [-|+] unary | power        power = atom [ ^ unary ]       (right associative)
 *     atom       = number | name | function [ ^ number ] argument | ( expression )
 *     argument   = ( expression, .. ) | number | name
 *
 * A product has no sign where a blank is between the factors, where a number stands before a name or a parenthesis, and
 * where a name stands behind a prime or a parenthesis; not behind a quotient, which could be read in two ways, unless
 * it is a fraction without blanks whose denominator is a number: 1/2 m.  A power may also be written a**b, x' of a
 * coordinate dx/dt or diff(x, t), and all in the signs of books and of LaTeX (spelling.h, nh_name_spelled).
 * A decimal number is the exact rational it looks like, if that fits.  Names are resolved by the caller.  Parentheses,
 * calls, signs and powers may be nested 200 deep. */
#ifndef NH_PARSE_H
#define NH_PARSE_H

#include <stdint.h>

#include "base/error.h"
#include "base/text.h"
#include "graph/expr.h"
#include "graph/name.h"

typedef struct {
    size_t offset; /* offset of the error in the text, in bytes */
    char what[512], hint[256];
    bool ordinary;  /* it is written as on paper; also where there is no fault */
    bool undefined; /* the text is correct as far as it was read, but has no finite value there: 1/0, log(0) */
} nh_parse_fault;

/* Resolves a name (with its prime, "x'"); false when it is unknown, with an optional explanation in
 * fault->what/hint. */
typedef bool nh_resolve(void *context, const char *name, nh_ex *out, nh_parse_fault *fault);

/* Parses a whole text as one expression.  False with a fault. */
bool nh_parse(nh_dag *dag, const char *text, nh_resolve *resolve, void *context, nh_ex *out, nh_parse_fault *fault);

/* Parses "lhs = rhs"; a text without "=" is refused. */
bool nh_parse_equation(nh_dag *dag, const char *text, nh_resolve *resolve, void *context, nh_ex *lhs, nh_ex *rhs,
                       nh_parse_fault *fault);

#endif
