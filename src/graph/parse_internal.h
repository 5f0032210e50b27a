/* parse_internal: the state of the parser, shared by parse.c (operators, numbers) and parse_names.c (names, calls). */
#ifndef NH_PARSE_INTERNAL_H
#define NH_PARSE_INTERNAL_H

#include "graph/parse.h"

enum { NH_PARSE_NAME = 63 /* characters of a name */ };

typedef struct {
    nh_dag *dag;
    const char *text;
    size_t at;
    size_t number_end;           /* where the last factor ended, if it was a number without a power; else SIZE_MAX */
    size_t bare_begin, bare_end; /* the argument of the last call without parentheses: sin x */
    int depth;
    bool equation; /* parsing "lhs = rhs" */
    nh_resolve *resolve;
    void *context;
    nh_parse_fault *fault;
} nh_parser;

/* Record what is wrong at an offset, and what helps.  Return false. */
bool nh_parse_fail(nh_parser *p, size_t offset, const char *format, ...) __attribute__((format(printf, 3, 4)));
bool nh_parse_hint(nh_parser *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* A text in the place of the bytes [from, to). */
typedef struct {
    size_t from, to;
    const char *with;
} nh_parse_change;
/* The hint "write `...`": the text, or of a long one the term, with a change.  And with two of them to choose from. */
bool nh_parse_propose(nh_parser *p, size_t from, size_t to, const char *with);
bool nh_parse_propose_two(nh_parser *p, nh_parse_change one, nh_parse_change other);
/* A correct text may have no value. */
bool nh_parse_has_no_value(nh_parser *p);

/* The next character that is no blank; where the token before it ended; does a name begin here, possibly with a Greek
 * letter?  Of `begins_function`: is it that of a function? */
char nh_parse_peek(nh_parser *p);
size_t nh_parse_token_end(const nh_parser *p);
bool nh_parse_begins_name(const nh_parser *p);
bool nh_parse_begins_function(const nh_parser *p);
/* The text behind a complete operand, where an operator or `closing` is expected. */
bool nh_parse_no_operator(nh_parser *p, const char *closing);
/* The same where an operand is expected. */
bool nh_parse_no_operand(nh_parser *p);

/* ½ and its like: the fraction, and the bytes that it takes, or 0. */
size_t nh_parse_fraction(const char *at, long *top, long *bottom);

bool nh_parse_sum(nh_parser *p, nh_ex *out);
bool nh_parse_atom(nh_parser *p, nh_ex *out);
bool nh_parse_name(nh_parser *p, nh_ex *out); /* with its arguments, where it is a function */
bool nh_parse_closing(nh_parser *p);
/* Refuses what stands behind `sin x`: it may belong to the argument. */
bool nh_parse_bare_argument_ends(nh_parser *p);
/* base^exponent, whose sign `^` stands at offset `at`. */
bool nh_parse_raise(nh_parser *p, nh_ex base, nh_ex exponent, size_t at, nh_ex *out);

#endif
