/* Tapes against plain recursion, and batches against single points. */
#include <criterion/criterion.h>
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "evaluate/tape.h"
#include "evaluate/tape_complex.h"
#include "random_expression.h"

/* Units in the last place between a and b; equal infinities and two nans are 0 apart. */
static double ulps(double a, double b)
{
    if (a == b || (isnan(a) && isnan(b))) return 0;
    if (!isfinite(a) || !isfinite(b)) return INFINITY;
    return fabs(a - b) / fmax(fabs(nextafter(a, INFINITY) - a), DBL_MIN);
}

static nh_tape *tape_of(nh_dag *d, const char *names, size_t n_out, const char *const *text)
{
    nh_ex in[8], out[16];
    size_t n_in = strlen(names);
    for (size_t i = 0; i < n_in; i++) in[i] = nh_symbol(d, (char[]){names[i], 0});
    for (size_t i = 0; i < n_out; i++) out[i] = parsed(d, text[i]);
    nh_ex a = nh_symbol(d, "a"), k = nh_symbol(d, "k");
    return nh_tape_create(d, n_in, in, n_out, out, 2, (nh_ex[]){a, k}, (double[]){0.7385, 1.2071});
}

/* ---- single points ---- */

Test(tape, one_point_equals_plain_recursion)
{
    size_t compared = 0;
    for (uint64_t seed = 1; seed <= 5000; seed++) {
        source s = source_create(seed);
        nh_ex out[3];
        for (int i = 0; i < 3; i++) out[i] = random_expression(&s, 1 + (int)(seed % 6));
        nh_tape *tape = nh_tape_create(s.dag, SYMBOLS, s.symbol, 3, out, 0, NULL, NULL);
        nh_tape_work *work = nh_tape_work_create(tape);
        for (int k = 0; k < 3; k++) {
            double at[SYMBOLS], value[3];
            for (int i = 0; i < SYMBOLS; i++) at[i] = random_real(&s, k ? 0.2 : -2, 2);
            nh_tape_eval(tape, work, at, value);
            for (int i = 0; i < 3; i++) {
                double size = 0, naive = naive_value(s.dag, out[i], s.symbol, at, &size);
                if (!isfinite(naive) || !isfinite(value[i]) || size > 1e5) continue;
                cr_assert_float_eq(value[i], naive, 1e-9 * (1 + size), "seed %d", (int)seed);
                compared++;
            }
        }
        nh_tape_work_free(work);
        nh_tape_free(tape);
        nh_dag_free(s.dag);
    }
    cr_expect_gt(compared, 20000);
}

/* At a complex point the real part is that of the real tape, and a step along the imaginary axis gives the exact derivative. */
Test(tape, a_complex_step_equals_the_exact_derivative)
{
    size_t compared = 0;
    for (uint64_t seed = 1; seed <= 4000; seed++) {
        source s = source_create(seed);
        nh_ex e[2];
        e[0] = random_expression(&s, 1 + (int)(seed % 6));
        size_t k = seed % SYMBOLS;
        e[1] = nh_diff(s.dag, e[0], s.symbol[k]);
        nh_tape *tape = nh_tape_create(s.dag, SYMBOLS, s.symbol, 2, e, 0, NULL, NULL);
        nh_tape_work *work = nh_tape_work_create(tape);
        double complex *complex_work = nh_tape_complex_create(tape), in[SYMBOLS], out[2];
        for (int p = 0; p < 3; p++) {
            double at[SYMBOLS], value[2], size = 0;
            for (int i = 0; i < SYMBOLS; i++) in[i] = at[i] = random_real(&s, p ? 0.2 : -2, 2);
            nh_tape_eval(tape, work, at, value);
            naive_value(s.dag, e[1], s.symbol, at, &size);
            in[k] = CMPLX(at[k], 1e-100);
            nh_tape_eval_complex(tape, complex_work, in, out);
            if (!isfinite(value[0])) cr_assert(!isfinite(creal(out[0])), "seed %d: %g, %g", (int)seed, value[0], creal(out[0]));
            if (!isfinite(value[0]) || !isfinite(value[1]) || !(size < 1e5)) continue;
            cr_assert_float_eq(creal(out[0]), value[0], 1e-9 * (1 + fabs(value[0]) + size), "seed %d: %g, %g", (int)seed, creal(out[0]), value[0]);
            cr_assert_float_eq(cimag(out[0]) / 1e-100, value[1], 1e-9 * (1 + size), "seed %d: %g, %g", (int)seed, cimag(out[0]) / 1e-100, value[1]);
            compared++;
        }
        nh_free(complex_work);
        nh_tape_work_free(work);
        nh_tape_free(tape);
        nh_dag_free(s.dag);
    }
    cr_expect_gt(compared, 5000);
}

/* Undefined values come out as such: log(-1), 1/0, sign of what is not a number. */
Test(tape, undefined_values)
{
    nh_dag *d = nh_dag_create();
    const char *const text[] = {"log(x)", "1/y", "sqrt(x)", "sign(log(x))", "x^(1/3)", "1/y^2", "sign(y)", "log(y)", "-1/y^2", "exp(-1/y^2)"};
    enum { n = sizeof text / sizeof *text };
    nh_tape *tape = tape_of(d, "xy", n, text);
    nh_tape_work *work = nh_tape_work_create(tape);
    double out[n];
    nh_tape_eval(tape, work, (double[]){-1.5, 0}, out);
    for (int i = 0; i < 5; i++)
        if (i != 1) cr_expect(isnan(out[i]), "%s", text[i]);
    cr_expect(out[1] == INFINITY && out[5] == INFINITY && out[6] == 0 && out[7] == -INFINITY && out[8] == -INFINITY && out[9] == 0);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

/* ---- batches ---- */

typedef struct {
    double data[8][NH_BATCH];
    const double *in[8];
    double *out[8];
} rows;

static void rows_init(rows *r)
{
    for (int i = 0; i < 8; i++) r->in[i] = r->out[i] = r->data[i];
}

/* Every operator and function, over a wide range and the special points. */
Test(tape, batches_agree_with_single_points)
{
    static const char *const text[] = {
        "x + y", "x - y", "x*y", "x/y", "-x", "1/x", "x^2", "x^3", "x^-4", "x^7", "sqrt(x)", "x^(3/2)", "x^(-1/2)", "x^y", "2^x",
        "x^(1/3)", "sin(x)", "cos(x)", "tan(x)", "asin(x)", "acos(x)", "atan(x)", "sinh(x)", "cosh(x)", "tanh(x)", "asinh(x)",
        "acosh(x)", "atanh(x)", "exp(x)", "log(x)", "abs(x)", "sign(x)", "atan2(x, y)", "2*x - 3", "x^(y + 1/2)", "x^100", "x^(-13/2)"};
    static const double special[] = {0, 1, -1, INFINITY, -INFINITY, NAN, DBL_MIN, -DBL_MAX, 0.5, 2, 710, -746, 1e-320, 1e22};
    enum { specials = sizeof special / sizeof *special };
    nh_dag *d = nh_dag_create();
    source s = source_create(7);
    rows in, out;
    rows_init(&in);
    rows_init(&out);
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        nh_tape *tape = tape_of(d, "xy", 1, &text[k]);
        nh_tape_work *work = nh_tape_work_create(tape);
        for (int round = 0; round < 40; round++) {
            double reach = round % 4 == 0 ? 1 : round % 4 == 1 ? 5 : 300;
            for (int p = 0; p < NH_BATCH; p++)
                for (int i = 0; i < 2; i++) {
                    in.data[i][p] = round % 4 < 3 ? random_real(&s, -reach, reach) : exp(random_real(&s, -reach, reach));
                    if (round == 0) in.data[i][p] = special[i ? p / specials % specials : p % specials];
                }
            nh_tape_eval_batch(tape, work, NH_BATCH, in.in, out.out);
            for (int p = 0; p < NH_BATCH; p++) {
                double one;
                nh_tape_eval(tape, work, (double[]){in.data[0][p], in.data[1][p]}, &one);
                cr_assert_leq(ulps(one, out.data[0][p]), 8, "%s at x = %g, y = %g: %.17g and %.17g", text[k], in.data[0][p],
                              in.data[1][p], one, out.data[0][p]);
            }
        }
        nh_tape_work_free(work);
        nh_tape_free(tape);
    }
    nh_dag_free(s.dag);
    nh_dag_free(d);
}

/* The same numbers whatever the length of the batch, and not one point beyond it. */
Test(tape, short_batches)
{
    static const size_t counts[] = {1, 3, 7, 8, 9, 100, 255, 256, 0};
    static const char *const text[] = {"sin(x)*y - x^3", "x", "2.385", "sqrt(y)/x"};
    nh_dag *d = nh_dag_create();
    nh_tape *tape = tape_of(d, "xy", 4, text);
    nh_tape_work *work = nh_tape_work_create(tape);
    rows in, all, some;
    rows_init(&in);
    rows_init(&all);
    for (int p = 0; p < NH_BATCH; p++) {
        in.data[0][p] = 1 + sin(p);
        in.data[1][p] = 1.5 + cos(2.385 * p);
    }
    nh_tape_eval_batch(tape, work, NH_BATCH, in.in, all.out);
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        rows_init(&some);
        for (int i = 0; i < 4; i++)
            for (int p = 0; p < NH_BATCH; p++) some.data[i][p] = -77;
        nh_tape_eval_batch(tape, work, counts[k], in.in, some.out);
        for (int i = 0; i < 4; i++)
            for (size_t p = 0; p < NH_BATCH; p++)
                cr_assert_eq(some.data[i][p], p < counts[k] ? all.data[i][p] : -77, "%zu points, output %d, point %zu", counts[k], i, p);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

Test(tape, random_expressions_in_batches)
{
    for (uint64_t seed = 1; seed <= 1000; seed++) {
        source s = source_create(seed);
        nh_ex e[2] = {random_expression(&s, 5), random_expression(&s, 3)};
        nh_tape *tape = nh_tape_create(s.dag, SYMBOLS, s.symbol, 2, e, 0, NULL, NULL);
        nh_tape_work *work = nh_tape_work_create(tape);
        rows in, out;
        rows_init(&in);
        rows_init(&out);
        for (int p = 0; p < 100; p++)
            for (int i = 0; i < SYMBOLS; i++) in.data[i][p] = random_real(&s, 0.2, 1.7);
        nh_tape_eval_batch(tape, work, 100, in.in, out.out);
        for (int p = 0; p < 100; p++) {
            double at[SYMBOLS], value[2], size = 1;
            for (int i = 0; i < SYMBOLS; i++) at[i] = in.data[i][p];
            nh_tape_eval(tape, work, at, value);
            for (int i = 0; i < 2; i++) {
                naive_value(s.dag, e[i], s.symbol, at, &size);
                if (!isfinite(value[i]) || size > 1e5) continue;
                cr_assert_float_eq(out.data[i][p], value[i], 1e-9 * size, "seed %d", (int)seed);
            }
        }
        nh_tape_work_free(work);
        nh_tape_free(tape);
        nh_dag_free(s.dag);
    }
}

/* ---- what is and what is not in a tape ---- */

static size_t length_of(const char *names, size_t n, const char *const *text)
{
    nh_dag *d = nh_dag_create();
    parsed(d, "exp(x*y)^7 + tan(y)*log(x)"); /* of no use to any output */
    nh_tape *tape = tape_of(d, names, n, text);
    size_t length = nh_tape_length(tape);
    nh_tape_free(tape);
    nh_dag_free(d);
    return length;
}

Test(tape, length)
{
    static const struct {
        size_t length, n;
        const char *text[3];
    } expected[] = {
        {0, 0, {NULL}}, {0, 1, {"x"}}, {0, 1, {"2.385"}}, {0, 1, {"sin(a)*exp(k)^2 - a/k + log(2)"}}, {1, 1, {"x + y"}}, {1, 1, {"x - y"}},
        {1, 1, {"x*y"}}, {1, 1, {"x/y"}}, {1, 1, {"1/x"}}, {1, 1, {"-x"}}, {1, 1, {"x^2"}}, {2, 1, {"x^4"}}, {2, 1, {"x^3"}}, {1, 1, {"sqrt(x)"}},
        {2, 1, {"-x*y/(a*k^2)*a*k^3"}},         /* one constant factor */
        {1, 1, {"x + a + k^2 + 3"}},            /* one constant term */
        {2, 1, {"sin(a*k)*x + cos(a)"}},
        {2, 3, {"sin(x)", "sin(x)", "sin(x)^2"}}, /* each once */
        {2, 2, {"x^2", "x^3"}},                 /* x^3 = x^2 x */
        {3, 2, {"x*y + 1", "x*y - 2"}},
        {1, 2, {"x", "x^(1/3)"}},
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        size_t length = length_of("xy", expected[i].n, expected[i].text);
        cr_expect_eq(length, expected[i].length, "%s: %zu", expected[i].n ? expected[i].text[0] : "nothing", length);
    }
}

Test(tape, outputs_may_be_inputs_constants_and_each_other)
{
    nh_dag *d = nh_dag_create();
    const char *const text[] = {"x", "a*k", "sin(x) + y", "sin(x) + y", "y", "0", "sin(x)"};
    nh_tape *tape = tape_of(d, "xy", 7, text);
    nh_tape_work *work = nh_tape_work_create(tape);
    double v[7];
    nh_tape_eval(tape, work, (double[]){0.3, -0.4}, v);
    cr_expect(v[0] == 0.3 && v[1] == 0.7385 * 1.2071 && v[2] == sin(0.3) - 0.4 && v[3] == v[2] && v[4] == -0.4 && v[5] == 0 && v[6] == sin(0.3));
    cr_expect(nh_tape_outputs(tape) == 7);
    double in_place[7] = {0.3, -0.4};
    nh_tape_eval(tape, work, in_place, in_place);
    cr_expect_eq(memcmp(in_place, v, sizeof v), 0);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    tape = tape_of(d, "", 2, (const char *const[]){"a", "3"});
    work = nh_tape_work_create(tape);
    rows out;
    rows_init(&out);
    nh_tape_eval(tape, work, NULL, v);
    nh_tape_eval_batch(tape, work, 3, NULL, out.out);
    cr_expect(v[0] == 0.7385 && v[1] == 3 && out.data[0][2] == 0.7385 && out.data[1][0] == 3);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    tape = tape_of(d, "x", 0, NULL);
    work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, (double[]){1}, NULL);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

Test(tape, unbound_symbols_are_named)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), q = nh_symbol(d, "q"), symbol;
    nh_tape *tape = tape_of(d, "x", 2, (const char *const[]){"x*q + 1", "x + 1"});
    nh_tape_work *work = nh_tape_work_create(tape);
    double out[2];
    cr_expect(nh_tape_unbound(tape, &symbol));
    cr_expect_eq(symbol, q);
    nh_tape_eval(tape, work, (double[]){2}, out);
    cr_expect(isnan(out[0]) && out[1] == 3);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    tape = tape_of(d, "x", 1, (const char *const[]){"x + a"});
    cr_expect_not(nh_tape_unbound(tape, &symbol), "q is not used");
    nh_tape_free(tape);
    nh_ex inner = parsed(d, "sin(q)"), outer = parsed(d, "x + sin(q)^2"); /* an expression as an input hides its symbols */
    tape = nh_tape_create(d, 2, (nh_ex[]){x, inner}, 1, &outer, 0, NULL, NULL);
    cr_expect_not(nh_tape_unbound(tape, &symbol));
    work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, (double[]){2, 3}, out);
    cr_expect_eq(out[0], 11);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

/* ---- threads ---- */

typedef struct {
    const nh_tape *tape;
    double scale, sum;
} thread_job;

static void *run_thread(void *argument)
{
    thread_job *j = argument;
    nh_tape_work *work = nh_tape_work_create(j->tape);
    rows in, out;
    rows_init(&in);
    rows_init(&out);
    for (int k = 0; k < 200; k++) {
        double one;
        for (int p = 0; p < NH_BATCH; p++) {
            in.data[0][p] = j->scale * sin(k + p);
            in.data[1][p] = cos(k * p);
        }
        nh_tape_eval_batch(j->tape, work, NH_BATCH, in.in, out.out);
        nh_tape_eval(j->tape, work, (double[]){j->scale * k, 0.5}, &one);
        j->sum += out.data[0][k] + one;
    }
    nh_tape_work_free(work);
    return NULL;
}

Test(tape, threads_share_a_tape)
{
    nh_dag *d = nh_dag_create();
    nh_tape *tape = tape_of(d, "xy", 1, (const char *const[]){"sin(x)*exp(y) + x*y^3/(1 + x^2)"});
    thread_job alone[4], together[4];
    pthread_t id[4];
    for (int i = 0; i < 4; i++) alone[i] = together[i] = (thread_job){tape, 1 + 0.385 * i, 0};
    for (int i = 0; i < 4; i++) run_thread(&alone[i]);
    for (int i = 0; i < 4; i++) pthread_create(&id[i], NULL, run_thread, &together[i]);
    for (int i = 0; i < 4; i++) pthread_join(id[i], NULL);
    for (int i = 0; i < 4; i++) cr_expect_eq(alone[i].sum, together[i].sum);
    nh_tape_free(tape);
    nh_dag_free(d);
}

/* Two work memories of one tape, used in turn, do not see each other. */
Test(tape, interleaved_work)
{
    nh_dag *d = nh_dag_create();
    nh_tape *tape = tape_of(d, "xy", 1, (const char *const[]){"x*y + sin(x*y)"});
    nh_tape_work *a = nh_tape_work_create(tape), *b = nh_tape_work_create(tape);
    double u[2], v[2];
    for (int i = 0; i < 2; i++) {
        nh_tape_eval(tape, a, (double[]){2, 3}, &u[i]);
        nh_tape_eval(tape, b, (double[]){5, 7}, &v[i]);
    }
    cr_expect(u[0] == u[1] && v[0] == v[1] && u[0] != v[0]);
    nh_tape_work_free(a);
    nh_tape_work_free(b);
    nh_tape_free(tape);
    nh_dag_free(d);
}
