#include "reduction/generator_fit.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "expr/diff.h"
#include "noether/echelon.h"
#include "reduction/subspace.h"

enum { pushes = 6 }; /* velocities per place where L itself must be invariant */

static bool plain(const nh_kinetic *k) { return k->quadratic && !k->magnetic && k->autonomous; }

/* ---- values at the places ---- */

/* What the rows are made of at (t, q, v): K, dK, dV or dL/dq, dL/dv; f's derivatives; b_k, d_j b_k. */
typedef struct {
    size_t K, dK, dV, Lq, Lv, fq, fv, b, db, total;
} layout;

static layout lay_out(const nh_generator_fit *s)
{
    size_t m = s->m, f = s->k->f, at = 0;
    layout y;
    y.K = at, at += m * m;
    y.dK = at, at += m * m * m;
    y.dV = at, at += m;
    y.Lq = at, at += m;
    y.Lv = at, at += m;
    y.fq = at, at += f * m;
    y.fv = at, at += f * m;
    y.b = at, at += s->n;
    y.db = at, at += s->n * m;
    y.total = at;
    return y;
}

static nh_tape *row_tape(const nh_generator_fit *s, layout y)
{
    const nh_kinetic *k = s->k;
    nh_dag *d = k->dag;
    size_t m = s->m, width = 1 + 2 * m;
    nh_ex *e = nh_alloc_array(y.total, sizeof *e), *in = nh_alloc_array(width, sizeof *in), L = k->model->system->lagrangian;
    in[0] = k->model->system->t;
    memcpy(in + 1, k->q, m * sizeof *in);
    memcpy(in + 1 + m, k->v, m * sizeof *in);
    memcpy(e + y.K, k->K, m * m * sizeof *e);
    for (size_t r = 0; r < m; r++) {
        for (size_t i = 0; i < m * m; i++) e[y.dK + r * m * m + i] = nh_diff(d, k->K[i], k->q[r]);
        e[y.dV + r] = nh_diff(d, k->V, k->q[r]);
        e[y.Lq + r] = plain(k) ? nh_int(d, 0) : nh_diff(d, L, k->q[r]);
        e[y.Lv + r] = plain(k) ? nh_int(d, 0) : nh_diff(d, L, k->v[r]);
        for (size_t a = 0; a < k->f; a++) {
            e[y.fq + a * m + r] = nh_diff(d, k->force[a], k->q[r]);
            e[y.fv + a * m + r] = nh_diff(d, k->force[a], k->v[r]);
        }
        for (size_t c = 0; c < s->n; c++) e[y.db + c * m + r] = nh_diff(d, s->l.function[c], k->q[r]);
    }
    memcpy(e + y.b, s->l.function, s->n * sizeof *e);
    nh_tape *tape = nh_tape_create(d, width, in, y.total, e, k->model->system->parameters, k->model->parameter, k->model->parameter_value);
    nh_free(e);
    nh_free(in);
    return tape;
}

/* ---- rows ---- */

typedef struct {
    size_t rows, capacity, values, room;
    double *a, *b; /* row by row */
} rows;

static double *next_row(double **block, size_t *count, size_t *capacity, size_t n)
{
    nh_grow(block, capacity, (*count + 1) * n, sizeof **block);
    double *row = *block + (*count)++ * n;
    memset(row, 0, n * sizeof *row);
    return row;
}

static void metric_rows(const nh_generator_fit *s, layout y, const double *z, rows *out)
{
    size_t m = s->m;
    const double *K = z + y.K, *dK = z + y.dK;
    for (size_t r = 0; r < m; r++)
        for (size_t q = 0; q <= r; q++) {
            double *row = next_row(&out->a, &out->rows, &out->capacity, s->n), unit = 1 / sqrt(fabs(K[r * m + r] * K[q * m + q]));
            for (size_t c = 0; c < s->n; c++) {
                size_t i = s->l.component[c];
                const double *db = z + y.db + c * m;
                row[c] = unit * (z[y.b + c] * dK[i * m * m + r * m + q] + K[i * m + q] * db[r] + K[r * m + i] * db[q]);
            }
        }
}

/* The prolonged field on a function of (q, v) with derivatives eq, ev, at the velocity v. */
static void function_row(const nh_generator_fit *s, layout y, const double *z, const double *eq, const double *ev, const double *v, double unit, rows *out)
{
    double *row = next_row(&out->a, &out->rows, &out->capacity, s->n);
    for (size_t c = 0; c < s->n; c++) {
        size_t i = s->l.component[c];
        double rate = 0;
        for (size_t r = 0; r < s->m; r++) rate += z[y.db + c * s->m + r] * v[r];
        row[c] = unit * (z[y.b + c] * eq[i] + rate * ev[i]);
    }
}

/* One over the size of a covector on scaled vectors. */
static double unit_of(const nh_generator_fit *s, const double *e)
{
    double size = 0;
    for (size_t i = 0; i < s->m; i++) size = fmax(size, fabs(e[i]) * s->scale[i]);
    return size > 0 ? 1 / size : 0;
}

static bool place_rows(const nh_generator_fit *s, layout y, nh_tape *tape, nh_tape_work *work, size_t p, double *z, rows *out)
{
    const nh_kinetic *k = s->k;
    size_t m = s->m, width = 1 + 2 * m;
    double *in = nh_alloc_array(width, sizeof *in), sum = 0;
    const double *v = k->speed + p * m;
    in[0] = k->time[p];
    memcpy(in + 1, k->place + p * m, m * sizeof *in);
    memcpy(in + 1 + m, v, m * sizeof *in);
    nh_tape_eval(tape, work, in, z);
    for (size_t i = 0; i < y.total; i++) sum += z[i] - z[i];
    if (sum == 0) {
        if (plain(k)) metric_rows(s, y, z, out);
        if (plain(k)) function_row(s, y, z, z + y.dV, z + y.Lv, v, unit_of(s, z + y.dV), out); /* of its own size: V may be steep elsewhere */
        for (size_t a = 0; a < k->f; a++) function_row(s, y, z, z + y.fq + a * m, z + y.fv + a * m, v, unit_of(s, z + y.fv + a * m), out);
        for (size_t c = 0; c < m; c++) {
            double *row = next_row(&out->b, &out->values, &out->room, s->n);
            for (size_t j = 0; j < s->n; j++)
                if (s->l.component[j] == c) row[j] = z[y.b + j] / s->scale[c];
        }
        for (size_t i = 1; i <= pushes && !plain(k); i++) { /* L at velocities that the constraints need not allow */
            memcpy(in + 1 + m, k->speed + (p + i) % k->places * m, m * sizeof *in);
            nh_tape_eval(tape, work, in, z);
            function_row(s, y, z, z + y.Lq, z + y.Lv, in + 1 + m, unit_of(s, z + y.Lv), out);
        }
    }
    nh_free(in);
    return sum == 0;
}

static double *columns_of(size_t rows_count, size_t n, const double *row)
{
    double *a = nh_alloc_array(rows_count * n + 1, sizeof *a);
    for (size_t i = 0; i < rows_count; i++)
        for (size_t j = 0; j < n; j++) a[i + j * rows_count] = row[i * n + j];
    return a;
}

static void collect(nh_generator_fit *s, rows *out)
{
    layout y = lay_out(s);
    nh_tape *tape = row_tape(s, y);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *z = nh_alloc_array(y.total, sizeof *z);
    for (size_t p = 0; p < s->k->places && (out->rows < 3 * s->n + 40 || out->values < 2 * s->n + 40); p++) place_rows(s, y, tape, work, p, z, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(z);
}

/* Null vectors of A relative to B. */
bool nh_generator_fit_solve(nh_generator_fit *s, nh_error *error)
{
    rows r = {0};
    collect(s, &r);
    nh_basis basis;
    nh_nullspace_options o = nh_nullspace_options_from(s->options);
    double *a = columns_of(r.rows, s->n, r.a), *b = columns_of(r.values, s->n, r.b);
    s->size = nh_alloc_array(s->n + 1, sizeof *s->size);
    for (size_t j = 0; j < s->n; j++) {
        for (size_t i = 0; i < r.values; i++) s->size[j] += b[i + j * r.values] * b[i + j * r.values];
        s->size[j] = sqrt(s->size[j] / (double)(r.values + 1));
    }
    bool good = r.values > 0 && nh_basis_init(&basis, r.values, s->n, b, r.values, NULL, &o, error);
    if (good) {
        size_t n = basis.count;
        double *kept = nh_alloc_array(r.rows * n + 1, sizeof *kept), *kernel = nh_alloc_array(n * n + 1, sizeof *kernel);
        nh_basis_gather(&basis, r.rows, a, r.rows, kept);
        if (n) nh_solve_triangle_right(r.rows, n, basis.r, n, kept);
        for (size_t i = 0; i < r.rows * n; i++) kept[i] *= sqrt((double)r.values / (double)(r.rows + 1)); /* per row of A and B alike */
        s->d = nh_kernel(r.rows, n, kept, s->options->group, kernel, &s->last_null, &s->first_other);
        s->vector = nh_alloc_array(s->n * s->d + 1, sizeof *s->vector);
        if (s->d) nh_basis_expand(&basis, s->n, s->d, kernel, s->vector);
        nh_free(kept);
        nh_free(kernel);
        nh_basis_clear(&basis);
    }
    nh_free(a);
    nh_free(b);
    nh_free(r.a);
    nh_free(r.b);
    return good;
}

void nh_generator_fit_scale(nh_generator_fit *s)
{
    const nh_kinetic *k = s->k;
    double *K = nh_alloc_array(s->m * s->m, sizeof *K);
    s->scale = nh_alloc_array(s->m, sizeof *s->scale);
    nh_kinetic_values(k, s->m * s->m, k->K, k->place, K);
    for (size_t i = 0; i < s->m; i++) s->scale[i] = K[i * (s->m + 1)] > 0 ? 1 / sqrt(K[i * (s->m + 1)]) : 1;
    nh_free(K);
}

void nh_generator_fit_clear(nh_generator_fit *s)
{
    nh_library_clear(&s->l);
    nh_free(s->scale);
    nh_free(s->vector);
    nh_free(s->size);
}
