/* The symbol of one weight: its components, each by sparse elimination that takes the shortest row and its rarest
 * column first. */
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "count/graded_solver_internal.h"

/* an inverse modulo the prime takes as long as so many products, and an entry of a row as long as these */
enum { inverse_work = 40, cell_work = 50 };

/* Is the known part of an equation without unknowns a condition on the parameters? */
static bool is_condition(const nh_graded_system *s, size_t equation)
{
    const nh_residue *known = s->known + equation * s->before;
    for (size_t j = 0; j < s->before; j++)
        if (known[j]) return true;
    return false;
}

/* ---- parts: components one after another, and what is left of them ---- */

/* An unknown that follows from those in its cells (itself among them) and from the known part of an equation, which is
 * still to be multiplied by `inverse`. */
typedef struct {
    size_t component, unknown, equation, from, to;
    nh_residue inverse;
} pivot;

typedef struct {
    size_t first, end; /* components */
    size_t pivots, pivot_room, cells, cell_room, frees, free_room, conditions, condition_room;
    pivot *pivot;
    nh_graded_entry *cell;
    size_t *free;      /* unknowns that become parameters: free_to[component] is the end of those of a component */
    size_t *condition; /* equations */
    double work;
} part;

static void part_clear(part *p)
{
    nh_free(p->pivot);
    nh_free(p->cell);
    nh_free(p->free);
    nh_free(p->condition);
}

/* ---- one component of the symbol: sparse elimination, the shortest row and its rarest column first ---- */

typedef struct {
    uint32_t column;
    nh_residue value;
} cell;

typedef struct {
    size_t count, capacity;
    uint32_t *item;
} row_list;

/* The remaining rows by their length, in lists: a row's number plus 1, or 0 at the end. */
typedef struct {
    size_t least; /* no row is shorter */
    uint32_t *first, *next, *previous;
} lengths;

/* Most components are small and there are thousands of them: one after the other uses the same memory. */
typedef struct {
    size_t rows, columns, rank;
    size_t *equation;         /* of each row */
    size_t *unknown;          /* of each column */
    cell **cells, *spare;     /* spare: a replaced row whose memory serves the next one */
    size_t *room, spare_room; /* length of each row; room of the spare one */
    size_t *length, *count;   /* number of entries of each row; number of remaining rows that have this column */
    bool *done, *pivoted;     /* rows used as pivots; columns */
    size_t *pivot_row, *pivot_column;
    nh_residue *inverse; /* by which the row's known part is still to be multiplied */
    row_list *member;    /* for each column: the rows that have it or had it, some more than once */
    lengths rest;
    double work;         /* of all components so far */
} component;

static void component_init(component *c, size_t rows, size_t columns)
{
    *c = (component){0};
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

static void component_clear(component *c, size_t rows, size_t columns)
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

static void list_row(component *c, size_t i)
{
    lengths *l = &c->rest;
    size_t length = c->length[i];
    if (!length) return;
    l->next[i] = l->first[length];
    l->previous[i] = 0;
    if (l->next[i]) l->previous[l->next[i] - 1] = (uint32_t)i + 1;
    l->first[length] = (uint32_t)i + 1;
    if (length < l->least) l->least = length;
}

static void unlist_row(component *c, size_t i)
{
    lengths *l = &c->rest;
    if (l->previous[i]) l->next[l->previous[i] - 1] = l->next[i];
    else l->first[c->length[i]] = l->next[i];
    if (l->next[i]) l->previous[l->next[i] - 1] = l->previous[i];
}

/* SIZE_MAX: no row has entries. */
static size_t shortest_row(component *c)
{
    lengths *l = &c->rest;
    while (l->least <= c->columns && !l->first[l->least]) l->least++;
    return l->least <= c->columns ? l->first[l->least] - 1 : SIZE_MAX;
}

/* ---- elimination ---- */

static void append(row_list *l, size_t x)
{
    if (l->count == l->capacity) nh_grow(&l->item, &l->capacity, l->count + 1, sizeof *l->item);
    l->item[l->count++] = (uint32_t)x;
}

/* to := to + factor * from, both sorted by column */
static void combine(const nh_graded_system *s, component *c, size_t to, size_t from, nh_residue factor)
{
    size_t x = 0, y = 0, n = 0, na = c->length[to], nb = c->length[from];
    nh_grow(&c->spare, &c->spare_room, na + nb, sizeof *c->spare);
    cell *a = c->cells[to], *b = c->cells[from], *out = c->spare;
    while (x < na || y < nb) {
        if (y == nb || (x < na && a[x].column < b[y].column)) {
            out[n++] = a[x++];
        } else if (x == na || b[y].column < a[x].column) {
            out[n++] = (cell){b[y].column, nh_residue_mul(s->f, factor, b[y].value)};
            append(&c->member[b[y].column], to);
            c->count[b[y++].column]++;
        } else {
            nh_residue v = nh_residue_add(s->f, a[x].value, nh_residue_mul(s->f, factor, b[y].value));
            if (v) out[n++] = (cell){a[x].column, v};
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

static const cell *find_cell(const component *c, size_t i, size_t column)
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
static void take_pivot(const nh_graded_system *s, component *c, size_t i)
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
        const cell *x = c->done[k] ? NULL : find_cell(c, k, column);
        if (x) combine(s, c, k, i, nh_residue_negative(s->f, x->value));
    }
}

static void eliminate(const nh_graded_system *s, component *c)
{
    for (size_t best; (best = shortest_row(c)) != SIZE_MAX && !nh_late();) take_pivot(s, c, best);
}

/* ---- what is left of a component ---- */

static void keep_pivots(const component *c, size_t number, part *p)
{
    for (size_t t = 0; t < c->rank; t++) {
        size_t i = c->pivot_row[t], from = p->cells;
        nh_grow(&p->cell, &p->cell_room, from + c->length[i], sizeof *p->cell);
        for (size_t z = 0; z < c->length[i]; z++)
            p->cell[p->cells++] = (nh_graded_entry){(uint32_t)c->unknown[c->cells[i][z].column], c->cells[i][z].value};
        nh_grow(&p->pivot, &p->pivot_room, p->pivots + 1, sizeof *p->pivot);
        p->pivot[p->pivots++] = (pivot){.component = number,
                                        .unknown = c->unknown[c->pivot_column[t]],
                                        .equation = c->equation[i],
                                        .from = from,
                                        .to = p->cells,
                                        .inverse = c->inverse[i]};
    }
}

/* Columns without a pivot become parameters, rows without entries conditions. */
static void keep_rest(const nh_graded_system *s, const component *c, part *p)
{
    for (size_t j = 0; j < c->columns; j++) {
        if (c->pivoted[j]) continue;
        nh_grow(&p->free, &p->free_room, p->frees + 1, sizeof *p->free);
        p->free[p->frees++] = c->unknown[j];
    }
    for (size_t i = 0; i < c->rows; i++) {
        if (c->done[i] || !is_condition(s, c->equation[i])) continue;
        nh_grow(&p->condition, &p->condition_room, p->conditions + 1, sizeof *p->condition);
        p->condition[p->conditions++] = c->equation[i];
    }
}

/* ---- the symbol's components ---- */

static size_t root_of(size_t *parent, size_t x)
{
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
}

static int by_column(const void *a, const void *b)
{
    uint32_t x = ((const cell *)a)->column, y = ((const cell *)b)->column;
    return (x > y) - (x < y);
}

/* Most rows have a few entries, in order but for some. */
static void sort_cells(size_t n, cell *x)
{
    enum { few = 24 };
    if (n > few) {
        qsort(x, n, sizeof *x, by_column);
        return;
    }
    for (size_t i = 1; i < n; i++) {
        cell own = x[i];
        size_t k = i;
        for (; k > 0 && x[k - 1].column > own.column; k--) x[k] = x[k - 1];
        x[k] = own;
    }
}

/* Fills the rows with the entries of their equations; entries in one column are added. */
static void fill(const nh_graded_system *s, component *c, const size_t *place)
{
    for (size_t i = 0; i < c->rows; i++) {
        size_t from = s->start[c->equation[i]], to = s->start[c->equation[i] + 1], n = 0;
        nh_grow(&c->cells[i], &c->room[i], to - from, sizeof *c->cells[i]);
        cell *x = c->cells[i];
        for (size_t z = from; z < to; z++)
            x[z - from] = (cell){(uint32_t)place[s->symbol[z].unknown], s->symbol[z].value};
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

static void solve_component(const nh_graded_system *s, component *c, const size_t *place)
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

/* Sorts positions by `key` in [0, keys): those of a key begin at start[key]. */
static void group(size_t count, const size_t *key, size_t keys, size_t *start, size_t *out)
{
    memset(start, 0, (keys + 2) * sizeof *start);
    for (size_t i = 0; i < count; i++) start[key[i] + 2]++;
    for (size_t k = 0; k < keys; k++) start[k + 2] += start[k + 1];
    for (size_t i = 0; i < count; i++) out[start[key[i] + 1]++] = i;
}

static size_t widest(size_t count, const size_t *start)
{
    size_t most = 0;
    for (size_t k = 0; k < count; k++) most = start[k + 1] - start[k] > most ? start[k + 1] - start[k] : most;
    return most;
}

/* Components of unknowns that occur together: the equations and the unknowns of component k are those from rows[k] and
 * from columns[k] on. */
typedef struct {
    nh_graded_system *s;
    size_t count, parts;
    size_t *rows, *columns, *equation, *unknown;
    size_t *place;           /* of each unknown, in its component */
    size_t *free_to, *width; /* of each component: the end of its free unknowns; how many parameters it is about */
    part part[NH_GRADED_PARTS];
} symbol;

static symbol find_components(nh_graded_system *s)
{
    size_t unknowns = s->alphas * s->unknowns_of, connected = 0;
    symbol x = {.s = s,
                .place = nh_alloc_array(unknowns + 1, sizeof *x.place),
                .unknown = nh_alloc_array(unknowns + 1, sizeof *x.unknown),
                .equation = nh_alloc_array(s->equations + 1, sizeof *x.equation)};
    size_t *parent = nh_alloc_array(unknowns + 1, sizeof *parent),
           *number = nh_alloc_array(unknowns + 1, sizeof *number),
           *list = nh_alloc_array(s->equations + 1, sizeof *list), *of = nh_alloc_array(s->equations + 1, sizeof *of);
    for (size_t i = 0; i < unknowns; i++) parent[i] = i;
    for (size_t q = 0; q < s->equations; q++)
        for (size_t z = s->start[q] + 1; z < s->start[q + 1]; z++)
            parent[root_of(parent, s->symbol[z].unknown)] = root_of(parent, s->symbol[z - 1].unknown);
    for (size_t i = 0; i < unknowns; i++)
        if (root_of(parent, i) == i) number[i] = x.count++;
    for (size_t i = 0; i < unknowns; i++) number[i] = number[root_of(parent, i)]; /* a root keeps its number */
    for (size_t q = 0; q < s->equations; q++) {
        if (s->start[q] == s->start[q + 1]) {
            if (is_condition(s, q)) s->fresh[s->fresh_count++] = s->known + q * s->before;
        } else {
            list[connected] = q;
            of[connected++] = number[s->symbol[s->start[q]].unknown];
        }
    }
    x.rows = nh_alloc_array(x.count + 3, sizeof *x.rows);
    x.columns = nh_alloc_array(x.count + 3, sizeof *x.columns);
    x.free_to = nh_alloc_array(x.count + 1, sizeof *x.free_to);
    x.width = nh_alloc_array(x.count + 1, sizeof *x.width);
    group(connected, of, x.count, x.rows, x.equation);
    group(unknowns, number, x.count, x.columns, x.unknown);
    for (size_t i = 0; i < connected; i++) x.equation[i] = list[x.equation[i]];
    nh_free(of);
    nh_free(list);
    nh_free(number);
    nh_free(parent);
    return x;
}

static void symbol_clear(symbol *x)
{
    for (size_t i = 0; i < x->parts; i++) part_clear(&x->part[i]);
    nh_free(x->rows);
    nh_free(x->columns);
    nh_free(x->equation);
    nh_free(x->unknown);
    nh_free(x->place);
    nh_free(x->free_to);
    nh_free(x->width);
}

/* Parts with about as many equations each. */
static void divide(symbol *x)
{
    const nh_graded_system *s = x->s;
    size_t equations = x->rows[x->count], k = 0;
    x->parts = nh_graded_parts((double)s->start[s->equations] * ((double)s->before + cell_work));
    for (size_t i = 0; i < x->parts; i++) {
        x->part[i].first = k;
        while (k < x->count && (i + 1 == x->parts || x->rows[k] * x->parts < equations * (i + 1))) k++;
        x->part[i].end = k;
    }
}

static void eliminate_part(size_t index, void *context)
{
    symbol *x = context;
    part *p = &x->part[index];
    component c;
    size_t rows = widest(p->end - p->first, x->rows + p->first),
           columns = widest(p->end - p->first, x->columns + p->first);
    component_init(&c, rows, columns);
    for (size_t k = p->first; k < p->end && !nh_late(); k++) {
        c.rows = x->rows[k + 1] - x->rows[k];
        c.columns = x->columns[k + 1] - x->columns[k];
        c.equation = x->equation + x->rows[k];
        c.unknown = x->unknown + x->columns[k];
        for (size_t j = 0; j < c.columns; j++) x->place[c.unknown[j]] = j;
        solve_component(x->s, &c, x->place);
        keep_pivots(&c, k, p);
        keep_rest(x->s, &c, p);
        x->free_to[k] = p->frees;
    }
    p->work = c.work;
    component_clear(&c, rows, columns);
}

static void take_parameters_and_conditions(symbol *x)
{
    nh_graded_system *s = x->s;
    for (size_t i = 0; i < x->parts; i++) {
        const part *p = &x->part[i];
        for (size_t k = p->first, j = 0; k < p->end && !s->over; k++) {
            for (; j < x->free_to[k] && !s->over; j++)
                nh_graded_parameter(s, p->free[j] / s->unknowns_of, s->first + p->free[j] % s->unknowns_of);
            x->width[k] = s->N;
        }
        for (size_t j = 0; j < p->conditions; j++)
            s->fresh[s->fresh_count++] = s->known + p->condition[j] * s->before;
    }
}

/* The unknowns with a pivot follow from the others, last pivot first. */
static void back_substitute(size_t index, void *context)
{
    symbol *x = context;
    const nh_graded_system *s = x->s;
    part *p = &x->part[index];
    for (size_t t = p->pivots; t-- > 0;) {
        const pivot *v = &p->pivot[t];
        size_t width = x->width[v->component];
        nh_residue *out = nh_graded_row(s, v->unknown / s->unknowns_of, s->first + v->unknown % s->unknowns_of);
        memcpy(out, s->known + v->equation * s->before, s->before * sizeof *out);
        nh_residue_scale(s->f, s->before, out, nh_residue_negative(s->f, v->inverse));
        for (size_t z = v->from; z < v->to; z++) {
            size_t other = p->cell[z].unknown;
            if (other != v->unknown)
                nh_residue_add_multiple(s->f, width, out,
                                        nh_graded_row(s, other / s->unknowns_of, s->first + other % s->unknowns_of),
                                        nh_residue_negative(s->f, p->cell[z].value));
        }
        p->work += (double)((v->to - v->from) * width);
    }
}

void nh_graded_solve_symbol(nh_graded_system *s)
{
    s->fresh = nh_alloc_array(s->equations + 1, sizeof *s->fresh);
    s->fresh_count = 0;
    symbol x = find_components(s);
    divide(&x);
    nh_parallel(x.parts, s->p->threads, eliminate_part, &x);
    s->over |= nh_late();
    if (!s->over) take_parameters_and_conditions(&x);
    if (!s->over) nh_parallel(x.parts, s->p->threads, back_substitute, &x);
    for (size_t i = 0; i < x.parts; i++) s->work += x.part[i].work;
    symbol_clear(&x);
}
