/* Sparse elimination of a pencil with pivots that keep it linear in the parameter. */
#include "classify/staircase.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"

enum { least_cost = 4, largest_cost = 4096 };

/* A term is a column and its coefficients: the constant one, then those of the other powers, `slopes`. */
typedef struct {
    size_t count, capacity, slopes; /* slopes: of its terms that depend on the parameters */
    uint32_t *term;
} sparse_row;

typedef struct {
    /* number of rows that have a term in this column, and of those whose term depends on the parameters */
    size_t count, slopes;
    size_t rows, capacity; /* the list may hold rows that have no term here any more */
    uint32_t *row;
} sparse_column;

typedef struct {
    nh_prime f;
    size_t rows, columns, powers, stride; /* length of a term: 1 + powers */
    sparse_row *row;
    sparse_column *column;
    sparse_row work;
} sparse;

static uint32_t *at(const sparse *s, const sparse_row *r, size_t k) { return r->term + k * s->stride; }

static bool moves(const sparse *s, const uint32_t *t)
{
    bool any = false;
    for (size_t k = 1; k < s->powers; k++) any |= t[1 + k] != 0;
    return any;
}

/* ---- in ---- */

static int by_place(const void *a, const void *b)
{
    const nh_sparse_entry *x = a, *y = b;
    if (x->row != y->row) return x->row < y->row ? -1 : 1;
    return (x->column > y->column) - (x->column < y->column);
}

/* Writes every entry with power 0 or 1, and adds the rows y_i - lambda y_(i-1). */
static size_t linear_entries(const nh_sparse_pencil *p, nh_prime f, nh_sparse_entry **out)
{
    size_t D = p->degree ? p->degree : 1, count = 0;
    nh_sparse_entry *e = nh_alloc_array(p->entries + 2 * (D - 1) * p->columns + 1, sizeof *e);
    for (size_t k = 0; k < p->entries; k++) {
        const nh_sparse_entry *x = &p->entry[k];
        bool top = x->power == D;
        e[count++] = (nh_sparse_entry){x->row, (uint32_t)((x->power - top) * p->columns + x->column), top, x->value};
    }
    for (size_t i = 1; i < D; i++)
        for (size_t c = 0; c < p->columns; c++) {
            uint32_t row = (uint32_t)(p->rows + (i - 1) * p->columns + c);
            e[count++] = (nh_sparse_entry){row, (uint32_t)(i * p->columns + c), 0, 1};
            e[count++] = (nh_sparse_entry){row, (uint32_t)((i - 1) * p->columns + c), 1, (nh_residue)(f.p - 1)};
        }
    qsort(e, count, sizeof *e, by_place);
    *out = e;
    return count;
}

static size_t sorted_entries(const nh_sparse_pencil *p, nh_sparse_entry **out)
{
    *out = nh_alloc_array(p->entries + 1, sizeof **out);
    memcpy(*out, p->entry, p->entries * sizeof **out);
    qsort(*out, p->entries, sizeof **out, by_place);
    return p->entries;
}

static void enter_column(sparse *s, uint32_t row, const uint32_t *t)
{
    sparse_column *c = &s->column[t[0]];
    nh_grow(&c->row, &c->capacity, c->rows + 1, sizeof *c->row);
    c->row[c->rows++] = row;
    c->count++;
    c->slopes += moves(s, t);
}

static void leave_column(sparse *s, const uint32_t *t)
{
    s->column[t[0]].count--;
    s->column[t[0]].slopes -= moves(s, t);
}

/* Makes room for one more term, which is counted later, when it is known to be nonzero. */
static uint32_t *next(const sparse *s, sparse_row *r)
{
    nh_grow(&r->term, &r->capacity, (r->count + 1) * s->stride, sizeof *r->term);
    return at(s, r, r->count);
}

static bool push(const sparse *s, sparse_row *r)
{
    const uint32_t *t = at(s, r, r->count);
    bool slope = moves(s, t), any = slope || t[1];
    r->count += any;
    r->slopes += slope;
    return any;
}

/* The entries in rows, added up where they share a place, and the lists of the columns. */
static void open_sparse(sparse *s, const nh_sparse_pencil *p, nh_prime f)
{
    nh_sparse_entry *e;
    bool one = p->second == 0;
    size_t D = one && p->degree ? p->degree : 1, count = one ? linear_entries(p, f, &e) : sorted_entries(p, &e);
    *s = (sparse){.f = f,
                  .rows = p->rows + (D - 1) * p->columns,
                  .columns = D * p->columns,
                  .powers = one ? 2 : (p->degree + 1) * (p->second + 1)};
    s->stride = 1 + s->powers;
    s->row = nh_alloc_array(s->rows + 1, sizeof *s->row);
    s->column = nh_alloc_array(s->columns + 1, sizeof *s->column);
    for (size_t k = 0; k < count;) {
        size_t first = k;
        uint32_t *t = next(s, &s->row[e[first].row]);
        memset(t, 0, s->stride * sizeof *t);
        t[0] = e[first].column;
        for (; k < count && by_place(&e[first], &e[k]) == 0; k++)
            t[1 + e[k].power] = nh_residue_add(f, t[1 + e[k].power], e[k].value);
        push(s, &s->row[e[first].row]);
    }
    for (size_t i = 0; i < s->rows; i++)
        for (size_t k = 0; k < s->row[i].count; k++) enter_column(s, (uint32_t)i, at(s, &s->row[i], k));
    nh_free(e);
}

static void close_sparse(sparse *s)
{
    for (size_t i = 0; i < s->rows; i++) nh_free(s->row[i].term);
    for (size_t j = 0; j < s->columns; j++) nh_free(s->column[j].row);
    nh_free(s->work.term);
    nh_free(s->row);
    nh_free(s->column);
}

/* ---- elimination ---- */

static const uint32_t *term_at(const sparse *s, const sparse_row *r, uint32_t column)
{
    size_t low = 0, high = r->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (*at(s, r, middle) < column) low = middle + 1;
        else high = middle;
    }
    return low < r->count && *at(s, r, low) == column ? at(s, r, low) : NULL;
}

/* t -= factor times the term x of the pivot row; one of the two does not depend on the parameters. */
static void subtract_term(const sparse *s, uint32_t *t, const nh_residue *factor, const uint32_t *x)
{
    nh_prime f = s->f;
    for (size_t k = 1; k < s->powers; k++) {
        nh_residue both = nh_residue_add(f, nh_residue_mul(f, factor[0], x[1 + k]), nh_residue_mul(f, factor[k], x[1]));
        t[1 + k] = nh_residue_sub(f, t[1 + k], both);
    }
    t[1] = nh_residue_sub(f, t[1], nh_residue_mul(f, factor[0], x[1]));
}

/* row -= factor times the pivot row, without the pivot's column. */
static void subtract(sparse *s, uint32_t index, const sparse_row *p, uint32_t column, const nh_residue *factor)
{
    sparse_row *r = &s->row[index], *w = &s->work;
    size_t i = 0, j = 0;
    w->count = w->slopes = 0;
    while (i < r->count || j < p->count) {
        const uint32_t *a = i < r->count ? at(s, r, i) : NULL, *b = j < p->count ? at(s, p, j) : NULL;
        bool left = a && (!b || a[0] <= b[0]), right = b && (!a || b[0] <= a[0]);
        uint32_t *t = next(s, w);
        if (left) memcpy(t, a, s->stride * sizeof *t);
        else memset(t, 0, s->stride * sizeof *t), t[0] = b[0];
        if (right) subtract_term(s, t, factor, b);
        if (t[0] != column) {
            if (left) leave_column(s, a);
            bool there = push(s, w);
            if (there && !left) enter_column(s, index, t);
            else if (there) s->column[t[0]].count++, s->column[t[0]].slopes += moves(s, t);
        }
        i += left;
        j += right;
    }
    sparse_row old = *r;
    *r = *w;
    *w = old;
}

/* Eliminates the column from all other rows by the pivot at (index, column); row and column leave the system. */
static void eliminate(sparse *s, uint32_t index, uint32_t column)
{
    sparse_row p = s->row[index];
    sparse_column c = s->column[column];
    s->row[index] = (sparse_row){0};
    s->column[column] = (sparse_column){0};
    for (size_t k = 0; k < p.count; k++)
        if (*at(s, &p, k) != column) leave_column(s, at(s, &p, k));
    nh_residue inverse = nh_residue_inverse(s->f, term_at(s, &p, column)[1]);
    nh_residue *factor = nh_alloc_array(s->powers, sizeof *factor);
    for (size_t k = 0; k < c.rows; k++) {
        const uint32_t *t = term_at(s, &s->row[c.row[k]], column);
        if (!t) continue;
        for (size_t i = 0; i < s->powers; i++) factor[i] = nh_residue_mul(s->f, t[1 + i], inverse);
        subtract(s, c.row[k], &p, column, factor);
    }
    nh_free(factor);
    nh_free(p.term);
    nh_free(c.row);
}

/* The column of the cheapest pivot of a row; SIZE_MAX: none is as cheap as allowed. */
static size_t pivot_of(const sparse *s, const sparse_row *r, size_t most)
{
    size_t best = SIZE_MAX;
    for (size_t k = 0; k < r->count; k++) {
        const uint32_t *t = at(s, r, k);
        const sparse_column *c = &s->column[t[0]];
        size_t cost = (r->count - 1) * (c->count - 1);
        if (!t[1] || moves(s, t) || (r->slopes && c->slopes) || cost > most) continue;
        best = t[0];
        most = cost;
    }
    return best;
}

/* Eliminates; returns the number of pivots. */
static size_t eliminate_all(sparse *s)
{
    size_t pivots = 0;
    for (size_t cost = least_cost; cost <= largest_cost && !nh_late(); cost *= 4)
        for (bool found = true; found && !nh_late();) {
            found = false;
            for (size_t i = 0; i < s->rows; i++) {
                size_t column = pivot_of(s, &s->row[i], cost);
                if (column == SIZE_MAX) continue;
                eliminate(s, (uint32_t)i, (uint32_t)column);
                found = true;
                pivots++;
            }
        }
    return pivots;
}

/* ---- out ---- */

nh_sparse_pencil nh_sparse_pencil_reduce(const nh_sparse_pencil *p, nh_prime f)
{
    sparse s;
    open_sparse(&s, p, f);
    nh_sparse_pencil out = {.degree = p->second ? p->degree : 1, .second = p->second};
    out.pivots = eliminate_all(&s);
    uint32_t *to = nh_alloc_array(s.columns + 1, sizeof *to);
    for (size_t j = 0; j < s.columns; j++) { /* columns without rows are free for every value and do not matter */
        to[j] = (uint32_t)out.columns;
        out.columns += s.column[j].count > 0;
    }
    for (size_t i = 0; i < s.rows; i++) {
        for (size_t k = 0; k < s.row[i].count; k++) {
            const uint32_t *t = at(&s, &s.row[i], k);
            for (uint32_t power = 0; power < s.powers; power++) {
                if (!t[1 + power]) continue;
                nh_grow(&out.entry, &out.capacity, out.entries + 1, sizeof *out.entry);
                out.entry[out.entries++] = (nh_sparse_entry){(uint32_t)out.rows, to[t[0]], power, t[1 + power]};
            }
        }
        out.rows += s.row[i].count > 0;
    }
    nh_free(to);
    close_sparse(&s);
    return out;
}
