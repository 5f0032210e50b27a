/* What reading and writing of formulas for the eye share. */
#ifndef NH_TYPESET_INTERNAL_H
#define NH_TYPESET_INTERNAL_H

#include "base/memory.h"
#include "expr/typeset.h"

typedef enum { NH_SEEN_NUMBER, NH_SEEN_NAME, NH_SEEN_CALL, NH_SEEN_MINUS, NH_SEEN_SUM, NH_SEEN_PRODUCT, NH_SEEN_FRACTION, NH_SEEN_POWER, NH_SEEN_EQUATION } nh_seen_kind;

/* A formula as it stands on paper. */
typedef struct nh_seen nh_seen;
struct nh_seen {
    nh_seen_kind kind;
    const char *text;   /* of a number, a name (without primes) or a function */
    size_t primes;
    bool minus;         /* as a term of a sum: it is subtracted */
    nh_seen *child;     /* first of its parts */
    nh_seen *next;      /* its neighbour */
};

/* NULL when the text is not of the language. */
nh_seen *nh_typeset_read(nh_arena *arena, const char *text);
/* Do the first `length` characters spell a Greek letter? */
bool nh_typeset_is_greek(const char *text, size_t length);
/* As nh_typeset, of what was read. */
void nh_typeset_seen(const nh_seen *e, nh_typeset_form form, nh_text *out);

#endif
