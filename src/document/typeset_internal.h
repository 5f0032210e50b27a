/* typeset_internal: declarations for reading and writing typeset formulas. */
#ifndef NH_TYPESET_INTERNAL_H
#define NH_TYPESET_INTERNAL_H

#include "base/memory.h"
#include "document/typeset.h"

typedef enum {
    NH_FORMULA_NODE_NUMBER,
    NH_FORMULA_NODE_NAME,
    NH_FORMULA_NODE_CALL,
    NH_FORMULA_NODE_MINUS,
    NH_FORMULA_NODE_SUM,
    NH_FORMULA_NODE_PRODUCT,
    NH_FORMULA_NODE_FRACTION,
    NH_FORMULA_NODE_POWER,
    NH_FORMULA_NODE_EQUATION
} nh_formula_node_kind;

/* A formula as it is printed. */
typedef struct nh_formula_node nh_formula_node;
struct nh_formula_node {
    nh_formula_node_kind kind;
    const char *text; /* text of a number, a name (without primes) or a function */
    size_t primes;
    bool minus;             /* a term of a sum that is subtracted */
    bool followed;          /* a function behind which a factor could be read as part of its argument */
    nh_formula_node *child; /* the first of its parts */
    nh_formula_node *next;  /* the next part of the same whole */
};

/* The markup of one form: around a group, around a symbol with an index, a power or an accent, and so on. */
typedef struct {
    const char *group[2], *base[2], *fraction[3], *root[2], *power[3], *below[3], *dot[2], *ddot[2], *open, *close,
        *bar[2];
    const char *plus, *minus, *equal, *times, *dot_times, *apply, *comma, *number[2], *italic[2], *upright[2], *pi;
    const char *flat_open, *flat_close; /* around what is not tall; open and close grow with their contents */
    const char *wide_open, *wide_close, *wide_bar, *slash; /* parentheses and bars between which a line may break */
    const char *tall_open, *tall_close;                    /* the same around fractions, as high as these */
    const char *next_plus, *next_minus;                    /* text at the beginning of a piece */
} nh_typeset_script;

const nh_typeset_script *nh_typeset_script_of(nh_typeset_form form);

typedef struct {
    nh_typeset_form form;
    const nh_typeset_script *s;
    nh_text *out;
} nh_typeset_writer;

/* Does it contain a fraction, outside of exponents? */
bool nh_typeset_tall(const nh_formula_node *e);
/* Writes it in one piece. */
void nh_typeset_put(const nh_typeset_writer *w, const nh_formula_node *e);
void nh_typeset_parenthesised(const nh_typeset_writer *w, const nh_formula_node *e);
/* Does it begin with the name of a function, as cos x does and a square root does not? */
bool nh_typeset_names_a_function(const nh_formula_node *e);
/* The name of a function, without its argument. */
void nh_typeset_function(const nh_typeset_writer *w, const char *name);
/* Functions with letters and indices of their own (typeset_named.c): writes the letter with its index; returns the
 * first of the arguments in parentheses. */
bool nh_typeset_is_named(const char *name);
const nh_formula_node *nh_typeset_named_head(const nh_typeset_writer *w, const nh_formula_node *call);
/* The separator behind argument k of these. */
void nh_typeset_named_comma(const nh_typeset_writer *w, const char *name, size_t k);
/* The separator between two factors; `factor` is the second.  True: a dot. */
bool nh_typeset_times(const nh_typeset_writer *w, const nh_formula_node *factor);

/* NULL when the text does not belong to the language. */
nh_formula_node *nh_typeset_read(nh_arena *arena, const char *text);
/* Do the first `length` characters spell a Greek letter? */
bool nh_typeset_is_greek(const char *text, size_t length);

#endif
