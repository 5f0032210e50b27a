/* Equations of chains of bodies against a recursion written by hand: time to build, size, time per evaluation of the accelerations. */
#include <stdlib.h>

#include "base/clock.h"
#include "chain.h"
#include "geometry/model.h"

enum { repetitions = 101, least_bodies = 2, most_bodies = 12 };

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef struct {
    const tree *t;
    nh_tape *tape;
    nh_tape_work *work;
    double z[2 * most_bodies + 1];
} job;

static void by_hand(job *j, double *out)
{
    double M[most_bodies * most_bodies];
    accelerations_by_hand(j->t, j->z + 1, j->z + 1 + j->t->links, M, out);
}

/* 256 points at a time; nanoseconds per point. */
static double measure_batch(job *j)
{
    static double in[2 * most_bodies + 1][NH_BATCH], out[most_bodies][NH_BATCH];
    const double *row_in[2 * most_bodies + 1];
    double *row_out[most_bodies], time[repetitions];
    for (size_t i = 0; i <= 2 * j->t->links; i++) {
        row_in[i] = in[i];
        for (size_t p = 0; p < NH_BATCH; p++) in[i][p] = j->z[i] + 1e-3 * (double)p;
    }
    for (size_t i = 0; i < j->t->links; i++) row_out[i] = out[i];
    for (int i = 0; i < repetitions; i++) {
        double start = nh_clock();
        nh_tape_eval_batch(j->tape, j->work, NH_BATCH, row_in, row_out);
        time[i] = 1e9 * (nh_clock() - start) / NH_BATCH;
    }
    qsort(time, repetitions, sizeof *time, ascending);
    return time[0];
}

static void by_tape(job *j, double *out) { nh_tape_eval(j->tape, j->work, j->z, out); }

/* Least nanoseconds per evaluation of many short runs, the state changing a little each time. */
static double measure(job *j, void (*run)(job *, double *))
{
    double time[repetitions], out[most_bodies], sum = 0;
    for (int i = 0; i < repetitions; i++) {
        int rounds = 50;
        double start = nh_clock();
        for (int k = 0; k < rounds; k++) {
            run(j, out);
            j->z[1] += 1e-9 * out[0];
            sum += out[0];
        }
        time[i] = 1e9 * (nh_clock() - start) / rounds;
    }
    if (sum == 0.123456789) puts("");
    qsort(time, repetitions, sizeof *time, ascending);
    return time[0];
}

static double worst_difference(job *j)
{
    double a[most_bodies], b[most_bodies], worst = 0, size = 0;
    by_hand(j, a);
    by_tape(j, b);
    for (size_t i = 0; i < j->t->links; i++) worst = fmax(worst, fabs(a[i] - b[i])), size = fmax(size, fabs(a[i]));
    return worst / size;
}

/* Slope of log(y) over log(n) by least squares. */
static double growth(size_t n, const double *bodies, const double *y)
{
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t i = 0; i < n; i++) {
        double a = log(bodies[i]), b = log(y[i]);
        sx += a, sy += b, sxx += a * a, sxy += a * b;
    }
    return ((double)n * sxy - sx * sy) / ((double)n * sxx - sx * sx);
}

int main(int argc, char **argv)
{
    static double bodies[most_bodies], hand[most_bodies], tape[most_bodies], machine[most_bodies], batch[most_bodies], build[most_bodies];
    size_t rows = 0, last = argc > 1 ? (size_t)atoi(argv[1]) : most_bodies;
    printf("| bodies | building, s | instructions | by hand, ns | tape, ns | tape / hand | compiling, s | compiled, ns | compiled / hand | batch, ns | batch / hand | difference |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t n = least_bodies; n <= last; n++) {
        tree t;
        nh_error error;
        nh_error_clear(&error);
        char *text = revolute_chain(&t, n, 7);
        double start = nh_clock();
        nh_system *s = nh_system_parse("chain", text, 0, NULL, &error);
        nh_model *o = s ? nh_model_create(s, nh_chart_create(s, NH_CHART_AUTO, 1, &error), &error) : NULL;
        if (!o) {
            fprintf(stderr, "%s\n", error.what);
            return 1;
        }
        build[rows] = nh_clock() - start;
        job j = {.t = &t, .tape = nh_model_tape(o, n, o->a)};
        j.work = nh_tape_work_create(j.tape);
        for (size_t i = 0; i < 2 * n; i++) j.z[1 + i] = sin(1 + 2.3 * (double)i);
        double difference = worst_difference(&j);
        bodies[rows] = (double)n;
        hand[rows] = measure(&j, by_hand);
        tape[rows] = measure(&j, by_tape);
        batch[rows] = measure_batch(&j);
        start = nh_clock();
        bool compiled = nh_tape_compile(j.tape, j.work);
        double compiling = nh_clock() - start;
        machine[rows] = compiled ? measure(&j, by_tape) : NAN;
        printf("| %zu | %.3f | %zu | %.0f | %.0f | %.2f | %.2f | %.0f | %.2f | %.0f | %.2f | %.0e |\n", n, build[rows], nh_tape_length(j.tape), hand[rows], tape[rows],
               tape[rows] / hand[rows], compiling, machine[rows], machine[rows] / hand[rows], batch[rows], batch[rows] / hand[rows], difference);
        fflush(stdout);
        rows++;
        nh_tape_work_free(j.work);
        nh_tape_free(j.tape);
        nh_model_free(o);
        nh_system_free(s);
        free(text);
    }
    printf("\nFitted growth with the number n of bodies: by hand n^%.1f, tape n^%.1f, compiled n^%.1f, batch n^%.1f, building n^%.1f.\n", growth(rows, bodies, hand), growth(rows, bodies, tape),
           growth(rows, bodies, machine), growth(rows, bodies, batch), growth(rows, bodies, build));
    return 0;
}
