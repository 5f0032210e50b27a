#include "evaluate/machine.h"

#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "evaluate/compile.h"
#include "base/memory.h"
#include "base/recovery.h"
#include "evaluate/tape_internal.h"
#include "graph/function.h"

enum { most_machines = 64, most_instructions = 20000 };
static const char *const entry_point = "nh_code";

/* ---- the text ---- */

static void put_value(double x, nh_text *out)
{
    if (isnan(x)) nh_text_add(out, "__builtin_nan(\"\")");
    else if (isinf(x)) nh_text_add(out, x > 0 ? "__builtin_inf()" : "-__builtin_inf()");
    else nh_text_addf(out, "%a", x);
}

/* What a register holds at this point of the program. */
static void put_register(const nh_tape *t, const uint32_t *writer, uint32_t r, nh_text *out)
{
    if (writer[r]) nh_text_addf(out, "t%" PRIu32, writer[r] - 1);
    else if (r < t->inputs) nh_text_addf(out, "x%" PRIu32, r);
    else {
        nh_text_add(out, "(");
        put_value(t->constant[r - t->inputs], out);
        nh_text_add(out, ")");
    }
}

/* The text before, between and after the operands; `between` NULL: there is one operand.  The same operations as
 * op_value of tape.c. */
typedef struct {
    const char *before, *between, *after;
} notation;

static notation notation_of(unsigned op)
{
    static const notation plain[] = {
        [NH_OP_ADD] = {"", " + ", ""},    [NH_OP_SUB] = {"", " - ", ""},       [NH_OP_MUL] = {"", " * ", ""},
        [NH_OP_DIV] = {"", " / ", ""},    [NH_OP_NEG] = {"-", NULL, ""},       [NH_OP_INV] = {"1 / ", NULL, ""},
        [NH_OP_SQUARE] = {"", " * ", ""}, [NH_OP_SQRT] = {"sqrt(", NULL, ")"}, [NH_OP_POW] = {"pow(", ", ", ")"}};
    if (op < NH_OP_FUNCTION) return plain[op];
    return (notation){"(", op - NH_OP_FUNCTION == NH_ATAN2 ? ", " : NULL, ")"};
}

static void put_instruction(const nh_tape *t, const uint32_t *writer, const nh_instruction *x, nh_text *out)
{
    notation n = notation_of(x->op);
    if (x->op >= NH_OP_FUNCTION)
        nh_text_add(out, x->op == NH_OP_FUNCTION + NH_ABS ? "fabs"
                                                          : nh_function_name((nh_function)(x->op - NH_OP_FUNCTION)));
    nh_text_add(out, n.before);
    put_register(t, writer, x->a, out);
    if (n.between) {
        nh_text_add(out, n.between);
        put_register(t, writer, x->op == NH_OP_SQUARE ? x->a : x->b, out);
    }
    nh_text_add(out, n.after);
}

static void put_prototypes(nh_text *out)
{
#define X(id, name, parity, at_zero, at_one) #name,
    static const char *const one[] = {NH_ELEMENTARY_TABLE(X) "sqrt", "fabs"};
#undef X
    for (size_t i = 0; i < sizeof one / sizeof *one; i++) nh_text_addf(out, "double %s(double);\n", one[i]);
    nh_text_add(out, "double pow(double, double);\ndouble atan2(double, double);\n"
                     "static double sign(double a) { return a > 0 ? 1 : a < 0 ? -1 : a; }\n\n");
}

/* Reads all inputs before the first output is written: they may share memory. */
static void machine_text(const nh_tape *t, nh_text *out)
{
    /* 1 + instruction that wrote a register last; 0: none yet */
    uint32_t *writer = nh_alloc_array(t->registers + 1, sizeof *writer);
    put_prototypes(out);
    nh_text_addf(out, "void %s(const double *in, double *out)\n{\n", entry_point);
    for (size_t i = 0; i < t->inputs; i++) nh_text_addf(out, "    const double x%zu = in[%zu];\n", i, i);
    for (size_t i = 0; i < t->length; i++) {
        nh_text_addf(out, "    const double t%zu = ", i);
        put_instruction(t, writer, &t->code[i], out);
        nh_text_add(out, ";\n");
        writer[t->code[i].to] = (uint32_t)i + 1;
    }
    for (size_t k = 0; k < t->outputs; k++) {
        nh_text_addf(out, "    out[%zu] = ", k);
        put_register(t, writer, t->output[k], out);
        nh_text_add(out, ";\n");
    }
    nh_text_add(out, "}\n");
    nh_free(writer);
}

/* ---- what was compiled ---- */

struct nh_machine {
    nh_text text;
    nh_compilation *compilation;
    nh_machine_code *code;
    bool busy;
};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static nh_machine machine[most_machines];
static size_t machines;

void nh_machine_cleanup(void)
{
    for (size_t i = 0; i < machines; i++) {
        nh_compile_free(machine[i].compilation);
        nh_text_clear(&machine[i].text);
    }
    machines = 0;
}

static nh_machine *look_up(const nh_text *text)
{
    for (size_t i = 0; i < machines; i++)
        if (machine[i].text.length == text->length && !memcmp(machine[i].text.data, text->data, text->length))
            return &machine[i];
    return NULL;
}

static nh_machine *put_into_list(nh_text *text)
{
    if (machines == most_machines || (!machines && atexit(nh_machine_cleanup))) return NULL;
    nh_machine *m = &machine[machines];
    *m = (nh_machine){.text = *text, .compilation = nh_compile(nh_text_string(text)), .busy = true};
    nh_text_init(text);
    machines++;
    return m;
}

static nh_machine *machine_of(const nh_tape *tape, bool start)
{
    if (tape->length > most_instructions) return NULL;
    for (size_t i = 0; i < tape->length; i++) /* the C library does not have these; they take most of the time */
        if (nh_op_is_named(tape->code[i].op)) return NULL;
    nh_text text;
    nh_text_init(&text);
    machine_text(tape, &text);
    nh_held held;
    nh_hold(&held, &lock);
    nh_machine *m = look_up(&text);
    if (!m && start) m = put_into_list(&text);
    nh_release(&held);
    nh_text_clear(&text);
    return m;
}

nh_machine *nh_machine_known(const nh_tape *tape) { return machine_of(tape, false); }
nh_machine *nh_machine_of(const nh_tape *tape) { return machine_of(tape, true); }

nh_machine_code *nh_machine_get(nh_machine *m, bool wait, bool *busy)
{
    nh_held held;
    nh_hold(&held, &lock);
    if (m->busy) {
        void *address = nh_compile_result(m->compilation, entry_point, wait, &m->busy);
        memcpy(&m->code, &address, sizeof m->code); /* ISO C knows no conversion from a pointer to an object */
    }
    *busy = m->busy;
    nh_machine_code *code = m->code;
    nh_release(&held);
    return code;
}

const char *nh_machine_words(const nh_machine *m) { return nh_compile_words(m->compilation); }
