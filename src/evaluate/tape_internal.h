/* tape_internal: the instructions, shared by tape.c (compiler, one point) and tape_batch.c (many points). */
#ifndef NH_TAPE_INTERNAL_H
#define NH_TAPE_INTERNAL_H

#include "evaluate/tape.h"
#include "graph/declared.h"
#include "graph/function.h"

/* see machine.h */
typedef struct nh_machine nh_machine;
typedef void nh_machine_code(const double *in, double *out);

typedef enum {
    NH_OP_ADD,
    NH_OP_SUB,
    NH_OP_MUL,
    NH_OP_DIV,
    NH_OP_NEG,
    NH_OP_INV,
    NH_OP_SQUARE,
    NH_OP_SQRT,
    NH_OP_POW,
    NH_OP_FUNCTION /* + nh_function */
} nh_op;

typedef struct {
    uint16_t op, more; /* for functions of three and four arguments: the others are nh_tape.more[more - 1]; else 0 */
    uint32_t to, a, b;
} nh_instruction;

/* Registers of the third and the fourth argument; the same twice where there are three. */
typedef struct {
    uint32_t c, d;
} nh_more_arguments;

/* Registers: [0, inputs) inputs, [inputs, inputs + constants) constants, then temporaries. */
struct nh_tape {
    size_t inputs, constants, registers, length, outputs;
    double effort; /* units of one evaluation (base/effort.h) */
    double *constant;
    nh_instruction *code;
    nh_more_arguments *more;
    uint32_t *output;        /* register of each output */
    const nh_spline **table; /* of the functions that the graph declares; NULL: none has one */
    nh_ex unbound;
    bool has_unbound;
};

struct nh_tape_work {
    double *scalar;        /* registers, for one point */
    double *batch;         /* (registers - inputs) rows of NH_BATCH */
    double **row;          /* registers: pointers into batch or to the inputs */
    nh_machine_code *code; /* runs instead of the instructions; NULL: the instructions are interpreted */
    nh_machine *machine;   /* where the code comes from, now or later */
    double patience;       /* the tape is compiled when it has cost so many times what compiling costs */
    uint64_t left;         /* evaluations until nh_tape_look is called; 0: never */
    bool looked;           /* it was already asked whether another motion has started the compiler for this tape */
    const char *words;     /* why the tape is not compiled; or NULL */
};

/* One look: has another motion paid for the code, start the compiler, or see whether it is ready (tape_jit.c). */
void nh_tape_look(const nh_tape *tape, nh_tape_work *work);

/* Units of effort of one interpreted instruction. */
double nh_op_effort(unsigned op);

/* The value of a named function. */
double nh_tape_named(const nh_spline *const *table, unsigned op, const double *argument);

/* Is it a function that only named_value.h, or a table, computes? */
static inline bool nh_op_is_named(unsigned op)
{
    return op >= NH_OP_FUNCTION && nh_is_named_function((nh_function)(op - NH_OP_FUNCTION));
}

#endif
