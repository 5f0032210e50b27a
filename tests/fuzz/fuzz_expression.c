/* fuzz_expression: any bytes as an expression: parsed, printed, read again, differentiated, simplified, evaluated.
 *
 * The text of what was read must mean the same when it is read again. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "exact/ball.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/parse.h"
#include "graph/print.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "graph/node.h"

enum { longest = 2000, largest = 20000 };

static bool any_name(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    (void)fault;
    *out = nh_symbol(context, name);
    return true;
}

static void check(bool fine)
{
    if (!fine) abort();
}

/* What is not a number or was cut off cannot come back, nor can a number of more digits than are written. */
static bool printable(const char *text)
{
    return !strstr(text, "...") && !strstr(text, "nan") && !strstr(text, "inf");
}

static void round_trip(nh_dag *dag, nh_ex e)
{
    char *text = nh_print_string(dag, e);
    nh_parse_fault fault = {0};
    nh_ex back;
    if (printable(text) && nh_is_short(dag, e)) {
        check(nh_parse(dag, text, any_name, dag, &back, &fault));
        check(back == e || !nh_is_short(dag, back) || nh_normal_is_zero(dag, nh_sub(dag, back, e), 500) != NH_NONZERO);
    }
    nh_free(text);
}

static void use(nh_dag *dag, nh_ex e)
{
    nh_ex x = nh_symbol(dag, "x");
    if (nh_node_count(dag, e) > 500) return;
    nh_ex slope = nh_diff(dag, e, x), simple = nh_simplify(dag, e), out[3] = {e, slope, simple};
    double in = 0.7236, value[3], low, high;
    nh_tape *tape = nh_tape_create(dag, 1, &x, 3, out, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, &in, value);
    nh_ball *ball = nh_ball_create(dag, 128);
    nh_ball_set_double(ball, x, in);
    for (size_t i = 0; i < 3; i++)
        if (nh_ball_value(ball, out[i], &low, &high)) check(!isnan(low) && high >= 0);
    nh_ball_free(ball);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > longest) return 0;
    char *text = malloc(size + 1);
    memcpy(text, data, size);
    text[size] = 0;
    nh_dag *dag = nh_dag_create();
    nh_parse_fault fault = {0};
    nh_ex e, lhs, rhs;
    if (nh_parse(dag, text, any_name, dag, &e, &fault)) {
        round_trip(dag, e);
        use(dag, e);
    } else {
        check(fault.offset <= size && fault.what[0] && memchr(fault.what, 0, sizeof fault.what));
    }
    nh_parse_equation(dag, text, any_name, dag, &lhs, &rhs, &fault);
    nh_dag_free(dag);
    free(text);
    return 0;
}
