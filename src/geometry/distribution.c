#include "geometry/distribution.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "expr/diff.h"
#include "expr/normal.h"
#include "system/embedding.h"

const char *nh_constraint_type_name(nh_constraint_type type)
{
    static const char *const names[] = {"none", "linear", "affine", "nonlinear"};
    return names[type];
}

/* Zero by normal form, or, where that is undecided, at the probes. */
static bool vanishes(const nh_model *o, nh_ex e)
{
    nh_zero_verdict verdict = nh_normal_is_zero(o->dag, e, 0);
    if (verdict == NH_ZERO) return true;
    return nh_chart_pivot_score(o->chart, e) == 0;
}

static nh_constraint_type type_of(const nh_model *o)
{
    const nh_system *y = o->system;
    nh_dag *d = o->dag;
    nh_constraint_type type = o->k ? NH_LINEAR : NH_UNCONSTRAINED;
    nh_ex *v = nh_alloc_array(2 * o->m + 1, sizeof *v), *zero = v + o->m;
    for (size_t s = 0; s < o->m; s++) v[s] = y->coordinate[s].v;
    for (size_t a = 0; a < o->k; a++) {
        nh_ex f = nh_chart_constraint(o->chart, a);
        for (size_t s = 0; s < o->m; s++)
            for (size_t r = 0; r <= s; r++) {
                nh_ex second = nh_diff(d, nh_diff(d, f, v[s]), v[r]);
                if (!nh_is_zero(d, second) && nh_normal_is_zero(d, second, 0) != NH_ZERO) type = NH_NONLINEAR;
            }
        if (type == NH_LINEAR && nh_normal_is_zero(d, nh_substitute(d, f, o->m, v, zero), 0) != NH_ZERO) type = NH_AFFINE;
    }
    nh_free(v);
    return type;
}

static bool is_semiholonomic(const nh_model *o)
{
    nh_dag *d = o->dag;
    for (size_t a = 0; a < o->k; a++)
        for (size_t l = 0; l < o->n; l++) {
            nh_ex e = nh_int(d, 0);
            for (size_t s = 0; s < o->m; s++) {
                nh_ex part = nh_sub(d, nh_model_X0(o, o->R[s * o->n + l]), nh_model_X(o, l, o->rho[s]));
                e = nh_add(d, e, nh_mul(d, o->nu[a * o->m + s], part));
            }
            if (!vanishes(o, e)) return false;
        }
    return true;
}

/* ---- growth vector ---- */

typedef struct {
    size_t count, capacity;
    nh_ex *field; /* count x m */
} fields;

static void push(fields *f, size_t m, const nh_ex *x)
{
    nh_grow(&f->field, &f->capacity, (f->count + 1) * m, sizeof *f->field);
    memcpy(f->field + f->count++ * m, x, m * sizeof *x);
}

static void bracket(const nh_model *o, const nh_ex *x, const nh_ex *y, nh_ex *out)
{
    nh_dag *d = o->dag;
    for (size_t s = 0; s < o->m; s++) {
        out[s] = nh_int(d, 0);
        for (size_t r = 0; r < o->m; r++) {
            nh_ex q = o->system->coordinate[r].q;
            out[s] = nh_add(d, out[s], nh_mul(d, x[r], nh_diff(d, y[s], q)));
            out[s] = nh_sub(d, out[s], nh_mul(d, y[r], nh_diff(d, x[s], q)));
        }
    }
}

/* Largest rank of the fields over a few probes. */
static size_t rank_of(const nh_model *o, const fields *f)
{
    enum { probes = 4 };
    size_t m = o->m, n = f->count, best = 0;
    nh_tape *tape = nh_model_tape(o, n * m, f->field);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *a = nh_alloc_array(n * m, sizeof *a), *s = nh_alloc_array(n + m, sizeof *s);
    for (size_t p = 0; p < probes && p < o->chart->probes; p++) {
        nh_tape_eval(tape, work, o->chart->probe + p * o->width, a);
        size_t rank = 0, least = n < m ? n : m;
        if (nh_svd(m, n, a, s, NULL, NULL))
            while (rank < least && s[rank] > 1e-9 * s[0]) rank++;
        if (rank > best) best = rank;
    }
    nh_free(s);
    nh_free(a);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return best;
}

static void growth(const nh_model *o, nh_distribution *out)
{
    enum { most_fields = 200 };
    size_t m = o->m, first = 0;
    fields f = {0};
    nh_ex *x = nh_alloc_array(m + 1, sizeof *x);
    for (size_t i = 0; i < o->n; i++) {
        for (size_t s = 0; s < m; s++) x[s] = o->R[s * o->n + i];
        push(&f, m, x);
    }
    out->growth[out->growth_length++] = rank_of(o, &f);
    while (out->growth_length < NH_MOST_GROWTH && out->growth[out->growth_length - 1] < m && f.count < most_fields) {
        size_t last = f.count;
        for (size_t i = 0; i < o->n; i++)
            for (size_t j = first; j < last && f.count < most_fields; j++) {
                if (first == 0 && j <= i) continue; /* [X_i, X_j] once */
                bracket(o, f.field + i * m, f.field + j * m, x);
                push(&f, m, x);
            }
        first = last;
        size_t rank = rank_of(o, &f);
        if (rank == out->growth[out->growth_length - 1]) break;
        out->growth[out->growth_length++] = rank;
    }
    out->hidden = m - out->growth[out->growth_length - 1];
    nh_free(x);
    nh_free(f.field);
}

nh_distribution nh_distribution_of(const nh_model *o)
{
    nh_distribution out = {.type = type_of(o)};
    for (size_t a = 0; a < o->k; a++) out.rheonomic |= nh_depends(o->dag, nh_chart_constraint(o->chart, a), o->system->t);
    if (o->k == 0) return out;
    out.semiholonomic = is_semiholonomic(o);
    out.holonomic = out.semiholonomic && out.type != NH_NONLINEAR;
    if (out.type == NH_LINEAR && !out.rheonomic) growth(o, &out);
    return out;
}
