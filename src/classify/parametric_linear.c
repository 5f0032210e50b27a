/* The equations of a linear family: their coefficients as series at a point, and the linear system for Taylor
 * coefficients of the solutions. */
#include <string.h>

#include "base/progress.h"
#include "classify/parametric_internal.h"
#include "exact/normal.h"

enum { largest_form = 2000 };

static size_t equations(const nh_parametric *f)
{
    const nh_linear_family *l = f->linear;
    return l->equations[l->levels - 1];
}

static size_t entries(const nh_parametric *f)
{
    return equations(f) * f->linear->unknowns * (nh_parametric_kept(f) + 1);
}

size_t nh_parametric_linear_length(const nh_parametric *f, const nh_jet_ring *r) { return (1 + entries(f)) * r->size; }

/* ---- expressions ---- */

/* The family's equations take the place of the equations of motion, which are open already. */
void nh_parametric_linear_open(nh_parametric *f)
{
    nh_jet_equations *x = f->counter.equations;
    const nh_linear_family *l = f->linear;
    f->kept = l->variables;
    size_t count = entries(f);
    f->entry = nh_alloc_array(count + l->n * l->n + 1, sizeof *f->entry);
    bool good = true;
    for (size_t i = 0; i < count + l->n * l->n && good; i++) {
        f->entry[i] = nh_canonical(x->dag, i < count ? l->coefficient[i] : l->mass[i - count], largest_form);
        good = nh_jet_point_register(x->point, 1, &f->entry[i]);
    }
    if (!good) f->obstacle = x->point->obstacle;
    else if (!nh_parametric_depends(f, count, f->entry))
        f->obstacle = "the equations of this question do not depend on the parameter";
    for (size_t i = 0; i < x->point->kernels && !f->obstacle; i++)
        if (nh_parametric_depends(f, 1, &x->point->kernel[i].key))
            f->obstacle = "the parameter occurs inside of a function or a root";
    if (f->obstacle) return;
    nh_parametric_denominators(f, count, f->entry, f->of_rest);
    nh_parametric_denominators(f, l->n * l->n, f->entry + count, f->of_mass);
}

/* The variables at their point, everything else at residues. */
static nh_jet_eval *evaluator(nh_parametric *f, const nh_jet_ring *r)
{
    nh_jet_equations *x = f->counter.equations;
    const nh_linear_family *l = f->linear;
    nh_residue *q = nh_alloc_array(x->coordinates * r->size + 1, sizeof *q);
    for (size_t k = 0; k < x->coordinates; k++) q[k * r->size] = x->at[k];
    nh_jet_eval *v = nh_jet_equations_eval(x, r, q);
    uint64_t random = x->point->random + 4321;
    for (size_t k = 0; k < l->variables; k++) {
        memset(q, 0, r->size * sizeof *q);
        q[0] = nh_residue_random(r->field, &random);
        q[r->up[k * r->size]] = 1;
        nh_jet_eval_set(v, l->variable[k], q, false);
    }
    nh_free(q);
    return v;
}

/* The common denominator of the coefficients goes to `clear`; its product with det M, without denominators, to Q. */
static bool multipliers(nh_parametric *f, nh_jet_eval *v, const nh_jet_ring *r, nh_residue *clear, nh_residue *Q)
{
    size_t n = f->linear->n, e = r->size;
    nh_residue *M = nh_alloc_array((n * n + 2) * e, sizeof *M), *value = M + n * n * e, *work = value + e;
    bool good = nh_jet_eval_all(v, n * n, f->entry + entries(f), M);
    nh_jet_constant(r, 1, clear);
    if (good) nh_parametric_determinant(r, n, M, Q);
    for (size_t i = 0; i < f->factors && good; i++) {
        good = nh_jet_eval_all(v, 1, &f->factor[i], value);
        for (size_t k = 0; k < f->of_rest[i] && good; k++) nh_parametric_times(r, clear, value, work);
        for (size_t k = 0; k < f->of_mass[i] * n + f->of_rest[i] && good; k++) nh_parametric_times(r, Q, value, work);
    }
    nh_free(M);
    return good;
}

bool nh_parametric_linear_multiplier(nh_parametric *f, const nh_jet_ring *r, nh_residue *out)
{
    nh_residue *clear = nh_alloc_array(r->size, sizeof *clear);
    nh_jet_eval *v = evaluator(f, r);
    bool good = multipliers(f, v, r, clear, out);
    nh_jet_eval_free(v);
    nh_free(clear);
    return good;
}

static bool expressions(nh_parametric *f, const nh_jet_ring *r, nh_residue *out)
{
    size_t count = entries(f), e = r->size;
    nh_residue *clear = nh_alloc_array(2 * e, sizeof *clear);
    nh_jet_eval *v = evaluator(f, r);
    bool good = multipliers(f, v, r, clear, out) && out[0] && nh_jet_eval_all(v, count, f->entry, out + e);
    for (size_t i = 1; i <= count && good; i++)
        if (!nh_jet_is_zero(r, out + i * e)) nh_parametric_times(r, out + i * e, clear, clear + e);
    nh_jet_eval_free(v);
    nh_free(clear);
    return good;
}

/* ---- the density of a measure ---- */

/* d (c w^a w^b)/d w^l summed over l: what the quadratic monomials of the rate of w^l give to the row of w^i. */
static void add_quadratic(const nh_jet_ring *r, size_t n, size_t l, const nh_residue *monomial, nh_residue *divergence)
{
    for (size_t a = 0; a < n; a++)
        for (size_t b = a; b < n; b++, monomial += r->size) {
            if (a == l) nh_jet_add_multiple(r, divergence + b * r->size, 1, monomial);
            if (b == l) nh_jet_add_multiple(r, divergence + a * r->size, 1, monomial);
        }
}

/* The equations of a density u as (fields + 1) rows: G_i(u) + (div G)_i u, and the divergence without velocities. */
static bool density(nh_parametric *f, nh_parametric_series *s, nh_residue *out)
{
    const nh_jet_equations *x = f->counter.equations;
    const nh_jet_ring *r = s->ring;
    size_t n = x->n, kept = nh_parametric_kept(f), e = r->size, count = nh_jet_equations_monomials(n);
    size_t motion = (1 + x->fields * kept + n * count) * e;
    nh_residue *G = nh_alloc_array(motion + (n + 2) * e, sizeof *G), *rate = G + (1 + x->fields * kept) * e;
    nh_residue *divergence = G + motion, *work = divergence + (n + 1) * e;
    bool good = nh_parametric_motion(f, r, s->coordinate, G);
    memset(out, 0, s->length * sizeof *out);
    memcpy(out, G, e * sizeof *out);
    for (size_t l = 0; l < n && good; l++) {
        add_quadratic(r, n, l, rate + (l * count + 1 + n) * e, divergence);
        nh_jet_add_multiple(r, divergence + n * e, 1, rate + (l * count + 1 + l) * e);
    }
    for (size_t i = 0; i <= n && good; i++) {
        nh_residue *row = out + e + i * (kept + 1) * e;
        memcpy(row + kept * e, divergence + i * e, e * sizeof *row);
        for (size_t k = 0; k < kept && i < x->fields; k++) {
            memcpy(row + k * e, G + (1 + i * kept + k) * e, e * sizeof *row);
            nh_jet_derivative(r, row + k * e, k, work);
            nh_jet_add_multiple(r, row + kept * e, 1, work);
        }
    }
    nh_free(G);
    return good;
}

bool nh_parametric_linear_value(nh_parametric *f, nh_parametric_series *s, nh_residue *out)
{
    if (!f->linear->coefficient) return density(f, s, out);
    nh_parametric_set(f);
    f->counter.work += (double)s->ring->pairs[s->ring->size] * (double)entries(f);
    return expressions(f, s->ring, out);
}

/* ---- the linear system ---- */

/* Which Taylor coefficients of each function are unknown: where no derivative occurs, those of the highest order are in
 * no equation. */
typedef struct {
    const nh_jet_ring *r;
    size_t kept, unknowns, rows, columns;
} layout;

static bool has_derivatives(const nh_parametric_series *s, const layout *y, size_t equations)
{
    size_t e = s->ring->size, D = (s->degree + 1) * (s->second + 1);
    for (size_t j = 0; j < D; j++)
        for (size_t i = 0; i < equations * y->unknowns * (y->kept + 1); i++)
            if (i % (y->kept + 1) < y->kept && !nh_jet_is_zero(s->ring, s->coefficient + j * s->length + (1 + i) * e))
                return true;
    return false;
}

static layout layout_of(const nh_parametric *f, const nh_parametric_series *s, size_t level)
{
    layout y = {.r = s->ring, .kept = nh_parametric_kept(f), .unknowns = f->linear->unknowns};
    size_t equations = f->linear->equations[level - 1], order = s->ring->order;
    y.rows = equations * s->ring->first[order];
    y.columns = has_derivatives(s, &y, equations) ? s->ring->size : s->ring->first[order];
    return y;
}

/* The entries that a series in front of d_k u_a contributes (k = kept: in front of u_a); each goes to `put`. */
typedef void entry_function(void *to, size_t row, size_t column, nh_residue value);

static void add_series(const layout *y, size_t equation, size_t unknown, size_t k, const nh_residue *series,
                       entry_function *put, void *to)
{
    const nh_jet_ring *r = y->r;
    size_t rows = r->first[r->order];
    if (nh_jet_is_zero(r, series)) return;
    for (size_t e = 0; e < rows; e++)
        for (size_t z = r->pairs[e]; z < r->pairs[e + 1]; z++) {
            size_t u = k < y->kept ? r->up[k * r->size + r->right[z]] : r->right[z];
            if (!series[r->left[z]] || u == UINT32_MAX) continue;
            nh_residue v = series[r->left[z]];
            if (k < y->kept) v = nh_residue_mul(r->field, v, (nh_residue)r->exponent[u * r->variables + k]);
            if (v) put(to, equation * rows + e, unknown * y->columns + u, v);
        }
}

static void add_all(const layout *y, size_t equations, const nh_residue *series, entry_function *put, void *to)
{
    for (size_t e = 0; e < equations && !nh_late(); e++)
        for (size_t a = 0; a < y->unknowns; a++)
            for (size_t k = 0; k <= y->kept; k++, series += y->r->size) add_series(y, e, a, k, series, put, to);
}

/* ---- for every value ---- */

typedef struct {
    nh_sparse_pencil *out;
    size_t power;
} target;

static void put_entry(void *to, size_t row, size_t column, nh_residue value)
{
    target *t = to;
    nh_sparse_pencil *p = t->out;
    nh_grow(&p->entry, &p->capacity, p->entries + 1, sizeof *p->entry);
    p->entry[p->entries++] = (nh_sparse_entry){(uint32_t)row, (uint32_t)column, (uint32_t)t->power, value};
}

bool nh_parametric_linear_pencil(const nh_parametric *f, const nh_parametric_series *s, size_t level, size_t most,
                                 nh_sparse_pencil *out)
{
    layout y = layout_of(f, s, level);
    *out =
        (nh_sparse_pencil){.rows = y.rows, .columns = y.unknowns * y.columns, .degree = s->degree, .second = s->second};
    if (out->columns > most) return false;
    for (size_t j = 0; j < (s->degree + 1) * (s->second + 1); j++) {
        target t = {out, j};
        add_all(&y, f->linear->equations[level - 1], s->coefficient + j * s->length + s->ring->size, put_entry, &t);
    }
    return !nh_late();
}

/* ---- at one value ---- */

/* The rank of a matrix without parameters, restricted to the columns of Taylor coefficients of order above s. */
static size_t rank_of(const nh_sparse_pencil *p, const layout *y, size_t low, double most, bool *good)
{
    nh_sparse_pencil part = *p;
    part.entry = nh_alloc_array(p->entries + 1, sizeof *part.entry);
    part.entries = 0;
    for (size_t k = 0; k < p->entries; k++)
        if (p->entry[k].column % y->columns >= low) part.entry[part.entries++] = p->entry[k];
    nh_sparse_pencil rest = nh_sparse_pencil_reduce(&part, y->r->field);
    double columns = (double)rest.columns, rows = (double)rest.rows;
    *good = rows * columns * (rows < columns ? rows : columns) <= most && !nh_late();
    size_t rank = rest.pivots + (*good ? nh_staircase_rank(&rest, y->r->field, 1) : 0);
    nh_free(rest.entry);
    nh_free(part.entry);
    return rank;
}

bool nh_parametric_linear_dimension(const nh_parametric *f, const nh_parametric_series *s, const nh_residue *values,
                                    size_t level, double most, size_t *out)
{
    layout y = layout_of(f, s, level);
    size_t order = f->linear->low < s->ring->order ? f->linear->low : s->ring->order - 1;
    size_t low = s->ring->first[order + 1];
    nh_sparse_pencil p = {.rows = y.rows, .columns = y.unknowns * y.columns};
    target t = {&p, 0};
    bool good = false, all_good = false;
    add_all(&y, f->linear->equations[level - 1], values + s->ring->size, put_entry, &t);
    size_t high = rank_of(&p, &y, low, most, &good), all = good ? rank_of(&p, &y, 0, most, &all_good) : 0;
    *out = y.unknowns * low + high - all;
    nh_free(p.entry);
    return all_good;
}
