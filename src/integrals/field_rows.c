#include "integrals/field_rows.h"

#include <string.h>

#include "base/budget.h"
#include "exact/normal.h"
#include "graph/dag.h"

/* Is R free of the velocities, as it is written? */
static bool is_inclined(const nh_model *model)
{
    for (size_t i = 0; i < model->m * model->n; i++)
        for (size_t j = 0; j < model->n; j++)
            if (nh_depends(model->dag, model->R[i], model->chart->w[j])) return true;
    return false;
}

/* pbar_i w^i - Lbar; the energy itself, in its own words, where the velocities are R w. */
static nh_ex energy_of_frame(const nh_model *model)
{
    nh_dag *d = model->dag;
    nh_ex e = nh_neg(d, model->Lbar), off = nh_int(d, 0);
    for (size_t i = 0; i < model->n; i++) e = nh_add(d, e, nh_mul(d, model->pbar[i], model->chart->w[i]));
    for (size_t s = 0; s < model->m; s++) {
        nh_ex rest = model->rho[s];
        for (size_t i = 0; i < model->n; i++)
            rest = nh_sub(d, rest, nh_mul(d, model->R[s * model->n + i], model->chart->w[i]));
        if (!nh_is_zero(d, rest)) off = nh_add(d, off, nh_mul(d, model->p[s], rest));
    }
    return nh_is_zero(d, off) ? model->E : e;
}

/* Is pbar_i = M_ij w^j with a constant M?  Then the field M^-1 X has the current w^i. */
static bool is_constant(const nh_model *model)
{
    nh_dag *d = model->dag;
    size_t n = model->n;
    bool constant = true;
    for (size_t i = 0; i < n * n && constant; i++) constant = nh_model_is_constant(model, model->M[i]);
    for (size_t i = 0; i < n && constant; i++) {
        nh_ex off = model->pbar[i];
        for (size_t j = 0; j < n; j++) off = nh_sub(d, off, nh_mul(d, model->M[i * n + j], model->chart->w[j]));
        constant = nh_normal_is_zero(d, off, 0) == NH_ZERO;
    }
    return constant;
}

nh_field_bases nh_field_rows_bases(const nh_model *model)
{
    nh_dag *d = model->dag;
    size_t n = model->n;
    nh_field_base *base = nh_arena_alloc(model->arena, (n + 1) * sizeof *base);
    bool constant = is_constant(model);
    base[0] = (nh_field_base){energy_of_frame(model), model->chart->w};
    for (size_t i = 0; i < n; i++) {
        nh_ex *zeta = nh_arena_alloc(model->arena, (n + 1) * sizeof *zeta);
        for (size_t j = 0; j < n; j++) zeta[j] = nh_int(d, i == j);
        if (constant) nh_lu_solve(model->M_lu, zeta, zeta);
        base[1 + i] = (nh_field_base){constant ? model->chart->w[i] : model->pbar[i], zeta};
    }
    return (nh_field_bases){n + 1, base, is_inclined(model)};
}

/* The derivations that have rows: D_0, and D_1 .. D_n where (NY) is no identity. */
static size_t derivations_of(const nh_model *model, const nh_field_bases *bases)
{
    return bases->inclined ? 1 + model->n : 1;
}

size_t nh_field_rows_equations(const nh_model *model, const nh_field_bases *bases, size_t points)
{
    return derivations_of(model, bases) * points;
}

/* D_q of a factor, a base or a function, which has no zeta. */
static nh_ex derived(const nh_model *model, const nh_field_bases *bases, nh_ex factor, size_t q)
{
    nh_dag *d = model->dag;
    size_t n = model->n;
    const nh_ex *zeta = NULL;
    for (size_t b = 0; b < bases->count && !zeta; b++)
        if (bases->base[b].phi == factor) zeta = bases->base[b].zeta;
    nh_ex e = q ? nh_model_Y(model, q - 1, factor) : nh_model_X0(model, factor);
    for (size_t i = 0; i < n && zeta; i++) {
        nh_ex c = q ? nh_neg(d, model->M[i * n + q - 1]) : model->A[i];
        e = nh_add(d, e, nh_mul(d, c, zeta[i]));
    }
    return e;
}

/* The factors, their derivatives one derivation after another, kappa. */
static nh_tape *tape_of(const nh_model *model, const nh_field_bases *bases, const nh_ansatz *a, nh_ex kappa)
{
    size_t n = a->factors, derivations = derivations_of(model, bases), count = (1 + derivations) * n;
    nh_ex *out = nh_alloc_array(count + 1, sizeof *out);
    memcpy(out, a->factor, n * sizeof *out);
    for (size_t q = 0; q < derivations; q++)
        for (size_t i = 0; i < n; i++) out[(1 + q) * n + i] = derived(model, bases, a->factor[i], q);
    out[count] = kappa;
    nh_tape *tape = nh_model_tape(model, count + 1, out);
    nh_free(out);
    return tape;
}

typedef struct {
    const nh_ansatz *ansatz;
    const nh_points *points;
    size_t derivations, ld; /* ld: equations */
    bool kappa;
    double **row; /* of NH_BATCH values each */
    double *a, *b;
} block;

/* One column at points start .. start + count - 1 by Leibniz' rule. */
static void column_at(const block *k, size_t j, size_t start, size_t count)
{
    const nh_column *c = &k->ansatz->column[j];
    size_t n = k->ansatz->factors, points = k->points->count;
    const double *unit = k->row[(1 + k->derivations) * n], *weight = k->points->weight + start;
    double value[NH_BATCH], rate[NH_BATCH];
    for (size_t q = 0; q < k->derivations; q++) {
        for (size_t p = 0; p < count; p++) value[p] = 1, rate[p] = 0;
        for (size_t i = 0; i < c->count; i++) {
            const double *f = k->row[c->factor[i]], *g = k->row[(1 + q) * n + c->factor[i]];
            for (size_t p = 0; p < count; p++) {
                rate[p] = rate[p] * f[p] + value[p] * g[p];
                value[p] *= f[p];
            }
        }
        for (size_t p = 0; p < count; p++) k->a[j * k->ld + q * points + start + p] = weight[p] * rate[p];
    }
    for (size_t p = 0; p < count; p++) k->b[j * points + start + p] = value[p] * (k->kappa ? weight[p] * unit[p] : 1);
}

void nh_field_rows_all(const nh_model *model, const nh_field_bases *bases, const nh_ansatz *ansatz, nh_ex kappa,
                       const nh_points *points, double *a, double *b)
{
    size_t derivations = derivations_of(model, bases), rows = (1 + derivations) * ansatz->factors + 1;
    nh_tape *tape = tape_of(model, bases, ansatz, kappa);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *store = nh_alloc_array(rows * NH_BATCH, sizeof *store), **row = nh_alloc_array(rows, sizeof *row);
    const double **in = nh_alloc_array(model->width + 1, sizeof *in);
    for (size_t i = 0; i < rows; i++) row[i] = store + i * NH_BATCH;
    block k = {ansatz, points, derivations, derivations * points->count, kappa != 0, row, a, b};
    for (size_t start = 0; start < points->count; start += NH_BATCH) {
        size_t left = points->count - start, count = left < NH_BATCH ? left : NH_BATCH;
        for (size_t j = 0; j < points->width; j++) in[j] = points->column[j] + start;
        nh_work_add(NH_WORK_VALUE, (double)count * (double)(nh_tape_length(tape) + derivations * ansatz->columns));
        nh_tape_eval_batch(tape, work, count, in, row);
        for (size_t j = 0; j < ansatz->columns; j++) column_at(&k, j, start, count);
    }
    nh_free(in);
    nh_free(row);
    nh_free(store);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}
