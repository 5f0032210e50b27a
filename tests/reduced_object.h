/* reduced_object: a system with the printed stage of its reduction, and what follows from its Lagrangian and its constraints by values alone: metric,
 * forms, connections and curvatures by differences, structure constants from differences of the printed fields. */
#ifndef NH_TESTS_REDUCED_OBJECT_H
#define NH_TESTS_REDUCED_OBJECT_H

#include "reduced_sheet.h"

#include <math.h>

#include "base/linalg.h"

enum { most = 10 };

typedef struct {
    reduced_sheet s;
    size_t m, f;               /* coordinates, constraints */
    size_t first;              /* of a second stage: the Chaplygin stage below it; else SIZE_MAX */
    size_t n, d;               /* of the stage: shape, group */
    size_t x[most], y[most];   /* coordinates of the system: shape, and those that the slice fixes */
    const char *shape[most];   /* the names of x in the stage: q_s where the group moves q */
    double q[most];            /* a place of the slice */
    double c[most * most * most]; /* [e_a, e_b] = -c_ab^k e_k as fields */
    const char *name;
} object;

static inline size_t coordinate(const object *o, const char *name)
{
    for (size_t i = 0; i < o->m; i++)
        if (!strcmp(o->s.system->coordinate[i].name, name)) return i;
    for (size_t i = 0; i < o->m; i++) {
        size_t length = strlen(o->s.system->coordinate[i].name);
        if (!strncmp(o->s.system->coordinate[i].name, name, length) && !strcmp(name + length, "_s")) return i;
    }
    cr_assert_fail("%s: there is no %s", o->name, name);
    return 0;
}

static const char *name_of(const object *o, size_t i) { return o->shape[i]; }

static inline double evaluated(object *o, nh_ex e, const double *q, const double *v)
{
    const nh_ex *parameter;
    const double *numbers;
    double out;
    for (size_t i = 0; i < o->m; i++) o->s.value[2 * i] = q[i], o->s.value[2 * i + 1] = v ? v[i] : 0;
    nh_system_bindings(o->s.system, &parameter, &numbers);
    nh_tape *tape = nh_tape_create(o->s.system->dag, o->s.symbols, o->s.symbol, 1, &e, o->s.system->parameters, parameter, numbers);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, o->s.value, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

static inline void set_place(object *o)
{
    for (size_t i = 0; i < o->m; i++) o->s.value[2 * i] = o->q[i], o->s.value[2 * i + 1] = 0;
}

static inline double potential(object *o, const double *q) { return -evaluated(o, o->s.system->lagrangian, q, NULL); }

/* K_ij = L(e_i + e_j) - L(e_i) - L(e_j) + L(0). */
static inline void metric(object *o, const double *q, double *K)
{
    size_t m = o->m;
    nh_ex L = o->s.system->lagrangian;
    double v[most] = {0}, one[most], zero = evaluated(o, L, q, v);
    for (size_t i = 0; i < m; i++) {
        v[i] = 1;
        one[i] = evaluated(o, L, q, v) - zero;
        v[i] = 0;
    }
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j <= i; j++) {
            v[i] += 1, v[j] += 1;
            K[i + j * m] = K[j + i * m] = evaluated(o, L, q, v) - zero - one[i] - one[j];
            v[i] = v[j] = 0;
        }
}

/* f x m, column by column. */
static inline void forms(object *o, const double *q, double *omega)
{
    double v[most] = {0};
    for (size_t a = 0; a < o->f; a++) {
        const nh_constraint *c = &o->s.system->constraint[a];
        for (size_t i = 0; i < o->m; i++) {
            v[i] = 1;
            omega[a + i * o->f] = evaluated(o, c->lhs, q, v) - evaluated(o, c->rhs, q, v);
            v[i] = 0;
        }
    }
}

/* Components of the fields of stage `of` along all coordinates: m x d. */
static inline size_t fields(object *o, size_t of, const double *q, double *E)
{
    const cJSON *field, *component, *stage = cJSON_GetArrayItem(oracle_get(o->s.root, "stages"), (int)of);
    size_t d = 0;
    for (size_t i = 0; i < o->m; i++) o->s.value[2 * i] = q[i];
    cJSON_ArrayForEach(field, oracle_get(stage, "generators")) {
        for (size_t i = 0; i < o->m; i++) E[i + d * o->m] = 0;
        cJSON_ArrayForEach(component, field) E[coordinate(o, component->string) + d * o->m] = value_of(&o->s, component->valuestring);
        d++;
    }
    return d;
}

/* x (columns of b) with a x = b, where a has more rows than columns: a^T a x = a^T b. */
static inline void least(size_t rows, size_t n, const double *a, size_t count, const double *b, double *x)
{
    double N[most * most] = {0}, rcond;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            for (size_t r = 0; r < rows; r++) N[i + j * n] += a[r + i * rows] * a[r + j * rows];
    for (size_t c = 0; c < count; c++)
        for (size_t i = 0; i < n; i++) {
            x[i + c * n] = 0;
            for (size_t r = 0; r < rows; r++) x[i + c * n] += a[r + i * rows] * b[r + c * rows];
        }
    cr_assert(nh_solve(n, N, count, x, &rcond));
}

static const double step = 1e-5;

/* c_ab^k = -([e_a, e_b] in the fields): the fields differentiated along each other. */
static inline void constants(object *o, size_t of, size_t d, const double *q)
{
    size_t m = o->m;
    double E[most * most], side[2][most * most], at[most], bracket[most] = {0}, k[most];
    fields(o, of, q, E);
    for (size_t a = 0; a < d; a++)
        for (size_t b = 0; b < d; b++) {
            memset(bracket, 0, sizeof bracket);
            for (int turn = 0; turn < 2; turn++) { /* (e_a d) e_b - (e_b d) e_a */
                const double *along = E + (turn ? b : a) * m;
                for (int w = 0; w < 2; w++) {
                    for (size_t i = 0; i < m; i++) at[i] = q[i] + (w ? step : -step) * along[i];
                    fields(o, of, at, side[w]);
                }
                for (size_t i = 0; i < m; i++) bracket[i] += (turn ? -1 : 1) * (side[1][i + (turn ? a : b) * m] - side[0][i + (turn ? a : b) * m]) / (2 * step);
            }
            least(m, d, E, 1, bracket, k);
            for (size_t j = 0; j < d; j++) o->c[(a * d + b) * d + j] = fabs(k[j]) > 1e-7 ? -k[j] : 0;
        }
    set_place(o);
}

/* ---- the metric that a stage starts from, in the coordinates of its shape and its slice ---- */

/* The first stage's shape coordinates; its own: all. */
static inline size_t around(const object *o, size_t *of)
{
    if (o->first == SIZE_MAX) {
        for (size_t i = 0; i < o->m; i++) of[i] = i;
        return o->m;
    }
    const cJSON *name, *stage = cJSON_GetArrayItem(oracle_get(o->s.root, "stages"), (int)o->first);
    size_t n = 0;
    cJSON_ArrayForEach(name, oracle_get(stage, "shape")) of[n++] = coordinate(o, name->valuestring);
    return n;
}

/* A = om_e^-1 om_x (d x n) of a Chaplygin stage at q, and the frame (d_i, e_a): m x m. */
static inline void connection(object *o, size_t of, size_t n, const size_t *x, const double *q, double *A, double *frame)
{
    size_t m = o->m, f = o->f;
    double omega[most * most], E[most * most], a[most * most] = {0}, rcond;
    forms(o, q, omega);
    cr_assert_eq(fields(o, of, q, E), f);
    memset(frame, 0, m * m * sizeof *frame);
    for (size_t i = 0; i < n; i++) frame[x[i] + i * m] = 1;
    memcpy(frame + n * m, E, f * m * sizeof *frame);
    for (size_t r = 0; r < f; r++)
        for (size_t c = 0; c < f; c++)
            for (size_t i = 0; i < m; i++) a[r + c * f] += omega[r + i * f] * E[i + c * m];
    for (size_t r = 0; r < f; r++)
        for (size_t i = 0; i < n; i++) A[r + i * f] = omega[r + x[i] * f];
    cr_assert(nh_solve(f, a, n, A, &rcond));
}

/* The lifts (m x n), Khat (n x n) and J_a (d x n). */
static inline void lifted(object *o, size_t of, size_t n, const size_t *x, const double *q, double *lift, double *Khat, double *J)
{
    size_t m = o->m, f = o->f;
    double A[most * most], frame[most * most], K[most * most];
    connection(o, of, n, x, q, A, frame);
    metric(o, q, K);
    for (size_t i = 0; i < n; i++)
        for (size_t r = 0; r < m; r++) {
            lift[r + i * m] = frame[r + i * m];
            for (size_t a = 0; a < f; a++) lift[r + i * m] -= A[a + i * f] * frame[r + (n + a) * m];
        }
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++) {
            Khat[i + j * n] = 0;
            for (size_t r = 0; r < m; r++)
                for (size_t s = 0; s < m; s++) Khat[i + j * n] += lift[r + i * m] * K[r + s * m] * lift[s + j * m];
        }
        for (size_t a = 0; a < f; a++) {
            J[a + j * f] = 0;
            for (size_t r = 0; r < m; r++)
                for (size_t s = 0; s < m; s++) J[a + j * f] += frame[r + (n + a) * m] * K[r + s * m] * lift[s + j * m];
        }
    }
}

/* ---- comparisons ---- */

static inline void same(const object *o, const char *label, double got, double want, double tolerance)
{
    cr_expect_float_eq(got, want, tolerance * (1 + fabs(want)), "%s: %s is %.12g, but %.12g was expected", o->name, label, got, want);
}

static inline double line_value(const object *o, const char *section, const char *of, const char *format, ...)
{
    char label[200];
    va_list list;
    va_start(list, format);
    vsnprintf(label, sizeof label, format, list);
    va_end(list);
    return shown_value(&o->s, section, label, of);
}

/* B^a_ij from a connection of d x n at q and at q +- step along each shape coordinate. */
static inline void curvature(object *o, size_t n, size_t d, const size_t *x, void (*at)(object *, const double *, double *), double *B)
{
    double A[most * most], side[2][most * most], *dA = nh_alloc_array(n * n * d + 1, sizeof *dA), q[most];
    at(o, o->q, A);
    for (size_t l = 0; l < n; l++) {
        for (int w = 0; w < 2; w++) {
            memcpy(q, o->q, sizeof q);
            q[x[l]] += w ? step : -step;
            at(o, q, side[w]);
        }
        for (size_t i = 0; i < n * d; i++) dA[l * n * d + i] = (side[1][i] - side[0][i]) / (2 * step);
    }
    for (size_t a = 0; a < d; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++) {
                double e = dA[i * n * d + a + j * d] - dA[j * n * d + a + i * d];
                for (size_t b = 0; b < d; b++)
                    for (size_t k = 0; k < d; k++) e -= o->c[(b * d + k) * d + a] * A[b + i * d] * A[k + j * d];
                B[(a * n + i) * n + j] = e;
            }
    nh_free(dA);
    set_place(o);
}

/* label = 1/2 p M p with letters for the two p: the printed coefficients are those of the symmetric M. */
static inline void quadratic(const object *o, const char *label, double sign, size_t n, const double *M, const char *square, const char *product, bool numbered)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) {
            char of[100];
            if (numbered) snprintf(of, sizeof of, i == j ? square : product, i + 1, j + 1);
            else snprintf(of, sizeof of, i == j ? square : product, name_of(o, i), name_of(o, j));
            same(o, label, line_value(o, "hamiltonian", of, "%s", label), sign * (i == j ? M[i + i * n] / 2 : M[i + j * n]), 1e-8);
        }
}

static inline void inverse(size_t n, const double *M, double *out)
{
    double a[most * most], rcond;
    memcpy(a, M, n * n * sizeof *a);
    for (size_t i = 0; i < n * n; i++) out[i] = i % (n + 1) == 0;
    if (n) cr_assert(nh_solve(n, a, n, out, &rcond));
}

#endif
