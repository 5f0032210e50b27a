#include "evaluate/tape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/effort.h"
#include "base/memory.h"
#include "evaluate/named_value.h"
#include "evaluate/tape_internal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

/* units of an evaluation beside its instructions: per call, per input and output */
static const double call = 8, each_value = 0.3;

/* ---- values of single operations ---- */

#define X(id, name, parity, at_zero, at_one)                                                                           \
    case NH_##id: return name(a);
static double call_value(unsigned f, double a, double b)
{
    switch (f) {
        NH_ELEMENTARY_TABLE(X)
    case NH_ABS: return fabs(a);
    case NH_SIGN: return a > 0 ? 1 : a < 0 ? -1 : a;
    case NH_ATAN2: return atan2(a, b);
    default: return NAN;
    }
}
#undef X

double nh_tape_named(const nh_spline *const *table, unsigned op, const double *argument)
{
    nh_function f = (nh_function)(op - NH_OP_FUNCTION);
    if (f != NH_TABLE) return nh_named_value(f, argument);
    unsigned n = (unsigned)argument[1];
    return nh_spline_value(table[(size_t)argument[0]], n % NH_SPLINE_ORDERS, n / NH_SPLINE_ORDERS, argument[2],
                           argument[3]);
}

/* `more` may be NULL where it takes at most two arguments. */
static double named_value(const nh_tape *tape, const nh_instruction *x, const double *r)
{
    const nh_more_arguments *more = x->more ? &tape->more[x->more - 1] : NULL;
    const double argument[NH_MOST_ARGUMENTS] = {r[x->a], r[x->b], more ? r[more->c] : 0, more ? r[more->d] : 0};
    return nh_tape_named(tape->table, x->op, argument);
}

static double op_value(unsigned op, double a, double b)
{
    switch (op) {
    case NH_OP_ADD: return a + b;
    case NH_OP_SUB: return a - b;
    case NH_OP_MUL: return a * b;
    case NH_OP_DIV: return a / b;
    case NH_OP_NEG: return -a;
    case NH_OP_INV: return 1 / a;
    case NH_OP_SQUARE: return a * a;
    case NH_OP_SQRT: return sqrt(a);
    case NH_OP_POW: return pow(a, b);
    default: return call_value(op - NH_OP_FUNCTION, a, b);
    }
}

/* ---- the compiler: first in virtual registers, each written once ---- */

/* What a virtual register holds: an operation, or (op == constant_word) the two halves of a double. */
typedef struct {
    uint32_t op, a, b, to; /* op: with `more` in its upper half; to: the register + 1, 0 when the slot is free */
} known_value;

enum { constant_word = UINT16_MAX, most_more = UINT16_MAX };

typedef struct {
    nh_dag *dag;
    uint32_t *value;  /* per node: virtual register + 1 */
    double *constant; /* virtual registers that are constants; parallel to kind */
    char *kind;       /* 'i' input, 'c' constant, 't' temporary */
    size_t count, kind_capacity, constant_capacity;
    nh_instruction *code;
    size_t length, capacity;
    nh_more_arguments *more;
    size_t mores, more_capacity;
    known_value *known; /* open addressing: equal operations have one register */
    size_t known_count, known_capacity;
    size_t n_fixed;
    const nh_ex *fixed;
    const double *fixed_value;
    bool has_unbound;
    nh_ex unbound;
} compiler;

static uint32_t fresh(compiler *c, char kind, double constant)
{
    nh_grow(&c->kind, &c->kind_capacity, c->count + 1, sizeof *c->kind);
    nh_grow(&c->constant, &c->constant_capacity, c->count + 1, sizeof *c->constant);
    c->kind[c->count] = kind;
    c->constant[c->count] = constant;
    return (uint32_t)c->count++;
}

static known_value *known_slot(known_value *table, size_t capacity, uint32_t op, uint32_t a, uint32_t b)
{
    uint64_t h = ((uint64_t)op << 48) ^ ((uint64_t)a << 24) ^ b ^ ((uint64_t)a >> 8);
    for (size_t i = (size_t)(h * 0x9e3779b97f4a7c15u >> 32) & (capacity - 1);; i = (i + 1) & (capacity - 1)) {
        known_value *k = &table[i];
        if (!k->to || (k->op == op && k->a == a && k->b == b)) return k;
    }
}

/* The slot of this operation; its `to` is 0 when it is new. */
static known_value *find_known(compiler *c, uint32_t op, uint32_t a, uint32_t b)
{
    if (2 * (c->known_count + 1) > c->known_capacity) {
        size_t capacity = c->known_capacity ? 2 * c->known_capacity : 64;
        known_value *table = nh_alloc_array(capacity, sizeof *table);
        for (size_t i = 0; i < c->known_capacity; i++) {
            known_value k = c->known[i];
            if (k.to) *known_slot(table, capacity, k.op, k.a, k.b) = k;
        }
        nh_free(c->known);
        c->known = table;
        c->known_capacity = capacity;
    }
    known_value *k = known_slot(c->known, c->known_capacity, op, a, b);
    if (!k->to) {
        c->known_count++;
        *k = (known_value){op, a, b, 0};
    }
    return k;
}

static uint32_t constant(compiler *c, double value)
{
    uint32_t word[2];
    memcpy(word, &value, sizeof word);
    known_value *k = find_known(c, constant_word, word[0], word[1]);
    if (!k->to) k->to = fresh(c, 'c', value) + 1;
    return k->to - 1;
}

static bool is_constant(const compiler *c, uint32_t r, double value)
{
    return c->kind[r] == 'c' && c->constant[r] == value;
}

/* The register of this operation, an existing one or a new one. */
static uint32_t operation(compiler *c, unsigned op, uint32_t more, uint32_t a, uint32_t b)
{
    known_value *k = find_known(c, op | more << 16, a, b);
    if (k->to) return k->to - 1;
    nh_grow(&c->code, &c->capacity, c->length + 1, sizeof *c->code);
    uint32_t to = fresh(c, 't', 0);
    k->to = to + 1;
    c->code[c->length++] = (nh_instruction){(uint16_t)op, (uint16_t)more, to, a, b};
    return to;
}

static bool all_constant(const compiler *c, size_t n, const uint32_t *r)
{
    for (size_t i = 0; i < n; i++)
        if (c->kind[r[i]] != 'c') return false;
    return true;
}

/* The third and the fourth argument: index of the entry + 1; 0: there are too many. */
static uint32_t more_of(compiler *c, uint32_t third, uint32_t fourth)
{
    for (size_t i = 0; i < c->mores; i++)
        if (c->more[i].c == third && c->more[i].d == fourth) return (uint32_t)i + 1;
    if (c->mores == most_more) return 0;
    nh_grow(&c->more, &c->more_capacity, c->mores + 1, sizeof *c->more);
    c->more[c->mores++] = (nh_more_arguments){third, fourth};
    return (uint32_t)c->mores;
}

static uint32_t emit_named(compiler *c, nh_function f, const uint32_t *r)
{
    size_t n = nh_function_arity(f);
    uint32_t more = n > 2 ? more_of(c, r[2], r[n - 1]) : 0;
    if (n > 2 && !more) return constant(c, NAN);
    if (!all_constant(c, n, r)) return operation(c, NH_OP_FUNCTION + f, more, r[0], r[n > 1]);
    double value[NH_MOST_ARGUMENTS];
    for (size_t i = 0; i < n; i++) value[i] = c->constant[r[i]];
    if (f == NH_TABLE) return operation(c, NH_OP_FUNCTION + f, more, r[0], r[1]);
    return constant(c, nh_named_value(f, value));
}

static uint32_t emit(compiler *c, unsigned op, uint32_t a, uint32_t b)
{
    if (c->kind[a] == 'c' && c->kind[b] == 'c') return constant(c, op_value(op, c->constant[a], c->constant[b]));
    if (op == NH_OP_MUL && is_constant(c, a, 1)) return b;
    if ((op == NH_OP_MUL || op == NH_OP_DIV) && is_constant(c, b, 1)) return a;
    if (op == NH_OP_MUL && is_constant(c, a, -1)) return emit(c, NH_OP_NEG, b, b);
    if (op == NH_OP_ADD && is_constant(c, a, 0)) return b;
    return operation(c, op, 0, a, b);
}

static uint32_t integer_power(compiler *c, uint32_t a, int64_t n)
{
    if (n == 1) return a;
    if (n % 2) return emit(c, NH_OP_MUL, integer_power(c, a, n - 1), a);
    uint32_t half = integer_power(c, a, n / 2);
    return emit(c, NH_OP_SQUARE, half, half);
}

/* b^x with x made positive; the caller divides when it was negative. */
static uint32_t positive_power(compiler *c, uint32_t b, nh_num x, uint32_t exponent)
{
    if (x.q == 1 && x.p <= 64) return integer_power(c, b, x.p);
    if (x.q == 2 && x.p <= 63) {
        uint32_t root = emit(c, NH_OP_SQRT, b, b);
        return x.p == 1 ? root : emit(c, NH_OP_MUL, root, integer_power(c, b, x.p / 2));
    }
    return emit(c, NH_OP_POW, b, exponent);
}

/* The i-th factor, with the absolute value of its exponent; `below`: it is in the denominator. */
static uint32_t compile_factor(compiler *c, nh_ex e, size_t i, bool *below)
{
    uint32_t b = c->value[nh_child(c->dag, e, i)] - 1;
    nh_ex x = nh_exponent_of(c->dag, e, i);
    *below = false;
    if (nh_kind_of(c->dag, x) != NH_NUMBER) return emit(c, NH_OP_POW, b, c->value[x] - 1);
    nh_num n = nh_number_of(c->dag, x);
    *below = nh_num_value(n) < 0;
    if (*below) n = nh_num_mul(n, nh_num_int(-1));
    return positive_power(c, b, n, constant(c, nh_num_value(n)));
}

/* Constant factors first: they fold into one. */
static uint32_t compile_product(compiler *c, nh_ex e)
{
    uint32_t top = constant(c, nh_num_value(nh_constant_of(c->dag, e))), bottom = 0;
    bool divided = false, below;
    for (size_t i = 0; i < nh_arity(c->dag, e); i++) {
        uint32_t f = compile_factor(c, e, i, &below);
        if (c->kind[f] == 'c') top = emit(c, below ? NH_OP_DIV : NH_OP_MUL, top, f);
    }
    for (size_t i = 0; i < nh_arity(c->dag, e); i++) {
        uint32_t f = compile_factor(c, e, i, &below);
        if (c->kind[f] == 'c') continue;
        if (!below) top = emit(c, NH_OP_MUL, top, f);
        else bottom = divided ? emit(c, NH_OP_MUL, bottom, f) : f;
        divided |= below;
    }
    if (!divided) return top;
    return is_constant(c, top, 1) ? emit(c, NH_OP_INV, bottom, bottom) : emit(c, NH_OP_DIV, top, bottom);
}

/* Constant terms first: they fold into one. */
static uint32_t compile_sum(compiler *c, nh_ex e)
{
    const nh_dag *dag = c->dag;
    size_t n = nh_arity(dag, e);
    double fixed = nh_num_value(nh_constant_of(dag, e));
    for (size_t i = 0; i < n; i++) {
        uint32_t term = c->value[nh_child(dag, e, i)] - 1;
        if (c->kind[term] == 'c') fixed += nh_num_value(nh_coefficient_of(dag, e, i)) * c->constant[term];
    }
    uint32_t total = constant(c, fixed);
    for (size_t i = 0; i < n; i++) {
        uint32_t term = c->value[nh_child(dag, e, i)] - 1;
        if (c->kind[term] == 'c') continue;
        double k = nh_num_value(nh_coefficient_of(dag, e, i));
        bool minus = k < 0 && !is_constant(c, total, 0);
        term = emit(c, NH_OP_MUL, constant(c, minus ? -k : k), term);
        total = emit(c, minus ? NH_OP_SUB : NH_OP_ADD, total, term);
    }
    return total;
}

static uint32_t compile_symbol(compiler *c, nh_ex e)
{
    for (size_t i = 0; i < c->n_fixed; i++)
        if (c->fixed[i] == e) return constant(c, c->fixed_value[i]);
    if (!c->has_unbound) c->unbound = e;
    c->has_unbound = true;
    return constant(c, NAN);
}

static uint32_t compile_node(compiler *c, nh_ex e)
{
    switch (nh_kind_of(c->dag, e)) {
    case NH_NUMBER: return constant(c, nh_num_value(nh_number_of(c->dag, e)));
    case NH_SYMBOL: return compile_symbol(c, e);
    case NH_SUM: return compile_sum(c, e);
    case NH_PRODUCT: return compile_product(c, e);
    default: break;
    }
    nh_function f = nh_function_of(c->dag, e);
    if (f == NH_PI) return constant(c, 3.14159265358979323846);
    uint32_t argument[NH_MOST_ARGUMENTS], a = c->value[nh_child(c->dag, e, 0)] - 1;
    for (size_t i = 0; i < nh_arity(c->dag, e); i++) argument[i] = c->value[nh_child(c->dag, e, i)] - 1;
    if (nh_is_named_function(f)) return emit_named(c, f, argument);
    uint32_t b = f == NH_ATAN2 ? c->value[nh_child(c->dag, e, 1)] - 1 : a;
    return emit(c, NH_OP_FUNCTION + f, a, b);
}

/* Nodes needed by the outputs, children first. */
static void compile_nodes(compiler *c, size_t n_out, const nh_ex *out)
{
    const nh_dag *dag = c->dag;
    nh_ex top = 0;
    for (size_t i = 0; i < n_out; i++) top = out[i] > top ? out[i] : top;
    char *needed = nh_alloc((size_t)top + 1);
    for (size_t i = 0; i < n_out; i++) needed[out[i]] = 1;
    for (nh_ex e = top + 1; e-- > 0;) {
        if (!needed[e] || c->value[e]) continue; /* an input may be an expression: its operands are not needed */
        nh_kind kind = nh_kind_of(dag, e);
        for (size_t i = 0; i < nh_arity(dag, e); i++) {
            needed[nh_child(dag, e, i)] = 1;
            if (kind == NH_PRODUCT && nh_kind_of(dag, nh_exponent_of(dag, e, i)) != NH_NUMBER)
                needed[nh_exponent_of(dag, e, i)] = 1;
        }
    }
    for (nh_ex e = 0; e <= top; e++)
        if (needed[e] && !c->value[e]) c->value[e] = compile_node(c, e) + 1;
    nh_free(needed);
}

/* ---- registers: a linear scan over last uses ---- */

/* The registers that an instruction reads, each once. */
static size_t operands(const compiler *c, const nh_instruction *x, uint32_t *out)
{
    uint32_t all[NH_MOST_ARGUMENTS] = {x->a, x->b, x->a, x->a};
    if (x->more) all[2] = c->more[x->more - 1].c, all[3] = c->more[x->more - 1].d;
    size_t n = 0;
    for (size_t i = 0; i < NH_MOST_ARGUMENTS; i++) {
        bool seen = false;
        for (size_t j = 0; j < n; j++) seen |= out[j] == all[i];
        if (!seen) out[n++] = all[i];
    }
    return n;
}

static void assign(compiler *c, nh_tape *tape, const uint32_t *out)
{
    uint32_t *place = nh_alloc_array(c->count + 1, sizeof *place), operand[NH_MOST_ARGUMENTS];
    size_t *last = nh_alloc_array(c->count + 1, sizeof *last);
    char *used = nh_alloc(c->count + 1);
    for (size_t i = 0; i < c->length; i++) {
        size_t n = operands(c, &c->code[i], operand);
        for (size_t k = 0; k < n; k++) {
            last[operand[k]] = i;
            used[operand[k]] = 1;
        }
    }
    for (size_t i = 0; i < tape->outputs; i++) {
        last[out[i]] = SIZE_MAX;
        used[out[i]] = 1;
    }
    tape->constant = nh_alloc_array(c->count + 1, sizeof *tape->constant);
    for (uint32_t v = 0; v < c->count; v++) {
        if (v < tape->inputs) place[v] = v;
        else if (c->kind[v] == 'c' && used[v]) {
            tape->constant[tape->constants] = c->constant[v];
            place[v] = (uint32_t)(tape->inputs + tape->constants++);
        }
    }
    uint32_t next = (uint32_t)(tape->inputs + tape->constants), *stack = nh_alloc_array(c->length + 1, sizeof *stack);
    size_t depth = 0;
    for (size_t i = 0; i < c->length; i++) {
        nh_instruction x = c->code[i], y = {x.op, x.more, 0, place[x.a], place[x.b]};
        /* before the operands are freed: the kernels need separate input and output rows */
        y.to = place[x.to] = depth ? stack[--depth] : next++;
        size_t n = operands(c, &x, operand);
        for (size_t k = 0; k < n; k++)
            if (c->kind[operand[k]] == 't' && last[operand[k]] == i) stack[depth++] = place[operand[k]];
        tape->code[i] = y;
    }
    for (size_t i = 0; i < c->mores; i++) tape->more[i] = (nh_more_arguments){place[c->more[i].c], place[c->more[i].d]};
    for (size_t i = 0; i < tape->outputs; i++) tape->output[i] = place[out[i]];
    tape->registers = next;
    nh_free(stack);
    nh_free(used);
    nh_free(last);
    nh_free(place);
}

nh_tape *nh_tape_create(nh_dag *dag, size_t n_in, const nh_ex *in, size_t n_out, const nh_ex *out, size_t n_fixed,
                        const nh_ex *fixed, const double *value)
{
    compiler c = {.dag = dag, .n_fixed = n_fixed, .fixed = fixed, .fixed_value = value};
    c.value = nh_alloc_array(nh_dag_size(dag), sizeof *c.value);
    for (size_t i = 0; i < n_in; i++) c.value[in[i]] = fresh(&c, 'i', 0) + 1;
    compile_nodes(&c, n_out, out);
    uint32_t *virtual_out = nh_alloc_array(n_out + 1, sizeof *virtual_out);
    for (size_t i = 0; i < n_out; i++) virtual_out[i] = c.value[out[i]] - 1;
    nh_tape *tape = nh_alloc(sizeof *tape);
    *tape = (nh_tape){
        .inputs = n_in, .outputs = n_out, .length = c.length, .unbound = c.unbound, .has_unbound = c.has_unbound};
    tape->code = nh_alloc_array(c.length + 1, sizeof *tape->code);
    tape->output = nh_alloc_array(n_out + 1, sizeof *tape->output);
    tape->more = nh_alloc_array(c.mores + 1, sizeof *tape->more);
    tape->table = nh_declared_tables(dag);
    assign(&c, tape, virtual_out);
    tape->effort = call + each_value * (double)(n_in + n_out);
    for (size_t i = 0; i < tape->length; i++) tape->effort += nh_op_effort(tape->code[i].op);
    nh_free(virtual_out);
    nh_free(c.value);
    nh_free(c.kind);
    nh_free(c.constant);
    nh_free(c.code);
    nh_free(c.more);
    nh_free(c.known);
    return tape;
}

/* Every instruction jumps to the next one by itself (GCC's labels as values): the processor then predicts each jump by
 * its address, which makes long tapes about twice and short ones up to four times as fast as one switch in a loop
 * (docs/performance.md). */
void nh_tape_eval(const nh_tape *tape, nh_tape_work *work, const double *in, double *out)
{
    static void *const plain[] = {[NH_OP_ADD] = &&add,       [NH_OP_SUB] = &&sub,    [NH_OP_MUL] = &&mul,
                                  [NH_OP_DIV] = &&div,       [NH_OP_NEG] = &&other,  [NH_OP_INV] = &&other,
                                  [NH_OP_SQUARE] = &&square, [NH_OP_SQRT] = &&other, [NH_OP_POW] = &&other};
    nh_effort_add(tape->effort);
    if (work->code) {
        work->code(in, out);
        return;
    }
    if (work->left && --work->left == 0) nh_tape_look(tape, work);
    double *r = work->scalar;
    const nh_instruction *x = tape->code, *end = x + tape->length;
    if (tape->inputs) memcpy(r, in, tape->inputs * sizeof *r);
#define DISPATCH()                                                                                                     \
    do {                                                                                                               \
        if (x == end) goto done;                                                                                       \
        goto *(x->op < NH_OP_FUNCTION ? plain[x->op] : &&other);                                                       \
    } while (0)
    DISPATCH();
add:
    r[x->to] = r[x->a] + r[x->b], x++;
    DISPATCH();
sub:
    r[x->to] = r[x->a] - r[x->b], x++;
    DISPATCH();
mul:
    r[x->to] = r[x->a] * r[x->b], x++;
    DISPATCH();
div:
    r[x->to] = r[x->a] / r[x->b], x++;
    DISPATCH();
square:
    r[x->to] = r[x->a] * r[x->a], x++;
    DISPATCH();
other:
    r[x->to] = nh_op_is_named(x->op) ? named_value(tape, x, r) : op_value(x->op, r[x->a], r[x->b]);
    x++;
    DISPATCH();
#undef DISPATCH
done:
    for (size_t i = 0; i < tape->outputs; i++) out[i] = r[tape->output[i]];
}
