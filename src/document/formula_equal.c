/* Equal sums inside formulas, written the same way, so that one name serves them all.
 *
 * Values at one point propose which are equal; the normal form decides. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "document/formula.h"
#include "evaluate/tape.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"

enum {
    least_sum = 5, /* symbols: a shorter sum gets no name */
    most_sums = 2000,
    most_terms = 2000, /* of a normal form */
    most_rounds = 4    /* sums inside a sum may be replaced, too */
};

static const double closeness = 1e-10, nothing = 1e-8;

typedef struct {
    nh_ex sum;
    double value, size;
    size_t length;
} valued;

static int by_size(const void *a, const void *b)
{
    const valued *x = a, *y = b;
    if (x->size != y->size) return x->size < y->size ? -1 : 1;
    return (x->sum > y->sum) - (x->sum < y->sum);
}

/* Is it shorter, or of the same length and older? */
static bool simpler(const valued *x, const valued *y)
{
    return x->length != y->length ? x->length < y->length : x->sum < y->sum;
}

typedef struct {
    size_t symbols, sums;
    nh_ex *symbol, *sum;
} found;

/* The symbols, and the long sums in the formulas; a node has a larger index than its children. */
static found parts_of(const nh_dag *d, size_t n, const nh_ex *e)
{
    size_t nodes = nh_dag_size(d);
    bool *in = nh_alloc_array(nodes + 1, sizeof *in);
    found f = {.symbol = nh_alloc_array(nodes + 1, sizeof *f.symbol), .sum = nh_alloc_array(nodes + 1, sizeof *f.sum)};
    for (size_t i = 0; i < n; i++) in[e[i]] = true;
    for (size_t i = nodes; i-- > 0;) {
        nh_ex node = (nh_ex)i;
        if (!in[i]) continue;
        nh_kind kind = nh_kind_of(d, node);
        if (kind == NH_SYMBOL) f.symbol[f.symbols++] = node;
        if (kind == NH_SUM && nh_complexity(d, node) >= least_sum) f.sum[f.sums++] = node;
        for (size_t k = 0; kind != NH_SYMBOL && kind != NH_NUMBER && k < nh_arity(d, node); k++) {
            in[nh_child(d, node, k)] = true;
            if (kind == NH_PRODUCT) in[nh_exponent_of(d, node, k)] = true;
        }
    }
    nh_free(in);
    return f;
}

/* The sums sorted by their values at a point. */
static valued *in_order(nh_dag *d, const found *f)
{
    const double golden = 0.6180339887498949;
    double *at = nh_alloc_array(f->symbols + f->sums + 1, sizeof *at), *value = at + f->symbols;
    valued *list = nh_alloc_array(f->sums + 1, sizeof *list);
    for (size_t i = 0; i < f->symbols; i++) at[i] = 0.3 + 0.6 * fmod(golden * (double)(i + 1), 1);
    nh_tape *tape = nh_tape_create(d, f->symbols, f->symbol, f->sums, f->sum, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, at, value);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    for (size_t i = 0; i < f->sums; i++)
        list[i] =
            (valued){f->sum[i], value[i], isfinite(value[i]) ? fabs(value[i]) : INFINITY, nh_complexity(d, f->sum[i])};
    qsort(list, f->sums, sizeof *list, by_size);
    nh_free(at);
    return list;
}

/* Replaces each sum of a group by the simplest one, or minus it, if the two are proved equal. */
static size_t replacements(nh_dag *d, size_t n, const valued *group, nh_ex *from, nh_ex *to)
{
    const valued *best = group;
    size_t count = 0;
    for (size_t i = 1; i < n; i++)
        if (simpler(&group[i], best)) best = &group[i];
    for (size_t i = 0; i < n; i++) {
        if (&group[i] == best) continue;
        nh_ex other = signbit(group[i].value) == signbit(best->value) ? best->sum : nh_neg(d, best->sum);
        if (nh_normal_is_zero(d, nh_sub(d, group[i].sum, other), most_terms) != NH_ZERO) continue;
        from[count] = group[i].sum;
        to[count++] = other;
    }
    return count;
}

void nh_formula_unify(nh_dag *d, size_t n, nh_ex *e)
{
    found f = parts_of(d, n, e);
    if (f.sums > 1 && f.sums <= most_sums) {
        valued *list = in_order(d, &f);
        nh_ex *from = nh_alloc_array(2 * f.sums, sizeof *from), *to = from + f.sums;
        size_t count = 0;
        for (size_t i = 0, end; i < f.sums && isfinite(list[i].size); i = end) {
            for (end = i + 1; end < f.sums && list[end].size <= list[i].size * (1 + closeness);) end++;
            if (end > i + 1 && list[i].size > nothing)
                count += replacements(d, end - i, list + i, from + count, to + count);
        }
        for (size_t i = 0; i < n && count; i++)
            for (nh_ex before = e[i] + 1, round = 0; before != e[i] && round < most_rounds; round++) {
                before = e[i];
                e[i] = nh_substitute(d, e[i], count, from, to);
            }
        nh_free(from);
        nh_free(list);
    }
    nh_free(f.symbol);
    nh_free(f.sum);
}
