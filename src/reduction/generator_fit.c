/* The combinations of a library's fields that leave a system invariant, as null vectors (generator_fit.h).
 *
 *                       column: field b_k d/dq^(i_k)
 *      place 1   L_xi K      m (m + 1)/2 rows               A c = 0 relative to B c:
 *                xi(V)       1 row                          B: the values of the fields at the places
 *                xi(f^a)     f rows
 *                L_xi Q      m rows                         each kind in units of its own terms
 *      place 2   .. */
#include "reduction/generator_fit.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "reduction/relative.h"

enum { pushes = 6 }; /* velocities per place where L itself must be invariant */

static bool plain(const nh_kinetic *k) { return k->quadratic && !k->magnetic && k->autonomous; }

/* ---- values at the places ---- */

/* The data of the rows at (t, q, v): K, dK, dV or dL/dq, dL/dv; f's derivatives; Q and its derivatives; b_k,
 * d_j b_k. */
typedef struct {
    size_t K, dK, dV, Lq, Lv, fq, fv, Q, Qq, Qv, b, db, total;
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
    y.Q = at, at += s->k->forced ? m : 0;
    y.Qq = at, at += s->k->forced ? m * m : 0;
    y.Qv = at, at += s->k->forced ? m * m : 0;
    y.b = at, at += s->terms;
    y.db = at, at += s->terms * m;
    y.total = at;
    return y;
}

static nh_tape *row_tape(const nh_generator_fit *s, layout y)
{
    const nh_kinetic *k = s->k;
    nh_dag *d = k->dag;
    size_t m = s->m, width = 1 + 2 * m;
    nh_ex *e = nh_alloc_array(y.total, sizeof *e), *in = nh_alloc_array(width, sizeof *in),
          L = k->model->system->lagrangian;
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
        for (size_t i = 0; i < m && k->forced; i++) {
            e[y.Qq + i * m + r] = nh_diff(d, k->Q[i], k->q[r]);
            e[y.Qv + i * m + r] = nh_diff(d, k->Q[i], k->v[r]);
        }
        for (size_t c = 0; c < s->terms; c++) e[y.db + c * m + r] = nh_diff(d, s->b[c], k->q[r]);
    }
    if (k->forced) memcpy(e + y.Q, k->Q, m * sizeof *e);
    memcpy(e + y.b, s->b, s->terms * sizeof *e);
    nh_tape *tape = nh_tape_create(d, width, in, y.total, e, k->model->system->parameters, k->model->parameter,
                                   k->model->parameter_value);
    nh_free(e);
    nh_free(in);
    return tape;
}

/* ---- rows ---- */

/* The unit of an entry of K; a velocity without inertia, which constraints may bind, has none. */
static double size_of(const nh_generator_fit *s, const double *K, size_t r)
{
    double own = fabs(K[r * s->m + r]);
    return own > 0 ? own : 1 / (s->scale[r] * s->scale[r]);
}

/* (L_xi K)_rs over (K_rr K_ss)^(1/2). */
static void metric_rows(const nh_generator_fit *s, layout y, const double *z, nh_relative *out)
{
    size_t m = s->m;
    const double *K = z + y.K, *dK = z + y.dK;
    for (size_t r = 0; r < m; r++)
        for (size_t q = 0; q <= r; q++) {
            double *row = nh_relative_condition(out), unit = 1 / sqrt(size_of(s, K, r) * size_of(s, K, q));
            for (size_t c = 0; c < s->terms; c++) {
                size_t i = s->component[c];
                const double *db = z + y.db + c * m;
                row[s->column[c]] +=
                    unit * (z[y.b + c] * dK[i * m * m + r * m + q] + K[i * m + q] * db[r] + K[r * m + i] * db[q]);
            }
        }
}

/* The prolonged field on a function of (q, v) with derivatives eq, ev, at the velocity v. */
static void function_row(const nh_generator_fit *s, layout y, const double *z, const double *eq, const double *ev,
                         const double *v, double unit, nh_relative *out)
{
    double *row = nh_relative_condition(out);
    for (size_t c = 0; c < s->terms; c++) {
        size_t i = s->component[c];
        double rate = 0;
        for (size_t r = 0; r < s->m; r++) rate += z[y.db + c * s->m + r] * v[r];
        row[s->column[c]] += unit * (z[y.b + c] * eq[i] + rate * ev[i]);
    }
}

/* One over the size of a covector on scaled vectors. */
static double unit_of(const nh_generator_fit *s, const double *e)
{
    double size = 0;
    for (size_t i = 0; i < s->m; i++) size = fmax(size, fabs(e[i]) * s->scale[i]);
    return size > 0 ? 1 / size : 0;
}

/* One over the unit of velocities, a power of 1024, by which no digit is lost: the rows of constraints and of L must
 * not become small with the unit of time. */
static double slowness(const nh_generator_fit *s, const double *v)
{
    double size = 0;
    for (size_t i = 0; i < s->m; i++) size = fmax(size, fabs(v[i]) / s->scale[i]);
    return size > 0 && isfinite(size) ? exp2(-10 * round(log2(size) / 10)) : 1;
}

/* (L_xi Q)_i = xi(Q_i), prolonged, + Q_l d_i xi^l, in units of the largest force and of its change. */
static void force_rows(const nh_generator_fit *s, layout y, const double *z, const double *v, nh_relative *out)
{
    size_t m = s->m;
    double size = 0;
    for (size_t i = 0; i < m && s->k->forced; i++) {
        size = fmax(size, fabs(z[y.Q + i]) * s->scale[i]);
        for (size_t r = 0; r < m; r++)
            size = fmax(size, fabs(z[y.Qq + i * m + r]) * s->scale[i] * s->scale[r] +
                                  fabs(z[y.Qv + i * m + r] * v[r]) * s->scale[i]);
    }
    for (size_t i = 0; i < m && size > 0; i++) {
        function_row(s, y, z, z + y.Qq + i * m, z + y.Qv + i * m, v, s->scale[i] / size, out);
        double *row = out->a + (out->conditions - 1) * out->columns;
        for (size_t c = 0; c < s->terms; c++)
            row[s->column[c]] += z[y.Q + s->component[c]] * z[y.db + c * m + i] * s->scale[i] / size;
    }
}

/* All rows of one place; false where something is not finite. */
static bool place_rows(const nh_generator_fit *s, layout y, nh_tape *tape, nh_tape_work *work, size_t p, double *z,
                       nh_relative *out)
{
    const nh_kinetic *k = s->k;
    size_t m = s->m, width = 1 + 2 * m;
    double *in = nh_alloc_array(width, sizeof *in);
    const double *v = k->speed + p * m;
    in[0] = k->time[p];
    memcpy(in + 1, k->place + p * m, m * sizeof *in);
    memcpy(in + 1 + m, v, m * sizeof *in);
    nh_tape_eval(tape, work, in, z);
    bool finite = nh_all_finite(y.total, z);
    if (finite) {
        if (plain(k)) metric_rows(s, y, z, out);
        /* relative to its own size: V may be steep elsewhere */
        if (plain(k)) function_row(s, y, z, z + y.dV, z + y.Lv, v, unit_of(s, z + y.dV), out);
        for (size_t a = 0; a < k->f; a++)
            function_row(s, y, z, z + y.fq + a * m, z + y.fv + a * m, v, slowness(s, v) * unit_of(s, z + y.fv + a * m),
                         out);
        if (k->forced) force_rows(s, y, z, v, out);
        for (size_t c = 0; c < m; c++) {
            double *row = nh_relative_value(out);
            for (size_t j = 0; j < s->terms; j++)
                if (s->component[j] == c) row[s->column[j]] = z[y.b + j] / s->scale[c];
        }
        for (size_t i = 1; i <= pushes && !plain(k); i++) { /* L at velocities that the constraints need not allow */
            memcpy(in + 1 + m, k->speed + (p + i) % k->places * m, m * sizeof *in);
            nh_tape_eval(tape, work, in, z);
            if (nh_all_finite(y.total, z))
                function_row(s, y, z, z + y.Lq, z + y.Lv, in + 1 + m, slowness(s, in + 1 + m) * unit_of(s, z + y.Lv),
                             out);
        }
    }
    nh_free(in);
    return finite;
}

/* A potential gives one row a place: there must be more than fields that leave the metric as it is, m (m + 1)/2 at
 * most, or than columns. */
static bool wants_more(const nh_generator_fit *s, size_t places, const nh_relative *r)
{
    enum { spare = 10 };
    size_t fields = s->m * (s->m + 1) / 2, unknown = s->n < fields ? s->n : fields;
    return places < unknown + spare || nh_relative_wants_more(r);
}

/* Rows of as many places as the columns need. */
static void collect(nh_generator_fit *s, nh_relative *out)
{
    layout y = lay_out(s);
    nh_tape *tape = row_tape(s, y);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *z = nh_alloc_array(y.total, sizeof *z);
    for (size_t p = 0, used = 0; p < s->k->places && wants_more(s, used, out); p++)
        used += place_rows(s, y, tape, work, p, z, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(z);
}

/* The columns as sums of b d/dq^i. */
static void list_terms(nh_generator_fit *s)
{
    size_t most = s->n * (s->l.whole ? s->m : 1);
    s->b = nh_alloc_array(most + 1, sizeof *s->b);
    s->component = nh_alloc_array(most + 1, sizeof *s->component);
    s->column = nh_alloc_array(most + 1, sizeof *s->column);
    s->terms = 0;
    for (size_t c = 0; c < s->n; c++)
        for (size_t i = 0; i < s->m; i++) {
            nh_ex b = nh_library_component(&s->l, s->k->dag, c, i);
            if (nh_is_zero(s->k->dag, b)) continue;
            s->b[s->terms] = b;
            s->component[s->terms] = i;
            s->column[s->terms++] = c;
        }
}

bool nh_generator_fit_solve(nh_generator_fit *s, nh_error *error)
{
    nh_relative r = {.columns = s->n};
    list_terms(s);
    collect(s, &r);
    s->size = nh_alloc_array(s->n + 1, sizeof *s->size);
    nh_relative_sizes(&r, s->size);
    s->vector = nh_relative_null(&r, s->options, &s->d, &s->last_null, &s->first_other, error);
    nh_relative_clear(&r);
    return s->vector != NULL;
}

void nh_generator_fit_scale(nh_generator_fit *s)
{
    const nh_kinetic *k = s->k;
    double *K = nh_alloc_array(s->m * s->m, sizeof *K);
    s->scale = nh_alloc_array(s->m, sizeof *s->scale);
    nh_kinetic_values(k, s->m * s->m, k->K, k->place, K);
    for (size_t i = 0; i < s->m; i++) {
        s->scale[i] = K[i * (s->m + 1)];
        for (size_t j = 0; j < s->m && k->invertible && !k->metric; j++)
            s->scale[i] = fmax(s->scale[i], fabs(K[i * s->m + j]));
    }
    double length = nh_kinetic_length(k, s->scale);
    for (size_t i = 0; i < s->m; i++) s->scale[i] = s->scale[i] > 0 ? length / sqrt(s->scale[i]) : 1;
    nh_free(K);
}

void nh_generator_fit_clear(nh_generator_fit *s)
{
    nh_library_clear(&s->l);
    nh_free(s->scale);
    nh_free(s->vector);
    nh_free(s->size);
    nh_free(s->b);
    nh_free(s->component);
    nh_free(s->column);
}
