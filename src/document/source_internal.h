/* source_internal: shared by source.c (names and statements) and source_expression.c (expressions). */
#ifndef NH_SOURCE_INTERNAL_H
#define NH_SOURCE_INTERNAL_H

#include "base/memory.h"
#include "document/source.h"

struct nh_source {
    const nh_source_language *language;
    nh_dag *dag;
    nh_text *out;
    nh_arena *arena;
    const char *indent;
    size_t size;            /* number of nodes when the tables were made */
    uint32_t *uses, *nodes; /* per node: how often it is printed; its length */
    unsigned char *reach;   /* per node: is it needed? */
    const char **name;      /* per node: its name; NULL: it is written out */
    struct {
        uint32_t *uses;
        const char **name;
    } outer;           /* around a loop */
    const char **word; /* names in use */
    size_t words, capacity, count;
    bool sign, whole;
};

enum { NH_IN_SUM, NH_IN_PRODUCT, NH_IN_POWER }; /* The operator around an expression. */

/* Has it a name, or is it a symbol? */
bool nh_source_simple(const nh_source *w, nh_ex e);
/* p in x^(p/q), if this is written as products and roots; otherwise 0. */
int64_t nh_source_small_power(const nh_source *w, nh_num exponent);
/* Writes the expression itself, even where it has a name. */
void nh_source_put_inside(nh_source *w, nh_ex e, int around);
/* The i-th term of a sum, with its sign, which before the first term is shown only if it is a minus; terms from `begin`
 * on, `end` excluded. */
void nh_source_put_term(nh_source *w, nh_ex e, size_t i, bool first);
void nh_source_put_terms(nh_source *w, nh_ex e, size_t begin, size_t end);

#endif
