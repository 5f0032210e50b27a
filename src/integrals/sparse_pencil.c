/* Sparse elimination of a pencil with pivots that keep it linear in the parameter. */
#include "integrals/sparse_pencil.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"

enum { least_cost = 4, largest_cost = 4096 };

/* constant + lambda slope, in a column */
typedef struct {
    uint32_t column;
    nh_residue constant, slope;
} term;

typedef struct {
    size_t count, capacity, slopes; /* slopes: of its terms that have one */
    term *term;
} sparse_row;

typedef struct {
    size_t count, slopes;    /* rows with a term here; with a slope */
    size_t rows, capacity;   /* the list may hold rows that have no term here any more */
    uint32_t *row;
} sparse_column;

typedef struct {
    nh_prime f;
    size_t rows, columns;
    sparse_row *row;
    sparse_column *column;
    sparse_row work;
} sparse;

/* ---- in ---- */

static int by_place(const void *a, const void *b)
{
    const nh_sparse_entry *x = a, *y = b;
    if (x->row != y->row) return x->row < y->row ? -1 : 1;
    return (x->column > y->column) - (x->column < y->column);
}

/* Every entry as one of power 0 or 1, and the rows  y_i - lambda y_(i-1). */
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

static void enter_column(sparse *s, uint32_t row, const term *t)
{
    sparse_column *c = &s->column[t->column];
    nh_grow(&c->row, &c->capacity, c->rows + 1, sizeof *c->row);
    c->row[c->rows++] = row;
    c->count++;
    c->slopes += t->slope != 0;
}

static void leave_column(sparse *s, const term *t)
{
    s->column[t->column].count--;
    s->column[t->column].slopes -= t->slope != 0;
}

static void push(sparse_row *r, uint32_t column, nh_residue constant, nh_residue slope)
{
    if (!constant && !slope) return;
    nh_grow(&r->term, &r->capacity, r->count + 1, sizeof *r->term);
    r->term[r->count++] = (term){column, constant, slope};
    r->slopes += slope != 0;
}

static void open_sparse(sparse *s, const nh_sparse_pencil *p, nh_prime f)
{
    nh_sparse_entry *e;
    size_t D = p->degree ? p->degree : 1, count = linear_entries(p, f, &e);
    *s = (sparse){.f = f, .rows = p->rows + (D - 1) * p->columns, .columns = D * p->columns};
    s->row = nh_alloc_array(s->rows + 1, sizeof *s->row);
    s->column = nh_alloc_array(s->columns + 1, sizeof *s->column);
    for (size_t k = 0; k < count;) {
        nh_residue value[2] = {0, 0};
        size_t first = k;
        for (; k < count && by_place(&e[first], &e[k]) == 0; k++)
            value[e[k].power] = nh_residue_add(f, value[e[k].power], e[k].value);
        push(&s->row[e[first].row], e[first].column, value[0], value[1]);
    }
    for (size_t i = 0; i < s->rows; i++)
        for (size_t k = 0; k < s->row[i].count; k++) enter_column(s, (uint32_t)i, &s->row[i].term[k]);
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

static const term *term_at(const sparse_row *r, uint32_t column)
{
    size_t low = 0, high = r->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (r->term[middle].column < column) low = middle + 1;
        else high = middle;
    }
    return low < r->count && r->term[low].column == column ? &r->term[low] : NULL;
}

/* row -= (constant + lambda slope) times the pivot row, without the pivot's column. */
static void subtract(sparse *s, uint32_t index, const sparse_row *p, uint32_t column, nh_residue constant,
                     nh_residue slope)
{
    sparse_row *r = &s->row[index], *w = &s->work;
    nh_prime f = s->f;
    size_t i = 0, j = 0;
    w->count = w->slopes = 0;
    while (i < r->count || j < p->count) {
        bool left = i < r->count && (j == p->count || r->term[i].column <= p->term[j].column), right = j < p->count
            && (i == r->count || p->term[j].column <= r->term[i].column);
        term t = left ? r->term[i] : (term){p->term[j].column, 0, 0};
        if (right) {
            const term *x = &p->term[j];
            nh_residue both = nh_residue_add(f, nh_residue_mul(f, constant, x->slope),
                                             nh_residue_mul(f, slope, x->constant));
            t.constant = nh_residue_sub(f, t.constant, nh_residue_mul(f, constant, x->constant));
            t.slope = nh_residue_sub(f, t.slope, both);
        }
        if (t.column != column) {
            bool is_new = !left && (t.constant || t.slope);
            if (left) leave_column(s, &r->term[i]);
            if (is_new) enter_column(s, index, &t);
            else if (left && (t.constant || t.slope))
                s->column[t.column].count++, s->column[t.column].slopes += t.slope != 0;
            push(w, t.column, t.constant, t.slope);
        }
        i += left;
        j += right;
    }
    sparse_row old = *r;
    *r = *w;
    *w = old;
}

static void eliminate(sparse *s, uint32_t index, uint32_t column)
{
    sparse_row p = s->row[index];
    sparse_column c = s->column[column];
    s->row[index] = (sparse_row){0};
    s->column[column] = (sparse_column){0};
    for (size_t k = 0; k < p.count; k++)
        if (p.term[k].column != column) leave_column(s, &p.term[k]);
    nh_residue inverse = nh_residue_inverse(s->f, term_at(&p, column)->constant);
    for (size_t k = 0; k < c.rows; k++) {
        const term *t = term_at(&s->row[c.row[k]], column);
        if (t)
            subtract(s, c.row[k], &p, column, nh_residue_mul(s->f, t->constant, inverse),
                     nh_residue_mul(s->f, t->slope, inverse));
    }
    nh_free(p.term);
    nh_free(c.row);
}

/* The cheapest pivot of a row, its column; SIZE_MAX: none costs so little. */
static size_t pivot_of(const sparse *s, const sparse_row *r, size_t most)
{
    size_t best = SIZE_MAX;
    for (size_t k = 0; k < r->count; k++) {
        const term *t = &r->term[k];
        const sparse_column *c = &s->column[t->column];
        size_t cost = (r->count - 1) * (c->count - 1);
        if (!t->constant || t->slope || (r->slopes && c->slopes) || cost > most) continue;
        best = t->column;
        most = cost;
    }
    return best;
}

static void eliminate_all(sparse *s)
{
    for (size_t cost = least_cost; cost <= largest_cost && !nh_late(); cost *= 4)
        for (bool found = true; found && !nh_late();) {
            found = false;
            for (size_t i = 0; i < s->rows; i++) {
                size_t column = pivot_of(s, &s->row[i], cost);
                if (column == SIZE_MAX) continue;
                eliminate(s, (uint32_t)i, (uint32_t)column);
                found = true;
            }
        }
}

/* ---- out ---- */

nh_sparse_pencil nh_sparse_pencil_reduce(const nh_sparse_pencil *p, nh_prime f)
{
    sparse s;
    open_sparse(&s, p, f);
    nh_sparse_pencil out = {.degree = 1};
    eliminate_all(&s);
    uint32_t *to = nh_alloc_array(s.columns + 1, sizeof *to);
    for (size_t j = 0; j < s.columns; j++) { /* columns without rows stay free for every value: they do not matter */
        to[j] = (uint32_t)out.columns;
        out.columns += s.column[j].count > 0;
    }
    for (size_t i = 0; i < s.rows; i++) {
        for (size_t k = 0; k < s.row[i].count; k++) {
            const term *t = &s.row[i].term[k];
            nh_residue value[2] = {t->constant, t->slope};
            for (uint32_t power = 0; power < 2; power++) {
                if (!value[power]) continue;
                nh_grow(&out.entry, &out.capacity, out.entries + 1, sizeof *out.entry);
                out.entry[out.entries++] = (nh_sparse_entry){(uint32_t)out.rows, to[t->column], power, value[power]};
            }
        }
        out.rows += s.row[i].count > 0;
    }
    nh_free(to);
    close_sparse(&s);
    return out;
}
