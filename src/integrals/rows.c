#include "integrals/rows.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

/* The derivative of log(R - s), a difference that cancels, is often a quotient in which nothing cancels: then the
 * simplification pays.  For all rates it would cost more than the whole search. */
static nh_ex without_logarithms(nh_dag *d, nh_ex of, nh_ex derivative)
{
    NH_LIST(call);
    size_t n = nh_functions_in(d, of, &call);
    for (size_t i = 0; i < n; i++) {
        nh_function f = nh_function_of(d, call[i]);
        if (f == NH_LOG || f == NH_ATANH || f == NH_ACOSH || f == NH_ASIN || f == NH_ACOS)
            return nh_simplify(d, derivative);
    }
    return derivative;
}

/* ---- current route ---- */

struct nh_rows {
    const nh_model *model;
    const nh_ansatz *ansatz;
    nh_tape *tape, *beyond; /* beyond the chart, where q' and w' are inputs: made when such points come */
    nh_tape_work *work, *beyond_work;
    size_t unknowns;
    nh_ex *unknown;
    double **row;          /* values, then rates of the factors, then kappa */
    double *store, *theta; /* rows of NH_BATCH */
    double *value, *rate;  /* columns x NH_BATCH */
    const double **in;
};

/* Values and Gamma-rates of the factors, in one tape. */
static nh_tape *factor_tape(const nh_model *model, const nh_ansatz *a, nh_ex kappa, size_t unknowns,
                            const nh_ex *unknown)
{
    size_t n = a->factors;
    nh_ex *out = nh_alloc_array(2 * n + 1, sizeof *out), *in = nh_alloc_array(model->width + unknowns, sizeof *in);
    for (size_t i = 0; i < n; i++) {
        out[i] = a->factor[i];
        out[n + i] = without_logarithms(model->dag, a->factor[i], nh_model_gamma(model, a->factor[i]));
    }
    out[2 * n] = kappa;
    memcpy(in, model->chart->symbol, model->width * sizeof *in);
    if (unknowns) memcpy(in + model->width, unknown, unknowns * sizeof *in);
    nh_tape *tape = nh_tape_create(model->dag, model->width + unknowns, in, 2 * n + 1, out, model->system->parameters,
                                   model->parameter, model->parameter_value);
    nh_free(in);
    nh_free(out);
    return tape;
}

/* The same beyond the chart, where (q', w') are values: f' = f_t + f_q q' + f_w w'. */
static nh_tape *beyond_tape(const nh_model *model, const nh_ansatz *a, size_t unknowns, const nh_ex *unknown)
{
    nh_dag *d = model->dag;
    size_t n = a->factors, moving = model->m + model->n, width = model->width + moving;
    nh_ex *out = nh_alloc_array(2 * n + 1, sizeof *out), *in = nh_alloc_array(width + unknowns, sizeof *in);
    memcpy(in, model->chart->symbol, model->width * sizeof *in);
    for (size_t i = 0; i < moving; i++) in[model->width + i] = nh_symbol_fresh(d, "rate");
    if (unknowns) memcpy(in + width, unknown, unknowns * sizeof *in);
    for (size_t i = 0; i < n; i++) {
        nh_ex rate = nh_add(d, nh_diff(d, a->factor[i], in[0]),
                            nh_diff_along(d, a->factor[i], moving, in + 1, in + model->width));
        out[i] = a->factor[i];
        out[n + i] = without_logarithms(d, a->factor[i], rate);
    }
    out[2 * n] = nh_int(d, 0);
    nh_tape *tape = nh_tape_create(d, width + unknowns, in, 2 * n + 1, out, model->system->parameters, model->parameter,
                                   model->parameter_value);
    nh_free(in);
    nh_free(out);
    return tape;
}

/* Tape and scratch for 2 * factors + 1 rows of NH_BATCH values: factors, their rates, kappa. */
static nh_rows *prepare(const nh_model *model, const nh_ansatz *a, nh_ex kappa, size_t unknowns, const nh_ex *unknown)
{
    nh_rows *r = nh_alloc(sizeof *r);
    size_t rows = 2 * a->factors + 1;
    *r = (nh_rows){
        .model = model, .ansatz = a, .tape = factor_tape(model, a, kappa, unknowns, unknown), .unknowns = unknowns};
    r->work = nh_tape_work_create(r->tape);
    r->unknown = nh_alloc_array(unknowns + 1, sizeof *r->unknown);
    if (unknowns) memcpy(r->unknown, unknown, unknowns * sizeof *unknown);
    r->row = nh_alloc_array(rows, sizeof *r->row);
    r->store = nh_alloc_array(rows * NH_BATCH, sizeof *r->store);
    for (size_t i = 0; i < rows; i++) r->row[i] = r->store + i * NH_BATCH;
    r->theta = nh_alloc_array(unknowns * NH_BATCH + 1, sizeof *r->theta);
    r->value = nh_alloc_array(a->columns * NH_BATCH + 1, sizeof *r->value);
    r->rate = nh_alloc_array(a->columns * NH_BATCH + 1, sizeof *r->rate);
    r->in = nh_alloc_array(model->width + model->m + model->n + unknowns, sizeof *r->in);
    return r;
}

nh_rows *nh_rows_create(const nh_model *model, const nh_ansatz *ansatz, size_t unknowns, const nh_ex *unknown)
{
    return prepare(model, ansatz, nh_int(model->dag, 0), unknowns, unknown);
}

void nh_rows_free(nh_rows *r)
{
    if (!r) return;
    nh_tape_work_free(r->work);
    nh_tape_work_free(r->beyond_work);
    nh_tape_free(r->tape);
    nh_tape_free(r->beyond);
    nh_free(r->unknown);
    nh_free(r->row);
    nh_free(r->store);
    nh_free(r->theta);
    nh_free(r->value);
    nh_free(r->rate);
    nh_free(r->in);
    nh_free(r);
}

/* One column by Leibniz' rule: value = prod f_i, rate = sum_i g_i prod_(j != i) f_j. */
static void leibniz(const nh_column *c, size_t count, double *const *f, double *const *g, double *value, double *rate)
{
    for (size_t p = 0; p < count; p++) {
        value[p] = 1;
        rate[p] = 0;
    }
    for (size_t i = 0; i < c->count; i++) {
        const double *fi = f[c->factor[i]], *gi = g[c->factor[i]];
        for (size_t p = 0; p < count; p++) {
            rate[p] = rate[p] * fi[p] + value[p] * gi[p];
            value[p] *= fi[p];
        }
    }
}

/* Columns' values and rates at points start .. start+count-1, column-major with leading dimension NH_BATCH. */
static size_t run(nh_rows *r, const nh_tape *tape, nh_tape_work *work, const nh_points *points, size_t start)
{
    const nh_ansatz *a = r->ansatz;
    size_t left = points->count - start, count = left < NH_BATCH ? left : NH_BATCH;
    for (size_t j = 0; j < points->width; j++) r->in[j] = points->column[j] + start;
    for (size_t j = 0; j < r->unknowns; j++) r->in[points->width + j] = r->theta + j * NH_BATCH;
    nh_work_add(NH_WORK_VALUE, (double)count * (double)(nh_tape_length(tape) + a->columns));
    nh_tape_eval_batch(tape, work, count, r->in, r->row);
    for (size_t j = 0; j < a->columns; j++)
        leibniz(&a->column[j], count, r->row, r->row + a->factors, r->value + j * NH_BATCH, r->rate + j * NH_BATCH);
    return count;
}

/* Rates at the points beyond the chart; points at which a factor of the ansatz is undefined are left out. */
static size_t run_beyond(nh_rows *r, const nh_points *points, size_t start)
{
    if (!r->beyond) {
        r->beyond = beyond_tape(r->model, r->ansatz, r->unknowns, r->unknown);
        r->beyond_work = nh_tape_work_create(r->beyond);
    }
    size_t count = run(r, r->beyond, r->beyond_work, points, start), columns = r->ansatz->columns;
    for (size_t p = 0; p < count; p++) {
        bool good = true;
        for (size_t j = 0; j < columns; j++) good &= isfinite(r->rate[j * NH_BATCH + p]) != 0;
        for (size_t j = 0; j < columns; j++) r->rate[j * NH_BATCH + p] *= good ? points->weight[start + p] : 0;
        for (size_t j = 0; j < columns && !good; j++) r->rate[j * NH_BATCH + p] = 0;
    }
    return count;
}

void nh_rows_current(nh_rows *r, const nh_points *points, const double *theta, nh_equations *equations)
{
    const nh_points *beyond = points->beyond;
    for (size_t j = 0; j < r->unknowns; j++)
        for (size_t p = 0; p < NH_BATCH; p++) r->theta[j * NH_BATCH + p] = theta[j];
    for (size_t start = 0; start < points->count && !nh_late(); start += NH_BATCH) {
        size_t count = run(r, r->tape, r->work, points, start);
        for (size_t j = 0; j < r->ansatz->columns; j++)
            for (size_t p = 0; p < count; p++) r->rate[j * NH_BATCH + p] *= points->weight[start + p];
        nh_equations_add(equations, count, r->rate, NH_BATCH);
        nh_equations_add_values(equations, count, r->value, NH_BATCH);
    }
    for (size_t start = 0; beyond && start < beyond->count && !nh_late(); start += NH_BATCH)
        nh_equations_add(equations, run_beyond(r, beyond, start), r->rate, NH_BATCH);
}

/* w Gamma(b_j) and w kappa b_j, or b_j alone, of every column at every point of the chart, into arrays of leading
   dimension ld. */
static void whole(nh_rows *r, bool weigh, const nh_points *points, size_t ld, double *A, double *B)
{
    const nh_ansatz *a = r->ansatz;
    const double *k = r->row[2 * a->factors];
    for (size_t start = 0; start < points->count; start += NH_BATCH) {
        size_t count = run(r, r->tape, r->work, points, start);
        for (size_t j = 0; j < a->columns; j++)
            for (size_t p = 0; p < count; p++) {
                double w = points->weight[start + p], unit = weigh ? w * k[p] : 1;
                A[j * ld + start + p] = w * r->rate[j * NH_BATCH + p];
                B[j * points->count + start + p] = unit * r->value[j * NH_BATCH + p];
            }
    }
}

void nh_rows_pencil(const nh_model *model, const nh_ansatz *a, nh_ex kappa, const nh_points *points, double *A,
                    double *B)
{
    nh_rows *r = prepare(model, a, kappa, 0, NULL);
    whole(r, true, points, points->count, A, B);
    nh_rows_free(r);
}

void nh_rows_all(const nh_model *model, const nh_ansatz *a, const nh_points *points, double *A, double *B)
{
    const nh_points *beyond = points->beyond;
    size_t ld = nh_points_equations(points);
    nh_rows *r = nh_rows_create(model, a, 0, NULL);
    whole(r, false, points, ld, A, B);
    for (size_t start = 0; beyond && start < beyond->count; start += NH_BATCH) {
        size_t count = run_beyond(r, beyond, start);
        for (size_t j = 0; j < a->columns; j++)
            memcpy(A + j * ld + points->count + start, r->rate + j * NH_BATCH, count * sizeof *A);
    }
    nh_rows_free(r);
}

/* ---- symmetry route ---- */

static void add_column(nh_field_column *list, size_t *count, size_t slot, nh_ex e, nh_dag *dag)
{
    if (nh_is_zero(dag, e)) return;
    if (nh_kind_of(dag, e) == NH_PRODUCT) { /* a numeric factor makes no new column */
        nh_num c = nh_constant_of(dag, e);
        if (!nh_num_is(c, 1)) e = nh_mul(dag, e, nh_number(dag, nh_num_inv(c)));
    }
    if (nh_kind_of(dag, e) == NH_NUMBER) {
        if (slot == 0) return; /* z0 = const is the trivial current */
        e = nh_int(dag, 1);
    }
    for (size_t i = 0; i < *count; i++)
        if (list[i].slot == slot && list[i].function == e) return;
    list[(*count)++] = (nh_field_column){slot, e};
}

size_t nh_rows_field_columns(const nh_model *model, size_t n, const nh_ex *b, nh_field_column **out)
{
    nh_dag *d = model->dag;
    nh_field_column *list = nh_arena_alloc(model->arena, (n * (model->n + 1) + 1) * sizeof *list);
    nh_ex *zeta = nh_alloc_array(model->n + 1, sizeof *zeta);
    size_t count = 0;
    for (size_t j = 0; j < n; j++) {
        nh_ex z0 = b[j];
        for (size_t i = 0; i < model->n; i++) zeta[i] = nh_model_Y(model, i, b[j]);
        nh_lu_solve(model->M_lu, zeta, zeta);
        for (size_t i = 0; i < model->n; i++) {
            zeta[i] = nh_simplify_short(d, zeta[i], 0);
            z0 = nh_sub(d, z0, nh_mul(d, model->pbar[i], zeta[i]));
            add_column(list, &count, i + 1, zeta[i], d);
        }
        add_column(list, &count, 0, nh_simplify_short(d, z0, 0), d);
    }
    nh_free(zeta);
    *out = list;
    return count;
}

nh_ex nh_rows_field_current(const nh_model *model, const nh_field_column *c)
{
    return c->slot == 0 ? c->function : nh_mul(model->dag, model->pbar[c->slot - 1], c->function);
}

/* The variation of the field: its own part of Phi, slot by slot.  (Phi alone would not do: z0 = g and zeta = g/pbar
 * have the same Phi and are different fields.) Centred per slot, so that Phi = const is trivial. */
static void field_values(size_t n, const nh_field_column *column, size_t slot, size_t per, size_t count,
                         const double *value, double *block)
{
    memset(block, 0, n * count * sizeof *block);
    for (size_t c = 0; c < n; c++) {
        const double *from = value + c * per * count;
        double mean = 0;
        if (column[c].slot != slot) continue;
        for (size_t p = 0; p < count; p++) mean += from[p] / (double)count;
        for (size_t p = 0; p < count; p++) block[c * count + p] = from[p] - mean;
    }
}

void nh_rows_symmetry(const nh_model *model, size_t n, const nh_field_column *column, const nh_points *points,
                      nh_equations *equations)
{
    nh_dag *d = model->dag;
    size_t per = model->n + 2; /* Phi, (N0), (NY)_1..n */
    nh_ex *e = nh_alloc_array(n * per + 1, sizeof *e);
    for (size_t c = 0; c < n; c++) {
        nh_ex phi = nh_rows_field_current(model, &column[c]), n0 = nh_model_X0(model, phi);
        size_t i = column[c].slot - 1;
        bool zeta = column[c].slot > 0;
        if (zeta) n0 = nh_add(d, n0, nh_mul(d, model->A[i], column[c].function));
        e[c * per] = phi;
        e[c * per + 1] = without_logarithms(d, phi, n0);
        for (size_t j = 0; j < model->n; j++) {
            nh_ex ny = nh_model_Y(model, j, phi);
            if (zeta) ny = nh_sub(d, ny, nh_mul(d, model->M[i * model->n + j], column[c].function));
            e[c * per + 2 + j] = without_logarithms(d, phi, ny);
        }
    }
    double *value = nh_alloc_array(n * per * points->count + 1, sizeof *value);
    nh_points_evaluate(points, model, n * per, e, value);
    double *block = nh_alloc_array(n * points->count + 1, sizeof *block);
    for (size_t q = 1; q < per; q++) {
        for (size_t c = 0; c < n; c++) {
            const double *from = value + (c * per + q) * points->count;
            for (size_t p = 0; p < points->count; p++) block[c * points->count + p] = points->weight[p] * from[p];
        }
        nh_equations_add(equations, points->count, block, points->count);
    }
    for (size_t slot = 0; slot <= model->n; slot++) {
        field_values(n, column, slot, per, points->count, value, block);
        nh_equations_add_values(equations, points->count, block, points->count);
    }
    nh_free(block);
    nh_free(value);
    nh_free(e);
}
