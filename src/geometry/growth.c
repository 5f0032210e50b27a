/* growth: the growth vector, where it drops, and the proof that its last rank is right. [docs/method.md, sec. 2,
 * (8a)]
 *
 *     1  residue_ranks       ranks of brackets modulo two primes (closure.h): lower bounds
 *        generic_ranks       where there are no residues: ranks by singular values at the probes
 *     2  look_for_drops      each coordinate, and all of them, at 0: other ranks there?
 *     3  prove_involutive    r brackets in reduced form E_i = d/dx^p(i) + .. span everything: [E_i, E_j] = 0
 *
 * Why 3 is a proof: [E_i, E_j] has the component 0 at every pivot p(i), so it lies in the span of the E_i only if it
 * is 0. */
#include "geometry/growth.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"

enum { most_fields = 200, largest_entry = 400, zero_terms = 2000, stages_beyond = 2, deepest = 4, most_nodes = 250000 };
static const double rank_bound = 1e-9;

typedef struct {
    const nh_model *o;
    nh_dag *d;
    size_t N;
    const nh_ex *symbol;
    double *unit; /* N: the unit of each component */
    bool proved, too_large;
    size_t end; /* size of the graph at which brackets are no longer formed */
} space;

void nh_growth_bracket(nh_dag *d, size_t N, const nh_ex *symbol, const nh_ex *a, const nh_ex *b, nh_ex *out)
{
    for (size_t s = 0; s < N; s++) {
        out[s] = nh_int(d, 0);
        for (size_t r = 0; r < N; r++) {
            if (!nh_is_zero(d, a[r])) out[s] = nh_add(d, out[s], nh_mul(d, a[r], nh_diff(d, b[s], symbol[r])));
            if (!nh_is_zero(d, b[r])) out[s] = nh_sub(d, out[s], nh_mul(d, b[r], nh_diff(d, a[s], symbol[r])));
        }
    }
}

/* ---- elimination over the field of functions ---- */

/* Fields in reduced form: E_i has the component 1 at pivot[i], where all others have 0. */
typedef struct {
    size_t count, *pivot;
    nh_ex *field; /* count x N */
} frame;

static void frame_init(frame *f, size_t N)
{
    *f = (frame){0, nh_alloc_array(N + 1, sizeof *f->pivot), nh_alloc_array(N * N + 1, sizeof *f->field)};
}

static void frame_clear(frame *f)
{
    nh_free(f->pivot);
    nh_free(f->field);
}

/* The simplified entry, and the number 0 where it vanishes identically. */
static nh_ex tidy(space *x, nh_ex e)
{
    nh_dag *d = x->d;
    if (nh_is_zero(d, e)) return e;
    e = nh_simplify(d, e);
    if (nh_is_zero(d, e)) return e;
    x->too_large |= nh_complexity(d, e) > largest_entry;
    if (nh_kind_of(d, e) == NH_NUMBER || nh_kind_of(d, e) == NH_SYMBOL) return e;
    if (nh_normal_is_zero(d, e, zero_terms) == NH_ZERO) return nh_int(d, 0);
    if (nh_chart_pivot_score(x->o->chart, e) > 0) return e;
    x->proved = false; /* it vanishes at the probes, without proof */
    return nh_int(d, 0);
}

/* x := x - x[p] e for a field e with 1 in component p. */
static void clear_component(space *x, nh_ex *field, const nh_ex *e, size_t p)
{
    nh_dag *d = x->d;
    nh_ex factor = field[p];
    if (nh_is_zero(d, factor)) return;
    for (size_t s = 0; s < x->N; s++)
        if (!nh_is_zero(d, e[s]))
            field[s] = s == p ? nh_int(d, 0) : tidy(x, nh_sub(d, field[s], nh_mul(d, factor, e[s])));
}

/* The simplest entry that does not vanish; N when there is none. */
static size_t choose_pivot(const space *x, const nh_ex *field)
{
    size_t best = x->N, least = SIZE_MAX;
    for (size_t s = 0; s < x->N; s++) {
        if (nh_is_zero(x->d, field[s])) continue;
        size_t size = nh_kind_of(x->d, field[s]) == NH_NUMBER ? 0 : nh_complexity(x->d, field[s]);
        if (size < least) best = s, least = size;
    }
    return best;
}

/* Add a field (overwritten) unless it is a combination of those there. */
static bool frame_add(space *x, frame *f, nh_ex *field)
{
    size_t N = x->N;
    for (size_t s = 0; s < N; s++) field[s] = tidy(x, field[s]);
    for (size_t i = 0; i < f->count; i++) clear_component(x, field, f->field + i * N, f->pivot[i]);
    size_t p = choose_pivot(x, field);
    if (p == N) return false;
    nh_ex inverse = nh_div(x->d, nh_int(x->d, 1), field[p]);
    for (size_t s = 0; s < N; s++) field[s] = s == p ? nh_int(x->d, 1) : tidy(x, nh_mul(x->d, inverse, field[s]));
    for (size_t i = 0; i < f->count; i++) clear_component(x, f->field + i * N, field, p);
    memcpy(f->field + f->count * N, field, N * sizeof *field);
    f->pivot[f->count++] = p;
    return true;
}

/* ---- ranks at points ---- */

/* Brackets [X_i, F] of the generators with those of the stage before; stage j ends before field first[j + 1]. */
typedef struct {
    size_t count, capacity, stages, first[NH_MOST_GROWTH + 1];
    nh_ex *field;
} brackets;

static void push(brackets *b, size_t N, const nh_ex *x)
{
    nh_grow(&b->field, &b->capacity, (b->count + 1) * N, sizeof *b->field);
    memcpy(b->field + b->count++ * N, x, N * sizeof *x);
}

static void next_stage(const space *x, brackets *b, size_t generators)
{
    size_t N = x->N, from = b->stages ? b->first[b->stages - 1] : 0, to = b->count;
    nh_ex *out = nh_alloc_array(N + 1, sizeof *out);
    for (size_t i = 0; i < generators; i++)
        for (size_t j = from; j < to && b->count < most_fields && nh_dag_size(x->d) < x->end; j++) {
            if (from == 0 && j <= i) continue; /* [X_i, X_j] once */
            nh_growth_bracket(x->d, x->N, x->symbol, b->field + i * N, b->field + j * N, out);
            push(b, N, out);
        }
    b->first[++b->stages] = b->count;
    nh_free(out);
}

/* The rank of the first `count` columns: a column that is rounding beside the largest one counts as zero, the others
 * enter by their directions. */
static size_t rank_of(size_t N, size_t count, const double *value, double *work)
{
    double largest = 0, *s = work + N * count;
    size_t used = 0, rank = 0;
    for (size_t i = 0; i < N * count; i++) largest = fmax(largest, fabs(value[i]));
    for (size_t i = 0; i < count; i++) {
        double size = 0;
        for (size_t j = 0; j < N; j++) size = hypot(size, value[i * N + j]);
        if (size <= rank_bound * 1e-3 * largest) continue;
        for (size_t j = 0; j < N; j++) work[used * N + j] = value[i * N + j] / size;
        used++;
    }
    size_t least = used < N ? used : N;
    if (used && nh_svd(N, used, work, s, NULL, NULL))
        while (rank < least && s[rank] > rank_bound * s[0]) rank++;
    return rank;
}

/* Scales components, so that lengths and angles compare. */
static void without_units(const space *x, size_t n, double *value)
{
    for (size_t i = 0; i < n; i++) value[i] /= x->unit[i % x->N];
}

/* The ranks of all stages at a point z; false where something is not finite. */
static bool ranks_at(const space *x, const brackets *b, const nh_tape *tape, const double *z, size_t *rank)
{
    size_t n = b->count * x->N;
    nh_tape_work *scratch = nh_tape_work_create(tape);
    double *value = nh_alloc_array(2 * n + b->count + x->N + 1, sizeof *value);
    nh_tape_eval(tape, scratch, z, value);
    bool good = true;
    without_units(x, n, value);
    for (size_t i = 0; i < n; i++) good &= isfinite(value[i]) && fabs(value[i]) < 1e100;
    for (size_t j = 0; j < b->stages && good; j++) rank[j] = rank_of(x->N, b->first[j + 1], value, value + n);
    nh_free(value);
    nh_tape_work_free(scratch);
    return good;
}

/* Keeps those fields of the last stage that raise the rank at z: brackets of the others give nothing new. */
static void prune(const space *x, brackets *b, const nh_tape *tape, const double *z)
{
    size_t N = x->N, from = b->first[b->stages - 1], kept = from, n = b->count * N;
    nh_tape_work *scratch = nh_tape_work_create(tape);
    double *value = nh_alloc_array(2 * n + b->count + N + 1, sizeof *value);
    nh_tape_eval(tape, scratch, z, value);
    without_units(x, n, value);
    size_t rank = rank_of(N, from, value, value + n);
    for (size_t j = from; j < b->count; j++) {
        memmove(value + kept * N, value + j * N, N * sizeof *value);
        size_t with = rank_of(N, kept + 1, value, value + n);
        if (with == rank) continue;
        rank = with;
        memmove(b->field + kept++ * N, b->field + j * N, N * sizeof *b->field);
    }
    b->count = b->first[b->stages] = kept;
    nh_free(value);
    nh_tape_work_free(scratch);
}

/* Adds stages, each with the largest rank over the probes, until the rank stays the same. */
static void generic_ranks(const space *x, size_t generators, const nh_ex *field, nh_growth *g)
{
    size_t rank[NH_MOST_GROWTH + 1];
    const nh_chart *c = x->o->chart;
    brackets b = {0};
    for (size_t i = 0; i < generators; i++) push(&b, x->N, field + i * x->N);
    b.first[++b.stages] = b.count;
    for (bool growing = true; growing;) {
        nh_tape *tape = nh_model_tape(x->o, b.count * x->N, b.field);
        size_t best = 0, at = 0, last = b.stages - 1, reached = g->length ? g->rank[g->length - 1] : 0;
        for (size_t p = 0; p < c->probes && best < x->N; p++)
            if (ranks_at(x, &b, tape, c->probe + p * x->o->width, rank) && rank[last] > best) best = rank[last], at = p;
        growing = best > reached;
        if (growing) g->rank[g->length++] = best;
        growing &= best < x->N && g->length < NH_MOST_GROWTH;
        if (growing && b.stages > 1) prune(x, &b, tape, c->probe + at * x->o->width);
        if (growing) next_stage(x, &b, generators);
        g->cut = nh_dag_size(x->d) >= x->end || b.count >= most_fields;
        growing &= !g->cut;
        nh_tape_free(tape);
    }
    nh_free(b.field);
}

/* The ranks modulo primes; false: the fields have no residues. */
static bool residue_ranks(const space *x, size_t generators, const nh_ex *field, nh_growth *g)
{
    nh_closure_growth c = nh_closure_growth_of(x->o, generators, x->N, x->symbol, field);
    if (c.obstacle) return false;
    g->length = c.length;
    memcpy(g->rank, c.rank, sizeof g->rank);
    g->cut = c.cut;
    return true;
}

/* ---- special places ---- */

/* Another growth vector than the generic one?  Beyond their ends both stay as they are. */
static bool differs(const nh_growth *g, const nh_closure_growth *c)
{
    for (size_t j = 0; j < c->length; j++)
        if (c->rank[j] != g->rank[j < g->length ? j : g->length - 1]) return true;
    return false;
}

/* Ranks, with repetitions, at a special place, up to the final generic one. */
static void keep_there(nh_growth *g, const nh_closure_growth *c, nh_ex where)
{
    size_t last = g->rank[g->length - 1];
    g->drops = true;
    g->where = where;
    for (size_t j = 0; j < c->length && (j == 0 || c->rank[j - 1] != last); j++)
        g->rank_there[g->length_there++] = c->rank[j];
    size_t *end = g->rank_there + g->length_there;
    for (; g->length_there > 1 && end[-1] == end[-2] && end[-1] != last; end--) g->length_there--;
}

/* Each coordinate at zero, and all of them, where the domain reaches there: all brackets, up to two stages beyond the
 * generic growth; their number at least doubles with every stage. */
static void look_for_drops(const space *x, size_t generators, const nh_ex *field, nh_growth *g)
{
    const nh_model *o = x->o;
    const nh_chart *chart = o->chart;
    if (g->length > deepest || g->cut || g->by_numbers) return;
    nh_ex *zero = nh_alloc_array(o->m + 1, sizeof *zero);
    for (size_t s = 0; s <= o->m && !g->drops; s++) {
        size_t count = 0;
        bool inside = true, present = false;
        for (size_t r = s == o->m ? 0 : s; r < (s == o->m ? o->m : s + 1); r++) {
            inside &= chart->low[1 + r] <= 0 && chart->high[1 + r] >= 0;
            zero[count++] = o->system->coordinate[r].q;
            for (size_t i = 0; i < generators * x->N && !present; i++)
                present = nh_depends(x->d, field[i], zero[count - 1]);
        }
        if (!inside || !present) continue;
        nh_closure_growth c =
            nh_closure_growth_at(o, generators, x->N, x->symbol, field, count, zero, g->length + stages_beyond);
        if (!c.obstacle && c.length && c.rank[0] == g->rank[0] && differs(g, &c))
            keep_there(g, &c, s < o->m ? o->system->coordinate[s].q : 0);
    }
    nh_free(zero);
}

/* ---- a proof that nothing is missing ---- */

/* Adds brackets of the fields with those before them, in reduced form, until there are `count` fields. */
static void grow_to(space *x, frame *f, size_t count)
{
    size_t N = x->N;
    nh_ex *field = nh_alloc_array(N + 1, sizeof *field);
    for (size_t i = 1; i < f->count && f->count < count && !x->too_large; i++)
        for (size_t j = 0; j < i && f->count < count && !x->too_large; j++) {
            nh_growth_bracket(x->d, x->N, x->symbol, f->field + i * N, f->field + j * N, field);
            frame_add(x, f, field);
        }
    nh_free(field);
}

/* Is the span involutive?  The brackets of `count` reduced fields have components 0 at the pivots, and must vanish. */
static bool prove_involutive(space *x, size_t generators, const nh_ex *generator, size_t count)
{
    size_t N = x->N;
    frame f;
    frame_init(&f, N);
    nh_ex *field = nh_alloc_array(N + 1, sizeof *field);
    for (size_t i = 0; i < generators; i++) {
        memcpy(field, generator + i * N, N * sizeof *field);
        frame_add(x, &f, field);
    }
    grow_to(x, &f, count);
    bool good = f.count == count && !x->too_large;
    for (size_t i = 0; i < f.count && good; i++)
        for (size_t j = 0; j < i && good; j++) {
            nh_growth_bracket(x->d, x->N, x->symbol, f.field + i * N, f.field + j * N, field);
            for (size_t s = 0; s < N && good; s++) good = nh_is_zero(x->d, tidy(x, field[s])) && !x->too_large;
        }
    nh_free(field);
    frame_clear(&f);
    return good && x->proved;
}

static void shift_down(size_t length, size_t *rank, size_t shift)
{
    for (size_t j = 0; j < length; j++) rank[j] = rank[j] > shift ? rank[j] - shift : 0;
}

nh_growth nh_growth_of(const nh_model *o, size_t count, size_t N, const nh_ex *symbol, const nh_ex *field, size_t shift)
{
    space x = {.o = o,
               .d = o->dag,
               .N = N,
               .symbol = symbol,
               .proved = true,
               .end = nh_dag_size(o->dag) + most_nodes,
               .unit = nh_alloc_array(N + 1, sizeof(double))};
    for (size_t s = 0; s < N; s++) x.unit[s] = nh_chart_symbol_unit(o->system, symbol[s]);
    nh_growth g = {.dimension = N - shift};
    g.by_numbers = !residue_ranks(&x, count, field, &g);
    if (g.by_numbers) generic_ranks(&x, count, field, &g);
    look_for_drops(&x, count, field, &g);
    nh_free(x.unit);
    size_t last = g.rank[g.length - 1];
    if (last == N) g.cut = false;
    g.proved = !g.cut && (last == N || prove_involutive(&x, count, field, last));
    shift_down(g.length, g.rank, shift);
    shift_down(g.length_there, g.rank_there, shift);
    return g;
}
