/* graded_symbol: the symbol of one weight: its components, in parts that several threads share.
 *
 *     find_components     unknowns that occur in one equation belong together (union and find)
 *     divide              components into parts with about as many equations each
 *     eliminate_part      sparse elimination of each component (graded_component.h)
 *     take_parameters     free unknowns become parameters, rows without unknowns conditions: in order, by one thread
 *     back_substitute     the other unknowns follow, last pivot first */
#include <string.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "count/graded_solver_internal.h"

enum { cell_work = 50 }; /* an entry of a row takes as long as so many products */

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

/* ---- what is left of a component ---- */

static void keep_pivots(const nh_graded_component *c, size_t number, part *p)
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
static void keep_rest(const nh_graded_system *s, const nh_graded_component *c, part *p)
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

/* The representative of x, with shorter ways for the next time. */
static size_t root_of(size_t *parent, size_t x)
{
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
}

/* Sorts positions by `key` in [0, keys): those of a key begin at start[key]. */
static void group(size_t count, const size_t *key, size_t keys, size_t *start, size_t *out)
{
    memset(start, 0, (keys + 2) * sizeof *start);
    for (size_t i = 0; i < count; i++) start[key[i] + 2]++;
    for (size_t k = 0; k < keys; k++) start[k + 2] += start[k + 1];
    for (size_t i = 0; i < count; i++) out[start[key[i] + 1]++] = i;
}

/* The most members of one component. */
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

/* Unknowns that occur in one equation belong together: the symbol falls apart into components, listed one after
 * another. */
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

/* The components of one part, for one thread. */
static void eliminate_part(size_t index, void *context)
{
    symbol *x = context;
    part *p = &x->part[index];
    nh_graded_component c;
    size_t rows = widest(p->end - p->first, x->rows + p->first),
           columns = widest(p->end - p->first, x->columns + p->first);
    nh_graded_component_init(&c, rows, columns);
    for (size_t k = p->first; k < p->end && !nh_late(); k++) {
        c.rows = x->rows[k + 1] - x->rows[k];
        c.columns = x->columns[k + 1] - x->columns[k];
        c.equation = x->equation + x->rows[k];
        c.unknown = x->unknown + x->columns[k];
        for (size_t j = 0; j < c.columns; j++) x->place[c.unknown[j]] = j;
        nh_graded_component_solve(x->s, &c, x->place);
        keep_pivots(&c, k, p);
        keep_rest(x->s, &c, p);
        x->free_to[k] = p->frees;
    }
    p->work = c.work;
    nh_graded_component_clear(&c, rows, columns);
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
        for (size_t j = 0; j < p->conditions; j++) s->fresh[s->fresh_count++] = s->known + p->condition[j] * s->before;
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
