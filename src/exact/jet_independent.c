/* Are the functions at a point independent, except for what the point keeps (jet_independent.h)?
 *
 *      K_2  = K_1(sqrt of radicands with roots of level 1)        roots of level 1: their radicands contain
 *       |                                                         roots of level 0, and so on
 *      K_1  = K_0(sqrt of radicands in K_0)
 *       |
 *      K_0  = Q(symbols, exp, sin, cos, log, ..)                  transcendental: independent atoms, by series [Ax1971]
 *
 *      one level:       radicand   D_1  D_2  D_3       a row per random point: 1 where the residue is no square
 *        point 1                    1    0    1        full rank over the field of two elements: no product of
 *        point 2                    0    1    1        the D_i is a square in K, and the level has degree 2^3
 *        point 3                    1    1    1
 *
 * Where the rank stays below for many points, the null vector says which product seems to be a square: then its root
 * is searched (field_root.h), and the last root of the product is from then on a function of the others. This repeats
 * until a level is independent, or no root is found: then nothing is known. */
#include "exact/jet_independent.h"

#include <flint/nmod_mat.h>

#include "base/memory.h"
#include "exact/field_root.h"
#include "exact/jet_eval.h"
#include "exact/kernel.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_roots = 60, spare_rows = 20, most_tries = 20000, series_points = 8, series_tries = 400, most_inner = 8 };

static const char related[] = "functions that may be related to each other",
                  roots[] = "roots that may be related to each other";

/* The roots of even order, in levels: those of one level contain roots of lower ones only. */
typedef struct {
    nh_jet_point *point;
    nh_dag *dag;
    nh_ex *symbol;
    size_t symbols, count, levels;
    size_t kernel[most_roots], level[most_roots];
    bool dependent[most_roots]; /* a function of the others */
} tower;

/* ---- the tower ---- */

/* Roots of odd order are unique modulo the primes that are taken, and need no test. */
static bool is_even_root(const nh_jet_kernel *k) { return k->kind == NH_JET_ROOT && k->order % 2 == 0; }

/* The symbols that get values of their own. */
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
        const nh_jet_kernel *k = &x->point->kernel[i];
        if (!is_even_root(k) || nh_jet_point_is_in_unity(x->point, k->key)) continue;
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

/* Is it one of the independent roots of this level? */
static bool counts(const tower *x, size_t i, size_t level) { return x->level[i] == level && !x->dependent[i]; }

/* Have all independent roots of lower levels values at the point?  Only then is it one of the field that they generate:
 * 6 + sqrt(11) = ((1 + sqrt(11))/sqrt(2))^2 is no square where 2 is none. */
static bool has_lower_roots(tower *x, nh_jet_eval *v, size_t level)
{
    bool good = true;
    for (size_t below = 0; below < level; below++)
        for (size_t i = 0; i < x->count && good; i++) {
            const nh_jet_kernel *k = &x->point->kernel[x->kernel[i]];
            nh_num least = nh_num_ratio(1, (int64_t)k->order);
            nh_residue value, root;
            if (counts(x, i, below))
                good = nh_jet_eval_all(v, 1, &k->key, &value) && value &&
                       nh_jet_point_root(x->point, k->key, value, least, &root);
        }
    return good;
}

/* Which radicands of a level are no squares at a point, as bits; false: one has no value there, or is 0. */
static bool pattern(tower *x, size_t level, nh_prime field, uint64_t seed, uint64_t *bits)
{
    size_t one = 1, place = 0;
    nh_jet_ring *ring = nh_jet_ring_create(field, 1, &one, 0);
    nh_jet_eval *v = at_point(x, ring, seed);
    bool good = has_lower_roots(x, v, level);
    *bits = 0;
    for (size_t i = 0; i < x->count && good; i++) {
        nh_residue value;
        if (!counts(x, i, level)) continue;
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

/* A set of `count` places with an even number of every row's: the kernel of the rows, which are in echelon form. */
static uint64_t unseen(const uint64_t *row, size_t count)
{
    uint64_t set = 0;
    size_t free = 0;
    while (free < count && row[free]) free++;
    set = (uint64_t)1 << free;
    for (size_t lead = free + 1; lead < count; lead++) /* a row's bits are its lead and lower ones */
        if (row[lead] && __builtin_parityll(row[lead] & set)) set |= (uint64_t)1 << lead;
    return set;
}

/* Is no product of radicands of this level a square?  Where it seems that one is: `together`. */
static bool independent_roots(tower *x, size_t level, uint64_t *together)
{
    uint64_t row[64] = {0}, bits;
    size_t wanted = 0, rank = 0, idle = 0;
    nh_prime field = {0};
    *together = 0;
    for (size_t i = 0; i < x->count; i++) wanted += counts(x, i, level);
    for (uint64_t seed = 1; seed < most_tries && rank < wanted && idle < spare_rows; seed++) {
        field = next_prime(x, level, field);
        if (!field.p) return false;
        if (!pattern(x, level, field, seed, &bits)) continue;
        bool grows = reduce(row, bits);
        rank += grows;
        idle = grows ? 0 : idle + 1;
    }
    if (rank < wanted && idle == spare_rows) *together = unseen(row, wanted);
    return rank == wanted;
}

/* ---- roots that are functions of others ---- */

/* Adds the arguments of a kind of functions that can stand in e. */
static size_t arguments_of(const tower *x, nh_jet_kernel_kind kind, nh_ex e, nh_ex *out)
{
    size_t count = 0;
    for (size_t i = 0; i < x->point->kernels; i++) {
        const nh_jet_kernel *k = &x->point->kernel[i];
        if (k->kind != kind || nh_jet_point_is_pi(x->point, k->key)) continue;
        NH_LIST(symbol);
        bool occurs = !nh_symbols_in(x->dag, k->key, &symbol);
        for (size_t s = 0; s < x->symbols && !occurs; s++)
            occurs = nh_depends(x->dag, k->key, x->symbol[s]) && nh_depends(x->dag, e, x->symbol[s]);
        if (occurs) out[count++] = nh_mul(x->dag, nh_ratio(x->dag, 1, (int64_t)k->order), k->key);
    }
    return count;
}

/* A function whose square is e, a product of radicands of this level. */
static bool root_of(const tower *x, size_t level, nh_ex e, nh_ex *root)
{
    size_t room = x->point->kernels + 1;
    nh_ex *angle = nh_alloc_array(3 * room, sizeof *angle), *exponent = angle + room, *radicand = exponent + room;
    nh_root_field f = {.angle = angle, .exponent = exponent, .radicand = radicand};
    for (size_t i = x->count; i-- > 0;) { /* from outside */
        const nh_jet_kernel *k = &x->point->kernel[x->kernel[i]];
        if (x->dependent[i] && x->level[i] < level) e = nh_substitute_root(x->dag, e, k->key, k->P);
    }
    f.angles = arguments_of(x, NH_JET_CIRCLE, e, angle);
    f.exponents = arguments_of(x, NH_JET_EXPONENTIAL, e, exponent);
    for (size_t below = 0; below < level; below++)
        for (size_t i = 0; i < x->count; i++)
            if (counts(x, i, below) && x->point->kernel[x->kernel[i]].order == 2)
                radicand[f.roots++] = x->point->kernel[x->kernel[i]].key;
    bool good = f.roots <= most_inner && nh_field_root(x->dag, &f, e, root);
    nh_free(angle);
    return good;
}

/* The last square root in `together`, whose radicands have a square as their product, as a function of the others. */
static bool express(tower *x, size_t level, uint64_t together)
{
    nh_dag *d = x->dag;
    nh_ex product = nh_int(d, 1), roots_of_all = product, last_root = product, root;
    size_t place = 0, last = SIZE_MAX, kernels = x->point->kernels;
    for (size_t i = 0; i < x->count; i++) {
        if (!counts(x, i, level) || !(together >> place++ & 1)) continue;
        nh_ex key = x->point->kernel[x->kernel[i]].key, r = nh_sqrt(d, key);
        product = nh_mul(d, product, key);
        roots_of_all = nh_mul(d, roots_of_all, r);
        if (x->point->kernel[x->kernel[i]].order == 2) last = i, last_root = r;
    }
    if (last == SIZE_MAX || !x->point->sign || !root_of(x, level, product, &root)) return false;
    int sign = x->point->sign(x->point->context, root);
    nh_ex formula = nh_div(d, nh_mul(d, nh_mul(d, nh_int(d, sign), root), last_root), roots_of_all);
    if (!sign || !nh_jet_point_register(x->point, 1, &formula) || x->point->kernels != kernels) return false;
    x->point->kernel[x->kernel[last]].P = formula;
    return x->point->kernel[x->kernel[last]].dependent = x->dependent[last] = true;
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

/* Level by level, then the atoms of the two kinds of transcendental functions. */
const char *nh_jet_point_related(nh_jet_point *point)
{
    tower x = {.point = point, .dag = point->dag};
    uint64_t together;
    for (size_t i = 0; i < point->kernels; i++) point->kernel[i].dependent = false;
    list_symbols(&x);
    point->conjugates = true;
    const char *why = list_roots(&x) ? NULL : roots;
    for (size_t level = 0; level < x.levels && !why; level++)
        while (!why && !independent_roots(&x, level, &together))
            if (!together || !express(&x, level, together)) why = roots;
    for (int real = 0; real < 2 && !why; real++)
        if (!independent_atoms(&x, real)) why = related;
    point->conjugates = false;
    nh_free(x.symbol);
    return why;
}
