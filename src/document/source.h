/* source: expressions as statements of programming languages.
 *
 * The text of one function body: names for its symbols, then blocks of statements.  What occurs more than once is
 * computed once, into names of its own; long expressions are cut into such statements, too, so that no line and no
 * nesting grows without bound. */
#ifndef NH_SOURCE_H
#define NH_SOURCE_H

#include "base/text.h"
#include "graph/dag.h"

/* How a language writes expressions. */
typedef struct {
    const char *name;
    const char
        *reserved; /* words between blanks that no symbol may be called: keywords, and what the code itself uses */
    const char *call[NH_FUNCTION_COUNT]; /* functions, without the parenthesis */
    /* Named functions, with $1, .. for the arguments.  NULL: no common library has it. */
    const char *named[NH_FUNCTION_COUNT];
    const char *library[2][2];           /* what code says that uses a library, and the line which that needs */
    const char *series[2]; /* what code says that needs a function for Riemann's equation, and that function */
    const char *root;                    /* the square root */
    const char *pi;
    const char *power[3];      /* before, between and after base and exponent */
    const char *declare, *end; /* around `name = value` of a statement */
    const char *fraction[3];   /* around a fraction of whole numbers that stands alone; NULL: as a quotient */
    bool exact;                /* numbers are written as they are, not as doubles */
    bool point;                /* whole numbers have a decimal point */
    bool products;             /* small powers are products, and half ones have roots */
    bool plain;                /* the expression language itself: velocities keep their dash */
} nh_source_language;

extern const nh_source_language nh_source_c, nh_source_python, nh_source_sympy, nh_source_matlab, nh_source_plain;

typedef struct nh_source nh_source;

/* For expressions of the graph as it is now; the text goes to `out`, each statement after `indent`. */
nh_source *nh_source_create(const nh_source_language *language, nh_dag *dag, nh_text *out);
void nh_source_free(nh_source *code);
void nh_source_indent(nh_source *code, const char *indent);

/* `wish`, or the like, as a name that nothing else has here; words of the same arena as the code. */
const char *nh_source_word(nh_source *code, const char *wish);
/* The name of a symbol: x' becomes x_dot.  The same symbol has the same name. */
const char *nh_source_name(nh_source *code, nh_ex symbol);
/* The symbol stands for these words from now on. */
void nh_source_set(nh_source *code, nh_ex symbol, const char *words);

/* Nothing gets a name, however long it is. */
void nh_source_whole(nh_source *code);
/* Of all that the body computes: what is counted here decides what gets a name. */
void nh_source_plan(nh_source *code, size_t n, const nh_ex *e);
/* Statements for the parts of e that have names and are not written yet. */
void nh_source_parts(nh_source *code, size_t n, const nh_ex *e);
void nh_source_put(nh_source *code, nh_ex e);
/* Inside of a loop: what is computed there is not known behind it, and the plan is one of its own. */
void nh_source_open(nh_source *code);
void nh_source_close(nh_source *code);

/* Does the sign function occur? */
bool nh_source_has_sign(const nh_source *code);
/* The lines for the libraries that this code uses. */
void nh_source_libraries(const nh_source_language *language, const char *code, nh_text *out);
/* The function for Riemann's equation, where this code calls it. */
void nh_source_series(const nh_source_language *language, const char *code, nh_text *out);
/* Every function in e can be written; otherwise the name of one that cannot. */
const char *nh_source_lacks(const nh_source_language *language, const nh_dag *dag, nh_ex e);
/* A word of the language from any text: letters, digits and _. */
void nh_source_identifier(const nh_source_language *language, const char *text, nh_text *out);

#endif
