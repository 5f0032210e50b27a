/* machine: machine code gives the same bits as the interpreter; where nothing can be compiled, the interpreter goes on. */
#include <sys/stat.h>
#include <unistd.h>

#include "evaluate/machine.h"
#include "graph/dag.h"
#include "mechanics.h"
#include "motion/trajectory.h"
#include "random_expression.h"

enum { N_OUT = 40, POINTS = 200 };

/* Equal bits; all nans are one. */
static bool same(double a, double b) { return (a != a && b != b) || memcmp(&a, &b, sizeof a) == 0; }

/* Many random expressions in one tape, so that the compiler runs few times. */
Test(machine, the_same_bits)
{
    size_t finite = 0;
    for (uint64_t seed = 1; seed <= 6; seed++) {
        source s = source_create(seed);
        s.inexact = seed % 2;
        nh_ex out[N_OUT];
        for (int i = 0; i < N_OUT; i++) out[i] = random_expression(&s, 1 + i % 6);
        nh_tape *tape = nh_tape_create(s.dag, SYMBOLS, s.symbol, N_OUT, out, 0, NULL, NULL);
        nh_tape_work *plain = nh_tape_work_create(tape), *compiled = nh_tape_work_create(tape);
        cr_assert(nh_tape_compile(tape, compiled), "%s", nh_tape_words(compiled));
        for (int k = 0; k < POINTS; k++) {
            double at[SYMBOLS], a[N_OUT], b[N_OUT], size = k % 3 == 0 ? 1e-3 : k % 3 == 1 ? 3 : 1e3;
            for (int i = 0; i < SYMBOLS; i++) at[i] = random_real(&s, -size, size);
            nh_tape_eval(tape, plain, at, a);
            nh_tape_eval(tape, compiled, at, b);
            for (int i = 0; i < N_OUT; i++) {
                cr_assert(same(a[i], b[i]), "seed %d, output %d: %a %a", (int)seed, i, a[i], b[i]);
                finite += isfinite(a[i]) != 0;
            }
        }
        nh_tape_work_free(plain);
        nh_tape_work_free(compiled);
        nh_tape_free(tape);
        nh_dag_free(s.dag);
    }
    cr_expect_gt(finite, 20000);
}

static nh_tape *tape_of(nh_dag *d, size_t n, const char *const *text)
{
    nh_ex in[2] = {nh_symbol(d, "x"), nh_symbol(d, "y")}, out[64];
    for (size_t i = 0; i < n; i++) out[i] = parsed(d, text[i]);
    return nh_tape_create(d, 2, in, n, out, 0, NULL, NULL);
}

/* Every operation, where it is defined and where it is not; sin and cos of one argument, which the compiler computes together. */
static const char *const EVERY[] = {"sin(x)", "cos(x)", "tan(x)", "asin(x)", "acos(x)", "atan(x)", "sinh(x)", "cosh(x)", "tanh(x)", "asinh(x)", "acosh(x)", "atanh(x)", "exp(x)",
                                    "log(x)", "abs(x)", "sign(x)", "atan2(x, y)", "x^y", "sqrt(x)", "x^(1/3)", "x^(3/2)", "1/x", "-x", "x - y", "x/y", "x^2", "x^7", "x", "pi", "3*x*y + 0.1"};
enum { N_EVERY = sizeof EVERY / sizeof *EVERY };

Test(machine, every_operation)
{
    static const double at[] = {0, -0.0, 1, -1, 0.5, -0.7, 1e-300, 1e300, 3.14159265358979, 1e5, 1e22, INFINITY, -INFINITY, NAN};
    enum { n = sizeof at / sizeof *at };
    nh_dag *d = nh_dag_create();
    nh_tape *tape = tape_of(d, N_EVERY, EVERY);
    nh_tape_work *plain = nh_tape_work_create(tape), *compiled = nh_tape_work_create(tape);
    cr_assert(nh_tape_compile(tape, compiled), "%s", nh_tape_words(compiled));
    for (int i = 0; i < n * n; i++) {
        double in[2] = {at[i / n], at[i % n]}, a[N_EVERY], b[N_EVERY];
        nh_tape_eval(tape, plain, in, a);
        nh_tape_eval(tape, compiled, in, b);
        for (int k = 0; k < N_EVERY; k++) cr_expect(same(a[k], b[k]), "%s at (%g, %g): %a %a", EVERY[k], in[0], in[1], a[k], b[k]);
    }
    nh_tape_work_free(plain);
    nh_tape_work_free(compiled);
    nh_tape_free(tape);
    nh_dag_free(d);
}

/* sin and cos at a million places: sincos, which the compiler may call, must not differ. */
Test(machine, sine_and_cosine_together)
{
    static const char *const both[] = {"sin(x)", "cos(x)", "sin(y)*cos(y)"};
    nh_dag *d = nh_dag_create();
    nh_tape *tape = tape_of(d, 3, both);
    nh_tape_work *plain = nh_tape_work_create(tape), *compiled = nh_tape_work_create(tape);
    source s = source_create(5);
    cr_assert(nh_tape_compile(tape, compiled), "%s", nh_tape_words(compiled));
    for (int i = 0; i < 500000; i++) {
        double size = i % 4 == 0 ? 0.2 : i % 4 == 1 ? 4 : i % 4 == 2 ? 1e4 : 1e9, in[2] = {random_real(&s, -size, size), random_real(&s, -size, size)}, a[3], b[3];
        nh_tape_eval(tape, plain, in, a);
        nh_tape_eval(tape, compiled, in, b);
        cr_assert(same(a[0], b[0]) && same(a[1], b[1]) && same(a[2], b[2]), "%a %a", in[0], in[1]);
    }
    nh_tape_work_free(plain);
    nh_tape_work_free(compiled);
    nh_tape_free(tape);
    nh_dag_free(d);
    nh_dag_free(s.dag);
}

/* Input and output may be the same memory. */
Test(machine, in_place)
{
    static const char *const swapped[] = {"y", "x"};
    nh_dag *d = nh_dag_create();
    nh_tape *tape = tape_of(d, 2, swapped);
    nh_tape_work *work = nh_tape_work_create(tape);
    double z[2] = {1, 2};
    nh_tape_eval(tape, work, z, z);
    cr_expect(z[0] == 2 && z[1] == 1);
    cr_assert(nh_tape_compile(tape, work), "%s", nh_tape_words(work));
    nh_tape_eval(tape, work, z, z);
    cr_expect(z[0] == 1 && z[1] == 2);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

/* ---- compilers that are not there or do not work ---- */

static void expect_interpreter(const char *why)
{
    nh_dag *d = nh_dag_create();
    nh_tape *tape = tape_of(d, N_EVERY, EVERY);
    nh_tape_work *work = nh_tape_work_create(tape);
    double in[2] = {0.3, 0.4}, out[N_EVERY];
    cr_expect(!nh_tape_compile(tape, work));
    cr_expect(nh_tape_words(work) && strstr(nh_tape_words(work), why), "%s", nh_tape_words(work));
    nh_tape_eval(tape, work, in, out);
    cr_expect(out[0] == sin(0.3));
    nh_tape_jit(work, 1e-9);
    for (int i = 0; i < 5000; i++) nh_tape_eval(tape, work, in, out);
    cr_expect(out[0] == sin(0.3));
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

Test(machine, no_compiler)
{
    setenv("NHSYM_CC", "no-such-compiler", 1);
    expect_interpreter("no-such-compiler: No such file");
}

Test(machine, none_wanted)
{
    setenv("NHSYM_CC", "", 1);
    expect_interpreter("names no compiler");
}

Test(machine, a_compiler_that_fails)
{
    setenv("NHSYM_CC", "false", 1);
    expect_interpreter("failed with status 1");
}

Test(machine, a_compiler_that_writes_nothing)
{
    setenv("NHSYM_CC", "true", 1);
    expect_interpreter("cannot be loaded");
}

Test(machine, no_folder)
{
    setenv("TMPDIR", "/no/such/folder", 1);
    expect_interpreter("/no/such/folder");
}

/* Others could exchange what lies in a folder that they may rename. */
Test(machine, a_folder_open_to_others)
{
    char folder[] = "/tmp/nhsym-test-XXXXXX";
    cr_assert_not_null(mkdtemp(folder));
    chmod(folder, 0777);
    setenv("TMPDIR", folder, 1);
    expect_interpreter("only its owner");
    cr_expect(rmdir(folder) == 0); /* it is empty */
}

/* Nothing is left in it. */
Test(machine, the_folder_is_removed)
{
    static const char *const text[] = {"sin(x) + 0.123*y"};
    char folder[] = "/tmp/nhsym-test-XXXXXX";
    cr_assert_not_null(mkdtemp(folder));
    setenv("TMPDIR", folder, 1);
    nh_dag *d = nh_dag_create();
    nh_tape *tape = tape_of(d, 1, text);
    nh_tape_work *work = nh_tape_work_create(tape);
    cr_assert(nh_tape_compile(tape, work), "%s", nh_tape_words(work));
    cr_expect(strstr(nh_tape_words(work), "compiled by cc"), "%s", nh_tape_words(work));
    cr_expect(rmdir(folder) == 0);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

/* ---- motions ---- */

/* So that a motion finds the code of its right-hand side ready. */
static void compile_rates(const nh_model *o)
{
    nh_ex *e = nh_alloc_array(o->m + o->n, sizeof *e);
    memcpy(e, o->rho, o->m * sizeof *e);
    memcpy(e + o->m, o->a, o->n * sizeof *e);
    nh_tape *tape = nh_model_tape(o, o->m + o->n, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    cr_assert(nh_tape_compile(tape, work), "%s", nh_tape_words(work));
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(e);
}

/* The same motion, bit by bit, whether and whenever the change to machine code comes. */
Test(machine, motions_do_not_change)
{
    static const char *const paths[] = {"systems/sleigh.yaml", "systems/contact_oscillator.yaml", "systems/rolling_disk.yaml"};
    for (size_t p = 0; p < sizeof paths / sizeof *paths; p++) {
        mechanics x = mechanics_of_file(paths[p], NH_CHART_AUTO, 0, NULL);
        nh_model *o = x.model;
        double times[5] = {0, 10, 20, 30, 40}, *at = nh_alloc_array(2 * o->m, sizeof *at);
        memcpy(at, o->chart->probe + 1, o->m * sizeof *at);
        values_at(o, o->m, o->rho, o->chart->probe, at + o->m);
        nh_state initial = {.q = at, .v = at + o->m};
        nh_options options;
        nh_options_default(&options);
        nh_trajectory_request q = {.model = o, .initial = &initial, .count = 5, .times = times, .options = &options, .n = o->m, .e = o->rho, .method = nh_method_find("GSL rk8pd")};
        nh_error error = {0};
        static const double patience[] = {0, 1e-9, 1e-2};
        nh_trajectory *t[3];
        for (int i = 0; i < 3; i++) {
            options.compile = patience[i];
            if (i == 2) compile_rates(o);
            must((t[i] = nh_trajectory_create(&q, &error)) != NULL, &error, paths[p]);
            cr_expect_eq(t[i]->motion->count, t[0]->motion->count);
            cr_expect(memcmp(t[i]->value, t[0]->value, t[0]->motion->count * o->m * sizeof *t[0]->value) == 0, "%s: %s", paths[p], t[i]->machine);
        }
        cr_expect(!strcmp(t[0]->machine, "interpreted") && strcmp(t[1]->machine, "interpreted"), "%s, %s", t[0]->machine, t[1]->machine);
        cr_expect(strstr(t[2]->machine, "compiled by"), "%s", t[2]->machine);
        for (int i = 0; i < 3; i++) nh_trajectory_free(t[i]);
        nh_free(at);
        mechanics_clear(&x);
    }
}
