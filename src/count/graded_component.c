/* graded_component: Markowitz' order, simplified: the shortest row, and in it the rarest column.
 *
 * Rows are cells sorted by column.  Remaining rows stand in lists by length; a column remembers the rows that have or
 * had it.  The known part of a pivot row is divided by the pivot only at the end (`inverse`). */
#include "count/graded_solver_internal.h"

#include <stdlib.h>
#include <string.h>

#include "base/progress.h"

enum { inverse_work = 40 }; /* an inverse modulo the prime takes as long as this many products */

void nh_graded_component_init(nh_graded_component *c, size_t rows, size_t columns)
{
    *c = (nh_graded_component){0};
    c->cells = nh_alloc_array(rows + 1, sizeof *c->cells);
    c->room = nh_alloc_array(rows + 1, sizeof *c->room);
    c->length = nh_alloc_array(rows + 1, sizeof *c->length);
    c->done = nh_alloc_array(rows + 1, sizeof *c->done);
    c->inverse = nh_alloc_array(rows + 1, sizeof *c->inverse);
    c->count = nh_alloc_array(columns + 1, sizeof *c->count);
    c->pivoted = nh_alloc_array(columns + 1, sizeof *c->pivoted);
    c->member = nh_alloc_array(columns + 1, sizeof *c->member);
    c->pivot_row = nh_alloc_array(columns + 1, sizeof *c->pivot_row);
    c->pivot_column = nh_alloc_array(columns + 1, sizeof *c->pivot_column);
    c->rest.first = nh_alloc_array(columns + 1, sizeof *c->rest.first);
    c->rest.next = nh_alloc_array(rows + 1, sizeof *c->rest.next);
    c->rest.previous = nh_alloc_array(rows + 1, sizeof *c->rest.previous);
}

void nh_graded_component_clear(nh_graded_component *c, size_t rows, size_t columns)
{
    for (size_t i = 0; i < rows; i++) nh_free(c->cells[i]);
    for (size_t j = 0; j < columns; j++) nh_free(c->member[j].item);
    nh_free(c->rest.first);
    nh_free(c->rest.next);
    nh_free(c->rest.previous);
    nh_free(c->spare);
    nh_free(c->cells);
    nh_free(c->room);
    nh_free(c->length);
    nh_free(c->done);
    nh_free(c->inverse);
    nh_free(c->count);
    nh_free(c->pivoted);
    nh_free(c->member);
    nh_free(c->pivot_row);
    nh_free(c->pivot_column);
}

/* ---- the shortest remaining row ---- */

/* Row i into the list of its length; empty rows into none. */
static void list_row(nh_graded_component *c, size_t i)
{
    nh_graded_lengths *l = &c->rest;
    size_t length = c->length[i];
    if (!length) return;
    l->next[i] = l->first[length];
    l->previous[i] = 0;
    if (l->next[i]) l->previous[l->next[i] - 1] = (uint32_t)i + 1;
    l->first[length] = (uint32_t)i + 1;
    if (length < l->least) l->least = length;
}

static void unlist_row(nh_graded_component *c, size_t i)
{
    nh_graded_lengths *l = &c->rest;
    if (l->previous[i]) l->next[l->previous[i] - 1] = l->next[i];
    else l->first[c->length[i]] = l->next[i];
    if (l->next[i]) l->previous[l->next[i] - 1] = l->previous[i];
}

/* SIZE_MAX: no row has entries. */
static size_t shortest_row(nh_graded_component *c)
{
    nh_graded_lengths *l = &c->rest;
    while (l->least <= c->columns && !l->first[l->least]) l->least++;
    return l->least <= c->columns ? l->first[l->least] - 1 : SIZE_MAX;
}

/* ---- elimination ---- */

static void append(nh_graded_row_list *l, size_t x)
{
    if (l->count == l->capacity) nh_grow(&l->item, &l->capacity, l->count + 1, sizeof *l->item);
    l->item[l->count++] = (uint32_t)x;
}

/* to := to + factor * from, both sorted by column */
static void combine(const nh_graded_system *s, nh_graded_component *c, size_t to, size_t from, nh_residue factor)
{
    size_t x = 0, y = 0, n = 0, na = c->length[to], nb = c->length[from];
    nh_grow(&c->spare, &c->spare_room, na + nb, sizeof *c->spare);
    nh_graded_cell *a = c->cells[to], *b = c->cells[from], *out = c->spare;
    while (x < na || y < nb) {
        if (y == nb || (x < na && a[x].column < b[y].column)) {
            out[n++] = a[x++];
        } else if (x == na || b[y].column < a[x].column) {
            out[n++] = (nh_graded_cell){b[y].column, nh_residue_mul(s->f, factor, b[y].value)};
            append(&c->member[b[y].column], to);
            c->count[b[y++].column]++;
        } else {
            nh_residue v = nh_residue_add(s->f, a[x].value, nh_residue_mul(s->f, factor, b[y].value));
            if (v) out[n++] = (nh_graded_cell){a[x].column, v};
            else c->count[a[x].column]--;
            x++, y++;
        }
    }
    size_t room = c->room[to];
    unlist_row(c, to);
    c->room[to] = c->spare_room;
    c->cells[to] = out;
    c->length[to] = n;
    c->spare = a;
    c->spare_room = room;
    list_row(c, to);
    nh_residue_add_multiple(s->f, s->before, s->known + c->equation[to] * s->before,
                            s->known + c->equation[from] * s->before, nh_residue_mul(s->f, factor, c->inverse[from]));
    c->work += (double)(s->before + 8 * n); /* an entry costs more than a product, because its row is made anew */
}

static const nh_graded_cell *find_cell(const nh_graded_component *c, size_t i, size_t column)
{
    size_t low = 0, high = c->length[i];
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (c->cells[i][middle].column < column) low = middle + 1;
        else high = middle;
    }
    return low < c->length[i] && c->cells[i][low].column == column ? &c->cells[i][low] : NULL;
}

/* Divides the row by its entry in the rarest column, its known part not yet, and takes it as a pivot row. */
static void take_pivot(const nh_graded_system *s, nh_graded_component *c, size_t i)
{
    size_t at = 0;
    for (size_t z = 1; z < c->length[i]; z++)
        if (c->count[c->cells[i][z].column] < c->count[c->cells[i][at].column]) at = z;
    size_t column = c->cells[i][at].column;
    nh_residue inverse = c->inverse[i] = nh_residue_inverse(s->f, c->cells[i][at].value);
    for (size_t z = 0; z < c->length[i]; z++) {
        c->cells[i][z].value = nh_residue_mul(s->f, c->cells[i][z].value, inverse);
        c->count[c->cells[i][z].column]--;
    }
    c->work += (double)(c->member[column].count + inverse_work);
    unlist_row(c, i);
    c->done[i] = c->pivoted[column] = true;
    c->pivot_row[c->rank] = i;
    c->pivot_column[c->rank++] = column;
    for (size_t z = 0; z < c->member[column].count && c->count[column]; z++) {
        size_t k = c->member[column].item[z];
        const nh_graded_cell *x = c->done[k] ? NULL : find_cell(c, k, column);
        if (x) combine(s, c, k, i, nh_residue_negative(s->f, x->value));
    }
}

static void eliminate(const nh_graded_system *s, nh_graded_component *c)
{
    for (size_t best; (best = shortest_row(c)) != SIZE_MAX && !nh_late();) take_pivot(s, c, best);
}

/* ---- the rows of a component ---- */

static int by_column(const void *a, const void *b)
{
    uint32_t x = ((const nh_graded_cell *)a)->column, y = ((const nh_graded_cell *)b)->column;
    return (x > y) - (x < y);
}

/* Most rows have a few entries, in order but for some. */
static void sort_cells(size_t n, nh_graded_cell *x)
{
    enum { few = 24 };
    if (n > few) {
        qsort(x, n, sizeof *x, by_column);
        return;
    }
    for (size_t i = 1; i < n; i++) {
        nh_graded_cell own = x[i];
        size_t k = i;
        for (; k > 0 && x[k - 1].column > own.column; k--) x[k] = x[k - 1];
        x[k] = own;
    }
}

/* Fills the rows with the entries of their equations; entries in one column are added. */
static void fill(const nh_graded_system *s, nh_graded_component *c, const size_t *place)
{
    for (size_t i = 0; i < c->rows; i++) {
        size_t from = s->start[c->equation[i]], to = s->start[c->equation[i] + 1], n = 0;
        nh_grow(&c->cells[i], &c->room[i], to - from, sizeof *c->cells[i]);
        nh_graded_cell *x = c->cells[i];
        for (size_t z = from; z < to; z++)
            x[z - from] = (nh_graded_cell){(uint32_t)place[s->symbol[z].unknown], s->symbol[z].value};
        sort_cells(to - from, x);
        for (size_t z = 0; z < to - from; z++) {
            if (n && x[n - 1].column == x[z].column) x[n - 1].value = nh_residue_add(s->f, x[n - 1].value, x[z].value);
            else x[n++] = x[z];
            if (x[n - 1].value == 0 && (z + 1 == to - from || x[z + 1].column != x[n - 1].column)) n--;
        }
        c->length[i] = n;
        for (size_t z = 0; z < n; z++) {
            c->count[x[z].column]++;
            append(&c->member[x[z].column], i);
        }
        list_row(c, i);
    }
}

void nh_graded_component_solve(const nh_graded_system *s, nh_graded_component *c, const size_t *place)
{
    c->rank = c->rest.least = 0;
    memset(c->rest.first, 0, (c->columns + 1) * sizeof *c->rest.first);
    memset(c->done, 0, c->rows * sizeof *c->done);
    memset(c->count, 0, c->columns * sizeof *c->count);
    memset(c->pivoted, 0, c->columns * sizeof *c->pivoted);
    for (size_t j = 0; j < c->columns; j++) c->member[j].count = 0;
    fill(s, c, place);
    eliminate(s, c);
}
