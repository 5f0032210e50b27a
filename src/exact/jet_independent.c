/* The independence of roots by patterns of squares and non-squares, and that of transcendental functions by series. */
#include "exact/jet_independent.h"

#include <flint/nmod_mat.h>

#include "base/memory.h"
#include "exact/jet_eval.h"
#include "exact/kernel.h"

enum { most_roots = 60, spare_rows = 20, most_tries = 20000, series_points = 8, series_tries = 400 };

static const char related[] = "functions that may be related to each other",
                  roots[] = "roots that may be related to each other";

/* The roots of even order, in levels: those of one level contain roots of lower ones only. */
typedef struct {
    nh_jet_point *point;
    nh_dag *dag;
    nh_ex *symbol;
    size_t symbols, count, levels;
    size_t kernel[most_roots], level[most_roots];
} tower;

/* ---- the tower ---- */

static bool is_even_root(const nh_jet_kernel *k) { return k->kind == NH_JET_ROOT && k->order % 2 == 0; }

static void list_symbols(tower *x)
{
    nh_ex *node, *key = nh_alloc_array(x->point->kernels + 1, sizeof *key);
    for (size_t i = 0; i < x->point->kernels; i++) key[i] = x->point->kernel[i].key;
    size_t n = nh_nodes_in(x->dag, x->point->kernels, key, &node);
    x->symbol = nh_alloc_array(n + 1, sizeof *x->symbol);
    for (size_t i = 0; i < n; i++)
        if (nh_kind_of(x->dag, node[i]) == NH_SYMBOL) x->symbol[x->symbols++] = node[i];
    nh_free(node);
    nh_free(key);
}

/* One more than the highest level of the roots inside of root i, of those that are known so far; SIZE_MAX where its
 * radicand is defined piece by piece. */
static size_t level_of(const tower *x, size_t i)
{
    nh_ex *node;
    size_t n = nh_nodes_in(x->dag, 1, &x->point->kernel[x->kernel[i]].key, &node), level = 0;
    for (size_t k = 0; k < n && level != SIZE_MAX; k++) {
        nh_kind kind = nh_kind_of(x->dag, node[k]);
        if (kind == NH_FUNCTION &&
            (nh_function_of(x->dag, node[k]) == NH_ABS || nh_function_of(x->dag, node[k]) == NH_SIGN))
            level = SIZE_MAX;
        for (size_t f = 0; kind == NH_PRODUCT && f < nh_arity(x->dag, node[k]); f++)
            for (size_t j = 0; j < x->count; j++)
                if (x->point->kernel[x->kernel[j]].key == nh_child(x->dag, node[k], f) && level <= x->level[j] &&
                    nh_exponent_kind_of(x->dag, nh_exponent_of(x->dag, node[k], f)) == NH_EXPONENT_ROOT)
                    level = x->level[j] + 1;
    }
    nh_free(node);
    return level;
}

/* False: there are too many roots, or one is defined piece by piece. */
static bool list_roots(tower *x)
{
    for (size_t i = 0; i < x->point->kernels; i++) {
        if (!is_even_root(&x->point->kernel[i]) || nh_jet_point_is_in_unity(x->point, x->point->kernel[i].key)) continue;
        if (x->count == most_roots) return false;
        x->kernel[x->count++] = i;
    }
    for (bool changes = true; changes;) {
        changes = false;
        for (size_t i = 0; i < x->count; i++) {
            size_t level = level_of(x, i);
            if (level == SIZE_MAX) return false;
            changes |= level > x->level[i];
            x->level[i] = level;
            if (level >= x->levels) x->levels = level + 1;
        }
    }
    return true;
}

/* ---- roots ---- */

/* All symbols at random series that begin with a random residue and a random slope. */
static nh_jet_eval *at_point(tower *x, const nh_jet_ring *ring, uint64_t seed)
{
    uint64_t random = seed + 31415;
    nh_residue *series = nh_alloc_array(ring->size + 1, sizeof *series);
    nh_jet_point_choose(x->point, ring->field, seed);
    nh_jet_eval *v = nh_jet_eval_create(x->point, ring);
    for (size_t k = 0; k < x->symbols; k++) {
        for (size_t e = 0; e < 2 && e < ring->size; e++) series[e] = nh_residue_random(ring->field, &random);
        nh_jet_eval_set(v, x->symbol[k], series, false);
    }
    nh_free(series);
    return v;
}

/* The next prime at which there are values: roots of odd order are unique, and where roots of even order are needed
 * one of two is a square itself.  Of the first level they are not: then 3, which is a square modulo all primes that are
 * 11 modulo 12, is told from squares beside cube roots, too. */
static nh_prime next_prime(const tower *x, size_t level, nh_prime f)
{
    for (bool good = false; !good;) {
        f = nh_prime_below(f, nh_jet_point_unity(x->point));
        good = !f.p || f.p % 4 == 3 || level == 0;
        for (size_t i = 0; i < x->point->kernels && good && f.p; i++) {
            uint64_t order = x->point->kernel[i].kind == NH_JET_ROOT ? x->point->kernel[i].order : 1;
            while (order % 2 == 0) order /= 2;
            good = nh_gcd((int64_t)order, (int64_t)f.p - 1) == 1;
        }
    }
    return f;
}

/* Which radicands of a level are no squares at a point, as bits; false: one has no value there, or is 0. */
static bool pattern(tower *x, size_t level, nh_prime field, uint64_t seed, uint64_t *bits)
{
    size_t one = 1, place = 0;
    nh_jet_ring *ring = nh_jet_ring_create(field, 1, &one, 0);
    nh_jet_eval *v = at_point(x, ring, seed);
    bool good = true;
    *bits = 0;
    for (size_t i = 0; i < x->count && good; i++) {
        nh_residue value;
        if (x->level[i] != level) continue;
        good = nh_jet_eval_all(v, 1, &x->point->kernel[x->kernel[i]].key, &value) && value;
        if (good && nh_residue_power(field, value, (field.p - 1) / 2) != 1) *bits |= (uint64_t)1 << place;
        place++;
    }
    nh_jet_eval_free(v);
    nh_jet_ring_free(ring);
    return good;
}

/* Adds a row over the field of two elements; returns whether the rank grows. */
static bool reduce(uint64_t *row, uint64_t bits)
{
    while (bits) {
        int lead = 63 - __builtin_clzll(bits);
        if (!row[lead]) return row[lead] = bits, true;
        bits ^= row[lead];
    }
    return false;
}

/* Is no product of radicands of this level a square? */
static bool independent_roots(tower *x, size_t level)
{
    uint64_t row[64] = {0}, bits;
    size_t wanted = 0, rank = 0, idle = 0;
    nh_prime field = {0};
    for (size_t i = 0; i < x->count; i++) wanted += x->level[i] == level;
    for (uint64_t seed = 1; seed < most_tries && rank < wanted && idle < spare_rows; seed++) {
        field = next_prime(x, level, field);
        if (!field.p) return false;
        if (!pattern(x, level, field, seed, &bits)) continue;
        bool grows = reduce(row, bits);
        rank += grows;
        idle = grows ? 0 : idle + 1;
    }
    return rank == wanted;
}

/* ---- series ---- */

/* Are the atoms of a kind linearly independent, as series along random lines at several points together? */
static bool independent_atoms(tower *x, bool real)
{
    size_t count, found = 0, one = 1;
    nh_prime field = nh_jet_point_prime(x->point, 0);
    nh_jet_eval *v = at_point(x, &(nh_jet_ring){.field = field, .size = 1}, 0);
    nh_jet_eval_atoms(v, real, &count, NULL);
    nh_jet_eval_free(v);
    if (!count) return true;
    nh_jet_ring *ring = nh_jet_ring_create(field, 1, &one, count + 2 < 250 ? count + 2 : 250);
    nmod_mat_t rows;
    nmod_mat_init(rows, (slong)count, (slong)(series_points * ring->size), field.p);
    nh_residue *series = nh_alloc_array(count * ring->size, sizeof *series);
    for (uint64_t seed = 1; seed < series_tries && found < series_points; seed++) {
        v = at_point(x, ring, seed);
        bool good = nh_jet_eval_atoms(v, real, &count, series);
        nh_jet_eval_free(v);
        for (size_t i = 0; i < count && good; i++)
            for (size_t e = 0; e < ring->size; e++)
                nmod_mat_entry(rows, i, found * ring->size + e) = series[i * ring->size + e];
        found += good;
    }
    bool independent = found == series_points && (size_t)nmod_mat_rank(rows) == count;
    nmod_mat_clear(rows);
    nh_free(series);
    nh_jet_ring_free(ring);
    return independent;
}

const char *nh_jet_point_related(nh_jet_point *point)
{
    tower x = {.point = point, .dag = point->dag};
    list_symbols(&x);
    point->conjugates = true;
    const char *why = list_roots(&x) ? NULL : roots;
    for (size_t level = 0; level < x.levels && !why; level++)
        if (!independent_roots(&x, level)) why = roots;
    for (int real = 0; real < 2 && !why; real++)
        if (!independent_atoms(&x, real)) why = related;
    point->conjugates = false;
    nh_free(x.symbol);
    return why;
}
