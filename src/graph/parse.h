/* parse: the expression language of system files (docs/formats.md).
 *
 *     expression = term { (+|-) term }        term  = unary { (*|/) unary }
 *     unary      = [-|+] unary | power        power = atom [ ^ unary ]       (right associative)
 *     atom       = number | name | function ( ... ) | ( expression )
 *
 * A decimal number is the exact rational it looks like, if that fits.  Names are resolved by the caller.  Parentheses,
 * calls, signs and powers may be nested 200 deep. */
#ifndef NH_PARSE_H
#define NH_PARSE_H

#include "base/error.h"
#include "graph/dag.h"

typedef struct {
    size_t offset; /* byte in the text where the trouble is */
    char what[512], hint[256];
    bool undefined; /* the text is right as far as it was read, but has no finite value there: 1/0, log(0) */
} nh_parse_fault;

/* What a name (with its prime, "x'") means; false when unknown, with an optional explanation in fault->what/hint. */
typedef bool nh_resolve(void *context, const char *name, nh_ex *out, nh_parse_fault *fault);

/* Parse a whole text as one expression. */
bool nh_parse(nh_dag *dag, const char *text, nh_resolve *resolve, void *context, nh_ex *out, nh_parse_fault *fault);

/* "lhs = rhs"; a text without "=" is refused. */
bool nh_parse_equation(nh_dag *dag, const char *text, nh_resolve *resolve, void *context, nh_ex *lhs, nh_ex *rhs,
                       nh_parse_fault *fault);

/* Is the text a name of the language: a letter or _, then letters, digits and _? */
bool nh_is_name(const char *text);
/* What is written for the Greek letter or the lowered digit at this place ("phi", "1"), and how long that is; NULL: it
   is none. */
const char *nh_name_of_letter(const char *at, size_t *length);
/* Adds what names are, and one that is like the text.  False. */
bool nh_name_hint(nh_error *error, const char *text);
/* Is the name taken by a function, `pi` or `t`? */
bool nh_is_reserved(const char *name);

#endif
