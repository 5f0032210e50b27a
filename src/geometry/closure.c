/* closure: brackets as truncated power series modulo a prime.
 *
 *     take         the components, with the parameters' values, in the canonical form that has residues
 *     evaluate     their series at a random point: value[i] is an element of ring[x_1, .., x_N] up to an order d
 *     close_up     brackets of the generators with all that were kept, until the rank stays
 *     growth_with  for the growth vector: the same by stages, at points modulo two primes
 *
 * A bracket takes a derivative, so each loses one order of its series: one of j-th depth is right up to the order d -
 * j. Only the constant terms enter the rank.
 *
 *     X_1, X_2                 order d          rank at the point: constant terms of these
 *     [X_1, X_2]               order d - 1
 *     [X_1, [X_1, X_2]], ..    order d - 2      the order 0 ends it: `cut`, and a longer series is tried
 *
 * A series of a field is N series of ring->size residues, one component after the other. */
#include "geometry/closure.h"

#include <string.h>

#include "base/progress.h"
#include "exact/form.h"
#include "exact/jet_eval.h"
#include "exact/jet_independent.h"
#include "exact/residue_matrix.h"
#include "graph/node.h"

enum { canonical_length = 2000, most_points = 200, most_size = 3000, deepest = 10, most_nodes = 400000 };
/* of growth vectors: the order of the first attempt, coefficients of a series, brackets, points */
enum { first_order = 3, largest_series = 7000, most_fields = 200, growth_points = 2 };

typedef struct {
    const nh_model *o;
    nh_dag *d;
    size_t N, count, functions;
    const nh_ex *symbol; /* N */
    size_t zeros;        /* symbols that are 0 at the point */
    const nh_ex *zero;
    /* the components of the fields, then the functions: in canonical form, with the parameters' values */
    nh_ex *e;
    nh_prime field;
    nh_jet_point *point;
    nh_jet_ring *ring;
    nh_residue *value; /* of e */
    /* number of fields that are independent at the point, and the order up to which their series are right */
    size_t kept, *order;
    nh_residue *frame; /* N x N series */
} space;

/* Field i of those that were kept: N series. */
static nh_residue *member(const space *x, size_t i) { return x->frame + i * x->N * x->ring->size; }

/* ---- a point ---- */

static bool is_zero_there(const space *x, nh_ex symbol)
{
    for (size_t i = 0; i < x->zeros; i++)
        if (x->zero[i] == symbol) return true;
    return false;
}

/* Series of all components at the random point of this seed: symbol k stands for c_k + x_k, c_k random or, at a
 * special place, 0.  False where a function has no value there; then another seed is tried. */
static bool evaluate(space *x, uint64_t seed)
{
    uint64_t random = seed + 815;
    nh_jet_point_choose(x->point, x->field, seed);
    if (!nh_jet_point_vanish(x->point, x->zeros, x->zero)) return false;
    nh_jet_eval *v = nh_jet_eval_create(x->point, x->ring);
    nh_residue *series = nh_alloc_array(x->ring->size, sizeof *series);
    for (size_t k = 0; k < x->N; k++) {
        nh_residue at = nh_residue_random(x->field, &random);
        nh_jet_constant(x->ring, is_zero_there(x, x->symbol[k]) ? 0 : at, series);
        if (x->ring->order) series[x->ring->up[k * x->ring->size]] = 1;
        nh_jet_eval_set(v, x->symbol[k], series, false);
    }
    bool good = nh_jet_eval_all(v, x->count * x->N + x->functions, x->e, x->value);
    nh_free(series);
    nh_jet_eval_free(v);
    return good;
}

/* ---- the closure ---- */

/* Keeps the field if it raises the rank at the point; returns whether it does. */
static bool keep(space *x, const nh_residue *field, size_t order)
{
    size_t N = x->N, size = x->ring->size;
    nh_residue *rows = nh_alloc_array((x->kept + 1) * N, sizeof *rows);
    for (size_t i = 0; i <= x->kept; i++)
        for (size_t c = 0; c < N; c++) rows[i * N + c] = (i < x->kept ? member(x, i) : field)[c * size];
    bool grows = x->kept < N && nh_residue_matrix_rank(x->field, x->kept + 1, N, rows) == x->kept + 1;
    nh_free(rows);
    if (!grows) return false;
    memcpy(member(x, x->kept), field, N * size * sizeof *field);
    x->order[x->kept++] = order;
    return true;
}

/* out = [a, b] */
static void bracket(const space *x, const nh_residue *a, const nh_residue *b, nh_residue *out)
{
    const nh_jet_ring *ring = x->ring;
    size_t size = ring->size;
    nh_residue *slope = nh_alloc_array(size, sizeof *slope);
    memset(out, 0, x->N * size * sizeof *out);
    for (size_t s = 0; s < x->N; s++)
        for (size_t r = 0; r < x->N; r++) {
            if (!nh_jet_is_zero(ring, a + r * size)) {
                nh_jet_derivative(ring, b + s * size, r, slope);
                nh_jet_add_product(ring, out + s * size, a + r * size, slope);
            }
            if (nh_jet_is_zero(ring, b + r * size)) continue;
            nh_jet_derivative(ring, a + s * size, r, slope);
            nh_jet_sub_product(ring, out + s * size, b + r * size, slope);
        }
    nh_free(slope);
}

/* Brackets of the generators with every kept field, until there is no new one.  Brackets that need higher orders than
 * the series have are left out. */
static void close_up(space *x, size_t enough)
{
    nh_residue *out = nh_alloc_array(x->N * x->ring->size, sizeof *out);
    for (size_t i = 0; i < x->count && x->kept < enough; i++)
        keep(x, x->value + i * x->N * x->ring->size, x->ring->order);
    size_t generators = x->kept;
    for (size_t j = 0; j < x->kept; j++)
        for (size_t i = 0; i < generators && x->kept < enough && !nh_late(); i++) {
            if (x->order[j] == 0 || (j < generators && i >= j)) continue;
            bracket(x, member(x, i), member(x, j), out);
            keep(x, out, x->order[j] - 1);
        }
    nh_free(out);
}

/* The rank of the functions' gradients at the point. */
static size_t gradients(const space *x)
{
    size_t size = x->ring->size;
    nh_residue *rows = nh_alloc_array(x->functions * x->N + 1, sizeof *rows);
    for (size_t i = 0; i < x->functions; i++)
        for (size_t k = 0; k < x->N; k++)
            rows[i * x->N + k] = x->value[(x->count * x->N + i) * size + x->ring->up[k * size]];
    size_t rank = nh_residue_matrix_rank(x->field, x->functions, x->N, rows);
    nh_free(rows);
    return rank;
}

/* ---- the whole ---- */

/* For the roots that are functions of others. */
static int sign_at_probe(void *context, nh_ex e) { return nh_model_sign_at_probe(((space *)context)->o, e); }

/* The reason why the fields have no series modulo a prime, or NULL. */
static const char *take(space *x, const nh_ex *field, const nh_ex *function)
{
    size_t n = x->count * x->N, nodes = 0;
    nh_forms forms;
    x->e = nh_alloc_array(n + x->functions + 1, sizeof *x->e);
    for (size_t i = 0; i < n + x->functions && nodes < most_nodes; i++)
        nodes += nh_node_count(x->d, i < n ? field[i] : function[i - n]);
    if (nodes >= most_nodes) return "formulas that are too long";
    x->point->sign = sign_at_probe;
    x->point->context = x;
    nh_forms_init(&forms, x->d, false, canonical_length);
    for (size_t i = 0; i < n + x->functions; i++)
        x->e[i] = nh_form_rewrite(&forms, nh_model_values(x->o, i < n ? field[i] : function[i - n]));
    nh_forms_clear(&forms);
    if (x->o->chart->implicit) return "velocities that are given implicitly";
    if (!nh_jet_point_register(x->point, n + x->functions, x->e)) return x->point->obstacle;
    return nh_jet_point_related(x->point);
}

/* The ring of series in N variables to the order given, or to the largest below it with at most `most` coefficients. */
static nh_jet_ring *ring_of(const space *x, size_t order, size_t most)
{
    size_t *one = nh_alloc_array(x->N + 1, sizeof *one);
    for (size_t k = 0; k < x->N; k++) one[k] = 1;
    while (order > 1 && nh_jet_ring_size(x->N, one, order, most) == SIZE_MAX) order--;
    nh_jet_ring *ring = nh_jet_ring_create(x->field, x->N, one, order);
    nh_free(one);
    return ring;
}

/* One regular point decides: the gradients of the known functions first, which say how large the rank can be. */
static void solve(space *x, nh_closure *out)
{
    bool good = false;
    x->field = nh_jet_point_prime(x->point, 0); /* they are known after the roots of numbers */
    x->ring = ring_of(x, deepest, most_size);
    x->value = nh_alloc_array((x->count * x->N + x->functions) * x->ring->size + 1, sizeof *x->value);
    x->frame = nh_alloc_array(x->N * x->N * x->ring->size, sizeof *x->frame);
    x->order = nh_alloc_array(x->N + 1, sizeof *x->order);
    for (uint64_t seed = 1; seed <= most_points && !good; seed++) good = evaluate(x, seed);
    if (!good) out->obstacle = "no regular point was found";
    if (out->obstacle) return;
    out->known = gradients(x);
    close_up(x, x->N - out->known);
    out->rank = x->kept;
}

static void clear(space *x)
{
    nh_jet_ring_free(x->ring);
    nh_free(x->order);
    nh_free(x->frame);
    nh_free(x->value);
    nh_free(x->e);
    nh_jet_point_free(x->point);
}

nh_closure nh_closure_of(const nh_model *o, size_t count, const nh_ex *field, size_t functions, const nh_ex *function)
{
    space x = {.o = o,
               .d = o->dag,
               .N = 1 + o->m + o->n,
               .symbol = o->chart->symbol,
               .count = count,
               .functions = functions,
               .point = nh_jet_point_create(o->dag)};
    nh_closure out = {.dimension = x.N};
    out.obstacle = take(&x, field, function);
    if (!out.obstacle) solve(&x, &out);
    clear(&x);
    return out;
}

/* ---- growth ---- */

/* Fields that raise the rank, stage by stage: at a generic point the brackets of the others give nothing new. */
static void generic_stages(space *x, nh_closure_growth *g)
{
    nh_residue *out = nh_alloc_array(x->N * x->ring->size, sizeof *out);
    x->kept = 0;
    for (size_t i = 0; i < x->count; i++) keep(x, x->value + i * x->N * x->ring->size, x->ring->order);
    size_t generators = x->kept, from = 0, to = x->kept;
    g->rank[g->length++] = to;
    for (bool grows = true; grows && to < x->N && g->length < NH_MOST_GROWTH && !g->cut;) {
        g->cut = x->order[from] == 0 || nh_late();
        for (size_t j = from; j < to && !g->cut; j++)
            for (size_t i = 0; i < generators && x->kept < x->N; i++) {
                if (j < generators && i >= j) continue;
                bracket(x, member(x, i), member(x, j), out);
                keep(x, out, x->order[j] - 1);
            }
        grows = x->kept > to;
        from = to;
        to = x->kept;
        if (grows) g->rank[g->length++] = to;
    }
    nh_free(out);
}

/* All brackets, of `stages` stages: where ranks are not constant, dependent fields have independent brackets. */
static void all_stages(space *x, size_t stages, nh_closure_growth *g)
{
    size_t N = x->N, size = x->ring->size, length = N * size, total = x->count, from = 0, to = total;
    nh_residue *field = nh_alloc_array((most_fields + x->count) * length, sizeof *field);
    nh_residue *rows = nh_alloc_array((most_fields + x->count) * N, sizeof *rows);
    memcpy(field, x->value, total * length * sizeof *field);
    for (size_t stage = 0; stage < stages && !g->cut; stage++) {
        for (size_t j = from; stage && j < to && !g->cut; j++)
            for (size_t i = 0; i < x->count && !g->cut; i++) {
                if (stage == 1 && i >= j) continue; /* [X_i, X_j] once */
                g->cut = total == most_fields + x->count || nh_late();
                if (!g->cut) bracket(x, field + i * length, field + j * length, field + total++ * length);
            }
        if (stage) from = to, to = total;
        for (size_t i = 0; i < total; i++)
            for (size_t c = 0; c < N; c++) rows[i * N + c] = field[i * length + c * size];
        if (!g->cut) g->rank[g->length++] = nh_residue_matrix_rank(x->field, total, N, rows);
    }
    nh_free(rows);
    nh_free(field);
}

/* The larger ranks of two points: both are lower bounds. */
static void join(nh_closure_growth *g, const nh_closure_growth *other)
{
    for (size_t j = 0; j < other->length; j++) {
        size_t before = j < g->length ? g->rank[j] : 0;
        g->rank[j] = other->rank[j] > before ? other->rank[j] : before;
    }
    if (other->length > g->length) g->length = other->length;
    g->cut |= other->cut;
}

/* At points modulo two primes, with series up to this order; `stages`: at a special place. */
static nh_closure_growth growth_with(space *x, size_t order, size_t stages, size_t *used)
{
    nh_closure_growth g = {0};
    uint64_t seed = 0;
    for (size_t index = 0; index < growth_points && !g.obstacle; index++) {
        nh_closure_growth here = {0};
        bool good = false;
        x->field = nh_jet_point_prime(x->point, index);
        x->ring = ring_of(x, order, largest_series);
        *used = x->ring->order;
        x->value = nh_alloc_array(x->count * x->N * x->ring->size + 1, sizeof *x->value);
        x->frame = nh_alloc_array(x->N * x->N * x->ring->size, sizeof *x->frame);
        x->order = nh_alloc_array(x->N + 1, sizeof *x->order);
        for (size_t tries = 0; tries < most_points && !good; tries++) good = evaluate(x, ++seed);
        if (!good) g.obstacle = "no regular point was found";
        else if (stages) all_stages(x, stages, &here);
        else generic_stages(x, &here);
        join(&g, &here);
        nh_jet_ring_free(x->ring);
        nh_free(x->value);
        nh_free(x->frame);
        nh_free(x->order);
        x->ring = NULL, x->value = x->frame = NULL, x->order = NULL;
    }
    return g;
}

/* Without `stages` the order grows by 2 as long as it was what ended the growth; a special place needs stages - 1
 * derivatives and no more. */
static nh_closure_growth growth_of(space *x, const nh_ex *field, size_t stages)
{
    nh_closure_growth g = {0};
    x->d = x->o->dag;
    x->point = nh_jet_point_create(x->d);
    g.obstacle = take(x, field, NULL);
    size_t order = stages ? stages - 1 : first_order, used = order;
    for (bool again = !g.obstacle; again; order += 2) {
        g = growth_with(x, order, stages, &used);
        again = !stages && g.cut && !g.obstacle && used == order && order < deepest;
    }
    clear(x);
    return g;
}

nh_closure_growth nh_closure_growth_of(const nh_model *o, size_t count, size_t N, const nh_ex *symbol,
                                       const nh_ex *field)
{
    space x = {.o = o, .N = N, .symbol = symbol, .count = count};
    return growth_of(&x, field, 0);
}

nh_closure_growth nh_closure_growth_at(const nh_model *o, size_t count, size_t N, const nh_ex *symbol,
                                       const nh_ex *field, size_t zeros, const nh_ex *zero, size_t stages)
{
    space x = {.o = o, .N = N, .symbol = symbol, .count = count, .zeros = zeros, .zero = zero};
    return growth_of(&x, field, stages);
}
