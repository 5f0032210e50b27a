/* bench_export: nanoseconds per evaluation of exported C against the program's own tapes.
 *
 * usage: bench_export [SYSTEM]...        prints the table of docs/export.md */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "commands/export.h"
#include "document/export.h"
#include "geometry/bordered.h"
#include "scratch.h"

typedef int on_state(double t, const double *state, const void *parameters, double *rate);
typedef int on_velocities(double t, const double *q, const double *v, const void *parameters, double *acceleration,
                          double *multiplier, double *reaction);
typedef int without_multipliers(double t, const double *q, const double *v, const void *parameters,
                                double *acceleration);

/* What is measured: one evaluation. */
typedef struct {
    const nh_model *o;
    nh_tape *tape;
    nh_tape_work *work;
    nh_bordered *bordered;
    on_state *rates;
    void *accelerations;
    const void *parameters;
    double *z, *v, *out;
} bench;

static void by_tape(bench *b) { nh_tape_eval(b->tape, b->work, b->z, b->out); }
static void by_bordered(bench *b) { nh_bordered_accelerations(b->bordered, b->z[0], b->z + 1, b->v, b->out); }
static void by_rates(bench *b) { b->rates(b->z[0], b->z + 1, b->parameters, b->out); }

static void by_accelerations(bench *b)
{
    size_t m = b->o->m;
    if (b->o->k) {
        on_velocities *f;
        memcpy(&f, &b->accelerations, sizeof f);
        f(b->z[0], b->z + 1, b->v, b->parameters, b->out, b->out + m, b->out + 2 * m);
    } else {
        without_multipliers *f;
        memcpy(&f, &b->accelerations, sizeof f);
        f(b->z[0], b->z + 1, b->v, b->parameters, b->out);
    }
}

/* The least of several measurements, in nanoseconds. */
static double time_of(void (*once)(bench *), bench *b)
{
    static const double long_enough = 0.02;
    double best = INFINITY;
    size_t count = 1;
    for (int trial = 0; trial < 7;) {
        double begin = nh_clock();
        for (size_t i = 0; i < count; i++) {
            b->z[1] += 1e-9;
            once(b);
        }
        double taken = nh_clock() - begin;
        if (taken < long_enough) {
            count *= 2;
            continue;
        }
        best = fmin(best, taken / (double)count);
        trial++;
    }
    return best * 1e9;
}

/* The exported C as a library of this process. */
static void *compile(const nh_export *x, const char *name)
{
    char folder[SCRATCH], path[SCRATCH + 50], command[2 * SCRATCH + 200];
    nh_text text;
    scratch_name(folder);
    if (!mkdtemp(folder)) return NULL;
    nh_text_init(&text);
    nh_export_text(x, NH_EXPORT_C, name, NULL, &text);
    snprintf(path, sizeof path, "%s/code.c", folder);
    FILE *file = fopen(path, "w");
    bool good = file && (fputs(nh_text_string(&text), file) >= 0) & (fclose(file) == 0);
    nh_text_clear(&text);
    snprintf(command, sizeof command, "${CC:-cc} -std=c99 -O2 -shared -fPIC %s -o %s/code.so -lm", path, folder);
    if (!good || system(command)) return NULL;
    snprintf(path, sizeof path, "%s/code.so", folder);
    void *library = dlopen(path, RTLD_NOW);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command) ? NULL : library;
}

static void *symbol(void *library, const char *name, const char *suffix)
{
    char word[200];
    snprintf(word, sizeof word, "%s_%s", name, suffix);
    return dlsym(library, word);
}

static void measure(const char *name)
{
    char path[SCRATCH];
    nh_error error = {0};
    snprintf(path, sizeof path, "systems/%s.yaml", name);
    nh_request q = {.line = "bench", .system_path = path, .of = "equations, submanifold"};
    nh_options_default(&q.options);
    nh_export *x = nh_export_create(&q, &error);
    void *library = x ? compile(x, name) : NULL;
    if (!library || x->model->chart->implicit) {
        printf("| %s | %s |\n", name, x ? "no library" : error.what);
        return;
    }
    const nh_model *o = x->model;
    size_t m = o->m, n = o->n, width = o->width;
    nh_ex *e = nh_alloc_array(m + n, sizeof *e);
    memcpy(e, o->rho, m * sizeof *e);
    memcpy(e + m, o->a, n * sizeof *e);
    bench b = {.o = o, .tape = nh_model_tape(o, m + n, e), .bordered = nh_bordered_create(o)};
    b.work = nh_tape_work_create(b.tape);
    void *rates = symbol(library, name, "rates");
    memcpy(&b.rates, &rates, sizeof rates);
    b.accelerations = symbol(library, name, "accelerations");
    b.parameters = symbol(library, name, "default");
    b.z = nh_alloc_array(width + 4 * m + n + o->k + 1, sizeof *b.z);
    b.v = b.z + width;
    b.out = b.v + m;
    memcpy(b.z, o->chart->probe, width * sizeof *b.z);
    by_tape(&b);
    memcpy(b.v, b.out, m * sizeof *b.v);
    double tape = time_of(by_tape, &b), rate = time_of(by_rates, &b), bordered = time_of(by_bordered, &b),
           full = time_of(by_accelerations, &b), machine = nh_tape_compile(b.tape, b.work) ? time_of(by_tape, &b) : NAN;
    printf("| %s | %zu | %.0f | %.0f | %.0f | %.0f | %.0f |\n", name, m + n, tape, machine, rate, bordered, full);
    nh_tape_work_free(b.work);
    nh_tape_free(b.tape);
    nh_bordered_free(b.bordered);
    nh_free(b.z);
    nh_free(e);
    dlclose(library);
    nh_export_free(x);
}

int main(int argc, char **argv)
{
    static const char *const usual[] = {"sleigh",     "kepler",     "rolling_disk", "chaplygin_ball",
                                        "snakeboard", "rattleback", "crane",        "car_trailers_3"};
    puts(
        "| system | state | tape | tape as machine code | `rates` in C | own multiplier form | `accelerations` in C |");
    puts("|---|---|---|---|---|---|---|");
    for (int i = 1; i < argc; i++) measure(argv[i]);
    for (size_t i = 0; argc < 2 && i < sizeof usual / sizeof *usual; i++) measure(usual[i]);
    return 0;
}
