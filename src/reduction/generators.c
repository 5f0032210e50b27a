#include "reduction/generators.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/progress.h"
#include "expr/diff.h"
#include "expr/normal.h"
#include "expr/relation.h"
#include "noether/echelon.h"
#include "noether/recognise.h"
#include "reduction/library.h"
#include "reduction/subspace.h"

enum { most_columns = 420, pushes = 6 }; /* pushes: velocities per place where L itself must be invariant */

typedef struct {
    const nh_kinetic *k;
    const nh_options *options;
    nh_library l;
    size_t m, n, d;         /* coordinates, columns, null vectors */
    double *scale;          /* m: K_ii^(-1/2), or 1 */
    double *vector, *size;  /* n x d null vectors; n: root mean square of each scaled column */
    double last_null, first_other;
} fit;

static bool plain(const nh_kinetic *k) { return k->quadratic && !k->magnetic && k->autonomous; }

/* ---- values at the places ---- */

/* What the rows are made of at (t, q, v): K, dK, dV or dL/dq, dL/dv; f's derivatives; b_k, d_j b_k. */
typedef struct {
    size_t K, dK, dV, Lq, Lv, fq, fv, b, db, total;
} layout;

static layout lay_out(const fit *s)
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

static nh_tape *row_tape(const fit *s, layout y)
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

static void metric_rows(const fit *s, layout y, const double *z, rows *out)
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
static void function_row(const fit *s, layout y, const double *z, const double *eq, const double *ev, const double *v, double unit, rows *out)
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
static double unit_of(const fit *s, const double *e)
{
    double size = 0;
    for (size_t i = 0; i < s->m; i++) size = fmax(size, fabs(e[i]) * s->scale[i]);
    return size > 0 ? 1 / size : 0;
}

static bool place_rows(const fit *s, layout y, nh_tape *tape, nh_tape_work *work, size_t p, double *z, rows *out)
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

static void collect(fit *s, rows *out)
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
static bool solve(fit *s, nh_error *error)
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

/* ---- echelon form ---- */

/* Columns from the simplest to the most complex; among equals by coordinate. */
static size_t *by_complexity(const fit *s)
{
    size_t *order = nh_alloc_array(s->n + 1, sizeof *order);
    for (size_t i = 0; i < s->n; i++) {
        size_t j = i;
        for (; j > 0 && s->l.complexity[order[j - 1]] > s->l.complexity[i]; j--) order[j] = order[j - 1];
        order[j] = i;
    }
    return order;
}

/* Reduced echelon form with the most complex columns as pivots; entries are compared as parts of the field, c_j |b_j|. */
static void reduce_vectors(fit *s, const size_t *order)
{
    static const double small = 1e-6, pivotal = 1e-3; /* nearly dependent columns carry noise: no pivot is made of it */
    size_t n = s->n, rank = 0;
    double *v = s->vector;
    for (size_t at = n; at-- > 0 && rank < s->d;) {
        size_t j = order[at], best = rank;
        double most = 0, whole = 0;
        for (size_t r = rank; r < s->d; r++)
            if (fabs(v[j + r * n]) > fabs(v[j + best * n])) best = r;
        most = fabs(v[j + best * n]) * s->size[j];
        for (size_t i = 0; i < n; i++) whole = fmax(whole, fabs(v[i + best * n]) * s->size[i]);
        if (!(most > pivotal * whole)) continue;
        for (size_t i = 0; i < n; i++) {
            double x = v[i + best * n];
            v[i + best * n] = v[i + rank * n];
            v[i + rank * n] = x;
        }
        double pivot = v[j + rank * n];
        for (size_t i = 0; i < n; i++) v[i + rank * n] /= pivot;
        for (size_t r = 0; r < s->d; r++) {
            double factor = v[j + r * n];
            if (r == rank || factor == 0) continue;
            for (size_t i = 0; i < n; i++) v[i + r * n] -= factor * v[i + rank * n];
        }
        rank++;
    }
    for (size_t r = 0; r < s->d; r++) {
        double whole = 0;
        for (size_t i = 0; i < n; i++) whole = fmax(whole, fabs(v[i + r * n]) * s->size[i]);
        for (size_t i = 0; i < n; i++)
            if (fabs(v[i + r * n]) * s->size[i] <= small * whole) v[i + r * n] = 0;
    }
}

static void scales(fit *s)
{
    const nh_kinetic *k = s->k;
    double *K = nh_alloc_array(s->m * s->m, sizeof *K);
    s->scale = nh_alloc_array(s->m, sizeof *s->scale);
    nh_kinetic_values(k, s->m * s->m, k->K, k->place, K);
    for (size_t i = 0; i < s->m; i++) s->scale[i] = K[i * (s->m + 1)] > 0 ? 1 / sqrt(K[i * (s->m + 1)]) : 1;
    nh_free(K);
}

static void fit_clear(fit *s)
{
    nh_library_clear(&s->l);
    nh_free(s->scale);
    nh_free(s->vector);
    nh_free(s->size);
}

/* The coefficients of one vector again, from its own terms alone: a large library is badly conditioned, a few terms are not. */
static void refit(fit *s, size_t r)
{
    fit t = {.k = s->k, .options = s->options, .m = s->m};
    double *v = s->vector + r * s->n, most = 0;
    size_t *index = nh_alloc_array(s->n + 1, sizeof *index);
    nh_error ignored = {0};
    for (size_t j = 0; j < s->n; j++)
        if (v[j] != 0) index[t.n++] = j;
    nh_library_pick(&t.l, &s->l, t.n, index);
    scales(&t);
    if (solve(&t, &ignored) && t.d > 0) {
        size_t *order = by_complexity(&t), pivot = order[t.n - 1], use = 0;
        reduce_vectors(&t, order); /* another generator may live on the same terms: the one that has the most complex term is meant */
        for (size_t c = 0; c < t.d; c++)
            if (fabs(t.vector[pivot + c * t.n]) > fabs(t.vector[pivot + use * t.n])) use = c;
        const double *u = t.vector + use * t.n;
        for (size_t i = 0; i < t.n; i++) most = fmax(most, fabs(u[i]) * t.size[i]);
        for (size_t i = 0; i < t.n; i++) v[index[i]] = fabs(u[i]) * t.size[i] > s->options->same * most ? u[i] : 0;
        nh_free(order);
    }
    fit_clear(&t);
    nh_free(index);
}

/* The simplest term, of the last coordinate, gets the coefficient 1. */
static void normalise(fit *s, const size_t *order, size_t r)
{
    double *v = s->vector + r * s->n, unit = 0, complexity = INFINITY;
    for (size_t at = 0; at < s->n; at++) {
        size_t j = order[at];
        if (v[j] == 0 || s->l.complexity[j] > complexity) continue;
        complexity = s->l.complexity[j];
        unit = v[j];
    }
    for (size_t j = 0; j < s->n && unit != 0; j++) v[j] /= unit;
}

/* ---- exact coefficients ---- */

static bool rational(fit *s, size_t r, nh_ex *coefficient)
{
    enum { largest_denominator = 1000 };
    nh_num x;
    bool all = true;
    for (size_t j = 0; j < s->n; j++) {
        double value = s->vector[j + r * s->n];
        if (value == 0) coefficient[j] = nh_int(s->k->dag, 0);
        else if (nh_recognise_ratio(value, largest_denominator, s->options->same, &x)) coefficient[j] = nh_number(s->k->dag, x);
        else all = nh_recognise_number(s->k->dag, value, s->options->recognise, &coefficient[j]) && all;
        if (value != 0 && !all) coefficient[j] = nh_real(s->k->dag, value);
    }
    return all;
}

static void assemble(const fit *s, const nh_ex *coefficient, nh_ex *component)
{
    nh_dag *d = s->k->dag;
    for (size_t i = 0; i < s->m; i++) component[i] = nh_int(d, 0);
    for (size_t j = 0; j < s->n; j++)
        component[s->l.component[j]] = nh_add(d, component[s->l.component[j]], nh_mul(d, coefficient[j], s->l.function[j]));
}

/* Coefficients in Q(parameters): the conditions of each term, told apart by symbols of their own, must cancel identically. */
static bool parametric(fit *s, size_t r, nh_ex *coefficient)
{
    const nh_kinetic *k = s->k;
    nh_dag *d = k->dag;
    size_t m = s->m, total = m * (m + 1) / 2 + 1 + k->f, terms = 0, *index = nh_alloc_array(s->n + 1, sizeof *index);
    nh_ex *mark = nh_alloc_array(2 * total, sizeof *mark), *equation = mark + total, *e = nh_alloc_array(2 * s->n + m + 1, sizeof *e), *found = e + s->n, *field = found + s->n;
    for (size_t i = 0; i < total; i++) mark[i] = nh_symbol_fresh(d, "mark");
    for (size_t j = 0; j < s->n; j++) {
        if (s->vector[j + r * s->n] == 0) continue;
        for (size_t i = 0; i < m; i++) field[i] = i == s->l.component[j] ? s->l.function[j] : nh_int(d, 0);
        size_t n = nh_invariance_equations(k, field, equation) + 1 + k->f;
        e[terms] = nh_int(d, 0);
        for (size_t i = 0; i < n; i++) e[terms] = nh_add(d, e[terms], nh_mul(d, mark[i], equation[i]));
        index[terms++] = j;
    }
    bool good = nh_relation_find(d, terms, e, k->model->system->parameters, k->model->parameter, (size_t)s->options->proof_terms, found) == NH_RELATION_UNIQUE;
    nh_ex unit = 0;
    for (size_t i = 0; i < terms && good; i++)
        if (s->vector[index[i] + r * s->n] == 1) unit = found[i];
    good = good && unit && !nh_is_zero(d, unit);
    for (size_t j = 0; j < s->n && good; j++) coefficient[j] = nh_int(d, 0);
    for (size_t i = 0; i < terms && good; i++) coefficient[index[i]] = nh_simplify(d, nh_div(d, found[i], unit));
    nh_free(index);
    nh_free(mark);
    nh_free(e);
    return good;
}

static void make_generators(fit *s, nh_generators *out)
{
    const nh_kinetic *k = s->k;
    nh_ex *coefficient = nh_alloc_array(s->n + s->m + 1, sizeof *coefficient), *component = coefficient + s->n;
    size_t *order = by_complexity(s);
    reduce_vectors(s, order);
    out->generator = nh_arena_alloc(k->arena, (s->d + 1) * sizeof *out->generator);
    out->count = 0;
    for (size_t r = s->d; r-- > 0;) { /* the pivots came from the most complex down */
        refit(s, r);
        normalise(s, order, r);
        if (!rational(s, r, coefficient)) parametric(s, r, coefficient);
        assemble(s, coefficient, component);
        nh_generator *g = &out->generator[out->count];
        nh_generator_init(g, k, NULL, component, s->options);
        out->count += g->invariant;
    }
    nh_free(order);
    nh_free(coefficient);
}

bool nh_generators_find(nh_generators *out, const nh_kinetic *k, const nh_jets *jets, const nh_options *options, nh_error *error)
{
    *out = (nh_generators){0};
    for (int level = 1; level <= NH_LIBRARY_LEVELS && !(jets && out->count >= jets->dimension) && !(out->level && nh_late()); level++) {
        fit s = {.k = k, .options = options, .m = k->m};
        nh_generators found = {.level = level};
        nh_library_init(&s.l, k, jets, level, most_columns);
        found.columns = s.n = s.l.count;
        scales(&s);
        bool good = s.n == 0 || solve(&s, error);
        if (good && s.d) make_generators(&s, &found);
        found.last_null = s.last_null;
        found.first_other = s.first_other;
        fit_clear(&s);
        if (!good) return false;
        if (found.count > out->count || !out->level) *out = found;
        else if (!jets) break;
    }
    return true;
}
