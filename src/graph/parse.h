/* parse: the expression language of system files (docs/formats.md).
 *
 *     expression = term { (+|-) term }        term  = unary { (*|/) unary }
 *     unary      = [-|+] unary | power        power = atom [ ^ unary ]       (right associative)
 *     atom       = number | name | function ( ... ) | ( expression )
 *
 * A power may also be written a**b, and names with Greek letters (nh_name_spelled).
 * A decimal number is the exact rational it looks like, if that fits.  Names are resolved by the caller.  Parentheses,
 * calls, signs and powers may be nested 200 deep. */
#ifndef NH_PARSE_H
#define NH_PARSE_H

#include <stdint.h>

#include "base/error.h"
#include "base/text.h"
#include "graph/dag.h"

typedef struct {
    size_t offset; /* offset of the error in the text, in bytes */
    char what[512], hint[256];
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

/* A character that names cannot have stands in them by its number, as uni53F0 (so fonts name it): writes it, and reads
 * it: the length of such a word at `at`, or 0. */
void nh_name_add_code(nh_text *out, uint32_t code);
size_t nh_name_code(const char *at, uint32_t *code);
/* Is the text a name of the language: a letter or _, then letters, digits and _? */
bool nh_is_name(const char *text);
/* The ASCII text for the Greek letter or subscript digit at this place ("phi", "1"), and its length in bytes there;
 * NULL: there is none. */
const char *nh_name_of_letter(const char *at, size_t *length);
/* The name at the beginning of the text as letters, digits and _ in `out` (room > 1 bytes, cut where it is longer):
 * theta for the Greek letter and for \theta, theta_1 for theta_{1}.  Returns how many bytes of the text it takes, 0:
 * there is none. */
size_t nh_name_spelled(const char *text, char *out, size_t room);
/* The ASCII text for a typographic sign, as word processors and books use them, at this place; NULL: there is none. */
const char *nh_name_of_sign(const char *at);
/* Adds to the fault what a name is made of, and a name similar to the text.  Returns false. */
bool nh_name_hint(nh_error *error, const char *text);
/* Is the name taken by a function, `pi` or `t`? */
bool nh_is_reserved(const char *name);

#endif
