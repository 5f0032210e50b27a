/* source: expressions as statements of programming languages.
 *
 * The text of one function body: names for its symbols, then blocks of statements.  A subexpression that occurs more
 * than once is computed once and gets a name; long expressions are split into such statements, too, so that line
 * lengths and nesting are bounded. */
#ifndef NH_SOURCE_H
#define NH_SOURCE_H

#include "base/text.h"
#include "graph/function.h"

/* How a language writes expressions. */
typedef struct {
    const char *name;
    /* words, separated by blanks, that no symbol may have as a name: keywords, and names that the code itself uses */
    const char *reserved;
    const char *call[NH_FUNCTION_COUNT]; /* names of functions, without the parenthesis */
    /* Named functions, with $1, .. for the arguments.  NULL: no common library has it. */
    const char *named[NH_FUNCTION_COUNT];
    /* text by which code that uses a library is recognised, and the line that such code needs */
    const char *library[2][2];
    /* text by which code that needs a function for Riemann's equation is recognised, and that function */
    const char *series[2];
    const char *root; /* the square root */
    const char *pi;
    const char *power[3];      /* text before, between and after base and exponent */
    const char *declare, *end; /* around `name = value` of a statement */
    const char *fraction[3];   /* text around a fraction of whole numbers that stands alone; NULL: a quotient */
    bool exact;                /* numbers are written exactly, not as doubles */
    bool point;                /* whole numbers have a decimal point */
    bool products;             /* small powers are products, and half powers have roots */
    bool plain;                /* the expression language itself: velocities keep their prime */
} nh_source_language;

extern const nh_source_language nh_source_c, nh_source_python, nh_source_sympy, nh_source_matlab, nh_source_js,
    nh_source_plain;

typedef struct nh_source nh_source;

/* Borrows the graph as it is now.  The text goes to `out`, each statement after `indent`. */
nh_source *nh_source_create(const nh_source_language *language, nh_dag *dag, nh_text *out);
void nh_source_free(nh_source *code);
void nh_source_indent(nh_source *code, const char *indent);

/* `wish`, or a similar name that nothing else has here; in the arena of the code. */
const char *nh_source_word(nh_source *code, const char *wish);
/* The name of a symbol: x' becomes x_dot.  The same symbol has the same name. */
const char *nh_source_name(nh_source *code, nh_ex symbol);
/* Lets these words stand for the symbol from now on. */
void nh_source_set(nh_source *code, nh_ex symbol, const char *words);

/* Introduces no names, however long an expression is. */
void nh_source_whole(nh_source *code);
/* Counts an expression that the body computes: the counts decide which parts get names. */
void nh_source_plan(nh_source *code, size_t n, const nh_ex *e);
/* Writes statements for the parts of e that have names and are not written yet. */
void nh_source_parts(nh_source *code, size_t n, const nh_ex *e);
void nh_source_put(nh_source *code, nh_ex e);
/* Begins and ends a loop: what is computed inside is not known behind it, and has counts of its own. */
void nh_source_open(nh_source *code);
void nh_source_close(nh_source *code);

/* Does the sign function occur? */
bool nh_source_has_sign(const nh_source *code);
/* The lines for the libraries that this code uses. */
void nh_source_libraries(const nh_source_language *language, const char *code, nh_text *out);
/* The function for Riemann's equation, where this code calls it. */
void nh_source_series(const nh_source_language *language, const char *code, nh_text *out);
/* Can every function in e be written?  Otherwise the name of one that cannot; NULL: all can. */
const char *nh_source_lacks(const nh_source_language *language, const nh_dag *dag, nh_ex e);
/* An identifier of the language from any text: letters, digits and _. */
void nh_source_identifier(const nh_source_language *language, const char *text, nh_text *out);

#endif
