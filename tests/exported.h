/* exported: values of exported functions by tapes and LAPACK, for the tests of what other languages compute. */
#ifndef NH_TESTS_EXPORTED_H
#define NH_TESTS_EXPORTED_H

#include "mechanics.h"

#include "base/linalg.h"
#include "commands/export.h"
#include "graph/node.h"

enum { EXPORTED_MOST = 400, EXPORTED_ENTRIES = 1600 }; /* symbols known to a function; entries of an array */

static const double exported_time = 0.23, exported_input = 0.37;

/* One call: arguments, and what the results are. */
typedef struct {
    double *argument[NH_EXPORT_MOST_ARRAYS], *result[NH_EXPORT_MOST_ARRAYS];
    bool good;
    double time;
} exported_call;

static inline nh_export *exported_make(const char *path, const char *of, const char *input)
{
    nh_error error = {0};
    nh_request q = {.line = "test", .system_path = path, .of = of, .input = input};
    nh_options_default(&q.options);
    q.options.work = 30;
    q.options.count_work = 1e5;
    nh_export *x = nh_export_create(&q, &error);
    must(x != NULL, &error, path);
    return x;
}

/* Any number of (0.2, 0.9), always the same for a name. */
static inline double exported_any(const char *name, size_t shift)
{
    uint64_t h = 1469598103934665603u + 977 * shift;
    for (; *name; name++) h = (h ^ (unsigned char)*name) * 1099511628211u;
    return 0.2 + 0.7 * (double)((h >> 20) % 100000) / 100000;
}

/* A probe of the model's chart gives its coordinates and velocities, what else there is has any value. */
static inline double exported_value(const nh_export *x, const char *name, size_t probe)
{
    const nh_model *o = x->model;
    if (!o || o->chart->probes == 0) return exported_any(name, probe);
    const nh_chart *c = o->chart;
    const double *z = c->probe + probe % c->probes * c->width;
    size_t length = strlen(name);
    for (size_t i = 1; i < c->width; i++)
        if (!strcmp(nh_name_of(o->dag, c->symbol[i]), name)) return z[i];
    for (size_t s = 0; s < o->m; s++) {
        const char *own = o->system->coordinate[s].name;
        if (strlen(own) + 1 != length || name[length - 1] != '\'' || strncmp(own, name, length - 1)) continue;
        nh_tape *tape = nh_model_tape(o, 1, &o->rho[s]);
        nh_tape_work *work = nh_tape_work_create(tape);
        double v;
        nh_tape_eval(tape, work, z, &v);
        nh_tape_work_free(work);
        nh_tape_free(tape);
        return v;
    }
    return exported_any(name, probe);
}

/* ---- values ---- */

typedef struct {
    const nh_export_function *f;
    nh_ex symbol[EXPORTED_MOST];
    double value[EXPORTED_MOST];
    size_t count;
} exported_scope;

static inline void exported_know(exported_scope *s, nh_ex symbol, double value)
{
    cr_assert_lt(s->count, EXPORTED_MOST);
    s->symbol[s->count] = symbol;
    s->value[s->count++] = value;
}

static inline void exported_values(const exported_scope *s, size_t n, const nh_ex *e, double *out)
{
    nh_tape *tape = nh_tape_create(s->f->dag, s->count, s->symbol, n, e, 0, NULL, NULL);
    nh_ex unbound;
    cr_assert_not(nh_tape_unbound(tape, &unbound), "%s: %s is not known", s->f->name, nh_name_of(s->f->dag, unbound));
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, s->value, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

/* matrix^-1 right at what is known. */
static inline bool exported_step(const exported_scope *s, const nh_export_solve *q, double *x)
{
    double *A = nh_alloc_array(q->n * q->n + 1, sizeof *A), *column = nh_alloc_array(q->n * q->n + 1, sizeof *column);
    exported_values(s, q->n * q->n, q->matrix, A);
    exported_values(s, q->n, q->right, x);
    for (size_t i = 0; i < q->n * q->n; i++) column[i / q->n + i % q->n * q->n] = A[i];
    bool good = nh_all_finite(q->n * q->n, A) && nh_all_finite(q->n, x) && nh_solve(q->n, column, 1, x, NULL);
    nh_free(A);
    nh_free(column);
    return good;
}

static inline bool exported_newton(exported_scope *s, const nh_export_solve *q, const double *guess)
{
    double *x = nh_alloc_array(q->n + 1, sizeof *x), size = 1;
    size_t first = s->count;
    for (size_t i = 0; i < q->n; i++) exported_know(s, q->unknown[i], guess[i]);
    bool good = true;
    for (int step = 0; step < 40 && good && size > 1e-15; step++) {
        good = exported_step(s, q, x);
        size = 0;
        for (size_t i = 0; i < q->n && good; i++) {
            s->value[first + i] -= x[i];
            size = fmax(size, fabs(x[i]) / (1 + fabs(s->value[first + i])));
        }
    }
    nh_free(x);
    return good && size < 1e-13;
}

/* Results from arguments; the parameters have the values of the file. */
static inline bool exported_run(const nh_export *x, const nh_export_function *f, exported_call *c)
{
    exported_scope s = {.f = f};
    exported_know(&s, f->system->t, c->time);
    for (size_t i = 0; i < f->system->parameters; i++)
        exported_know(&s, f->system->parameter[i].symbol, x->input[i] ? exported_input : f->system->parameter[i].value);
    for (size_t a = 0; a < f->arguments; a++)
        for (size_t i = 0; i < f->argument[a].rows; i++) exported_know(&s, f->argument[a].e[i], c->argument[a][i]);
    bool good = true;
    for (size_t i = 0; i < f->solves && good; i++) {
        const nh_export_solve *q = &f->solve[i];
        double *value = nh_alloc_array(q->n + 1, sizeof *value);
        good = q->newton ? exported_newton(&s, q, c->argument[q->guess]) : exported_step(&s, q, value);
        for (size_t k = 0; k < q->n && good && !q->newton; k++) exported_know(&s, q->unknown[k], value[k]);
        nh_free(value);
    }
    for (size_t r = 0; r < f->results && good; r++)
        exported_values(&s, f->result[r].rows * f->result[r].columns, f->result[r].e, c->result[r]);
    return c->good = good;
}

static inline exported_call exported_call_make(const nh_export *x, const nh_export_function *f, size_t probe)
{
    exported_call c = {.time = exported_time};
    for (size_t a = 0; a < f->arguments; a++) {
        const nh_export_array *array = &f->argument[a];
        bool momenta = !strcmp(array->name, "momentum") || !strcmp(array->name, "group");
        c.argument[a] = nh_alloc_array(array->rows + 1, sizeof(double));
        for (size_t i = 0; i < array->rows; i++) {
            const char *name = nh_name_of(f->dag, array->e[i]);
            c.argument[a][i] = momenta ? exported_any(name, probe) : exported_value(x, name, probe);
        }
        for (size_t k = 0; k < f->solves; k++) /* not far from the solution */
            for (size_t i = 0; i < array->rows && f->solve[k].newton && f->solve[k].guess == a; i++)
                c.argument[a][i] = 0.01 + exported_value(x, nh_name_of(f->dag, f->solve[k].unknown[i]), probe);
    }
    for (size_t r = 0; r < f->results; r++)
        c.result[r] = nh_alloc_array(f->result[r].rows * f->result[r].columns + 1, sizeof(double));
    return c;
}

static inline void exported_call_clear(exported_call *c)
{
    for (size_t a = 0; a < NH_EXPORT_MOST_ARRAYS; a++) {
        nh_free(c->argument[a]);
        nh_free(c->result[a]);
    }
}

static inline const nh_export_function *exported_function(const nh_export *x, const char *name)
{
    for (size_t i = 0; i < x->functions; i++)
        if (!strcmp(x->function[i].name, name)) return &x->function[i];
    return NULL;
}

#endif
