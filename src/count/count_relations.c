/* count_relations: a product that is a combination of products before it is the leading product of a relation.
 *
 *     row = [ values under the functionals | which products it combines ]
 *     echelon form row by row: where the left part becomes 0 the right part is a relation
 *
 * Products that an earlier leading product divides follow from that relation, and are left out. */
#include <stdlib.h>
#include <math.h>
#include <string.h>

#include "count/count_internal.h"

enum { most_monomials = 400, spare = 8, beyond = 2 };

typedef struct {
    const nh_counter *counter;
    const uint8_t *exponent; /* known */
    size_t degree;
} monomial;

static int by_degree(const void *a, const void *b)
{
    const monomial *x = a, *y = b;
    if (x->degree != y->degree) return x->degree < y->degree ? -1 : 1;
    for (size_t k = x->counter->known; k-- > 0;) /* later integrals have higher prices */
        if (x->exponent[k] != y->exponent[k]) return x->exponent[k] < y->exponent[k] ? -1 : 1;
    return 0;
}

static monomial *sorted(const nh_counter *c, const nh_count_monomials *p)
{
    monomial *m = nh_alloc_array(p->count + 1, sizeof *m);
    for (size_t i = 0; i < p->count; i++) {
        m[i] = (monomial){.counter = c, .exponent = p->exponent + i * c->known};
        for (size_t k = 0; k < c->known; k++) m[i].degree += m[i].exponent[k] * c->degree[k];
    }
    qsort(m, p->count, sizeof *m, by_degree);
    return m;
}

/* Does the leading product of an earlier relation divide it? */
static bool follows(const nh_counter *c, const uint8_t *exponent, size_t relations, const nh_count_relation *relation)
{
    bool divides = false;
    for (size_t i = 0; i < relations && !divides; i++) {
        const uint8_t *leading = relation[i].exponent + (relation[i].terms - 1) * c->q->known;
        divides = true;
        for (size_t k = 0; k < c->known; k++) divides &= leading[c->index[k]] <= exponent[k];
    }
    return divides;
}

/* The row of the echelon form whose values are all zero: its other part says which products it combines, in the
 * question's integrals, the leading one last. */
static nh_count_relation read_relation(const nh_counter *c, const nh_residue *combination, size_t count,
                                       const monomial *m, const size_t *standard, nh_arena *arena)
{
    nh_count_relation r = {.exponent = nh_arena_alloc(arena, count * c->q->known)};
    for (size_t i = 0; i < count; i++) {
        if (!combination[i]) continue;
        for (size_t k = 0; k < c->known; k++)
            r.exponent[r.terms * c->q->known + c->index[k]] = m[standard[i]].exponent[k];
        r.terms++;
    }
    return r;
}

/* Rows: values, then a unit vector that says of which product. */
static size_t eliminate(const nh_counter *c, nh_prime field, const nh_count_monomials *p, const monomial *m,
                        size_t values, const nh_residue *value, nh_arena *arena, size_t most, nh_count_relation *out)
{
    size_t relations = 0, standards = 0, *standard = nh_alloc_array(p->count + 1, sizeof *standard);
    nh_count_space space = {.width = values + p->count + 1};
    nh_residue *row = nh_alloc_array(space.width, sizeof *row);
    for (size_t i = 0; i < p->count && relations < most; i++) {
        if (follows(c, m[i].exponent, relations, out)) continue;
        memset(row, 0, space.width * sizeof *row);
        memcpy(row, value + (size_t)(m[i].exponent - p->exponent) / (c->known ? c->known : 1) * values,
               values * sizeof *row);
        row[values + standards] = 1;
        standard[standards++] = i;
        nh_count_space_add(&space, field, row);
        const nh_residue *last = space.row + (space.rows - 1) * space.width;
        bool related = true;
        for (size_t j = 0; j < values && related; j++) related = !last[j];
        if (!related) continue;
        out[relations++] = read_relation(c, last + values, standards, m, standard, arena);
        space.rows--;
        standards--;
    }
    nh_free(row);
    nh_free(space.row);
    nh_free(standard);
    return relations;
}

/* The relations among monomials of the known integrals at one random point: columns are monomials, rows functionals
 * of series. */
static bool at_point(nh_counter *c, size_t degree, nh_arena *arena, size_t most, size_t *relations,
                     nh_count_relation *out)
{
    bool regular;
    nh_count_monomials p = nh_count_monomials_list(c, degree);
    nh_count_series *s = p.count && p.count <= most_monomials
                             ? nh_count_series_create(c, (degree + beyond) * c->frame->step, INFINITY, &regular)
                             : NULL;
    bool good = p.count > most_monomials || !p.count || s || !regular;
    if (s) {
        nh_count_functionals f = nh_count_functionals_create(s->ring, c->equations->n, p.count + spare, 314159);
        nh_residue *value = nh_alloc_array(p.count * f.count, sizeof *value);
        monomial *m = sorted(c, &p);
        good = nh_count_product_values(c, s->ring, s->coordinate, &p, &f, value);
        if (good) *relations = eliminate(c, s->ring->field, &p, m, f.count, value, arena, most, out);
        nh_free(m);
        nh_free(value);
        nh_count_functionals_clear(&f);
    }
    nh_count_series_free(s);
    nh_count_monomials_clear(&p);
    return good;
}

size_t nh_count_relations(const nh_model *model, size_t known, const nh_ex *current, size_t degree, nh_arena *arena,
                          size_t most, nh_count_relation *out)
{
    nh_count_question q = {.degree = degree, .known = known, .current = current};
    nh_counter c;
    size_t relations = 0;
    bool done = false;
    nh_counter_open(&c, model, &q, false);
    for (size_t point = 0; point < NH_COUNT_POINTS && !done && !c.equations->obstacle; point++)
        done = nh_count_regular_point(&c, point) && at_point(&c, degree, arena, most, &relations, out);
    nh_counter_close(&c);
    return relations;
}
