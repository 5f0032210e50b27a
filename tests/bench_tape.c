/* Tapes against C written by hand, on the two forms of the Chaplygin sleigh: time per point of the right-hand side. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/clock.h"
#include "graph/dag.h"
#include "graph/parse.h"
#include "evaluate/tape.h"

enum { inputs = 5, outputs = 5, points = NH_BATCH, repetitions = 31, evaluations = 51200 };

static const double A = 0.7385, K = 1.2071;

/* omega, v, phi, x, y */
static void quasi_by_hand(const double *in, double *out)
{
    double omega = in[0], v = in[1], phi = in[2];
    out[0] = -omega * v / (A * K * K);
    out[1] = A * omega * omega;
    out[2] = omega;
    out[3] = v * cos(phi);
    out[4] = v * sin(phi);
}

/* phi', x', phi, x, y */
static void chart_by_hand(const double *in, double *out)
{
    double rate = in[0], speed = in[1], phi = in[2], c = cos(phi), t = tan(phi);
    out[0] = -rate * speed / (A * K * K * c);
    out[1] = A * rate * rate * c - rate * speed * t;
    out[2] = rate;
    out[3] = speed;
    out[4] = speed * t;
}

typedef struct {
    const char *name;
    const char *symbol[inputs], *output[outputs];
    void (*by_hand)(const double *in, double *out);
} form;

static const form FORMS[] = {
    {"sleigh, quasi-velocities", {"omega", "v", "phi", "x", "y"},
     {"-omega*v/(a*k^2)", "a*omega^2", "omega", "v*cos(phi)", "v*sin(phi)"}, quasi_by_hand},
    {"sleigh, chart", {"phi'", "x'", "phi", "x", "y"},
     {"-phi'*x'/(a*k^2*cos(phi))", "a*phi'^2*cos(phi) - phi'*x'*tan(phi)", "phi'", "x'", "x'*tan(phi)"}, chart_by_hand},
};

static bool any_name(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    (void)fault;
    *out = nh_symbol(context, name);
    return true;
}

static nh_tape *compile(nh_dag *d, const form *f)
{
    nh_ex in[inputs], out[outputs], fixed[2] = {nh_symbol(d, "a"), nh_symbol(d, "k")};
    nh_parse_fault fault;
    for (int i = 0; i < inputs; i++) in[i] = nh_symbol(d, f->symbol[i]);
    for (int i = 0; i < outputs; i++)
        if (!nh_parse(d, f->output[i], any_name, d, &out[i], &fault)) exit(1);
    return nh_tape_create(d, inputs, in, outputs, out, 2, fixed, (double[]){A, K});
}

typedef struct {
    const form *f;
    const nh_tape *tape;
    nh_tape_work *work;
    double (*state)[inputs], (*rate)[outputs]; /* point by point */
    const double **in;
    double **out; /* row by row */
    size_t count;
} job;

static void run_by_hand(const job *j)
{
    for (size_t p = 0; p < j->count; p++) j->f->by_hand(j->state[p], j->rate[p]);
}

static void run_scalar(const job *j)
{
    for (size_t p = 0; p < j->count; p++) nh_tape_eval(j->tape, j->work, j->state[p], j->rate[p]);
}

static void run_batch(const job *j) { nh_tape_eval_batch(j->tape, j->work, j->count, j->in, j->out); }

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum { BY_HAND, SCALAR, BATCH, MACHINE, WAYS };

/* Nanoseconds per point: best and median.  The ways take turns, so that a change of the processor's clock meets them all. */
static void measure(const job *j, const job *compiled, double *best, double *median)
{
    static void (*const run[WAYS])(const job *) = {run_by_hand, run_scalar, run_batch, run_scalar};
    double time[WAYS][repetitions];
    size_t rounds = evaluations / j->count;
    for (int i = 0; i < repetitions; i++)
        for (int w = 0; w < WAYS; w++) {
            double start = nh_clock();
            for (size_t k = 0; k < rounds; k++) run[w](w == MACHINE ? compiled : j);
            time[w][i] = 1e9 * (nh_clock() - start) / (double)(rounds * j->count);
        }
    for (int w = 0; w < WAYS; w++) {
        qsort(time[w], repetitions, sizeof *time[w], ascending);
        best[w] = time[w][0];
        median[w] = time[w][repetitions / 2];
    }
}

static void report(const form *f, size_t count)
{
    static double state[points][inputs], rate[points][outputs], row_in[inputs][points], row_out[outputs][points];
    const double *in[inputs];
    double *out[outputs], best[WAYS], median[WAYS];
    nh_dag *d = nh_dag_create();
    nh_tape *tape = compile(d, f);
    job j = {f, tape, nh_tape_work_create(tape), state, rate, in, out, count};
    for (int i = 0; i < inputs; i++) {
        in[i] = row_in[i];
        out[i] = row_out[i];
        for (int p = 0; p < points; p++) row_in[i][p] = state[p][i] = sin(1 + 2.385 * p + 0.7 * i);
    }
    job compiled = j;
    compiled.work = nh_tape_work_create(tape);
    if (!nh_tape_compile(tape, compiled.work)) fprintf(stderr, "%s\n", nh_tape_words(compiled.work));
    measure(&j, &compiled, best, median);
    printf("| %s | %zu | %zu | %.2f (%.2f) | %.2f (%.2f) | %.2f (%.2f) | %.2f (%.2f) | %.2f | %.2f |\n", f->name, nh_tape_length(tape), count,
           best[BY_HAND], median[BY_HAND], best[SCALAR], median[SCALAR], best[MACHINE], median[MACHINE], best[BATCH], median[BATCH],
           median[MACHINE] / median[BY_HAND], median[BATCH] / median[BY_HAND]);
    nh_tape_work_free(compiled.work);
    nh_tape_work_free(j.work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

int main(void)
{
    static const size_t counts[] = {1, 8, 32, 128, NH_BATCH};
    printf("Nanoseconds per point, best (median) of %d repetitions.\n\n", repetitions);
    printf("| right-hand side | instructions | points | C by hand | tape, one point | compiled, one point | tape, batch | compiled / hand | batch / hand |\n");
    printf("|---|---|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof FORMS / sizeof *FORMS; i++)
        for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) report(&FORMS[i], counts[k]);
    return 0;
}
