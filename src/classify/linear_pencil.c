#include "classify/linear_pencil.h"

#include "base/progress.h"

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

bool nh_linear_pencil(const nh_parametric *f, const nh_parametric_series *s, size_t level, size_t most,
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

bool nh_linear_dimension(const nh_parametric *f, const nh_parametric_series *s, const nh_residue *values, size_t level,
                         double most, size_t *out)
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
