/* The symbol of one weight: its components, each by sparse elimination that takes the shortest row and its rarest
 * column first. */
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "count/graded_solver_internal.h"

enum { inverse_work = 40 }; /* an inverse modulo the prime takes as long as this many products */

/* Adds a condition on the parameters, unless it is empty. */
static void add_condition(nh_graded_system *s, nh_residue *known)
{
    for (size_t j = 0; j < s->before; j++)
        if (known[j]) {
            s->fresh[s->fresh_count++] = known;
            return;
        }
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

/* Keys length x 2^32 + row. */
typedef struct {
    size_t count, capacity;
    uint64_t *key;
} row_queue;

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
    row_queue queue;     /* a heap, which also holds outdated entries of rows that changed */
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
}

static void component_clear(component *c, size_t rows, size_t columns)
{
    for (size_t i = 0; i < rows; i++) nh_free(c->cells[i]);
    for (size_t j = 0; j < columns; j++) nh_free(c->member[j].item);
    nh_free(c->queue.key);
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

/* ---- the shortest remaining row: a binary heap whose least entry is taken ---- */

static void queue_row(component *c, size_t i)
{
    row_queue *q = &c->queue;
    uint64_t key = (uint64_t)c->length[i] << 32 | i;
    size_t at = q->count;
    if (!c->length[i]) return;
    if (q->count == q->capacity) nh_grow(&q->key, &q->capacity, q->count + 1, sizeof *q->key);
    q->count++;
    for (; at > 0 && q->key[(at - 1) / 2] > key; at = (at - 1) / 2) q->key[at] = q->key[(at - 1) / 2];
    q->key[at] = key;
}

static uint64_t least_of_queue(row_queue *q)
{
    uint64_t least = q->key[0], key = q->key[--q->count];
    size_t at = 0;
    for (size_t next = 1; next < q->count; next = 2 * at + 1) {
        if (next + 1 < q->count && q->key[next + 1] < q->key[next]) next++;
        if (q->key[next] >= key) break;
        q->key[at] = q->key[next];
        at = next;
    }
    q->key[at] = key;
    return least;
}

/* SIZE_MAX: no row has entries. */
static size_t shortest_row(component *c)
{
    while (c->queue.count) {
        uint64_t key = least_of_queue(&c->queue);
        size_t i = (uint32_t)key;
        if (!c->done[i] && c->length[i] == key >> 32) return i;
    }
    return SIZE_MAX;
}

/* ---- elimination ---- */

static void append(row_list *l, size_t x)
{
    if (l->count == l->capacity) nh_grow(&l->item, &l->capacity, l->count + 1, sizeof *l->item);
    l->item[l->count++] = (uint32_t)x;
}

/* to := to + factor * from, both sorted by column */
static void combine(nh_graded_system *s, component *c, size_t to, size_t from, nh_residue factor)
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
    c->room[to] = c->spare_room;
    c->cells[to] = out;
    c->length[to] = n;
    c->spare = a;
    c->spare_room = room;
    queue_row(c, to);
    nh_residue_add_multiple(s->f, s->before, s->known + c->equation[to] * s->before,
                            s->known + c->equation[from] * s->before, nh_residue_mul(s->f, factor, c->inverse[from]));
    s->work += (double)(s->before + 8 * n); /* an entry costs more than a product, because its row is made anew */
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
static void take_pivot(nh_graded_system *s, component *c, size_t i)
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
    s->work += (double)(c->member[column].count + inverse_work);
    c->done[i] = c->pivoted[column] = true;
    c->pivot_row[c->rank] = i;
    c->pivot_column[c->rank++] = column;
    for (size_t z = 0; z < c->member[column].count && c->count[column]; z++) {
        size_t k = c->member[column].item[z];
        const cell *x = c->done[k] ? NULL : find_cell(c, k, column);
        if (x) combine(s, c, k, i, nh_residue_negative(s->f, x->value));
    }
}

static void eliminate(nh_graded_system *s, component *c)
{
    for (size_t best; (best = shortest_row(c)) != SIZE_MAX && !nh_late();) take_pivot(s, c, best);
}

/* Columns without a pivot become parameters; the others follow from them, last pivot first. */
static void back_substitute(nh_graded_system *s, component *c)
{
    for (size_t j = 0; j < c->columns && !s->over; j++)
        if (!c->pivoted[j])
            nh_graded_parameter(s, c->unknown[j] / s->unknowns_of, s->first + c->unknown[j] % s->unknowns_of);
    for (size_t t = c->rank; t-- > 0 && !s->over;) {
        size_t i = c->pivot_row[t], u = c->unknown[c->pivot_column[t]];
        nh_residue *out = nh_graded_row(s, u / s->unknowns_of, s->first + u % s->unknowns_of);
        const nh_residue *known = s->known + c->equation[i] * s->before;
        memcpy(out, known, s->before * sizeof *out);
        nh_residue_scale(s->f, s->before, out, nh_residue_negative(s->f, c->inverse[i]));
        for (size_t z = 0; z < c->length[i]; z++) {
            size_t other = c->unknown[c->cells[i][z].column];
            if (other != u)
                nh_residue_add_multiple(s->f, s->N, out,
                                        nh_graded_row(s, other / s->unknowns_of, s->first + other % s->unknowns_of),
                                        nh_residue_negative(s->f, c->cells[i][z].value));
            s->work += (double)s->N;
        }
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
static void fill(nh_graded_system *s, component *c, const size_t *place)
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
        queue_row(c, i);
    }
}

static void solve_component(nh_graded_system *s, component *c, const size_t *place)
{
    c->rank = c->queue.count = 0;
    memset(c->done, 0, c->rows * sizeof *c->done);
    memset(c->count, 0, c->columns * sizeof *c->count);
    memset(c->pivoted, 0, c->columns * sizeof *c->pivoted);
    for (size_t j = 0; j < c->columns; j++) c->member[j].count = 0;
    fill(s, c, place);
    eliminate(s, c);
    for (size_t i = 0; i < c->rows; i++)
        if (!c->done[i]) add_condition(s, s->known + c->equation[i] * s->before);
    back_substitute(s, c);
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

/* Finds the components of unknowns that occur together, and solves each for itself. */
void nh_graded_solve_symbol(nh_graded_system *s)
{
    size_t unknowns = s->alphas * s->unknowns_of, components = 0, connected = 0;
    size_t *parent = nh_alloc_array(unknowns + 1, sizeof *parent),
           *number = nh_alloc_array(unknowns + 1, sizeof *number), *place = nh_alloc_array(unknowns + 1, sizeof *place);
    size_t *list = nh_alloc_array(s->equations + 1, sizeof *list), *of = nh_alloc_array(s->equations + 1, sizeof *of),
           *order = nh_alloc_array(s->equations + 1, sizeof *order);
    s->fresh = nh_alloc_array(s->equations + 1, sizeof *s->fresh);
    s->fresh_count = 0;
    for (size_t i = 0; i < unknowns; i++) parent[i] = i;
    for (size_t q = 0; q < s->equations; q++)
        for (size_t z = s->start[q] + 1; z < s->start[q + 1]; z++)
            parent[root_of(parent, s->symbol[z].unknown)] = root_of(parent, s->symbol[z - 1].unknown);
    for (size_t i = 0; i < unknowns; i++)
        if (root_of(parent, i) == i) number[i] = components++;
    for (size_t i = 0; i < unknowns; i++) number[i] = number[root_of(parent, i)]; /* a root keeps its number */
    for (size_t q = 0; q < s->equations; q++) {
        if (s->start[q] == s->start[q + 1]) {
            add_condition(s, s->known + q * s->before);
        } else {
            list[connected] = q;
            of[connected++] = number[s->symbol[s->start[q]].unknown];
        }
    }
    size_t *rows = nh_alloc_array(components + 3, sizeof *rows),
           *columns = nh_alloc_array(components + 3, sizeof *columns),
           *member = nh_alloc_array(unknowns + 1, sizeof *member);
    group(connected, of, components, rows, order);
    group(unknowns, number, components, columns, member);
    for (size_t i = 0; i < connected; i++) order[i] = list[order[i]];
    component c;
    size_t most_rows = widest(components, rows), most_columns = widest(components, columns);
    component_init(&c, most_rows, most_columns);
    for (size_t k = 0; k < components && !s->over && !nh_late(); k++) {
        c.rows = rows[k + 1] - rows[k];
        c.columns = columns[k + 1] - columns[k];
        c.equation = order + rows[k];
        c.unknown = member + columns[k];
        for (size_t j = 0; j < c.columns; j++) place[c.unknown[j]] = j;
        solve_component(s, &c, place);
    }
    component_clear(&c, most_rows, most_columns);
    nh_free(member);
    nh_free(columns);
    nh_free(rows);
    nh_free(order);
    nh_free(of);
    nh_free(list);
    nh_free(place);
    nh_free(number);
    nh_free(parent);
}
