#include "graph/monomials.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/index.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_symbols = 32, most_power = 64 };

/* ---- in which symbols ---- */

static bool whole_positive(const nh_dag *d, nh_ex exponent)
{
    if (nh_kind_of(d, exponent) != NH_NUMBER) return false;
    nh_num n = nh_number_of(d, exponent);
    return nh_num_short(n) && n.q == 1 && n.p > 0 && n.p <= most_power;
}

static bool has_degree(const nh_dag *d, nh_ex e, nh_ex symbol, nh_index *seen)
{
    uint32_t known;
    if (nh_index_get(seen, e, &known)) return known;
    bool has = e == symbol || !nh_depends(d, e, symbol);
    if (!has && (nh_kind_of(d, e) == NH_SUM || nh_kind_of(d, e) == NH_PRODUCT)) {
        has = true;
        for (size_t i = 0; i < nh_arity(d, e) && has; i++) {
            nh_ex child = nh_child(d, e, i);
            has = has_degree(d, child, symbol, seen);
            if (nh_kind_of(d, e) == NH_SUM) continue;
            nh_ex exponent = nh_exponent_of(d, e, i);
            has &= !nh_depends(d, exponent, symbol) && (!nh_depends(d, child, symbol) || whole_positive(d, exponent));
        }
    }
    nh_index_put(seen, e, has);
    return has;
}

bool nh_monomials_has_degree(const nh_dag *dag, nh_ex e, nh_ex symbol)
{
    nh_index seen = {0};
    bool has = has_degree(dag, e, symbol, &seen);
    nh_index_clear(&seen);
    return has;
}

/* ---- the coefficients ---- */

typedef struct {
    unsigned char exponent[most_symbols];
    nh_ex coefficient;
} part;

/* Monomials in ascending order, each once. */
typedef struct {
    size_t count;
    part *item;
} parts;

typedef struct {
    nh_dag *dag;
    size_t symbols, most, lists;
    const nh_ex *symbol;
    nh_index known; /* node -> number of its list */
    parts *list;
    size_t capacity;
} expansion;

static int by_exponents(const void *a, const void *b)
{
    return memcmp(((const part *)a)->exponent, ((const part *)b)->exponent, most_symbols);
}

/* Sorts, and adds up what belongs together. */
static void gather(nh_dag *d, parts *p)
{
    size_t kept = 0;
    if (p->count) qsort(p->item, p->count, sizeof *p->item, by_exponents);
    nh_num *one = nh_alloc_array(p->count + 1, sizeof *one);
    nh_ex *term = nh_alloc_array(p->count + 1, sizeof *term);
    for (size_t i = 0, j; i < p->count; i = j) {
        for (j = i; j < p->count && !by_exponents(&p->item[i], &p->item[j]); j++) {
            one[j - i] = nh_num_int(1);
            term[j - i] = p->item[j].coefficient;
        }
        part sum = p->item[i];
        sum.coefficient = nh_linear(d, j - i, one, term);
        if (!nh_is_zero(d, sum.coefficient)) p->item[kept++] = sum;
    }
    p->count = kept;
    nh_free(one);
    nh_free(term);
}

static parts single(nh_ex coefficient)
{
    parts out = {.count = 1, .item = nh_alloc_array(1, sizeof *out.item)};
    out.item[0].coefficient = coefficient;
    return out;
}

/* false: too many. */
static bool multiply(expansion *x, parts *into, const parts *by)
{
    parts out = {0};
    bool good = !by->count || into->count <= x->most / by->count;
    if (good) out.item = nh_alloc_array(into->count * by->count + 1, sizeof *out.item);
    for (size_t i = 0; i < into->count && good; i++)
        for (size_t j = 0; j < by->count && good; j++) {
            part product = {.coefficient = nh_mul(x->dag, into->item[i].coefficient, by->item[j].coefficient)};
            for (size_t k = 0; k < x->symbols && good; k++) {
                unsigned sum = (unsigned)into->item[i].exponent[k] + by->item[j].exponent[k];
                good = sum <= most_power;
                product.exponent[k] = (unsigned char)sum;
            }
            out.item[out.count++] = product;
        }
    if (good) gather(x->dag, &out);
    nh_free(into->item);
    *into = out;
    return good;
}

static bool expand(expansion *x, nh_ex e, size_t *list);

static bool expand_sum(expansion *x, nh_ex e, parts *out)
{
    *out = single(nh_number(x->dag, nh_constant_of(x->dag, e)));
    for (size_t i = 0; i < nh_arity(x->dag, e); i++) {
        size_t own;
        if (!expand(x, nh_child(x->dag, e, i), &own) || out->count + x->list[own].count > x->most) return false;
        const parts *term = &x->list[own];
        nh_ex c = nh_number(x->dag, nh_coefficient_of(x->dag, e, i));
        out->item = nh_realloc_array(out->item, out->count + term->count + 1, sizeof *out->item);
        for (size_t j = 0; j < term->count; j++) {
            part *p = &out->item[out->count++];
            *p = term->item[j];
            p->coefficient = nh_mul(x->dag, c, p->coefficient);
        }
    }
    gather(x->dag, out);
    return true;
}

static bool expand_product(expansion *x, nh_ex e, parts *out)
{
    bool good = true;
    *out = single(nh_number(x->dag, nh_constant_of(x->dag, e)));
    for (size_t i = 0; i < nh_arity(x->dag, e) && good; i++) {
        nh_ex base = nh_child(x->dag, e, i), exponent = nh_exponent_of(x->dag, e, i);
        bool varies = false;
        size_t own;
        for (size_t k = 0; k < x->symbols && !varies; k++) varies = nh_depends(x->dag, base, x->symbol[k]);
        int64_t power = varies ? nh_number_of(x->dag, exponent).p : 1;
        good = expand(x, varies ? base : nh_pow(x->dag, base, exponent), &own);
        for (int64_t n = 0; n < power && good; n++) good = multiply(x, out, &x->list[own]);
    }
    return good;
}

/* Each node once: a shared graph has many paths. */
static bool expand(expansion *x, nh_ex e, size_t *list)
{
    uint32_t known;
    parts own = {0};
    bool varies = false, good = true;
    if (nh_index_get(&x->known, e, &known)) {
        *list = known;
        return true;
    }
    for (size_t k = 0; k < x->symbols && !varies; k++) varies = nh_depends(x->dag, e, x->symbol[k]);
    if (!varies) {
        own = single(e);
        own.count = !nh_is_zero(x->dag, e);
    } else if (nh_kind_of(x->dag, e) == NH_SYMBOL) {
        own = single(nh_int(x->dag, 1));
        for (size_t k = 0; k < x->symbols; k++) own.item[0].exponent[k] = e == x->symbol[k];
    } else {
        good = nh_kind_of(x->dag, e) == NH_SUM ? expand_sum(x, e, &own) : expand_product(x, e, &own);
    }
    nh_grow(&x->list, &x->capacity, x->lists + 1, sizeof *x->list);
    *list = x->lists;
    x->list[x->lists++] = own;
    if (good) nh_index_put(&x->known, e, (uint32_t)*list);
    return good;
}

bool nh_monomials_of(nh_dag *dag, nh_ex e, size_t symbols, const nh_ex *symbol, size_t most, nh_monomials *out)
{
    expansion x = {.dag = dag, .symbols = symbols, .symbol = symbol, .most = most};
    size_t list;
    *out = (nh_monomials){.symbols = symbols};
    bool good = symbols <= most_symbols && expand(&x, e, &list);
    if (good) {
        const parts *p = &x.list[list];
        out->count = p->count;
        out->exponent = nh_alloc_array(p->count * symbols + 1, sizeof *out->exponent);
        out->coefficient = nh_alloc_array(p->count + 1, sizeof *out->coefficient);
        for (size_t i = 0; i < p->count; i++) {
            memcpy(out->exponent + i * symbols, p->item[i].exponent, symbols);
            out->coefficient[i] = p->item[i].coefficient;
        }
    }
    for (size_t i = 0; i < x.lists; i++) nh_free(x.list[i].item);
    nh_free(x.list);
    nh_index_clear(&x.known);
    return good;
}

void nh_monomials_clear(nh_monomials *m)
{
    nh_free(m->exponent);
    nh_free(m->coefficient);
    *m = (nh_monomials){0};
}
